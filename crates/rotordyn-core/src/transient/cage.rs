//! Cage kinematics: every cage rolls with the shaft without slip, also at varying speed, or turns as given.

use super::system::{State, System};
use crate::model::Spin;
use rotordyn_bearing::Rotation;
use rotordyn_linalg::{Outside, piecewise};

/// Cage and shaft angles at the end of a step, written to `out`.
///
/// ψ₁ = ψ₀ + r (θ₁ − θ₀), ψ̇ = r Ω with r = ½ (1 − D_w cos ᾱ / D_pw) at the load-weighted mean contact angle
/// of the step's start: rolling without slip. cos ᾱ varies by about 1e-4 over a ball passage, so that the
/// error of a lag of one step in r is negligible, while the shaft's own angle is exact.
pub fn advance(system: &System, state: &State, spin: &Spin, out: &mut [Rotation]) {
    let turned = spin.angle - state.spin.angle;
    for (((interface, before), reaction), after) in
        system.interfaces.iter().zip(&state.rotations).zip(&state.reactions).zip(out)
    {
        let ratio = interface.element.cage_ratio(reaction.mean_cos);
        let (cage_angle, cage_speed) = match &interface.cage_angles {
            None => (before.cage_angle + ratio * turned, ratio * spin.speed),
            Some(given) => {
                let [_, angle] = piecewise(given, spin.angle, Outside::Constant);
                let ratio = if turned == 0.0 { ratio } else { (angle - before.cage_angle) / turned };
                (angle, ratio * spin.speed)
            }
        };
        *after = Rotation {
            cage_angle,
            cage_speed: Some(cage_speed),
            shaft_angle: spin.angle,
            shaft_speed: spin.speed,
        };
    }
}
