//! Forces of single mechanisms against their closed forms: spin moment, traction curve, film, rolling resistance, drag.

use crate::bearings::{ball_bearing, free, geometry_6205, off, rings, rpm};
use rotordyn_bearing::contact::{FilmFormula, Lubricant};
use rotordyn_bearing::free_ball::{
    BallBody, BallReport, Drag, FilmShear, FreeBallBearing, FreeBallState, FreeBalls, FrictionLaw, Loss,
    RingState, SlipModel, TractionCurve,
};

type V = nalgebra::Vector3<f64>;

const STILL: fn() -> [RingState; 2] = Default::default;

/// One ball pressed 1 μm into the outer race at x = r, moving and rotating as given; its report and lost powers.
fn on_outer_race(bearing: FreeBallBearing, velocity: V, rotation: V) -> (BallReport, Vec<f64>) {
    let g = bearing.ball.geometry.clone();
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let position = V::new(0.5 * g.pitch_diameter + 0.25 * g.radial_clearance + 1e-6, 0.0, 0.0);
    let state = FreeBallState::new(&[BallBody { position, velocity, rotation }], None);
    let report = balls.report(&state, &STILL()).remove(0);
    (report, balls.forces(&state, &STILL()).losses.to_vec())
}

fn with_law(friction: FrictionLaw, slip: SlipModel) -> FreeBallBearing {
    let bearing = free(ball_bearing(geometry_6205(1, 1e-3)), 0.1, 1e-3, slip);
    FreeBallBearing { friction, ..bearing }
}

/// A ball that spins about the contact normal loses M ω with M = (3/8) μ Q a E, E the complete elliptic integral of the
/// second kind (Harris, Rolling Bearing Analysis, ch. 8).
#[test]
fn spin_moment_is_that_of_the_contact_ellipse() {
    let slip = SlipModel::Ellipse { along: 24, across: 48 };
    let bearing = free(ball_bearing(geometry_6205(1, 1e-3)), 0.1, 1e-6, slip);
    let contact = bearing.ball.hertz().outer;
    let (report, losses) = on_outer_race(bearing, V::zeros(), V::new(30.0, 0.0, 0.0));
    let race = report.races[1].unwrap();
    let moment = 0.375 * 0.1 * race.load * race.semi_axes[1] * contact.integrals[1];
    println!("spin moment {:.6e} N m, closed form {moment:.6e}", losses[1] / 30.0);
    assert!(off(losses[1] / 30.0, moment) < 2e-3);
    assert!(race.friction.norm() < 1e-12 * race.load);
}

/// Traction over load is (A + B v) e^{−C v} + D with A = −D, its slope at rest B + C D.
#[test]
fn traction_curve_is_followed() {
    let law = TractionCurve { limit: 0.04, slope: 0.3, decay: 2.5 };
    for v in [1e-6, 0.1, 0.5, 3.0] {
        let bearing = with_law(FrictionLaw::Curve(law), SlipModel::Centre);
        let (report, losses) = on_outer_race(bearing, V::new(0.0, 0.0, v), V::zeros());
        let race = report.races[1].unwrap();
        let expected = (0.3 * v - 0.04) * f64::exp(-2.5 * v) + 0.04;
        assert!(off(-race.friction.z / race.load, expected) < 1e-9);
        assert!(off(losses[1], race.load * expected * v) < 1e-9);
        if v < 1e-5 {
            assert!(off(expected, v * (0.3 + 2.5 * 0.04)) < 1e-5);
        }
    }
    let balls = FreeBalls::new(with_law(FrictionLaw::Curve(law), SlipModel::Centre), 0.0).unwrap();
    let step = 2.785 * balls.ball_inertia(0)[0] / (3.5 * 10.0 * (0.3 + 2.5 * 0.04));
    assert!(off(balls.stable_friction_step(10.0, 1), step) < 1e-3);
}

