//! Equilibrium and stiffness matrix of a single bearing under a load or a prescribed displacement.

use std::sync::Arc;

use super::equilibrium::{CAGE_ANGLES_PER_PITCH, CageTreatment};
use crate::assembly::PhysicsError;
use rayon::prelude::*;
use rotordyn_bearing::{BallBearing, BallLoad, BearingElement, BearingModel, Reaction, Rotation};
use rotordyn_linalg::dot;
use rotordyn_linalg::small_dense::solve_in_place;
use serde::{Deserialize, Serialize};

const MAX_ITERATIONS: usize = 100;
const MAX_HALVINGS: usize = 80;
/// Residual at the solution over the largest force.
const TOLERANCE: f64 = 1e-13;
/// Residual accepted as equilibrium where round-off or a kink in the contact law prevents full convergence.
const ACCEPTED_RESIDUAL: f64 = 1e-8;

/// Resolution of the groove centres' distance in double precision \[m\]: times the stiffness the force left by
/// round-off, also without any load.
const RESOLUTION: f64 = 1e-18;

/// Force accepted as none \[N\] where Newton's method does not converge.
const SMALLEST_FORCE: f64 = 2e-9;

/// Boundary conditions of a single bearing: for each inner-ring motion (u_x u_y u_z θ_x θ_y) the applied load
/// or the prescribed displacement.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Condition {
    /// Load of the shaft on the bearing F_x F_y F_z M_x M_y \[N, N m\]; ignored for prescribed motions.
    pub load: [f64; 5],
    /// Prescribed displacements of the inner ring relative to the outer one \[m, rad\]; `None`: free.
    pub prescribed: [Option<f64>; 5],
    /// Shaft speed Ω \[rad/s\].
    pub speed: f64,
    pub cage: CageTreatment,
    /// Angle of ball 0 \[rad\].
    pub cage_angle: f64,
}

/// A bearing in equilibrium.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingEquilibrium {
    pub condition: Condition,
    /// Displacement of the inner ring relative to the outer one \[m, rad\].
    pub displacement: [f64; 5],
    /// Load of the shaft on the bearing \[N, N m\]: applied load, and reactions of prescribed displacements.
    pub load: [f64; 5],
    /// K = ∂load/∂displacement in the order x y z θ_x θ_y \[N/m, N, N m/rad\]. Source: Zhang 2016 eq. 14.
    pub stiffness: [[f64; 5]; 5],
    /// Load-weighted mean of cos α over the loaded balls.
    pub mean_cos: f64,
    pub iterations: usize,
    /// Largest unbalanced force \[N\], moments divided by the pitch radius.
    pub residual: f64,
}

impl BearingEquilibrium {
    /// Stiffness along a direction n with all other motions constrained: nᵀ K n.
    pub fn constrained_stiffness(&self, n: &[f64; 5]) -> f64 {
        (0..5).map(|a| n[a] * (0..5).map(|b| self.stiffness[a][b] * n[b]).sum::<f64>()).sum()
    }

    /// Stiffness along n with the other motions free unless prescribed (static condensation), 1 / (nᵀ K⁻¹ n);
    /// never above the constrained stiffness, 0 where nothing resists.
    ///
    /// `radius`: length \[m\] by which rotations are scaled in the solve.
    pub fn condensed_stiffness(&self, n: &[f64; 5], radius: f64) -> f64 {
        let unit = [1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius];
        let free: [bool; 5] = std::array::from_fn(|a| self.condition.prescribed[a].is_none() || n[a] != 0.0);
        let scaled = |a: usize, b: usize| unit[a] * self.stiffness[a][b] * unit[b];
        let largest = (0..5).map(|a| scaled(a, a)).fold(0.0, f64::max);
        if largest <= 0.0 {
            return 0.0;
        }
        let direction: [f64; 5] = std::array::from_fn(|a| n[a] * unit[a]);
        let mut x = direction;
        let mut k = [0.0; 25];
        for a in 0..5 {
            for b in 0..5 {
                k[5 * a + b] = if free[a] && free[b] { scaled(a, b) / largest } else { 0.0 };
            }
            // Regularisation: an unresisted motion gets a huge compliance, reported below as zero stiffness.
            k[6 * a] += if free[a] { 1e-14 } else { 1.0 };
        }
        if !solve_in_place(&mut k, &mut x) {
            return 0.0;
        }
        let compliance = dot(&direction, &x);
        let stiffness = largest / compliance;
        if stiffness > 1e-10 * largest { stiffness } else { 0.0 }
    }
}

