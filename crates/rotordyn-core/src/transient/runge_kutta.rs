//! Explicit Runge-Kutta steps: the classical method of order 4 (RK4) and Dormand-Prince 5(4).

use nalgebra::DVector;

use super::cage;
use super::system::{Bodies, State, System};
use super::torque::coupling::{Motion, Workspace};
use crate::model::Spin;
use rotordyn_bearing::{Reaction, Rotation};

/// Coefficients of an explicit method; rows of `a` are packed.
struct Tableau {
    c: &'static [f64],
    a: &'static [&'static [f64]],
    b: &'static [f64],
    /// b − b̂, for the embedded error estimate.
    error: &'static [f64],
    /// Whether the last stage is the state at the step's end (FSAL, first same as last).
    last_is_end: bool,
}

const RK4: Tableau = Tableau {
    c: &[0.0, 0.5, 0.5, 1.0],
    a: &[&[], &[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]],
    b: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    error: &[],
    last_is_end: false,
};

/// Dormand & Prince 1980, RK5(4)7M.
const DORMAND_PRINCE: Tableau = Tableau {
    c: &[0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0],
    a: &[
        &[],
        &[0.2],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
        &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
        &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
    ],
    b: &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0, 0.0],
    error: &[
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ],
    last_is_end: true,
};

/// Explicit integrator; steps are allocation-free.
pub struct RungeKutta {
    tableau: &'static Tableau,
    /// (ẋ, ẍ) of every stage.
    stages: Vec<(DVector<f64>, DVector<f64>)>,
    /// States of free bodies, and their rates at every stage.
    bodies: Vec<f64>,
    body_stages: Vec<Vec<f64>>,
    x: DVector<f64>,
    v: DVector<f64>,
    x_error: DVector<f64>,
    v_error: DVector<f64>,
    d: Vec<f64>,
    d_rate: Vec<f64>,
    force: Vec<f64>,
    scratch: Vec<f64>,
    rotations: Vec<Rotation>,
    reactions: Vec<Reaction>,
    /// Buffers of a torque drive: of its coupling, and x, ẋ without the rigid rotation.
    coupling: Option<Workspace>,
    centred: [DVector<f64>; 2],
    at_rest: DVector<f64>,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
}

impl RungeKutta {
    pub fn classical(system: &System) -> Self {
        Self::new(system, &RK4)
    }

    pub fn dormand_prince(system: &System) -> Self {
        Self::new(system, &DORMAND_PRINCE)
    }

    fn new(system: &System, tableau: &'static Tableau) -> Self {
        let (n, m) = (system.size(), system.interface_size());
        let zero = || DVector::zeros(n);
        Self {
            tableau,
            stages: (0..tableau.c.len()).map(|_| (zero(), zero())).collect(),
            bodies: vec![0.0; system.body_states()],
            body_stages: vec![vec![0.0; system.body_states()]; tableau.c.len()],
            x: zero(),
            v: zero(),
            x_error: zero(),
            v_error: zero(),
            d: vec![0.0; m],
            d_rate: vec![0.0; m],
            force: vec![0.0; m],
            scratch: Vec::new(),
            rotations: vec![Rotation::default(); system.interfaces.len()],
            reactions: vec![Reaction::default(); system.interfaces.len()],
            coupling: system.drive.as_ref().map(|drive| Workspace::new(drive, n)),
            centred: [zero(), zero()],
            at_rest: zero(),
            evaluations: 0,
        }
    }

    /// Reactions of the last evaluation: a force without tangents leaves those of the evaluation before.
    pub fn reactions(&self) -> &[Reaction] {
        &self.reactions
    }

    /// The integrator after a step that ended with these reactions, as many as interfaces.
    pub fn set_reactions(&mut self, reactions: &[Reaction]) {
        self.reactions.copy_from_slice(reactions);
    }

    /// Rate (ẋ, ẍ) at (time, x, v), written to `stage`; reactions, d and ḋ of that point stay in the buffers.
    fn evaluate(&mut self, system: &System, state: &State, time: f64, spin: &Spin, stage: usize) {
        self.evaluations += 1;
        let mut spin = *spin;
        let [mut x, mut v] = [&self.x, &self.v];
        if let Some(drive) = &system.drive {
            // The rigid rotation within the step belongs to the shaft's rotation.
            let [angle, speed] = [drive.rigid_part(x), drive.rigid_part(v)];
            for ((centred, y), turned) in self.centred.iter_mut().zip([x, v]).zip([angle, speed]) {
                centred.copy_from(y);
                centred.axpy(-turned, &drive.rigid_rotation, 1.0);
            }
            spin.angle += angle;
            spin.speed += speed;
            [x, v] = self.centred.each_ref();
        }
        cage::advance(system, state, &spin, &mut self.rotations);
        system.to_interface(x, &mut self.d);
        system.to_interface(v, &mut self.d_rate);
        let bodies = Bodies { states: &self.bodies, rates: &mut self.body_stages[stage] };
        let (reactions, force) = (&mut self.reactions, &mut self.force);
        system.bearing_forces(&self.d, &self.d_rate, &self.rotations, bodies, reactions, force);
        let (rate, acceleration) = &mut self.stages[stage];
        rate.copy_from(&self.v);
        system.load(time, &spin, acceleration);
        system.add_linear(&spin, [x, v], -1.0, &mut self.scratch, acceleration);
        system.add_from_interface(&self.force, acceleration);
        if let (Some(drive), Some(work)) = (&system.drive, &mut self.coupling) {
            let at = Motion { spin: &spin, x, v, acceleration: &self.at_rest };
            drive.add_coupling(system, &at, &self.reactions, work, acceleration);
            drive.solve_inertia(work, acceleration);
        }
    }

