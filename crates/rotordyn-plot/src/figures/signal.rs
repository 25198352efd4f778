//! Figures of a signal analysis: record, spectra, envelope, kurtogram, cepstrum.

use super::Named;
use super::signal_units::{
    CURSOR_GROUPS, OTHER_GROUPS, cursor_group, defect_orders, display_unit, quantity_name,
};
use crate::{
    Channel, Cursor, CursorLines, CursorMark, CursorPanel, Curve, Figure, HeatMap, History, Lines,
    MarkedRegion,
};
use rotordyn_core::results::{EnvelopeResult, KurtogramResult, SignalResult};
use rotordyn_core::series::Series;
use rotordyn_signal::bearing_lines::{BearingPart, Modulation};
use rotordyn_signal::diagnosis::BandRule;
use rotordyn_signal::grading::Explanation;
use rotordyn_signal::kurtogram::Kurtogram;
use rotordyn_signal::spectrum::Spectrum;

/// Upper end of the axis of an envelope spectrum, in multiples of BPFI.
const ENVELOPE_RANGE_IN_BPFI: f64 = 3.3;
/// Highest order shown of an envelope spectrum without a bearing.
const ENVELOPE_MAX_ORDER: f64 = 20.0;

/// All figures of one channel; `title` is that of its file.
pub fn figures(r: &SignalResult, title: &str) -> Vec<Named> {
    let name = |what: &str| format!("signal_{what}_{}", r.channel);
    let note = note(r, title);
    let mut out = vec![(name("record"), Figure::History(record(r, &note)))];
    if let Some(found) = &r.spectrum {
        out.push((name("spectrum"), Figure::CursorLines(spectrum(r, found, &note))));
    }
    if let Some(found) = &r.density {
        out.push((name("psd"), Figure::Lines(density(r, found, &note))));
    }
    if let Some(found) = &r.envelope {
        out.push((name("envelope"), Figure::CursorLines(envelope(&[(r, found, title)], &note))));
        if let Some(compared) = found.band_scores.as_ref().filter(|_| found.rule == BandRule::Lines) {
            let map = HeatMap {
                title: format!("Demodulation bands of {} by the evidence of a damaged part", r.channel),
                quantity: "evidence of bearing lines".into(),
                unit: "dB".into(),
                ..band_map(compared, &note)
            };
            out.push((name("band_scores"), Figure::HeatMap(map)));
        }
    }
    if let Some(found) = &r.kurtogram {
        let map = HeatMap {
            title: format!("Kurtogram of {}", r.channel),
            quantity: "envelope kurtosis".into(),
            ..band_map(&found.kurtogram, &note)
        };
        out.push((name("kurtogram"), Figure::HeatMap(map)));
        out.push((name("spectral_kurtosis"), Figure::Lines(spectral_kurtosis(r, found, &note))));
    }
    if let Some(found) = &r.cepstrum {
        out.push((name("cepstrum"), Figure::CursorLines(cepstrum(r, found, &note))));
    }
    out.extend(super::signal_orders::figures(r, &note));
    out
}

/// Envelope spectra of two records, if both have one.
pub fn envelope_comparison(of: [(&SignalResult, &str); 2]) -> Option<Named> {
    let [first, second] = of.map(|(r, title)| Some((r, r.envelope.as_ref()?, title)));
    let pair = [first?, second?];
    let speed = |r: &SignalResult| {
        r.shaft.as_ref().map_or("unknown speed".into(), |s| format!("{:.0} rpm", 60.0 * s.mean))
    };
    let bearing = of[0].0.bearing.as_ref().map_or(String::new(), |b| format!(", bearing {}", b.name));
    let note = format!("top {}, bottom {}{bearing}", speed(of[0].0), speed(of[1].0));
    let name = format!("signal_envelope_{}_vs_{}", of[0].0.channel, of[1].0.channel);
    Some((name, Figure::CursorLines(envelope(&pair, &note))))
}

/// Note line: file, speed, bearing, number of samples, sampling rate.
fn note(r: &SignalResult, title: &str) -> String {
    let mut parts = vec![title.to_string()];
    if let Some(s) = &r.shaft {
        parts.push(match s.steady {
            true => format!("{:.0} rpm", 60.0 * s.mean),
            false => format!("{:.0} to {:.0} rpm", 60.0 * s.min, 60.0 * s.max),
        });
    }
    if let Some(b) = &r.bearing {
        parts.push(format!("bearing {}", b.name));
    }
    let rate = (1e3 * r.sample_rate).round() / 1e3;
    parts.push(format!("{} samples at {rate} Hz", r.samples.len()));
    parts.join(", ")
}

fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|v| v * factor).collect()
}

fn record(r: &SignalResult, note: &str) -> History {
    let d = display_unit(r);
    let s = &r.statistics;
    let kurtosis = s.kurtosis.map_or(String::new(), |k| format!(", kurtosis {k:.2}"));
    let channel = Channel {
        label: format!("{}{kurtosis}", format!("RMS {:.4} {}", s.rms * d.factor, d.name).trim_end()),
        quantity: quantity_name(r).into(),
        unit: d.name.into(),
        time: (0..r.samples.len()).map(|n| r.start + n as f64 / r.sample_rate).collect(),
        value: scaled(&r.samples, d.factor).into(),
        ..Channel::default()
    };
    let [time, value] = r.speed.clone().map(Series::from);
    let (label, quantity, unit) = ("shaft speed".into(), "speed".into(), "rpm".into());
    let speed =
        (!time.is_empty()).then_some(Channel { label, quantity, unit, time, value, ..Channel::default() });
    History {
        title: format!("Time record {}", r.channel),
        note: note.into(),
        channels: speed.into_iter().chain([channel]).collect(),
        ..History::default()
    }
}

fn spectrum(r: &SignalResult, found: &Spectrum, note: &str) -> CursorLines {
    let d = display_unit(r);
    // Skip the mean at 0 Hz.
    let curve = Curve {
        x: found.frequencies[1..].to_vec(),
        y: scaled(&found.values[1..], d.factor),
        ..Curve::default()
    };
    let panel = CursorPanel {
        y_name: format!("{}, peak", quantity_name(r)),
        y_unit: d.name.into(),
        curves: vec![curve],
        ..CursorPanel::default()
    };
    CursorLines {
        title: format!("Amplitude spectrum of {}", r.channel),
        note: note.into(),
        x_name: "frequency".into(),
        x_unit: "Hz".into(),
        panels: vec![panel],
        log_y: true,
        x_range: Some([0.0, 0.5 * r.sample_rate]),
        ..CursorLines::default()
    }
}

fn density(r: &SignalResult, found: &Spectrum, note: &str) -> Lines {
    let d = display_unit(r);
    let unit = if d.name.is_empty() { "1/Hz".into() } else { format!("({})²/Hz", d.name) };
    // Skip 0 Hz: only the remainder of the removed means.
    let curve = Curve {
        x: found.frequencies[1..].to_vec(),
        y: scaled(&found.values[1..], d.factor * d.factor),
        ..Curve::default()
    };
    Lines {
        title: format!("Power spectral density of {}", r.channel),
        note: format!("{note}; Welch, Hann, {:.3} Hz", found.frequencies[1]),
        x_name: "frequency".into(),
        x_unit: "Hz".into(),
        y_name: "PSD".into(),
        y_unit: unit,
        curves: vec![curve],
        log_y: true,
        ..Lines::default()
    }
}

/// Envelope spectra of one or several records, one panel each; several records with known speeds are drawn
/// over orders.
pub fn envelope(of: &[(&SignalResult, &EnvelopeResult, &str)], note: &str) -> CursorLines {
    let (r, found, _) = of[0];
    let several = of.len() > 1;
    let by_order = found.over_orders || several && of.iter().all(|(r, ..)| r.shaft.is_some());
    let panels = of.iter().map(|(r, found, title)| {
        let per_turn = |r: &SignalResult| r.shaft.as_ref().map_or(1.0, |s| s.mean);
        let divisor = if by_order && !found.over_orders { per_turn(r) } else { 1.0 };
        let label = if several { panel_label(r, found, title) } else { String::new() };
        envelope_panel(r, found, divisor, label)
    });
    let panels: Vec<CursorPanel> = panels.collect();
    let unit = match (&r.shaft, by_order) {
        (_, true) => 1.0,
        (Some(s), false) => s.mean,
        (None, false) => 1.0,
    };
    let end = match (&r.bearing, by_order) {
        (Some(b), _) => ENVELOPE_RANGE_IN_BPFI * b.orders.bpfi * unit,
        (None, true) => ENVELOPE_MAX_ORDER,
        (None, false) => r.shaft.as_ref().map_or(500.0, |s| ENVELOPE_MAX_ORDER * s.mean),
    };
    let last = found.spectrum.frequencies.last().copied().unwrap_or(end);
    let known = r.bearing.is_some();
    let groups = CURSOR_GROUPS
        .iter()
        .enumerate()
        .map(|(k, g)| if known || k == 0 { g.to_string() } else { String::new() });
    // Only groups that occur are in the legend.
    let marked = |group: usize| panels.iter().any(|p| p.found.iter().any(|f| f.group == group));
    let others: Vec<String> = (OTHER_GROUPS.iter().enumerate())
        .map(|(k, name)| if marked(CURSOR_GROUPS.len() + k) { name.to_string() } else { String::new() })
        .collect();
    let band = format!("band {:.0} to {:.0} Hz", found.band.0, found.band.1);
    let diagnosis = found.statement().map_or(String::new(), |statement| format!(": {statement}"));
    CursorLines {
        title: if several {
            format!("Envelope spectra: {} and {}", of[0].0.channel, of[1].0.channel)
        } else {
            format!("Envelope spectrum of {}{diagnosis}", r.channel)
        },
        note: if several { note.into() } else { format!("{note}; {band}") },
        x_name: if by_order { "order" } else { "frequency" }.into(),
        x_unit: if by_order { "1/rev" } else { "Hz" }.into(),
        groups: groups.chain(others).collect(),
        panels,
        log_y: false,
        x_range: Some([0.0, end.min(if by_order == found.over_orders { last } else { end })]),
    }
}

