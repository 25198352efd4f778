//! Generalised-α and Newmark steps with Newton on the bearing interfaces only.
//!
//! The linear part is constant but for Ω, so one inverse serves many steps; the nonlinear bearings act on a
//! few interface rows, so Newton solves for those alone (the rest follows by back-substitution). Balls with coordinates
//! of their own touch nothing but their bearing: it solves their equations at every iterate, one by one.

use nalgebra::{DMatrix, DVector};

use super::cage;
use super::system::{State, System};
use crate::bearing::Reaction;
use crate::bearing::radial::StepGain;
use crate::linalg::panel::Panel;
use crate::linalg::small::solve_in_place;
use crate::model::Spin;

/// Newton stops when the interface displacement moved by less than this \[m, rad\] in an iteration; being
/// quadratic on contact deflections of 1e-7 m and more, it is then within 1e-15 m of the solution.
const TOLERANCE: f64 = 1e-11;
/// Largest (Ω − Ω_f) h at which an inverse made at Ω_f serves at Ω, by its first-order expansion in Ω: what the
/// expansion leaves out is the square of this, 1e-8 of the gyroscopic effect.
const STALE: f64 = 1e-4;
const MAX_ITERATIONS: usize = 25;

/// Parameters of the family (Chung & Hulbert 1993, eq. 17-20 and 25).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheme {
    pub alpha_m: f64,
    pub alpha_f: f64,
    pub beta: f64,
    pub gamma: f64,
}

impl Scheme {
    /// Generalised-α with spectral radius ρ∞ in \[0, 1\] at infinite frequency.
    ///
    /// x and v are second order; the a it carries along is that of a time (α_f − α_m) h before its step's end
    /// (0.11 h at ρ∞ = 0.8), which an acceleration channel shows as that shift. Newmark has none.
    pub fn generalised_alpha(rho: f64) -> Self {
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        Self {
            alpha_m,
            alpha_f,
            beta: 0.25 * (1.0 - alpha_m + alpha_f).powi(2),
            gamma: 0.5 - alpha_m + alpha_f,
        }
    }

    /// Newmark's average acceleration, γ = ½, β = ¼.
    pub const NEWMARK: Self = Self { alpha_m: 0.0, alpha_f: 0.0, beta: 0.25, gamma: 0.5 };
}

/// The inverse of the effective matrix for one step length, near one speed.
///
/// S(Ω) = S₀ + κ (γ h G + β h² K_c)(1−α_f), κ = Ω − Ω_f; S⁻¹ ≈ S₀⁻¹ − κ S₀⁻¹ S′ S₀⁻¹, and likewise for what is
/// made of it.
struct Factor {
    step: f64,
    speed: f64,
    acceleration: f64,
    /// S₀⁻¹ and S₀⁻¹ S′ S₀⁻¹.
    inverse: Panel,
    /// The same of S⁻¹ Wᵀ, coordinates × rows.
    response: Panel,
    /// Y = W S⁻¹ Wᵀ, row-major.
    compliance: [Vec<f64>; 2],
}

/// Why a step failed, for the driver that halves it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepFailure {
    /// Interface row with the largest correction, and that correction.
    pub row: usize,
    pub residual: f64,
    pub iterations: usize,
}

/// One-step implicit integrator; owns every buffer, so that a step allocates nothing.
pub struct GeneralisedAlpha {
    scheme: Scheme,
    factors: Vec<Factor>,
    /// External and linear force of the previous state, L₀ = C v + K x − p, and its bearing force Wᵀ f.
    previous: DVector<f64>,
    scratch: Vec<f64>,
    right: DVector<f64>,
    linear: DVector<f64>,
    x: DVector<f64>,
    v: DVector<f64>,
    a: DVector<f64>,
    base_d: Vec<f64>,
    base_rate: Vec<f64>,
    row_buffer: Vec<f64>,
    force: Vec<f64>,
    unknown: Vec<f64>,
    residual: Vec<f64>,
    jacobian: Vec<f64>,
    /// (1−α_f) Y at this step's speed.
    compliance: Vec<f64>,
    /// −∂(force on every ball)/∂(rows of its bearing).
    ball_follow: Vec<[f64; 4]>,
    /// Force of the state before the last, and the step between them.
    last_force: Vec<f64>,
    last_step: f64,
    d: Vec<f64>,
    d_rate: Vec<f64>,
    rotations: Vec<crate::bearing::Rotation>,
    reactions: Vec<Reaction>,
    /// Newton iterations spent, for the run's report.
    pub iterations: u64,
    /// Inverses made.
    pub refactored: u64,
}

