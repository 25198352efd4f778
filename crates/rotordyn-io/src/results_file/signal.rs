//! Signal analyses of records as one HDF5 file, `signal.h5`.
//!
//! | group | contents |
//! |---|---|
//! | `/meta` | attributes: schema, program, version, git, file, command |
//! | `/compared_record/<channel>` | the channel of the compared record |
//! | `/<channel>` | attributes: unit, sample_rate, start, statistics, speed, bearing and its orders, diagnosis |
//! | `.../record`, `.../speed` | the samples analysed; the shaft's speed over time |
//! | `.../spectrum`, `.../density`, `.../envelope`, `.../spectral_kurtosis` | values over their axis |
//! | `.../kurtogram`, `.../band_scores` | low, high, level, value of every band |
//! | `.../spectrogram`, `.../orders`, `.../cyclic_coherence` | spectrogram, order map, cyclic spectral coherence, with their axes as dimension scales |
//! | `.../cepstrum`, `.../jerk`, `.../folded_jerk`, `.../synchronous_average` | curves; jerk folded over the ball passages, time-synchronous average |
//! | `.../lines` | one row for every bearing defect line searched |

use super::{GroupWriter, SCHEMA};
use crate::error::Error;
use crate::hdf5::Store;
use rotordyn_core::results::{EnvelopeResult, JerkResult, SignalResult};
use rotordyn_signal::bearing_lines::{BearingLine, Modulation};
use rotordyn_signal::diagnosis::BandRule;
use rotordyn_signal::kurtogram::Kurtogram;
use rotordyn_signal::race_defects::DefectKind;
use rotordyn_signal::spectrum::Spectrum;

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
    compared: Option<&SignalResult>,
) -> Result<(), Error> {
    let writer = GroupWriter::new(store, "/meta")?;
    writer.set_attribute("schema", SCHEMA)?;
    writer.set_attribute("program", "rotordyn")?;
    writer.set_attribute("version", env!("CARGO_PKG_VERSION"))?;
    writer.set_attribute("git", option_env!("ROTORDYN_GIT").unwrap_or("unknown"))?;
    writer.set_attribute("file", meta.file)?;
    writer.set_attribute("command", meta.command)?;
    writer.set_attribute(
        "units",
        "SI where the record's unit is known; frequencies in Hz, orders per revolution of the shaft",
    )?;
    results.iter().try_for_each(|result| channel(store, "", result))?;
    compared.map_or(Ok(()), |other| channel(store, "/compared_record", other))?;
    store.flush()
}

