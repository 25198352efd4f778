//! Tacho pulses (one per revolution) of a measured run-up as speed profile of a simulated one.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use rotordyn::io::budget::Limits;
use rotordyn::io::external_file;
use rotordyn::model::{Model, Options, load_with};
use rotordyn::results::History;
use rotordyn::signal::WindowKind;
use rotordyn::signal::order::{OrderSettings, OrderTracker};
use rotordyn::signal::segment::Level;
use rotordyn::signal::spectrum::amplitude_spectrum;
use rotordyn::signal::tacho::PulseTrain;
use rotordyn::study::{Machine, Recorder};

use crate::measured_data::measured;

/// A rigid rotor with unbalance on a 6205 with an outer race dent, over two seconds of the measured ramp.
const MACHINE: &str = r#"[model]
name = "run_up"

[rotor]
centre = "0 m"
mass = "5 kg"
polar_inertia = "1e-2 kg m^2"
diametral_inertia = "1e-2 kg m^2"

[station]
C = "0 m"

[joint.plane]
between = ["rotor", "ground"]
constrain = ["z", "tx", "ty"]

[bushing.seal]
between = ["rotor", "ground"]
c_x = "300 N s/m"
c_y = "300 N s/m"

[bearing.C]
station = "C"
model = "ball"
designation = "6205"
radial_clearance = "4 um"

[[bearing.C.defect]]
kind = "dent"
on = "outer"
centre = "-90 deg"
width = "0.6 mm"
depth = "4 um"

[unbalance.rotor]
station = "C"
magnitude = "300 g mm"

[probe.x]
at = "rotor"
direction = "x"

[probe.y_acceleration]
at = "rotor"
direction = "y"
quantity = "acceleration"

[speed]
profile = "measured"
file = "time_s.csv"
smoothing = 4
from = "3.5 s"
to = "5.5 s"

[study.run_up]
integrator = "newmark"
step = "40 us"
sample_rate = "8 kHz"
"#;

const FROM: f64 = 3.5;

fn machine(set: &[(&str, &str)]) -> Option<Model> {
    let file = measured("tacho_run_up/time_s.csv")?;
    let files = [external_file::read_external_file(file.parent()?, "time_s.csv", &Limits::default())];
    let set = set.iter().map(|(path, value)| ((*path).to_string(), (*value).to_string())).collect();
    let options = Options { set, ..Options::default() };
    let loaded = load_with("run_up.toml", MACHINE, &options, &files).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(loaded.warnings, []);
    Some(loaded.model)
}

/// Pulse times of the record, and its speeds after each interval \[rpm\].
fn record() -> Option<(Vec<f64>, Vec<f64>)> {
    let read = |name: &str| -> Option<Vec<f64>> {
        let text = std::fs::read_to_string(measured(&format!("tacho_run_up/{name}"))?).unwrap();
        Some(text.lines().map(|line| line.trim().parse().unwrap()).collect())
    };
    Some((read("time_s.csv")?, read("speed_rpm.csv")?))
}

/// The whole record: speed between pulses is 60 over the interval, equal to the record's speed column, and without
/// smoothing the shaft angle is a whole revolution at every pulse.
#[test]
fn tacho_pulses_define_the_speed_profile() {
    let Some((times, rpm)) = record() else { return };
    let remove = [("speed.from", "0 s"), ("speed.to", "100 s")];
    let Some(plain) = machine(&[&remove[..], &[("speed.smoothing", "0")]].concat()) else { return };
    assert!((plain.profile.duration() - (times[488] - times[0])).abs() < 1e-9);
    let curve = plain.profile.curve();
    for (k, t) in times.iter().enumerate() {
        let turns = curve.at(t - times[0]).angle / TAU;
        assert!((turns - k as f64).abs() < 1e-9, "pulse {k}: {turns}");
    }
    for k in 1..times.len() {
        let [a, b] = [times[k - 1], times[k]].map(|t| curve.at(t - times[0]).angle);
        assert!(((b - a) / (times[k] - times[k - 1]) * 60.0 / TAU / rpm[k] - 1.0).abs() < 1e-9);
    }
    // Smoothed, on the ramp: deviations from the pulses of about twice the record's time resolution of 1/25600 s at
    // 3000 rpm, 0.002 revolutions (0.0045 by the same cubics in numpy); the acceleration is that of the ramp, without
    // the resolution's noise (107 instead of 356 rad/s² there).
    let smooth = machine(&remove).unwrap();
    let curve = smooth.profile.curve();
    let mut worst = 0.0f64;
    for (k, t) in times.iter().enumerate().skip(10).take(210) {
        worst = worst.max((curve.at(t - times[0]).angle / TAU - k as f64).abs());
    }
    println!("smoothed: at most {worst:.5} turns off the pulses");
    assert!(worst < 0.006, "{worst}");
    let acceleration = |model: &Model| {
        let curve = model.profile.curve();
        (0..4000)
            .map(|k| curve.at(4.2 - times[0] + f64::from(k) * 2.5e-4).acceleration.abs())
            .fold(0.0, f64::max)
    };
    let [rough, fine] = [acceleration(&plain), acceleration(&smooth)];
    println!("acceleration up to {rough:.0} rad/s² through the pulses, {fine:.0} rad/s² smoothed");
    // The measured speed increases by 1428 rpm/s at most, 150 rad/s².
    assert!(fine < 150.0 && rough > fine, "{rough} {fine}");
}

