//! Signal analyses of records as JSON: the document "rotordyn-signal-2".
//!
//! Frequencies and rates in Hz, times in s, angles in rad, amplitudes in the channel's unit; maps and spectra
//! are in the HDF5 file. Per channel in `channels`, and for the channel of the compared record in
//! `compared_record`:
//!
//! | key | contents |
//! |---|---|
//! | `channel`, `unit`, `sample_rate_hz`, `start_s`, `samples` | what was analysed |
//! | `shaft` | `source`, `mean_rpm`, `min_rpm`, `max_rpm`, `steady` |
//! | `speed` | `time_s`, `rpm`, if the shaft's angle is known |
//! | `bearing` | `name`, `source`, `balls`, `orders` {ftf, bpfo, bpfi, bsf} |
//! | `statistics` | mean, rms, peak, crest_factor, kurtosis, skewness, ... |
//! | `spectrum`, `density` | `peaks` \[{frequency_hz, amplitude}\], highest first; `resolution_hz` |
//! | `envelope` | `band_hz`, `rule`, `axis` "Hz" or "order", `diagnosis`, `peaks` \[{measured, amplitude}\], `strongest`, `families` \[{part, line, expected, fitted, detected, strength, lines}\]; a line: {line, harmonic, sideband_of, sideband_order, expected, measured, amplitude, background, level_db, probability, significant, coincident: a shaft harmonic or a stronger family has a line there} |
//! | `kurtogram` | `best` {low_hz, high_hz, kurtosis}, `spectral_kurtosis` {frequency_hz, value} at its highest |
//! | `cepstrum` | `peaks` \[{quefrency_s, value}\] |
//! | `jerk` | `jumps`: their number, `race`, `full_circumference`, `defects` \[{kind, angle, width, width_m}\] |
//! | `orders` | `cuts` \[{label, order, rpm, rms}\] |
//! | `synchronous_average` | time-synchronous average: `revolutions`, `rms` {record, synchronous_average, residual} |
//! | `cyclic_coherence` | cyclic spectral coherence: `duration_s`, `lines` \[{line, harmonic, expected_hz, peak_hz, coherence, background, z_score}\] |

use serde_json::{Map, Value, json};

use rotordyn_core::results::{EnvelopeResult, JerkResult, SignalResult};
use rotordyn_signal::bearing_lines::{BearingLine, Modulation};
use rotordyn_signal::diagnosis::BandRule;
use rotordyn_signal::race_defects::DefectKind;
use rotordyn_signal::ridge::find_peaks;

/// Number of spectral peaks listed.
const MAX_PEAKS: usize = 20;

/// The results of every channel as one document; `compared`: the channel of the compared record.
pub fn signal_to_json(results: &[SignalResult], compared: Option<&SignalResult>) -> Value {
    let mut out = json!({
        "schema": "rotordyn-signal-2",
        "program": "rotordyn",
        "version": env!("CARGO_PKG_VERSION"),
        "channels": results.iter().map(channel).collect::<Vec<_>>(),
    });
    if let Some(other) = compared {
        out["compared_record"] = channel(other);
    }
    out
}

