//! Common interface of the time integrators: fixed steps, halved on failure, or error-controlled steps.

use serde::{Deserialize, Serialize};

use super::generalised_alpha::{GeneralisedAlpha, Scheme, StepMemory};
use super::load_corners::LoadCorners;
use super::runge_kutta::RungeKutta;
use super::system::{State, System};
use crate::assembly::PhysicsError;
use crate::model::study::Integrator;
use rotordyn_bearing::Reaction;

/// Largest number of halvings of a step: 2⁻¹² of its length.
const MAX_HALVINGS: u32 = 12;
/// No step for free bodies is shorter \[s\]: friction so stiff makes the run diverge, which ends it.
const SHORTEST_STEP: f64 = 1e-9;
/// Bearing displacement above which the run counts as diverged \[m\].
const MAX_DISPLACEMENT: f64 = 0.1;

/// A time integrator for one system.
pub struct Stepper {
    method: Method,
    /// Steps accepted.
    pub steps: u64,
    /// Steps that were halved (implicit) or rejected by error control (explicit).
    pub halvings: u64,
    /// Longest step for the structure where free bodies set the step \[s\]; found at the first step.
    structure_step: Option<f64>,
    /// Shortest step taken with free bodies \[s\].
    shortest: f64,
    corners: LoadCorners,
}

#[allow(clippy::large_enum_variant)] // there is one
enum Method {
    Implicit(Box<GeneralisedAlpha>),
    Fixed(RungeKutta),
    Adaptive {
        method: RungeKutta,
        /// Relative, and absolute in mass-normalised coordinates.
        tolerance: (f64, f64),
        step: f64,
    },
}

/// What a [`Stepper`] takes from the steps before: with it a new one goes on with the same bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StepperMemory {
    method: MethodMemory,
    steps: u64,
    halvings: u64,
    structure_step: Option<f64>,
    shortest: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
enum MethodMemory {
    Implicit(Box<StepMemory>),
    Explicit {
        reactions: Vec<Reaction>,
        evaluations: u64,
        /// The next step under error control \[s\].
        step: Option<f64>,
    },
}

impl StepperMemory {
    /// Whether it is one of this integrator and of a system of this size.
    pub fn fits(&self, system: &System, integrator: Integrator) -> bool {
        let implicit = !matches!(integrator, Integrator::RungeKutta4 | Integrator::DormandPrince { .. });
        let adaptive = matches!(integrator, Integrator::DormandPrince { .. });
        match &self.method {
            MethodMemory::Implicit(memory) => implicit && memory.fits(system),
            MethodMemory::Explicit { reactions, step, .. } => {
                !implicit && adaptive == step.is_some() && reactions.len() == system.interfaces.len()
            }
        }
    }
}

/// Called after every accepted step with its length.
pub type OnStep<'a> = &'a mut dyn FnMut(&mut State, f64) -> Result<(), PhysicsError>;

impl Stepper {
    /// `step`: the initial step under error control, else unused.
    pub fn new(system: &System, integrator: Integrator, step: f64) -> Self {
        let implicit = |scheme| Method::Implicit(Box::new(GeneralisedAlpha::new(system, scheme)));
        let method = match integrator {
            Integrator::GeneralisedAlpha { rho_infinity } => {
                implicit(Scheme::generalised_alpha(rho_infinity))
            }
            Integrator::Newmark => implicit(Scheme::NEWMARK),
            Integrator::FittedNewmark => implicit(Scheme::FITTED_NEWMARK),
            Integrator::RungeKutta4 => Method::Fixed(RungeKutta::classical(system)),
            Integrator::DormandPrince { relative_tolerance, absolute_tolerance } => Method::Adaptive {
                method: RungeKutta::dormand_prince(system),
                tolerance: (relative_tolerance, absolute_tolerance),
                step,
            },
        };
        let corners = LoadCorners::new(system);
        Self { method, steps: 0, halvings: 0, structure_step: None, shortest: f64::INFINITY, corners }
    }

    /// Ends Newton's iterations of an implicit method where they leave a thousandth of the first correction of a step, far less than
    /// the step itself: for a run-up, not for the small difference of two trajectories.
    pub fn end_below_step_error(mut self) -> Self {
        if let Method::Implicit(method) = &mut self.method {
            method.end_below_step_error();
        }
        self
    }

    /// What later steps take from those so far.
    pub fn memory(&self) -> StepperMemory {
        let explicit = |method: &RungeKutta, step| MethodMemory::Explicit {
            reactions: method.reactions().to_vec(),
            evaluations: method.evaluations,
            step,
        };
        let method = match &self.method {
            Method::Implicit(method) => MethodMemory::Implicit(Box::new(method.memory())),
            Method::Fixed(method) => explicit(method, None),
            Method::Adaptive { method, step, .. } => explicit(method, Some(*step)),
        };
        StepperMemory {
            method,
            steps: self.steps,
            halvings: self.halvings,
            structure_step: self.structure_step,
            shortest: self.shortest,
        }
    }