    /// x and v of the state plus the weighted sum of the stage rates.
    fn combine(&mut self, state: &State, step: f64, weights: &[f64]) {
        let (x, v) = (self.x.as_mut_slice(), self.v.as_mut_slice());
        let [mut from_x, mut from_v] = [Some(state.x.as_slice()), Some(state.v.as_slice())];
        for (weight, (rate, acceleration)) in weights.iter().zip(&self.stages).filter(|(w, _)| **w != 0.0) {
            add(x, from_x.take(), step * weight, rate.as_slice());
            add(v, from_v.take(), step * weight, acceleration.as_slice());
        }
        let mut from_bodies = Some(state.bodies.as_slice());
        for (weight, rates) in weights.iter().zip(&self.body_stages).filter(|(w, _)| **w != 0.0) {
            add(&mut self.bodies, from_bodies.take(), step * weight, rates);
        }
    }

    /// Tries a step; returns the error estimate in units of the tolerance (0 without error control).
    ///
    /// `spin` gives the shaft's motion at an offset from the state's time. With `tolerance` = (relative,
    /// absolute \[m √kg\]) and an estimate above 1 the state is left as it was.
    pub fn step(
        &mut self,
        system: &System,
        state: &mut State,
        step: f64,
        spin: &dyn Fn(f64) -> Spin,
        tolerance: Option<(f64, f64)>,
    ) -> f64 {
        let Tableau { c, a, b, error, last_is_end } = *self.tableau;
        // The first stage is the state's own rate.
        self.stages[0].0.copy_from(&state.v);
        self.stages[0].1.copy_from(&state.a);
        self.body_stages[0].copy_from_slice(&state.body_rates);
        for stage in 1..c.len() {
            self.combine(state, step, a[stage]);
            let offset = c[stage] * step;
            self.evaluate(system, state, state.time + offset, &spin(offset), stage);
        }
        let mut estimate = 0.0;
        if let Some((relative, absolute)) = tolerance {
            self.x_error.fill(0.0);
            self.v_error.fill(0.0);
            for (weight, (rate, acceleration)) in error.iter().zip(&self.stages) {
                self.x_error.axpy(step * weight, rate, 1.0);
                self.v_error.axpy(step * weight, acceleration, 1.0);
            }
            // Velocities on their own scale: on that of displacements, static ones above all, noise of stiff modes at the limit of
            // stability passes, which contacts dissipate.
            let [x, v] = [state.x.amax(), step * state.v.amax()];
            let of_x = self.x_error.amax() / (absolute + relative * (x + v));
            let of_v = step * self.v_error.amax() / (absolute + relative * v);
            estimate = of_x.max(of_v);
            if estimate > 1.0 || estimate.is_nan() {
                return estimate;
            }
        }
        let end = spin(step);
        if !last_is_end {
            self.combine(state, step, b);
            self.evaluate(system, state, state.time + step, &end, 0);
        }
        state.x.copy_from(&self.x);
        state.v.copy_from(&self.v);
        state.a.copy_from(&self.stages[if last_is_end { c.len() - 1 } else { 0 }].1);
        state.acceleration.copy_from(&state.a);
        if system.drive.is_some() {
            state.driven.rate = end.acceleration;
        }
        state.time += step;
        state.spin = end;
        state.rotations.copy_from_slice(&self.rotations);
        state.reactions.copy_from_slice(&self.reactions);
        state.d.copy_from_slice(&self.d);
        state.d_rate.copy_from_slice(&self.d_rate);
        state.force.copy_from_slice(&self.force);
        if system.has_bodies() {
            state.bodies.copy_from_slice(&self.bodies);
            state.body_rates.copy_from_slice(&self.body_stages[if last_is_end { c.len() - 1 } else { 0 }]);
            system.finish_bodies(state);
        }
        estimate
    }
}

/// y ← base + factor · rate; without `base`, y ← y + factor · rate.
fn add(y: &mut [f64], base: Option<&[f64]>, factor: f64, rate: &[f64]) {
    match base {
        Some(base) => y.iter_mut().zip(base).zip(rate).for_each(|((y, b), r)| *y = b + factor * r),
        None => y.iter_mut().zip(rate).for_each(|(y, r)| *y += factor * r),
    }
}
