//! Results as JSON, for other programs: the document "rotordyn-results-3".
//!
//! Frequencies in Hz, speeds in rpm, all else in SI; non-finite numbers are null. Keys of results that were
//! not computed are absent.
//!
//! | key | contents |
//! |---|---|
//! | `schema`, `program`, `version` | "rotordyn-results-3", "rotordyn", the program's version |
//! | `model`, `title` | name and title of the model |
//! | `units` | the unit of every quantity below |
//! | `estimated_geometry` | if the internal geometry of bearings is estimated: name of the bearing, how |
//! | `equilibrium` | `speed_rpm`, `residual_n`, `iterations`, `shaft` \[{z_m, u_x_m, u_y_m, shear_x_n, shear_y_n, moment_xz_nm, moment_yz_nm, axial_force_n, torque_nm, bending_stress_pa}\], `support_forces` \[{support, z_m, force: 6}\], `belts` \[{name, stated_pull_n: 2, pull_n: 2, remaining_share, displacement_m: 2}\], `preloads` \[{bearing, kind, stated_force_n, interference_m, spring_n_per_m, axial_force_n: per row, share: the least over the stated}\], `nodes` \[{node, displacement: 6}\], `bearings` \[{name, displacement: 6, force: 6, stiffness: 6×6, damping: 6×6, largest_ball_load_n, balls: \[{position_rad, load_n, contact_angle_rad, deflection_m}\]}\] |
//! | `modal` | per speed {speed_rpm, nodes (names), modes: \[{label, kind, eigenvalue {re, im} in 1/s, shape {re, im: 6 per node} with φᴴ M φ = 1, frequency_hz, damping_ratio, log_decrement, effective_mass: 3}\]} |
//! | `campbell` | `speeds_rpm`, `least_damped` \[{speed_rpm, log_decrement, label}\], `branches` \[{label, kind, labels, frequency_hz, log_decrement, eigenvalue {re, im}}\] over the speeds, `orders` \[{label, order}\], `crossings`, `crossings_omitted` \[{order, modes}\], `uncertain`, `lost_branches` \[{branch, from_rpm, to_rpm, continued_by}\], `thresholds` \[{speed_rpm, unstable_above, label}\] |
//! | `critical_speeds` | `max_speed_rpm`, `nodes` (names), `speeds` \[{speed_rpm, order, frequency_hz, damping_ratio, log_decrement, kind, label, eigenvalue {re, im}, shape {re, im: 6 per node}}\], also the form of `crossings`, without `shape`; `uncertain` \[{order, from_rpm, to_rpm}\] |
//! | `critical_map` | `max_speed_rpm`, `stiffness_n_per_m`, `curves` \[{mode, critical_speeds_rpm}\], `bearing_speeds_rpm`, `bearings` \[{bearing, stiffness_n_per_m}\], `crossings` \[{speed_rpm, mode, bearing, stiffness_n_per_m}\] |
//! | `torsional` | `max_speed_rpm`, `rigid_rotations`, `coupled`, `operating_speed_rpm`, `lowest_operating_speed_rpm`, `z_m`, `modes` \[{mode, frequency_hz, frequency_rpm, twist}\], `orders`, `interferences` \[{speed_rpm, mode, frequency_hz, order, separation, assessment}\] |
//! | `frf` | `speed_rpm`, `quantity`, `frequency_hz`, `requested` (indices of the requested frequencies), `undamped` \[{frequency_hz, label, responses}\], `functions` \[{excitation, response, unit, re, im}\] |
//! | `unbalance` | `speeds_rpm`, `requested` (indices of the requested speeds), `operating_speed_rpm`, `lowest_operating_speed_rpm`, `separation_margins` \[{speed_rpm, label, log_decrement, response, peak_rpm, amplification_factor, separation_margin, required_separation_margin, assessment}\], `bearing_forces` \[{bearing, x_re, x_im, y_re, y_im, at_rest_n: 2}\], `shaft` \[{at, speed_rpm, sections: \[{z_m, displacement_m, shear_n, moment_nm}\]}\], `peaks` \[{response, unit, speed_rpm, amplitude, amplification_factor, half_power_rpm: 2, separation_margin, required_separation_margin}\], `undamped` \[{speed_rpm, label, responses}\], `responses` \[{name, unit, re, im}\], `orbits` \[{disc, x_re, x_im, y_re, y_im}\]; x(t) = Re(X e^{jΩt}) |
//! | `run_up` | sizes and errors of the reduced model, `end`, `step_s`, `defect_step_s`, `requested_step_s`, `step_error`, `cage_angles` \[{bearing, initial_rad}\], `steps`, `iterations`, `halvings`, `energy_j` (`stored_*`: kinetic, strain and contact energy, zero at rest and undeformed; stored_change = work + drive_work + parametric_work − damping_loss − contact_loss + residual), `sample_rate_hz`, `samples`, `channels` \[{name, unit, quantity, station, direction, minimum, maximum, rms}\] |
//! | `spectrograms` | per channel {channel, unit, frames, frequencies, peak: {speed_rpm, frequency_hz, amplitude}}; the maps are in the HDF5 file |
//! | `orders` | per channel {channel, unit, cuts: \[{label, order, speed_rpm, rms}\]} |
//! | `cage_phases` | `bearings`, `angles_rad` per run, `channels` \[{channel, unit, cuts: \[{label, order, speed_rpm, rms, minimum, maximum, peaks}\]}\] |
//! | `poincare` | `speed_rpm`, `clock` {name, phase, frequency_hz}, `motion` {kind, period, recurrence, zero_one: 0-1 test for chaos, settled, residual: estimated distance from the motion it tends to relative to the orbit, decay_factor: per period}, `transient_periods`: periods discarded, `groups`, `planes` \[{name, axes, section: \[x, y\], orbit: extremes of x and y, whirl, clearance}\] |
//! | `lyapunov` | largest Lyapunov exponent: `speed_rpm`, `clock`, `exponent` {value, standard_error} in 1/s, `time_s`, `history` |
//! | `bifurcation` | `parameter` (paths), `unit`, `clock`, `channels`, `chunk_boundaries`, `rerun_chunks`, `complete`, `sweeps` \[{name, points: \[{value, motion, transient_periods, frequency_hz, sections, extremes, exponent} or {value, failure}\]}\] |
//! | `bearings` | per stand-alone ball bearing {name, load_source, estimated_geometry: if the internal geometry is estimated, how, ball_inertia, prescribed: 5, rating, preload: of the centred bearing, mounted_preload: as in `equilibrium`, nominal_orders, operating, films, warnings, sweeps: \[{variable, label, unit, values, points}\]}; a point: load: 5, displacement: 5, stiffness: 5×5, single values by the names of the HDF5 file with their units, balls \[{position, inner, outer}\] with loads, angles, ellipses, pressures, films, spinning, shoulder distances, and the motion of the ball (`controlling_race` 0 inner, 1 outer); all in SI, speeds in rad/s |
//! | `ball_inertia` | per study and bearing {study, bearing, stated, used, speed_rpm, centrifugal_force_n, largest_contact_load_n, ratio, limit}: ball inertia used at the highest speed, and why; one entry in `bearings` |
//! | `warnings` | list of {code, severity (caution, serious), item, text, advice} |
//! | `seconds`, `wall_seconds`, `cpu_seconds` | per study: elapsed time (twice, `seconds` is the former name) and processor time of all threads |

