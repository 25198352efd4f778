//! Force law of local defects as published (Atef 2022): ±K_d |H|^{3/2} added to the load of an undisturbed
//! ball.

use super::plane_motion::PlaneMotion;
use super::sum::PlaneForce;

/// Force of a massless ball plus the defect force, along the same contact line n.
///
/// p = (Q + F_d) n. As published, F_d acts on every ball at all times, so that a ball may pull; with
/// `loaded_only` it acts on loaded balls only and cannot make the load negative. F_d is not conservative: its
/// work −F_d n·ṡ on the moving ring counts as input power.
///
/// Source: Atef 2022 eq. 11 and 12, without the centrifugal force, whose sum over equally spaced balls is zero.
#[inline]
pub(super) fn with_defect_force(
    ball: Option<PlaneForce>,
    loaded_only: bool,
    motion: &PlaneMotion,
) -> Option<PlaneForce> {
    let defect_force = motion.deviation.defect_force;
    if defect_force == 0.0 || loaded_only && ball.is_none() {
        return ball;
    }
    let mut out = ball.unwrap_or_default();
    let [radial, axial] = motion.s;
    let distance = radial.hypot(axial);
    let n = [radial / distance, axial / distance];
    let closing = n[0] * motion.rate[0] + n[1] * motion.rate[1];
    if loaded_only && out.load + defect_force <= 0.0 {
        out.power += out.load * closing;
        return Some(PlaneForce {
            energy: out.energy,
            dissipated: out.dissipated,
            power: out.power,
            ..PlaneForce::default()
        });
    }
    out.power -= defect_force * closing;
    out.force[0] += defect_force * n[0];
    out.force[1] += defect_force * n[1];
    // Geometric stiffness along t = (−n_z, n_r): the force direction rotates with the contact line.
    let bend = defect_force / distance;
    let turn = [n[1] * n[1], -n[0] * n[1], -n[0] * n[1], n[0] * n[0]];
    for (value, t) in out.by_motion.iter_mut().zip(turn) {
        *value += bend * t;
    }
    out.load += defect_force;
    out.load_cos += defect_force * n[0];
    Some(out)
}
