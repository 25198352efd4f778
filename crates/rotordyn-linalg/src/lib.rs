//! Linear algebra: sparse and banded matrices; dense eigenvalue problems through faer and nalgebra.
//!
//! | module | contents |
//! |---|---|
//! | [`sparse`] | [`Triplets`] for assembly, [`SparseMatrix`] (compressed columns, CSC), [`SparseRow`] |
//! | [`band_lu`] | reverse Cuthill-McKee ordering, [`BandLayout`] and banded LU ([`BandLu`]), real and complex |
//! | [`band_lu_lanes`] | the same of several complex matrices at once ([`BandLuLanes`]) |
//! | [`complex_lanes`] | complex numbers of several matrices side by side |
//! | [`band_matrix`] | the banded [`BandMatrix`] in natural order |
//! | [`fft_length`](mod@fft_length) | efficient lengths for fast Fourier transforms |
//! | [`gmres`](mod@gmres) | preconditioned GMRES |
//! | [`hessenberg`] | eigenvalues and single eigenvectors of a Hessenberg matrix |
//! | [`inertia`] | number of negative eigenvalues of a banded Hermitian matrix |
//! | [`dot`](mod@dot), [`piecewise`](mod@piecewise) | scalar products; piecewise-linear tables |
//! | [`dense_lu`] | LU factors of a dense matrix ([`DenseLu`]) |
//! | [`eigen`] | dense eigenvalue problems, with workarounds for faer |
//! | [`group_dense`] | symmetric matrices dense within groups of unknowns ([`GroupDense`]) |
//! | `coupled_group`, `arnoldi` | the eigenvalue problem of one group, its Krylov space |
//! | `layout_cache` | band layouts computed once for matrices of one sparsity ([`LayoutCache`]) |
//! | [`krylov`] | lowest eigenvalues of λ² M + λ C + K (shift-and-invert Arnoldi) |
//! | [`panel`] | dense matrix-vector products of a time step |
//! | [`pchip`] | monotone cubic interpolation |
//! | `rayleigh` | eigenvalues corrected by the Rayleigh functional of their vectors |
//! | [`refinement`] | residuals in twice the precision, iterative refinement |
//! | [`small_dense`] | small dense linear systems |
//! | [`spline`] | interpolating cubic spline |
//! | `stop` | a request to end a computation ([`StopRequest`]) |
//! | `wide` | code compiled for the widest vectors of the processor ([`with_widest_vectors`]) |
//! | [`workspaces`] | memory that tasks take in turn |

mod arnoldi;
pub mod band_lu;
pub mod band_lu_lanes;
pub mod band_matrix;
pub mod complex_lanes;
mod coupled_group;
pub mod dense_lu;
pub mod dot;
pub mod eigen;
mod eigen_error;
pub mod fft_length;
pub mod gmres;
pub mod group_dense;
pub mod hessenberg;
pub mod inertia;
pub mod krylov;
mod layout_cache;
pub mod panel;
pub mod pchip;
pub mod piecewise;
mod rayleigh;
pub mod refinement;
pub mod small_dense;
pub mod sparse;
pub mod spline;
mod stop;
mod wide;
pub mod workspaces;

pub use band_lu::{BandLayout, BandLu, ZeroPivot};
pub use band_lu_lanes::BandLuLanes;
pub use band_matrix::BandMatrix;
pub use dense_lu::DenseLu;
pub use dot::dot;
pub use fft_length::fft_length;
pub use gmres::gmres;
pub use group_dense::GroupDense;
pub use layout_cache::LayoutCache;
pub use piecewise::{Outside, piecewise, piecewise_within};
pub use sparse::{SparseMatrix, SparseRow, Triplets};
pub use stop::StopRequest;
pub use wide::with_widest_vectors;

pub use num_complex::Complex;

/// Complex number of double precision.
pub type Complex64 = Complex<f64>;