impl GeneralisedAlpha {
    pub fn new(system: &System, scheme: Scheme) -> Self {
        let (n, m, places) = (system.size(), system.rows(), system.places());
        let sites = system.interfaces.len();
        let zero = || DVector::zeros(n);
        Self {
            scheme,
            factors: Vec::new(),
            previous: zero(),
            scratch: Vec::new(),
            right: zero(),
            linear: zero(),
            x: zero(),
            v: zero(),
            a: zero(),
            base_d: vec![0.0; places],
            base_rate: vec![0.0; places],
            row_buffer: vec![0.0; places],
            force: vec![0.0; places],
            unknown: vec![0.0; m],
            residual: vec![0.0; m],
            jacobian: vec![0.0; m * m],
            compliance: vec![0.0; m * m],
            ball_follow: vec![[0.0; 4]; places - m],
            last_force: vec![0.0; places],
            last_step: 0.0,
            d: vec![0.0; places],
            d_rate: vec![0.0; places],
            rotations: vec![Default::default(); sites],
            reactions: vec![Reaction::default(); sites],
            iterations: 0,
            refactored: 0,
        }
    }

    /// Index of a factor that is close enough in speed for this step length.
    fn factor(&mut self, system: &System, step: f64, spin: &Spin) -> usize {
        let found = self.factors.iter().position(|f| f.step == step);
        if let Some(k) = found {
            let f = &self.factors[k];
            let stale = ((f.speed - spin.speed) * step).abs() > STALE
                || ((f.acceleration - spin.acceleration) * step * step).abs() > STALE * STALE;
            if !stale {
                return k;
            }
        }
        let Scheme { alpha_m, alpha_f, beta, gamma } = self.scheme;
        let n = system.structure();
        let weight = 1.0 - alpha_f;
        let by_speed =
            (&system.gyroscopic * (gamma * step) + &system.circulatory * (beta * step * step)) * weight;
        let effective = DMatrix::identity(n, n) * (1.0 - alpha_m)
            + (&system.damping * (gamma * step)
                + (&system.stiffness + &system.spin_up * spin.acceleration) * (beta * step * step))
                * weight
            + &by_speed * spin.speed;
        // The effective matrix is the identity plus terms of order h: invertible for any step worth taking;
        // a singular one yields NaN, which the divergence check of the driver reports.
        let inverse = effective.try_inverse().unwrap_or_else(|| DMatrix::from_element(n, n, f64::NAN));
        let slope = &inverse * by_speed * &inverse;
        let map = &system.interface_map;
        let response = [&inverse * map.transpose(), &slope * map.transpose()];
        // Column-major of the transpose is row-major.
        let compliance = [0, 1].map(|k| (map * &response[k]).transpose().as_slice().to_vec());
        let factor = Factor {
            step,
            speed: spin.speed,
            acceleration: spin.acceleration,
            inverse: Panel::new(&[&inverse, &slope]),
            response: Panel::new(&[&response[0], &response[1]]),
            compliance,
        };
        self.refactored += 1;
        match found {
            Some(k) => {
                self.factors[k] = factor;
                k
            }
            None => {
                self.factors.push(factor);
                self.factors.len() - 1
            }
        }
    }

