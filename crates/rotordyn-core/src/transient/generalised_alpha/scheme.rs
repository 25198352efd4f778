//! Parameters of the generalised-α family, and a step that failed.

use rotordyn_bearing::internal::NewmarkGain;

/// Parameters of the family (Chung & Hulbert 1993, eq. 17-20 and 25).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scheme {
    pub alpha_m: f64,
    pub alpha_f: f64,
    pub beta: f64,
    pub gamma: f64,
    /// Whether inertias are fitted to the step.
    pub fitted: bool,
}

impl Scheme {
    /// Generalised-α with spectral radius ρ∞ in \[0, 1\] at infinite frequency.
    ///
    /// x and v are second-order accurate; the algorithmic acceleration a belongs to a time (α_f − α_m) h before the end
    /// of the step (0.11 h at ρ∞ = 0.8), which an acceleration channel shows as a time shift. Newmark has no shift.
    pub fn generalised_alpha(rho: f64) -> Self {
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        Self {
            alpha_m,
            alpha_f,
            beta: 0.25 * (1.0 - alpha_m + alpha_f).powi(2),
            gamma: 0.5 - alpha_m + alpha_f,
            fitted: false,
        }
    }

    /// Newmark's average acceleration, γ = ½, β = ¼.
    pub const NEWMARK: Self = Self { alpha_m: 0.0, alpha_f: 0.0, beta: 0.25, gamma: 0.5, fitted: false };

    /// Newmark's average acceleration with fitted inertias.
    pub const FITTED_NEWMARK: Self = Self { fitted: true, ..Self::NEWMARK };

    /// Inertia of a coordinate of unit mass that vibrates at a natural frequency ω \[rad/s\], for steps of length h.
    ///
    /// A step of average acceleration turns a motion of frequency ω̂ by 2 atan(ω̂ h/2) and not by ω̂ h: frequencies come out too low by
    /// (ω h)²/12. The inertia m = (ω h/2)²/tan²(ω h/2) makes ω̂ = ω/√m turn by ω h. Up to ω h = 2, three steps in a
    /// period, and from there on that of ω h = 2, so that m is 0.4 or more and steps of any length are stable; 1 if not fitted.
    pub(super) fn inertia(&self, frequency: f64, step: f64) -> f64 {
        let half = (0.5 * frequency * step).min(1.0);
        if self.fitted && half > 0.0 { (half / half.tan()).powi(2) } else { 1.0 }
    }

    /// Position and velocity at the end of a step of length h by the accelerations ẍ₁ there: g β h² and g γ h with
    /// g = (1−α_f)/(1−α_m).
    pub(super) fn gain(&self, step: f64) -> NewmarkGain {
        let by_end = self.mean().end;
        NewmarkGain { position: by_end * self.beta * step * step, velocity: by_end * self.gamma * step }
    }

    /// a₁ of (1−α_m) a₁ + α_m a₀ = (1−α_f) ẍ₁ + α_f ẍ₀.
    pub(super) fn mean(&self) -> Mean {
        let weight = 1.0 / (1.0 - self.alpha_m);
        Mean {
            end: (1.0 - self.alpha_f) * weight,
            start: self.alpha_f * weight,
            before: -self.alpha_m * weight,
        }
    }
}

/// The integrator's acceleration a₁ = `end` ẍ₁ + `start` ẍ₀ + `before` a₀.
pub(super) struct Mean {
    pub end: f64,
    pub start: f64,
    pub before: f64,
}

/// Newton iteration that did not converge, for the driver that halves the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepFailure {
    /// Interface row with the largest correction, and that correction \[m, rad\].
    pub row: usize,
    pub residual: f64,
    pub iterations: usize,
}