    /// The stepper after the steps that left `memory`, which fits system and integrator.
    pub fn after(system: &System, integrator: Integrator, memory: &StepperMemory) -> Self {
        let mut out = Self::new(system, integrator, 0.0);
        match (&mut out.method, &memory.method) {
            (Method::Implicit(method), MethodMemory::Implicit(memory)) => {
                **method = GeneralisedAlpha::after(system, method.scheme(), memory);
            }
            (
                Method::Fixed(method) | Method::Adaptive { method, .. },
                MethodMemory::Explicit { reactions, evaluations, .. },
            ) => {
                method.set_reactions(reactions);
                method.evaluations = *evaluations;
            }
            // Not of this integrator, which `fits` refuses.
            _ => {}
        }
        if let (Method::Adaptive { step: own, .. }, MethodMemory::Explicit { step: Some(step), .. }) =
            (&mut out.method, &memory.method)
        {
            *own = *step;
        }
        (out.steps, out.halvings) = (memory.steps, memory.halvings);
        (out.structure_step, out.shortest) = (memory.structure_step, memory.shortest);
        out
    }

    /// Shortest step taken where free bodies divide the given one \[s\]; else infinite.
    pub fn shortest_step(&self) -> f64 {
        self.shortest
    }

    /// Whether the step size is controlled by the error estimate.
    pub fn is_adaptive(&self) -> bool {
        matches!(self.method, Method::Adaptive { .. })
    }

    /// What helps against divergence that the method causes; empty for an implicit one.
    fn advice(&self, system: &System) -> String {
        let (name, smaller) = match self.method {
            Method::Implicit(_) => return String::new(),
            Method::Fixed(_) => ("rk4", "lower step"),
            Method::Adaptive { .. } => {
                ("dormand-prince", "lower step, relative_tolerance and absolute_tolerance")
            }
        };
        // Free bodies need it.
        let other =
            if system.has_bodies() { "" } else { ", or leave out integrator, whose default is implicit" };
        format!("; the explicit integrator {name} is unstable if its steps are too long: {smaller}{other}")
    }

    /// Newton iterations spent and effective matrices inverted by an implicit method.
    pub fn iteration_counts(&self) -> (u64, u64) {
        match &self.method {
            Method::Implicit(method) => (method.iterations(), method.inverted()),
            _ => (0, 0),
        }
    }

    /// Advances `state` by `step` to the time `end`, given by the caller to avoid accumulated round-off.
    ///
    /// # Errors
    /// A step that fails at the smallest length, or an error of `taken`.
    pub fn advance(
        &mut self,
        system: &System,
        state: &mut State,
        mut step: f64,
        end: f64,
        taken: OnStep,
    ) -> Result<(), PhysicsError> {
        let all = self.is_adaptive();
        if self.corners.divide(system, state.time, end, all) {
            while let Some(corner) = self.corners.next(system, state.time, end) {
                self.smooth_step(system, state, corner - state.time, corner, taken)?;
            }
            step = end - state.time;
        }
        self.smooth_step(system, state, step, end, taken)
    }

    /// [`Self::advance`] where no load has a corner within the step that matters.
    fn smooth_step(
        &mut self,
        system: &System,
        state: &mut State,
        step: f64,
        end: f64,
        taken: OnStep,
    ) -> Result<(), PhysicsError> {
        match &self.method {
            Method::Implicit(_) => self.implicit(system, state, step, 0, taken)?,
            Method::Fixed(_) if system.has_bodies() => self.divided_step(system, state, step, taken)?,
            Method::Fixed(_) => {
                self.exact_step(system, state, step)?;
                taken(state, step)?;
            }
            Method::Adaptive { .. } => self.adaptive_steps(system, state, end, taken)?,
        }
        state.time = end;
        Ok(())
    }

    /// Prepares a state for steps of another length: velocities and accelerations may change with fitted inertias.
    pub fn fit_inertias(&self, system: &System, state: &mut State, step: f64) {
        if let Method::Implicit(method) = &self.method {
            method.fit_inertias(system, state, step);
        }
    }

    /// γ − ½ and β − ½γ of an implicit method, which are 0 if velocities and displacements follow from accelerations and velocities
    /// by the trapezoidal rule.
    pub fn distance_from_trapezoidal_rule(&self) -> [f64; 2] {
        let Method::Implicit(method) = &self.method else { return [0.0; 2] };
        let scheme = method.scheme();
        [scheme.gamma - 0.5, scheme.beta - 0.5 * scheme.gamma]
    }

    /// Takes one step of exactly this length, neither halved nor rejected, as a perturbed trajectory must.
    ///
    /// # Errors
    /// An implicit step that does not converge.
    pub fn exact_step(&mut self, system: &System, state: &mut State, step: f64) -> Result<(), PhysicsError> {
        match &mut self.method {
            Method::Implicit(method) => {
                let spin = system.spin_ahead(state.time, &state.spin, step);
                method
                    .step(system, state, step, spin)
                    .map_err(|failure| no_convergence(system, state, failure))?;
            }
            Method::Fixed(method) | Method::Adaptive { method, .. } => {
                explicit(system, state, method, step, None);
            }
        }
        self.steps += 1;
        Ok(())
    }