/// Static equilibrium solver of a single ball bearing.
#[derive(Clone, Debug)]
pub struct BearingSolver {
    pub name: String,
    pub element: Arc<dyn BearingElement>,
    /// Length by which rotations are scaled: the pitch radius \[m\].
    pub radius: f64,
    /// Series stiffness of a ball's dry contacts, for an initial estimate of the stiffness \[N/m^1.5\].
    contact_stiffness: f64,
}

/// A trial state; displacements and residual with rotations scaled to lengths.
struct Trial {
    x: [f64; 5],
    reaction: Reaction,
    residual: [f64; 5],
}

impl BearingSolver {
    /// Prepares a bearing.
    pub fn new(name: &str, bearing: &BallBearing) -> Self {
        Self {
            name: name.into(),
            element: bearing.element(),
            radius: 0.5 * bearing.geometry.pitch_diameter,
            contact_stiffness: bearing.hertz().stiffness,
        }
    }

    /// Force on the shaft with its tangents at a displacement, under a condition's speed and cage.
    pub fn reaction(&self, condition: &Condition, d: &[f64; 5]) -> Reaction {
        let d = [d[0], d[1], d[2], d[3], d[4], 0.0];
        let rotation = rotation(condition);
        match condition.cage {
            CageTreatment::FixedAngle => self.element.reaction(&d, &[0.0; 6], &rotation),
            CageTreatment::Averaged => self.element.cage_average(&d, &rotation, CAGE_ANGLES_PER_PITCH),
        }
    }

    /// Load of every ball at an equilibrium, at the condition's cage angle.
    pub fn ball_loads(&self, found: &BearingEquilibrium) -> Vec<BallLoad> {
        let d = &found.displacement;
        self.element.contact_loads(&[d[0], d[1], d[2], d[3], d[4], 0.0], &rotation(&found.condition))
    }

    /// Finds the equilibrium by damped Newton-Raphson (line search), from `start` or the centred bearing.
    ///
    /// Solves load + f(d) = 0 in every free motion. The contact energy is convex, so a Newton step shortened
    /// until the force along it has fallen converges through clearance and loss of contact; without contact a
    /// fraction of the Hertz stiffness under the load regularises the step.
    ///
    /// # Errors
    /// [`PhysicsError::NoBearingEquilibrium`] with load, speed and residual.
    pub fn solve(
        &self,
        condition: &Condition,
        start: Option<&[f64; 5]>,
    ) -> Result<BearingEquilibrium, PhysicsError> {
        let found = match (self.newton(condition, start.unwrap_or(&[0.0; 5])), start) {
            (Err(_), Some(_)) => self.newton(condition, &[0.0; 5]),
            (found, _) => found,
        };
        found.or_else(|error| self.by_larger_loads(condition).ok_or(error))
    }

    /// Equilibrium by way of those under larger loads, where contacts are less abrupt; `None` if it is not found.
    fn by_larger_loads(&self, condition: &Condition) -> Option<BearingEquilibrium> {
        let mut start = [0.0; 5];
        let mut found = None;
        for factor in [1e6, 1e5, 1e4, 1e3, 1e2, 1e1, 1.0] {
            let larger = Condition { load: condition.load.map(|f| f * factor), ..*condition };
            found = self.newton(&larger, &start).ok();
            start = found.as_ref().map_or(start, |found| found.displacement);
        }
        found
    }

