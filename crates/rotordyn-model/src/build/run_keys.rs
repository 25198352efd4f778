//! Keys that run-up and steady studies share.

use crate::Model;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, not_negative, positive};
use crate::study::Integrator;
use rotordyn_units::{LENGTH, NUMBER};

pub(super) fn channels(r: &Reader, key: &str, model: &Model) -> Vec<String> {
    let mut channels = Vec::new();
    for (name, span) in r.texts(key).unwrap_or_default() {
        if !model.probes.iter().any(|p| p.name == name) {
            let problem = Problem::new(Kind::UnknownName, &span, format!("unknown probe `{name}`"));
            r.log.error(problem.suggest(name, model.probes.iter().map(|p| p.name.as_str())));
        }
        channels.push(name.to_string());
    }
    channels
}

/// The requested integrator or the default; reject settings of other integrators.
pub(super) fn integrator(r: &Reader, default: Integrator) -> Integrator {
    #[derive(Clone, Copy)]
    enum Method {
        Alpha,
        Newmark,
        Rk4,
        Dopri,
    }
    let methods = [
        ("generalised-alpha", Method::Alpha),
        ("newmark", Method::Newmark),
        ("rk4", Method::Rk4),
        ("dormand-prince", Method::Dopri),
    ];
    let rho = r.get("rho_infinity", not_negative(NUMBER));
    if rho.is_some_and(|rho| rho > 1.0) {
        r.error(Kind::OutOfRange, "rho_infinity", format!("{} must be from 0 to 1", r.name("rho_infinity")));
    }
    let relative = r.get("relative_tolerance", positive(NUMBER));
    let absolute = r.get("absolute_tolerance", positive(LENGTH));
    let Some(method) = r.choice("integrator", &methods) else {
        return match (default, rho) {
            (Integrator::GeneralisedAlpha { .. }, Some(rho_infinity)) => {
                Integrator::GeneralisedAlpha { rho_infinity }
            }
            _ => default,
        };
    };
    let foreign = |key: &str, given: bool, owner: &str| {
        if given {
            r.error(Kind::Conflict, key, format!("{} belongs to integrator = \"{owner}\"", r.name(key)));
        }
    };
    let dopri = matches!(method, Method::Dopri);
    foreign("rho_infinity", rho.is_some() && !matches!(method, Method::Alpha), "generalised-alpha");
    foreign("relative_tolerance", relative.is_some() && !dopri, "dormand-prince");
    foreign("absolute_tolerance", absolute.is_some() && !dopri, "dormand-prince");
    match method {
        Method::Alpha => Integrator::GeneralisedAlpha { rho_infinity: rho.unwrap_or(0.8) },
        Method::Newmark => Integrator::Newmark,
        Method::Rk4 => Integrator::RungeKutta4,
        Method::Dopri => Integrator::DormandPrince {
            relative_tolerance: relative.unwrap_or(1e-6),
            absolute_tolerance: absolute.unwrap_or(1e-12),
        },
    }
}
