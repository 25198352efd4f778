//! 6x6 stiffness and damping matrices from named components.

use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative};
use rotordyn_units::{
    CROSS_DAMPING, CROSS_STIFFNESS, DAMPING, Dimension, NUMBER, STIFFNESS, TILT_DAMPING, TILT_STIFFNESS,
};

pub(super) type Matrix6 = [[f64; 6]; 6];

/// Names of the six DOFs in component keys: `k_xy`, `c_txty`.
pub(super) const DOFS: [&str; 6] = ["x", "y", "z", "tx", "ty", "tz"];
/// Short names of the diagonal: `k_x`, `k_tilt_x`, `k_spin`.
const DIAGONAL: [&str; 6] = ["x", "y", "z", "tilt_x", "tilt_y", "spin"];

/// Stiffness or damping.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum MatrixKind {
    Stiffness,
    Damping,
}

impl MatrixKind {
    /// First letter of the component keys, whole-matrix key, dimensions by the number of rotations (0, 1, 2).
    fn keys_and_dimensions(self) -> (&'static str, &'static str, [Dimension; 3]) {
        match self {
            Self::Stiffness => ("k", "stiffness_si", [STIFFNESS, CROSS_STIFFNESS, TILT_STIFFNESS]),
            Self::Damping => ("c", "damping_si", [DAMPING, CROSS_DAMPING, TILT_DAMPING]),
        }
    }
}

/// One matrix from its components; `passive` requires symmetry and a non-negative diagonal.
pub(super) fn matrix(r: &Reader, family: MatrixKind, passive: bool) -> Matrix6 {
    let [matrix] = table(r, family, 1, passive).try_into().unwrap_or([[[0.0; 6]; 6]]);
    matrix
}

/// One matrix for each of `rows` speeds; a component has one value for all speeds or one per speed.
pub(super) fn table(r: &Reader, family: MatrixKind, rows: usize, passive: bool) -> Vec<Matrix6> {
    let (letter, matrix_key, dimensions) = family.keys_and_dimensions();
    let mut matrices = vec![[[0.0; 6]; 6]; rows];
    if let Some(values) = r.list(matrix_key, any(NUMBER)) {
        if values.len() == 36 {
            for matrix in &mut matrices {
                for (k, value) in values.iter().enumerate() {
                    matrix[k / 6][k % 6] = *value;
                }
            }
        } else {
            let problem = format!("{} has {} numbers instead of 6 x 6", r.name(matrix_key), values.len());
            r.log.error(
                Problem::new(Kind::WrongType, &r.span_of(matrix_key), problem)
                    .hint("rows and columns u_x u_y u_z theta_x theta_y theta_z, SI units, nested lists"),
            );
        }
    }
    let mut put = |key: &str, places: &[(usize, usize)]| {
        let (i, j) = places[0];
        let dimension = dimensions[usize::from(i > 2) + usize::from(j > 2)];
        let spec = if passive && i == j { not_negative(dimension) } else { any(dimension) };
        let Some(values) = r.list(key, spec) else { return };
        if values.len() != 1 && values.len() != rows {
            let message = format!("{} has {} values for {rows} speeds", r.name(key), values.len());
            r.error(Kind::WrongType, key, message);
            return;
        }
        for (row, matrix) in matrices.iter_mut().enumerate() {
            for &(i, j) in places {
                matrix[i][j] = values[row % values.len()];
            }
        }
    };
    put(&format!("{letter}_tilt"), &[(3, 3), (4, 4)]);
    for (i, row) in DOFS.iter().enumerate() {
        for (j, column) in DOFS.iter().enumerate() {
            let key = format!("{letter}_{row}{column}");
            if i == j {
                let short = format!("{letter}_{}", DIAGONAL[i]);
                r.one_of(&[&short, &key]);
                put(&short, &[(i, i)]);
            }
            put(&key, &[(i, j)]);
        }
    }
    if passive && r.has_no_errors() {
        for (i, j) in (0..6).flat_map(|i| (0..i).map(move |j| (i, j))) {
            if matrices.iter().any(|m| m[i][j] != m[j][i]) {
                let (one, other) =
                    (format!("{letter}_{}{}", DOFS[i], DOFS[j]), format!("{letter}_{}{}", DOFS[j], DOFS[i]));
                let given = if r.has(&one) { &one } else { &other };
                let message = format!(
                    "{}: {one} and {other} differ; an asymmetric matrix is not passive (it generates energy)",
                    r.path
                );
                let problem = Problem::new(Kind::Conflict, &r.span_of(given), message);
                r.log.error(problem.hint("give both with the same value, or use a linear bearing"));
            }
        }
    }
    matrices
}
