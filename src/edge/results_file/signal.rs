//! Signal analyses of records as one HDF5 file, `signal.h5`.
//!
//! | group | contents |
//! |---|---|
//! | `/meta` | attributes: program, version, git, file, command |
//! | `/against/<channel>` | the channel of the compared record |
//! | `/<channel>` | attributes: unit, sample_rate, start, statistics, speed, bearing and its orders, verdict |
//! | `.../record`, `.../speed` | the samples analysed; the shaft's speed over time |
//! | `.../spectrum`, `.../density`, `.../envelope`, `.../spectral_kurtosis` | values over their axis |
//! | `.../kurtogram`, `.../band_scores` | low, high, level, value of every band |
//! | `.../spectrogram`, `.../orders`, `.../cyclic` | spectrogram, order map, cyclic spectral coherence, with their axes as dimension scales |
//! | `.../cepstrum`, `.../jerk`, `.../folded_jerk`, `.../average` | curves; jerk folded over the ball passages, time-synchronous average |
//! | `.../lines` | one row for every bearing defect line searched |

use super::Place;
use crate::edge::hdf5::Store;
use crate::error::Error;
use crate::results::{EnvelopeResult, JerkResult, SignalResult};
use crate::signal::bearing_lines::{BearingLine, Modulation};
use crate::signal::diagnosis::BandRule;
use crate::signal::kurtogram::Kurtogram;
use crate::signal::race_defects::DefectKind;
use crate::signal::spectrum::Spectrum;

/// Provenance of results.
#[derive(Clone, Copy, Debug)]
pub struct SignalMeta<'a> {
    pub file: &'a str,
    /// The command's arguments.
    pub command: &'a str,
}

/// Writes the results of every channel, and of the channel of another record for comparison.
///
/// # Errors
/// The file cannot be written.
pub fn write_signal(
    store: &Store,
    meta: &SignalMeta,
    results: &[SignalResult],
    against: Option<&SignalResult>,
) -> Result<(), Error> {
    let place = Place::new(store, "/meta")?;
    place.note("program", "rotordyn")?;
    place.note("version", env!("CARGO_PKG_VERSION"))?;
    place.note("git", option_env!("ROTORDYN_GIT").unwrap_or("unknown"))?;
    place.note("file", meta.file)?;
    place.note("command", meta.command)?;
    place.note(
        "units",
        "SI where the record's unit is known; frequencies in Hz, orders per revolution of the shaft",
    )?;
    results.iter().try_for_each(|result| channel(store, "", result))?;
    against.map_or(Ok(()), |other| channel(store, "/against", other))?;
    store.flush()
}

