//! Studies of rotordynamics standards: critical speed map, torsional modes, operating speeds.

use super::default_ranges::max_speed_or;
use super::increasing::check_increasing;
use super::orders::{ORDER, orders};
use crate::Model;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Key, Quantity, Spaced, Special, SubTable, count, keys, positive, quantity, spaced, special,
    sub_table,
};
use crate::file::reader::Reader;
use crate::study::{CriticalMapStudy, Studies, TorsionalStudy};
use rotordyn_units::{SPEED, STIFFNESS};

keys! {
    /// Tables of `[study]`.
    pub(super) static ROTOR_STUDY: RotorStudyKeys {
        critical_map: SubTable = sub_table(CriticalMapKeys::TABLE);
        torsional: SubTable = sub_table(TorsionalKeys::TABLE);
    }
}

keys! {
    /// `[study.critical_map]`.
    static CRITICAL_MAP: CriticalMapKeys = "Undamped critical speeds over the radial stiffness of all bearings." {
        max_speed: Quantity = quantity(positive(SPEED), "Highest speed.")
            .computed("three times the highest of [speed], else 6000 rpm").example("\"6000 rpm\"");
        lowest_stiffness: Quantity = quantity(positive(STIFFNESS), "Lowest stiffness.")
            .computed("a decade below that of the bearings").example("\"1e5 N/m\"");
        highest_stiffness: Quantity = quantity(positive(STIFFNESS), "Highest stiffness.")
            .computed("a decade above that of the bearings").example("\"1e10 N/m\"");
        points: Count = count([2, 1000], "Number of stiffnesses, at equal ratios.").default("41");
    }
}

keys! {
    /// `[study.torsional]`.
    static TORSIONAL: TorsionalKeys = "Torsional natural frequencies and the orders that meet them." {
        max_speed: Quantity = quantity(positive(SPEED), "Highest speed.")
            .computed("1.5 times the highest of [speed], else 6000 rpm").example("\"6000 rpm\"");
        orders: Special = special(ORDER, "Orders of the excitation.").computed("1 and 2")
            .example("[1, 2, 6]");
        modes: Count = count([1, 1000], "Number of modes.").default("6");
        operating_speeds: Spaced = spaced(positive(SPEED), OPERATING_SPEEDS)
            .computed("the highest of [speed]").example("\"2800, 3200 rpm\"");
    }
}

/// Meaning of the key `operating_speeds`.
pub(super) const OPERATING_SPEEDS: &str = "Lowest and highest operating speed, for separation margins.";

pub(super) fn read(all: &Reader, model: &Model, studies: &mut Studies) {
    if let Some(r) = all.table(&ROTOR_STUDY.critical_map) {
        studies.critical_map = Some(critical_map(&r, model));
        if model.bearings.is_empty() && r.has_no_errors() {
            let problem = Problem::new(Kind::Conflict, &r.span, "study.critical_map needs a bearing");
            r.log.error(
                problem.hint("add [bearing.NAME], whose stiffness is varied, in place of a joint or bushing"),
            );
        }
        r.finish();
    }
    if let Some(r) = all.table(&ROTOR_STUDY.torsional) {
        studies.torsional = Some(TorsionalStudy {
            max_speed: max_speed_or(&r, &TORSIONAL.max_speed, model, 1.5),
            orders: excitation_orders(&r, model),
            modes: r.count(&TORSIONAL.modes),
            operating_speeds: operating_speeds(&r, &TORSIONAL.operating_speeds),
        });
        r.finish();
    }
}

/// The given orders, else once and twice per revolution.
fn excitation_orders(r: &Reader, model: &Model) -> Vec<f64> {
    if r.has(&TORSIONAL.orders) {
        return orders(r, &TORSIONAL.orders, model);
    }
    r.taken_by_default(&TORSIONAL.orders, "1 and 2");
    vec![1.0, 2.0]
}

fn critical_map(r: &Reader, model: &Model) -> CriticalMapStudy {
    let [low, high] = [&CRITICAL_MAP.lowest_stiffness, &CRITICAL_MAP.highest_stiffness];
    let study = CriticalMapStudy {
        max_speed: max_speed_or(r, &CRITICAL_MAP.max_speed, model, 3.0),
        lowest_stiffness: r.get(low),
        highest_stiffness: r.get(high),
        points: r.count(&CRITICAL_MAP.points),
    };
    if let (Some(lowest), Some(highest)) = (study.lowest_stiffness, study.highest_stiffness)
        && lowest >= highest
    {
        r.error(Kind::OutOfRange, high, format!("{} must be above {}", r.name(high), r.name(low)));
    }
    study
}

/// One operating speed, or the lowest and the highest.
pub(super) fn operating_speeds(r: &Reader, key: &Key<Spaced>) -> Option<[f64; 2]> {
    if !r.has(key) {
        r.taken_by_default(key, "the highest of [speed]");
        return None;
    }
    let speeds = r.spaced(key)?;
    check_increasing(r, key, &speeds);
    match speeds[..] {
        [only] => Some([only; 2]),
        [lowest, highest] => Some([lowest, highest]),
        _ => {
            let message = format!("{} must be one speed, or the lowest and the highest", r.name(key));
            r.error(Kind::OutOfRange, key, message);
            None
        }
    }
}
