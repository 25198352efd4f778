//! The Sommerfeld effect: speed over motor torque, up and down.
//!
//! `cargo run --release --example sommerfeld [FOLDER]`: the rotor of `models/sommerfeld.toml`, whose control torque
//! rises and falls slowly. Speed and whirl stay at the resonance until the torque suffices for a jump.

use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::path::PathBuf;

use rotordyn::linalg::{Outside, piecewise};
use rotordyn::model::{self, LoadFactor, Options};
use rotordyn::plot::{self, Curve, Figure, Grid, GridPanel};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;

const MODEL: &str = include_str!("../../models/sommerfeld.toml");
/// Interval over which speed and whirl are averaged \[s\].
const INTERVAL: f64 = 0.5;

/// Mean torque \[N m\] and speed \[rpm\] and largest whirl radius \[mm\] of one interval.
#[derive(Clone, Copy, Default)]
struct Point {
    torque: f64,
    speed: f64,
    whirl: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "out/sommerfeld".into()));
    std::fs::create_dir_all(&folder)?;
    let model = model::load("sommerfeld.toml", MODEL, &Options::default())?.model;
    let study = model.studies.run_up.clone().ok_or("the model has no run-up study")?;
    let LoadFactor::Table(history) = model.loads.first().ok_or("the model has no motor")?.factor.clone()
    else {
        return Err("the torque of the motor does not vary over time".into());
    };
    let top = history.iter().map(|row| row[1]).fold(0.0, f64::max);
    let turn = history.iter().find(|row| row[1] == top).map_or(0.0, |row| row[0]);
    let machine = Machine::new(model)?;
    let reduction = machine.reduce(&study)?;
    let per_interval = (INTERVAL * study.sample_rate).round();

    let (mut up, mut down) = (Vec::new(), Vec::new());
    let mut point = Point::default();
    let mut sag = None;
    let report = machine.run_up(&study, &reduction, |sample| {
        let (time, speed) = (sample.state.time, sample.state.spin.speed);
        let [x, y] = [sample.channels[0], sample.channels[1]];
        let still = *sag.get_or_insert([x, y]);
        point.torque += piecewise(&history, time, Outside::Constant)[1] / per_interval;
        point.speed += speed * 30.0 / PI / per_interval;
        point.whirl = point.whirl.max(1e3 * (x - still[0]).hypot(y - still[1]));
        if (sample.index + 1) % per_interval as usize == 0 {
            if time <= turn {
                up.push(point)
            } else {
                down.push(point)
            }
            point = Point::default();
        }
        ControlFlow::Continue(())
    });
    if let End::Failed(error) = report.end {
        return Err(error.into());
    }
    for (name, branch) in [("up", &up), ("down", &down)] {
        let jump = branch.windows(2).max_by(|a, b| {
            let size = |pair: &[Point]| (pair[1].speed - pair[0].speed).abs();
            size(a).total_cmp(&size(b))
        });
        if let Some([before, after]) = jump {
            println!(
                "{name}: jump at {:.3} N m from {:.0} rpm to {:.0} rpm",
                before.torque, before.speed, after.speed
            );
        }
    }
    let e = report.energy;
    println!(
        "energy: work {:.1} J, dissipated {:.1} J, residual {:.1e} J",
        e.work,
        e.damping_loss,
        e.residual()
    );

    let curve = |branch: &[Point], y: fn(&Point) -> f64| Curve {
        x: branch.iter().map(|p| p.torque).collect(),
        y: branch.iter().map(y).collect(),
        ..Curve::default()
    };
    let panel = |name: &str, unit: &str, y: fn(&Point) -> f64| GridPanel {
        name: name.into(),
        unit: unit.into(),
        curves: vec![curve(&up, y), curve(&down, y)],
        from_zero: true,
        ..GridPanel::default()
    };
    let grid = Grid {
        title: "Sommerfeld effect of a Jeffcott rotor".into(),
        note: "control torque up and down in 100 s each, less drag".into(),
        x_name: "control torque".into(),
        x_unit: "N m".into(),
        legend: vec!["up".into(), "down".into()],
        panels: vec![panel("speed", "rpm", |p| p.speed), panel("whirl radius", "mm", |p| p.whirl)],
        columns: 2,
        mark: None,
    };
    plot::write(&Figure::Grid(grid), &[], &folder.join("sommerfeld"))?;
    println!("{}", folder.join("sommerfeld.png").display());
    Ok(())
}
