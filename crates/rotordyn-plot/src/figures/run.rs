//! Figures of a run-up: time histories, spectrograms, waterfalls, order maps and order cuts.

use super::campbell::{branches, order_lines};
use super::display_unit::{DisplayUnit, decibels_of, quantity, unit};
use super::order_tracks::{Shown, order_tracks};
use super::{Named, TO_RPM};
use crate::{
    Branch, Channel, Curve, Figure, History, Lines, OrderMap, Spectrogram, SpectrogramPanel, Waterfall,
    WaterfallPanel,
};
use rotordyn_core::results::{
    self, CagePhaseBand, CampbellResult, HistoryChannel, OrderResult, SpectrogramResult,
};
use rotordyn_core::series::SeriesError;
use rotordyn_core::study::Machine;
use rotordyn_signal::waterfall::waterfall;

/// Default dynamic range of level maps \[dB\].
const DYNAMIC_RANGE_DB: f64 = 70.0;
/// Number of spectra of a waterfall.
const WATERFALL_SPECTRA: usize = 40;

pub fn histories(history: &results::History, machine: &Machine) -> Vec<Named> {
    let channel = |c: &HistoryChannel, label: String| {
        let shown = unit(&c.unit);
        Channel {
            label,
            quantity: quantity(&c.unit).into(),
            unit: shown.name.into(),
            time: history.time.clone(),
            value: c.values.scaled(shown.factor),
            ..Channel::default()
        }
    };
    let speed = shaft_speed(history);
    let note = &machine.model.title;
    let figure = |name: String, title: String, channels: Vec<Channel>| {
        (name, Figure::History(History { title, note: note.clone(), channels, ..History::default() }))
    };
    let mut figures = Vec::new();
    for c in &history.channels {
        // The centre of a cage, which no probe measures, is drawn as an orbit.
        let is_probe = machine.model.probes.iter().any(|probe| probe.name == c.name);
        if !is_probe && machine.model.bearings.iter().any(|site| site.name == c.station) && c.unit == "m" {
            continue;
        }
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
        figures.push(figure("run_up_energy".into(), "Run-up, energy balance".into(), energies));
    }
    figures
}

/// Shaft speed of a run over time.
pub(super) fn shaft_speed(history: &results::History) -> Channel {
    Channel {
        label: "shaft speed".into(),
        quantity: "speed".into(),
        unit: "rpm".into(),
        time: history.time.clone(),
        value: history.speed.scaled(TO_RPM),
        ..Channel::default()
    }
}

/// Spectra of one run over speed.
pub(super) struct SpectraOverSpeed<'a> {
    pub name: &'a str,
    /// Speed of every frame \[rpm\].
    pub rpm: &'a [f64],
    pub hz: &'a [f64],
    /// `amplitude[frame * hz.len() + line]`.
    pub amplitude: &'a [f64],
}

/// Waterfalls of runs at common speeds, amplitudes times `factor`; none if the speed is constant.
pub(super) fn waterfall_panels(runs: &[SpectraOverSpeed], factor: f64) -> Vec<WaterfallPanel> {
    let every = || runs.iter().flat_map(|r| r.rpm.iter());
    let (lo, hi) = every().fold((f64::INFINITY, 0.0f64), |(lo, hi), v| (lo.min(*v), hi.max(*v)));
    let step = (hi - lo) / WATERFALL_SPECTRA as f64;
    if step.is_nan() || step <= 0.0 {
        return Vec::new();
    }
    let steps: Vec<f64> = (0..=WATERFALL_SPECTRA).map(|k| lo + step * k as f64).collect();
    let panel = |run: &SpectraOverSpeed| {
        // Its errors (NaN, size mismatch) cannot occur with a spectrogram.
        let rows = waterfall(run.hz, run.amplitude, run.rpm, &steps, 0.5 * step).ok()?;
        Some(WaterfallPanel {
            name: run.name.into(),
            rpm: rows.rpm,
            hz: rows.axis,
            amplitude: rows.amplitude.iter().map(|a| a * factor).collect(),
        })
    };
    runs.iter().filter_map(panel).collect()
}

/// # Errors
/// Amplitudes that cannot be read.
pub fn spectrogram(
    found: &SpectrogramResult,
    campbell: Option<&CampbellResult>,
    machine: &Machine,
) -> Result<Vec<Named>, SeriesError> {
    let title = format!("Spectra of the run-up, {}", found.channel);
    let run = SpectraOfRun { name: "", found, campbell };
    let figures = spectrograms(&[run], &title, machine)?.into_iter();
    Ok(figures.map(|(kind, figure)| (format!("{kind}_{}", found.channel), figure)).collect())
}

/// Spectra of one channel of a run, and the linear natural frequencies drawn over them.
pub(super) struct SpectraOfRun<'a> {
    pub name: &'a str,
    pub found: &'a SpectrogramResult,
    pub campbell: Option<&'a CampbellResult>,
}

