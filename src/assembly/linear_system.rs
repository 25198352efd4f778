//! Linearised equations of motion at one speed, bearings included.

use super::Assembly;
use crate::bearing::SiteTangent;
use crate::error::{Error, PhysicsError};
use crate::linalg::{Outside, SparseMatrix, Triplets, eigen, piecewise};

/// M q̈ + D q̇ + S q = f at speed Ω, with D = C + Ω G and S = K + Ω K_c, bearings and belts included.
#[derive(Clone, Debug)]
pub struct LinearSystem {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// M.
    pub mass: SparseMatrix,
    /// D = C + Ω G.
    pub damping: SparseMatrix,
    /// S = K + Ω K_c.
    pub stiffness: SparseMatrix,
}

impl LinearSystem {
    /// Linearised equations with one tangent per bearing site, in order.
    ///
    /// # Errors
    /// Undamped modes for modal damping did not converge.
    pub fn new(assembly: &Assembly, tangents: &[SiteTangent], speed: f64) -> Result<Self, Error> {
        let n = assembly.dofs.len();
        let (mut k, mut c) = (Triplets::new(n, n), Triplets::new(n, n));
        for (site, tangent) in assembly.sites.iter().zip(tangents) {
            k.add_between_rows(&site.rows, &tangent.stiffness);
            c.add_between_rows(&site.rows, &tangent.damping);
        }
        let standstill = SparseMatrix::sum(&[
            (1.0, &assembly.stiffness),
            (1.0, &assembly.belt_stiffness),
            (1.0, &k.build()),
        ]);
        let modal = modal_damping(assembly, &standstill)?;
        Ok(Self {
            speed,
            mass: assembly.mass.clone(),
            damping: SparseMatrix::sum(&[
                (1.0, &assembly.damping),
                (1.0, &c.build()),
                (1.0, &modal),
                (speed, &assembly.gyroscopic),
            ]),
            stiffness: SparseMatrix::sum(&[(1.0, &standstill), (speed, &assembly.circulatory)]),
        })
    }
}

/// Modal damping matrix C = M Φ diag(2 ζ ω) Φᵀ M from the undamped modes at standstill, Φᵀ M Φ = 1.
pub fn modal_damping(assembly: &Assembly, stiffness: &SparseMatrix) -> Result<SparseMatrix, Error> {
    let n = assembly.dofs.len();
    if assembly.modal_damping.is_empty() {
        return Ok(SparseMatrix::zeros(n, n));
    }
    let mass = assembly.mass.to_dense();
    let (squares, mut shapes) = eigen::undamped(&stiffness.to_dense(), &mass, 1.0)
        .map_err(|e| PhysicsError::Eigen { speed_rpm: 0.0, reason: e.to_string() })?;
    let momentum = &mass * &shapes;
    for (mut column, square) in shapes.column_iter_mut().zip(&squares) {
        let omega = square.max(0.0).sqrt();
        let hz = omega / std::f64::consts::TAU;
        let [_, ratio] = piecewise(&assembly.modal_damping, hz, Outside::Constant);
        column *= 2.0 * omega * ratio;
    }
    let mut dense = &momentum * (mass * shapes).transpose();
    // Entries between uncoupled unknowns are round-off only: set to zero to keep sparsity.
    let floor = 1e-12 * dense.amax();
    dense.apply(|v| {
        if v.abs() < floor {
            *v = 0.0;
        }
    });
    Ok(SparseMatrix::from_dense(&dense))
}
