//! Check of a run's start: no two parts of a bearing with free balls share space, by their shapes.

use crate::geometry::rapier::overlaps;
use rotordyn_bearing::PlacedBalls;

/// Elastic approach of a ball and a race over the ball diameter that loads and preload may cause: Hertzian contacts reach
/// 4 GPa, the static limit of steel, at less than half of it.
const RACE_ALLOWANCE: f64 = 0.01;

/// The deepest overlap of balls, cage and rings in words; `None` if they are apart or pressed on the races as by a load.
pub(crate) fn overlap_at_start(placed: &PlacedBalls) -> Option<String> {
    let PlacedBalls { balls, state, rings } = placed;
    let allowance = RACE_ALLOWANCE * balls.bearing().ball.geometry.ball_diameter;
    let found = overlaps(balls, state, rings, allowance);
    let deepest = found.iter().max_by(|a, b| a.depth.total_cmp(&b.depth))?;
    Some(format!("{deepest} at the start"))
}
