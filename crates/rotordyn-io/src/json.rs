//! Results as JSON, for other programs: the document "rotordyn-results-2".
//!
//! Frequencies in Hz, speeds in rpm, all else in SI; non-finite numbers are null. Keys of results that were
//! not computed are absent.
//!
//! | key | contents |
//! |---|---|
//! | `schema`, `program`, `version` | "rotordyn-results-2", "rotordyn", the program's version |
//! | `model`, `title` | name and title of the model |
//! | `units` | the unit of every quantity below |
//! | `estimated_geometry` | if the internal geometry of bearings is estimated: name of the bearing, how |
//! | `equilibrium` | `speed_rpm`, `residual_n`, `iterations`, `belts` \[{name, stated_pull_n: 2, pull_n: 2, remaining_share, displacement_m: 2}\], `preloads` \[{bearing, kind, stated_force_n, interference_m, spring_n_per_m, axial_force_n: per row, share: the least over the stated}\], `nodes` \[{node, displacement: 6}\], `bearings` \[{name, displacement: 6, force: 6, stiffness: 6×6, damping: 6×6, largest_ball_load_n, balls: \[{position_rad, load_n, contact_angle_rad, deflection_m}\]}\] |
//! | `modal` | per speed {speed_rpm, nodes (names), modes: \[{label, kind, eigenvalue {re, im} in 1/s, shape {re, im: 6 per node} with φᴴ M φ = 1, frequency_hz, damping_ratio, log_decrement, effective_mass: 3}\]} |
//! | `campbell` | `speeds_rpm`, `branches` \[{label, kind, labels, frequency_hz, log_decrement, eigenvalue {re, im}}\] over the speeds, `orders` \[{label, order}\], `crossings`, `crossings_omitted` \[{order, modes}\], `uncertain`, `lost_branches` \[{branch, from_rpm, to_rpm, continued_by}\], `thresholds` \[{speed_rpm, unstable_above, label}\] |
//! | `critical_speeds` | `max_speed_rpm`, `nodes` (names), `speeds` \[{speed_rpm, order, frequency_hz, damping_ratio, log_decrement, kind, label, eigenvalue {re, im}, shape {re, im: 6 per node}}\], also the form of `crossings`, without `shape`; `uncertain` \[{order, from_rpm, to_rpm}\] |
//! | `frf` | `speed_rpm`, `quantity`, `frequency_hz`, `requested` (indices of the requested frequencies), `undamped` \[{frequency_hz, label, responses}\], `functions` \[{excitation, response, unit, re, im}\] |
//! | `unbalance` | `speeds_rpm`, `requested` (indices of the requested speeds), `operating_speed_rpm`, `peaks` \[{response, unit, speed_rpm, amplitude, amplification_factor, half_power_rpm: 2, separation_margin, required_separation_margin}\], `undamped` \[{speed_rpm, label, responses}\], `responses` \[{name, unit, re, im}\], `orbits` \[{disc, x_re, x_im, y_re, y_im}\]; x(t) = Re(X e^{jΩt}) |
//! | `run_up` | sizes and errors of the reduced model, `end`, `step_s`, `requested_step_s`, `step_error`, `cage_angles` \[{bearing, initial_rad}\], `steps`, `iterations`, `halvings`, `energy_j` (`stored_*`: kinetic, strain and contact energy, zero at rest and undeformed; stored_change = work + drive_work + parametric_work − damping_loss − contact_loss + residual), `sample_rate_hz`, `samples`, `channels` \[{name, unit, quantity, station, direction, minimum, maximum, rms}\] |
//! | `spectrograms` | per channel {channel, unit, frames, frequencies, peak: {speed_rpm, frequency_hz, amplitude}}; the maps are in the HDF5 file |
//! | `orders` | per channel {channel, unit, cuts: \[{label, order, speed_rpm, rms}\]} |
//! | `cage_phases` | `bearings`, `angles_rad` per run, `channels` \[{channel, unit, cuts: \[{label, order, speed_rpm, rms, minimum, maximum, peaks}\]}\] |
//! | `poincare` | `speed_rpm`, `clock` {name, phase, frequency_hz}, `motion` {kind, period, recurrence, zero_one: 0-1 test for chaos, settled, residual: estimated distance from the motion it tends to relative to the orbit, decay_factor: per period}, `transient_periods`: periods discarded, `groups`, `planes` \[{name, axes, section: \[x, y\], orbit: extremes of x and y, whirl, clearance}\] |
//! | `lyapunov` | largest Lyapunov exponent: `speed_rpm`, `clock`, `exponent` {value, standard_error} in 1/s, `time_s`, `history` |
//! | `bifurcation` | `parameter` (paths), `unit`, `clock`, `channels`, `chunk_boundaries`, `rerun_chunks`, `complete`, `sweeps` \[{name, points: \[{value, motion, transient_periods, frequency_hz, sections, extremes, exponent} or {value, failure}\]}\] |
//! | `bearings` | per stand-alone ball bearing {name, load_source, estimated_geometry: if the internal geometry is estimated, how, ball_inertia, prescribed: 5, rating, preload: of the centred bearing, mounted_preload: as in `equilibrium`, nominal_orders, operating, films, warnings, sweeps: \[{variable, label, unit, values, points}\]}; a point: load: 5, displacement: 5, stiffness: 5×5, single values by the names of the HDF5 file with their units, balls \[{position, inner, outer}\] with loads, angles, ellipses, pressures, films, spinning, shoulder distances, and the motion of the ball (`controlling_race` 0 inner, 1 outer); all in SI, speeds in rad/s |
//! | `ball_inertia` | per study and bearing {study, bearing, stated, used, speed_rpm, centrifugal_force_n, largest_contact_load_n, ratio, limit}: ball inertia used at the highest speed, and why; one entry in `bearings` |
//! | `warnings` | messages |
//! | `seconds`, `wall_seconds`, `cpu_seconds` | per study: elapsed time (twice, `seconds` is the former name) and processor time of all threads |

