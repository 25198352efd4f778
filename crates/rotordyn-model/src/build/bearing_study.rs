//! `[study.bearing]`: analysis of single ball bearings, without the machine.

use super::increasing::check_increasing;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative, positive};
use crate::study::{BearingStudy, BearingSweep, DOF_NAMES, SweepDirection, SweepVariable};
use rotordyn_units::{ANGLE, FORCE, LENGTH, MOMENT, SPEED};

/// Read the study; `bearings` are the names of the file's ball bearings.
pub(super) fn read(r: &Reader, bearings: &[String]) -> BearingStudy {
    let known = || bearings.iter().map(String::as_str);
    let mut chosen = Vec::new();
    for (name, span) in r.texts("bearings").unwrap_or_default() {
        if !known().any(|other| other == name) {
            let problem = Problem::new(Kind::UnknownName, &span, format!("unknown ball bearing `{name}`"));
            r.log.error(problem.suggest(name, known()));
        }
        chosen.push(name.to_string());
    }
    let mut study = BearingStudy { bearings: chosen, ..BearingStudy::default() };
    study.force = r.list("load", any(FORCE)).and_then(|f| fixed_length(r, "load", "F_x, F_y, F_z", &f));
    study.moment = r.list("moment", any(MOMENT)).and_then(|m| fixed_length(r, "moment", "M_x, M_y", &m));
    study.constrained = r.texts("constrain").map(|names| {
        let mut constrained = [false; 5];
        for (name, span) in names {
            match DOF_NAMES.iter().position(|motion| *motion == name) {
                Some(k) => constrained[k] = true,
                None => {
                    let message = format!("{} cannot be `{name}`", r.name("constrain"));
                    let problem = Problem::new(Kind::UnknownName, &span, message);
                    r.log.error(problem.expected("some of x, y, z, theta_x, theta_y"));
                }
            }
        }
        constrained
    });
    study.speed = r.get("speed", not_negative(SPEED));
    study.cage_average = r.flag("cage_average", false);
    study.roughness = r.or("roughness", positive(LENGTH), study.roughness);
    let mut directions = vec![("load", SweepDirection::Load)];
    directions.extend(DOF_NAMES.iter().enumerate().map(|(k, name)| (*name, SweepDirection::Axis(k))));
    study.sweep_direction = r.choice("along", &directions).unwrap_or_default();
    let is_rotation = matches!(study.sweep_direction, SweepDirection::Axis(3 | 4));
    for (of, key) in SweepVariable::ALL {
        let spec = match of {
            SweepVariable::Load => any(if is_rotation { MOMENT } else { FORCE }),
            SweepVariable::Displacement => any(if is_rotation { ANGLE } else { LENGTH }),
            SweepVariable::Speed => not_negative(SPEED),
            SweepVariable::CageAngle => any(ANGLE),
        };
        if let Some(values) = r.sweep(key, spec) {
            check_increasing(r, key, &values);
            study.sweeps.push(BearingSweep { variable: of, values });
        }
    }
    for (name, span) in r.texts("sweep").unwrap_or_default() {
        match SweepVariable::ALL.iter().find(|(of, _)| of.name() == name) {
            Some((of, _)) if study.sweeps.iter().any(|sweep| sweep.variable == *of) => {}
            Some((of, _)) => study.sweeps.push(BearingSweep { variable: *of, values: Vec::new() }),
            None => {
                let problem =
                    Problem::new(Kind::UnknownName, &span, format!("{} cannot be `{name}`", r.name("sweep")));
                r.log.error(problem.expected("some of load, displacement, speed, cage_angle"));
            }
        }
    }
    study
}

fn fixed_length<const N: usize>(r: &Reader, key: &str, components: &str, values: &[f64]) -> Option<[f64; N]> {
    let found = values.try_into().ok();
    if found.is_none() {
        r.error(Kind::WrongType, key, format!("{} must have {N} values: {components}", r.name(key)));
    }
    found
}
