//! Studies requested by a file, with their defaults.

use super::increasing::check_increasing;
use super::loading::{QUANTITIES, anchor_and_direction};
use super::places::Places;
use super::run_keys::{channels, integrator};
use super::{bearing_study, steady, work_limits};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, not_negative, positive};
use crate::file::tree::{Node, Value};
use crate::study::{
    BearingStudy, CampbellStudy, CriticalStudy, EquilibriumStudy, Excitation, FrfStudy, Integrator,
    ModalStudy, OrderStudy, RunUpStudy, SpectrogramStudy, Studies, UnbalanceStudy, WindowKind,
};
use crate::{Drive, Model, Probe, Quantity};
use rotordyn_bearing::{Bearing, Cage};
use rotordyn_units::{FREQUENCY, NUMBER, SPEED, TIME};

const DEFAULT_MODES: usize = 12;

pub(super) fn read(top: &Reader, model: &Model, places: &Places) -> Studies {
    let all = top.table_or_empty("study");
    let mut studies = Studies::default();
    if let Some(r) = all.table("static") {
        let speed = r.or("speed", not_negative(SPEED), 0.0);
        studies.equilibrium = Some(EquilibriumStudy { speed, cage_average: r.flag("cage_average", false) });
        r.finish();
    }
    if let Some(r) = all.table("modal") {
        let speeds = r.sweep("speeds", not_negative(SPEED)).unwrap_or_else(|| vec![0.0]);
        studies.modal = Some(ModalStudy { speeds, modes: r.count("modes", DEFAULT_MODES, 1..=10_000) });
        r.finish();
    }
    if let Some(r) = all.table("campbell") {
        studies.campbell = Some(CampbellStudy {
            speeds: speeds(&r),
            modes: r.count("modes", DEFAULT_MODES, 1..=10_000),
            orders: orders(&r, "orders", model, &[1.0]),
            speed_dependent_bearings: r.flag("speed_dependent_bearings", true),
        });
        r.finish();
    }
    if let Some(r) = all.table("critical") {
        let max_speed = r.need("max_speed", positive(SPEED));
        studies.critical = Some(CriticalStudy { max_speed, orders: orders(&r, "orders", model, &[1.0]) });
        r.finish();
    }
    if let Some(r) = all.table("frf") {
        studies.frf = Some(frf(&r, model, places));
        r.finish();
    }
    if let Some(r) = all.table("unbalance") {
        let responses = responses(&r, model, Quantity::Displacement);
        studies.unbalance =
            Some(UnbalanceStudy { speeds: speeds(&r), refine: r.flag("refine", true), responses });
        if model.unbalances.is_empty() && r.has_no_errors() {
            let problem = Problem::new(Kind::MissingKey, &r.span, "study.unbalance needs an unbalance");
            r.log.error(problem.hint("add [unbalance.NAME] with station and magnitude"));
        }
        r.finish();
    }
    if let Some(r) = all.table("run_up") {
        let study = run_up(top, &r, model);
        work_limits::check_run_up(&r, &study, model.profile.duration());
        studies.run_up = Some(study);
        r.finish();
    }
    let sample_rate = studies.run_up.as_ref().map_or(0.0, |s| s.sample_rate);
    if let Some(r) = all.table("spectrogram") {
        needs_run_up(&r, &studies);
        studies.spectrogram = Some(spectrogram(&r, model, sample_rate));
        r.finish();
    }
    if let Some(r) = all.table("orders") {
        needs_run_up(&r, &studies);
        studies.orders = Some(order_spectra(&r, model));
        r.finish();
    }
    steady::read(&all, model, &mut studies);
    let sites = model.bearings.iter().map(|site| (&site.name, &site.bearing));
    studies.bearing = bearing(&all, sites);
    all.finish();
    studies
}

/// Studies of a bearing-only file.
pub(super) fn read_for_bearings(top: &Reader, bearings: &[(String, Bearing)]) -> Studies {
    let all = top.table_or_empty("study");
    let bearing = bearing(&all, bearings.iter().map(|(name, bearing)| (name, bearing)));
    all.finish();
    Studies { bearing, ..Studies::default() }
}

fn bearing<'a>(
    all: &Reader,
    bearings: impl Iterator<Item = (&'a String, &'a Bearing)>,
) -> Option<BearingStudy> {
    let r = all.table("bearing")?;
    let balls = bearings.filter(|(_, bearing)| bearing.static_balls().is_some());
    let study = bearing_study::read(&r, &balls.map(|(name, _)| name.clone()).collect::<Vec<_>>());
    r.finish();
    Some(study)
}

fn needs_run_up(r: &Reader, studies: &Studies) {
    if studies.run_up.is_none() {
        let problem = Problem::new(Kind::MissingKey, &r.span, format!("{} needs [study.run_up]", r.path));
        r.log.error(problem.hint("add [study.run_up], whose channels are analysed"));
    }
}

