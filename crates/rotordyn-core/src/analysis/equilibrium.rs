//! Static equilibrium of the machine on its nonlinear bearings.

use std::sync::Arc;

pub use super::bearing_state::{BearingState, CAGE_ANGLES_PER_PITCH, CageTreatment};
use super::belt_pull::{BeltPull, belt_pulls};
use super::mounted_preload::mounted_preloads;
use super::preload::MountedPreload;
use super::section_loads::ShaftSections;
use super::shaft_loads::{self, ShaftPoint};
use super::support_forces::{SupportForce, support_forces};
use crate::assembly::rigid_body_modes::motion_of;
use crate::assembly::{Assembly, DofMap, PhysicsError};
use crate::document::{Document, Rows, in_hdf5, in_json, named};
use crate::model::{Model, ShaftExtent};
use rotordyn_bearing::{BearingElement, Reaction, Rotation, SiteTangent};
use rotordyn_linalg::refinement::{NEGLIGIBLE, PreciseResidual, refine};
use rotordyn_linalg::{SparseMatrix, SparseRow, Triplets, dot};
use serde::{Deserialize, Serialize};

/// Residual over the largest load or bearing force.
const TOLERANCE: f64 = 1e-11;
/// The same, accepted where round-off prevents it.
const ACCEPTED: f64 = 1e-9;
/// Multiple of the mass matrix in the tangent that remains at the solution \[1/s²\].
const LEAST_SHIFT: f64 = 1e-4;
/// Multiples of it where the tangent is singular to round-off.
const LARGER_SHIFTS: [f64; 3] = [1e3, 1e6, 1e9];
const MAX_ITERATIONS: usize = 200;
/// Steps without progress near convergence after which Newton's method ends.
const STALLED: usize = 3;
const MAX_HALVINGS: usize = 80;
/// Force accepted as none \[N\] where Newton's method does not converge.
const SMALLEST_FORCE: f64 = 2e-9;
/// Relative correction at the end of the refinement that is an error: those that shrink end far below, those that do not begin
/// far above; in between is the noise of bearing forces in motions that hardly anything holds.
const MAX_ROUND_OFF: f64 = 1e-2;
/// Relative round-off of a sum of structural forces.
const ROUND_OFF: f64 = 1e-14;
/// Resolution of the groove centres' distance in double precision \[m\].
const RESOLUTION: f64 = 1e-18;

/// Static equilibrium K q = f_gravity + f_static + Σ Rᵀ f_bearing(R q).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Equilibrium {
    /// Speed at which speed-dependent bearings are evaluated \[rad/s\].
    pub speed: f64,
    pub cage: CageTreatment,
    /// Displacements of the free DOFs \[m, rad\].
    pub q: Vec<f64>,
    pub bearings: Vec<BearingState>,
    pub belts: Vec<BeltPull>,
    pub preloads: Vec<MountedPreload>,
    pub iterations: usize,
    /// Largest unbalanced force or moment \[N, N m\].
    pub residual: f64,
    /// Deflection and loads along the shaft, and the forces of its supports; empty for a rigid rotor, and where only the
    /// equilibrium is of interest.
    pub shaft: Vec<ShaftPoint>,
    pub support_forces: Vec<SupportForce>,
}

impl Equilibrium {
    /// Tangents of all bearings in the order of the model.
    pub fn tangents(&self) -> Vec<SiteTangent> {
        self.bearings.iter().map(|b| b.tangent).collect()
    }

    /// The equilibrium with deflection, section loads and support forces of the shaft.
    pub fn with_shaft_loads(mut self, model: &Model, assembly: &Assembly) -> Self {
        let q = assembly.dofs.expand(&self.q);
        let sections = ShaftSections::new(model).at_rest(&q);
        self.shaft = shaft_loads::at_rest(model, &sections, &q);
        self.support_forces = support_forces(model, &sections);
        self
    }

    /// What is written to files.
    pub fn document(&self, dofs: &DofMap) -> Document<'_> {
        let q = dofs.expand(&self.q);
        let nodes: Vec<_> = dofs.node_names.iter().zip(q.chunks(6)).collect();
        let rows = Rows::of(&nodes).text(in_json("node"), |(name, _)| name).numbers(
            "displacement",
            "m, rad",
            &[6],
            |(_, q)| q,
        );
        Document::new()
            .quantity("speed", "rad/s", self.speed)
            .text(in_hdf5("cage"), self.cage.name())
            .integer("iterations", self.iterations)
            .quantity("residual", "N", self.residual)
            .table(named("nodes", ""), rows)
            .table("shaft", ShaftPoint::columns(&self.shaft))
            .table("support_forces", SupportForce::columns(&self.support_forces))
            .groups("belts", "name", self.belts.iter().map(|b| (b.name.clone(), b.document())))
            .groups("preloads", "bearing", self.preloads.iter().map(|p| (p.bearing.clone(), p.document())))
            .groups("bearings", "name", self.bearings.iter().map(|b| (b.name.clone(), b.document())))
    }
}

