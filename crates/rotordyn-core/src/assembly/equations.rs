//! The equations of motion over the free DOFs: matrices, loads, bearing sites.

use super::dofs::DofMap;
use super::error::PhysicsError;
use super::modal_damping::ModalDamping;
use super::spin_up::SpinUpForm;
use crate::element::Anchor;
use crate::element::shaft_matrices::ConeRule;
use crate::model::{Model, ShaftExtent};
use rotordyn_bearing::Reaction;
use rotordyn_linalg::{Complex64, LayoutCache, SparseMatrix, SparseRow, dot};
use std::sync::Arc;

/// Equations of motion over the free DOFs, without bearings.
#[derive(Clone, Debug)]
pub struct Assembly {
    pub dofs: DofMap,
    /// Mass M.
    pub mass: SparseMatrix,
    /// Stiffness K of shaft, bushings and belts on fixed centres, without bearings.
    pub stiffness: SparseMatrix,
    /// Stiffness of belts with constant pull: acts on deviations from the equilibrium, not in statics.
    pub belt_stiffness: SparseMatrix,
    /// Damping C: of elements, bushings, belts, proportional and internal; without bearings and modal damping.
    pub damping: SparseMatrix,
    /// Gyroscopic matrix G, per rad/s.
    pub gyroscopic: SparseMatrix,
    /// Circulatory stiffness K_c of internal damping, per rad/s.
    pub circulatory: SparseMatrix,
    /// Sᵀ C_i S of internal damping C_i, S the turn by 90° about z: the share of its loss that grows with Ω².
    pub rotating_damping: SparseMatrix,
    /// Stiffness K_s of angular acceleration, per rad/s².
    pub spin_up: SparseMatrix,
    /// Gravity on every mass \[N, N m\].
    pub gravity_load: Vec<f64>,
    /// Constant loads and the belts' static pull \[N, N m\].
    pub static_load: Vec<f64>,
    /// Momentum Tᵀ M r of the rigid rotation r of all shaft nodes about z: an acceleration Ω̇ loads the twist
    /// by −Ω̇ times this. (Without a drive station each inertia is driven by its own torque: not to be
    /// applied.)
    pub spin_momentum: Vec<f64>,
    /// Moments Tᵀ C r of bushings and belts on the rotating shaft, per rad/s of the rigid rotation r.
    pub rotation_drag: Vec<f64>,
    /// Polar moment of inertia rᵀ M r of shaft, discs and attached masses \[kg m²\].
    pub polar_inertia: f64,
    pub unbalances: Vec<UnbalanceForce>,
    pub sites: Vec<Site>,
    /// Modal damping table: (frequency \[Hz\], ζ).
    pub modal_damping: Vec<[f64; 2]>,
    /// The modal damping matrix, once the bearings at standstill are known
    /// ([`Assembly::set_standstill`]).
    pub modal: Option<Arc<ModalDamping>>,
    /// Mass over all DOFs, before elimination.
    pub full_mass: SparseMatrix,
    /// The shaft's mesh, for messages.
    pub extent: ShaftExtent,
    /// Band layouts of its linear systems.
    pub layouts: LayoutCache,
}

/// Bearing site: its six relative displacements as linear functions of q.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    pub name: String,
    /// Shaft node minus housing point: u_x u_y u_z θ_x θ_y θ_z as rows over the free DOFs.
    pub rows: [SparseRow; 6],
    /// Housing point: u_x u_y u_z θ_x θ_y θ_z; no entries for ground.
    pub housing_rows: [SparseRow; 6],
}

impl Site {
    /// Relative displacement (or velocity) d = R q.
    pub fn relative(&self, q: &[f64]) -> [f64; 6] {
        std::array::from_fn(|i| self.rows[i].dot(q))
    }

    /// Adds Rᵀ f: f on the shaft, −f and the additional housing force on the housing.
    pub fn add_force(&self, reaction: &Reaction, to: &mut [f64]) {
        super::elements::add_force(&self.rows, &reaction.force, to);
        for (row, force) in self.housing_rows.iter().zip(reaction.housing_force) {
            row.add_to(force, to);
        }
    }
}

/// Unbalance U at phase ϕ on a node, as a rotating force on the free DOFs.
#[derive(Clone, Debug, PartialEq)]
pub struct UnbalanceForce {
    pub name: String,
    /// u_x, u_y and θ_z of the node as rows over the free DOFs.
    pub x: SparseRow,
    pub y: SparseRow,
    pub twist: SparseRow,
    /// U = m e \[kg m\].
    pub magnitude: f64,
    /// ϕ \[rad\].
    pub phase: f64,
}

