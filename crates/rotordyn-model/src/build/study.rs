//! Studies requested by a file, with their defaults.

use super::bearing_study::{self, BearingStudyKeys};
use super::default_points;
use super::default_ranges::{self, DefaultRange, spaced_or};
use super::increasing::check_increasing;
use super::loading::{DirectionKeys, QUANTITIES, anchor_and_direction};
use super::orders::{ORDER, orders};
use super::places::{AnchorKeys, Places};
use super::rotor_studies::{self, RotorStudyKeys};
use super::run_analyses::{self, ORDERS_TABLE, SPECTROGRAM_TABLE};
use super::run_keys::{RUN_STEP, channels, check_step_of_loads, default_step_us, top_speed};
use super::run_up::{self, RUN_UP, RUN_UP_TABLE};
use super::steady::{self, SteadyStudyKeys};
use super::work_limits;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Flag, Group, Key, NamedTables, Quantity, Spaced, Special, SubTable, Table, Texts, Words, count,
    flag, keys, named_tables, not_negative, positive, quantity, spaced, special, sub_table, texts, words,
};
use crate::file::reader::Reader;
use crate::study::{
    BearingStudy, CampbellStudy, CriticalStudy, EquilibriumStudy, Excitation, FrfStudy, ModalStudy, Studies,
    UnbalanceStudy,
};
use crate::{Model, Probe, Quantity as MotionQuantity};
use rotordyn_bearing::Bearing;
use rotordyn_units::{FREQUENCY, SPEED};

keys! {
    /// Tables of this file.
    pub(super) static TOP: TopKeys {
        study: SubTable = sub_table(&STUDY_TABLE);
    }
}

static STUDY_TABLE: Table = Table {
    meaning: "Studies of the machine; each is done if its table is in the file, by defaults if that is empty; bifurcation needs its parameter.",
    groups: &[
        Group::always(StudyKeys::LIST),
        Group::always(RotorStudyKeys::LIST),
        Group::always(SteadyStudyKeys::LIST),
    ],
};

keys! {
    /// `[study]`.
    static STUDY: StudyKeys {
        equilibrium: SubTable = sub_table(StaticKeys::TABLE).named("static");
        modal: SubTable = sub_table(ModalKeys::TABLE);
        campbell: SubTable = sub_table(CampbellKeys::TABLE);
        critical: SubTable = sub_table(CriticalKeys::TABLE);
        frf: SubTable = sub_table(&FRF_TABLE);
        unbalance: SubTable = sub_table(&UNBALANCE_TABLE);
        run_up: SubTable = sub_table(&RUN_UP_TABLE);
        spectrogram: SubTable = sub_table(&SPECTROGRAM_TABLE);
        orders: SubTable = sub_table(&ORDERS_TABLE);
        bearing: SubTable = sub_table(BearingStudyKeys::TABLE);
    }
}

keys! {
    /// `[study.static]`.
    static STATIC: StaticKeys = "Static equilibrium." {
        speed: Quantity = quantity(not_negative(SPEED), "Shaft speed, for what depends on it.").default("0 rpm");
        cage_average: Flag = flag("Average over the cage angle instead of keeping that of the model.")
            .default("false");
    }
}

keys! {
    /// `[study.modal]`.
    static MODAL: ModalKeys = "Natural frequencies, damping and mode shapes." {
        speeds: Spaced = spaced(not_negative(SPEED), "Speeds.").default("0 rpm").example("\"0, 3000 rpm\"");
        modes: Count = count([1, 10_000], "Number of modes.").default("12");
    }
}

keys! {
    /// `[study.campbell]`.
    static CAMPBELL: CampbellKeys = "Campbell diagram of the linearised machine." {
        speeds: Spaced = spaced(not_negative(SPEED), "Speeds, increasing.")
            .computed("25 up to the highest of [speed], else 3000 rpm").example(SPEEDS);
        modes: Count = count([1, 10_000], "Number of modes.").default("12");
        orders: Special = special(ORDER, "Order lines for critical speeds.").default("1");
        speed_dependent_bearings: Flag = flag("Linearise the bearings at every speed, not only at the first.")
            .default("true");
    }
}

keys! {
    /// `[study.critical]`.
    static CRITICAL: CriticalKeys = "Critical speeds." {
        max_speed: Quantity = quantity(positive(SPEED), "Highest speed.")
            .computed("three times the highest of [speed], else 6000 rpm").example("\"6000 rpm\"");
        orders: Special = special(ORDER, "Orders of the excitation.").default("1");
    }
}

static FRF_TABLE: Table = Table {
    meaning: "Frequency response functions of every probe to every excitation.",
    groups: &[Group::always(FrfKeys::LIST), Group::always(ResponseKeys::LIST)],
};

