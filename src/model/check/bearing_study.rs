//! `[study.bearing]`: analysis of single ball bearings, without the machine.

use super::loading::increasing;
use crate::model::file::diagnostic::{Kind, Problem};
use crate::model::file::reader::{Reader, any, not_negative, positive};
use crate::model::study::{Along, BearingStudy, BearingSweep, MOTIONS, Swept};
use crate::units::{ANGLE, FORCE, LENGTH, MOMENT, SPEED};

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
    study.force = r.list("load", any(FORCE)).and_then(|f| exactly(r, "load", "F_x, F_y, F_z", &f));
    study.moment = r.list("moment", any(MOMENT)).and_then(|m| exactly(r, "moment", "M_x, M_y", &m));
    study.held = r.texts("hold").map(|names| {
        let mut held = [false; 5];
        for (name, span) in names {
            match MOTIONS.iter().position(|motion| *motion == name) {
                Some(k) => held[k] = true,
                None => {
                    let message = format!("{} cannot be `{name}`", r.name("hold"));
                    let problem = Problem::new(Kind::UnknownName, &span, message);
                    r.log.error(problem.expected("some of x, y, z, theta_x, theta_y"));
                }
            }
        }
        held
    });
    study.speed = r.get("speed", not_negative(SPEED));
    study.cage_average = r.flag("cage_average", false);
    study.roughness = r.or("roughness", positive(LENGTH), study.roughness);
    let mut ways = vec![("load", Along::Load)];
    ways.extend(MOTIONS.iter().enumerate().map(|(k, name)| (*name, Along::Axis(k))));
    study.along = r.choice("along", &ways).unwrap_or_default();
    let turning = matches!(study.along, Along::Axis(3 | 4));
    for (of, key) in Swept::ALL {
        let spec = match of {
            Swept::Load => any(if turning { MOMENT } else { FORCE }),
            Swept::Displacement => any(if turning { ANGLE } else { LENGTH }),
            Swept::Speed => not_negative(SPEED),
            Swept::CageAngle => any(ANGLE),
        };
        if let Some(values) = r.sweep(key, spec) {
            increasing(r, key, &values);
            study.sweeps.push(BearingSweep { of, values });
        }
    }
    for (name, span) in r.texts("sweep").unwrap_or_default() {
        match Swept::ALL.iter().find(|(of, _)| of.name() == name) {
            Some((of, _)) if study.sweeps.iter().any(|sweep| sweep.of == *of) => {}
            Some((of, _)) => study.sweeps.push(BearingSweep { of: *of, values: Vec::new() }),
            None => {
                let problem =
                    Problem::new(Kind::UnknownName, &span, format!("{} cannot be `{name}`", r.name("sweep")));
                r.log.error(problem.expected("some of load, displacement, speed, cage_angle"));
            }
        }
    }
    study
}

fn exactly<const N: usize>(r: &Reader, key: &str, components: &str, values: &[f64]) -> Option<[f64; N]> {
    let found = values.try_into().ok();
    if found.is_none() {
        r.error(Kind::WrongType, key, format!("{} must have {N} values: {components}", r.name(key)));
    }
    found
}