fn channel(store: &Store, parent: &str, r: &SignalResult) -> Result<(), Error> {
    let writer = GroupWriter::new(store, &format!("{parent}/{}", r.channel.replace('/', "_")))?;
    writer.set_attribute("unit", r.unit.as_str())?;
    writer.set_attribute("sample_rate", r.sample_rate)?;
    writer.set_attribute("start", r.start)?;
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
        writer.set_attribute(name, value)?;
    }
    if let Some(shaft) = &r.shaft {
        writer.set_attribute("speed_source", shaft.source.as_str())?;
        for (name, speed) in [("speed", shaft.mean), ("min_speed", shaft.min), ("max_speed", shaft.max)] {
            writer.set_attribute(name, std::f64::consts::TAU * speed)?;
        }
    }
    let [time, rpm] = &r.speed;
    if !time.is_empty() {
        let at = writer.subgroup("speed")?;
        at.write_array("rpm", &[rpm.len()], rpm, "rpm")?;
        at.write_array("time", &[time.len()], time, "s")?;
        at.attach_scale("rpm", 0, "time")?;
    }
    if let Some(b) = &r.bearing {
        writer.set_attribute("bearing", b.name.as_str())?;
        let o = b.orders;
        for (name, order) in [("ftf", o.ftf), ("bpfo", o.bpfo), ("bpfi", o.bpfi), ("bsf", o.bsf)] {
            writer.set_attribute(name, order)?;
        }
    }
    let unit = r.unit.as_str();
    writer.write_array("record", &[r.samples.len()], &r.samples, unit)?;
    if let Some(found) = &r.spectrum {
        over_axis(&writer, "spectrum", found, "frequency", "Hz", unit)?;
    }
    if let Some(found) = &r.density {
        over_axis(&writer, "density", found, "frequency", "Hz", &format!("({unit})^2/Hz"))?;
    }
    if let Some(found) = &r.spectrogram {
        let map = &found.map;
        let at = writer.subgroup("spectrogram")?;
        let (frames, bins) = (map.times.len(), map.frequencies.len());
        at.write_array("amplitude", &[frames, bins], &map.amplitude, unit)?;
        at.write_array("time", &[frames], &map.times, "s")?;
        at.write_array("frequency", &[bins], &map.frequencies, "Hz")?;
        at.attach_scale("amplitude", 0, "time")?;
        at.attach_scale("amplitude", 1, "frequency")?;
        if !found.rpm.is_empty() {
            at.write_array("rpm", &[frames], &found.rpm, "rpm")?;
        }
    }
    if let Some(found) = &r.envelope {
        envelope(&writer, found, unit)?;
    }
    if let Some(found) = &r.kurtogram {
        bands(&writer, "kurtogram", &found.kurtogram, "1")?;
        over_axis(&writer, "spectral_kurtosis", &found.spectral, "frequency", "Hz", "1")?;
    }
    if let Some(c) = &r.cepstrum {
        let at = writer.subgroup("cepstrum")?;
        at.write_array("values", &[c.values.len()], &c.values, "1")?;
        at.write_array("quefrency", &[c.values.len()], &c.quefrencies, "s")?;
        at.attach_scale("values", 0, "quefrency")?;
    }
    if let Some(found) = &r.jerk {
        jerk(&writer, found, unit)?;
    }
    if let Some(found) = &r.orders {
        let at = writer.subgroup("orders")?;
        let (windows, bins) = (found.map.times.len(), found.map.orders.len());
        at.write_array("amplitude", &[windows, bins], &found.map.amplitude, unit)?;
        at.write_array("rpm", &[windows], &found.map.rpm, "rpm")?;
        at.write_array("time", &[windows], &found.map.times, "s")?;
        at.write_array("order", &[bins], &found.map.orders, "1/revolution")?;
        at.write_array("average", &[bins], &found.average, unit)?;
        at.attach_scale("amplitude", 0, "rpm")?;
        at.attach_scale("amplitude", 0, "time")?;
        at.attach_scale("amplitude", 1, "order")?;
        at.attach_scale("average", 0, "order")?;
    }
    if let Some(found) = &r.average {
        let at = writer.subgroup("synchronous_average")?;
        let count = found.average.mean.len();
        let angle: Vec<f64> = (0..count).map(|k| std::f64::consts::TAU * k as f64 / count as f64).collect();
        at.set_attribute("revolutions", found.average.periods as i64)?;
        at.write_array("mean", &[count], &found.average.mean, unit)?;
        at.write_array("deviation", &[count], &found.average.deviation, unit)?;
        at.write_array("angle", &[count], &angle, "rad")?;
        at.attach_scale("mean", 0, "angle")?;
        at.attach_scale("deviation", 0, "angle")?;
    }
    if let Some(found) = &r.cyclic {
        let at = writer.subgroup("cyclic_coherence")?;
        let c = &found.coherence;
        let (rates, carriers) = (c.cyclic_frequencies.len(), c.frequencies.len());
        at.set_attribute("threshold_1_percent", c.one_percent_threshold)?;
        at.set_attribute("duration", found.duration)?;
        at.write_array("squared_coherence", &[rates, carriers], &c.squared, "1")?;
        at.write_array("cyclic_frequency", &[rates], &c.cyclic_frequencies, "Hz")?;
        at.write_array("frequency", &[carriers], &c.frequencies, "Hz")?;
        at.write_array("enhanced_envelope_spectrum", &[rates], &found.enhanced.values, "1")?;
        at.attach_scale("squared_coherence", 0, "cyclic_frequency")?;
        at.attach_scale("squared_coherence", 1, "frequency")?;
        at.attach_scale("enhanced_envelope_spectrum", 0, "cyclic_frequency")?;
    }
    Ok(())
}

fn over_axis(
    writer: &GroupWriter,
    name: &str,
    spectrum: &Spectrum,
    axis: &str,
    axis_unit: &str,
    unit: &str,
) -> Result<(), Error> {
    let at = writer.subgroup(name)?;
    let count = spectrum.values.len();
    at.set_attribute("noise_bandwidth", spectrum.noise_bandwidth_hz)?;
    at.write_array("values", &[count], &spectrum.values, unit)?;
    at.write_array(axis, &[count], &spectrum.frequencies, axis_unit)?;
    at.attach_scale("values", 0, axis)
}