/// The bearings of a model at a speed, for the evaluation of their forces.
pub(super) struct Sites {
    elements: Vec<(Arc<dyn BearingElement>, Rotation)>,
    cage: CageTreatment,
}

impl Sites {
    pub(super) fn new(model: &Model, speed: f64, cage: CageTreatment) -> Self {
        let elements = model
            .bearings
            .iter()
            .map(|site| {
                let rotation = Rotation {
                    cage_angle: site.bearing.cage_angle(),
                    shaft_speed: speed,
                    ..Rotation::default()
                };
                (site.bearing.element(), rotation)
            })
            .collect();
        Self { elements, cage }
    }

    pub(super) fn reaction(&self, k: usize, d: &[f64; 6]) -> Reaction {
        let (element, rotation) = &self.elements[k];
        match self.cage {
            CageTreatment::FixedAngle => element.reaction(d, &[0.0; 6], rotation),
            CageTreatment::Averaged => element.cage_average(d, rotation, CAGE_ANGLES_PER_PITCH),
        }
    }

    pub(super) fn reactions(&self, assembly: &Assembly, q: &[f64]) -> Vec<Reaction> {
        assembly.sites.iter().enumerate().map(|(k, site)| self.reaction(k, &site.relative(q))).collect()
    }
}

/// Finds the static equilibrium at a speed by damped Newton-Raphson (line search), from `start` or q = 0.
///
/// The structure and the Hertz contacts have a convex energy, so a Newton step shortened until the force along
/// it has fallen converges for any clearance and any number of unloaded balls. While no ball carries load
/// (all within the clearance) a vanishing multiple of M regularises the step.
/// Elastic forces only: no damping, no cage motion past the rings.
///
/// # Errors
/// [`PhysicsError::RoundOff`] for more elements than double precision solves (some ten thousand),
/// [`PhysicsError::Singular`] when a load excites a rigid-body mode, [`PhysicsError::NoEquilibrium`] when
/// Newton ends before the residual is below 1e-9 of the loads and bearing forces, or below round-off.
pub fn equilibrium(
    model: &Model,
    assembly: &Assembly,
    speed: f64,
    cage: CageTreatment,
    start: Option<&[f64]>,
) -> Result<Equilibrium, PhysicsError> {
    let sites = Sites::new(model, speed, cage);
    let Solution { q, reactions, iterations, residual } = solve(model, assembly, &sites, speed, start)?;
    let bearings: Vec<BearingState> = (0..assembly.sites.len())
        .map(|k| {
            let displacement = assembly.sites[k].relative(&q);
            let (element, rotation) = &sites.elements[k];
            BearingState {
                name: assembly.sites[k].name.clone(),
                displacement,
                force: reactions[k].force,
                tangent: SiteTangent::from(&reactions[k]),
                balls: element.contact_loads(&displacement, rotation),
                largest_ball_load: largest_ball_load(element.as_ref(), &displacement, rotation),
                preload: element.preload_state(speed),
            }
        })
        .collect();
    Ok(Equilibrium {
        speed,
        cage,
        belts: belt_pulls(model, assembly, &q),
        preloads: mounted_preloads(model, &sites.elements, &bearings, cage),
        bearings,
        q,
        iterations,
        residual,
        shaft: Vec::new(),
        support_forces: Vec::new(),
    })
}

/// Tangents of all bearings in the [`equilibrium`] at a speed, in the order of the model.
///
/// # Errors
/// As [`equilibrium`].
pub fn equilibrium_tangents(
    model: &Model,
    assembly: &Assembly,
    speed: f64,
    cage: CageTreatment,
    start: Option<&[f64]>,
) -> Result<Vec<SiteTangent>, PhysicsError> {
    let found = solve(model, assembly, &Sites::new(model, speed, cage), speed, start)?;
    Ok(found.reactions.iter().map(SiteTangent::from).collect())
}

/// Displacements of an equilibrium, with the bearings' forces and tangents there.
struct Solution {
    q: Vec<f64>,
    reactions: Vec<Reaction>,
    iterations: usize,
    residual: f64,
}