/// Label of a panel: record, band and bearing diagnosis.
fn panel_label(r: &SignalResult, found: &EnvelopeResult, title: &str) -> String {
    let diagnosis = found.statement().map_or(String::new(), |statement| format!(": {statement}"));
    let (low, high) = found.band;
    format!("{title}, {}, {low:.0} to {high:.0} Hz{diagnosis}", r.channel)
}

/// One envelope spectrum; frequencies and cursors over `divisor`.
fn envelope_panel(r: &SignalResult, found: &EnvelopeResult, divisor: f64, label: String) -> CursorPanel {
    let d = display_unit(r);
    let mut panel = CursorPanel {
        label,
        y_name: format!("envelope of {}, peak", quantity_name(r)),
        y_unit: d.name.into(),
        curves: vec![Curve {
            x: found.spectrum.frequencies[1..].iter().map(|f| f / divisor).collect(),
            y: scaled(&found.spectrum.values[1..], d.factor),
            ..Curve::default()
        }],
        ..CursorPanel::default()
    };
    let unit = if found.over_orders { 1.0 } else { r.shaft_speed().unwrap_or(0.0) } / divisor;
    if unit > 0.0 {
        panel.cursors.extend((1..=2).map(|n| Cursor {
            at: f64::from(n) * unit,
            label: format!("{n}x"),
            group: 0,
        }));
    }
    let Some(lines) = &found.lines else { return panel };
    for family in &lines.families {
        let harmonics = if lines.diagnosis == Some(family.part) { 3 } else { 1 };
        for n in 1..=harmonics {
            // Measured frequency if detected, else the expected one.
            let base = if family.detected { family.frequency } else { family.expected } / divisor;
            let at = f64::from(n) * base;
            let name = family.part.line_name();
            let text = if n == 1 { name.to_string() } else { format!("{n}×{name}") };
            panel.cursors.push(Cursor { at, label: text, group: cursor_group(family.part) });
        }
        // Sidebands only for the diagnosed family.
        let is_diagnosed = lines.diagnosis == Some(family.part);
        let own = family.lines.iter().filter(|l| l.significant && !l.shared && family.detected);
        for line in own.filter(|l| is_diagnosed || l.modulation.is_none()) {
            let (at, y) = (line.frequency / divisor, line.amplitude * d.factor);
            if line.modulation.is_some() {
                panel.cursors.push(Cursor {
                    at,
                    label: String::new(),
                    group: sideband_group(line.modulation, family.part),
                });
            }
            panel.found.push(CursorMark { x: at, y, group: cursor_group(family.part) });
        }
    }
    mark_strong_lines(&mut panel, found, divisor, d.factor);
    panel
}

/// Marks every strong line that has no mark yet, by what explains it.
fn mark_strong_lines(panel: &mut CursorPanel, found: &EnvelopeResult, divisor: f64, factor: f64) {
    let Some(graded) = &found.graded else { return };
    let step = found.spectrum.frequencies[1] / divisor;
    for line in &graded.strong_lines {
        let group = match line.explanation {
            Explanation::Bearing(part) => cursor_group(part),
            Explanation::Shaft(_) => 0,
            Explanation::Mains | Explanation::Beat | Explanation::Periodic(_) => CURSOR_GROUPS.len(),
            Explanation::Unexplained => CURSOR_GROUPS.len() + 1,
        };
        let x = line.frequency / divisor;
        if panel.found.iter().all(|mark| (mark.x - x).abs() > 1.5 * step) {
            panel.found.push(CursorMark { x, y: line.amplitude * factor, group });
        }
    }
}

