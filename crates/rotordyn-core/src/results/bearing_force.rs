//! Dynamic bearing forces of the unbalance response.

use crate::analysis::unbalance::Orbit;
use crate::document::{Array, Document, Rows, in_hdf5, named};
use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};

/// Force of a bearing on the shaft over speed, F(t) = Re(F e^{jΩt}), and at rest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingForce {
    pub name: String,
    /// Complex F_x and F_y as Re and Im \[N\].
    pub x: Vec<[f64; 2]>,
    pub y: Vec<[f64; 2]>,
    /// Static force F_x, F_y at standstill \[N\].
    pub at_rest: [f64; 2],
}

impl BearingForce {
    /// Largest dynamic force during a revolution \[N\] at speed number k: the semi-major axis of the ellipse of (F_x, F_y).
    pub fn amplitude(&self, k: usize) -> f64 {
        let [x, y] = [self.x[k], self.y[k]].map(|[re, im]| Complex64::new(re, im));
        Orbit::new(x, y).major
    }

    /// Amplitudes |F_x| and |F_y| \[N\] at speed number k.
    pub fn components(&self, k: usize) -> [f64; 2] {
        [self.x[k], self.y[k]].map(|[re, im]| re.hypot(im))
    }

    /// Index of the speed with the largest finite dynamic force.
    pub fn largest(&self) -> Option<usize> {
        let finite = (0..self.x.len()).filter(|&k| self.amplitude(k).is_finite());
        finite.max_by(|&a, &b| self.amplitude(a).total_cmp(&self.amplitude(b)))
    }

    /// What JSON has of them, one row a bearing.
    pub fn columns(found: &[Self], count: usize) -> Rows<'static, '_, Self> {
        let part = |pairs: &[[f64; 2]], k: usize| -> Vec<f64> { pairs.iter().map(|p| p[k]).collect() };
        Rows::of(found)
            .text("bearing", |b| &b.name)
            .numbers("x_re", "N", &[count], |b| part(&b.x, 0))
            .numbers("x_im", "N", &[count], |b| part(&b.x, 1))
            .numbers("y_re", "N", &[count], |b| part(&b.y, 0))
            .numbers("y_im", "N", &[count], |b| part(&b.y, 1))
            .numbers(named("at_rest_n", "at_rest"), "N", &[2], |b| b.at_rest)
    }

    /// What HDF5 has of them over the axis `rpm`.
    pub fn arrays(found: &[Self]) -> Document<'static> {
        let complex = |pairs: &[[f64; 2]]| {
            let values: Vec<_> = pairs.iter().map(|&[re, im]| Complex64::new(re, im)).collect();
            Array::complex(&[pairs.len()], "N", values).over(0, "rpm")
        };
        found.iter().fold(Document::new(), |out, Self { name, x, y, at_rest }| {
            out.array(in_hdf5(format!("bearing_forces/{name}/x")), complex(x))
                .array(in_hdf5(format!("bearing_forces/{name}/y")), complex(y))
                .numbers(in_hdf5(format!("bearing_forces/{name}/at_rest")), "N", at_rest.to_vec())
        })
    }
}
