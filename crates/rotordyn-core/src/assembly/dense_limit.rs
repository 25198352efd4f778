//! Limit of dense matrices, checked before they are made.

use super::PhysicsError;
use crate::model::ShaftExtent;

/// Memory that dense matrices may take \[bytes\]: a block of 6000 unknowns for modal damping, 5500 for a reduced model.
const LIMIT: f64 = 2e9;

/// Refuses a computation with dense matrices that would take too much memory.
///
/// `purpose`: what needs them; `unknowns`: their order n; `matrices`: how many are in memory together, 8 n² bytes each.
///
/// # Errors
/// [`PhysicsError::TooLarge`] with the part of the shaft that has most of the unknowns.
pub fn check_dense(
    purpose: &str,
    unknowns: usize,
    matrices: usize,
    shaft: &ShaftExtent,
) -> Result<(), PhysicsError> {
    let bytes = 8.0 * matrices as f64 * (unknowns as f64).powi(2);
    if bytes <= LIMIT {
        return Ok(());
    }
    let [gigabytes, limit] = [bytes, LIMIT].map(|bytes| 1e-9 * bytes);
    Err(PhysicsError::TooLarge {
        purpose: purpose.into(),
        unknowns,
        gigabytes,
        limit,
        shaft: shaft.to_string(),
    })
}