mod run_up;
mod signal;
mod steady;
mod unit;

pub use run_up::run_up_step_error;
pub use signal::signal_to_json;
use unit::TO_RPM;

/// Name and version of the document's schema.
pub const SCHEMA: &str = "rotordyn-results-2";

use serde_json::{Map, Value, json};

use rotordyn_bearing::Preload;
use rotordyn_bearing::ball_inertia::INERTIA_LIMIT;
use rotordyn_core::analysis::Mode;
use rotordyn_core::analysis::ball_inertia::InertiaUse;
use rotordyn_core::analysis::belt_pull::BeltPull;
use rotordyn_core::analysis::critical_speed::{CriticalSpeed, CrossingList, UncertainRange};
use rotordyn_core::analysis::equilibrium::{BearingState, Equilibrium};
use rotordyn_core::analysis::preload::MountedPreload;
use rotordyn_core::results::{
    BallState, BearingPoint, BearingResult, BearingSweepResult, CampbellResult, ContactState, FrfResult,
    ModalResult, OrderResult, ResponsePeak, Results, SpectrogramResult, UnbalanceResult, UndampedPeak,
    is_rotation, unit_of,
};
use rotordyn_core::study::Machine;
use rotordyn_linalg::Complex64;

/// The results as one document.
pub fn to_json(results: &Results, machine: &Machine) -> Value {
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| out.insert(key.into(), value);
    put("schema", SCHEMA.into());
    put("program", "rotordyn".into());
    put("version", env!("CARGO_PKG_VERSION").into());
    put("model", machine.model.name.clone().into());
    put("title", machine.model.title.clone().into());
    put(
        "units",
        json!({
            "speed": "rpm", "frequency": "Hz", "order": "1/revolution", "displacement": "m, rad",
            "force": "N, N m", "stiffness": "N/m, N, N m/rad", "damping": "N s/m, N s, N m s/rad",
            "damping_ratio": "1", "log_decrement": "1", "effective_mass": "share of the total mass",
            "energy": "J", "angle": "rad",
        }),
    );
    if !results.ball_inertia.is_empty() {
        let all = results.ball_inertia.iter().flat_map(|(study, used)| used.iter().map(move |u| (study, u)));
        put(
            "ball_inertia",
            all.map(|(study, used)| {
                let mut entry = inertia_use(used);
                entry["study"] = json!(study);
                entry
            })
            .collect(),
        );
    }
    let estimated: serde_json::Map<String, Value> =
        machine.model.estimated_geometries().map(|(name, how)| (name.to_string(), how.into())).collect();
    if !estimated.is_empty() {
        put("estimated_geometry", estimated.into());
    }
    if let Some(found) = &results.equilibrium {
        put("equilibrium", equilibrium(found, machine));
    }
    if !results.modal.is_empty() {
        put("modal", results.modal.iter().map(|at| modal(at, machine)).collect());
    }
    if let Some(found) = &results.campbell {
        put("campbell", campbell(found));
    }
    if let Some(found) = &results.critical {
        let with_shape = |c: &CriticalSpeed| {
            let mut speed = crossing(c);
            speed["shape"] = shape(&c.mode);
            speed
        };
        let speeds: Value = found.crossings.list.iter().map(with_shape).collect();
        put(
            "critical_speeds",
            json!({
                "max_speed_rpm": found.max_speed * TO_RPM, "nodes": machine.assembly.dofs.node_names,
                "speeds": speeds, "uncertain": uncertain_ranges(&found.crossings),
            }),
        );
    }
    if let Some(found) = &results.frf {
        put("frf", frf(found));
    }
    if let Some(found) = &results.unbalance {
        put("unbalance", unbalance(found));
    }
    if let Some(found) = &results.run_up {
        put("run_up", run_up::run_up(found));
    }
    if !results.spectrograms.is_empty() {
        put("spectrograms", results.spectrograms.iter().map(spectrogram).collect());
    }
    if !results.orders.is_empty() {
        put("orders", results.orders.iter().map(orders).collect());
    }
    if let Some(found) = &results.cage_phases {
        put("cage_phases", run_up::cage_phases(found));
    }
    if let Some(found) = &results.poincare {
        put("poincare", steady::poincare(found));
    }
    if let Some(found) = &results.lyapunov {
        put("lyapunov", steady::lyapunov(found));
    }
    if let Some(found) = &results.bifurcation {
        put("bifurcation", steady::bifurcation(found));
    }
    if !results.bearings.is_empty() {
        put("bearings", results.bearings.iter().map(bearing).collect());
    }
    put("warnings", results.warnings.clone().into());
    Value::Object(out)
}

