//! A massless ball: both contacts carry one load along the line that joins the groove centres.

use super::ring_sum::PlaneForce;
use super::row::PlaneMotion;
use crate::contact::{ContactDamping, Loaded};

/// Plane force of a massless ball.
///
/// s is the inner groove centre seen from the outer one, n = s/|s|, δ = |s| − A + w_i + w_o its approach with
/// waviness; p = Q n with Q = max(0, Q_e(δ) + damping) and δ̇ = n·ṡ + ẇ. Along t, across n, the load turns with the
/// line: ∂p/∂s = Q′ n nᵀ + (Q/|s|) t tᵀ + (∂Q/∂δ̇) n (∂δ̇/∂s)ᵀ, ∂δ̇/∂s = t (t·ṡ)/|s|.
///
/// `None` when the law says unloaded. A contact that would have to pull lets go: its elastic energy is lost.
#[inline(always)]
pub(super) fn react(
    series: impl Fn(f64) -> Loaded,
    damping: &ContactDamping,
    centre_distance: f64,
    motion: &PlaneMotion,
) -> Option<PlaneForce> {
    let [radial, axial] = motion.s;
    let distance = (radial * radial + axial * axial).sqrt();
    let approach = distance - centre_distance + motion.waves[0] + motion.waves[1];
    let elastic = series(approach);
    if elastic.load <= 0.0 {
        return None;
    }
    let inverse = 1.0 / distance;
    let n = [radial * inverse, axial * inverse];
    let wave_rate = motion.wave_rates[0] + motion.wave_rates[1];
    let rate = n[0] * motion.rate[0] + n[1] * motion.rate[1] + wave_rate;
    let damped = damped(damping, elastic, approach, rate);
    let load = damped.load;
    let mut out = PlaneForce {
        energy: elastic.energy,
        dissipated: (load - elastic.load) * rate,
        power: load * wave_rate,
        ..PlaneForce::default()
    };
    if load > 0.0 {
        let turn = (n[0] * motion.rate[1] - n[1] * motion.rate[0]) * inverse;
        let bend = load * inverse;
        let nn = [n[0] * n[0], n[0] * n[1], n[1] * n[1]];
        let swing = damped.by_rate * turn;
        out.force = [load * n[0], load * n[1]];
        // n nᵀ, t tᵀ and n tᵀ with t = (−n_z, n_r).
        out.by_motion = [
            damped.by_approach * nn[0] + bend * nn[2] - swing * nn[1],
            (damped.by_approach - bend) * nn[1] + swing * nn[0],
            (damped.by_approach - bend) * nn[1] - swing * nn[2],
            damped.by_approach * nn[2] + bend * nn[0] + swing * nn[1],
        ];
        out.by_rate = nn.map(|v| damped.by_rate * v);
        out.load = load;
        out.load_cos = load * n[0];
    }
    Some(out)
}

/// Load of a damped contact with its slopes.
pub(super) struct Damped {
    pub load: f64,
    pub by_approach: f64,
    pub by_rate: f64,
}

/// Elastic load plus damping along the line of contact; all zero where the sum would pull.
#[inline(always)]
pub(super) fn damped(damping: &ContactDamping, elastic: Loaded, approach: f64, rate: f64) -> Damped {
    let damped = match *damping {
        ContactDamping::Constant { coefficient, ramp } => {
            let (weight, slope) = ramp_at(approach, ramp);
            Damped {
                load: elastic.load + coefficient * weight * rate,
                by_approach: elastic.slope + coefficient * slope * rate,
                by_rate: coefficient * weight,
            }
        }
        ContactDamping::HuntCrossley { factor } => Damped {
            load: elastic.load * (1.0 + factor * rate),
            by_approach: elastic.slope * (1.0 + factor * rate),
            by_rate: elastic.load * factor,
        },
    };
    if damped.load > 0.0 { damped } else { Damped { load: 0.0, by_approach: 0.0, by_rate: 0.0 } }
}

/// Smooth start of the contact damping: 0 at δ = 0, 1 from `length` on, C¹; returns value and slope.
fn ramp_at(deflection: f64, length: f64) -> (f64, f64) {
    if deflection >= length {
        return (1.0, 0.0);
    }
    let x = (deflection / length).max(0.0);
    (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / length)
}