    /// Advances `state` by `step`; `spin` is the shaft's motion at the end of the step.
    ///
    /// (1−α_m) a₁ + α_m a₀ + (1−α_f) R₁ + α_f R₀ = 0 with R = (C+ΩG) v + (K+…) x − p − Wᵀ f,
    /// x₁ = x₀ + h v₀ + h² ((½−β) a₀ + β a₁), v₁ = v₀ + h ((1−γ) a₀ + γ a₁).
    /// On failure the state is left as it was.
    pub fn step(
        &mut self,
        system: &System,
        state: &mut State,
        step: f64,
        spin: Spin,
    ) -> Result<(), StepFailure> {
        let Scheme { alpha_m, alpha_f, beta, gamma } = self.scheme;
        let k = self.factor(system, step, &spin);
        let (kd, kv) = (beta * step * step, gamma * step);
        let (n, places) = (system.structure(), system.places());
        let gain = StepGain { place: kd, rate: kv, ball: (1.0 - alpha_f) / (1.0 - alpha_m) };
        cage::advance(system, state, &spin, &mut self.rotations);

        // Predictors with a₁ = 0.
        self.x.copy_from(&state.x);
        self.x.axpy(step, &state.v, 1.0);
        self.x.axpy(step * step * (0.5 - beta), &state.a, 1.0);
        self.v.copy_from(&state.v);
        self.v.axpy(step * (1.0 - gamma), &state.a, 1.0);

        // R₀, needed only when α_f ≠ 0.
        self.right.fill(0.0);
        if alpha_f != 0.0 {
            system.load(state.time, &state.spin, &mut self.previous);
            self.previous.neg_mut();
            let at = [&state.x, &state.v];
            system.add_linear(&state.spin, at, 1.0, &mut self.scratch, &mut self.previous);
            for (minus, force) in self.force.iter_mut().zip(&state.force) {
                *minus = -force;
            }
            system.add_from_interface(&self.force, &mut self.previous);
            self.right.axpy(-alpha_f, &self.previous, 1.0);
        }
        if alpha_m != 0.0 {
            self.right.axpy(-alpha_m, &state.a, 1.0);
        }
        system.load(state.time + step, &spin, &mut self.linear);
        system.add_linear(&spin, [&self.x, &self.v], -1.0, &mut self.scratch, &mut self.linear);
        self.right.axpy(1.0 - alpha_f, &self.linear, 1.0);

        // Without bearings' forces: a₁ = S⁻¹ r. With them: a₁ += (1−α_f) S⁻¹ Wᵀ f.
        let factor = &self.factors[k];
        let off = spin.speed - factor.speed;
        let (right, on_balls) = self.right.as_slice().split_at(n);
        self.scratch.clear();
        self.scratch.extend(right);
        self.scratch.extend(right.iter().map(|r| -off * r));
        self.a.fill(0.0);
        let (a, balls) = self.a.as_mut_slice().split_at_mut(n);
        factor.inverse.mul_add(&self.scratch, a);
        for (a, right) in balls.iter_mut().zip(on_balls) {
            *a = right / (1.0 - alpha_m);
        }
        if places > 0 {
            for (y, (y0, y1)) in
                self.compliance.iter_mut().zip(factor.compliance[0].iter().zip(&factor.compliance[1]))
            {
                *y = (1.0 - alpha_f) * (y0 - off * y1);
            }
            // d = d̄ + kd u, ḋ = ḋ̄ + kv u with u = (1−α_f) Y f(d, ḋ).
            system.to_interface(&self.x, &mut self.base_d);
            system.to_interface(&self.v, &mut self.base_rate);
            system.to_interface(&self.a, &mut self.row_buffer);
            for r in 0..places {
                self.base_d[r] += kd * self.row_buffer[r];
                self.base_rate[r] += kv * self.row_buffer[r];
            }
            // The force is carried on from the last two states: a start a hundred times nearer than the last.
            for r in 0..places {
                let now = state.force[r];
                let ahead = if self.last_step == step { 2.0 * now - self.last_force[r] } else { now };
                self.force[r] = ahead;
            }
            self.newton(system, &gain)?;
            self.last_force.copy_from_slice(&state.force);
            self.last_step = step;
            let factor = &self.factors[k];
            let (rows, on_balls) = self.force.split_at(system.rows());
            self.scratch.clear();
            self.scratch.extend(rows.iter().map(|f| (1.0 - alpha_f) * f));
            self.scratch.extend(rows.iter().map(|f| -off * (1.0 - alpha_f) * f));
            let (a, balls) = self.a.as_mut_slice().split_at_mut(n);
            factor.response.mul_add(&self.scratch, a);
            for ((a, force), mass) in balls.iter_mut().zip(on_balls).zip(&system.ball_masses) {
                *a += gain.ball * force / mass.sqrt();
            }
        }

        state.x.copy_from(&self.x);
        state.x.axpy(kd, &self.a, 1.0);
        state.v.copy_from(&self.v);
        state.v.axpy(kv, &self.a, 1.0);
        state.a.copy_from(&self.a);
        state.time += step;
        state.spin = spin;
        state.rotations.copy_from_slice(&self.rotations);
        state.reactions.copy_from_slice(&self.reactions);
        state.d.copy_from_slice(&self.d);
        state.d_rate.copy_from_slice(&self.d_rate);
        state.force.copy_from_slice(&self.force);
        Ok(())
    }