/// Stand-alone ball bearings (no machine) as a document of the same schema.
pub fn bearings_to_json(results: &Results, name: &str, title: &str) -> Value {
    json!({
        "schema": SCHEMA, "program": "rotordyn", "version": env!("CARGO_PKG_VERSION"),
        "model": name, "title": title, "warnings": results.warnings,
        "bearings": results.bearings.iter().map(bearing).collect::<Value>(),
    })
}

fn bearing(found: &BearingResult) -> Value {
    let o = &found.nominal_orders;
    let sweep = |s: &BearingSweepResult| {
        json!({
            "variable": s.of.name(), "label": s.label, "unit": s.unit, "values": s.values,
            "points": s.points.iter().map(point).collect::<Value>(),
        })
    };
    let mut out = json!({
        "name": found.name,
        "load_source": found.load_source,
        "ball_inertia": inertia_use(&found.ball_inertia),
        "prescribed": found.prescribed,
        "rating": {
            "dynamic": found.rating.dynamic, "static": found.rating.static_rating, "fatigue": found.rating.fatigue,
        },
        "preload": { "offset": found.preload.offset, "axial_force": found.preload.axial_force },
        "nominal_orders": { "ftf": o.ftf, "bpfo": o.bpfo, "bpfi": o.bpfi, "bsf": o.bsf },
        "operating": point(&found.point),
        "sweeps": found.sweeps.iter().map(sweep).collect::<Value>(),
        "films": found.films.iter().map(|f| json!({
            "race": f.race,
            "load": f.load,
            "entrainment_speed": f.speed,
            "central_film": f.solution.central_film,
            "minimum_film": f.solution.minimum_film,
            "approach": f.solution.approach,
            "rolling_force": f.solution.rolling_force,
        })).collect::<Value>(),
        "warnings": found.warnings,
    });
    // What a bearing does not have is omitted.
    if let Some(mounted) = &found.mounted_preload {
        out["mounted_preload"] = preload(mounted);
    }
    if let Some(how) = found.bearing.estimated_geometry {
        out["estimated_geometry"] = how.into();
    }
    out
}

