//! Elastohydrodynamic (EHL) pressure and film thickness of the most heavily loaded contacts of a bearing.

use crate::results::{BearingPoint, EhlFilm, PickContact};
use crate::warning::{Code, Warning};
use rotordyn_bearing::BallBearing;
use rotordyn_bearing::contact::ContactLaw;
use rotordyn_bearing::contact::ehl::similarity::{MIN_SOLVED_FILM, SimilarContact};
use rotordyn_bearing::contact::ehl::{self, Grid, Problem};

/// Grid resolution, see [`Grid::flooded`].
const GRID_POINTS: usize = 5;

/// EHL solution of the most heavily loaded ball at both races, for a bearing with the EHL contact law.
///
/// Thickness, approach and rolling resistance are extrapolated to zero mesh width, like those of the tables. Failure to
/// converge, and a film too thin for the grid, are warnings.
pub(super) fn ehl_films(
    name: &str,
    bearing: &BallBearing,
    point: &BearingPoint,
    warnings: &mut Vec<Warning>,
) -> Vec<EhlFilm> {
    let ContactLaw::Ehl(law) = &bearing.contact else { return Vec::new() };
    let g = &bearing.geometry;
    let gamma = g.ball_diameter / g.pitch_diameter * g.contact_angle.cos();
    let entrainment = 0.25 * g.pitch_diameter * (1.0 - gamma * gamma);
    let speed = law.speed_factor * entrainment * point.state.condition.speed.abs();
    let hertz = bearing.hertz();
    let races: [(&'static str, _, PickContact); 2] =
        [("inner", hertz.inner, |b| &b.inner), ("outer", hertz.outer, |b| &b.outer)];
    let mut warn = |text| warnings.push(Warning::new(Code::LubricantFilm, format!("bearing.{name}"), text));
    let mut found = Vec::new();
    for (race, contact, pick) in races {
        let load = point.balls.iter().map(|b| pick(b).load).fold(0.0, f64::max);
        if load <= 0.0 || speed <= 0.0 {
            continue;
        }
        let grid = Grid::flooded(&contact, &law.lubricant, speed, load, GRID_POINTS);
        let problem = Problem { contact, lubricant: law.lubricant.clone(), speed, load, grid };
        let thickness = SimilarContact::new(&contact, &law.lubricant, speed, load).film;
        if thickness < MIN_SOLVED_FILM {
            warn(format!(
                "bearing {name}, {race} race: the film under {load:.4} N at {speed:.4} m/s is too thin for its pressure \
                 to be solved ({thickness:.4} of the contact's depth b²/R, solved from {MIN_SOLVED_FILM}): its thickness is \
                 extrapolated from higher speeds"
            ));
            continue;
        }
        match ehl::extrapolate(&problem, None) {
            Ok(limit) => found.push(EhlFilm { race: race.into(), load, speed, solution: limit.solution() }),
            Err(failure) => warn(format!("bearing {name}, {race} race: {failure}")),
        }
    }
    found
}
