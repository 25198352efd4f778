//! Why eigenvalues cannot be had.

/// Why an eigenvalue computation failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EigenError {
    #[error("the iteration did not converge")]
    NoConvergence,
    #[error("a matrix of the eigenvalue problem is not positive definite")]
    NotDefinite,
    #[error("a matrix contains a value that is not finite")]
    NotFinite,
    #[error("the shifted matrix is singular")]
    SingularShift,
}