fn point(p: &BearingPoint) -> Value {
    let contact = |c: &ContactState| -> Value {
        let values =
            ContactState::COLUMNS.iter().map(|(name, _, value)| ((*name).to_string(), json!(value(c))));
        Value::Object(values.collect())
    };
    let ball = |b: &BallState| {
        let mut out = json!({ "row": b.row, "position": b.position, "inner": contact(&b.inner), "outer": contact(&b.outer) });
        for (name, _, value) in BallState::COLUMNS.iter().filter(|(_, _, value)| !value(b).is_nan()) {
            out[*name] = json!(value(b));
        }
        out
    };
    let mut out = json!({
        "load": p.state.load, "displacement": p.state.displacement, "stiffness": p.state.stiffness,
        "balls": p.balls.iter().map(ball).collect::<Value>(),
    });
    // Quantities for which a standard gives no value (NaN) are omitted.
    for (name, _, value) in BearingPoint::COLUMNS.iter().filter(|(_, _, value)| !value(p).is_nan()) {
        out[*name] = json!(value(p));
    }
    out
}

fn equilibrium(found: &Equilibrium, machine: &Machine) -> Value {
    let dofs = &machine.assembly.dofs;
    let q = dofs.expand(&found.q);
    let nodes: Value = dofs
        .node_names
        .iter()
        .zip(q.chunks(6))
        .map(|(n, q)| json!({ "node": n, "displacement": q }))
        .collect();
    let ball = |b: &rotordyn_bearing::BallLoad| {
        json!({
            "position_rad": b.position, "load_n": b.load,
            "contact_angle_rad": b.contact_angle, "deflection_m": b.deflection,
        })
    };
    let bearing = |b: &BearingState| {
        json!({
            "name": b.name, "displacement": b.displacement, "force": b.force,
            "stiffness": b.tangent.stiffness, "damping": b.tangent.damping,
            "largest_ball_load_n": b.largest_ball_load, "balls": b.balls.iter().map(ball).collect::<Value>(),
        })
    };
    json!({
        "speed_rpm": found.speed * TO_RPM,
        "residual_n": found.residual,
        "iterations": found.iterations,
        "belts": belts(&found.belts),
        "preloads": preloads(&found.preloads),
        "nodes": nodes,
        "bearings": found.bearings.iter().map(bearing).collect::<Value>(),
    })
}

/// Pulls of the belts at equilibrium.
pub fn belts(found: &[BeltPull]) -> Value {
    let belt = |b: &BeltPull| {
        json!({
            "name": b.name, "stated_pull_n": b.stated, "pull_n": b.remaining,
            "remaining_share": b.remaining_share(), "displacement_m": b.displacement,
        })
    };
    found.iter().map(belt).collect()
}

/// Axial forces of the preloaded bearings at equilibrium.
pub fn preloads(found: &[MountedPreload]) -> Value {
    found.iter().map(preload).collect()
}

fn preload(found: &MountedPreload) -> Value {
    let (kind, interference, stiffness) = match found.stated {
        Preload::None => ("none", None, None),
        Preload::Interference(offset) => ("interference", Some(offset), None),
        Preload::DryForce(_) => ("dry_force", None, None),
        Preload::Force(_) => ("force", None, None),
        Preload::Spring { stiffness, .. } => ("spring", None, Some(stiffness)),
        Preload::Mounted { interference, .. } => ("mounted_force", interference, None),
    };
    json!({
        "bearing": found.bearing, "kind": kind, "stated_force_n": found.stated.force(),
        "interference_m": interference, "spring_n_per_m": stiffness, "axial_force_n": found.rows,
        "share": found.share(),
    })
}

fn eigenvalue(m: &Mode) -> Value {
    json!({ "re": m.eigenvalue.re, "im": m.eigenvalue.im })
}

