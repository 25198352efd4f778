//! 6x6 stiffness and damping matrices from named components.

use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Declared, Key, Quantities, any, keys, not_negative, quantities};
use crate::file::reader::Reader;
use rotordyn_units::{
    CROSS_DAMPING, CROSS_STIFFNESS, DAMPING, Dimension, NUMBER, STIFFNESS, TILT_DAMPING, TILT_STIFFNESS,
};

pub(super) type Matrix6 = [[f64; 6]; 6];

/// Names of the six DOFs in component keys: `k_xy`, `c_txty`.
pub(super) const DOFS: [&str; 6] = ["x", "y", "z", "tx", "ty", "tz"];

/// Number of component keys: both tilts, the diagonal by its short names, and 6 x 6 components.
const COMPONENTS: usize = 1 + 6 + 36;

#[rustfmt::skip]
const STIFFNESS_NAMES: [&str; COMPONENTS] = [
    "k_tilt",
    "k_x", "k_y", "k_z", "k_tilt_x", "k_tilt_y", "k_spin",
    "k_xx", "k_xy", "k_xz", "k_xtx", "k_xty", "k_xtz",
    "k_yx", "k_yy", "k_yz", "k_ytx", "k_yty", "k_ytz",
    "k_zx", "k_zy", "k_zz", "k_ztx", "k_zty", "k_ztz",
    "k_txx", "k_txy", "k_txz", "k_txtx", "k_txty", "k_txtz",
    "k_tyx", "k_tyy", "k_tyz", "k_tytx", "k_tyty", "k_tytz",
    "k_tzx", "k_tzy", "k_tzz", "k_tztx", "k_tzty", "k_tztz",
];
#[rustfmt::skip]
const DAMPING_NAMES: [&str; COMPONENTS] = [
    "c_tilt",
    "c_x", "c_y", "c_z", "c_tilt_x", "c_tilt_y", "c_spin",
    "c_xx", "c_xy", "c_xz", "c_xtx", "c_xty", "c_xtz",
    "c_yx", "c_yy", "c_yz", "c_ytx", "c_yty", "c_ytz",
    "c_zx", "c_zy", "c_zz", "c_ztx", "c_zty", "c_ztz",
    "c_txx", "c_txy", "c_txz", "c_txtx", "c_txty", "c_txtz",
    "c_tyx", "c_tyy", "c_tyz", "c_tytx", "c_tyty", "c_tytz",
    "c_tzx", "c_tzy", "c_tzz", "c_tztx", "c_tzty", "c_tztz",
];

const STIFFNESS_UNITS: [Dimension; 3] = [STIFFNESS, CROSS_STIFFNESS, TILT_STIFFNESS];
const DAMPING_UNITS: [Dimension; 3] = [DAMPING, CROSS_DAMPING, TILT_DAMPING];

const WHOLE: &str = "Whole matrix, rows and columns u_x u_y u_z theta_x theta_y theta_z.";
const IDENTITY: &str = "[[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], \
                        [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1]]";

keys! {
    /// Whole matrices.
    pub(super) static MATRICES: MatrixKeys {
        stiffness_si: Quantities = quantities(any(NUMBER), "6 x 6 in SI units", WHOLE).computed("from its components")
            .example(IDENTITY);
        damping_si: Quantities = quantities(any(NUMBER), "6 x 6 in SI units", WHOLE).computed("from its components")
            .example(IDENTITY);
    }
}

/// Components of stiffness or damping.
pub(super) struct Components {
    keys: [Key<Quantities>; COMPONENTS],
    /// Symmetric, without negative diagonal.
    passive: bool,
    whole: &'static Key<Quantities>,
}

/// Of bushings and housings.
pub(super) static PASSIVE_STIFFNESS: Components =
    components(STIFFNESS_NAMES, STIFFNESS_UNITS, true, &MATRICES.stiffness_si);
pub(super) static PASSIVE_DAMPING: Components =
    components(DAMPING_NAMES, DAMPING_UNITS, true, &MATRICES.damping_si);
/// Of linear bearings, with a value per speed.
pub(super) static BEARING_STIFFNESS: Components =
    components(STIFFNESS_NAMES, STIFFNESS_UNITS, false, &MATRICES.stiffness_si);
pub(super) static BEARING_DAMPING: Components =
    components(DAMPING_NAMES, DAMPING_UNITS, false, &MATRICES.damping_si);

