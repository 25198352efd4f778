//! Modes of bearings whose coefficients depend on the frequency of the whirl.

use crate::analysis::critical_speed::continued_eigenvalue;
use crate::analysis::{Mode, log_decrement};
use crate::document::TO_RPM;
use crate::study::{Machine, Results};
use crate::warning::{Code, Warning};
use rotordyn_linalg::Complex64;
use std::f64::consts::TAU;

/// Relative change of λ from which a mode counts as another one.
const SMALLEST_CHANGE: f64 = 1e-3;
/// Relative change of λ at which the iteration for a mode with the coefficients at its own frequency ends.
const TOLERANCE: f64 = 1e-8;
const MAX_ITERATIONS: usize = 20;

impl Machine {
    /// Modes that are others with the coefficients at their own frequency than at that of rotation, which they take: the one
    /// that changes most of each study.
    pub(super) fn whirl_frequency_warnings(&self, results: &Results) -> Vec<Warning> {
        if !self.has_whirl_tables() {
            return Vec::new();
        }
        let modal = results.modal.iter().flat_map(|at| at.modes.iter().map(|mode| (at.speed, mode)));
        let diagrams = results.campbell.iter().map(|found| &found.diagram);
        let branches = diagrams.flat_map(|diagram| {
            let along = |modes| diagram.speeds.iter().copied().zip(modes);
            diagram.branches.iter().flat_map(move |branch| along(&branch.modes))
        });
        let branches = branches.filter_map(|(speed, mode)| Some((speed, mode.as_ref()?)));
        let crossings = results.critical.iter().flat_map(|found| &found.crossings.list);
        let found = [
            self.largest_change("study.modal", modal),
            self.largest_change("study.campbell", branches),
            self.largest_change("study.critical", crossings.map(|found| (found.speed, &found.mode))),
        ];
        found.into_iter().flatten().collect()
    }

    fn largest_change<'m>(
        &self,
        item: &str,
        modes: impl Iterator<Item = (f64, &'m Mode)>,
    ) -> Option<Warning> {
        let mut changed: Vec<(f64, f64, &Mode, Complex64)> = modes
            .filter_map(|(speed, mode)| {
                let own = self.at_own_frequency(speed, mode)?;
                let change = (own - mode.eigenvalue).norm() / mode.natural_omega();
                (change > SMALLEST_CHANGE).then_some((change, speed, mode, own))
            })
            .collect();
        changed.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (_, speed, mode, own) = changed.first()?;
        let others = match changed.len() - 1 {
            0 => String::new(),
            1 => "; another mode changes too".into(),
            n => format!("; {n} others change too"),
        };
        let text = format!(
            "{} at {:.0} rpm takes the coefficients over whirl frequency at the frequency of rotation: {:.2} Hz, log \
             decrement {:.3}; with those at its own frequency it has {:.2} Hz, {:.3}{others}",
            mode.label,
            speed * TO_RPM,
            mode.frequency_hz(),
            mode.log_dec(),
            own.im / TAU,
            log_decrement(*own)
        );
        Some(Warning::new(Code::WhirlFrequency, item, text))
    }

    /// λ of a mode with the coefficients at the frequency of that λ, by iteration; `None` where it is not found.
    fn at_own_frequency(&self, speed: f64, mode: &Mode) -> Option<Complex64> {
        let mut value = mode.eigenvalue;
        for _ in 0..MAX_ITERATIONS {
            let system = self.linear_system_at_whirl(speed, value.im).ok()??;
            let next = continued_eigenvalue(&system, mode)?;
            let change = (next - value).norm() / next.norm();
            value = next;
            if change < TOLERANCE {
                break;
            }
        }
        Some(value)
    }
}
