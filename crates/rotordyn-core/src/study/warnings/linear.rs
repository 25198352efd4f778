//! Linear responses used beyond their sense.

use crate::analysis::equilibrium::BearingState;
use crate::analysis::peaks::Peak;
use crate::document::{TO_RPM, number};
use crate::results::UnbalanceResult;
use crate::study::{Machine, Results};
use crate::warning::{Code, Warning};
use rotordyn_linalg::Complex64;
use std::collections::BTreeSet;

/// A bearing in the linear unbalance response at the speed where its contacts come nearest to opening.
struct Opening {
    speed: f64,
    /// Amplitude of the relative radial displacement \[m\] and of the force of the linear bearing \[N\].
    displacement: f64,
    force: f64,
    /// The larger of amplitude over compression, and amplitude of the force over the static one.
    excess: f64,
}

/// Amplification factor above which hardly anything damps a peak: a damping ratio of 1e-5, a tenth of that of bare metal.
const SHARP: f64 = 5e4;
/// Peaks within this share of their frequency are one.
const SAME_PEAK: f64 = 1e-3;

/// The sharpest of the peaks (response, peak) at every frequency, of those above [`SHARP`].
fn sharp_peaks(peaks: impl Iterator<Item = (String, Peak)>) -> Vec<(String, Peak, f64)> {
    let sharp = peaks.filter_map(|(name, peak)| {
        let factor = peak.amplification().filter(|factor| *factor > SHARP && factor.is_finite())?;
        Some((name, peak, factor))
    });
    let mut found: Vec<(String, Peak, f64)> = Vec::new();
    for one in sharp {
        match found.iter_mut().find(|other| (other.1.at - one.1.at).abs() < SAME_PEAK * one.1.at) {
            Some(other) if other.2 < one.2 => *other = one,
            Some(_) => {}
            None => found.push(one),
        }
    }
    found
}

fn sharp_peaks_of_unbalance(result: &UnbalanceResult) -> Vec<Warning> {
    let all = result.peaks.iter().map(|found| (found.response.clone(), found.peak));
    let warning = |(response, peak, factor): (String, Peak, f64)| {
        let text = format!(
            "unbalance: the peak of {response} at {:.2} rpm has an amplification factor of {factor:.1e} (damping ratio {:.1e}): \
             hardly anything damps this mode, and the height of the peak says nothing of a real machine",
            peak.at * TO_RPM,
            0.5 / factor
        );
        Warning::new(Code::UndampedPeak, "study.unbalance", text)
    };
    sharp_peaks(all).into_iter().map(warning).collect()
}

impl Machine {
    pub(super) fn linear_warnings(&self, results: &Results) -> Vec<Warning> {
        let mut found = Vec::new();
        let undamped = |item: &str, text: String| Warning::new(Code::UndampedPeak, item, text);
        for peak in results.frf.iter().flat_map(|frf| &frf.undamped) {
            let text =
                format!("frf: {} at {:.4} Hz is undamped: the FRF is infinite there", peak.label, peak.at);
            found.push(undamped("study.frf", text));
        }
        for peak in results.unbalance.iter().flat_map(|unbalance| &unbalance.undamped) {
            let (label, rpm) = (&peak.label, peak.at * TO_RPM);
            let text =
                format!("unbalance: {label} at {rpm:.2} rpm is undamped: the response is infinite there");
            found.push(undamped("study.unbalance", text));
        }
        found.extend(results.unbalance.iter().flat_map(sharp_peaks_of_unbalance));
        found.extend(results.unbalance.iter().flat_map(|response| self.opened_contacts(response)));
        found
    }

    /// Ball bearings whose contacts would open under the linear unbalance response.
    ///
    /// Clearances in bearings are the only gaps that a model has: discs, housings and bodies have masses and springs, but no
    /// bores or walls, and linear bearings no play; a response that strikes a part of the machine shows in its amplitude only.
    /// The contacts open where the displacement exceeds the compression of the most loaded ball; in a bearing with
    /// unloaded balls the force follows its tangent only up to about the static load.
    fn opened_contacts(&self, result: &UnbalanceResult) -> Vec<Warning> {
        let bearings = self
            .model
            .bearings
            .iter()
            .zip(&self.standstill_equilibrium.bearings)
            .zip(result.bearing_displacements.iter().zip(&result.bearing_forces));
        let mut found = Vec::new();
        for ((site, state), (displacements, forces)) in bearings {
            let Some(compression) = largest_compression(state) else { continue };
            let rows = RowStates::of(state);
            let static_force = state.force[0].hypot(state.force[1]);
            let openings = result.speeds.iter().zip(displacements).enumerate().map(|(k, (speed, &d))| {
                let (displacement, force) = (semi_major_axis(d), forces.amplitude(k));
                let by_force = if rows.partly_loaded { force / static_force } else { 0.0 };
                let excess = (displacement / compression).max(displacement / rows.gap).max(by_force);
                Opening { speed: *speed, displacement, force, excess }
            });
            let Some(worst) = openings.max_by(|a, b| a.excess.total_cmp(&b.excess)) else { continue };
            if worst.excess <= 1.0 || !worst.excess.is_finite() {
                continue;
            }
            let clearance = site.bearing.ball().map_or(0.0, |ball| ball.geometry.radial_clearance);
            let clearance = if clearance > 0.0 {
                format!(", radial clearance {} um", number(1e6 * clearance, 3))
            } else {
                String::new()
            };
            let text = format!(
                "unbalance: at {:.0} rpm the linear response moves bearing {} by {} um and loads it with {} N (static \
                 compression of its balls {} um, load {} N{clearance}): its contacts open, and its stiffness is another",
                worst.speed * TO_RPM,
                site.name,
                number(1e6 * worst.displacement, 3),
                number(worst.force, 3),
                number(1e6 * compression, 3),
                number(static_force, 3)
            );
            let advice = "near this speed trust a run-up, which has the bearing's own forces";
            found
                .push(Warning::new(Code::LinearRange, format!("bearing.{}", site.name), text).advise(advice));
        }
        found
    }
}

/// Which contacts of a bearing carry load at rest.
struct RowStates {
    /// Whether a row has both loaded and unloaded contacts.
    partly_loaded: bool,
    /// Smallest gap of the rows without any load \[m\], infinite without such a row: a motion that closes it meets another
    /// stiffness.
    gap: f64,
}

impl RowStates {
    fn of(state: &BearingState) -> Self {
        let mut of = Self { partly_loaded: false, gap: f64::INFINITY };
        let rows: BTreeSet<usize> = state.balls.iter().map(|contact| contact.row).collect();
        for row in rows {
            let contacts = || state.balls.iter().filter(|contact| contact.row == row);
            let loaded = contacts().filter(|contact| contact.load > 0.0).count();
            of.partly_loaded |= loaded > 0 && loaded < contacts().count();
            if loaded == 0 {
                of.gap = contacts().map(|contact| -contact.deflection).fold(of.gap, f64::min).max(0.0);
            }
        }
        of
    }
}

/// Compression of the most loaded ball \[m\]; `None` for a bearing without contacts or without load.
fn largest_compression(state: &BearingState) -> Option<f64> {
    let largest = state.balls.iter().map(|contact| contact.deflection).fold(0.0, f64::max);
    (largest > 0.0).then_some(largest)
}

/// Semi-major axis of the ellipse Re((x, y) e^{jΩt}).
fn semi_major_axis([x, y]: [Complex64; 2]) -> f64 {
    (0.5 * (x.norm_sqr() + y.norm_sqr() + (x * x + y * y).norm())).sqrt()
}