type KeyList = [&'static dyn Declared; COMPONENTS];
pub(super) static PASSIVE_STIFFNESS_LIST: KeyList = list(&PASSIVE_STIFFNESS);
pub(super) static PASSIVE_DAMPING_LIST: KeyList = list(&PASSIVE_DAMPING);
pub(super) static BEARING_STIFFNESS_LIST: KeyList = list(&BEARING_STIFFNESS);
pub(super) static BEARING_DAMPING_LIST: KeyList = list(&BEARING_DAMPING);

/// `dimensions` by the number of rotations (0, 1, 2).
const fn components(
    names: [&'static str; COMPONENTS],
    dimensions: [Dimension; 3],
    passive: bool,
    whole: &'static Key<Quantities>,
) -> Components {
    let count = if passive { "one" } else { "one, or one for each speed" };
    let mut keys = [quantities(any(NUMBER), count, "").computed("0"); COMPONENTS];
    let mut k = 0;
    while k < COMPONENTS {
        let (i, j, meaning) = match k {
            0 => (3, 3, "Both tilts, about x and about y."),
            1..7 => (k - 1, k - 1, "Translation along an axis, tilt about it, or spin about z."),
            _ => ((k - 7) / 6, (k - 7) % 6, "Force or moment of the first DOF per motion of the second."),
        };
        let dimension = dimensions[(i > 2) as usize + (j > 2) as usize];
        let each = if passive && i == j { not_negative(dimension) } else { any(dimension) };
        keys[k] = quantities(each, count, meaning).computed("0").named(names[k]);
        k += 1;
    }
    Components { keys, passive, whole }
}

const fn list(components: &'static Components) -> KeyList {
    let mut list: KeyList = [&components.keys[0]; COMPONENTS];
    let mut k = 1;
    while k < COMPONENTS {
        list[k] = &components.keys[k];
        k += 1;
    }
    list
}

impl Components {
    /// Both tilts.
    pub fn tilts(&self) -> &Key<Quantities> {
        &self.keys[0]
    }

    /// A component of the diagonal, by its short name.
    pub fn diagonal(&self, i: usize) -> &Key<Quantities> {
        &self.keys[1 + i]
    }

    pub fn component(&self, i: usize, j: usize) -> &Key<Quantities> {
        &self.keys[7 + 6 * i + j]
    }

    /// One matrix.
    pub fn matrix(&self, r: &Reader) -> Matrix6 {
        self.matrix_of(r, self.passive)
    }

    /// One matrix, symmetric if it is that of something passive.
    pub fn matrix_of(&self, r: &Reader, passive: bool) -> Matrix6 {
        let matrices = self.components(r, 1);
        if passive && r.has_no_errors() {
            self.check_symmetry(r, &matrices);
        }
        let [matrix] = matrices.try_into().unwrap_or([[[0.0; 6]; 6]]);
        matrix
    }

    /// One matrix for each of `rows` speeds; a component has one value for all speeds or one per speed.
    pub fn table(&self, r: &Reader, rows: usize) -> Vec<Matrix6> {
        let matrices = self.components(r, rows);
        if self.passive && r.has_no_errors() {
            self.check_symmetry(r, &matrices);
        }
        matrices
    }

    fn components(&self, r: &Reader, rows: usize) -> Vec<Matrix6> {
        let mut matrices = vec![[[0.0; 6]; 6]; rows];
        if let Some(values) = r.list(self.whole) {
            if values.len() == 36 {
                for matrix in &mut matrices {
                    for (k, value) in values.iter().enumerate() {
                        matrix[k / 6][k % 6] = *value;
                    }
                }
            } else {
                let message = format!("{} has {} numbers instead of 6 x 6", r.name(self.whole), values.len());
                r.log
                    .error(Problem::new(Kind::WrongType, &r.span_of(self.whole), message).hint(
                        "rows and columns u_x u_y u_z theta_x theta_y theta_z, SI units, nested lists",
                    ));
            }
        }
        let mut put = |key: &Key<Quantities>, places: &[(usize, usize)]| {
            let Some(values) = r.list(key) else { return };
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
        put(self.tilts(), &[(3, 3), (4, 4)]);
        for i in 0..6 {
            for j in 0..6 {
                let key = self.component(i, j);
                if i == j {
                    let short = self.diagonal(i);
                    // a setting of the command line is the only one of both that holds
                    if r.one_of(&[short, key]).is_some_and(|given| given.is(short)) {
                        put(short, &[(i, i)]);
                        continue;
                    }
                }
                put(key, &[(i, j)]);
            }
        }
        matrices
    }

    fn check_symmetry(&self, r: &Reader, matrices: &[Matrix6]) {
        for (i, j) in (0..6).flat_map(|i| (0..i).map(move |j| (i, j))) {
            if matrices.iter().any(|m| m[i][j] != m[j][i]) {
                let (one, other) = (self.component(i, j), self.component(j, i));
                let given = if r.has(one) { one } else { other };
                let message = format!(
                    "{}: {} and {} differ; an asymmetric matrix is not passive (it generates energy)",
                    r.path,
                    one.name(),
                    other.name()
                );
                let problem = Problem::new(Kind::Conflict, &r.span_of(given), message);
                r.log.error(problem.hint("give both with the same value; a linear bearing, or a bushing with unsymmetric = true, takes such a matrix"));
            }
        }
    }
}