mod document;

pub use document::{add_sections, document, groups};

use rotordyn_core::document::{Document, Section};
use rotordyn_core::results::{BearingPoint, BearingResult, SignalResult, TrendResult};
use rotordyn_core::study::{Machine, Results};
use rotordyn_core::warning::Warning;
use serde_json::{Map, Value, json};

/// Name and version of the document's schema.
pub const SCHEMA: &str = "rotordyn-results-3";

/// The results as one document.
pub fn to_json(results: &Results, machine: &Machine) -> Value {
    let mut out = header(&machine.model.name, &machine.model.title);
    out.insert(
        "units".into(),
        json!({
            "speed": "rpm", "frequency": "Hz", "order": "1/revolution", "displacement": "m, rad",
            "force": "N, N m", "stiffness": "N/m, N, N m/rad", "damping": "N s/m, N s, N m s/rad",
            "damping_ratio": "1", "log_decrement": "1", "effective_mass": "share of the total mass",
            "energy": "J", "angle": "rad",
        }),
    );
    let estimated: Map<String, Value> =
        machine.model.estimated_geometries().map(|(name, how)| (name.to_string(), how.into())).collect();
    if !estimated.is_empty() {
        out.insert("estimated_geometry".into(), estimated.into());
    }
    add_sections(&mut out, &results.sections(&machine.assembly.dofs));
    out.entry("warnings").or_insert_with(|| json!([]));
    Value::Object(out)
}

