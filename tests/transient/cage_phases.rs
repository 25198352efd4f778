//! Step and cage phase of a run-up: the step used, its estimated error against the true one, levels over the phase.

use std::ops::ControlFlow;

use rotordyn::model::{Options, load};
use rotordyn::results::{History, StepError};
use rotordyn::study::{Checkpoints, Machine, Recorder};
use rotordyn::transient::run::{End, Report};

/// A rigid rotor with a little unbalance on two deep groove ball bearings.
const TWO_BEARINGS: &str = r#"
[model]
name = "two_bearings"

[material.steel]
young = "210 GPa"
poisson = 0.3
density = "7850 kg/m^3"

[rotor]
centre = "0 m"
mass = "6 kg"
polar_inertia = "0.02 kg m^2"
diametral_inertia = "0.08 kg m^2"

[station]
A = "-0.15 m"
C = "0 m"
B = "0.1 m"

[bearing.A]
station = "A"
model = "ball"
designation = "6205"
material = "steel"
radial_clearance = "8 um"
contact_damping = "300 N s/m"
damping_ramp = "1 um"

[bearing.B]
station = "B"
model = "ball"
designation = "6204"
material = "steel"
radial_clearance = "8 um"
contact_damping = "300 N s/m"
damping_ramp = "1 um"

[unbalance.u]
station = "C"
magnitude = "20 g mm"

[drive]
kind = "prescribed"
station = "A"

[speed]
profile = "ramp"
settle = "0.2 s"
ramp = "3 s"
hold = "0.5 s"
to = "1500 rpm"

[probe.C_y]
at = "station.C"
direction = "y"

[probe.A_x]
at = "station.A"
direction = "x"
quantity = "velocity"

[study.run_up]
step = "100 us"
sample_rate = "3 kHz"

[study.orders]
resolution = 0.25
max_order = 12
cuts = [1, "A.BPFO", "B.BPFO"]
"#;

fn machine(text: &str, set: &[(&str, &str)]) -> Machine {
    let set = set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
    let loaded = load("cages.toml", text, &Options { variant: None, set });
    Machine::new(loaded.unwrap_or_else(|errors| panic!("{errors:?}")).model).unwrap()
}

fn run(machine: &Machine) -> (History, Report, Option<StepError>) {
    let study = machine.model.studies.run_up.clone().unwrap();
    let reduction = machine.reduce(&study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let mut checkpoints = Checkpoints::new(&study, machine.model.profile.duration());
    let report = machine.run_up(&study, &reduction, |sample| {
        recorder.record(sample);
        checkpoints.observe(sample);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    let history = recorder.into_history();
    let orders = machine.checked_orders();
    let error = machine.step_error(&study, &reduction, &orders, (&checkpoints, &history, &report)).unwrap();
    (history, report, error)
}

#[test]
fn step_divides_the_sampling_interval_and_is_reported() {
    let (_, report, error) = run(&machine(TWO_BEARINGS, &[("speed.ramp", "0.5 s")]));
    // 1/3 ms in four steps.
    assert!((report.step.unwrap() - 1.0 / 12e3).abs() < 1e-15, "{report:?}");
    let error = error.expect("the run is long enough");
    assert!(error.cost < 0.1 && error.steps > 0, "{error:?}");
    let (_, report, error) = run(&machine(
        TWO_BEARINGS,
        &[("speed.ramp", "0.1 s"), ("speed.hold", "0.1 s"), ("study.run_up.integrator", "dormand-prince")],
    ));
    assert_eq!((report.step, error), (None, None));
}

/// The estimate from a stretch against the difference to a run with an eighth of the step.
#[test]
fn estimated_step_error_is_that_of_a_run_with_a_much_smaller_step() {
    const JEFFCOTT: &str = include_str!("../../models/jeffcott.toml");
    let jeffcott = |step: &str| {
        let set = [("study.run_up.step", step), ("unbalance.disc.grade", "G2.5"), ("speed.ramp", "12 s")];
        machine(JEFFCOTT, &set)
    };
    for (coarse, fine) in [("1 ms", "125 us"), ("500 us", "62.5 us")] {
        let (_, _, estimate) = run(&jeffcott(coarse));
        let (_, _, reference) = run(&jeffcott(fine));
        let (estimate, reference) = (estimate.unwrap(), reference.unwrap());
        println!("{coarse}: {estimate:?}\n{fine}: {reference:?}");
        assert_eq!(estimate.stretch, reference.stretch);
        for line in estimate.lines.iter().filter(|l| l.channel.starts_with("disc")) {
            let other = reference.lines.iter().find(|l| l.channel == line.channel && l.line == line.line);
            let truth = line.level / other.unwrap().level - 1.0;
            println!("{coarse} {} {}: {:.3e} of {truth:.3e}", line.channel, line.line.label, line.error);
            assert!((line.error / truth - 1.0).abs() < 0.1, "{} of {truth}", line.error);
        }
    }
}

/// Levels of two runs that differ by rounding of an angle: the cuts follow the cage, whose turns the Newton iteration of the
/// steps knows to about 1e-10.
const SAME: f64 = 1e-8;

#[test]
fn ball_pass_levels_range_over_the_phase_between_the_cages() {
    let own = machine(TWO_BEARINGS, &[("study.run_up.cage_phases", "4")]);
    let orders = own.model.studies.orders.clone().unwrap();
    let base = own.orders(&orders, &run(&own).0).unwrap();
    let study = own.model.studies.run_up.clone().unwrap();
    let carry_on = || ControlFlow::Continue(());
    let band = own.cage_phase_band(&study, &orders, &base, &carry_on).unwrap().unwrap();
    assert_eq!(band.bearings, ["B"]);
    let pitch = std::f64::consts::TAU / own.model.bearings[1].bearing.ball().unwrap().geometry.balls as f64;
    let angles: Vec<f64> = band.angles.iter().map(|a| a[0] / pitch).collect();
    assert!(angles.iter().zip([0.0, 0.25, 0.5, 0.75]).all(|(a, b)| (a - b).abs() < 1e-12), "{angles:?}");

    // The third run is that of a model with this cage angle.
    let degrees = format!("{} deg", (0.5 * pitch).to_degrees());
    let turned = machine(TWO_BEARINGS, &[("bearing.B.cage_angle", &degrees)]);
    let alone = turned.orders(&orders, &run(&turned).0).unwrap();
    for (channel, (result, base)) in band.channels.iter().zip(alone.iter().zip(&base)) {
        for (line, (cut, own)) in channel.lines.iter().zip(result.cuts.iter().zip(&base.cuts)) {
            println!("{} {}: {:?}", channel.channel, line.line.label, line.peaks);
            let peak = cut.1.rms.iter().copied().fold(0.0, f64::max);
            assert!((line.peaks[2] / peak - 1.0).abs() < SAME, "{} {peak}", line.peaks[2]);
            for (k, level) in own.1.rms.iter().chain(&cut.1.rms).enumerate() {
                let at = k % line.minimum.len();
                assert!(
                    (line.minimum[at]..=line.maximum[at] * (1.0 + 2.0 * SAME))
                        .contains(&(level * (1.0 + SAME)))
                );
            }
        }
    }
    // The runs differ.
    let peaks = &band.channels[0].lines[2].peaks;
    assert!(peaks[1..].iter().all(|peak| (peak / peaks[0] - 1.0).abs() > 1e-4), "{peaks:?}");
}
