//! Driving points: the residue of a receptance at the point and direction of the force is −j a with a > 0 in every mode of a passive
//! structure, also a rotating one with little damping. Another phase is a fault of the measurement.

use super::result::{ModalIdentification, Mode};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::Dof;
use std::f64::consts::TAU;

/// Modes of less than this share of the largest modal constant are left to noise.
const LEAST_SHARE: f64 = 0.02;
/// Length of the weighted mean direction of the phases from which they agree.
const AGREE: f64 = 0.8;
/// Phase \[rad\] that is no error of identification: 20 degrees; and what a delay must leave of it, with three modes and with more.
const NOTABLE: f64 = 0.349;
const LEFT: [f64; 2] = [0.0873, 0.175];
/// Steps of the search for a delay.
const STEPS: i32 = 400;

/// A mode at a driving point: ω \[rad/s\], phase of j R \[rad\], weight |R| ω.
#[derive(Clone, Copy)]
struct Phase {
    omega: f64,
    phase: f64,
    weight: f64,
}

/// What the residues at driving points say of signs, quantities and delays, in words.
pub fn driving_point_faults(found: &ModalIdentification) -> Vec<String> {
    let mut out = Vec::new();
    for (r, response) in found.responses.iter().enumerate() {
        for (e, reference) in found.references.iter().enumerate() {
            if let Some(sign) = common_sign(*response, *reference) {
                let name = format!("{response}/{reference}");
                out.extend(
                    fault(&phases(&found.modes, r, e, sign))
                        .map(|what| format!("the residues of the driving-point FRF {name} {what}")),
                );
            }
        }
    }
    out
}

/// 1 for the same point and direction, −1 for opposite directions; `None` for others.
fn common_sign(response: Dof, reference: Dof) -> Option<f64> {
    let is_driving_point = response.node > 0
        && response.node == reference.node
        && response.direction != 0
        && response.direction.unsigned_abs() == reference.direction.unsigned_abs();
    is_driving_point.then(|| if response.direction == reference.direction { 1.0 } else { -1.0 })
}

fn phases(modes: &[Mode], r: usize, e: usize, sign: f64) -> Vec<Phase> {
    let of = |mode: &Mode| {
        let residue = sign * mode.shape[r] * mode.participation[e];
        let turned = residue * Complex64::i();
        Phase { omega: mode.pole.im, phase: turned.arg(), weight: residue.norm() * mode.pole.im }
    };
    let mut all: Vec<Phase> = modes.iter().filter(|m| m.quality_warnings.is_empty()).map(of).collect();
    let largest = all.iter().fold(0.0, |largest: f64, p| largest.max(p.weight));
    all.retain(|p| p.weight > LEAST_SHARE * largest && p.omega > 0.0);
    all
}

fn fault(all: &[Phase]) -> Option<String> {
    if let Some(delay) = delay(all) {
        return Some(format!(
            "have phases in proportion to the frequency: a delay of {:.3} ms of the {} against the other channel",
            1e3 * delay.abs(),
            if delay > 0.0 { "response" } else { "force" }
        ));
    }
    let mean = all.iter().map(|p| Complex64::from_polar(p.weight, p.phase)).sum::<Complex64>()
        / all.iter().map(|p| p.weight).sum::<f64>().max(f64::MIN_POSITIVE);
    if mean.norm() < AGREE {
        return None;
    }
    match mean.arg().to_degrees() {
        angle if angle.abs() > 150.0 => Some(
            "are negative, which no passive structure has: a reversed sensor, force or direction, or a receptance that is read as \
             an accelerance or the reverse (--quantity)"
                .into(),
        ),
        angle if (60.0..120.0).contains(&angle.abs()) => Some(format!(
            "have a phase of {:+.0} deg: the FRFs have one time derivative {} than they are read with (--quantity)",
            angle.signum() * 90.0,
            if angle > 0.0 { "more" } else { "less" }
        )),
        _ => None,
    }
}

/// Delay τ of the response \[s\] that explains the phases, −ω τ.
fn delay(all: &[Phase]) -> Option<f64> {
    let left = *LEFT.get(all.len().checked_sub(3)?).unwrap_or(&LEFT[1]);
    let lowest = all.iter().fold(f64::INFINITY, |low, p| low.min(p.omega));
    let largest_of = |tau: f64| {
        all.iter().fold(0.0, |largest: f64, p| {
            let rest = (p.phase + p.omega * tau + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
            largest.max(rest.abs())
        })
    };
    // Within a quarter of the period of the lowest mode.
    let step = 0.25 * TAU / lowest / f64::from(STEPS);
    let best = (-STEPS..=STEPS)
        .map(|k| f64::from(k) * step)
        .min_by(|a, b| largest_of(*a).total_cmp(&largest_of(*b)))?;
    (largest_of(0.0) > NOTABLE && largest_of(best) < left.min(0.4 * largest_of(0.0))).then_some(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Modes at 40 to 260 Hz with phases turned by `turn` and delayed by `tau`.
    fn modes(turn: f64, tau: f64) -> Vec<Phase> {
        let noise = [0.03, -0.05, 0.02, 0.04];
        [42.0, 95.0, 131.0, 260.0]
            .into_iter()
            .zip(noise)
            .map(|(hz, noise)| {
                let omega = TAU * hz;
                let phase = (turn - omega * tau + noise + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
                Phase { omega, phase, weight: 1.0 + noise }
            })
            .collect()
    }

    #[test]
    fn signs_quantities_and_delays_are_told_apart() {
        assert_eq!(fault(&modes(0.0, 0.0)), None);
        let text_of = |turn: f64, tau: f64| fault(&modes(turn, tau)).unwrap();
        assert!(text_of(0.5 * TAU, 0.0).contains("negative"));
        assert!(text_of(0.25 * TAU, 0.0).contains("one time derivative more"));
        assert!(text_of(-0.25 * TAU, 0.0).contains("one time derivative less"));
        for tau in [7.3e-4, -4e-4] {
            let found = delay(&modes(0.0, tau)).unwrap();
            assert!((found - tau).abs() < 5e-5, "{found}");
        }
        assert!(text_of(0.0, 7.3e-4).contains("of the response"), "{}", text_of(0.0, 7.3e-4));
        // A twentieth of a millisecond is 5 degrees at 260 Hz.
        assert_eq!(fault(&modes(0.0, 5e-5)), None);
    }

    #[test]
    fn driving_points_have_one_point_and_axis() {
        let of = |a: (i64, i8), b: (i64, i8)| common_sign(Dof::new(a.0, a.1), Dof::new(b.0, b.1));
        assert_eq!(of((1, 3), (1, 3)), Some(1.0));
        assert_eq!(of((1, -3), (1, 3)), Some(-1.0));
        for other in [(2, 3), (1, 2), (0, 0), (1, 0)] {
            assert_eq!(of((1, 3), other), None);
        }
        assert_eq!(of((0, 3), (0, 3)), None);
    }
}
