//! Modal reduction of the linear parts (component mode synthesis) with static correction modes.
//!
//! Basis: the undamped modes of the machine linearised at equilibrium (bearings included, so no Craig-Bampton
//! fixed-interface modes), up to a cutoff, plus static correction modes: its static response (residual
//! flexibility) to every interface force and load. The static compliance at the bearings is therefore exact;
//! C, G and the other matrices are projected.

use nalgebra::{DMatrix, DVector};

use super::channels::{Channel, Channels};
use super::interface::Interface;
use super::panels::Panels;
use super::system::{System, VaryingLoad};
use super::torque::{RotatingUnbalance, TorqueDrive};
use crate::analysis::equilibrium::Equilibrium;
use crate::assembly::dense_limit::check_dense;
use crate::assembly::{Assembly, ModalDamping, PhysicsError};
use crate::model::{Drive, LoadFactor, Model, Probe};
use rotordyn_bearing::Rotation;
use rotordyn_linalg::eigen::{self, EigenError};
use rotordyn_linalg::{SparseMatrix, SparseRow, Triplets};

/// |K_ij − K_ji|/2 over √(K_ii K_jj) that is more than round-off.
const ASYMMETRIC: f64 = 1e-10;
/// Shifts σ of K + σ M where K is not positive definite \[rad²/s²\]: 1 for a rigid-body mode, more for a
/// shaft in unstable equilibrium on one ball.
const MASS_SHIFTS: [f64; 4] = [1.0, 1e2, 1e4, 1e6];

/// Dense matrices over all DOFs in memory together: M, K, factor, congruent K, modes, momenta, and two of a projection.
const DENSE_MATRICES: usize = 8;

/// Refuses a machine whose dense matrices would not fit into memory.
///
/// # Errors
/// [`PhysicsError::TooLarge`].
pub fn check_size(assembly: &Assembly) -> Result<(), PhysicsError> {
    check_dense("the reduced model of a run", assembly.dofs.len(), DENSE_MATRICES, &assembly.extent)
}

/// A reduced machine with the basis for expansion to all DOFs.
#[derive(Clone, Debug)]
pub struct Reduction {
    pub system: System,
    /// Basis V (free DOFs × coordinates), Vᵀ M V = 1.
    pub basis: DMatrix<f64>,
    /// Coordinates of the equilibrium about which the model was reduced, internal ones of bearings included.
    pub equilibrium: DVector<f64>,
    /// Number of vibration modes and of static correction modes in the basis.
    pub modes: usize,
    pub corrections: usize,
    /// Largest displacement error of the equilibrium in the basis, relative to the largest displacement.
    pub static_error: f64,
}

impl Reduction {
    /// All free DOFs \[m, rad\] of the structure at coordinates x.
    pub fn expand(&self, x: &DVector<f64>) -> DVector<f64> {
        &self.basis * x.rows(0, self.basis.ncols())
    }

    /// A row over the free DOFs in terms of the coordinates: Vᵀ r, zero for internal coordinates.
    pub fn row(&self, row: Vec<f64>) -> DVector<f64> {
        padded(self.basis.tr_mul(&DVector::from_vec(row)), self.system.size())
    }
}

/// A vector over the structure's coordinates with zeros for internal ones.
fn padded(vector: DVector<f64>, size: usize) -> DVector<f64> {
    vector.resize_vertically(size, 0.0)
}