fn channel(r: &SignalResult) -> Value {
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| out.insert(key.into(), value);
    put("channel", json!(r.channel));
    put("unit", json!(r.unit));
    put("sample_rate_hz", json!(r.sample_rate));
    put("start_s", json!(r.start));
    put("samples", json!(r.samples.len()));
    if let Some(s) = &r.shaft {
        let rpm = |rev: f64| 60.0 * rev;
        put(
            "shaft",
            json!({
                "source": s.source, "mean_rpm": rpm(s.mean), "min_rpm": rpm(s.min), "max_rpm": rpm(s.max),
                "steady": s.steady,
            }),
        );
    }
    let [time, rpm] = &r.speed;
    if !time.is_empty() {
        put("speed", json!({ "time_s": time, "rpm": rpm }));
    }
    if let Some(b) = &r.bearing {
        let o = &b.orders;
        put(
            "bearing",
            json!({
                "name": b.name, "source": b.source, "balls": b.balls,
                "orders": { "ftf": o.ftf, "bpfo": o.bpfo, "bpfi": o.bpfi, "bsf": o.bsf },
            }),
        );
    }
    let s = &r.statistics;
    put(
        "statistics",
        json!({
            "mean": s.mean, "standard_deviation": s.standard_deviation, "rms": s.rms, "peak": s.peak,
            "peak_to_peak": s.peak_to_peak, "crest_factor": s.crest_factor, "mean_absolute": s.mean_absolute,
            "shape_factor": s.shape_factor, "impulse_factor": s.impulse_factor,
            "clearance_factor": s.clearance_factor, "skewness": s.skewness, "kurtosis": s.kurtosis,
        }),
    );
    for (key, spectrum) in [("spectrum", &r.spectrum), ("density", &r.density)] {
        if let Some(s) = spectrum {
            let peaks = highest_peaks(&s.frequencies, &s.values, "frequency_hz", "amplitude");
            put(key, json!({ "resolution_hz": s.frequencies[1] - s.frequencies[0], "peaks": peaks }));
        }
    }
    if let Some(found) = &r.envelope {
        put("envelope", envelope(found));
    }
    if let Some(found) = &r.kurtogram {
        let best = found.kurtogram.best();
        let s = &found.spectral;
        let top = (1..s.values.len() - 1).max_by(|&a, &b| s.values[a].total_cmp(&s.values[b])).unwrap_or(0);
        put(
            "kurtogram",
            json!({
                "best": { "low_hz": best.low, "high_hz": best.high, "kurtosis": best.value },
                "spectral_kurtosis": { "frequency_hz": s.frequencies[top], "value": s.values[top] },
            }),
        );
    }
    if let Some(c) = &r.cepstrum {
        put("cepstrum", json!({ "peaks": highest_peaks(&c.quefrencies, &c.values, "quefrency_s", "value") }));
    }
    if let Some(found) = &r.jerk {
        put("jerk", jerk(found));
    }
    if let Some(found) = &r.orders {
        let cuts = found.cuts.iter().map(
            |(line, cut)| json!({ "label": line.label, "order": line.order, "rpm": cut.rpm, "rms": cut.rms }),
        );
        put("orders", json!({ "cuts": cuts.collect::<Vec<_>>() }));
    }
    if let Some(found) = &r.average {
        let [record, average, residual] = found.rms;
        put(
            "synchronous_average",
            json!({
                "revolutions": found.average.periods,
                "rms": { "record": record, "synchronous_average": average, "residual": residual },
            }),
        );
    }
    if let Some(found) = &r.cyclic {
        let lines = found.lines.iter().map(|l| {
            json!({
                "line": l.part.line_name(), "harmonic": l.harmonic, "expected_hz": l.expected, "peak_hz": l.rate,
                "coherence": l.coherence, "background": l.background, "z_score": l.deviations,
            })
        });
        put("cyclic_coherence", json!({ "duration_s": found.duration, "lines": lines.collect::<Vec<_>>() }));
    }
    put("warnings", json!(r.warnings));
    Value::Object(out)
}

/// The highest local maxima beyond the first bin.
fn highest_peaks(axis: &[f64], values: &[f64], position_key: &str, amplitude_key: &str) -> Vec<Value> {
    let mut found = find_peaks(axis, values, f64::NEG_INFINITY).unwrap_or_default();
    found.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    let entry = |p: &rotordyn_signal::ridge::Peak| {
        Value::Object(Map::from_iter([
            (position_key.to_string(), json!(p.position)),
            (amplitude_key.to_string(), json!(p.amplitude)),
        ]))
    };
    found.iter().take(MAX_PEAKS).map(entry).collect()
}

fn envelope(found: &EnvelopeResult) -> Value {
    let rule = match found.rule {
        BandRule::Given(..) => "given",
        BandRule::Whole => "full_band",
        BandRule::Kurtosis => "kurtosis",
        BandRule::Lines => "lines",
    };
    let mut out = json!({
        "band_hz": [found.band.0, found.band.1],
        "rule": rule,
        "axis": if found.over_orders { "order" } else { "Hz" },
    });
    let s = &found.spectrum;
    out["peaks"] = json!(highest_peaks(&s.frequencies, &s.values, "measured", "amplitude"));
    if let Some(lines) = &found.lines {
        out["diagnosis"] = json!(lines.diagnosis_name());
        out["strongest"] = lines.strongest_line().map_or(Value::Null, line);
        let families = lines.families.iter().map(|f| {
            json!({
                "part": f.part.name(), "line": f.part.line_name(), "expected": f.expected, "fitted": f.frequency,
                "detected": f.detected, "strength": f.strength, "lines": f.lines.iter().map(line).collect::<Vec<_>>(),
            })
        });
        out["families"] = families.collect();
    }
    out
}

fn line(l: &BearingLine) -> Value {
    let (sideband_of, sideband_order) = match l.modulation {
        None => (None, 0),
        Some(Modulation::Shaft(n)) => (Some("shaft"), n),
        Some(Modulation::Cage(n)) => (Some("cage"), n),
    };
    json!({
        "line": l.part.line_name(), "harmonic": l.harmonic, "sideband_of": sideband_of, "sideband_order": sideband_order,
        "expected": l.expected, "measured": l.frequency, "amplitude": l.amplitude, "background": l.background,
        "level_db": l.level_db, "probability": l.probability, "significant": l.significant, "coincident": l.shared,
    })
}

fn jerk(found: &JerkResult) -> Value {
    let mut out = json!({ "jumps": found.jumps.len() });
    if let Some(race) = &found.race {
        let defect = |d: &rotordyn_signal::race_defects::RaceDefect| {
            json!({
                "kind": match d.kind { DefectKind::Dent => "dent", DefectKind::Bump => "bump" },
                "angle": d.angle, "width": d.width, "width_m": race.radius.map(|r| r * d.width), "jumps": d.jumps,
            })
        };
        out["race"] = json!(race.race);
        out["full_circumference"] = json!(race.full_circumference);
        out["defects"] = race.defects.iter().map(defect).collect();
    }
    out
}