fn channel(store: &Store, above: &str, r: &SignalResult) -> Result<(), Error> {
    let place = Place::new(store, &format!("{above}/{}", r.channel.replace('/', "_")))?;
    place.note("unit", r.unit.as_str())?;
    place.note("sample_rate", r.sample_rate)?;
    place.note("start", r.start)?;
    let s = &r.statistics;
    let optional = |v: Option<f64>| v.unwrap_or(f64::NAN);
    for (name, value) in [
        ("mean", s.mean),
        ("standard_deviation", s.standard_deviation),
        ("rms", s.rms),
        ("peak", s.peak),
        ("crest_factor", optional(s.crest_factor)),
        ("kurtosis", optional(s.kurtosis)),
        ("skewness", optional(s.skewness)),
    ] {
        place.note(name, value)?;
    }
    if let Some(shaft) = &r.shaft {
        place.note("speed_source", shaft.source.as_str())?;
        for (name, speed) in [("speed", shaft.mean), ("least_speed", shaft.least), ("most_speed", shaft.most)]
        {
            place.note(name, std::f64::consts::TAU * speed)?;
        }
    }
    let [time, rpm] = &r.speed;
    if !time.is_empty() {
        let at = place.below("speed")?;
        at.array("rpm", &[rpm.len()], rpm, "rpm")?;
        at.array("time", &[time.len()], time, "s")?;
        at.axis("rpm", 0, "time")?;
    }
    if let Some(b) = &r.bearing {
        place.note("bearing", b.name.as_str())?;
        let o = b.orders;
        for (name, order) in [("ftf", o.ftf), ("bpfo", o.bpfo), ("bpfi", o.bpfi), ("bsf", o.bsf)] {
            place.note(name, order)?;
        }
    }
    let unit = r.unit.as_str();
    place.array("record", &[r.samples.len()], &r.samples, unit)?;
    if let Some(found) = &r.spectrum {
        over_axis(&place, "spectrum", found, "frequency", "Hz", unit)?;
    }
    if let Some(found) = &r.density {
        over_axis(&place, "density", found, "frequency", "Hz", &format!("({unit})^2/Hz"))?;
    }
    if let Some(found) = &r.spectrogram {
        let map = &found.map;
        let at = place.below("spectrogram")?;
        let (frames, bins) = (map.times.len(), map.frequencies.len());
        at.array("amplitude", &[frames, bins], &map.amplitude, unit)?;
        at.array("time", &[frames], &map.times, "s")?;
        at.array("frequency", &[bins], &map.frequencies, "Hz")?;
        at.axis("amplitude", 0, "time")?;
        at.axis("amplitude", 1, "frequency")?;
        if !found.rpm.is_empty() {
            at.array("rpm", &[frames], &found.rpm, "rpm")?;
        }
    }
    if let Some(found) = &r.envelope {
        envelope(&place, found, unit)?;
    }
    if let Some(found) = &r.kurtogram {
        bands(&place, "kurtogram", &found.kurtogram, "1")?;
        over_axis(&place, "spectral_kurtosis", &found.spectral, "frequency", "Hz", "1")?;
    }
    if let Some(c) = &r.cepstrum {
        let at = place.below("cepstrum")?;
        at.array("values", &[c.values.len()], &c.values, "1")?;
        at.array("quefrency", &[c.values.len()], &c.quefrencies, "s")?;
        at.axis("values", 0, "quefrency")?;
    }
    if let Some(found) = &r.jerk {
        jerk(&place, found, unit)?;
    }
    if let Some(found) = &r.orders {
        let at = place.below("orders")?;
        let (windows, bins) = (found.map.times.len(), found.map.orders.len());
        at.array("amplitude", &[windows, bins], &found.map.amplitude, unit)?;
        at.array("rpm", &[windows], &found.map.rpm, "rpm")?;
        at.array("time", &[windows], &found.map.times, "s")?;
        at.array("order", &[bins], &found.map.orders, "1/revolution")?;
        at.array("average", &[bins], &found.average, unit)?;
        at.axis("amplitude", 0, "rpm")?;
        at.axis("amplitude", 0, "time")?;
        at.axis("amplitude", 1, "order")?;
        at.axis("average", 0, "order")?;
    }
    if let Some(found) = &r.average {
        let at = place.below("average")?;
        let count = found.average.mean.len();
        let angle: Vec<f64> = (0..count).map(|k| std::f64::consts::TAU * k as f64 / count as f64).collect();
        at.note("turns", found.average.periods as i64)?;
        at.array("mean", &[count], &found.average.mean, unit)?;
        at.array("deviation", &[count], &found.average.deviation, unit)?;
        at.array("angle", &[count], &angle, "rad")?;
        at.axis("mean", 0, "angle")?;
        at.axis("deviation", 0, "angle")?;
    }
    if let Some(found) = &r.cyclic {
        let at = place.below("cyclic")?;
        let c = &found.coherence;
        let (rates, carriers) = (c.cyclic_frequencies.len(), c.frequencies.len());
        at.note("one_percent", c.one_percent)?;
        at.note("duration", found.duration)?;
        at.array("squared_coherence", &[rates, carriers], &c.squared, "1")?;
        at.array("cyclic_frequency", &[rates], &c.cyclic_frequencies, "Hz")?;
        at.array("frequency", &[carriers], &c.frequencies, "Hz")?;
        at.array("enhanced", &[rates], &found.enhanced.values, "1")?;
        at.axis("squared_coherence", 0, "cyclic_frequency")?;
        at.axis("squared_coherence", 1, "frequency")?;
        at.axis("enhanced", 0, "cyclic_frequency")?;
    }
    Ok(())
}

fn over_axis(
    place: &Place,
    name: &str,
    spectrum: &Spectrum,
    axis: &str,
    axis_unit: &str,
    unit: &str,
) -> Result<(), Error> {
    let at = place.below(name)?;
    let count = spectrum.values.len();
    at.note("noise_bandwidth", spectrum.noise_bandwidth_hz)?;
    at.array("values", &[count], &spectrum.values, unit)?;
    at.array(axis, &[count], &spectrum.frequencies, axis_unit)?;
    at.axis("values", 0, axis)
}