    fn newton(&self, condition: &Condition, start: &[f64; 5]) -> Result<BearingEquilibrium, PhysicsError> {
        let unit = [1.0, 1.0, 1.0, 1.0 / self.radius, 1.0 / self.radius];
        let free = condition.prescribed.map(|held| held.is_none());
        let trial = |x: [f64; 5]| {
            let d: [f64; 5] = std::array::from_fn(|a| unit[a] * x[a]);
            let reaction = self.reaction(condition, &d);
            let residual = std::array::from_fn(|a| match free[a] {
                true => unit[a] * (condition.load[a] + reaction.force[a]),
                false => 0.0,
            });
            Trial { x, reaction, residual }
        };
        let mut now = trial(std::array::from_fn(|a| condition.prescribed[a].unwrap_or(start[a]) / unit[a]));
        let scaled_load: [f64; 5] =
            std::array::from_fn(|a| if free[a] { unit[a] * condition.load[a] } else { 0.0 });
        let load_size = max_abs(&scaled_load);
        // Reference force: of the load or, under preload, of the balls.
        let size_of = |t: &Trial| {
            let force: [f64; 5] = std::array::from_fn(|a| unit[a] * t.reaction.force[a]);
            load_size.max(max_abs(&force)).max(f64::MIN_POSITIVE)
        };
        let hertz = (self.contact_stiffness.powi(2) * size_of(&now).max(1e-3)).cbrt();
        let mut iterations = 0;
        let mut stalled = 0;
        let round_off = |t: &Trial| {
            let stiffness = |a: usize| (unit[a] * t.reaction.stiffness[a][a] * unit[a]).abs();
            RESOLUTION * (0..5).map(stiffness).fold(0.0, f64::max)
        };
        while max_abs(&now.residual) > TOLERANCE * size_of(&now) && iterations < MAX_ITERATIONS && stalled < 3
        {
            iterations += 1;
            let before = max_abs(&now.residual);
            let shift = hertz * (1e-3 * (before / size_of(&now)).min(1.0) + 1e-12);
            let mut k = [0.0; 25];
            for a in 0..5 {
                for b in 0..5 {
                    k[5 * a + b] = match free[a] && free[b] {
                        true => unit[a] * now.reaction.stiffness[a][b] * unit[b],
                        false => 0.0,
                    };
                }
                k[6 * a] += if free[a] { shift } else { 1.0 };
            }
            let mut step = now.residual;
            if !solve_in_place(&mut k, &mut step) {
                break;
            }
            let along = |r: &[f64; 5]| dot(r, &step);
            let first = along(&now.residual);
            // Zero or negative only by round-off at the solution.
            let at_solution = first <= 0.0 || first.is_nan();
            let (mut low, mut high, mut length) = (0.0, f64::INFINITY, 1.0);
            for halving in 0..MAX_HALVINGS {
                let next = trial(std::array::from_fn(|a| now.x[a] + length * step[a]));
                let force_along = along(&next.residual);
                if force_along.abs() <= 0.9 * first.abs() || at_solution || halving + 1 == MAX_HALVINGS {
                    let after = max_abs(&next.residual);
                    let near = before <= (ACCEPTED_RESIDUAL * size_of(&now)).max(round_off(&now));
                    stalled = if near && after > 0.5 * before { stalled + 1 } else { 0 };
                    // At round-off level: keep the smaller residual.
                    if !(near && after >= before) {
                        now = next;
                    }
                    break;
                }
                if force_along > 0.0 {
                    low = length;
                } else {
                    high = length;
                }
                length = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * length };
            }
        }
        let residual = max_abs(&now.residual);
        let lost = max_abs(&now.x) > 10.0 * self.radius;
        let accepted = (ACCEPTED_RESIDUAL * size_of(&now)).max(round_off(&now)).max(SMALLEST_FORCE);
        if residual > accepted || residual.is_nan() || lost {
            return Err(PhysicsError::NoBearingEquilibrium {
                bearing: self.name.clone(),
                load: condition.load,
                speed_rpm: condition.speed * 30.0 / std::f64::consts::PI,
                residual,
                iterations,
            });
        }
        let reaction = now.reaction;
        Ok(BearingEquilibrium {
            condition: *condition,
            displacement: std::array::from_fn(|a| unit[a] * now.x[a]),
            load: std::array::from_fn(|a| if free[a] { condition.load[a] } else { -reaction.force[a] }),
            stiffness: std::array::from_fn(|a| std::array::from_fn(|b| reaction.stiffness[a][b])),
            mean_cos: reaction.mean_cos,
            iterations,
            residual,
        })
    }

    /// Equilibria of a list of conditions, each started from the previous one; ends at the first failure.
    pub fn sweep(&self, conditions: &[Condition]) -> (Vec<BearingEquilibrium>, Option<PhysicsError>) {
        let mut found: Vec<BearingEquilibrium> = Vec::with_capacity(conditions.len());
        for condition in conditions {
            match self.solve(condition, found.last().map(|last| &last.displacement)) {
                Ok(point) => found.push(point),
                Err(error) => return (found, Some(error)),
            }
        }
        (found, None)
    }

    /// Equilibria over a table of conditions, every row a sweep of its own; rows run in parallel.
    ///
    /// # Errors
    /// The first condition (in the order of the table) without equilibrium.
    pub fn map(&self, rows: &[Vec<Condition>]) -> Result<Vec<Vec<BearingEquilibrium>>, PhysicsError> {
        let row = |conditions: &Vec<Condition>| match self.sweep(conditions) {
            (found, None) => Ok(found),
            (_, Some(error)) => Err(error),
        };
        rows.par_iter().map(row).collect::<Vec<_>>().into_iter().collect()
    }
}

fn rotation(condition: &Condition) -> Rotation {
    Rotation { cage_angle: condition.cage_angle, shaft_speed: condition.speed, ..Rotation::default() }
}

fn max_abs(v: &[f64; 5]) -> f64 {
    v.iter().fold(0.0, |m: f64, x| if x.is_nan() || m.is_nan() { f64::NAN } else { m.max(x.abs()) })
}