/// Newton's method of [`equilibrium`].
fn solve(
    model: &Model,
    assembly: &Assembly,
    sites: &Sites,
    speed: f64,
    start: Option<&[f64]>,
) -> Result<Solution, PhysicsError> {
    let n = assembly.dofs.len();
    let load = external_load(assembly);
    let external = max_abs(&load).max(1e-6);
    let layout = assembly.layouts.layout(&[&assembly.mass, &assembly.stiffness, &bearing_pattern(assembly)]);
    let stiffness = layout.scatter(&assembly.stiffness);
    let mass = layout.scatter(&assembly.mass);

    let residual_of =
        |q: &[f64], reactions: &[Reaction]| residual_force(assembly, load.clone(), q, reactions);

    // Forces of preloaded bearings may exceed the load.
    let size_of = |reactions: &[Reaction]| {
        reactions.iter().flat_map(|r| &r.force[..3]).fold(external, |size, force| size.max(force.abs()))
    };

    let structural_force =
        |q: &[f64]| (0..n).map(|i| (assembly.stiffness.get(i, i) * q[i]).abs()).fold(0.0, f64::max);

    // Round-off of the forces, also without any load: of structure and bearings at these displacements.
    let round_off = |q: &[f64], reactions: &[Reaction]| {
        let structure = structural_force(q);
        let contacts = reactions.iter().flat_map(|r| (0..3).map(|a| r.stiffness[a][a].abs()));
        ROUND_OFF * structure + RESOLUTION * contacts.fold(0.0, f64::max)
    };

    let factor = |reactions: &[Reaction], shift: f64| {
        let tangent = layout.scatter(&bearing_stiffness_matrix(assembly, reactions));
        let shifted = |shift: f64| {
            let values = (0..tangent.len()).map(|k| stiffness[k] + tangent[k] + shift * mass[k]).collect();
            layout.factor::<f64>(values)
        };
        // In small machines, whose natural frequencies are high, the free rotation needs more.
        let larger = || LARGER_SHIFTS.iter().find_map(|factor| shifted(factor * shift).ok());
        shifted(shift).or_else(|p| {
            larger().ok_or_else(|| PhysicsError::Singular { motion: motion_of(assembly, p.unknown) })
        })
    };

    let mut q = start.map_or_else(|| vec![0.0; n], <[f64]>::to_vec);
    let mut reactions = sites.reactions(assembly, &q);
    let mut residual = residual_of(&q, &reactions);
    let mut iterations = 0;
    let mut stalled = 0;
    while max_abs(&residual) > TOLERANCE * size_of(&reactions)
        && iterations < MAX_ITERATIONS
        && stalled < STALLED
    {
        iterations += 1;
        let size = size_of(&reactions);
        // (2π · 3 Hz)² at a residual of the load's size, decreasing with it: fast convergence at the end.
        let shift = 350.0 * (max_abs(&residual) / size).min(1.0) + LEAST_SHIFT;
        let lu = factor(&reactions, shift)?;
        let mut direction = residual.clone();
        lu.solve(&mut direction);
        let before = dot(&residual, &direction);
        // Line search: bisection on the force along the step until it has fallen.
        let (mut low, mut high, mut length) = (0.0, f64::INFINITY, 1.0);
        for halving in 0..MAX_HALVINGS {
            let trial: Vec<f64> = q.iter().zip(&direction).map(|(q, p)| q + length * p).collect();
            let trial_reactions = sites.reactions(assembly, &trial);
            let trial_residual = residual_of(&trial, &trial_reactions);
            let along = dot(&trial_residual, &direction);
            // `before` is zero or negative only by round-off, at the solution.
            let at_solution = before <= 0.0 || before.is_nan();
            if along.abs() <= 0.9 * before.abs() || at_solution || halving + 1 == MAX_HALVINGS {
                let (now, then) = (max_abs(&trial_residual), max_abs(&residual));
                // Stagnation at round-off level. A sum of structural forces falls to their last digit and no further; else the
                // method stops after three steps without progress near convergence.
                let at_last_digit = then <= 2.0 * f64::EPSILON * structural_force(&q);
                stalled = match then <= 1e4 * TOLERANCE * size {
                    true if at_last_digit && now > 0.5 * then => STALLED,
                    true if now > 0.999 * then => stalled + 1,
                    _ => 0,
                };
                (q, reactions, residual) = (trial, trial_reactions, trial_residual);
                break;
            }
            if along > 0.0 {
                low = length;
            } else {
                high = length;
            }
            length = if high.is_finite() { 0.5 * (low + high) } else { 2.0 * length };
        }
    }
    let left = max_abs(&residual);
    let worst = residual.iter().position(|r| r.abs() == left).unwrap_or(0);
    let furthest = max_abs(&q);
    if furthest > 1e3 {
        let worst = q.iter().position(|v| v.abs() == furthest).unwrap_or(0);
        return Err(PhysicsError::Singular { motion: motion_of(assembly, worst) });
    }
    if f64::EPSILON * structural_force(&q) > NEGLIGIBLE * size_of(&reactions) {
        let lu = factor(&reactions, LEAST_SHIFT)?;
        let error = refine(&mut q, |q| {
            let mut forces = load.clone();
            for (site, reaction) in assembly.sites.iter().zip(sites.reactions(assembly, q)) {
                site.add_force(&reaction, &mut forces);
            }
            let mut residual = PreciseResidual::of(&forces);
            residual.subtract(1.0, &assembly.stiffness, q);
            let mut step = residual.values();
            lu.solve(&mut step);
            step
        });
        if error > MAX_ROUND_OFF || error.is_nan() {
            return Err(PhysicsError::RoundOff { error, shaft: ShaftExtent::of(model).to_string() });
        }
        reactions = sites.reactions(assembly, &q);
    }
    let accepted = (ACCEPTED * size_of(&reactions)).max(round_off(&q, &reactions));
    if left > accepted.max(SMALLEST_FORCE) || left.is_nan() {
        return Err(PhysicsError::NoEquilibrium {
            item: assembly.dofs.name(worst),
            speed_rpm: speed * 30.0 / std::f64::consts::PI,
            residual: left,
            iterations,
        });
    }
    Ok(Solution { q, reactions, iterations, residual: left })
}