fn bands(writer: &GroupWriter, name: &str, kurtogram: &Kurtogram, unit: &str) -> Result<(), Error> {
    let at = writer.subgroup(name)?;
    let bands: Vec<_> = kurtogram.bands().collect();
    let column =
        |pick: fn(&rotordyn_signal::kurtogram::BandChoice) -> f64| bands.iter().map(pick).collect::<Vec<_>>();
    for (name, values, unit) in [
        ("low", column(|b| b.low), "Hz"),
        ("high", column(|b| b.high), "Hz"),
        ("level", column(|b| b.level), "1"),
        ("value", column(|b| b.value), unit),
    ] {
        at.write_array(name, &[values.len()], &values, unit)?;
    }
    Ok(())
}

fn envelope(writer: &GroupWriter, found: &EnvelopeResult, unit: &str) -> Result<(), Error> {
    let (axis, axis_unit) = if found.over_orders { ("order", "1/revolution") } else { ("frequency", "Hz") };
    over_axis(writer, "envelope", &found.spectrum, axis, axis_unit, unit)?;
    writer.set_attribute("band_low", found.band.0)?;
    writer.set_attribute("band_high", found.band.1)?;
    if let Some(compared) = &found.band_scores {
        bands(writer, "band_scores", compared, if found.rule == BandRule::Lines { "dB" } else { "1" })?;
    }
    let Some(lines) = &found.lines else { return Ok(()) };
    writer.set_attribute("diagnosis", lines.diagnosis_name())?;
    let at = writer.subgroup("lines")?;
    let all: Vec<&BearingLine> = lines.families.iter().flat_map(|f| &f.lines).collect();
    let names: Vec<String> = all.iter().map(|l| line_name(l)).collect();
    at.write_texts("name", &[names.len()], &names)?;
    let column = |pick: fn(&BearingLine) -> f64| all.iter().map(|l| pick(l)).collect::<Vec<_>>();
    for (name, values, unit) in [
        ("expected", column(|l| l.expected), axis_unit),
        ("measured", column(|l| l.frequency), axis_unit),
        ("amplitude", column(|l| l.amplitude), unit),
        ("background", column(|l| l.background), unit),
        ("level", column(|l| l.level_db), "dB"),
        ("probability", column(|l| l.probability), "1"),
        ("significant_not_coincident", column(|l| f64::from(u8::from(l.significant && !l.shared))), "1"),
    ] {
        at.write_array(name, &[values.len()], &values, unit)?;
    }
    Ok(())
}

fn line_name(line: &BearingLine) -> String {
    let side = match line.modulation {
        None => String::new(),
        Some(Modulation::Shaft(n)) => format!(" {n:+} fr"),
        Some(Modulation::Cage(n)) => format!(" {n:+} FTF"),
    };
    format!("{} {}{side}", line.harmonic, line.part.line_name())
}

fn jerk(writer: &GroupWriter, found: &JerkResult, unit: &str) -> Result<(), Error> {
    let at = writer.subgroup("jerk")?;
    let unit = format!("{unit}/s");
    at.write_array("jerk", &[found.jerk.len()], &found.jerk, &unit)?;
    let times: Vec<f64> = found.jumps.iter().map(|j| j.time).collect();
    let sizes: Vec<f64> = found.jumps.iter().map(|j| j.size).collect();
    if !times.is_empty() {
        at.write_array("jump_time", &[times.len()], &times, "s")?;
        at.write_array("jump_size", &[sizes.len()], &sizes, &unit)?;
    }
    let Some(race) = &found.race else { return Ok(()) };
    let at = writer.subgroup("folded_jerk")?;
    at.set_attribute("race", race.race)?;
    at.write_array("angle", &[race.fold.angles.len()], &race.fold.angles, "rad")?;
    at.write_complex("jerk_change", &[race.fold.changes.len()], &race.fold.changes, &unit)?;
    at.attach_scale("jerk_change", 0, "angle")?;
    if race.defects.is_empty() {
        return Ok(());
    }
    let count = race.defects.len();
    let column = |pick: fn(&rotordyn_signal::race_defects::RaceDefect) -> f64| {
        race.defects.iter().map(pick).collect::<Vec<_>>()
    };
    at.write_array("defect_angle", &[count], &column(|d| d.angle), "rad")?;
    at.write_array("defect_width", &[count], &column(|d| d.width), "rad")?;
    let kind = |d: &rotordyn_signal::race_defects::RaceDefect| match d.kind {
        DefectKind::Dent => "dent",
        DefectKind::Bump => "bump",
    };
    at.write_texts("defect_kind", &[count], &race.defects.iter().map(kind).collect::<Vec<_>>())
}