impl Assembly {
    /// Assembles with exact conical elements and energy-consistent angular acceleration terms.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub fn new(model: &Model) -> Result<Self, PhysicsError> {
        Self::with_forms(model, SpinUpForm::default(), ConeRule::default())
    }

    /// Assembles with selected forms, for comparison with other programs.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub fn with_forms(model: &Model, spin_up: SpinUpForm, cones: ConeRule) -> Result<Self, PhysicsError> {
        let dofs = DofMap::new(model);
        let full = super::elements::assemble(model, cones);
        let n = dofs.len();
        let reduce = |a: &SparseMatrix| a.congruence(&dofs.basis, n);
        let (gravity, steady) = super::elements::loads(model, &full.mass);
        let rotation: Vec<f64> =
            (0..dofs.full_len()).map(|i| f64::from(i < 6 * dofs.shaft_nodes && i % 6 == 5)).collect();
        let momentum = full.mass.mul(&rotation);
        let n_full = dofs.full_len();
        let node_rows = |node: usize| dofs.anchor_rows(&Anchor::node(node));
        let assembly = Self {
            mass: reduce(&full.mass),
            stiffness: reduce(&full.stiffness),
            belt_stiffness: reduce(&full.belt_stiffness),
            damping: reduce(&full.damping),
            gyroscopic: reduce(&full.gyroscopic),
            circulatory: reduce(&full.circulatory),
            rotating_damping: reduce(&super::elements::rotating_damping(&full.circulatory, n_full)),
            spin_up: reduce(&super::spin_up::spin_up(model, spin_up, &full.gyroscopic)),
            gravity_load: dofs.reduce(&gravity),
            static_load: dofs.reduce(&steady),
            spin_momentum: dofs.reduce(&momentum),
            rotation_drag: dofs.reduce(&full.support_damping.mul(&rotation)),
            polar_inertia: dot(&momentum, &rotation),
            unbalances: model
                .unbalances
                .iter()
                .map(|u| {
                    let [x, y, _, _, _, twist] = node_rows(u.node);
                    UnbalanceForce {
                        name: u.name.clone(),
                        x,
                        y,
                        twist,
                        magnitude: u.magnitude,
                        phase: u.phase,
                    }
                })
                .collect(),
            sites: model
                .bearings
                .iter()
                .map(|b| Site {
                    name: b.name.clone(),
                    rows: dofs.relative_rows(&Anchor::node(b.node), &b.housing),
                    housing_rows: dofs.anchor_rows(&b.housing),
                })
                .collect(),
            modal_damping: model.damping.modal.clone(),
            modal: None,
            full_mass: full.mass,
            extent: ShaftExtent::of(model),
            layouts: LayoutCache::default(),
            dofs,
        };
        check_mass(&assembly)?;
        Ok(assembly)
    }

    /// Whether there is modal damping, which is a dense matrix.
    pub fn has_modal_damping(&self) -> bool {
        self.modal.is_some() || !self.modal_damping.is_empty()
    }

    /// Displacement of an anchor's point as rows over the free DOFs.
    pub fn anchor_rows(&self, anchor: &Anchor) -> [SparseRow; 6] {
        self.dofs.anchor_rows(anchor)
    }

    /// One direction of an anchor's point as a row over the free DOFs: Σ direction × row.
    pub fn direction_row(&self, anchor: &Anchor, direction: &[f64; 6]) -> SparseRow {
        let mut out = SparseRow::default();
        for (row, &d) in self.anchor_rows(anchor).iter().zip(direction) {
            out.add_scaled(d, row);
        }
        out
    }

    /// Adds the unbalance force at shaft angle θ, speed Ω and acceleration Ω̇:
    /// F_x = U (Ω² cos φ + Ω̇ sin φ), F_y = U (Ω² sin φ − Ω̇ cos φ), φ = θ + ϕ.
    pub fn add_unbalance(&self, theta: f64, speed: f64, acceleration: f64, to: &mut [f64]) {
        for u in &self.unbalances {
            let (sin, cos) = (theta + u.phase).sin_cos();
            u.x.add_to(u.magnitude * (speed * speed * cos + acceleration * sin), to);
            u.y.add_to(u.magnitude * (speed * speed * sin - acceleration * cos), to);
        }
    }

    /// Complex amplitude F of the unbalance force at steady speed, f = Re(F e^{jΩt}): F_x = U Ω² e^{jϕ}, F_y = −j F_x.
    pub fn unbalance_amplitude(&self, speed: f64) -> Vec<Complex64> {
        let mut f = vec![Complex64::default(); self.dofs.len()];
        for u in &self.unbalances {
            let force = Complex64::from_polar(u.magnitude * speed * speed, u.phase);
            for &(i, v) in &u.x.0 {
                f[i] += force * v;
            }
            for &(i, v) in &u.y.0 {
                f[i] += Complex64::new(force.im, -force.re) * v;
            }
        }
        f
    }
}

/// Checks that every free DOF has inertia.
fn check_mass(assembly: &Assembly) -> Result<(), PhysicsError> {
    let dofs: &DofMap = &assembly.dofs;
    match (0..dofs.len()).find(|&k| assembly.mass.get(k, k) <= 0.0) {
        Some(k) => Err(PhysicsError::NoInertia { item: dofs.name(k) }),
        None => Ok(()),
    }
}
