//! Massless ball: both contacts carry the same load along the line joining the groove centres.

use super::derivatives::AxialCurvature;
use super::plane_motion::PlaneMotion;
use super::sum::PlaneForce;
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

/// Curvature of a massless ball's elastic axial force, and the rate of its first derivatives along the motion.
///
/// With κ = Q′ n nᵀ + (Q/l) t tᵀ, l = |s|, a motion ṡ and a deviation's rate ẇ change κ by
/// Q″ (n·ṡ + ẇ) n nᵀ + \[Q′ (n·ṡ + ẇ) − (Q/l) n·ṡ\]/l · t tᵀ + (Q′ − Q/l) (t·ṡ)/l · (n tᵀ + t nᵀ).
pub(super) fn axial_curvature(
    contacts: &SpeedContacts,
    centre_distance: f64,
    motion: &PlaneMotion,
) -> AxialCurvature {
    let length = motion.s[0].hypot(motion.s[1]);
    let approach = length - centre_distance + motion.deviation.total();
    let ContactLoad { load, slope, .. } = contacts.series(approach);
    if load <= 0.0 {
        return AxialCurvature::default();
    }
    let step = 1e-4 * load / slope;
    let by_slope =
        (contacts.series(approach + step).slope - contacts.series(approach - step).slope) / (2.0 * step);
    let [nr, nz] = motion.s.map(|s| s / length);
    let bend = load / length;
    // Axial row of the change of κ.
    let change = |s: [f64; 2], deviation: f64| -> [f64; 2] {
        let (along, across) = (nr * s[0] + nz * s[1], nr * s[1] - nz * s[0]);
        let closing = along + deviation;
        let stretch = by_slope * closing;
        let swing = (slope * closing - bend * along) / length;
        let turn = (slope - bend) * across / length;
        [
            (stretch - swing) * nz * nr + turn * (nr * nr - nz * nz),
            stretch * nz * nz + swing * nr * nr + 2.0 * turn * nz * nr,
        ]
    };
    let ([rr, rz], [_, zz]) = (change([1.0, 0.0], 0.0), change([0.0, 1.0], 0.0));
    AxialCurvature {
        by_position: [rr, rz, zz],
        rate: change(motion.rate, motion.deviation.full_rate().iter().sum()),
    }
}