fn run(model: Model) -> History {
    let machine = Machine::new(model).unwrap();
    let study = machine.model.studies.run_up.clone().unwrap();
    let reduction = machine.reduce(&study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let report = machine.run_up(&study, &reduction, |sample| {
        recorder.record(sample);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, rotordyn::transient::run::End::Complete);
    recorder.into_history()
}

/// Half-energy bandwidth: width of the fewest bins that contain half of the energy within ±`reach` (relative) of
/// `place`, divided by `place`; position and amplitude of the largest of them.
///
/// Half, because a third of the dent's energy near BPFO is background outside the line.
fn half_energy_bandwidth(axis: &[f64], amplitude: &[f64], place: f64, reach: f64) -> (f64, f64, f64) {
    let band: Vec<(f64, f64)> = axis
        .iter()
        .zip(amplitude)
        .filter(|(f, _)| ((1.0 - reach) * place..(1.0 + reach) * place).contains(*f))
        .map(|(f, a)| (*f, a * a))
        .collect();
    let total: f64 = band.iter().map(|b| b.1).sum();
    let mut sorted = band.clone();
    sorted.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut energy = 0.0;
    let bins = sorted.iter().take_while(|b| {
        let more = energy < 0.5 * total;
        energy += b.1;
        more
    });
    (bins.count() as f64 * (axis[1] - axis[0]) / place, sorted[0].0, sorted[0].1.sqrt())
}

/// In Hz the lines are smeared by the speed change of two seconds; resampled over the tacho angle they are sharp.
#[test]
fn angle_resampling_sharpens_the_lines() {
    let (Some(model), Some((times, _))) = (machine(&[]), record()) else { return };
    let bpfo = {
        let ball = model.bearings[0].bearing.ball().unwrap();
        ball.geometry.characteristic_orders(0.0).bpfo
    };
    let history = run(model);
    let rate = history.sample_rate;
    let rpm = history.speed.ends().unwrap().unwrap().map(|w| w * 60.0 / TAU);
    println!("{:.0} to {:.0} rpm, BPFO {bpfo:.4}", rpm[0], rpm[1]);
    assert!(rpm[0] < 1500.0 && rpm[1] > 2050.0, "{rpm:?}");
    // The angle as for a measured record: from the tacho pulses, not from the simulation.
    let pulses: Vec<f64> = times.iter().map(|t| t - FROM).filter(|t| (-0.1..2.1).contains(t)).collect();
    let train = PulseTrain::new(&pulses, 1).unwrap().smoothed(4).unwrap();
    let (theta, first) = train.angle(rate, history.time.len()).unwrap();
    let tracker = OrderTracker::new(&theta, rate, OrderSettings::new(0.05, 12.0)).unwrap();
    let turns = (theta[theta.len() - 1] - theta[0]) / TAU;
    let mean_hz = turns * rate / (theta.len() - 1) as f64;
    // The band around BPFO excludes 3x and 4x.
    for (channel, order, reach, sharp) in [("x", 1.0, 0.4, 0.03), ("y_acceleration", bpfo, 0.1, 0.01)] {
        let values = history.channel(channel).unwrap().values.in_memory().unwrap();
        let values = &values[first..first + theta.len()];
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let values: Vec<f64> = values.iter().map(|v| v - mean).collect();
        let spectrum = amplitude_spectrum(&values, rate, WindowKind::Hann, Level::Peak).unwrap();
        let (smeared, _, low) =
            half_energy_bandwidth(&spectrum.frequencies, &spectrum.values, order * mean_hz, reach);
        let angle = &tracker.resample(&[&values]).unwrap()[0].parts[0];
        let per_turn = (angle.len() as f64 / turns).round();
        let spectrum = amplitude_spectrum(angle, per_turn, WindowKind::Hann, Level::Peak).unwrap();
        let (width, place, high) =
            half_energy_bandwidth(&spectrum.frequencies, &spectrum.values, order, reach);
        println!(
            "{channel}: order {place:.4}, {width:.4} wide, {high:.2e}; in Hz {smeared:.4} wide, {low:.2e}"
        );
        // With a Hann window over some seventy revolutions the fewest bins are one or two, 0.014 orders each.
        assert!(width < sharp && smeared > 4.0 * width, "{channel}: {width} {smeared}");
        assert!(high > 2.0 * low, "{channel}: {high} {low}");
        assert!((place / order - 1.0).abs() < 0.02, "{channel}: {place} of {order}");
    }
}