/// Mode shape by node, six components each.
fn shape(m: &Mode) -> Value {
    let part = |of: fn(&Complex64) -> f64| -> Value {
        m.full_shape.chunks(6).map(|node| node.iter().map(of).collect::<Value>()).collect()
    };
    json!({ "re": part(|v| v.re), "im": part(|v| v.im) })
}

fn modal(found: &ModalResult, machine: &Machine) -> Value {
    let mode = |m: &Mode| {
        json!({
            "eigenvalue": eigenvalue(m), "shape": shape(m),
            "label": m.label, "kind": m.kind.name(), "frequency_hz": m.frequency_hz(),
            "damping_ratio": m.zeta(), "log_decrement": m.log_dec(), "effective_mass": m.effective_mass,
        })
    };
    json!({
        "speed_rpm": found.speed * TO_RPM, "nodes": machine.assembly.dofs.node_names,
        "modes": found.modes.iter().map(mode).collect::<Value>(),
    })
}

fn campbell(found: &CampbellResult) -> Value {
    let branch = |b: &rotordyn_core::analysis::campbell::Branch| {
        let over = |value: fn(&Mode) -> f64| -> Value {
            b.modes.iter().map(|m| m.as_ref().map_or(Value::Null, |m| value(m).into())).collect()
        };
        let labels: Value =
            b.modes.iter().map(|m| m.as_ref().map_or(Value::Null, |m| m.label.as_str().into())).collect();
        json!({
            "label": b.label, "kind": b.kind.name(), "labels": labels,
            "frequency_hz": over(Mode::frequency_hz), "log_decrement": over(Mode::log_dec),
            "eigenvalue": { "re": over(|m| m.eigenvalue.re), "im": over(|m| m.eigenvalue.im) },
        })
    };
    let speeds: Vec<f64> = found.diagram.speeds.iter().map(|s| s * TO_RPM).collect();
    json!({
        "speeds_rpm": speeds,
        "branches": found.diagram.branches.iter().map(branch).collect::<Value>(),
        "orders": found.orders.iter().map(|o| json!({ "label": o.label, "order": o.order })).collect::<Value>(),
        "crossings": found.crossings.list.iter().map(crossing).collect::<Value>(),
        "crossings_omitted": found.crossings.omitted.iter().map(|(order, modes)| json!({
            "order": order, "modes": modes,
        })).collect::<Value>(),
        "uncertain": uncertain_ranges(&found.crossings),
        "lost_branches": found.diagram.lost.iter().map(|lost| json!({
            "branch": lost.branch, "from_rpm": lost.speeds[0] * TO_RPM, "to_rpm": lost.speeds[1] * TO_RPM,
            "continued_by": lost.continued_by,
        })).collect::<Value>(),
        "thresholds": found.thresholds.iter().map(|t| json!({
            "speed_rpm": t.speed * TO_RPM, "unstable_above": t.unstable_above, "label": t.mode.label,
        })).collect::<Value>(),
    })
}

/// Ranges of speed in which crossings may be missing.
fn uncertain_ranges(list: &CrossingList) -> Value {
    let range = |r: &UncertainRange| json!({ "order": r.order, "from_rpm": r.from * TO_RPM, "to_rpm": r.to * TO_RPM });
    list.uncertain.iter().map(range).collect()
}

fn crossing(c: &CriticalSpeed) -> Value {
    json!({
        "speed_rpm": c.speed * TO_RPM, "order": c.order, "frequency_hz": c.mode.frequency_hz(),
        "log_decrement": c.mode.log_dec(), "damping_ratio": c.mode.zeta(), "kind": c.mode.kind.name(),
        "label": c.mode.label, "eigenvalue": eigenvalue(&c.mode),
    })
}

fn frf(found: &FrfResult) -> Value {
    let mut functions = Vec::new();
    for (e, excitation) in found.excitations.iter().enumerate() {
        for (r, response) in found.responses.iter().enumerate() {
            let values = &found.frf.values[r][e];
            functions.push(json!({
                "excitation": excitation, "response": response, "unit": found.units[r][e],
                "re": values.iter().map(|v| v.re).collect::<Vec<_>>(),
                "im": values.iter().map(|v| v.im).collect::<Vec<_>>(),
            }));
        }
    }
    json!({
        "speed_rpm": found.speed * TO_RPM,
        "quantity": found.name(),
        "frequency_hz": found.frf.frequencies,
        "requested": found.requested,
        "undamped": found.undamped.iter().map(|u| undamped_peak(u, "frequency_hz", 1.0)).collect::<Vec<_>>(),
        "functions": functions,
    })
}

