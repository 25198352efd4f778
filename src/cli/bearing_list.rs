//! Ball bearings with their geometry and defect frequencies, as `check` prints them.

use rotordyn::bearing::BallBearing;
use serde_json::{Value, json};

use super::terminal::{Terminal, number};

/// A bearing of a model: its name, its model as keyword and in words, and its balls.
#[derive(Clone, Debug)]
pub struct ListedBearing<'a> {
    pub name: &'a str,
    pub keyword: &'static str,
    pub description: String,
    pub balls: Option<&'a BallBearing>,
}

/// Prints a row for each bearing, and how geometries that are not given were estimated.
pub fn print(terminal: &Terminal, bearings: &[ListedBearing]) {
    if bearings.is_empty() {
        return;
    }
    let rows: Vec<Vec<String>> = bearings.iter().map(row).collect();
    let header = ["bearing", "model", "pitch mm", "clearance um", "angle deg", "FTF", "BPFO", "BPFI", "BSF"];
    let has_balls = rows.iter().any(|row| row.len() > 2);
    let header = if has_balls { &header[..] } else { &header[..2] };
    terminal.table("Bearings and their defect frequencies per revolution", header, &rows);
    for bearing in bearings {
        if let Some(how) = bearing.balls.and_then(|balls| balls.estimated_geometry.as_deref()) {
            terminal.print(&format!("  internal geometry of {} {how}", bearing.name));
        }
    }
}

fn row(bearing: &ListedBearing) -> Vec<String> {
    let (mut row, model) = (vec![bearing.name.to_string()], bearing.description.clone());
    match bearing.balls {
        None => row.push(model),
        Some(ball) => {
            let g = &ball.geometry;
            let orders = g.characteristic_orders(g.contact_angle);
            let comma = if model.is_empty() { "" } else { ", " };
            let diameter = number(1e3 * g.ball_diameter, 4);
            row.push(format!("{} balls of {diameter} mm{comma}{model}", g.balls));
            row.push(number(1e3 * g.pitch_diameter, 5));
            row.push(format!("{:.1}", 1e6 * g.radial_clearance));
            row.push(format!("{:.0}", g.contact_angle.to_degrees()));
            let orders = [orders.ftf, orders.bpfo, orders.bpfi, orders.bsf];
            row.extend(orders.iter().map(|o| format!("{o:.4}")));
        }
    }
    row
}

/// The bearings in SI units.
pub fn to_json(bearings: &[ListedBearing]) -> Vec<Value> {
    let entry = |bearing: &ListedBearing| match bearing.balls {
        None => json!({ "name": bearing.name, "model": bearing.keyword }),
        Some(ball) => {
            let g = &ball.geometry;
            let o = g.characteristic_orders(g.contact_angle);
            json!({
                "name": bearing.name,
                "model": bearing.keyword,
                "balls": g.balls,
                "ball_diameter": g.ball_diameter,
                "pitch_diameter": g.pitch_diameter,
                "radial_clearance": g.radial_clearance,
                "estimated_geometry": ball.estimated_geometry,
                "orders": { "ftf": o.ftf, "bpfo": o.bpfo, "bpfi": o.bpfi, "bsf": o.bsf },
            })
        }
    };
    bearings.iter().map(entry).collect()
}
