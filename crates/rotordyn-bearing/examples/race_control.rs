//! Computes the table of race control in the documentation of `free_ball` again: `cargo run --release --example race_control`.
//!
//! 218 bearing under 17.8 kN of thrust over speed and friction: cage over shaft speed and pitch angle of the spin axis \[deg\], by
//! the hypotheses of race control and by traction integrated over the contact ellipse.

#[path = "../tests/free_ball/bearing_218.rs"]
mod bearing_218;
#[path = "../tests/free_ball/bearings.rs"]
#[allow(dead_code)] // the tests use the rest
mod bearings;

use bearing_218::{hypothesis, settled_with};
use rotordyn_bearing::BallInertia;
use rotordyn_bearing::free_ball::SlipModel;

const FRICTION: [f64; 4] = [0.02, 0.04, 0.06, 0.1];

fn main() {
    let columns = FRICTION.map(|friction| format!("μ = {friction}")).join(" | ");
    println!("| speed \\[rpm\\] | outer | inner | shared | {columns} |");
    println!("{}|", "|---".repeat(4 + FRICTION.len()));
    for speed in [500.0, 2000.0, 5000.0, 10_000.0] {
        let cell = |orbit: f64, axis: f64| format!("{orbit:.5}, {axis:.1}");
        let controls = [BallInertia::OuterRaceControl, BallInertia::InnerRaceControl, BallInertia::Shared];
        let mut row: Vec<String> = Vec::new();
        for control in controls {
            let [_, orbit, axis] = hypothesis(control, bearings::rpm(speed));
            row.push(cell(orbit, axis));
        }
        for friction in FRICTION {
            let found = settled_with(friction, bearings::rpm(speed), SlipModel::default(), 1e-2, 1e-6);
            row.push(cell(found[4], found[5]));
        }
        println!("| {speed:.0} | {} |", row.join(" | "));
    }
}
