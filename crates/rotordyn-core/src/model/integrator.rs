//! Time integration methods.

/// Time integrator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integrator {
    /// Generalised-α with spectral radius at infinity ρ∞.
    GeneralisedAlpha { rho_infinity: f64 },
    /// Newmark, γ = ½, β = ¼.
    Newmark,
    /// Newmark with the inertia of every reduced mode fitted to its exact frequency at the step length.
    FittedNewmark,
    /// Classical Runge-Kutta of order 4, fixed step.
    RungeKutta4,
    /// Dormand-Prince 5(4), error-controlled.
    DormandPrince { relative_tolerance: f64, absolute_tolerance: f64 },
}
