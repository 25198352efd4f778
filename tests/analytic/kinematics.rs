//! Places and speeds inside a ball bearing from its drawing: the inner groove's centres, and what drags oil in.

use crate::bearing::rig_6205;
use rotordyn::bearing::{BallBearing, BallElement, Defect, DefectForm, Rotation, Shape, Surface};
use rotordyn::contact::{BallContacts, ContactLaw, Lubricant, Race};

/// A ball of 7.938 mm at the bottom of the inner groove has its centre a quarter of the diametral clearance within the
/// pitch circle of 38.5 mm, and the groove of 0.515 D_w has its own r_i − D_w/2 farther out:
/// 19.25 − 0.0025 + (4.08807 − 3.969) mm.
#[test]
fn inner_groove_centres() {
    let geometry = rig_6205().geometry;
    assert!(
        (geometry.inner_centre_radius() - 19.366_57e-3).abs() < 1e-12,
        "{}",
        geometry.inner_centre_radius()
    );
}

/// Rolling surfaces pass a contact at the speed of the race seen from the cage: ω_c r_o at the outer race,
/// (Ω − ω_c) r_i at the inner one, r the race's radius at the contact, which are equal when the cage rolls.
#[test]
fn a_film_is_that_of_the_races_speed_past_the_balls() {
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
        // The cage at which both pass alike.
        let cage = shaft * inner / (inner + outer);
        let speed = cage * outer;
        assert!((speed / ((shaft - cage) * inner) - 1.0).abs() < 1e-14);
        let by_hand = BallContacts::new(bearing.hertz(), contact.clone());
        let element = BallElement::new(&bearing);
        let d = [12e-6, 0.0, if angle > 0.0 { 10e-6 } else { 0.0 }, 0.0, 0.0, 0.0];
        let rotation = Rotation { shaft_speed: shaft, cage_speed: cage, ..Rotation::default() };
        let mut loaded = 0;
        for ball in element.ball_loads(&d, &rotation).iter().filter(|ball| ball.load > 1.0) {
            for (k, race) in [Race::Inner, Race::Outer].into_iter().enumerate() {
                let expected = by_hand.at_speed(speed).film(race, ball.load);
                // Round-off of powers.
                assert!(
                    (ball.film[k] / expected - 1.0).abs() < 1e-12,
                    "{race:?}: {} {expected}",
                    ball.film[k]
                );
            }
            loaded += 1;
        }
        assert!(loaded > 0);
    }
}

/// Which balls carry less than on perfect races, when everything stands where it is.
fn on_dent(bearing: &BallBearing, rotation: &Rotation) -> Vec<bool> {
    let perfect = BallBearing { imperfections: Default::default(), ..bearing.clone() };
    let loads = |bearing: &BallBearing| BallElement::new(bearing).ball_loads(&[0.0; 6], rotation);
    loads(bearing).iter().zip(loads(&perfect)).map(|(worn, whole)| worn.load < whole.load - 1e-3).collect()
}

/// Nine preloaded balls; a dent of 1 mm begins at an angle of its surface.
fn dented(on: Surface, start: f64) -> BallBearing {
    let mut bearing = rig_6205();
    bearing.geometry.radial_clearance = -20e-6;
    let form = DefectForm::Dent { depth: Some(2e-6), shape: Shape::HalfSine };
    bearing.imperfections.defects = vec![Defect { on, row: None, start, width: 1e-3, form }];
    bearing
}

/// A dent of the inner race is where the shaft has turned it, a dent of the outer race where it was.
#[test]
fn a_dent_of_the_inner_race_turns_with_the_shaft() {
    for (on, shaft, at) in
        [(Surface::Inner, 2.0, 3.0), (Surface::Inner, -0.7, 0.3), (Surface::Outer, 2.0, 1.0)]
    {
        let bearing = dented(on, 1.0);
        // 1 mm on a race of 15.3 or 23.2 mm radius: 0.065 or 0.043 rad.
        for (off, seen) in [(0.025, true), (-0.01, false), (0.09, false)] {
            let rotation = Rotation { cage_angle: at + off, shaft_angle: shaft, ..Rotation::default() };
            let balls = on_dent(&bearing, &rotation);
            assert_eq!(balls[0], seen, "{on:?} {shaft} {off}");
            assert!(balls[1..].iter().all(|b| !b));
        }
    }
}

/// A ball rolls along the outer race by as much arc as it turns in its pocket: χ = 2 ψ r_o/D_w with r_o = ½ D_pw (1 + γ),
/// while the shaft turns by θ = 2 ψ/(1 − γ). Its dent meets the outer race once a turn, and half a turn on the inner one.
#[test]
fn a_dent_of_a_ball_comes_round_as_it_rolls() {
    let bearing = dented(Surface::Ball(0), 0.0);
    let g = &bearing.geometry;
    let gamma = g.ball_diameter / g.pitch_diameter;
    // 1 mm on a ball of 3.969 mm radius: 0.252 rad.
    for turns in [0.0, 1.0, 3.0, 20.0] {
        for (off, seen) in [(0.126, true), (-0.05, false), (0.3, false), (1.57, false)] {
            for race in [0.0, std::f64::consts::PI] {
                let spin = std::f64::consts::TAU * turns + race + off;
                let cage = spin * g.ball_diameter / (g.pitch_diameter * (1.0 + gamma));
                let rotation = Rotation {
                    cage_angle: cage,
                    shaft_angle: 2.0 * cage / (1.0 - gamma),
                    ..Rotation::default()
                };
                let balls = on_dent(&bearing, &rotation);
                assert_eq!(balls[0], seen, "{turns} turns, {race} + {off}");
                assert!(balls[1..].iter().all(|b| !b));
            }
        }
    }
}
