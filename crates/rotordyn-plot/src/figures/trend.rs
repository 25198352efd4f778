//! Figure of several records of one machine: every quantity over the axis of the trend, records marked by the part named.

use super::Named;
use super::display_unit::{typographic_unit, unit};
use crate::{Curve, Figure, Grid, GridPanel};
use rotordyn_core::results::{TrendQuantity, TrendResult};
use rotordyn_signal::bearing_lines::BearingPart;

/// One panel per quantity.
pub fn figure(found: &TrendResult, title: &str) -> Named {
    let parts: Vec<BearingPart> =
        BearingPart::ALL.into_iter().filter(|part| count(found, *part) > 0).collect();
    let mut legend = vec!["every record".to_string()];
    legend.extend(parts.iter().map(|part| format!("{} named", part.name())));
    let panels = found.quantities().iter().map(|quantity| panel(found, quantity, &parts)).collect();
    let state = found.records.iter().filter_map(|r| r.state.as_ref()).next();
    let mut note = vec![format!("{} records", found.records.len())];
    note.extend(state.map(|s| s.channel.clone()));
    note.extend(found.bearing.as_ref().map(|b| format!("bearing {}", b.name)));
    note.extend(
        found.line_band.map(|(low, high)| format!("lines in the envelope of {low:.0} to {high:.0} Hz")),
    );
    let grid = Grid {
        title: format!("Trend of {title} over {}", found.axis.name),
        note: note.join(", "),
        x_name: found.axis.name.clone(),
        x_unit: found.axis.unit.clone(),
        legend: if parts.is_empty() { Vec::new() } else { legend },
        panels,
        columns: 3,
        mark: None,
    };
    ("trend".into(), Figure::Grid(grid))
}

fn count(found: &TrendResult, part: BearingPart) -> usize {
    let states = found.records.iter().filter_map(|r| r.state.as_ref()?.diagnosis.as_ref());
    states.filter(|diagnosis| diagnosis.part == Some(part)).count()
}

fn panel(found: &TrendResult, quantity: &TrendQuantity, parts: &[BearingPart]) -> GridPanel {
    let known = unit(&quantity.unit);
    let (factor, unit) = match known.name {
        "SI" => (1.0, typographic_unit(&quantity.unit)),
        name => (known.factor, name.to_string()),
    };
    let points = |of: &dyn Fn(usize) -> bool, points: bool| {
        let places = (0..found.records.len())
            .filter(|&k| found.records[k].position.is_finite() && quantity.values[k].is_finite() && of(k));
        let (x, y) = places.map(|k| (found.records[k].position, quantity.values[k] * factor)).unzip();
        Curve { x, y, points, ..Curve::default() }
    };
    let named = |k: usize| found.records[k].state.as_ref()?.diagnosis.as_ref()?.part;
    let mut curves = vec![points(&|_| true, false)];
    curves.extend(parts.iter().map(|part| points(&|k| named(k) == Some(*part), true)));
    GridPanel {
        name: quantity.name.clone(),
        unit,
        curves,
        from_zero: quantity.name != "skewness",
        log_y: false,
    }
}
