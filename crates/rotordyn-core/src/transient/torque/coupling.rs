//! Loads that couple the rotation under a torque drive to the other coordinates, and their inertia matrix.

use nalgebra::DVector;

use super::TorqueDrive;
use crate::model::Spin;
use crate::transient::system::System;
use rotordyn_bearing::Reaction;
use rotordyn_linalg::small_dense::solve_in_place;

/// Slowest speed at which a torque follows from a bearing's parametric power \[rad/s\].
const STANDSTILL: f64 = 1e-6;

/// Motion of the coordinates and of their frame.
pub struct Motion<'a> {
    pub spin: &'a Spin,
    pub x: &'a DVector<f64>,
    pub v: &'a DVector<f64>,
    /// ẍ relative to the frame's acceleration.
    pub acceleration: &'a DVector<f64>,
}

/// Buffers of the coupling.
pub struct Workspace {
    /// K_s x; K_s ẋ, G ẋ, K_c x, Sᵀ C_i S x.
    spin_up_x: DVector<f64>,
    product: DVector<f64>,
    /// x_r/J.
    rigid: DVector<f64>,
    /// Pairs (A, B) of the inertia matrix I − Σ (A Bᵀ + B Aᵀ), and the response D of the coordinates to each.
    pairs: Vec<[DVector<f64>; 2]>,
    responses: Vec<[DVector<f64>; 2]>,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

impl Workspace {
    pub fn new(drive: &TorqueDrive, size: usize) -> Self {
        let pairs = drive.unbalances.len() + 1;
        let mut pairs = vec![[DVector::zeros(size), DVector::zeros(size)]; pairs];
        for (pair, unbalance) in pairs.iter_mut().zip(&drive.unbalances) {
            pair[1].copy_from(&unbalance.twist);
        }
        let count = 2 * pairs.len();
        Self {
            spin_up_x: DVector::zeros(size),
            product: DVector::zeros(size),
            rigid: &drive.rigid_rotation / drive.inertia(),
            responses: pairs.clone(),
            pairs,
            matrix: vec![0.0; count * count],
            right: vec![0.0; count],
        }
    }

    /// Response of the coordinates to a load, D A and D B of every pair; an explicit method has D = 1.
    pub fn set_responses(&mut self, mut respond: impl FnMut(&DVector<f64>, &mut DVector<f64>)) {
        for (load, response) in self.pairs.iter().flatten().zip(self.responses.iter_mut().flatten()) {
            respond(load, response);
        }
    }

