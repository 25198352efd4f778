//! Figures over speed, order and shaft angle (order tracking, synchronous average), cyclic coherence, and
//! jerk.

use super::Named;
use super::order_tracks::{Shown, order_tracks};
use super::run::{SpectraOverSpeed, waterfall_panels};
use super::signal_units::{CURSOR_GROUPS, cursor_group, defect_orders, display_unit, levels, quantity_name};
use crate::{
    Channel, Cursor, CursorLines, CursorPanel, Curve, Figure, HeatMap, History, Lines, OrderLine, OrderMap,
    Spectrogram, SpectrogramPanel, Waterfall,
};
use rotordyn_core::results::{
    CyclicResult, JerkResult, RaceResult, ShaftAverage, ShaftOrders, SignalResult, SpectrogramWithSpeed,
};
use rotordyn_core::series::Series;
use rotordyn_signal::bearing_lines::BearingPart;
use rotordyn_signal::race_defects::DefectKind;

/// Dynamic range of level maps \[dB\].
const DYNAMIC_RANGE_DB: f64 = 60.0;

pub fn figures(r: &SignalResult, note: &str) -> Vec<Named> {
    let name = |what: &str| format!("signal_{what}_{}", r.channel);
    let mut out = Vec::new();
    if let Some(found) = &r.spectrogram {
        out.push((name("spectrogram"), Figure::HeatMap(over_time(r, found, note))));
        out.extend(over_speed(r, found, note).into_iter().map(|(what, figure)| (name(what), figure)));
    }
    if let Some(found) = &r.orders {
        out.push((name("order_spectrum"), Figure::CursorLines(order_spectrum(r, found, note))));
        // A map over speed needs a varying speed.
        if r.shaft.as_ref().is_some_and(|s| !s.steady) && found.map.rpm.len() > 1 {
            out.push((name("orders"), Figure::OrderMap(orders(r, found, note))));
            out.push((name("order_cuts"), Figure::Lines(order_cuts(r, found, note))));
        }
        if let Some(tracks) = &found.tracks {
            let lines: Vec<_> = found.cuts.iter().map(|(line, _)| line).collect();
            let d = display_unit(r);
            let shown = Shown { quantity: quantity_name(r), unit: d.name, factor: d.factor };
            let title = format!("Order tracks of {}", r.channel);
            out.push((name("order_tracks"), order_tracks(tracks, &lines, &title, note, shown)));
        }
    }
    if let Some(found) = &r.average {
        out.push((name("synchronous_average"), Figure::Lines(average(r, found, note))));
    }
    if let Some(found) = &r.jerk {
        out.push((name("jerk"), Figure::History(jerk(r, found, note))));
        if let Some(race) = &found.race {
            out.push((name("jerk_folded"), Figure::CursorLines(folded_jerk(r, race, note))));
        }
    }
    if let Some(found) = &r.cyclic {
        out.push((name("cyclic_coherence"), Figure::HeatMap(cyclic(r, found, note))));
        out.push((
            name("enhanced_envelope_spectrum"),
            Figure::CursorLines(enhanced_envelope_spectrum(r, found, note)),
        ));
    }
    out
}

/// Shaft and bearing lines of order maps.
fn order_lines(r: &SignalResult) -> Vec<OrderLine> {
    let line = |label: &str, order: f64, bearing: bool| OrderLine { label: label.into(), order, bearing };
    if let Some(found) = &r.orders {
        let cuts = found.cuts.iter();
        return cuts.map(|(cut, _)| line(&cut.label, cut.order, cut.bearing)).collect();
    }
    let mut lines = vec![line("1x", 1.0, false), line("2x", 2.0, false)];
    if let Some(b) = &r.bearing {
        lines.extend(defect_orders(b).into_iter().map(|(part, order)| line(part.line_name(), order, true)));
    }
    lines
}

