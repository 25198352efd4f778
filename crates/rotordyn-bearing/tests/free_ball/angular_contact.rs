//! 218 angular contact bearing under 17.8 kN of thrust: contact angles, loads, cage speed, spin axis.

use crate::bearing_218::{hypothesis, settled_with};
use crate::bearings::rpm;
use rotordyn_bearing::BallInertia;
use rotordyn_bearing::free_ball::SlipModel;

/// Contact angles \[deg\], loads \[N\], cage over shaft speed and pitch angle \[deg\], once they are steady.
fn settled(speed: f64, slip: SlipModel, slip_speed: f64) -> [f64; 6] {
    settled_with(0.06, speed, slip, slip_speed, 2e-6)
}

/// Figures of a second engine: contact angles, loads, cage speed, spin axis; slip integrated over the ellipse.
const FIGURES: [(f64, [f64; 6]); 3] = [
    (500.0, [41.514, 41.481, 1678.2, 1679.3, 0.43374, 42.4]),
    (2000.0, [41.761, 41.227, 1666.5, 1684.0, 0.43357, 42.0]),
    (10_000.0, [48.89, 32.81, 1441.4, 1890.0, 0.44589, 31.06]),
];

/// Loads within 0.5 %, angles 0.2 deg, cage speed 0.1 %, spin axis 0.5 deg of the figures.
#[test]
fn bearing_218_settles_between_the_control_hypotheses() {
    for (speed, figures) in FIGURES {
        let found = settled(rpm(speed), SlipModel::default(), 1e-2);
        println!("{speed} rpm: {found:.5?}\n   figures {figures:.5?}");
        let allowed = [0.2, 0.2, 5e-3 * figures[2], 5e-3 * figures[3], 1e-3 * figures[4], 0.5];
        for k in 0..6 {
            assert!((found[k] - figures[k]).abs() < allowed[k], "{k}: {} {}", found[k], figures[k]);
        }
    }
}

/// Twice the points of the quadrature in each direction change spin axis and cage speed by less than 0.1 deg and 1e-4.
#[test]
fn quadrature_over_the_ellipse_has_converged() {
    for speed in [2000.0, 10_000.0] {
        let coarse = settled(rpm(speed), SlipModel::default(), 1e-2);
        let fine = settled(rpm(speed), SlipModel::Ellipse { along: 8, across: 24 }, 1e-2);
        println!("{speed} rpm: {coarse:.5?} {fine:.5?}");
        assert!((coarse[5] - fine[5]).abs() < 0.1 && (coarse[4] / fine[4] - 1.0).abs() < 1e-4);
    }
}

/// Slip at the contact's centre has no pivot moment: the gyroscopic moment alone turns the spin axis, to that of the
/// bearing, and the orbit is 11 % off.
#[test]
fn slip_at_the_centre_gives_a_wrong_attitude() {
    let found = settled(rpm(10_000.0), SlipModel::Centre, 0.3);
    let figures = FIGURES[2].1;
    println!("slip at the centre: {found:.5?}, over the ellipse {figures:.5?}");
    assert!(found[5].abs() < 1.0 && (found[4] / figures[4] - 1.0).abs() > 0.1);
}

/// Pitch angles of the spin axis in the table of race control (documentation of the study of free balls), which
/// `examples/race_control.rs` computes.
#[test]
fn control_hypotheses_are_off_by_speed_and_friction() {
    let [outer_load, orbit, axis] = hypothesis(BallInertia::OuterRaceControl, rpm(10_000.0));
    println!("outer race control at 10000 rpm: {outer_load:.1} N, {orbit:.5}, {axis:.2} deg");
    // Jones' outer control of the second engine.
    for (found, figure) in [(outer_load, 1922.0), (orbit, 0.45490), (axis, 26.7)] {
        assert!((found / figure - 1.0).abs() < 5e-3);
    }
    let table =
        [(500.0, [35.6, 49.2], [42.3, 42.3, 42.3], 0.1), (10_000.0, [26.7, 52.4], [5.0, 30.9, 30.1], 0.2)];
    for (speed, controls, axes, tolerance) in table {
        for (inertia, figure) in
            [BallInertia::OuterRaceControl, BallInertia::InnerRaceControl].into_iter().zip(controls)
        {
            assert!((hypothesis(inertia, rpm(speed))[2] - figure).abs() < 0.1);
        }
        for (friction, figure) in [0.02, 0.06, 0.12].into_iter().zip(axes) {
            let found = settled_with(friction, rpm(speed), SlipModel::default(), 1e-2, 1e-6);
            println!("{speed} rpm, friction {friction}: {found:.5?}");
            assert!((found[5] - figure).abs() < tolerance, "{}", found[5]);
        }
    }
}