/// Spectrogram map and waterfall of one channel, one panel per named run; kinds "spectrogram" and
/// "waterfall".
///
/// # Errors
/// Amplitudes that cannot be read.
pub(super) fn spectrograms(
    runs: &[SpectraOfRun],
    title: &str,
    machine: &Machine,
) -> Result<Vec<(&'static str, Figure)>, SeriesError> {
    let Some(SpectraOfRun { found: first, .. }) = runs.first() else { return Ok(Vec::new()) };
    let shown = unit(&first.unit);
    let highest = runs.iter().filter_map(|run| run.found.spectrogram.frequencies.last()).copied();
    let highest = highest.fold(0.0, f64::max);
    let visible = |b: &Branch| b.hz.iter().any(|hz| *hz <= highest);
    let orders = order_lines(&first.orders);
    let note = machine.model.title.clone();
    let span_db =
        machine.model.studies.spectrogram.as_ref().map_or(DYNAMIC_RANGE_DB, |study| study.dynamic_range_db);
    let rpm: Vec<Vec<f64>> =
        runs.iter().map(|run| run.found.speed.iter().map(|w| w * TO_RPM).collect()).collect();
    let panel = |(run, rpm): (&SpectraOfRun, &Vec<f64>)| SpectrogramPanel {
        name: run.name.into(),
        rpm: rpm.clone(),
        time: run.found.spectrogram.times.clone(),
        hz: run.found.spectrogram.frequencies.clone(),
        level_db: decibels_of(&run.found.spectrogram.amplitude, shown),
        orders: order_lines(&run.found.orders),
        branches: run.campbell.map(branches).into_iter().flatten().filter(visible).collect(),
    };
    let map = Spectrogram {
        title: title.into(),
        note: note.clone(),
        panels: runs.iter().zip(&rpm).map(panel).collect(),
        quantity: format!("{} level", quantity(&first.unit)),
        unit: reference(shown),
        span_db,
        max_hz: Some(highest),
        ..Spectrogram::default()
    };
    let mut figures = vec![("spectrogram", Figure::Spectrogram(map))];
    let amplitudes = runs.iter().map(|run| run.found.spectrogram.amplitude.all());
    let amplitudes = amplitudes.collect::<Result<Vec<_>, _>>()?;
    let spectra: Vec<SpectraOverSpeed> = runs
        .iter()
        .zip(rpm.iter().zip(&amplitudes))
        .map(|(run, (rpm, amplitude))| SpectraOverSpeed {
            name: run.name,
            rpm,
            hz: &run.found.spectrogram.frequencies,
            amplitude,
        })
        .collect();
    let panels = waterfall_panels(&spectra, shown.factor);
    if !panels.is_empty() {
        let figure = Waterfall { title: title.into(), note, panels, unit: shown.name.into(), orders };
        figures.push(("waterfall", Figure::Waterfall(figure)));
    }
    Ok(figures)
}

pub fn orders(found: &OrderResult, phases: Option<&CagePhaseBand>, machine: &Machine) -> Vec<Named> {
    let band_of = |label: &str| -> Vec<[f64; 2]> {
        let channel = phases.and_then(|p| p.channels.iter().find(|c| c.channel == found.channel));
        let line = channel.and_then(|c| c.lines.iter().find(|l| l.line.label == label));
        let factor = unit(&found.unit).factor;
        line.map_or_else(Vec::new, |l| {
            l.minimum.iter().zip(&l.maximum).map(|(lo, hi)| [lo * factor, hi * factor]).collect()
        })
    };
    let s = &found.spectrogram;
    let shown = unit(&found.unit);
    let note = machine.model.title.clone();
    let lines: Vec<results::OrderLine> = found.cuts.iter().map(|(line, _)| line.clone()).collect();
    let span_db =
        machine.model.studies.spectrogram.as_ref().map_or(DYNAMIC_RANGE_DB, |study| study.dynamic_range_db);
    let map = OrderMap {
        title: format!("Order map of the run-up, {}", found.channel),
        note: note.clone(),
        rpm: s.rpm.clone(),
        time: s.times.clone(),
        order: s.orders.clone(),
        level_db: decibels_of(&s.amplitude, shown),
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
        let note = match phases {
            None => note,
            Some(p) => format!("{note}; bands: range over {} initial cage phases", p.angles.len()),
        };
        let figure = Lines {
            title: format!("Order cuts of the run-up, {}", found.channel),
            note,
            x_name: "shaft speed".into(),
            x_unit: "rpm".into(),
            y_name: format!("{}, RMS", quantity(&found.unit)),
            y_unit: shown.name.into(),
            curves: curves.collect(),
            bands: found.cuts.iter().map(|(line, _)| band_of(&line.label)).collect(),
            log_x: false,
            log_y: true,
            ..Lines::default()
        };
        figures.push((format!("order_cuts_{}", found.channel), Figure::Lines(figure)));
    }
    if let Some(tracks) = &found.tracks {
        let lines: Vec<_> = lines.iter().collect();
        let title = format!("Order tracks of the run-up, {}", found.channel);
        let shown = Shown { quantity: quantity(&found.unit), unit: shown.name, factor: shown.factor };
        let figure = order_tracks(tracks, &lines, &title, &machine.model.title, shown);
        figures.push((format!("order_tracks_{}", found.channel), figure));
    }
    figures
}

fn reference(shown: DisplayUnit) -> String {
    format!("dB re 1 {}", shown.name)
}
