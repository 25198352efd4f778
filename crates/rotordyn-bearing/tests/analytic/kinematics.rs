//! Ball bearing kinematics from the geometry: groove centre radius, entrainment speed, passage of defects.

use crate::agree;
use crate::bearing::rig_6205;
use rotordyn_bearing::contact::{BallContacts, ContactLaw, Lubricant, Race};
use rotordyn_bearing::{BallBearing, BallElement, Defect, DefectForm, Rotation, Shape, Surface};

/// The centre of a 7.938 mm ball at the bottom of the inner groove is a quarter of the diametral clearance
/// inside the pitch circle of 38.5 mm, and the centre of the groove (radius 0.515 D_w) is r_i − D_w/2 farther
/// out: 19.25 − 0.0025 + (4.08807 − 3.969) mm.
#[test]
fn inner_groove_centre_radius() {
    let geometry = rig_6205().geometry;
    agree::absolute(
        "radius of the inner groove centres [m]",
        geometry.inner_centre_radius(),
        19.366_57e-3,
        1e-12,
    );
}

/// Entrainment speed is the speed of the race relative to the cage: ω_c r_o at the outer race and
/// (Ω − ω_c) r_i at the inner race, r being the race radius at the contact; both are equal in pure rolling.
#[test]
fn film_thickness_at_entrainment_speed() {
    let lubricant =
        Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2.2e-8, density: 870.0 };
    let contact = ContactLaw::Film { lubricant, speed_factor: 1.0 };
    for angle in [0.0, 0.4_f64] {
        let mut bearing = BallBearing { contact: contact.clone(), ..rig_6205() };
        bearing.geometry.contact_angle = angle;
        let g = &bearing.geometry;
        let [inner, outer] =
            [-0.5, 0.5].map(|half| 0.5 * g.pitch_diameter + half * g.ball_diameter * angle.cos());
        let shaft = 300.0;
        // Cage speed of equal entrainment speed at both races.
        let cage = shaft * inner / (inner + outer);
        let speed = cage * outer;
        agree::relative("cage speed of equal entrainment [m/s]", speed, (shaft - cage) * inner, 1e-14);
        let contacts = BallContacts::new(bearing.hertz(), contact.clone());
        let element = BallElement::new(&bearing);
        let d = [12e-6, 0.0, if angle > 0.0 { 10e-6 } else { 0.0 }, 0.0, 0.0, 0.0];
        let rotation = Rotation { shaft_speed: shaft, cage_speed: Some(cage), ..Rotation::default() };
        let mut loaded = 0;
        for ball in element.ball_loads(&d, &rotation).iter().filter(|ball| ball.load > 1.0) {
            for (k, race) in [Race::Inner, Race::Outer].into_iter().enumerate() {
                let expected = contacts.at_speed(speed).film(race, ball.load);
                // Round-off of the power function.
                agree::relative(format_args!("film at the {race:?} race [m]"), ball.film[k], expected, 1e-12);
            }
            loaded += 1;
        }
        assert!(loaded > 0);
    }
}

/// Balls less loaded than with perfect races, all positions being fixed.
fn balls_in_dent(bearing: &BallBearing, rotation: &Rotation) -> Vec<bool> {
    let perfect = BallBearing { imperfections: Default::default(), ..bearing.clone() };
    let loads = |bearing: &BallBearing| BallElement::new(bearing).ball_loads(&[0.0; 6], rotation);
    loads(bearing)
        .iter()
        .zip(loads(&perfect))
        .map(|(dented, perfect)| dented.load < perfect.load - 1e-3)
        .collect()
}

/// Nine preloaded balls; a dent of 1 mm length starts at an angle on a surface.
fn bearing_with_dent(surface: Surface, start: f64) -> BallBearing {
    let mut bearing = rig_6205();
    bearing.geometry.radial_clearance = -20e-6;
    let form = DefectForm::Dent { depth: Some(2e-6), shape: Shape::HalfSine };
    bearing.imperfections.defects = vec![Defect { surface, row: None, start, width: 1e-3, form }];
    bearing
}

/// A dent on the inner race rotates with the shaft, a dent on the outer race is stationary.
#[test]
fn dent_positions_on_inner_and_outer_race() {
    for (surface, shaft, at) in
        [(Surface::Inner, 2.0, 3.0), (Surface::Inner, -0.7, 0.3), (Surface::Outer, 2.0, 1.0)]
    {
        let bearing = bearing_with_dent(surface, 1.0);
        // Dent length 1 mm on a race of 15.3 or 23.2 mm radius: 0.065 or 0.043 rad.
        for (off, in_dent) in [(0.025, true), (-0.01, false), (0.09, false)] {
            let rotation = Rotation { cage_angle: at + off, shaft_angle: shaft, ..Rotation::default() };
            let balls = balls_in_dent(&bearing, &rotation);
            assert_eq!(balls[0], in_dent, "{surface:?} {shaft} {off}");
            assert!(balls[1..].iter().all(|b| !b));
        }
    }
}

/// Pure rolling on the outer race: ball spin angle relative to the cage χ = 2 ψ r_o/D_w with
/// r_o = ½ D_pw (1 + γ), shaft angle θ = 2 ψ/(1 − γ). A ball dent contacts the outer race once per ball
/// revolution, and the inner race half a revolution later.
#[test]
fn ball_dent_contacts_both_races_once_per_ball_revolution() {
    let bearing = bearing_with_dent(Surface::Ball(0), 0.0);
    let g = &bearing.geometry;
    let gamma = g.ball_diameter / g.pitch_diameter;
    // Dent length 1 mm on a ball of 3.969 mm radius: 0.252 rad.
    for turns in [0.0, 1.0, 3.0, 20.0] {
        for (off, in_dent) in [(0.126, true), (-0.05, false), (0.3, false), (1.57, false)] {
            for race in [0.0, std::f64::consts::PI] {
                let spin = std::f64::consts::TAU * turns + race + off;
                let cage = spin * g.ball_diameter / (g.pitch_diameter * (1.0 + gamma));
                let rotation = Rotation {
                    cage_angle: cage,
                    shaft_angle: 2.0 * cage / (1.0 - gamma),
                    ..Rotation::default()
                };
                let balls = balls_in_dent(&bearing, &rotation);
                assert_eq!(balls[0], in_dent, "{turns} turns, {race} + {off}");
                assert!(balls[1..].iter().all(|b| !b));
            }
        }
    }
}