/// Reduces `assembly` about `equilibrium`, keeping modes up to `cutoff` \[Hz\] (infinity keeps all).
///
/// # Errors
/// No undamped modes (mass or stiffness not positive definite), or too many DOFs.
pub fn reduce(
    model: &Model,
    assembly: &Assembly,
    equilibrium: &Equilibrium,
    cutoff: f64,
) -> Result<Reduction, PhysicsError> {
    let n = assembly.dofs.len();
    let failed = |reason: String| PhysicsError::Eigen { speed_rpm: 0.0, reason };
    let mut tangent = Triplets::new(n, n);
    for (site, bearing) in assembly.sites.iter().zip(&equilibrium.bearings) {
        let k = bearing.tangent.stiffness;
        let symmetric = std::array::from_fn(|a| std::array::from_fn(|b| 0.5 * (k[a][b] + k[b][a])));
        tangent.add_between_rows(&site.rows, &symmetric);
    }
    let tangent_stiffness = SparseMatrix::sum(&[
        (1.0, &assembly.stiffness),
        (1.0, &assembly.belt_stiffness),
        (1.0, &tangent.build()),
    ]);
    check_size(assembly)?;
    let mass = assembly.mass.to_dense();
    // Cross-coupling of bushings belongs to no undamped mode.
    let cross_coupling = assembly.stiffness.skew_part();
    let size = |i: usize| assembly.stiffness.get(i, i).abs().sqrt();
    let has_cross_coupling = cross_coupling.iter().any(|(i, j, v)| v.abs() > ASYMMETRIC * size(i) * size(j));
    let stiffness = match has_cross_coupling {
        true => SparseMatrix::sum(&[(1.0, &tangent_stiffness), (-1.0, &cross_coupling)]).to_dense(),
        false => tangent_stiffness.to_dense(),
    };
    let modes_at = |shift: &f64| eigen::undamped(&stiffness, &mass, *shift);
    let (squares, shapes) = MASS_SHIFTS[1..]
        .iter()
        .fold(modes_at(&MASS_SHIFTS[0]), |found, shift| found.or_else(|_| modes_at(shift)))
        .map_err(|e| match e {
            EigenError::NotDefinite => failed(
                "the stiffness at the static equilibrium is not positive definite: a support of negative stiffness, or \
                 an axial force beyond the buckling load"
                    .into(),
            ),
            other => failed(other.to_string()),
        })?;
    let limit = (std::f64::consts::TAU * cutoff).powi(2);
    let modes = squares.iter().filter(|&&s| s <= limit).count().max(1).min(n);

    // The belt resists deviation from equilibrium: its force is k (q₀ − q).
    let belt_preload = assembly.belt_stiffness.mul(&equilibrium.q);
    let mut static_load: Vec<f64> =
        (0..n).map(|k| assembly.gravity_load[k] + assembly.static_load[k]).collect();
    let varying: Vec<(Vec<f64>, LoadFactor)> = model
        .loads
        .iter()
        .filter(|load| !load.factor.is_constant())
        .map(|load| {
            let mut vector = vec![0.0; n];
            for (row, f) in assembly.anchor_rows(&load.at).iter().zip(&load.force) {
                row.add_to(*f, &mut vector);
            }
            (vector, load.factor.clone())
        })
        .collect();

    let dense = |row: &SparseRow| {
        let mut v = vec![0.0; n];
        row.add_to(1.0, &mut v);
        v
    };
    let mut forces: Vec<Vec<f64>> =
        vec![static_load.clone(), belt_preload.clone(), assembly.spin_momentum.clone()];
    let mut interfaces: Vec<Interface> = Vec::new();
    let mut map: Vec<&SparseRow> = Vec::new();
    let mut internal_masses: Vec<f64> = Vec::new();
    let [mut first_stiffness, mut first_tangent, mut first_body_state] = [0; 3];
    for (site, place) in model.bearings.iter().zip(&assembly.sites) {
        let element = site.bearing.element();
        let mut rows: Vec<&SparseRow> = place.rows[..element.relative_dofs()].iter().collect();
        let first_internal = internal_masses.len();
        if let Some(internal) = element.internal() {
            if site.housing.node.is_some() {
                rows.extend(&place.housing_rows[..internal.housing_dofs()]);
            }
            internal_masses.extend(internal.masses());
            forces.extend(rows.iter().map(|row| dense(row)));
        } else if element.bodies().is_some() {
            if site.housing.node.is_some() {
                rows.extend(&place.housing_rows);
            }
            forces.extend(rows.iter().map(|row| dense(row)));
        } else {
            forces.extend(place.rows.iter().map(dense));
        }
        let interface = Interface {
            name: site.name.clone(),
            first_row: map.len(),
            rows: rows.len(),
            first_internal,
            internal: internal_masses.len() - first_internal,
            first_stiffness,
            first_tangent,
            first_body_state,
            body_states: element.bodies().map_or(0, |bodies| bodies.states()),
            cage_angle: site.bearing.cage_angle(),
            cage_angles: None,
            free_rotation: matches!(model.drive, Drive::Torque { .. }),
            element,
        };
        first_stiffness = interface.stiffness_range().end;
        first_tangent = interface.tangent_range().end;
        first_body_state = interface.body_range().end;
        interfaces.push(interface);
        map.extend(rows);
    }
    forces.extend(assembly.unbalances.iter().flat_map(|u| [dense(&u.x), dense(&u.y)]));
    if let Drive::Torque { node, .. } = model.drive {
        let driven = &assembly.anchor_rows(&crate::element::Anchor::node(node))[5];
        forces.extend(assembly.unbalances.iter().map(|u| &u.twist).chain([driven]).map(&dense));
    }
    forces.extend(varying.iter().map(|(v, _)| v.clone()));
    let basis = basis(&stiffness, &mass, &shapes, modes, &forces)
        .ok_or_else(|| failed("the stiffness at equilibrium is not positive definite".into()))?;

    for (s, b) in static_load.iter_mut().zip(&belt_preload) {
        *s += b;
    }
    let momentum = basis.transpose() * &mass;
    let project = |m: &SparseMatrix| basis.transpose() * m.to_dense() * &basis;
    let size = basis.ncols() + internal_masses.len();
    let vector = |v: &[f64]| padded(basis.transpose() * DVector::from_column_slice(v), size);
    let row = |r: &SparseRow| vector(&dense(r));
    let structure_stiffness =
        SparseMatrix::sum(&[(1.0, &assembly.stiffness), (1.0, &assembly.belt_stiffness)]);
    let tangents = equilibrium.tangents();
    let own = if assembly.modal.is_none() { ModalDamping::new(assembly, &tangents)? } else { None };
    let modal = assembly.modal.as_deref().or(own.as_ref());
    let modal = modal.map_or_else(|| SparseMatrix::zeros(n, n), |modal| modal.matrix.to_sparse());
    let damping = SparseMatrix::sum(&[(1.0, &assembly.damping), (1.0, &modal)]);

    let mut unbalance = [DVector::zeros(size), DVector::zeros(size)];
    for u in &assembly.unbalances {
        let (sin, cos) = u.phase.sin_cos();
        let (x, y) = (row(&u.x) * u.magnitude, row(&u.y) * u.magnitude);
        unbalance[0] += &x * cos + &y * sin;
        unbalance[1] += &y * cos - &x * sin;
    }
    let drive = match &model.drive {
        Drive::Prescribed { .. } => None,
        Drive::Torque { node, table, drag } => {
            let node = crate::element::Anchor::node(*node);
            let unbalances: Vec<RotatingUnbalance> = assembly
                .unbalances
                .iter()
                .map(|u| RotatingUnbalance {
                    name: u.name.clone(),
                    x: row(&u.x),
                    y: row(&u.y),
                    twist: row(&u.twist),
                    magnitude: u.magnitude,
                    phase: u.phase,
                })
                .collect();
            let drive = TorqueDrive {
                table: table.clone(),
                drag: *drag,
                torque: row(&assembly.anchor_rows(&node)[5]),
                rigid_rotation: vector(&assembly.spin_momentum),
                unbalances,
                gravity: [model.gravity[0], model.gravity[1]],
                rotation_drag: vector(&assembly.rotation_drag),
                rotating_damping: match assembly.rotating_damping.max_abs() {
                    0.0 => DMatrix::zeros(0, 0),
                    _ => project(&assembly.rotating_damping),
                },
            };
            drive.check_inertia()?;
            Some(drive)
        }
    };
    // Without a drive station every inertia is accelerated by its own torque: spin-up causes no twist.
    let driven = !matches!(model.drive, Drive::Prescribed { node: None });
    let q0 = DVector::from_column_slice(&equilibrium.q);
    let structure = &momentum * &q0;
    let static_error = (&basis * &structure - &q0).amax() / q0.amax().max(f64::MIN_POSITIVE);
    let mut x0 = padded(structure, size);
    for ((interface, place), state) in interfaces.iter().zip(&assembly.sites).zip(&equilibrium.bearings) {
        let Some(internal) = interface.element.internal() else { continue };
        let relative = interface.element.relative_dofs();
        let housing = place.housing_rows[..interface.rows - relative].iter();
        let housing = housing.map(|row| row.dot(&equilibrium.q));
        let at: Vec<f64> = state.displacement[..relative].iter().copied().chain(housing).collect();
        let rotation = Rotation {
            cage_angle: interface.cage_angle,
            shaft_speed: equilibrium.speed,
            ..Rotation::default()
        };
        for (k, y) in interface.internal_range().zip(internal.equilibrium(&at, &rotation)) {
            x0[basis.ncols() + k] = internal_masses[k].sqrt() * y;
        }
    }
    let matrices = [
        &project(&damping),
        &project(&structure_stiffness),
        &project(&assembly.gyroscopic),
        &project(&assembly.spin_up),
        &project(&assembly.circulatory),
    ];
    let on_structure = |r: &SparseRow| (basis.transpose() * DVector::from_vec(dense(r))).transpose();
    let rows: Vec<_> = map.iter().map(|r| on_structure(r)).collect();
    let interface_map =
        if rows.is_empty() { DMatrix::zeros(0, basis.ncols()) } else { DMatrix::from_rows(&rows) };
    let natural_frequency = |k: usize, _| if k < modes { squares[k].max(0.0).sqrt() } else { 0.0 };
    let channel = |p: &Probe| Channel {
        name: p.name.clone(),
        row: row(&assembly.direction_row(&p.at, &p.direction)),
        quantity: p.quantity,
    };
    let system = System {
        natural_frequencies: DVector::from_fn(basis.ncols(), natural_frequency),
        panels: Panels::new(matrices, &interface_map),
        damping: matrices[0].clone(),
        stiffness: matrices[1].clone(),
        gyroscopic: matrices[2].clone(),
        spin_up: matrices[3].clone(),
        circulatory: matrices[4].clone(),
        cross_coupling: has_cross_coupling.then(|| project(&cross_coupling)),
        static_load: vector(&static_load),
        unbalance,
        rigid_rotation: vector(&assembly.spin_momentum),
        spin_inertia: vector(&assembly.spin_momentum) * if driven { -1.0 } else { 0.0 },
        varying_loads: varying
            .iter()
            .map(|(v, factor)| VaryingLoad { vector: vector(v), factor: factor.clone() })
            .collect(),
        interface_map,
        interfaces,
        internal_masses,
        channels: Channels::new(model.probes.iter().map(channel).collect()),
        curve: model.profile.curve(),
        drive,
    };
    Ok(Reduction { system, equilibrium: x0, modes, corrections: basis.ncols() - modes, static_error, basis })
}