fn speeds(r: &Reader) -> Vec<f64> {
    if !r.has("speeds") {
        r.missing("speeds", "{ from = \"0 rpm\", to = \"1200 rpm\", count = 25 }");
    }
    let speeds = r.sweep("speeds", not_negative(SPEED)).unwrap_or_else(|| vec![0.0]);
    check_increasing(r, "speeds", &speeds);
    speeds
}

fn frf(r: &Reader, model: &Model, places: &Places) -> FrfStudy {
    if !r.has("frequencies") {
        r.missing("frequencies", "{ from = \"1 Hz\", to = \"400 Hz\", step = \"0.25 Hz\" }");
    }
    let frequencies = r.sweep("frequencies", not_negative(FREQUENCY)).unwrap_or_default();
    check_increasing(r, "frequencies", &frequencies);
    let kinds = [
        ("receptance", Quantity::Displacement),
        ("mobility", Quantity::Velocity),
        ("accelerance", Quantity::Acceleration),
    ];
    let quantity = r.choice("quantity", &kinds).unwrap_or(Quantity::Displacement);
    let read = |(name, excitation): (&str, Reader)| {
        let (at, direction) = anchor_and_direction(&excitation, places);
        excitation.finish();
        Excitation { name: name.into(), at, direction }
    };
    let excitations: Vec<Excitation> = r.items("excitation").into_iter().map(read).collect();
    if excitations.is_empty() && r.has_no_errors() {
        let problem = Problem::new(Kind::MissingKey, &r.span, "study.frf has no excitation");
        r.log.error(problem.hint("add [study.frf.excitation.NAME] with at and direction"));
    }
    let speed = r.or("speed", not_negative(SPEED), 0.0);
    let refine = r.flag("refine", true);
    FrfStudy { speed, frequencies, refine, excitations, responses: responses(r, model, quantity), quantity }
}

/// Probes of the given names, or all, with the study's quantity.
fn responses(r: &Reader, model: &Model, quantity: Quantity) -> Vec<Probe> {
    let names = channels(r, "responses", model);
    let quantity = r.choice("response_quantity", &QUANTITIES).unwrap_or(quantity);
    let wanted = |p: &&Probe| names.is_empty() || names.contains(&p.name);
    let chosen: Vec<Probe> =
        model.probes.iter().filter(wanted).map(|p| Probe { quantity, ..p.clone() }).collect();
    if chosen.is_empty() && r.has_no_errors() {
        let problem = Problem::new(Kind::MissingKey, &r.span, format!("{} has no response probe", r.path));
        r.log.error(problem.hint("add [probe.NAME] with at, direction and quantity"));
    }
    chosen
}

fn run_up(top: &Reader, r: &Reader, model: &Model) -> RunUpStudy {
    if !top.has("speed") {
        let problem = Problem::new(Kind::MissingKey, &r.span, "study.run_up needs a speed profile");
        r.log.error(problem.hint("add [speed] with profile = \"ramp\", to = \"1200 rpm\", ramp = \"10 s\""));
    }
    RunUpStudy {
        integrator: integrator(r, Integrator::GeneralisedAlpha { rho_infinity: 0.8 }),
        step: r.or("step", positive(TIME), 1e-4),
        sample_rate: r.or("sample_rate", positive(FREQUENCY), 2000.0),
        cutoff: r.or("cutoff", positive(FREQUENCY), f64::INFINITY),
        from_equilibrium: r.flag("from_equilibrium", true),
        cage_phases: cage_phases(top, r, model),
    }
}

/// Number of cage phases: of a machine with a ball bearing and a prescribed speed, whose order cuts are requested.
fn cage_phases(top: &Reader, r: &Reader, model: &Model) -> usize {
    let count = r.count("cage_phases", 0, 0..=360);
    if count == 0 || !r.has_no_errors() {
        return count;
    }
    let conflict = if count == 1 {
        Some(("is 1: one phase has no range", "give 2 phases or more, such as 8"))
    } else if model.bearings.iter().all(|site| site.bearing.ball().is_none()) {
        Some(("needs a bearing with balls", "remove it, or use model = \"ball\" in a bearing"))
    } else if matches!(model.drive, Drive::Torque { .. }) {
        Some((
            "needs a prescribed speed, so that all runs have the same speeds",
            "set drive.kind = \"prescribed\"",
        ))
    } else if top.table("study").and_then(|all| all.table("orders")).is_none() {
        Some((
            "gives a range of order cuts, but the file has no [study.orders]",
            "add [study.orders] with cuts = [1, \"BPFO\"]",
        ))
    } else {
        None
    };
    if let Some((problem, hint)) = conflict {
        let message = format!("{} {problem}", r.name("cage_phases"));
        r.log.error(Problem::new(Kind::Conflict, &r.span_of("cage_phases"), message).hint(hint));
    }
    count
}

fn window(r: &Reader) -> WindowKind {
    let windows = [
        ("rectangular", WindowKind::Rectangular),
        ("hann", WindowKind::Hann),
        ("hamming", WindowKind::Hamming),
        ("blackman", WindowKind::Blackman),
        ("flat-top", WindowKind::FlatTop),
    ];
    r.choice("window", &windows).unwrap_or(WindowKind::Hann)
}

