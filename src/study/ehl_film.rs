//! Elastohydrodynamic (EHL) pressure and film thickness of the most heavily loaded contacts of a bearing.

use crate::bearing::BallBearing;
use crate::contact::ContactLaw;
use crate::contact::ehl::{self, Grid, Problem};
use crate::results::{BearingPoint, EhlFilm, PickContact};

/// Grid resolution, see [`Grid::flooded`].
const GRID_POINTS: usize = 8;

/// EHL solution of the most heavily loaded ball at both races, for a bearing with the EHL contact law;
/// failure to converge is a warning.
pub(super) fn ehl_films(
    name: &str,
    bearing: &BallBearing,
    point: &BearingPoint,
    warnings: &mut Vec<String>,
) -> Vec<EhlFilm> {
    let ContactLaw::Ehl(law) = &bearing.contact else { return Vec::new() };
    let g = &bearing.geometry;
    let gamma = g.ball_diameter / g.pitch_diameter * g.contact_angle.cos();
    let entrainment = 0.25 * g.pitch_diameter * (1.0 - gamma * gamma);
    let speed = law.speed_factor * entrainment * point.state.condition.speed.abs();
    let hertz = bearing.hertz();
    let races: [(&'static str, _, PickContact); 2] =
        [("inner", hertz.inner, |b| &b.inner), ("outer", hertz.outer, |b| &b.outer)];
    let mut found = Vec::new();
    for (race, contact, pick) in races {
        let load = point.balls.iter().map(|b| pick(b).load).fold(0.0, f64::max);
        if load <= 0.0 || speed <= 0.0 {
            continue;
        }
        let grid = Grid::flooded(&contact, &law.lubricant, speed, load, GRID_POINTS);
        let problem = Problem { contact, lubricant: law.lubricant.clone(), speed, load, grid };
        match ehl::solve(&problem, None) {
            Ok(solution) => found.push(EhlFilm { race, load, speed, solution }),
            Err(failure) => warnings.push(format!("bearing {name}, {race} race: {failure}")),
        }
    }
    found
}