fn over_time(r: &SignalResult, found: &SpectrogramWithSpeed, note: &str) -> HeatMap {
    let (value, unit) = levels(r, &found.map.amplitude);
    HeatMap {
        title: format!("Spectrogram of {}", r.channel),
        note: note.into(),
        x_name: "time".into(),
        x_unit: "s".into(),
        y_name: "frequency".into(),
        y_unit: "Hz".into(),
        x: found.map.times.clone(),
        y: found.map.frequencies.clone(),
        value,
        quantity: format!("{} level", quantity_name(r)),
        unit,
        range_below_max: Some(DYNAMIC_RANGE_DB),
        // The time range of a cut record does not start at zero.
        x_range: found.map.times.first().copied().zip(found.map.times.last().copied()).map(|(a, b)| [a, b]),
        ..HeatMap::default()
    }
}

/// Spectra over speed, if the speed varies.
fn over_speed(r: &SignalResult, found: &SpectrogramWithSpeed, note: &str) -> Vec<(&'static str, Figure)> {
    if found.rpm.is_empty() || r.shaft.as_ref().is_none_or(|s| s.steady) {
        return Vec::new();
    }
    let (level_db, unit) = levels(r, &found.map.amplitude);
    let map = Spectrogram {
        title: format!("Spectrogram of {} over speed", r.channel),
        note: note.into(),
        panels: vec![SpectrogramPanel {
            name: String::new(),
            rpm: found.rpm.clone(),
            hz: found.map.frequencies.clone(),
            level_db: level_db.into(),
            ..SpectrogramPanel::default()
        }],
        quantity: format!("{} level", quantity_name(r)),
        unit,
        span_db: DYNAMIC_RANGE_DB,
        orders: order_lines(r),
        ..Spectrogram::default()
    };
    let mut out = vec![("campbell", Figure::Spectrogram(map))];
    let spectra = SpectraOverSpeed {
        name: "",
        rpm: &found.rpm,
        hz: &found.map.frequencies,
        amplitude: &found.map.amplitude,
    };
    let d = display_unit(r);
    let panels = waterfall_panels(&[spectra], d.factor);
    if !panels.is_empty() {
        let figure = Waterfall {
            title: format!("Waterfall of {} over speed", r.channel),
            note: note.into(),
            panels,
            unit: d.name.into(),
            orders: order_lines(r),
        };
        out.push(("waterfall", Figure::Waterfall(figure)));
    }
    out
}

fn orders(r: &SignalResult, found: &ShaftOrders, note: &str) -> OrderMap {
    let (level_db, unit) = levels(r, &found.map.amplitude);
    OrderMap {
        title: format!("Order map of {}", r.channel),
        note: note.into(),
        rpm: found.map.rpm.clone(),
        time: found.map.times.clone(),
        order: found.map.orders.clone(),
        level_db: level_db.into(),
        quantity: format!("{} level", quantity_name(r)),
        unit,
        span_db: DYNAMIC_RANGE_DB,
        orders: order_lines(r),
        max_order: None,
    }
}

fn order_spectrum(r: &SignalResult, found: &ShaftOrders, note: &str) -> CursorLines {
    let d = display_unit(r);
    // The lines of the cuts: those asked for, or shaft and bearing.
    let cursor = |(line, _): &(rotordyn_core::results::OrderLine, _)| {
        let part = BearingPart::ALL.into_iter().find(|part| {
            let base = part.line_name().rsplit(' ').next().unwrap_or_default();
            line.bearing && line.label.ends_with(base)
        });
        Cursor { at: line.order, label: line.label.clone(), group: part.map_or(0, cursor_group) }
    };
    let cursors: Vec<Cursor> = found.cuts.iter().map(cursor).collect();
    let panel = CursorPanel {
        y_name: format!("{}, peak", quantity_name(r)),
        y_unit: d.name.into(),
        curves: vec![Curve {
            x: found.map.orders[1..].to_vec(),
            y: found.average[1..].iter().map(|v| v * d.factor).collect(),
            ..Curve::default()
        }],
        cursors,
        ..CursorPanel::default()
    };
    CursorLines {
        title: format!("Order spectrum of {}, mean over all speeds", r.channel),
        note: note.into(),
        x_name: "order".into(),
        x_unit: "1/rev".into(),
        groups: groups(r),
        panels: vec![panel],
        log_y: true,
        ..CursorLines::default()
    }
}