/// The film shears by τ_E asinh(η(p) v/(h τ_E)), below Λ p; without entrainment it is friction with Λ and v₀.
#[test]
fn film_shears_between_newtonian_flow_and_its_limit() {
    let lubricant = Lubricant::grade("ISO VG 68", 330.0).unwrap();
    let law = FilmShear { lubricant: lubricant.clone(), eyring_stress: 5e6, limit: 0.08, slip_speed: 1e-2 };
    let bearing = || with_law(FrictionLaw::Film(law.clone()), SlipModel::Centre);
    let film = FilmFormula::new(&bearing().ball.hertz().outer, &lubricant);
    let radius = 0.5 * 7.938e-3;
    for slip in [1e-5, 1e-3, 1.0] {
        // Rolling at 5 m/s with a slip across: both surfaces move at −5 m/s through the contact.
        let (report, _) =
            on_outer_race(bearing(), V::new(0.0, 5.0, slip), V::new(0.0, 0.0, -5.0 / (radius - 0.5e-6)));
        let race = report.races[1].unwrap();
        let orbit = 5.0 * (1.0 + (radius - 0.5e-6) / (19.5e-3 + 1e-6));
        let thickness = film.central(orbit, race.load);
        let pressure = race.load / (std::f64::consts::PI * race.semi_axes[0] * race.semi_axes[1]);
        let viscosity = lubricant.viscosity * lubricant.viscosity_ratio(pressure);
        let stress = 5e6 * (viscosity * slip / (thickness * 5e6)).asinh();
        let limit = 0.08 * pressure;
        let expected = stress / (1.0 + (stress / limit).powi(2)).sqrt() / pressure;
        println!(
            "slip {slip:e} m/s: traction {:.5e}, closed form {expected:.5e}, film {:.3e} m, {:.2e} Pa",
            -race.friction.z / race.load,
            thickness,
            pressure
        );
        assert!(off(-race.friction.z / race.load, expected) < 2e-4);
    }
    let (report, _) = on_outer_race(bearing(), V::new(0.0, 0.0, 1e-5), V::zeros());
    let race = report.races[1].unwrap();
    assert!(off(-race.friction.z / race.load, 0.08 * 1e-3) < 1e-3);
}

/// M = (3/16) · loss factor · Q b at each race, against the rolling.
#[test]
fn rolling_resistance_takes_its_power() {
    let mut bearing = free(ball_bearing(geometry_6205(1, -4e-6)), 0.1, 1e-5, SlipModel::Centre);
    bearing.rolling_loss = 0.02;
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let ring = rings(rpm(1200.0), 0.0);
    let state = balls.initial_state(&ring).unwrap();
    let report = &balls.report(&state, &ring)[0];
    let power = |race: &rotordyn_bearing::free_ball::RaceContactReport| {
        3.0 / 16.0 * 0.02 * race.load * race.semi_axes[0] * race.rolling.abs()
    };
    let expected: f64 = report.races.iter().flatten().map(power).sum();
    let found = balls.forces(&state, &ring).losses[Loss::RollingResistance as usize];
    println!("rolling resistance {found:.4e} W, closed form {expected:.4e} W");
    assert!(off(found, expected) < 1e-6);
}

/// A ball that slides freely along the groove slows down by drag, v = v₀/(1 + k v₀ t), k = ½ ρ C_d π r²/m; its spin by
/// ω = ω₀/(1 + k ω₀ t), k = ½ ρ C_n r⁵/I; the outer ring takes both.
#[test]
fn drag_slows_a_free_ball() {
    let mut bearing = free(ball_bearing(geometry_6205(1, 1e-3)), 0.0, 1e-3, SlipModel::Centre);
    bearing.drag = Drag { density: 80.0, ball_force: 1.2, ball_moment: 0.08, cage_moment: 0.0 };
    let balls = FreeBalls::new(bearing, 0.0).unwrap();
    let ring = STILL();
    let mut state = balls.initial_state(&rings(rpm(6000.0), 0.0)).unwrap();
    let (start, spin) = (state.ball(0).velocity.norm(), state.ball(0).rotation.norm());
    let duration = 0.3;
    balls.advance(&mut state, [&ring; 2], duration, 2e-6).unwrap();
    let r = 0.5 * 7.938e-3;
    let [mass, inertia] = balls.ball_inertia(0);
    let k = 0.5 * 80.0 * 1.2 * std::f64::consts::PI * r * r / mass;
    let turning = 0.5 * 80.0 * 0.08 * r.powi(5) / inertia;
    let expected = [start / (1.0 + k * start * duration), spin / (1.0 + turning * spin * duration)];
    let found = [state.ball(0).velocity.norm(), state.ball(0).rotation.norm()];
    println!("speeds {found:.6?}, closed form {expected:.6?} from {start:.3}, {spin:.3}");
    // The orbit's radius changes with the centrifugal load by some 1e-5 of it.
    assert!(off(found[0], expected[0]) < 5e-5 && off(found[1], expected[1]) < 1e-9);
    assert!(expected[0] < 0.9 * start);
}
