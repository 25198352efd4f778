//! `[study.bearing]`: analysis of single ball bearings, without the machine.

use super::increasing::check_increasing;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Flag, Key, Quantities, Quantity, Spaced, Texts, Words, any, flag, keys, not_negative, positive,
    quantities, quantity, spaced, texts, words,
};
use crate::file::reader::Reader;
use crate::study::{
    BearingStudy, BearingSweep, DOF_NAMES, ROUGHNESS, SkiddingRange, SweepDirection, SweepVariable,
};
use rotordyn_units::{ANGLE, FORCE, LENGTH, MOMENT, SPEED};

/// Load without the key.
const LOAD: &str = "zero with moment; else that in the machine, or without machine a tenth of the dynamic rating \
    along -y, with thrust for a single row that is not preloaded";
/// Constrained DOFs without the key.
const CONSTRAINED: &str = "in the machine z and tilts; with load or moment, or without machine, the tilts unless \
    moment is given, and z of a preloaded single row without axial load";

keys! {
    /// `[study.bearing]`.
    pub(super) static STUDY: BearingStudyKeys = "Analysis of single ball bearings." {
        bearings: Texts = texts("names of ball bearings", "Bearings.").computed("all").example("[\"B\"]");
        load: Quantities = quantities(any(FORCE), "three: F_x, F_y, F_z", "Load of the shaft on the bearing.")
            .computed(LOAD).example("\"0, -500, 100 N\"");
        moment: Quantities = quantities(any(MOMENT), "two: M_x, M_y", "Moments of the shaft on the bearing.")
            .computed("tilts are constrained").example("\"0, 4 N m\"");
        constrain: Texts = texts("some of x, y, z, theta_x, theta_y", "DOFs constrained at the centred position, in the machine at that of its equilibrium.")
            .computed(CONSTRAINED).example("[\"theta_x\", \"theta_y\"]");
        speed: Quantity = quantity(not_negative(SPEED), "Shaft speed.").computed("the highest of [speed]")
            .example("\"3000 rpm\"");
        cage_average: Flag = flag("Average over the cage angle instead of using that of the model.").default("false");
        roughness: Quantity = quantity(positive(LENGTH), "Composite RMS roughness of ball and race, for the lambda ratio.")
            .default_si(ROUGHNESS);
        along: Words<SweepDirection> = words(&[
            ("load", SweepDirection::Load),
            (DOF_NAMES[0], SweepDirection::Axis(0)),
            (DOF_NAMES[1], SweepDirection::Axis(1)),
            (DOF_NAMES[2], SweepDirection::Axis(2)),
            (DOF_NAMES[3], SweepDirection::Axis(3)),
            (DOF_NAMES[4], SweepDirection::Axis(4)),
        ], "Direction of load and displacement sweeps; load: all components in proportion.").default("load");
        sweep: Texts = texts("some of load, displacement, speed, cage_angle", "Sweeps over a default range.")
            .computed("load, cage_angle, and speed if the bearing depends on it").example("[\"load\"]");
        loads: Spaced = spaced(any(FORCE), "Sweep over the load, increasing; a moment along a tilt.").optional()
            .example("\"0, 500, 1000 N\"");
        displacements: Spaced = spaced(any(LENGTH), "Sweep over the displacement, increasing; an angle along a tilt.")
            .optional().example("\"0, 10, 20 um\"");
        speeds: Spaced = spaced(not_negative(SPEED), "Sweep over the speed, increasing.").optional()
            .example("\"0, 3000 rpm\"");
        cage_angles: Spaced = spaced(any(ANGLE), "Sweep over the cage angle, increasing.").optional()
            .example("\"0, 10, 20 deg\"");
        skidding: Flag = flag("Cage slip of bearings with free balls over load and speed.").default("false");
        skidding_loads: Spaced = spaced(positive(FORCE), "Loads of the skidding map, increasing, along that of the operating point.")
            .computed("5, 10, 20, 50 and 100 % of that of the operating point").example("\"20, 50, 100 N\"")
            .with("skidding = true");
        skidding_speeds: Spaced = spaced(positive(SPEED), "Speeds of the skidding map, increasing.")
            .computed("20, 40, 60, 80 and 100 % of that of the operating point").example("\"2000, 6000 rpm\"")
            .with("skidding = true");
    }
}