keys! {
    /// `[study.frf]`.
    static FRF: FrfKeys {
        frequencies: Spaced = spaced(not_negative(FREQUENCY), "Frequencies, increasing.")
            .computed("1 to 500 Hz in steps of 0.25 Hz").example("{ from = \"1 Hz\", to = \"400 Hz\", step = \"0.25 Hz\" }");
        quantity: Words<MotionQuantity> = words(&[
            ("receptance", MotionQuantity::Displacement),
            ("mobility", MotionQuantity::Velocity),
            ("accelerance", MotionQuantity::Acceleration),
        ], "Response per force.").default("receptance");
        excitation: NamedTables = named_tables(&EXCITATION_TABLE)
            .computed("x and y at the first disc, else rotor, else station");
        speed: Quantity = quantity(not_negative(SPEED), "Shaft speed.").default("0 rpm");
        refine: Flag = flag("Add frequencies around the natural frequencies.").default("true");
    }
}

static EXCITATION_TABLE: Table = Table {
    meaning: "A unit force or moment on a point, such as a hammer impact.",
    groups: &[Group::always(AnchorKeys::LIST), Group::always(DirectionKeys::LIST)],
};

keys! {
    /// Responses of `[study.frf]` and `[study.unbalance]`.
    static RESPONSE: ResponseKeys {
        responses: Texts = texts("names of probes", "Points of the response.").computed("every probe")
            .example("[\"disc_x\"]");
        response_quantity: Words<MotionQuantity> = words(&QUANTITIES, "Quantity of the response.")
            .computed("by quantity; that of each probe for an unbalance response");
    }
}

static UNBALANCE_TABLE: Table = Table {
    meaning: "Synchronous response to unbalance over speed.",
    groups: &[Group::always(UnbalanceStudyKeys::LIST), Group::always(ResponseKeys::LIST)],
};

keys! {
    /// `[study.unbalance]`.
    static UNBALANCE: UnbalanceStudyKeys {
        speeds: Spaced = spaced(not_negative(SPEED), "Speeds, increasing.")
            .computed("200 up to 1.5 times the highest of [speed], else 6000 rpm").example(SPEEDS);
        refine: Flag = flag("Add speeds around the critical speeds.").default("true");
        operating_speeds: Spaced = spaced(positive(SPEED), rotor_studies::OPERATING_SPEEDS)
            .computed("the highest of [speed]").example("\"2800, 3200 rpm\"");
    }
}

const SPEEDS: &str = "{ from = \"0 rpm\", to = \"1200 rpm\", count = 25 }";

pub(super) fn read(top: &Reader, model: &Model, places: &Places) -> Studies {
    let all = top.table_or_empty(&TOP.study);
    let mut studies = Studies::default();
    if let Some(r) = all.table(&STUDY.equilibrium) {
        let (speed, cage_average) = (r.value(&STATIC.speed), r.flag(&STATIC.cage_average));
        studies.equilibrium = Some(EquilibriumStudy { speed, cage_average });
        r.finish();
    }
    if let Some(r) = all.table(&STUDY.modal) {
        let speeds = r.spaced(&MODAL.speeds).unwrap_or_else(|| vec![0.0]);
        studies.modal = Some(ModalStudy { speeds, modes: r.count(&MODAL.modes) });
        r.finish();
    }
    if let Some(r) = all.table(&STUDY.campbell) {
        studies.campbell = Some(CampbellStudy {
            speeds: speeds(&r, &CAMPBELL.speeds, &default_ranges::campbell(model)),
            modes: r.count(&CAMPBELL.modes),
            orders: orders(&r, &CAMPBELL.orders, model),
            speed_dependent_bearings: r.flag(&CAMPBELL.speed_dependent_bearings),
        });
        r.finish();
    }
    if let Some(r) = all.table(&STUDY.critical) {
        let max_speed = default_ranges::max_speed_or(&r, &CRITICAL.max_speed, model, 3.0);
        studies.critical = Some(CriticalStudy { max_speed, orders: orders(&r, &CRITICAL.orders, model) });
        r.finish();
    }
    if let Some(r) = all.table(&STUDY.frf) {
        studies.frf = Some(frf(&r, model, places));
        r.finish();
    }
    if let Some(r) = all.table(&STUDY.unbalance) {
        let responses = responses(&r, model, None);
        let speeds = speeds(&r, &UNBALANCE.speeds, &default_ranges::unbalance(model));
        let refine = r.flag(&UNBALANCE.refine);
        let operating_speeds = rotor_studies::operating_speeds(&r, &UNBALANCE.operating_speeds);
        studies.unbalance = Some(UnbalanceStudy { speeds, refine, responses, operating_speeds });
        if model.unbalances.is_empty() && r.has_no_errors() {
            let problem = Problem::new(Kind::MissingKey, &r.span, "study.unbalance needs an unbalance");
            let problem = problem.follows("unbalance");
            r.log.error(problem.hint("add [unbalance.NAME] with station and magnitude"));
        }
        r.finish();
    }
    let (run_up_table, orders_table) = (all.table(&STUDY.run_up), all.table(&STUDY.orders));
    let orders = orders_table.as_ref().map(|r| run_analyses::orders_of_run(r, model));
    if let Some(r) = &run_up_table {
        let least_rate = orders
            .as_ref()
            .map_or(0.0, |(study, _)| run_analyses::rate_for(study.max_order, top_speed(model)));
        studies.run_up = Some(run_up::read(top, r, model, all.has(&STUDY.orders), least_rate));
    }
    if let Some(r) = all.table(&STUDY.spectrogram) {
        studies.spectrogram = Some(run_analyses::spectrogram(&r, model, studies.run_up.as_ref()));
        r.finish();
    }
    if let (Some(r), Some(study)) = (orders_table, orders) {
        studies.orders = Some(run_analyses::fitted_orders(&r, study, model, studies.run_up.as_ref()));
        r.finish();
    }
    if let (Some(r), Some(study)) = (run_up_table, &mut studies.run_up) {
        if !r.has(&RUN_STEP.step) {
            let cuts = studies.orders.as_ref().map_or(&[][..], |orders| &orders.cuts);
            let step = default_step_us(model, cuts, top_speed(model));
            study.step = step / 1e6;
            r.taken_by_default(&RUN_STEP.step, format!("\"{step} us\""));
        } else {
            check_step_of_loads(&r, model, study.step);
        }
        work_limits::check_run_up(
            &r,
            [&RUN_STEP.step, &RUN_UP.defect_step, &RUN_UP.sample_rate],
            study,
            model.profile.duration(),
        );
        r.finish();
    }
    rotor_studies::read(&all, model, &mut studies);
    steady::read(&all, model, &mut studies);
    let sites = model.bearings.iter().map(|site| (&site.name, &site.bearing));
    studies.bearing = bearing(&all, sites);
    all.finish();
    studies
}