fn overlap(r: &Reader) -> f64 {
    let overlap = r.or("overlap", not_negative(NUMBER), 0.75);
    if overlap >= 1.0 {
        let problem = Problem::new(
            Kind::OutOfRange,
            &r.span_of("overlap"),
            format!("{} is too large", r.name("overlap")),
        );
        r.log.error(problem.expected("from 0 to below 1"));
    }
    overlap
}

fn spectrogram(r: &Reader, model: &Model, sample_rate: f64) -> SpectrogramStudy {
    let max_frequency = r.or("max_frequency", positive(FREQUENCY), 0.5 * sample_rate);
    if max_frequency > 0.5 * sample_rate && sample_rate > 0.0 {
        let message = format!("{} is above half the sampling rate", r.name("max_frequency"));
        let problem = Problem::new(Kind::OutOfRange, &r.span_of("max_frequency"), message);
        r.log.error(problem.hint("raise study.run_up.sample_rate"));
    }
    SpectrogramStudy {
        channels: channels(r, "channels", model),
        window: window(r),
        length: r.or("length", positive(TIME), 1.0),
        overlap: overlap(r),
        max_frequency,
        dynamic_range_db: r.or("dynamic_range_db", positive(NUMBER), 60.0),
        orders: orders(r, "orders", model, &[1.0]),
    }
}

fn order_spectra(r: &Reader, model: &Model) -> OrderStudy {
    OrderStudy {
        channels: channels(r, "channels", model),
        resolution: r.or("resolution", positive(NUMBER), 0.05),
        max_order: r.or("max_order", positive(NUMBER), 20.0),
        overlap: overlap(r),
        window: window(r),
        cuts: orders(r, "cuts", model, &[1.0]),
    }
}

/// Orders as numbers or by name: "BPFO", "2 BPFO", "BPFI", "BSF", "FTF", with the bearing if they differ
/// between bearings: "B.BPFO".
fn orders(r: &Reader, key: &str, model: &Model, default: &[f64]) -> Vec<f64> {
    let Some(entry) = r.entry(key) else { return default.to_vec() };
    let items: &[Node] = match &entry.node.value {
        Value::List(items) => items,
        _ => std::slice::from_ref(&entry.node),
    };
    let mut orders = Vec::new();
    for item in items {
        let order = match &item.value {
            #[allow(clippy::cast_precision_loss)] // orders are small
            Value::Integer(i) => Some(*i as f64),
            Value::Float(f) => Some(*f),
            Value::Text(text) => match named_order(text, model) {
                Ok(order) => Some(order),
                Err(message) => {
                    let problem = Problem::new(Kind::UnknownName, &item.span, message);
                    r.log.error(problem.expected("an order such as 1, \"BPFO\", \"2 BPFO\" or \"B.BPFO\""));
                    continue;
                }
            },
            _ => None,
        };
        match order {
            Some(order) if order.is_finite() && order > 0.0 => orders.push(order),
            _ => {
                let message = format!("{} has an item that is not an order", r.name(key));
                let problem = Problem::new(Kind::OutOfRange, &item.span, message);
                r.log.error(problem.expected("a number above zero, or a name such as \"BPFO\""));
            }
        }
    }
    orders
}

fn named_order(text: &str, model: &Model) -> Result<f64, String> {
    let (factor, name) = match text.trim().split_once(' ') {
        Some((factor, name)) => {
            (factor.parse::<f64>().map_err(|_| format!("`{text}` is not an order"))?, name.trim())
        }
        None => (1.0, text.trim()),
    };
    let (wanted, frequency) = name.rsplit_once('.').map_or((None, name), |(b, f)| (Some(b), f));
    let mut found: Vec<f64> = Vec::new();
    for site in &model.bearings {
        if let Some(ball) = site.bearing.ball()
            && wanted.is_none_or(|w| w == site.name || w.strip_prefix("bearing.") == Some(&site.name))
        {
            let g = &ball.geometry;
            let ratio = g.ball_diameter / g.pitch_diameter * g.contact_angle.cos();
            let cage = match ball.cage {
                Cage::Rolling => 0.5 * (1.0 - ratio),
                Cage::Ratio(cage) => cage,
            };
            found.push(match frequency {
                "BPFO" => g.balls as f64 * cage,
                "BPFI" => g.balls as f64 * (1.0 - cage),
                "BSF" => g.pitch_diameter / (2.0 * g.ball_diameter) * (1.0 - ratio * ratio),
                "FTF" => cage,
                _ => return Err(format!("`{frequency}` is not one of BPFO, BPFI, BSF, FTF")),
            });
        }
    }
    match found[..] {
        [] => Err(format!("`{text}` needs a ball bearing, but no such bearing exists")),
        [first, ..] if found.iter().all(|f| (f - first).abs() <= 1e-9 * first) => Ok(factor * first),
        _ => Err(format!("`{text}` differs between bearings; write BEARING.{frequency}")),
    }
}