/// Stand-alone ball bearings (no machine) as a document of the same schema.
pub fn bearings_to_json(results: &Results, name: &str, title: &str) -> Value {
    let mut out = header(name, title);
    let mut units: Map<String, Value> =
        BearingPoint::units().map(|(name, unit)| (name.to_string(), unit.into())).collect();
    for (quantity, unit) in [
        ("load", "N, N m"),
        ("displacement", "m, rad"),
        ("stiffness", "N/m, N, N m/rad"),
        ("angle", "rad"),
        ("pressure", "Pa"),
        ("geometry", "m, rad"),
        ("rating", "N"),
    ] {
        units.insert(quantity.into(), unit.into());
    }
    out.insert("units".into(), units.into());
    let sections: Vec<Section> = results.bearings.iter().map(BearingResult::section).collect();
    add_sections(&mut out, &sections);
    out.entry("bearings").or_insert_with(|| json!([]));
    out.insert("warnings".into(), warnings(&results.warnings));
    Value::Object(out)
}

/// A list of warnings.
pub fn warnings(found: &[Warning]) -> Value {
    document::document(&Document::new().with("", Warning::list(found)))
}

fn header(name: &str, title: &str) -> Map<String, Value> {
    let texts = [
        ("schema", SCHEMA),
        ("program", "rotordyn"),
        ("version", env!("CARGO_PKG_VERSION")),
        ("model", name),
        ("title", title),
    ];
    texts.iter().map(|(key, text)| ((*key).to_string(), json!(text))).collect()
}

/// Analyses of the channels of a record as a document "rotordyn-signal-2"; `compared`: the channel of the compared record.
///
/// Frequencies and rates in Hz, times in s, angles in rad, amplitudes in the channel's unit; maps and spectra are in the
/// HDF5 file. Per channel in `channels`, and for the channel of the compared record in `compared_record`:
///
/// | key | contents |
/// |---|---|
/// | `channel`, `unit`, `sample_rate_hz`, `start_s`, `samples` | what was analysed |
/// | `shaft` | `source`, `mean_rpm`, `min_rpm`, `max_rpm`, `steady` |
/// | `speed` | `time_s`, `rpm`, if the shaft's angle is known |
/// | `bearing` | `name`, `source`, `balls`, `orders` {ftf, bpfo, bpfi, bsf} |
/// | `statistics` | mean, rms, peak, crest_factor, kurtosis, skewness, ... |
/// | `spectrum`, `density` | `peaks` \[{frequency_hz, amplitude}\], highest first; `resolution_hz` |
/// | `envelope` | `band_hz`, `rule`, `axis` "Hz" or "order", `diagnosis`, `peaks` \[{measured, amplitude}\], `strongest`, `families` \[{part, line, expected, fitted, detected, strength, lines}\]; a line: {line, harmonic, sideband_of, sideband_order, expected, measured, amplitude, background, level_db, probability, significant, coincident: a shaft harmonic or a stronger family has a line there} |
/// | `kurtogram` | `best` {low_hz, high_hz, kurtosis}, `spectral_kurtosis` {frequency_hz, value} at its highest |
/// | `cepstrum` | `peaks` \[{quefrency_s, value}\] |
/// | `jerk` | `jumps`: their number, `race`, `full_circumference`, `defects` \[{kind, angle, width, width_m}\] |
/// | `orders` | `cuts` \[{label, order, rpm, rms}\] |
/// | `synchronous_average` | time-synchronous average: `revolutions`, `rms` {record, synchronous_average, residual} |
/// | `cyclic_coherence` | cyclic spectral coherence: `duration_s`, `lines` \[{line, harmonic, expected_hz, peak_hz, coherence, background, z_score}\] |
pub fn signal_to_json(results: &[SignalResult], compared: Option<&SignalResult>) -> Value {
    let mut out = json!({
        "schema": "rotordyn-signal-2", "program": "rotordyn", "version": env!("CARGO_PKG_VERSION"),
        "channels": results.iter().map(|found| document(&found.document())).collect::<Vec<_>>(),
    });
    if let Some(other) = compared {
        out["compared_record"] = document(&other.document());
    }
    out
}

/// Several records of one machine; schema "rotordyn-trend-1".
///
/// | key | contents |
/// |---|---|
/// | `axis` | `name`, `unit`, `source` |
/// | `unit`, `bearing`, `line_band_low_hz`, `line_band_high_hz`, `rms_bands_hz` | what holds for all records |
/// | `records` | one for each: `name`, `position`, `problem`, `channel`, statistics, `bpfo_amplitude`, `bpfo_level_db` and so on, `statement`, `diagnosis`, `candidate`, `probability` |
/// | `changes` | `quantity`, `first`, `last`, `slope`, `slope_95_percent`, `tau`, `p_value`, `significant` |
/// | `statements` | what is said of the whole |
pub fn trend_to_json(found: &TrendResult) -> Value {
    let mut out = document(&found.section().content);
    out["schema"] = json!("rotordyn-trend-1");
    out
}
