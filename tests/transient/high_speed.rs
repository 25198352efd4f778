//! High-speed run-up on preloaded bearings with ball inertia: it completes, and its energy balance closes.

use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use std::ops::ControlFlow;

const ROTOR: &str = r#"
[model]
name = "spindle"
[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[shaft]
element_length = "40 mm"
section = [{ length = "400 mm", outer_diameter = "25 mm" }]
[station]
A = "20 mm"
disc = "200 mm"
B = "380 mm"
[disc.main]
station = "disc"
outer_diameter = "120 mm"
thickness = "10 mm"
material = "steel"
[bearing.A]
station = "A"
model = "ball"
designation = "7205C"
thrust = "+z"
INERTIA
preload = { interference = "3 um" }
[bearing.B]
station = "B"
model = "ball"
designation = "7205C"
thrust = "-z"
INERTIA
preload = { interference = "3 um" }
[unbalance.disc]
station = "disc"
magnitude = "5 g mm"
[damping.modal]
frequency = "100 Hz"
ratio = 0.01
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "ramp"
from = "0 rpm"
ramp = "0.3 s"
to = "12000 rpm"
[probe.disc_y]
at = "disc.main"
direction = "y"
[study.run_up]
step = "20 us"
sample_rate = "5 kHz"
cutoff = "2500 Hz"
"#;

#[test]
fn energy_balance_of_a_run_up_with_ball_inertia() {
    let text = ROTOR.replace("INERTIA", "ball_inertia = \"outer_race_control\"");
    let model = load("spindle.toml", &text, &Options::default())
        .map_err(|e| format!("{e:?}"))
        .expect("a valid model")
        .model;
    let machine = Machine::new(model).expect("an assembled machine");
    let study = machine.model.studies.run_up.clone().expect("a run-up study");
    let reduction = machine.reduce(&study).expect("a reduced model");
    let report = machine.run_up(&study, &reduction, |_| ControlFlow::Continue(()));
    let energy = report.energy;
    // The ball inertia alone transfers a tenth of the energy turnover into the contacts during the run-up.
    assert!(
        energy.residual().abs() < 5e-3 * energy.exchanged(),
        "{energy:?}: residual {}",
        energy.residual()
    );
    assert!(energy.contact > energy.start);
}