    /// K_s x of the last motion.
    pub fn spin_up_x(&self) -> &DVector<f64> {
        &self.spin_up_x
    }
}

impl TorqueDrive {
    /// Adds the loads of the coupling at a motion to `out`: the unbalances in full, with their reaction on the twist of
    /// their node, and the moments on the rotation by tilting inertias, internal damping, cages and rotational dampers.
    ///
    /// Unbalance: F_x = U (φ̇² cos φ + φ̈ sin φ), F_y = U (φ̇² sin φ − φ̈ cos φ),
    /// M_z = U ((ü_x − g_x) sin φ − (ü_y − g_y) cos φ). Tilting inertias: the moment
    /// −J ṡ = −(ẍᵀ K_s x + ẋᵀ K_s ẋ), and −ṡ K_s x − s G ẋ. Internal damping: −ẋᵀ K_c x − Ω xᵀ Sᵀ C_i S x. Cages: −P/Ω, P the parametric power of the balls.
    pub fn add_coupling(
        &self,
        system: &System,
        at: &Motion,
        reactions: &[Reaction],
        work: &mut Workspace,
        out: &mut DVector<f64>,
    ) {
        let Spin { speed, acceleration, .. } = *at.spin;
        for (u, [a, _]) in self.unbalances.iter().zip(&mut work.pairs) {
            let (sin, cos) = (at.spin.angle + u.twist.dot(at.x) + u.phase).sin_cos();
            let (rate, rate_change) =
                (speed + u.twist.dot(at.v), acceleration + u.twist.dot(at.acceleration));
            let m = u.magnitude;
            let square = rate * rate;
            let moving =
                [u.x.dot(at.acceleration) - self.gravity[0], u.y.dot(at.acceleration) - self.gravity[1]];
            out.axpy(m * (square * cos + rate_change * sin), &u.x, 1.0);
            out.axpy(m * (square * sin - rate_change * cos), &u.y, 1.0);
            out.axpy(m * (moving[0] * sin - moving[1] * cos), &u.twist, 1.0);
            a.copy_from(&u.x);
            a.scale_mut(m * sin);
            a.axpy(-m * cos, &u.y, 1.0);
        }
        let n = system.structure();
        let (x, v) = (at.x.rows(0, n), at.v.rows(0, n));
        let mut moment = 0.0;
        if system.panels.has_spin_up() {
            work.spin_up_x.rows_mut(0, n).gemv(1.0, &system.spin_up, &x, 0.0);
            work.product.rows_mut(0, n).gemv(1.0, &system.spin_up, &v, 0.0);
            let spin = v.dot(&work.spin_up_x.rows(0, n)) / self.inertia();
            let spin_change = at.acceleration.dot(&work.spin_up_x) + v.dot(&work.product.rows(0, n));
            moment -= spin_change;
            out.axpy(-spin_change / self.inertia(), &work.spin_up_x, 1.0);
            work.product.rows_mut(0, n).gemv(1.0, &system.gyroscopic, &v, 0.0);
            out.axpy(-spin, &work.product, 1.0);
        }
        if let Some([a, b]) = work.pairs.last_mut() {
            a.copy_from(&work.spin_up_x);
            a.neg_mut();
            b.copy_from(&work.rigid);
            b.axpy(0.5 / self.inertia(), &work.spin_up_x, 1.0);
        }
        if self.rotating_damping.nrows() == n {
            work.product.rows_mut(0, n).gemv(1.0, &system.circulatory, &x, 0.0);
            moment -= v.dot(&work.product.rows(0, n));
            work.product.rows_mut(0, n).gemv(1.0, &self.rotating_damping, &x, 0.0);
            moment -= speed * x.dot(&work.product.rows(0, n));
        }
        if speed.abs() > STANDSTILL {
            moment -= cage_power(system, reactions) / speed;
        }
        out.axpy(moment, &work.rigid, 1.0);
        out.axpy(-speed, &self.rotation_drag, 1.0);
    }

    /// Solves ẍ = `y` + Σ (A Bᵀ + B Aᵀ) ẍ for ẍ, in place, with the pairs of the last motion: (U (x sin φ − y cos φ),
    /// twist) of every unbalance and (−K_s x, x_r/J + K_s x/2J), which makes the matrix positive definite.
    pub fn solve_inertia(&self, work: &mut Workspace, y: &mut DVector<f64>) {
        work.set_responses(|load, response| response.copy_from(load));
        let start = y.clone();
        self.solve_coupling(work, &start, y);
    }

    /// Loads y = δ + Σ (A Bᵀ + B Aᵀ) D y that a defect δ requires of coordinates that respond with D: in place from δ in
    /// `y`, with `response` = D δ and the responses to the pairs.
    pub fn solve_coupling(&self, work: &mut Workspace, response: &DVector<f64>, y: &mut DVector<f64>) {
        let count = work.right.len();
        // Z = [A₁ B₁ A₂ B₂ …], P swaps the members of a pair: (1 − ZᵀD Z P) w = ZᵀD δ, y = δ + Z P w.
        for row in 0..count {
            let column = &work.pairs[row / 2][row % 2];
            for k in 0..count {
                let unit = f64::from(u8::from(row == k));
                let other = &work.responses[k / 2][(k % 2) ^ 1];
                work.matrix[row * count + k] = unit - column.dot(other);
            }
            work.right[row] = column.dot(response);
        }
        if !solve_in_place(&mut work.matrix, &mut work.right) {
            y.fill(f64::NAN);
            return;
        }
        for k in 0..count {
            y.axpy(work.right[k], &work.pairs[k / 2][(k % 2) ^ 1], 1.0);
        }
    }
}

/// Power that rotating cages put into the balls of all bearings \[W\]; it comes from the rotation.
///
/// Not that of cross-coupled linear bearings: their stiffness does not say what drives it.
pub(super) fn cage_power(system: &System, reactions: &[Reaction]) -> f64 {
    let with_cage = system.interfaces.iter().zip(reactions).filter(|(interface, _)| interface.has_cage());
    with_cage.map(|(_, reaction)| reaction.parametric_power).sum()
}
