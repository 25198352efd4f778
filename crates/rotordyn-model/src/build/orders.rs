//! Orders by number or by the name of a bearing defect frequency.

use crate::Model;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Key, Special};
use crate::file::quantities::default_numbers;
use crate::file::reader::Reader;
use crate::file::tree::{Node, Value};
use rotordyn_bearing::Cage;

/// Form of the value of a key of orders.
pub(super) const ORDER: &str = "numbers, or BPFO, BPFI, BSF, FTF as \"2 BPFO\", \"B.BPFO\"";

/// Orders as numbers or by name: "BPFO", "2 BPFO", "BPFI", "BSF", "FTF", with the bearing if they differ
/// between bearings: "B.BPFO".
pub(super) fn orders(r: &Reader, key: &Key<Special>, model: &Model) -> Vec<f64> {
    let Some(entry) = r.entry(key) else { return default_numbers(key) };
    let items: &[Node] = match &entry.node.value {
        Value::List(items) => items,
        _ => std::slice::from_ref(&entry.node),
    };
    let mut orders = Vec::new();
    for item in items {
        let order = match &item.value {
            #[allow(clippy::cast_precision_loss)] // orders are small
            Value::Integer(i) => Some(*i as f64),
            Value::Float(f) => Some(*f),
            Value::Text(text) => match named_order(text, model) {
                Ok(order) => Some(order),
                Err(message) => {
                    let problem = Problem::new(Kind::UnknownName, &item.span, message);
                    r.log.error(problem.expected("an order such as 1, \"BPFO\", \"2 BPFO\" or \"B.BPFO\""));
                    continue;
                }
            },
            _ => None,
        };
        match order {
            Some(order) if order.is_finite() && order > 0.0 => orders.push(order),
            _ => {
                let message = format!("{} has an item that is not an order", r.name(key));
                let problem = Problem::new(Kind::OutOfRange, &item.span, message);
                r.log.error(problem.expected("a number above zero, or a name such as \"BPFO\""));
            }
        }
    }
    orders
}

fn named_order(text: &str, model: &Model) -> Result<f64, String> {
    let (factor, name) = match text.trim().split_once(' ') {
        Some((factor, name)) => {
            (factor.parse::<f64>().map_err(|_| format!("`{text}` is not an order"))?, name.trim())
        }
        None => (1.0, text.trim()),
    };
    let (wanted, frequency) = name.rsplit_once('.').map_or((None, name), |(b, f)| (Some(b), f));
    let mut found: Vec<(&str, f64)> = Vec::new();
    for site in &model.bearings {
        if let Some(ball) = site.bearing.ball()
            && wanted.is_none_or(|w| w == site.name || w.strip_prefix("bearing.") == Some(&site.name))
        {
            let g = &ball.geometry;
            let ratio = g.ball_diameter / g.pitch_diameter * g.contact_angle.cos();
            let cage = match ball.cage {
                Cage::Rolling => 0.5 * (1.0 - ratio),
                Cage::Ratio(cage) => cage,
            };
            let order = match frequency {
                "BPFO" => g.balls as f64 * cage,
                "BPFI" => g.balls as f64 * (1.0 - cage),
                "BSF" => g.pitch_diameter / (2.0 * g.ball_diameter) * (1.0 - ratio * ratio),
                "FTF" => cage,
                _ => return Err(format!("`{frequency}` is not one of BPFO, BPFI, BSF, FTF")),
            };
            found.push((&site.name, order));
        }
    }
    match found[..] {
        [] => Err(format!("`{text}` needs a ball bearing, but no such bearing exists")),
        [(_, first), ..] if found.iter().all(|(_, f)| (f - first).abs() <= 1e-9 * first) => {
            Ok(factor * first)
        }
        _ => {
            let named = |(bearing, order): &(&str, f64)| format!("\"{bearing}.{frequency}\" is {order:.3}");
            let choices: Vec<String> = found.iter().map(named).collect();
            Err(format!("`{text}` differs between bearings; write one of them: {}", choices.join(", ")))
        }
    }
}
