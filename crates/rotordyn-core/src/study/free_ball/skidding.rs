//! Cage slip over load and speed.

use super::error::FreeBallStudyError;
use super::steady::steady_run;
use crate::model::free_ball_study::{FreeBallStudy, SkiddingMapStudy};
use crate::results::SkiddingMap;
use rayon::prelude::*;
use rotordyn_bearing::free_ball::FreeBallBearing;

/// Steady runs over loads and speeds, in parallel; each is by itself, so that the numbers do not depend on the threads.
///
/// # Errors
/// The load of the settings has no direction. A point whose run fails is NaN in the map, with its cause beside it.
pub fn skidding_map(
    name: &str,
    bearing: &FreeBallBearing,
    study: &SkiddingMapStudy,
) -> Result<SkiddingMap, FreeBallStudyError> {
    let force = study.point.force;
    let size = force.iter().map(|f| f * f).sum::<f64>().sqrt();
    if !(size > 0.0 && size.is_finite()) {
        return Err(FreeBallStudyError::Setting {
            bearing: name.into(),
            what: "a load with a direction for its skidding map",
        });
    }
    let points: Vec<[f64; 2]> =
        study.loads.iter().flat_map(|load| study.speeds.iter().map(|speed| [*load, *speed])).collect();
    let run = |[load, speed]: &[f64; 2]| {
        let point = FreeBallStudy { force: force.map(|f| f * load / size), speed: *speed, ..study.point };
        steady_run(name, bearing, &point)
    };
    let found: Vec<_> = points.par_iter().map(run).collect();
    let value = |pick: &dyn Fn(&crate::results::FreeBallResult) -> f64| -> Vec<f64> {
        found.iter().map(|point| point.as_ref().map_or(f64::NAN, pick)).collect()
    };
    let failure = |([load, _], point): (&[f64; 2], &Result<_, FreeBallStudyError>)| {
        point.as_ref().err().map(|error| format!("{load:.4} N: {error}"))
    };
    Ok(SkiddingMap {
        name: name.into(),
        loads: study.loads.clone(),
        speeds: study.speeds.clone(),
        slip: value(&|point| point.slip),
        heat: value(&|point| point.losses.iter().sum()),
        failures: points.iter().zip(&found).filter_map(failure).collect(),
    })
}
