//! The run-up over time, its spectra over speed.

use super::display::{Display, decibels, quantity, unit};
use super::speed::{branches, order_lines};
use super::{Named, TO_RPM};
use crate::edge::plot::{Branch, Channel, Curve, Figure, History, Lines, OrderMap, Spectrogram, Waterfall};
use crate::results::{self, CampbellResult, HistoryChannel, OrderResult, SpectrogramResult};
use crate::signal::waterfall::waterfall;
use crate::study::Machine;

/// Levels shown below the highest where the model file says nothing \[dB\].
const SPAN_DB: f64 = 70.0;
/// Spectra of a waterfall.
const STEPS: usize = 40;

pub fn histories(history: &results::History, machine: &Machine) -> Vec<Named> {
    let channel = |c: &HistoryChannel, label: String| {
        let shown = unit(&c.unit);
        Channel {
            label,
            quantity: quantity(&c.unit).into(),
            unit: shown.name.into(),
            time: history.time.clone(),
            value: c.values.iter().map(|v| v * shown.factor).collect(),
        }
    };
    let speed = Channel {
        label: "shaft speed".into(),
        quantity: "speed".into(),
        unit: "rpm".into(),
        time: history.time.clone(),
        value: history.speed.iter().map(|s| s * TO_RPM).collect(),
    };
    let note = &machine.model.title;
    let figure = |name: String, title: String, channels: Vec<Channel>| {
        (name, Figure::History(History { title, note: note.clone(), channels }))
    };
    let mut figures = Vec::new();
    for c in &history.channels {
        if ["displacement", "velocity", "acceleration"].contains(&c.quantity.as_str()) {
            let label = format!("{}: {} along {}", c.name, c.station, c.direction);
            let title = format!("Run-up, {}", c.name);
            figures.push(figure(format!("run_up_{}", c.name), title, vec![speed.clone(), channel(c, label)]));
        }
    }
    for site in &machine.model.bearings {
        let forces = history.channels.iter().filter(|c| c.quantity == "force" && c.station == site.name);
        let mut channels: Vec<Channel> =
            forces.map(|c| channel(c, format!("force on the shaft along {}", c.direction))).collect();
        if !channels.is_empty() {
            channels.insert(0, speed.clone());
            let title = format!("Run-up, bearing {}", site.name);
            figures.push(figure(format!("run_up_bearing_{}", site.name), title, channels));
        }
    }
    let energies = history.channels.iter().filter(|c| c.quantity == "energy");
    let energies: Vec<Channel> =
        energies.map(|c| channel(c, c.name.replace("energy_", "").replace('_', " "))).collect();
    if !energies.is_empty() {
        figures.push(figure("run_up_energy".into(), "Run-up, energy account".into(), energies));
    }
    figures
}

pub fn spectrogram(
    found: &SpectrogramResult,
    campbell: Option<&CampbellResult>,
    machine: &Machine,
) -> Vec<Named> {
    let s = &found.spectrogram;
    let shown = unit(&found.unit);
    let rpm: Vec<f64> = found.speed.iter().map(|w| w * TO_RPM).collect();
    let highest = s.frequencies.last().copied().unwrap_or(0.0);
    let seen = |b: &Branch| b.hz.iter().any(|hz| *hz <= highest);
    let linear: Vec<Branch> = campbell.map(branches).into_iter().flatten().filter(seen).collect();
    let orders = order_lines(&found.orders);
    let note = machine.model.title.clone();
    let span_db = machine.model.studies.spectrogram.as_ref().map_or(SPAN_DB, |study| study.dynamic_range_db);
    let map = Spectrogram {
        title: format!("Run-up seen in {}", found.channel),
        note: note.clone(),
        rpm: rpm.clone(),
        hz: s.frequencies.clone(),
        level_db: decibels(&s.amplitude, shown),
        quantity: format!("{} level", quantity(&found.unit)),
        unit: reference(shown),
        span_db,
        orders: orders.clone(),
        branches: linear,
        max_hz: Some(highest),
    };
    let mut figures = vec![(format!("spectrogram_{}", found.channel), Figure::Spectrogram(map))];
    let (lo, hi) = rpm.iter().fold((f64::INFINITY, 0.0f64), |(lo, hi), r| (lo.min(*r), hi.max(*r)));
    let step = (hi - lo) / STEPS as f64;
    if step > 0.0 {
        let steps: Vec<f64> = (0..=STEPS).map(|k| lo + step * k as f64).collect();
        // Its refusals (NaN, sizes that do not fit) cannot come from a spectrogram.
        if let Ok(rows) = waterfall(&s.frequencies, &s.amplitude, &rpm, &steps, 0.5 * step) {
            let figure = Waterfall {
                title: format!("Run-up seen in {}", found.channel),
                note,
                rpm: rows.rpm,
                hz: rows.axis,
                amplitude: rows.amplitude.iter().map(|a| a * shown.factor).collect(),
                unit: shown.name.into(),
                orders,
            };
            figures.push((format!("waterfall_{}", found.channel), Figure::Waterfall(figure)));
        }
    }
    figures
}

pub fn orders(found: &OrderResult, machine: &Machine) -> Vec<Named> {
    let s = &found.spectrogram;
    let shown = unit(&found.unit);
    let note = machine.model.title.clone();
    let lines: Vec<results::OrderLine> = found.cuts.iter().map(|(line, _)| line.clone()).collect();
    let span_db = machine.model.studies.spectrogram.as_ref().map_or(SPAN_DB, |study| study.dynamic_range_db);
    let map = OrderMap {
        title: format!("Orders of the run-up, {}", found.channel),
        note: note.clone(),
        rpm: s.rpm.clone(),
        order: s.orders.clone(),
        level_db: decibels(&s.amplitude, shown),
        quantity: format!("{} level", quantity(&found.unit)),
        unit: reference(shown),
        span_db,
        orders: order_lines(&lines),
        max_order: None,
    };
    let mut figures = vec![(format!("orders_{}", found.channel), Figure::OrderMap(map))];
    if !found.cuts.is_empty() {
        let curves = found.cuts.iter().map(|(line, cut)| Curve {
            label: line.label.clone(),
            x: cut.rpm.clone(),
            y: cut.rms.iter().map(|v| v * shown.factor).collect(),
            points: false,
        });
        let figure = Lines {
            title: format!("Order cuts of the run-up, {}", found.channel),
            note,
            x_name: "shaft speed".into(),
            x_unit: "rpm".into(),
            y_name: format!("{}, RMS", quantity(&found.unit)),
            y_unit: shown.name.into(),
            curves: curves.collect(),
            log_x: false,
            log_y: true,
            ..Lines::default()
        };
        figures.push((format!("order_cuts_{}", found.channel), Figure::Lines(figure)));
    }
    figures
}

fn reference(shown: Display) -> String {
    format!("dB re 1 {}", shown.name)
}