/// Names of the cursor groups; empty if unused.
fn groups(r: &SignalResult) -> Vec<String> {
    let known = r.bearing.is_some();
    CURSOR_GROUPS
        .iter()
        .enumerate()
        .map(|(k, g)| if known || k == 0 { g.to_string() } else { String::new() })
        .collect()
}

/// Fundamental defect frequencies of the bearing parts, in multiples of `unit`.
fn bearing_cursors(r: &SignalResult, unit: f64) -> Vec<Cursor> {
    let rates = r.bearing.as_ref().map_or_else(Vec::new, defect_orders);
    let cursor = |(part, order): (BearingPart, f64)| Cursor {
        at: unit * order,
        label: part.line_name().into(),
        group: cursor_group(part),
    };
    rates.into_iter().map(cursor).collect()
}

fn order_cuts(r: &SignalResult, found: &ShaftOrders, note: &str) -> Lines {
    let d = display_unit(r);
    let curves = found.cuts.iter().map(|(line, cut)| Curve {
        label: line.label.clone(),
        x: cut.rpm.clone(),
        y: cut.rms.iter().map(|v| v * d.factor).collect(),
        points: false,
    });
    Lines {
        title: format!("Order cuts of {}", r.channel),
        note: note.into(),
        x_name: "shaft speed".into(),
        x_unit: "rpm".into(),
        y_name: format!("{}, RMS", quantity_name(r)),
        y_unit: d.name.into(),
        curves: curves.collect(),
        log_y: true,
        ..Lines::default()
    }
}

fn average(r: &SignalResult, found: &ShaftAverage, note: &str) -> Lines {
    let d = display_unit(r);
    let a = &found.average;
    let count = a.mean.len();
    // Close the curve at the first point.
    let places: Vec<usize> = (0..=count).collect();
    let curve = |label: &str, sign: f64| Curve {
        label: label.into(),
        x: places.iter().map(|&k| 360.0 * k as f64 / count as f64).collect(),
        y: places.iter().map(|k| d.factor * (a.mean[k % count] + sign * a.deviation[k % count])).collect(),
        points: false,
    };
    Lines {
        title: format!("Time synchronous average of {} over {} revolutions", r.channel, a.periods),
        note: note.into(),
        x_name: "shaft angle".into(),
        x_unit: "°".into(),
        y_name: quantity_name(r).into(),
        y_unit: d.name.into(),
        curves: vec![
            curve("average", 0.0),
            curve("plus one standard deviation", 1.0),
            curve("minus one standard deviation", -1.0),
        ],
        x_range: Some([0.0, 360.0]),
        ..Lines::default()
    }
}

/// The record and its jerk over at most twelve ball passages.
fn jerk(r: &SignalResult, found: &JerkResult, note: &str) -> History {
    let d = display_unit(r);
    let passage =
        r.bearing.as_ref().zip(r.shaft.as_ref()).map(|(b, s)| r.sample_rate / (b.orders.bpfo * s.mean));
    let count = passage.map_or(4000, |p| (12.0 * p) as usize).clamp(2, r.samples.len());
    // From the middle: the start of a run contains a transient.
    let first = (r.samples.len() - count) / 2;
    let range = first..first + count;
    let time: Series = range.clone().map(|n| r.start + n as f64 / r.sample_rate).collect();
    let channel = |label: &str, quantity: String, unit: String, values: &[f64]| Channel {
        label: label.into(),
        quantity,
        unit,
        time: time.clone(),
        value: values[range.clone()].iter().map(|v| v * d.factor).collect(),
        ..Channel::default()
    };
    let per_second =
        if d.name.is_empty() { "1/s".into() } else { format!("{}/s", d.name).replace("m/s²/s", "m/s³") };
    History {
        title: format!("Jerk of {}: {} jumps in the whole record", r.channel, found.jumps.len()),
        note: note.into(),
        channels: vec![
            channel("record", quantity_name(r).into(), d.name.into(), &r.samples),
            channel("jerk", "jerk".into(), per_second, &found.jerk),
        ],
        ..History::default()
    }
}