/// Sidebands get the style of the modulating frequency.
fn sideband_group(modulation: Option<Modulation>, part: BearingPart) -> usize {
    match modulation {
        Some(Modulation::Shaft(_)) => 0,
        Some(Modulation::Cage(_)) => cursor_group(BearingPart::Cage),
        None => cursor_group(part),
    }
}

/// Map of a value per band over frequency, wide bands at the bottom, the best band framed.
fn band_map(kurtogram: &Kurtogram, note: &str) -> HeatMap {
    let finest = kurtogram.levels.iter().map(|l| l.values.len()).max().unwrap_or(1);
    // Number of columns divisible by the band count of every level.
    let columns = 3 * finest;
    let width = kurtogram.max_frequency / columns as f64;
    let rows = kurtogram.levels.len();
    let value = (0..columns).flat_map(|c| {
        kurtogram.levels.iter().map(move |level| level.values[c * level.values.len() / columns])
    });
    let best = kurtogram.best();
    let row = kurtogram.levels.iter().position(|l| l.level == best.level).unwrap_or(0) as f64;
    let ticks = kurtogram.levels.iter().enumerate().map(|(k, l)| (k as f64, l.values.len().to_string()));
    HeatMap {
        note: note.into(),
        x_name: "frequency".into(),
        x_unit: "Hz".into(),
        y_name: "number of bands".into(),
        x: (0..columns).map(|c| (c as f64 + 0.5) * width).collect(),
        y: (0..rows).map(|k| k as f64).collect(),
        value: value.collect(),
        x_range: Some([0.0, kurtogram.max_frequency]),
        y_range: Some([-0.5, rows as f64 - 0.5]),
        y_ticks: ticks.collect(),
        marked: Some(Box::new(MarkedRegion {
            x: [best.low, best.high],
            y: [row - 0.5, row + 0.5],
            label: format!("best: {:.0} to {:.0} Hz, {:.2}", best.low, best.high, best.value),
        })),
        ..HeatMap::default()
    }
}

fn spectral_kurtosis(r: &SignalResult, found: &KurtogramResult, note: &str) -> Lines {
    let s = &found.spectral;
    let inner = 1..s.values.len().saturating_sub(1).max(1);
    Lines {
        title: format!("Spectral kurtosis of {}", r.channel),
        note: format!("{note}; segments of {} samples", 2 * (s.values.len() - 1)),
        x_name: "frequency".into(),
        x_unit: "Hz".into(),
        y_name: "spectral kurtosis (0 for Gaussian noise)".into(),
        curves: vec![Curve {
            x: s.frequencies[inner.clone()].to_vec(),
            y: s.values[inner].to_vec(),
            ..Curve::default()
        }],
        ..Lines::default()
    }
}

fn cepstrum(r: &SignalResult, found: &rotordyn_signal::cepstrum::Cepstrum, note: &str) -> CursorLines {
    let steady = r.shaft.as_ref().filter(|s| s.steady);
    // Three shaft revolutions, or 50 ms.
    let end = steady.map_or(0.05, |s| 3.2 / s.mean);
    let count = found.quefrencies.partition_point(|q| *q <= end);
    // Skip low quefrencies: the spectral envelope.
    let first = found.quefrencies.partition_point(|q| *q < 0.02 * end);
    let mut cursors = Vec::new();
    if let Some(s) = steady {
        let period = 1e3 / s.mean;
        cursors.extend((1..=3).map(|n| Cursor {
            at: f64::from(n) * period,
            label: format!("{n}/fr"),
            group: 0,
        }));
        if let Some(b) = &r.bearing {
            cursors.extend(defect_orders(b).into_iter().filter(|(part, _)| *part != BearingPart::Cage).map(
                |(part, order)| {
                    let label = format!("1/{}", part.line_name().replace(' ', ""));
                    Cursor { at: period / order, label, group: cursor_group(part) }
                },
            ));
        }
    }
    let panel = CursorPanel {
        y_name: "real cepstrum".into(),
        curves: vec![Curve {
            x: found.quefrencies[first..count].iter().map(|q| 1e3 * q).collect(),
            y: found.values[first..count].to_vec(),
            ..Curve::default()
        }],
        cursors,
        ..CursorPanel::default()
    };
    CursorLines {
        title: format!("Cepstrum of {}", r.channel),
        note: note.into(),
        x_name: "quefrency".into(),
        x_unit: "ms".into(),
        groups: CURSOR_GROUPS.iter().map(|_| String::new()).collect(),
        panels: vec![panel],
        x_range: Some([0.0, 1e3 * end]),
        ..CursorLines::default()
    }
}
