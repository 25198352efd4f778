//! Linearised equations of motion at one speed, bearings included.

use super::{Assembly, ModalDamping, PhysicsError};
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::{BandLayout, Complex64, SparseMatrix, Triplets};
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
    /// Band layout of the matrices, modal damping included.
    pub layout: Arc<BandLayout>,
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
        let damping =
            SparseMatrix::sum(&[(1.0, &assembly.damping), (1.0, &c.build()), (speed, &assembly.gyroscopic)]);
        let stiffness = SparseMatrix::sum(&[
            (1.0, &assembly.stiffness),
            (1.0, &assembly.belt_stiffness),
            (1.0, &k.build()),
            (speed, &assembly.circulatory),
        ]);
        Ok(Self::with_matrices(assembly, speed, [damping, stiffness], modal))
    }

    /// Equations with these matrices D (without modal damping) and S.
    pub fn with_matrices(
        assembly: &Assembly,
        speed: f64,
        [damping, stiffness]: [SparseMatrix; 2],
        modal: Option<Arc<ModalDamping>>,
    ) -> Self {
        let mass = assembly.mass.clone();
        let of_modal = modal.as_ref().map(|modal| &modal.stiffness);
        let patterns: Vec<_> = [&mass, &damping, &stiffness].into_iter().chain(of_modal).collect();
        let layout = assembly.layouts.layout(&patterns);
        Self { speed, mass, damping, modal, stiffness, layout }
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
}
