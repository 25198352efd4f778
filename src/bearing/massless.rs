//! Massless ball: both contacts carry the same load along the line joining the groove centres.

use super::ball_sum::PlaneForce;
use super::row::PlaneMotion;
use crate::contact::{ContactDamping, ContactLoad, SpeedContacts};

/// Plane force of a massless ball.
///
/// s is the inner groove centre relative to the outer one, n = s/|s|, δ = |s| − A + w_i + w_o its approach
/// with deviations; p = Q n with Q = max(0, Q_e(δ) + damping) and δ̇ = n·ṡ + ẇ. Along t ⊥ n the load rotates
/// with the contact line (geometric stiffness): ∂p/∂s = Q′ n nᵀ + (Q/|s|) t tᵀ + (∂Q/∂δ̇) n (∂δ̇/∂s)ᵀ,
/// ∂δ̇/∂s = t (t·ṡ)/|s|.
///
/// `None` when unloaded. A contact with tensile damped load is set to zero: its elastic energy counts as
/// dissipated.
#[inline(always)]
pub(super) fn ball_force(
    series: impl Fn(f64) -> ContactLoad,
    contacts: &SpeedContacts,
    damping: &ContactDamping,
    centre_distance: f64,
    motion: &PlaneMotion,
) -> Option<PlaneForce> {
    let [radial, axial] = motion.s;
    let distance = (radial * radial + axial * axial).sqrt();
    let approach = distance - centre_distance + motion.deviation.total();
    let elastic = series(approach);
    if elastic.load <= 0.0 {
        return None;
    }
    let inverse = 1.0 / distance;
    let n = [radial * inverse, axial * inverse];
    let [passing, undamped] = [motion.deviation.rate, motion.deviation.undamped_rate].map(|[i, o]| i + o);
    let rate = n[0] * motion.rate[0] + n[1] * motion.rate[1] + passing;
    let damped = damping.apply(contacts, &elastic, approach, rate);
    let load = damped.load;
    let mut out = PlaneForce {
        energy: elastic.energy,
        dissipated: (load - elastic.load) * rate,
        power: load * passing + elastic.load * undamped,
        ..PlaneForce::default()
    };
    if load > 0.0 {
        let turn = (n[0] * motion.rate[1] - n[1] * motion.rate[0]) * inverse;
        let bend = load * inverse;
        let nn = [n[0] * n[0], n[0] * n[1], n[1] * n[1]];
        let damping_rotation = damped.by_rate * turn;
        out.force = [load * n[0], load * n[1]];
        // n nᵀ, t tᵀ and n tᵀ with t = (−n_z, n_r).
        out.by_motion = [
            damped.by_approach * nn[0] + bend * nn[2] - damping_rotation * nn[1],
            (damped.by_approach - bend) * nn[1] + damping_rotation * nn[0],
            (damped.by_approach - bend) * nn[1] - damping_rotation * nn[2],
            damped.by_approach * nn[2] + bend * nn[0] + damping_rotation * nn[1],
        ];
        out.by_rate = nn.map(|v| damped.by_rate * v);
        out.load = load;
        out.load_cos = load * n[0];
    }
    Some(out)
}