    /// Equal parts of a step, short enough for the free bodies as they are at its start.
    fn divided_step(
        &mut self,
        system: &System,
        state: &mut State,
        step: f64,
        taken: OnStep,
    ) -> Result<(), PhysicsError> {
        system.check_bodies(state)?;
        let for_structure = *self.structure_step.get_or_insert_with(|| system.structure_step(state));
        let longest = for_structure.min(system.body_step(state)).max(SHORTEST_STEP);
        let parts = (step / longest).ceil().max(1.0);
        let part = step / parts;
        self.shortest = self.shortest.min(part);
        for _ in 0..parts as u64 {
            self.exact_step(system, state, part)?;
            taken(state, part)?;
        }
        system.check_bodies(state)
    }

    /// One implicit step, halved while Newton does not converge.
    fn implicit(
        &mut self,
        system: &System,
        state: &mut State,
        step: f64,
        depth: u32,
        taken: OnStep,
    ) -> Result<(), PhysicsError> {
        match self.exact_step(system, state, step) {
            Ok(()) => taken(state, step),
            Err(_) if depth < MAX_HALVINGS => {
                self.halvings += 1;
                self.implicit(system, state, 0.5 * step, depth + 1, taken)?;
                self.implicit(system, state, 0.5 * step, depth + 1, taken)
            }
            Err(failure) => Err(failure),
        }
    }

    /// Steps to `end` exactly, adapting the step on the way.
    fn adaptive_steps(
        &mut self,
        system: &System,
        state: &mut State,
        end: f64,
        taken: OnStep,
    ) -> Result<(), PhysicsError> {
        let Method::Adaptive { method, tolerance, step: next } = &mut self.method else { return Ok(()) };
        let smallest = 1e-12 * end.max(1e-3);
        while end - state.time > smallest {
            let left = end - state.time;
            // Two equal steps rather than a full and a very short one.
            let step = if *next >= left {
                left
            } else if 2.0 * *next > left {
                0.5 * left
            } else {
                *next
            };
            let estimate = explicit(system, state, method, step, Some(*tolerance));
            let factor = if estimate > 0.0 { 0.9 * estimate.powf(-0.2) } else { 5.0 };
            if estimate <= 1.0 {
                self.steps += 1;
                taken(state, step)?;
                *next = step * factor.clamp(0.2, 5.0);
            } else {
                self.halvings += 1;
                *next = if estimate.is_finite() { step * factor.clamp(0.1, 0.9) } else { 0.1 * step };
                if *next < smallest {
                    return Err(PhysicsError::NoConvergence {
                        item: "error control".into(),
                        time: state.time,
                        speed_rpm: rpm(state.spin.speed),
                        residual: estimate,
                        iterations: self.halvings as usize,
                    });
                }
            }
        }
        Ok(())
    }
}

/// One explicit step; returns the error estimate, above 1 when the step was rejected.
fn explicit(
    system: &System,
    state: &mut State,
    method: &mut RungeKutta,
    step: f64,
    tolerance: Option<(f64, f64)>,
) -> f64 {
    let (time, spin) = (state.time, state.spin);
    let ahead = |offset| system.spin_ahead(time, &spin, offset);
    method.step(system, state, step, &ahead, tolerance)
}

fn no_convergence(
    system: &System,
    state: &State,
    failure: super::generalised_alpha::StepFailure,
) -> PhysicsError {
    PhysicsError::NoConvergence {
        item: match failure.row {
            usize::MAX => "the rotation of the shaft".into(),
            row => system.name_of_row(row),
        },
        time: state.time,
        speed_rpm: rpm(state.spin.speed),
        residual: failure.residual,
        iterations: failure.iterations,
    }
}

/// Divergence check: all values finite and all bearing displacements within limits.
///
/// # Errors
/// [`PhysicsError::Diverged`] naming the largest displacement.
pub fn check_divergence(system: &System, state: &State, stepper: &Stepper) -> Result<(), PhysicsError> {
    // Without early ends, for vector instructions.
    let are_finite = |y: &[f64]| y.iter().fold(true, |all, v| all & v.is_finite());
    let are_small = |d: &[f64]| d.iter().fold(true, |all, d| all & (d.abs() < MAX_DISPLACEMENT));
    if are_finite(state.x.as_slice()) && are_finite(state.v.as_slice()) && are_small(&state.d) {
        return Ok(());
    }
    let worst = state.d.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (row, value) = worst.map_or((0, 0.0), |(r, v)| (r, *v));
    Err(PhysicsError::Diverged {
        item: system.name_of_row(row),
        time: state.time,
        speed_rpm: rpm(state.spin.speed),
        value,
        advice: stepper.advice(system),
    })
}

fn rpm(speed: f64) -> f64 {
    speed * 30.0 / std::f64::consts::PI
}
