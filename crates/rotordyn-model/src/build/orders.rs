//! Orders by number or by the name of a bearing defect frequency.

use super::bearing;
use crate::Model;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Key, Special};
use crate::file::quantities::default_numbers;
use crate::file::reader::Reader;
use crate::file::tree::{Node, Value};
use rotordyn_bearing::Cage;

/// Form of the value of a key of orders.
pub(super) const ORDER: &str = "numbers, or BPFO, BPFI, BSF, FTF as \"2 BPFO\", \"B.BPFO\"";

/// Relative difference up to which orders of two bearings are one line; lines are named with the same one.
const SAME_ORDER: f64 = 1e-6;

/// Orders as numbers or by name: "BPFO", "2 BPFO", "BPFI", "BSF", "FTF", of one bearing as "B.BPFO". A name without bearing
/// stands for the line of every bearing, of bearings with the same order once.
pub(super) fn orders(r: &Reader, key: &Key<Special>, model: &Model) -> Vec<f64> {
    let Some(entry) = r.entry(key) else { return default_numbers(key) };
    let items: &[Node] = match &entry.node.value {
        Value::List(items) => items,
        _ => std::slice::from_ref(&entry.node),
    };
    let mut orders = Vec::new();
    for item in items {
        let found = match &item.value {
            #[allow(clippy::cast_precision_loss)] // orders are small
            Value::Integer(i) => vec![*i as f64],
            Value::Float(f) => vec![*f],
            Value::Text(text) => match named_orders(text, model) {
                Ok(found) => found,
                Err(message) => {
                    let problem = Problem::new(Kind::UnknownName, &item.span, message)
                        .expected("an order such as 1, \"BPFO\", \"2 BPFO\" or \"B.BPFO\"");
                    r.log.error(problem.follows(bearing::TOP.bearing.about.name));
                    continue;
                }
            },
            _ => Vec::new(),
        };
        let sound = |order: &f64| order.is_finite() && *order > 0.0;
        if found.is_empty() || !found.iter().all(sound) {
            let message = format!("{} has an item that is not an order", r.name(key));
            let problem = Problem::new(Kind::OutOfRange, &item.span, message)
                .expected("a number above zero, or a name such as \"BPFO\"");
            // the geometry of a bearing with errors is no geometry
            r.log.error(match item.value {
                Value::Text(_) => problem.follows(bearing::TOP.bearing.about.name),
                _ => problem,
            });
            continue;
        }
        let alone = found.len() == 1;
        for order in found {
            if alone || !orders.iter().any(|known| is_same(*known, order)) {
                orders.push(order);
            }
        }
    }
    orders
}

fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME_ORDER * b
}

/// The orders that a name stands for, each once.
fn named_orders(text: &str, model: &Model) -> Result<Vec<f64>, String> {
    let (factor, name) = match text.trim().split_once(' ') {
        Some((factor, name)) => {
            (factor.parse::<f64>().map_err(|_| format!("`{text}` is not an order"))?, name.trim())
        }
        None => (1.0, text.trim()),
    };
    let (wanted, frequency) = name.rsplit_once('.').map_or((None, name), |(b, f)| (Some(b), f));
    let mut found: Vec<f64> = Vec::new();
    let mut balls: Vec<&str> = Vec::new();
    for site in &model.bearings {
        let Some(ball) = site.bearing.ball() else { continue };
        balls.push(&site.name);
        if wanted.is_some_and(|w| w != site.name && w.strip_prefix("bearing.") != Some(&site.name)) {
            continue;
        }
        let g = &ball.geometry;
        let ratio = g.ball_diameter / g.pitch_diameter * g.contact_angle.cos();
        let cage = match ball.cage {
            Cage::Rolling => 0.5 * (1.0 - ratio),
            Cage::Ratio(cage) => cage,
        };
        let order = factor
            * match frequency {
                "BPFO" => g.balls as f64 * cage,
                "BPFI" => g.balls as f64 * (1.0 - cage),
                "BSF" => g.pitch_diameter / (2.0 * g.ball_diameter) * (1.0 - ratio * ratio),
                "FTF" => cage,
                _ => return Err(format!("`{frequency}` is not one of BPFO, BPFI, BSF, FTF")),
            };
        if !found.iter().any(|known| is_same(*known, order)) {
            found.push(order);
        }
    }
    match (found.is_empty(), wanted) {
        (false, _) => Ok(found),
        (true, Some(bearing)) if !balls.is_empty() => {
            let names = balls.iter().map(|name| format!("\"{name}.{frequency}\"")).collect::<Vec<_>>();
            Err(format!("`{text}`: no ball bearing `{bearing}`; known are {}", names.join(", ")))
        }
        _ => Err(format!("`{text}` needs a ball bearing, but no such bearing exists")),
    }
}