/// Studies of a bearing-only file.
pub(super) fn read_for_bearings(top: &Reader, bearings: &[(String, Bearing)]) -> Studies {
    let all = top.table_or_empty(&TOP.study);
    let bearing = bearing(&all, bearings.iter().map(|(name, bearing)| (name, bearing)));
    all.finish();
    Studies { bearing, ..Studies::default() }
}

fn bearing<'a>(
    all: &Reader,
    bearings: impl Iterator<Item = (&'a String, &'a Bearing)>,
) -> Option<BearingStudy> {
    let r = all.table(&STUDY.bearing)?;
    let balls = bearings.filter(|(_, bearing)| bearing.static_balls().is_some());
    let study = bearing_study::read(&r, &balls.map(|(name, _)| name.clone()).collect::<Vec<_>>());
    r.finish();
    Some(study)
}

fn speeds(r: &Reader, key: &Key<Spaced>, by_default: &DefaultRange) -> Vec<f64> {
    let speeds = spaced_or(r, key, by_default);
    check_increasing(r, key, &speeds);
    speeds
}

fn frf(r: &Reader, model: &Model, places: &Places) -> FrfStudy {
    let frequencies = spaced_or(r, &FRF.frequencies, &default_ranges::frequencies());
    check_increasing(r, &FRF.frequencies, &frequencies);
    let quantity = r.word(&FRF.quantity);
    let read = |(name, excitation): (&str, Reader)| {
        let (at, direction) = anchor_and_direction(&excitation, places);
        excitation.finish();
        Excitation { name: name.into(), at, direction }
    };
    let mut excitations: Vec<Excitation> = r.items(&FRF.excitation).into_iter().map(read).collect();
    if excitations.is_empty() {
        excitations = default_points::excitations(model);
        let named = excitations.iter().map(|excitation| excitation.name.as_str()).collect::<Vec<_>>();
        r.taken_by_default(&FRF.excitation, named.join(", "));
    }
    let speed = r.value(&FRF.speed);
    let refine = r.flag(&FRF.refine);
    FrfStudy {
        speed,
        frequencies,
        refine,
        excitations,
        responses: responses(r, model, Some(quantity)),
        quantity,
    }
}

/// Probes of the given names, or all, with the study's quantity, else their own.
fn responses(r: &Reader, model: &Model, quantity: Option<MotionQuantity>) -> Vec<Probe> {
    let names = channels(r, &RESPONSE.responses, model);
    let quantity = r.choice(&RESPONSE.response_quantity).or(quantity);
    let wanted = |p: &&Probe| names.is_empty() || names.contains(&p.name);
    let of_study = |p: &Probe| Probe { quantity: quantity.unwrap_or(p.quantity), ..p.clone() };
    let chosen: Vec<Probe> = model.probes.iter().filter(wanted).map(of_study).collect();
    if chosen.is_empty() && r.has_no_errors() {
        let problem = Problem::new(Kind::MissingKey, &r.span, format!("{} has no response probe", r.path));
        let problem = problem.follows("probe");
        r.log.error(problem.hint("add [probe.NAME] with at, direction and quantity"));
    }
    chosen
}