fn bands(place: &Place, name: &str, kurtogram: &Kurtogram, unit: &str) -> Result<(), Error> {
    let at = place.below(name)?;
    let bands: Vec<_> = kurtogram.bands().collect();
    let column =
        |pick: fn(&crate::signal::kurtogram::BandChoice) -> f64| bands.iter().map(pick).collect::<Vec<_>>();
    for (name, values, unit) in [
        ("low", column(|b| b.low), "Hz"),
        ("high", column(|b| b.high), "Hz"),
        ("level", column(|b| b.level), "1"),
        ("value", column(|b| b.value), unit),
    ] {
        at.array(name, &[values.len()], &values, unit)?;
    }
    Ok(())
}

fn envelope(place: &Place, found: &EnvelopeResult, unit: &str) -> Result<(), Error> {
    let (axis, axis_unit) = if found.over_orders { ("order", "1/revolution") } else { ("frequency", "Hz") };
    over_axis(place, "envelope", &found.spectrum, axis, axis_unit, unit)?;
    place.note("band_low", found.band.0)?;
    place.note("band_high", found.band.1)?;
    if let Some(compared) = &found.compared {
        bands(place, "band_scores", compared, if found.rule == BandRule::Lines { "dB" } else { "1" })?;
    }
    let Some(lines) = &found.lines else { return Ok(()) };
    place.note("verdict", lines.verdict_name())?;
    let at = place.below("lines")?;
    let all: Vec<&BearingLine> = lines.families.iter().flat_map(|f| &f.lines).collect();
    let names: Vec<String> = all.iter().map(|l| name(l)).collect();
    at.texts("name", &[names.len()], &names)?;
    let column = |pick: fn(&BearingLine) -> f64| all.iter().map(|l| pick(l)).collect::<Vec<_>>();
    for (name, values, unit) in [
        ("expected", column(|l| l.expected), axis_unit),
        ("at", column(|l| l.frequency), axis_unit),
        ("amplitude", column(|l| l.amplitude), unit),
        ("background", column(|l| l.background), unit),
        ("level", column(|l| l.level_db), "dB"),
        ("probability", column(|l| l.probability), "1"),
        ("own", column(|l| f64::from(u8::from(l.significant && !l.shared))), "1"),
    ] {
        at.array(name, &[values.len()], &values, unit)?;
    }
    Ok(())
}

fn name(line: &BearingLine) -> String {
    let side = match line.modulation {
        None => String::new(),
        Some(Modulation::Shaft(n)) => format!(" {n:+} fr"),
        Some(Modulation::Cage(n)) => format!(" {n:+} FTF"),
    };
    format!("{} {}{side}", line.harmonic, line.part.line_name())
}

fn jerk(place: &Place, found: &JerkResult, unit: &str) -> Result<(), Error> {
    let at = place.below("jerk")?;
    let unit = format!("{unit}/s");
    at.array("jerk", &[found.jerk.len()], &found.jerk, &unit)?;
    let times: Vec<f64> = found.jumps.iter().map(|j| j.time).collect();
    let sizes: Vec<f64> = found.jumps.iter().map(|j| j.size).collect();
    if !times.is_empty() {
        at.array("jump_time", &[times.len()], &times, "s")?;
        at.array("jump_size", &[sizes.len()], &sizes, &unit)?;
    }
    let Some(race) = &found.race else { return Ok(()) };
    let at = place.below("folded_jerk")?;
    at.note("race", race.race)?;
    at.array("angle", &[race.fold.angles.len()], &race.fold.angles, "rad")?;
    at.complex("change", &[race.fold.changes.len()], &race.fold.changes, &unit)?;
    at.axis("change", 0, "angle")?;
    if race.defects.is_empty() {
        return Ok(());
    }
    let count = race.defects.len();
    let column = |pick: fn(&crate::signal::race_defects::RaceDefect) -> f64| {
        race.defects.iter().map(pick).collect::<Vec<_>>()
    };
    at.array("defect_angle", &[count], &column(|d| d.angle), "rad")?;
    at.array("defect_width", &[count], &column(|d| d.width), "rad")?;
    let kind = |d: &crate::signal::race_defects::RaceDefect| match d.kind {
        DefectKind::Dent => "dent",
        DefectKind::Bump => "bump",
    };
    at.texts("defect_kind", &[count], &race.defects.iter().map(kind).collect::<Vec<_>>())
}