/// Modes, then static correction modes M-orthonormalised against the basis (Gram-Schmidt); linearly dependent
/// ones are dropped.
fn basis(
    stiffness: &DMatrix<f64>,
    mass: &DMatrix<f64>,
    shapes: &DMatrix<f64>,
    modes: usize,
    forces: &[Vec<f64>],
) -> Option<DMatrix<f64>> {
    let n = stiffness.nrows();
    // Rigid-body rotation makes K singular; a shift of (0.16 Hz)² hardly changes the static responses.
    let shifted = || MASS_SHIFTS.iter().find_map(|shift| nalgebra::Cholesky::new(stiffness + mass * *shift));
    let factor = nalgebra::Cholesky::new(stiffness.clone()).or_else(shifted)?;
    let mut columns: Vec<DVector<f64>> = (0..modes).map(|k| shapes.column(k).into_owned()).collect();
    let mut momenta: Vec<DVector<f64>> = columns.iter().map(|c| mass * c).collect();
    for force in forces {
        if columns.len() == n || force.iter().all(|f| *f == 0.0) {
            continue;
        }
        let mut response = factor.solve(&DVector::from_column_slice(force));
        let size = response.dot(&(mass * &response)).sqrt();
        // Twice is enough (Kahan & Parlett).
        for _ in 0..2 {
            for (c, p) in columns.iter().zip(&momenta) {
                let share = p.dot(&response);
                response.axpy(-share, c, 1.0);
            }
        }
        let momentum = mass * &response;
        let left = response.dot(&momentum).max(0.0).sqrt();
        if left > 1e-7 * size {
            columns.push(response / left);
            momenta.push(momentum / left);
        }
    }
    Some(DMatrix::from_columns(&columns))
}
