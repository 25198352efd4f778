//! Free balls at the operating points of analysed bearings, and their skidding maps.

use super::error::FreeBallStudyError;
use super::skidding::skidding_map;
use super::steady::stoppable_run;
use crate::model::free_ball_study::{FreeBallStudy, SkiddingMapStudy};
use crate::model::study::{BearingStudy, SkiddingRange};
use crate::results::BearingResult;
use crate::warning::{Code, Warning};
use rayon::prelude::*;
use rotordyn_bearing::free_ball::FreeBallBearing;
use std::ops::ControlFlow;

/// Loads and speeds of a map without given ones, over those of the operating point.
const LOAD_SHARES: [f64; 5] = [0.05, 0.1, 0.2, 0.5, 1.0];
const SPEED_SHARES: [f64; 5] = [0.2, 0.4, 0.6, 0.8, 1.0];

/// Adds to every result of a bearing with free balls their run at the operating point's force and speed, with aligned
/// rings, and the skidding map that the study asks for.
///
/// `progress` takes the runs done and all runs, and may stop: what is done until then is kept. Returns whether all is done.
/// A bearing that does not settle has a warning.
pub fn add_free_balls(
    found: &mut [BearingResult],
    bearings: &[(String, FreeBallBearing)],
    study: &BearingStudy,
    progress: &(dyn Fn(usize, usize) -> ControlFlow<()> + Sync),
) -> bool {
    let free = |name: &str| bearings.iter().find(|(other, _)| other == name).map(|(_, free)| free);
    let mut found: Vec<_> =
        found.iter_mut().filter_map(|found| free(&found.name).map(|free| (found, free))).collect();
    let maps: Vec<Option<SkiddingMapStudy>> =
        found.iter().map(|(found, _)| study.skidding.as_ref().map(|range| map_study(found, range))).collect();
    let points = |map: &SkiddingMapStudy| map.loads.len() * map.speeds.len();
    let all = found.len() + maps.iter().flatten().map(points).sum::<usize>();

    let settled = found.par_iter_mut().map(|(found, free)| {
        let progress_or_stop = || progress(0, all);
        match stoppable_run(&found.name, free, &operating(found), &progress_or_stop) {
            Ok(run) => found.free_balls = Some(run),
            Err(FreeBallStudyError::Stopped { .. }) => return false,
            Err(error) => found.warnings.push(warning(&found.name, error.to_string())),
        }
        true
    });
    let mut complete = settled.reduce(|| true, |a, b| a && b);

    let mut done = found.len();
    for ((found, free), map) in found.iter_mut().zip(&maps) {
        let Some(map) = map.as_ref().filter(|_| complete) else { continue };
        match skidding_map(&found.name, free, map, &|points| progress(done + points, all)) {
            Ok(skidding) => {
                complete = skidding.complete;
                let failures = skidding.failure_summary();
                found.warnings.extend(failures.map(|text| warning(&found.name, text)));
                found.skidding = Some(skidding);
            }
            Err(error) => found.warnings.push(warning(&found.name, error.to_string())),
        }
        done += points(map);
    }
    complete
}

fn warning(bearing: &str, text: String) -> Warning {
    Warning::new(Code::FreeBalls, format!("bearing.{bearing}"), text)
}

/// Settings of the run at the operating point of a result.
fn operating(found: &BearingResult) -> FreeBallStudy {
    let [x, y, z, ..] = found.point.state.load;
    FreeBallStudy::new([x, y, z], found.point.state.condition.speed)
}

fn map_study(found: &BearingResult, range: &SkiddingRange) -> SkiddingMapStudy {
    let point = operating(found);
    let load = point.force.iter().map(|f| f * f).sum::<f64>().sqrt();
    let given_or = |given: &[f64], shares: [f64; 5], of: f64| match given {
        [] => shares.map(|share| share * of).to_vec(),
        given => given.to_vec(),
    };
    SkiddingMapStudy {
        loads: given_or(&range.loads, LOAD_SHARES, load),
        speeds: given_or(&range.speeds, SPEED_SHARES, point.speed),
        point,
    }
}