fn undamped_peak(found: &UndampedPeak, key: &str, factor: f64) -> Value {
    json!({ key: found.at * factor, "label": found.label, "responses": found.responses })
}

fn unbalance(found: &UnbalanceResult) -> Value {
    let part = |pairs: &[[f64; 2]], k: usize| -> Vec<f64> { pairs.iter().map(|p| p[k]).collect() };
    let speeds: Vec<f64> = found.response.speeds.iter().map(|s| s * TO_RPM).collect();
    let responses = found.channels.iter().map(|c| {
        json!({
            "name": c.probe.name, "unit": unit_of(c.probe.quantity, is_rotation(&c.probe.direction)),
            "re": part(&c.amplitude, 0), "im": part(&c.amplitude, 1),
        })
    });
    let orbits = found.orbits.iter().map(|o| {
        json!({
            "disc": o.name, "x_re": part(&o.x, 0), "x_im": part(&o.x, 1),
            "y_re": part(&o.y, 0), "y_im": part(&o.y, 1),
        })
    });
    let peak = |p: &ResponsePeak| {
        let separation = found.operating_speed.map(|speed| p.peak.separation(speed));
        let required = found.operating_speed.and_then(|speed| p.peak.required_separation(speed));
        json!({
            "response": p.response, "unit": p.unit, "speed_rpm": p.peak.at * TO_RPM,
            "amplitude": p.peak.amplitude, "amplification_factor": p.peak.amplification(),
            "half_power_rpm": p.peak.half_power.map(|ends| ends.map(|speed| speed * TO_RPM)),
            "separation_margin": separation, "required_separation_margin": required,
        })
    };
    json!({
        "speeds_rpm": speeds,
        "requested": found.requested,
        "operating_speed_rpm": found.operating_speed.map(|speed| speed * TO_RPM),
        "peaks": found.peaks.iter().map(peak).collect::<Vec<_>>(),
        "undamped": found.undamped.iter().map(|u| undamped_peak(u, "speed_rpm", TO_RPM)).collect::<Vec<_>>(),
        "responses": responses.collect::<Value>(),
        "orbits": orbits.collect::<Value>(),
    })
}

fn spectrogram(found: &SpectrogramResult) -> Value {
    let s = &found.spectrogram;
    let bins = s.frequencies.len();
    let highest = (0..s.amplitude.len()).max_by(|&a, &b| s.amplitude[a].total_cmp(&s.amplitude[b]));
    let peak = highest.map_or(Value::Null, |k| {
        json!({
            "speed_rpm": found.speed[k / bins] * TO_RPM, "frequency_hz": s.frequencies[k % bins],
            "amplitude": s.amplitude[k],
        })
    });
    json!({
        "channel": found.channel, "unit": found.unit, "frames": s.times.len(), "frequencies": bins,
        "peak": peak,
    })
}

fn orders(found: &OrderResult) -> Value {
    let cuts = found.cuts.iter().map(|(line, cut)| {
        json!({ "label": line.label, "order": cut.order, "speed_rpm": cut.rpm, "rms": cut.rms })
    });
    json!({ "channel": found.channel, "unit": found.unit, "cuts": cuts.collect::<Value>() })
}

/// Ball inertia of one bearing, and why.
fn inertia_use(used: &InertiaUse) -> Value {
    let compared = &used.compared;
    json!({
        "bearing": used.bearing, "stated": used.inertia.keyword(), "used": used.inertia.in_effect().keyword(),
        "speed_rpm": compared.speed * TO_RPM, "centrifugal_force_n": compared.centrifugal,
        "largest_contact_load_n": compared.contact_load, "ratio": compared.ratio(),
        "limit": INERTIA_LIMIT,
    })
}
