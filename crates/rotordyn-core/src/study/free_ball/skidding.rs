//! Cage slip over load and speed.
//!
//! Cage slip \[%\] of a 120 mm angular contact bearing under thrust, comparable to that of NASA TN D-7870 (Bamberger, Zaretsky &
//! Signer 1975: up to 25 000 rpm and 22 240 N skidding of 0 to 6 %, generally growing with speed at a given load):
//!
//! | thrust \[N\] | 12 000 rpm | 16 700 rpm | 20 800 rpm | 25 000 rpm |
//! |---|---|---|---|---|
//! | 6672 | 1.09 | 1.65 | 2.40 | 3.48 |
//! | 13 345 | 1.02 | 1.26 | 1.55 | 2.35 |
//! | 22 240 | 0.85 | 1.31 | 1.40 | 1.61 |
//!
//! Bore, speeds and greatest thrust are the report's; balls, contact angle, cage, traction curve and the oil around the balls are
//! assumed (`tests/literature/nasa_tn_d_7870.rs`), and slip depends on the last of them: with a third of that oil 1.3 % at most
//! instead of 3.5 %. So trend and size agree, single values cannot be compared. Slip counts from the kinematic cage under outer
//! race control, as the balls' spin axes are not known before.

use super::error::FreeBallStudyError;
use super::steady::stoppable_run;
use crate::model::free_ball_study::{FreeBallStudy, SkiddingMapStudy};
use crate::results::{FreeBallResult, SkiddingMap};
use rayon::prelude::*;
use rotordyn_bearing::free_ball::FreeBallBearing;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Steady runs over loads and speeds, in parallel; each is by itself, so that the numbers do not depend on the threads.
///
/// `progress` takes the number of points done and may stop: the map then has the points done until then.
///
/// # Errors
/// The load of the settings has no direction. A point whose run fails is NaN in the map, with its cause beside it.
pub fn skidding_map(
    name: &str,
    bearing: &FreeBallBearing,
    study: &SkiddingMapStudy,
    progress: &(dyn Fn(usize) -> ControlFlow<()> + Sync),
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
    let done = AtomicUsize::new(0);
    let run = |[load, speed]: &[f64; 2]| {
        let progress_or_stop = || progress(done.load(Ordering::Relaxed));
        if progress_or_stop().is_break() {
            return Err(FreeBallStudyError::Stopped { bearing: name.into() });
        }
        let point = FreeBallStudy { force: force.map(|f| f * load / size), speed: *speed, ..study.point };
        let found = stoppable_run(name, bearing, &point, &progress_or_stop);
        done.fetch_add(1, Ordering::Relaxed);
        found
    };
    let found: Vec<_> = points.par_iter().map(run).collect();
    let value = |pick: &dyn Fn(&FreeBallResult) -> f64| -> Vec<f64> {
        found.iter().map(|point| point.as_ref().map_or(f64::NAN, pick)).collect()
    };
    let is_stopped =
        |point: &Result<_, FreeBallStudyError>| matches!(point, Err(FreeBallStudyError::Stopped { .. }));
    let failure = |([load, _], point): (&[f64; 2], &Result<_, FreeBallStudyError>)| {
        let error = point.as_ref().err().filter(|_| !is_stopped(point))?;
        Some(format!("{load:.4} N: {error}"))
    };
    Ok(SkiddingMap {
        name: name.into(),
        loads: study.loads.clone(),
        speeds: study.speeds.clone(),
        slip: value(&|point| point.slip),
        heat: value(&|point| point.losses.iter().sum()),
        failures: points.iter().zip(&found).filter_map(failure).collect(),
        complete: !found.iter().any(is_stopped),
    })
}