    /// Newton for u = Ỹ f(d̄ + kd u, ḋ̄ + kv u), Ỹ = (1−α_f) Y, starting from the force in `self.force`.
    fn newton(&mut self, system: &System, gain: &StepGain) -> Result<(), StepFailure> {
        let (rows, kd, kv) = (system.rows(), gain.place, gain.rate);
        for (u, y) in self.unknown.iter_mut().zip(self.compliance.chunks_exact(rows)) {
            *u = y.iter().zip(&self.force).map(|(a, b)| a * b).sum::<f64>();
        }
        let mut failure = StepFailure { row: 0, residual: f64::INFINITY, iterations: 0 };
        for iteration in 1..=MAX_ITERATIONS {
            self.iterations += 1;
            for r in 0..rows {
                self.d[r] = self.base_d[r] + kd * self.unknown[r];
                self.d_rate[r] = self.base_rate[r] + kv * self.unknown[r];
            }
            self.d[rows..].copy_from_slice(&self.base_d[rows..]);
            self.d_rate[rows..].copy_from_slice(&self.base_rate[rows..]);
            system.react_in_step(
                [&mut self.d, &mut self.d_rate],
                &self.rotations,
                gain,
                &mut self.reactions,
                &mut self.force,
                &mut self.ball_follow,
            );
            // Residual u − Ỹ f and Jacobian I + Ỹ (kd K + kv C), block by block.
            for r in 0..rows {
                let y = &self.compliance[r * rows..(r + 1) * rows];
                self.residual[r] =
                    self.unknown[r] - y.iter().zip(&self.force).map(|(a, b)| a * b).sum::<f64>();
                let line = &mut self.jacobian[r * rows..(r + 1) * rows];
                line.fill(0.0);
                for (interface, reaction) in system.interfaces.iter().zip(&self.reactions) {
                    let (first, count) = (interface.first_row, interface.rows);
                    for b in 0..count {
                        let (yd, yv) = (kd * y[first + b], kv * y[first + b]);
                        let (k, c) = (&reaction.stiffness[b], &reaction.damping[b]);
                        for column in 0..count {
                            line[first + column] += yd * k[column] + yv * c[column];
                        }
                    }
                }
                line[r] += 1.0;
            }
            if !solve_in_place(&mut self.jacobian, &mut self.residual) {
                return Err(failure);
            }
            let (mut worst, mut row) = (0.0, 0);
            for r in 0..rows {
                self.unknown[r] -= self.residual[r];
                let moved = kd * self.residual[r].abs();
                if moved > worst || moved.is_nan() {
                    (worst, row) = (moved, r);
                }
            }
            failure = StepFailure { row, residual: worst, iterations: iteration };
            if worst <= TOLERANCE {
                // The force moves with the last correction by its tangent, so that force and state agree.
                self.follow(system, gain);
                return Ok(());
            }
            if !worst.is_finite() {
                return Err(failure);
            }
        }
        Err(failure)
    }

    /// Takes displacements and forces along with Newton's last correction: f ← f − (kd K + kv C) Δu, Δu = −residual.
    fn follow(&mut self, system: &System, gain: &StepGain) {
        let (rows, kd, kv) = (system.rows(), gain.place, gain.rate);
        let (on_rows, on_balls) = self.force.split_at_mut(rows);
        for (interface, reaction) in system.interfaces.iter().zip(&mut self.reactions) {
            let moved = &self.residual[interface.row_range()];
            for (b, force) in reaction.force.iter_mut().enumerate().take(interface.rows) {
                for (column, by) in moved.iter().enumerate() {
                    *force += (kd * reaction.stiffness[b][column] + kv * reaction.damping[b][column]) * by;
                }
            }
            on_rows[interface.row_range()].copy_from_slice(&reaction.force[..interface.rows]);
            for ball in interface.ball_range() {
                let by: f64 = self.ball_follow[ball].iter().zip(moved).map(|(k, by)| k * by).sum();
                on_balls[ball] += kd * by;
                let lead = gain.ball / system.ball_masses[ball] * on_balls[ball];
                self.d[rows + ball] = self.base_d[rows + ball] + kd * lead;
                self.d_rate[rows + ball] = self.base_rate[rows + ball] + kv * lead;
            }
        }
        for r in 0..rows {
            self.d[r] = self.base_d[r] + kd * self.unknown[r];
            self.d_rate[r] = self.base_rate[r] + kv * self.unknown[r];
        }
    }
}
