//! Linearised equations of motion at one speed, bearings included.

use super::{Assembly, ModalDamping, PhysicsError};
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::{Complex64, SparseMatrix, Triplets};
use std::sync::Arc;

/// M q̈ + D q̇ + S q = f at speed Ω, with D = C + Ω G and S = K + Ω K_c, bearings and belts included.
#[derive(Clone, Debug)]
pub struct LinearSystem {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// M.
    pub mass: SparseMatrix,
    /// D without modal damping.
    pub damping: SparseMatrix,
    /// Modal damping, the rest of D; `None` without any.
    pub modal: Option<Arc<ModalDamping>>,
    /// S = K + Ω K_c.
    pub stiffness: SparseMatrix,
}

impl LinearSystem {
    /// Linearised equations with one tangent per bearing site, in order.
    ///
    /// Modal damping is that of [`Assembly::set_standstill`]; without it, that of these `tangents`.
    ///
    /// # Errors
    /// Undamped modes for modal damping did not converge.
    pub fn new(assembly: &Assembly, tangents: &[SiteTangent], speed: f64) -> Result<Self, PhysicsError> {
        let n = assembly.dofs.len();
        let (mut k, mut c) = (Triplets::new(n, n), Triplets::new(n, n));
        for (site, tangent) in assembly.sites.iter().zip(tangents) {
            k.add_between_rows(&site.rows, &tangent.stiffness);
            c.add_between_rows(&site.rows, &tangent.damping);
        }
        let modal = match &assembly.modal {
            Some(modal) => Some(modal.clone()),
            None => ModalDamping::new(assembly, tangents)?.map(Arc::new),
        };
        Ok(Self {
            speed,
            mass: assembly.mass.clone(),
            damping: SparseMatrix::sum(&[
                (1.0, &assembly.damping),
                (1.0, &c.build()),
                (speed, &assembly.gyroscopic),
            ]),
            modal,
            stiffness: SparseMatrix::sum(&[
                (1.0, &assembly.stiffness),
                (1.0, &assembly.belt_stiffness),
                (1.0, &k.build()),
                (speed, &assembly.circulatory),
            ]),
        })
    }

    /// D with modal damping, dense where there is any.
    pub fn full_damping(&self) -> SparseMatrix {
        match &self.modal {
            Some(modal) => SparseMatrix::sum(&[(1.0, &self.damping), (1.0, &modal.matrix.to_sparse())]),
            None => self.damping.clone(),
        }
    }

    /// D v, modal damping included.
    pub fn damp(&self, v: &[Complex64]) -> Vec<Complex64> {
        let mut out = self.damping.mul_complex(v);
        if let Some(modal) = &self.modal {
            out.iter_mut().zip(modal.matrix.mul_complex(v)).for_each(|(o, m)| *o += m);
        }
        out
    }

    /// Matrices with the couplings between unknowns, those of modal damping included.
    pub fn patterns(&self) -> Vec<&SparseMatrix> {
        let modal = self.modal.as_ref().map(|modal| &modal.stiffness);
        [Some(&self.mass), Some(&self.damping), Some(&self.stiffness), modal].into_iter().flatten().collect()
    }
}
