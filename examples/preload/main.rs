//! Peak-to-peak vibration over preload, after Figure 9 of Bal et al. 2022.
//!
//! `cargo run --release --example preload [FOLDER]`: the machine of `models/bal_2022.toml` starts at rest at
//! the bearing centre, at preloads from 20 to 500 N; peak-to-peak displacement of the transient and of the
//! steady state.

use std::ops::ControlFlow;
use std::path::PathBuf;

use rotordyn::model::{self, Options};
use rotordyn::plot::{self, Curve, Figure, Grid, GridPanel};
use rotordyn::study::Machine;

const MODEL: &str = include_str!("../../models/bal_2022.toml");
const PRELOADS: [f64; 6] = [20.0, 50.0, 100.0, 150.0, 200.0, 500.0];
/// Duration of the transient \[s\]; the steady motion is evaluated over the same time at the end of the run.
const TRANSIENT: f64 = 0.1;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "out/preload".into()));
    std::fs::create_dir_all(&folder)?;
    let mut found = Vec::new();
    println!("preload   transient p-p x, y, z [um]      steady p-p x, y, z [nm]");
    for preload in PRELOADS {
        let [start, steady] = peak_to_peak(preload)?;
        let [a, b, c] = start.map(|v| 1e6 * v);
        let [d, e, f] = steady.map(|v| 1e9 * v);
        println!("{preload:>5} N   {a:9.4} {b:9.4} {c:9.4}   {d:10.2e} {e:10.2e} {f:10.2e}");
        found.push([start, steady]);
    }
    let free_decay_share = |k: usize| (found[0][0][k] - found[0][1][k]) / found[0][0][k];
    let note = format!(
        "1400 rpm, film. At 20 N, {:.0} % of the transient in x and {:.0} % in y are free decay from the initial position",
        100.0 * free_decay_share(0),
        100.0 * free_decay_share(1)
    );
    println!("{note}");
    let panel = |k: usize, name: &str| GridPanel {
        name: format!("p-p in {name}"),
        unit: "µm".into(),
        log_y: true,
        curves: (0..2)
            .map(|which| Curve {
                x: PRELOADS.to_vec(),
                // Below 1e-18 m there is only round-off.
                y: found
                    .iter()
                    .map(|f| if f[which][k] > 1e-18 { 1e6 * f[which][k] } else { f64::NAN })
                    .collect(),
                ..Curve::default()
            })
            .collect(),
        ..GridPanel::default()
    };
    let grid = Grid {
        title: "Vibration over preload (after Bal et al. 2022, Figure 9)".into(),
        note,
        x_name: "preload".into(),
        x_unit: "N".into(),
        legend: vec!["transient".into(), "steady".into()],
        panels: vec![panel(0, "x"), panel(1, "y"), panel(2, "z")],
        columns: 3,
        mark: None,
    };
    plot::write(&Figure::Grid(grid), &[], &folder.join("preload_peak_to_peak"))?;
    println!("{}", folder.join("preload_peak_to_peak.png").display());
    Ok(())
}

/// Peak-to-peak displacement of the probes x, y, z over the transient and over the end of a run \[m\].
fn peak_to_peak(preload: f64) -> Result<[[f64; 3]; 2], Box<dyn std::error::Error>> {
    let options = Options {
        variant: Some(format!("preload_{preload}")),
        // A quarter of a ball pitch between the two ball sets: in phase their axial forces would cancel.
        set: vec![("bearing.B.cage_angle".into(), "-83.0769 deg".into())],
    };
    let model = model::load("bal_2022.toml", MODEL, &options)?.model;
    let study = model.studies.run_up.clone().ok_or("the model has no run-up study")?;
    let machine = Machine::new(model)?;
    let reduction = machine.reduce(&study)?;
    let duration = machine.model.profile.duration();
    let mut ranges = [[[f64::INFINITY, f64::NEG_INFINITY]; 3]; 2];
    machine.run_up(&study, &reduction, |sample| {
        let time = sample.state.time;
        for (which, within) in [time <= TRANSIENT, time >= duration - TRANSIENT].into_iter().enumerate() {
            for (range, &value) in ranges[which].iter_mut().zip(sample.channels) {
                if within {
                    *range = [range[0].min(value), range[1].max(value)];
                }
            }
        }
        ControlFlow::Continue(())
    });
    Ok(ranges.map(|window| window.map(|[low, high]| high - low)))
}
