//! Stiffness matrix of angular acceleration (run-up, coast-down), K_s in Ω̇ K_s.

use crate::element::shaft_contribution::add12;
use crate::model::{Drive, Model};
use rotordyn_linalg::{SparseMatrix, Triplets};

/// Form of the angular acceleration terms.
///
/// **Derivation.** A section of polar inertia i_p that spins at Ω about its tilted tangent
/// t = (θ_y, −θ_x, 1) has the angular momentum i_p Ω t; its rate contains i_p Ω G_θ θ̇ + i_p Ω̇ G_θ θ,
/// G_θ = \[0, 1; −1, 0\] over (θ_x, θ_y). The accelerating torque is transmitted by the shaft: the part on
/// the left exerts T(z) t on the part on the right, T′ = −i_p Ω̇. In the balance of moments of a slice,
/// d(T t)/dz = T′ t + T t′, the terms T′ t and i_p Ω̇ t cancel and **only T dt/dz remains**.
///
/// **Energy-consistent form.** The same follows from two potentials, so that K_s is split as
/// K_s = ½ G + K_T, with ½ Ω (θ̇_x θ_y − θ_x θ̇_y) i_p as the (symmetric) Lagrangian of spin, whose Ω̇ part is ½ Ω̇ G,
/// and V = ½ ∫ T (θ_x θ_y′ − θ_x′ θ_y) dz, whose variation is T θ_y′ + ½ T′ θ_y within the shaft (and minus that
/// for the other angle): the halves cancel by T′ = −i_p Ω̇. K_T is integrated with the actual T(z) for
/// Ω̇ = 1: the polar inertia on the side of z away from the drive (negative on its left). The remaining term
/// at the drive station fixes the direction of the drive torque: half way between the fixed axis and the
/// tangent.
///
/// **ROSS 3.1.0** puts minus the u_x- and θ_y-rows of G (for a disc: +I_p at (θ_y, θ_x)) in place of K_s, with no
/// torque in the shaft. That is neither Ω̇ G (each inertia driven by a torque about the fixed axis) nor zero
/// (by a torque along its own tangent), and treats the two planes differently. For its Jeffcott run-up the
/// difference is 8e-5 of the peak; for a heavy overhung disc 3 %.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum SpinUpForm {
    /// ½ G + K_T; zero without a drive station (each inertia is then driven along its own tangent).
    #[default]
    EnergyConsistent,
    /// As in ROSS 3.1.0, for comparison.
    Ross,
    /// Neglected.
    None,
}

/// Station at which the drive torque acts on the shaft.
pub(super) fn drive_node(model: &Model) -> Option<usize> {
    match model.drive {
        Drive::Prescribed { node } => node,
        Drive::Torque { node, .. } => Some(node),
    }
}

/// K_s over all DOFs; `gyroscopic` is G over all DOFs.
pub(super) fn spin_up(model: &Model, form: SpinUpForm, gyroscopic: &SparseMatrix) -> SparseMatrix {
    let n = 6 * model.node_count();
    let mut k = Triplets::new(n, n);
    match form {
        SpinUpForm::None => {}
        SpinUpForm::Ross => {
            for (e, element) in model.shaft.iter().enumerate() {
                element.with_layers().for_each(|layer| add12(&mut k, e, &layer.spin_up_ross(), 1.0));
            }
            for disc in model.rotating_inertias() {
                k.add(6 * disc.node + 4, 6 * disc.node + 3, disc.polar_inertia);
            }
        }
        SpinUpForm::EnergyConsistent => {
            let Some(drive) = drive_node(model) else { return k.build() };
            k.add_sparse(0, 0, gyroscopic, 0.5);
            let inertia_at = |node: usize| -> f64 {
                model.rotating_inertias().filter(|d| d.node == node).map(|d| d.polar_inertia).sum()
            };
            let total: f64 = (0..model.node_z.len()).map(inertia_at).sum::<f64>()
                + model.shaft.iter().map(|e| e.polar_inertia_beyond(0.0)).sum::<f64>();
            // Inertia to the right of the current element's right node.
            let mut beyond = total;
            for (e, element) in model.shaft.iter().enumerate() {
                beyond -= inertia_at(e) + element.polar_inertia_beyond(0.0);
                let driven = if e < drive { beyond - total } else { beyond };
                let torque = |xi: f64| driven + element.polar_inertia_beyond(xi);
                add12(&mut k, e, &element.torque_energy_stiffness(torque), 1.0);
            }
        }
    }
    k.build()
}