/// Gravity and constant loads.
pub(super) fn external_load(assembly: &Assembly) -> Vec<f64> {
    assembly.gravity_load.iter().zip(&assembly.static_load).map(|(g, s)| g + s).collect()
}

/// Residual force (out-of-balance force) f − K q + Σ Rᵀ f_bearing.
pub(super) fn residual_force(
    assembly: &Assembly,
    mut load: Vec<f64>,
    q: &[f64],
    reactions: &[Reaction],
) -> Vec<f64> {
    assembly.stiffness.mul_add(-1.0, q, &mut load);
    for (site, reaction) in assembly.sites.iter().zip(reactions) {
        site.add_force(reaction, &mut load);
    }
    load
}

/// Largest ball load over [`CAGE_ANGLES_PER_PITCH`] positions within one ball pitch.
pub(super) fn largest_ball_load(element: &dyn BearingElement, d: &[f64; 6], rotation: &Rotation) -> f64 {
    let balls = element.rolling_elements();
    // Contacts without a cage do not turn.
    let (angles, balls) = if balls > 0 { (CAGE_ANGLES_PER_PITCH, balls) } else { (1, 1) };
    (0..angles)
        .flat_map(|k| {
            let turn = std::f64::consts::TAU * k as f64 / (CAGE_ANGLES_PER_PITCH * balls) as f64;
            let turned = Rotation { cage_angle: rotation.cage_angle + turn, ..*rotation };
            element.contact_loads(d, &turned)
        })
        .fold(0.0, |most, ball| ball.load.max(most))
}

/// Tangent stiffness of all bearings, Σ Rᵀ K R.
pub(super) fn bearing_stiffness_matrix(assembly: &Assembly, reactions: &[Reaction]) -> SparseMatrix {
    let n = assembly.dofs.len();
    let mut triplets = Triplets::new(n, n);
    for (site, reaction) in assembly.sites.iter().zip(reactions) {
        triplets.add_between_rows(&site.rows, &reaction.stiffness);
    }
    triplets.build()
}

/// Sparsity pattern of the bearings.
fn bearing_pattern(assembly: &Assembly) -> SparseMatrix {
    let n = assembly.dofs.len();
    let mut triplets = Triplets::new(n, n);
    for site in &assembly.sites {
        // Absolute values: entries that cancel in one evaluation need not cancel in the next.
        triplets.add_between_rows(&site.rows.clone().map(SparseRow::abs), &[[1.0; 6]; 6]);
    }
    triplets.build()
}

fn max_abs(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m: f64, x| if x.is_nan() || m.is_nan() { f64::NAN } else { m.max(x.abs()) })
}
