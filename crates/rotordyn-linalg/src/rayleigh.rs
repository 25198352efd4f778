//! The Rayleigh functional of the quadratic eigenvalue problem.

use super::{Complex64, GroupDense, SparseMatrix};

/// Relative round-off of a sum of products, each with those of a row of the matrix.
const ROUND_OFF: f64 = 8.0 * f64::EPSILON;
/// Relative correction of a value beyond which its vector is in doubt.
const MAX_CORRECTION: f64 = 1e-6;
/// |Re λ|/|λ| above which round-off does not count: a dense part of C, whose products are expensive, is left alone there.
const DAMPED: f64 = 1e-6;

/// λ of a vector φ with φᴴ (λ² M + λ C + K) φ = 0, M symmetric.
///
/// As far as C and K conserve energy its errors are of second order in those of φ, and Re λ is that of the damping alone. Values
/// of the Arnoldi iteration have errors of ε (|λ|/σ)² and more: without damping their real parts have the sign of round-off.
///
/// Source: Tisseur and Meerbergen, The quadratic eigenvalue problem, SIAM Review 43, 2001, section 3.
pub(super) struct RayleighFunctional<'a> {
    matrices: [&'a SparseMatrix; 3],
    /// Further part of C.
    dense: Option<&'a GroupDense>,
    /// ½ (K − Kᵀ).
    circulatory: SparseMatrix,
}

impl<'a> RayleighFunctional<'a> {
    pub fn new(matrices: [&'a SparseMatrix; 3], dense: Option<&'a GroupDense>) -> Self {
        Self { matrices, dense, circulatory: matrices[2].skew_part() }
    }

    /// λ after one step of Newton's method.
    ///
    /// The real part of φᴴ K φ has the round-off of the stiffest elements, which are far stiffer than the mode: Im λ is corrected
    /// only by what is more than that. The imaginary part has none, since a symmetric K does not contribute.
    pub fn corrected(&self, value: Complex64, vector: &[Complex64]) -> Complex64 {
        let [m, c, k] = self.matrices;
        let [inertia, mut damping] = [m, c].map(|matrix| matrix.form(vector));
        if let Some(dense) = self.dense {
            if value.re.abs() > DAMPED * value.norm() {
                return value;
            }
            let image = dense.mul_complex(vector);
            damping += vector.iter().zip(&image).map(|(v, i)| v.conj() * i).sum::<Complex64>();
        }
        let stiffness = Complex64::new(k.form(vector).re, self.circulatory.form(vector).im);
        let rest = value * value * inertia + value * damping + stiffness;
        let slope = 2.0 * value * inertia + damping;
        let mut correction = rest / slope;
        if correction.norm().is_nan() || correction.norm() > MAX_CORRECTION * value.norm() {
            return value;
        }
        let terms = k.form_of_sizes(vector) + value.norm_sqr() * inertia.re;
        if correction.im.abs() < ROUND_OFF * terms / slope.norm() {
            correction.im = 0.0;
        }
        value - correction
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triplets;

    /// Two masses on springs, with gyroscopic coupling g, damping d and circulatory stiffness s.
    fn whirling(g: f64, d: f64, s: f64) -> [SparseMatrix; 3] {
        let [mut m, mut c, mut k] = [(); 3].map(|()| Triplets::new(2, 2));
        for i in 0..2 {
            let sign = if i == 0 { 1.0 } else { -1.0 };
            m.add(i, i, 2.0);
            c.add(i, i, d);
            c.add(i, 1 - i, sign * g);
            k.add(i, i, 800.0);
            k.add(i, 1 - i, sign * s);
        }
        [m, c, k].map(Triplets::build)
    }

    #[test]
    fn errors_of_the_value_are_gone_and_those_of_the_vector_count_squared() {
        // Circular whirl (1, −j): m λ² + (d − j g) λ + (k − j s) = 0.
        for [g, d, s] in [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 0.4, 0.0], [3.0, 0.4, 5.0]] {
            let matrices = whirling(g, d, s);
            let functional = RayleighFunctional::new(matrices.each_ref(), None);
            let half = Complex64::new(d, -g) / 4.0;
            let exact = -half + (half * half - Complex64::new(800.0, -s) / 2.0).sqrt();
            let exact = if exact.im > 0.0 { exact } else { -2.0 * half - exact };
            let error = |of_value: f64, of_vector: f64| {
                let vector = [Complex64::new(1.0 + of_vector, 0.0), Complex64::new(0.0, -1.0)];
                let value = exact * (1.0 + Complex64::new(of_value, of_value));
                (functional.corrected(value, &vector) - exact).norm() / exact.norm()
            };
            assert!(error(1e-8, 0.0) < 1e-14, "{g} {d} {s}: {:e}", error(1e-8, 0.0));
            assert!(error(0.0, 1e-4) < 1e-8, "{g} {d} {s}: {:e}", error(0.0, 1e-4));
            // Too far from the value of the vector: it stays.
            assert!(error(1e-3, 0.0) > 1e-4);
        }
    }

    #[test]
    fn forms_are_those_of_the_products() {
        let [_, c, k] = whirling(3.0, 0.4, 5.0);
        let x = [Complex64::new(0.3, -1.2), Complex64::new(-0.7, 0.4)];
        for matrix in [&c, &k] {
            let product: Complex64 = matrix.mul_complex(&x).iter().zip(&x).map(|(a, x)| x.conj() * a).sum();
            assert!((matrix.form(&x) - product).norm() < 1e-13 * product.norm());
        }
        let skew = k.skew_part();
        assert_eq!([skew.get(0, 1), skew.get(1, 0), skew.get(0, 0)], [5.0, -5.0, 0.0]);
        let sizes = 800.0 * (x[0].norm_sqr() + x[1].norm_sqr()) + 10.0 * x[0].norm() * x[1].norm();
        assert!((k.form_of_sizes(&x) - sizes).abs() < 1e-12 * sizes);
        // One entry of a pair alone.
        let mut single = Triplets::new(2, 2);
        single.add(0, 1, 3.0);
        let skew = single.build().skew_part();
        assert_eq!([skew.get(0, 1), skew.get(1, 0)], [1.5, -1.5]);
    }

    #[test]
    fn undamped_modes_have_no_real_part_whatever_the_stiffest_element() {
        let [m, c, _] = whirling(3.0, 0.0, 0.0);
        let mut k = Triplets::new(2, 2);
        for (i, j, v) in [(0, 0, 1e12 + 900.0), (0, 1, -1e12), (1, 0, -1e12), (1, 1, 1e12 + 700.0)] {
            k.add(i, j, v);
        }
        let k = k.build();
        let vector = [Complex64::new(1.0, 0.1), Complex64::new(1.0 + 1e-10, 0.1 - 3e-11)];
        let value =
            RayleighFunctional::new([&m, &c, &k], None).corrected(Complex64::new(1e-8, 20.0), &vector);
        assert!(value.re.abs() < 1e-16, "{value}");
    }
}