/// Read the study; `bearings` are the names of the file's ball bearings.
pub(super) fn read(r: &Reader, bearings: &[String]) -> BearingStudy {
    let known = || bearings.iter().map(String::as_str);
    let mut chosen = Vec::new();
    for (name, span) in r.texts(&STUDY.bearings).unwrap_or_default() {
        if !known().any(|other| other == name) {
            let problem = Problem::new(Kind::UnknownName, &span, format!("unknown ball bearing `{name}`"));
            r.log.error(problem.suggest(r.log, name, known()));
        }
        chosen.push(name.to_string());
    }
    let mut study = BearingStudy { bearings: chosen, ..BearingStudy::default() };
    study.force = r.list(&STUDY.load).and_then(|f| fixed_length(r, &STUDY.load, "F_x, F_y, F_z", &f));
    study.moment = r.list(&STUDY.moment).and_then(|m| fixed_length(r, &STUDY.moment, "M_x, M_y", &m));
    study.constrained = r.texts(&STUDY.constrain).map(|names| {
        let mut constrained = [false; 5];
        for (name, span) in names {
            match DOF_NAMES.iter().position(|motion| *motion == name) {
                Some(k) => constrained[k] = true,
                None => {
                    let message = format!("{} cannot be `{name}`", r.name(&STUDY.constrain));
                    let problem = Problem::new(Kind::UnknownName, &span, message);
                    r.log.error(problem.expected("some of x, y, z, theta_x, theta_y"));
                }
            }
        }
        constrained
    });
    study.speed = r.get(&STUDY.speed);
    study.cage_average = r.flag(&STUDY.cage_average);
    study.roughness = r.value(&STUDY.roughness);
    study.sweep_direction = r.word(&STUDY.along);
    let is_rotation = matches!(study.sweep_direction, SweepDirection::Axis(3 | 4));
    let [load, displacement] = match is_rotation {
        true => [any(MOMENT), any(ANGLE)],
        false => [STUDY.loads.value.0, STUDY.displacements.value.0],
    };
    for (variable, key, each) in [
        (SweepVariable::Load, &STUDY.loads, load),
        (SweepVariable::Displacement, &STUDY.displacements, displacement),
        (SweepVariable::Speed, &STUDY.speeds, STUDY.speeds.value.0),
        (SweepVariable::CageAngle, &STUDY.cage_angles, STUDY.cage_angles.value.0),
    ] {
        if let Some(values) = r.spaced_of(key, each) {
            check_increasing(r, key, &values);
            study.sweeps.push(BearingSweep { variable, values });
        }
    }
    for (name, span) in r.texts(&STUDY.sweep).unwrap_or_default() {
        match SweepVariable::ALL.iter().find(|(of, _)| of.name() == name) {
            Some((of, _)) if study.sweeps.iter().any(|sweep| sweep.variable == *of) => {}
            Some((of, _)) => study.sweeps.push(BearingSweep { variable: *of, values: Vec::new() }),
            None => {
                let problem = Problem::new(
                    Kind::UnknownName,
                    &span,
                    format!("{} cannot be `{name}`", r.name(&STUDY.sweep)),
                );
                r.log.error(problem.expected("some of load, displacement, speed, cage_angle"));
            }
        }
    }
    study.skidding = skidding(r);
    study
}

/// The skidding map, if asked for.
fn skidding(r: &Reader) -> Option<SkiddingRange> {
    let wanted = r.flag(&STUDY.skidding);
    let [loads, speeds] = [&STUDY.skidding_loads, &STUDY.skidding_speeds].map(|key| {
        if r.has(key) && !wanted {
            r.error(Kind::Conflict, key, format!("{} belongs to skidding = true", r.name(key)));
        }
        let values = r.spaced_of(key, key.value.0).unwrap_or_default();
        check_increasing(r, key, &values);
        values
    });
    wanted.then_some(SkiddingRange { loads, speeds })
}

fn fixed_length<const N: usize>(
    r: &Reader,
    key: &Key<Quantities>,
    components: &str,
    values: &[f64],
) -> Option<[f64; N]> {
    let found = values.try_into().ok();
    if found.is_none() {
        r.error(Kind::WrongType, key, format!("{} must have {N} values: {components}", r.name(key)));
    }
    found
}
