//! Matrices of the reduced equations of motion, stored for the matrix-vector products of a time step.

use nalgebra::DMatrix;
use rotordyn_linalg::panel::Panel;

/// The system's matrices stored for the matrix-vector products of a time step.
#[derive(Clone, Debug)]
pub struct Panels {
    /// The non-zero ones of \[C K G K_s K_c\].
    pub(super) linear: Panel,
    pub(super) is_nonzero: [bool; 5],
    /// The non-zero ones of \[G K_s K_c\].
    pub(super) rotational: Panel,
    /// C alone, and K alone.
    pub damping: Panel,
    pub stiffness: Panel,
    /// The non-zero ones of \[K_s K_c\]: the left-hand terms that are neither elastic, damping nor gyroscopic.
    pub effective: Panel,
    /// W and Wᵀ.
    pub(super) to_interface: Panel,
    pub(super) from_interface: Panel,
}

impl Panels {
    /// Whether K_s is not zero.
    pub fn has_spin_up(&self) -> bool {
        self.is_nonzero[3]
    }

    /// Whether K_c is not zero.
    pub fn has_circulatory(&self) -> bool {
        self.is_nonzero[4]
    }

    /// Panels of the matrices C, K, G, K_s, K_c and W.
    pub fn new(
        [damping, stiffness, gyroscopic, spin_up, circulatory]: [&DMatrix<f64>; 5],
        interface_map: &DMatrix<f64>,
    ) -> Self {
        let all = [damping, stiffness, gyroscopic, spin_up, circulatory];
        // The stiffness is always kept: it defines the number of rows.
        let is_nonzero: [bool; 5] = std::array::from_fn(|k| k == 1 || all[k].amax() != 0.0);
        let nonzero = |range: std::ops::Range<usize>| {
            let kept: Vec<_> = range.filter(|k| is_nonzero[*k]).map(|k| all[k]).collect();
            Panel::new(&kept)
        };
        Self {
            linear: nonzero(0..5),
            is_nonzero,
            rotational: nonzero(2..5),
            damping: Panel::new(&[damping]),
            stiffness: Panel::new(&[stiffness]),
            effective: nonzero(3..5),
            to_interface: Panel::new(&[interface_map]),
            from_interface: Panel::new(&[&interface_map.transpose()]),
        }
    }
}
