//! Figures of a bearing with free balls: cage speed, spin axes, orbit of the cage, skidding map.

use super::{Named, TO_RPM};
use crate::{Curve, Figure, HeatMap, Lines, Orbit, Orbits};
use rotordyn_core::results::{FreeBallResult, SkiddingMap};

/// All figures of one bearing; `title` is that of the model file.
pub fn figures(found: &FreeBallResult, title: &str) -> Vec<Named> {
    let name = |what: &str| format!("bearing_{}_{what}", found.name);
    let [x, y, z] = found.load.map(|f| (10.0 * f).round() / 10.0 + 0.0);
    let note = format!(
        "{:.0} rpm, load {x}, {y}, {z} N: slip {:.3} %, BPFO {:.5} of {:.5} kinematic ({title})",
        found.speed * TO_RPM,
        100.0 * found.slip,
        found.comparison.bpfo,
        found.comparison.kinematic.bpfo
    );
    let over_time = |what: &str, y_name: &str, y_unit: &str, curves| Lines {
        title: format!("{what} of bearing {}", found.name),
        note: note.clone(),
        x_name: "time".into(),
        x_unit: "s".into(),
        y_name: y_name.into(),
        y_unit: y_unit.into(),
        curves,
        ..Lines::default()
    };
    let record = &found.record;
    let turns = |k: usize| found.turns.iter().map(|turn| turn[k]).collect::<Vec<_>>();
    let curve =
        |label: &str, x: &[f64], y: Vec<f64>| Curve { label: label.into(), x: x.to_vec(), y, points: false };
    let speed = vec![curve("mean of each turn of the kinematic cage", &turns(0), turns(1))];
    let balls = found.balls.len();
    let axes = (0..balls).map(|j| {
        let angles = record.pitch_angles.iter().skip(j).step_by(balls);
        curve(&format!("ball {}", j + 1), &record.time, angles.map(|angle| angle.to_degrees()).collect())
    });
    let mut out = vec![
        (name("cage_speed"), Figure::Lines(over_time("Cage speed", "cage speed over kinematic", "1", speed))),
        (
            name("spin_axes"),
            Figure::Lines(over_time("Spin axes of the balls", "pitch angle", "°", axes.collect())),
        ),
    ];
    if !record.cage_x.is_empty() {
        let orbit = Orbit { x: record.cage_x.clone(), y: record.cage_y.clone(), ..Orbit::default() };
        let title = format!("Orbit of the cage of bearing {}", found.name);
        out.push((name("cage_orbit"), Figure::Orbits(Orbits { title, note, orbits: vec![orbit] })));
    }
    out
}

/// Slip at which the skidding map has contour lines \[%\].
const SLIP_LEVELS: [f64; 11] = [0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 50.0];

/// Cage slip over load and speed; `title` is that of the model file.
pub fn skidding(found: &SkiddingMap, title: &str) -> Named {
    let map = HeatMap {
        title: format!("Cage slip of bearing {} over load and speed", found.name),
        note: format!("1 less the cage speed over that of rolling without slip ({title})"),
        x_name: "load".into(),
        x_unit: "N".into(),
        y_name: "speed".into(),
        y_unit: "rpm".into(),
        x: found.loads.clone(),
        y: found.speeds.iter().map(|speed| speed * TO_RPM).collect(),
        value: found.slip.iter().map(|slip| 100.0 * slip).collect(),
        quantity: "slip".into(),
        unit: "%".into(),
        contours: SLIP_LEVELS.map(|level| (level, format!("{level} %"))).to_vec(),
        ..HeatMap::default()
    };
    (format!("bearing_{}_skidding", found.name), Figure::HeatMap(map))
}
