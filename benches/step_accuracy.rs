//! Accuracy of order cuts against computing time: the rig's run-up with each integrator and step.
//!
//! `cargo bench --bench step_accuracy` prints a table and writes `benches/step_accuracy.json`, from which the book draws its
//! figure. The error of a cut is the RMS difference of its amplitude over the run from that with Newmark's method at 6.25 us,
//! over the RMS of the latter; the worst of the seven cuts at housing B counts. Times are CPU time of one core,
//! without output.

use std::fmt::Write as _;
use std::ops::ControlFlow;

use rotordyn::model::study::{Integrator, RunUpStudy};
use rotordyn::study::{Machine, Recorder};
use rustix::time::{ClockId, clock_gettime};

#[path = "common/rig.rs"]
mod rig;
use rig::rig;

const CHANNEL: &str = "B_ax";
const REFERENCE: f64 = 6.25e-6;
const VARIANTS: [Option<&str>; 2] = [None, Some("wavy")];
const ALPHA: Integrator = Integrator::GeneralisedAlpha { rho_infinity: 0.8 };
/// Integrators with their steps \[us\].
const CASES: [(&str, Integrator, &[f64]); 4] = [
    (
        "fitted-newmark",
        Integrator::FittedNewmark,
        &[12.5, 25.0, 50.0, 62.5, 83.333_333_333_333_33, 125.0, 250.0],
    ),
    ("newmark", Integrator::Newmark, &[12.5, 25.0, 50.0, 62.5, 83.333_333_333_333_33, 125.0]),
    ("generalised-alpha", ALPHA, &[12.5, 25.0, 50.0, 62.5, 83.333_333_333_333_33, 125.0]),
    ("rk4", Integrator::RungeKutta4, &[6.25, 10.0, 12.5]),
];

/// RMS amplitudes of every cut, and the CPU time of the run \[s\].
struct Cuts {
    labels: Vec<String>,
    rms: Vec<Vec<f64>>,
    seconds: f64,
}

fn main() {
    // Cargo's test runner passes --test to benches.
    if std::env::args().any(|argument| argument == "--test") {
        return;
    }
    let mut points = Vec::new();
    for variant in VARIANTS {
        let machine = rig(variant);
        let variant = variant.unwrap_or("perfect");
        let reference = cuts(&machine, Integrator::Newmark, REFERENCE).expect("the reference run ends");
        println!("\n{variant}: Newmark at 6.25 us takes {:.2} s; error of the cuts in %", reference.seconds);
        println!(
            "{:20} {:>8} {:>8} {:>8}  {}",
            "integrator",
            "step us",
            "CPU s",
            "worst",
            reference.labels.join("  ")
        );
        for (name, integrator, steps) in CASES {
            for &step in steps {
                let Some(found) = cuts(&machine, integrator, 1e-6 * step) else {
                    println!("{name:20} {step:8.2}  does not end");
                    continue;
                };
                let errors = found.errors(&reference);
                let worst = errors.iter().copied().fold(0.0, f64::max);
                let all: Vec<String> = errors.iter().map(|error| format!("{:.3}", 100.0 * error)).collect();
                println!(
                    "{name:20} {step:8.2} {:8.2} {:8.3}  {}",
                    found.seconds,
                    100.0 * worst,
                    all.join("  ")
                );
                points.push(serde_json::json!({
                    "variant": variant, "integrator": name, "step_us": rounded(step, 4),
                    "cpu_s": rounded(found.seconds, 3), "worst_error": rounded(worst, 3),
                }));
            }
        }
    }
    let mut text = String::from("[\n");
    for (k, point) in points.iter().enumerate() {
        let _ = writeln!(text, " {point}{}", if k + 1 < points.len() { "," } else { "" });
    }
    text += "]\n";
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/step_accuracy.json");
    std::fs::write(path, text).expect("the folder of this file can be written");
}

/// Order cuts of a run; `None` if it does not end, as an explicit one with too long a step.
fn cuts(machine: &Machine, integrator: Integrator, step: f64) -> Option<Cuts> {
    let studies = &machine.model.studies;
    let study: RunUpStudy = studies.run_up.clone().expect("the rig has a run-up");
    let study = RunUpStudy { integrator, step, ..study };
    let orders = studies.orders.clone().expect("the rig has order cuts");
    let reduction = machine.reduce(&study).expect("the rig has modes");
    let recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let mut recorder = recorder.with_channels(|channel| channel.name == CHANNEL);
    let start = cpu_seconds();
    let report = machine.run_up(&study, &reduction, |sample| {
        recorder.record(sample);
        ControlFlow::Continue(())
    });
    let seconds = cpu_seconds() - start;
    if report.end != rotordyn::transient::run::End::Complete {
        return None;
    }
    let found = machine.orders(&orders, &recorder.into_history()).ok()?;
    let (labels, rms) =
        found.first()?.cuts.iter().map(|(line, cut)| (line.label.clone(), cut.rms.clone())).unzip();
    Some(Cuts { labels, rms, seconds })
}

impl Cuts {
    /// RMS difference of each cut over the RMS of the reference.
    fn errors(&self, reference: &Cuts) -> Vec<f64> {
        let square = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>();
        let one = |(own, exact): (&Vec<f64>, &Vec<f64>)| {
            let difference = square(&mut own.iter().zip(exact).map(|(a, b)| a - b));
            (difference / square(&mut exact.iter().copied())).sqrt()
        };
        self.rms.iter().zip(&reference.rms).map(one).collect()
    }
}

fn cpu_seconds() -> f64 {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// A number with so many digits.
fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}