fn folded_jerk(r: &SignalResult, race: &RaceResult, note: &str) -> CursorLines {
    let d = display_unit(r);
    let spacing = race.fold.angles.get(1).map_or(0.0, |step| step * race.fold.angles.len() as f64);
    let part = |name: &str, pick: fn(&rotordyn_signal::Complex<f64>) -> f64| Curve {
        label: name.into(),
        x: race.fold.angles.iter().map(|a| a.to_degrees()).collect(),
        y: race.fold.changes.iter().map(|c| d.factor * pick(c)).collect(),
        points: false,
    };
    let mut curves = vec![part("along x", |c| c.re)];
    if race.full_circumference {
        curves.push(part("along y", |c| c.im));
    }
    let mut cursors = Vec::new();
    for defect in &race.defects {
        let (name, group) = match defect.kind {
            DefectKind::Dent => ("dent", 1),
            DefectKind::Bump => ("bump", 3),
        };
        let begin = defect.angle.rem_euclid(spacing.max(f64::MIN_POSITIVE));
        let label = format!("{name} {:.1}°", defect.angle.to_degrees());
        cursors.push(Cursor { at: begin.to_degrees(), label, group });
        let end = (begin + defect.width).rem_euclid(spacing.max(f64::MIN_POSITIVE));
        cursors.push(Cursor { at: end.to_degrees(), label: String::new(), group });
    }
    let panel = CursorPanel {
        y_name: "jump of the jerk".into(),
        y_unit: if d.name.is_empty() {
            String::new()
        } else {
            format!("{}/s", d.name).replace("m/s²/s", "m/s³")
        },
        curves,
        cursors,
        ..CursorPanel::default()
    };
    CursorLines {
        title: format!("Jumps of the jerk folded over one ball spacing of the {}, {}", race.race, r.channel),
        note: note.into(),
        x_name: "angle on the race".into(),
        x_unit: "°".into(),
        panels: vec![panel],
        x_range: Some([0.0, spacing.to_degrees()]),
        ..CursorLines::default()
    }
}

fn cyclic(r: &SignalResult, found: &CyclicResult, note: &str) -> HeatMap {
    let c = &found.coherence;
    // Skip cyclic frequency 0, where the coherence is 1.
    let bins = c.frequencies.len();
    HeatMap {
        title: format!("Cyclic spectral coherence of {}", r.channel),
        note: note.into(),
        x_name: "cyclic (modulation) frequency".into(),
        x_unit: "Hz".into(),
        y_name: "carrier frequency".into(),
        y_unit: "Hz".into(),
        x: c.cyclic_frequencies[1..].to_vec(),
        y: c.frequencies.clone(),
        value: c.squared[bins..].to_vec(),
        quantity: format!("squared coherence (1 % level of noise: {:.3})", c.one_percent_threshold),
        y_range: Some([0.0, 0.5 * r.sample_rate]),
        ..HeatMap::default()
    }
}

fn enhanced_envelope_spectrum(r: &SignalResult, found: &CyclicResult, note: &str) -> CursorLines {
    let unit = r.shaft.as_ref().map_or(0.0, |s| s.mean);
    let mut cursors = bearing_cursors(r, unit);
    if unit > 0.0 {
        cursors.extend((1..=2).map(|n| Cursor { at: f64::from(n) * unit, label: format!("{n}x"), group: 0 }));
    }
    let panel = CursorPanel {
        y_name: "mean squared coherence".into(),
        curves: vec![Curve {
            x: found.enhanced.frequencies[1..].to_vec(),
            y: found.enhanced.values[1..].to_vec(),
            ..Curve::default()
        }],
        cursors,
        ..CursorPanel::default()
    };
    CursorLines {
        title: format!("Enhanced envelope spectrum of {}", r.channel),
        note: note.into(),
        x_name: "cyclic (modulation) frequency".into(),
        x_unit: "Hz".into(),
        groups: groups(r),
        panels: vec![panel],
        ..CursorLines::default()
    }
}
