//! `catalogue`: the built-in bearing catalogue.

use rotordyn::bearing::BallGeometry;
use rotordyn::bearing::rating::LoadRating;
use rotordyn::model::catalogue::{
    CLEARANCE_CLASSES, CatalogueEntry, angle_note, bearing_steel, clearance, entries, find, nearest,
};
use serde_json::{Value, json};

use super::failure::Failure;
use super::terminal::{Terminal, number};

pub fn run(wanted: Option<&str>, terminal: &Terminal) -> Result<Value, Failure> {
    let wanted = wanted.unwrap_or_default().trim();
    let found: Vec<CatalogueEntry> = match find(wanted) {
        Some(entry) => vec![entry],
        None => entries().filter(|e| starts(e.designation, wanted)).collect(),
    };
    match found.as_slice() {
        [] => {
            let message = format!(
                "the catalogue has no bearing `{wanted}`; nearest: {}; `rotordyn catalogue` lists all",
                nearest(wanted, 6).join(", ")
            );
            return Err(Failure::Input(message));
        }
        [one] => print_data_sheet(terminal, one),
        many => list(terminal, many),
    }
    Ok(json!({ "command": "catalogue", "bearings": found.iter().map(to_json).collect::<Vec<_>>() }))
}

fn starts(designation: &str, with: &str) -> bool {
    designation.get(..with.len()).is_some_and(|head| head.eq_ignore_ascii_case(with))
}

/// Internal geometry of an entry, without clearance.
pub fn geometry(e: &CatalogueEntry) -> BallGeometry {
    BallGeometry {
        balls: e.balls,
        ball_diameter: e.ball_diameter,
        pitch_diameter: e.pitch_diameter,
        inner_groove_radius: e.osculation[0] * e.ball_diameter,
        outer_groove_radius: e.osculation[1] * e.ball_diameter,
        radial_clearance: 0.0,
        contact_angle: e.contact_angle,
        thrust_direction: 1.0,
        moment_arm: None,
        bore: e.bore,
        outside_diameter: e.outside_diameter,
        width: e.width,
    }
}

fn list(terminal: &Terminal, found: &[CatalogueEntry]) {
    let mm = |length: f64| number(1e3 * length, 5).trim_end_matches('0').trim_end_matches('.').to_string();
    let rows: Vec<Vec<String>> = found
        .iter()
        .map(|e| {
            let orders = geometry(e).characteristic_orders(e.contact_angle);
            vec![
                e.designation.to_string(),
                mm(e.bore),
                mm(e.outside_diameter),
                mm(e.width),
                e.balls.to_string(),
                mm(e.ball_diameter),
                mm(e.pitch_diameter),
                format!("{:.0}", e.contact_angle.to_degrees()),
                format!("{:.3}", orders.bpfo),
                format!("{:.3}", orders.bpfi),
                if e.estimated { "estimated" } else { "" }.to_string(),
            ]
        })
        .collect();
    let header = [
        "designation",
        "bore",
        "OD",
        "width",
        "balls",
        "ball dia.",
        "pitch dia.",
        "angle deg",
        "BPFO",
        "BPFI",
        "internal geometry",
    ];
    terminal.table(
        &format!("{} bearings: lengths in mm, defect frequencies per revolution", found.len()),
        &header,
        &rows,
    );
}

fn print_data_sheet(terminal: &Terminal, e: &CatalogueEntry) {
    let orders = geometry(e).characteristic_orders(e.contact_angle);
    let row = |name: &str, value: String| vec![name.to_string(), value];
    let mm = |length: f64| format!("{} mm", number(1e3 * length, 5));
    let mut rows = vec![
        row("bore", mm(e.bore)),
        row("outside diameter", mm(e.outside_diameter)),
        row("width", mm(e.width)),
        row("smallest chamfer", mm(e.chamfer)),
        row("balls", e.balls.to_string()),
        row("ball diameter", mm(e.ball_diameter)),
        row("pitch diameter", mm(e.pitch_diameter)),
        row("groove radius / ball diameter", format!("inner {}, outer {}", e.osculation[0], e.osculation[1])),
        row(
            "contact angle",
            angle_note(e).unwrap_or_else(|| format!("{:.1} deg", e.contact_angle.to_degrees())),
        ),
        row("FTF, BPFO", format!("{:.4}, {:.4} per revolution", orders.ftf, orders.bpfo)),
        row("BPFI, BSF", format!("{:.4}, {:.4} per revolution", orders.bpfi, orders.bsf)),
    ];
    let kn = |force: f64| format!("{} kN", number(1e-3 * force, 4));
    let steel = bearing_steel();
    let found = LoadRating::new(&geometry(e), &steel, &steel, None);
    rows.push(row("C, C_0 of this geometry", format!("{}, {}", kn(found.dynamic), kn(found.static_rating))));
    rows.extend(e.published.map(|p| {
        let values = format!("{}, {} ({})", kn(p.dynamic), kn(p.static_rating), p.source);
        row("C, C_0 published", values)
    }));
    for class in CLEARANCE_CLASSES {
        let range = clearance(class, e.bore).filter(|_| e.contact_angle == 0.0);
        rows.extend(range.map(|[least, most]| {
            let um = |c: f64| format!("{:.0}", 1e6 * c);
            row(&format!("radial clearance {class}"), format!("{} to {} um", um(least), um(most)))
        }));
    }
    rows.push(row("source of geometry", e.origin.to_string()));
    terminal.table(e.designation, &["", ""], &rows);
}

fn to_json(e: &CatalogueEntry) -> Value {
    let orders = geometry(e).characteristic_orders(e.contact_angle);
    let steel = bearing_steel();
    let computed = LoadRating::new(&geometry(e), &steel, &steel, None);
    let clearances: serde_json::Map<String, Value> = CLEARANCE_CLASSES
        .iter()
        .filter_map(|class| Some(((*class).to_string(), json!(clearance(class, e.bore)?))))
        .collect();
    json!({
        "designation": e.designation,
        "bore": e.bore,
        "outside_diameter": e.outside_diameter,
        "width": e.width,
        "balls": e.balls,
        "ball_diameter": e.ball_diameter,
        "pitch_diameter": e.pitch_diameter,
        "osculation": e.osculation,
        "contact_angle": e.contact_angle,
        "chamfer": e.chamfer,
        "static_rating": e.published.map(|p| p.static_rating),
        "dynamic_rating": e.published.map(|p| p.dynamic),
        "fatigue_limit": e.published.and_then(|p| p.fatigue),
        "rating_source": e.published.map(|p| p.source),
        "computed_rating": { "dynamic": computed.dynamic, "static": computed.static_rating, "fatigue": computed.fatigue },
        "contact_angle_note": angle_note(e),
        "estimated": e.estimated,
        "radial_clearance": clearances,
        "orders": { "ftf": orders.ftf, "bpfo": orders.bpfo, "bpfi": orders.bpfi, "bsf": orders.bsf },
        "geometry_source": e.origin,
    })
}
