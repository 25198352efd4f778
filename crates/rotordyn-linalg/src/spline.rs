//! Interpolating cubic spline.

/// Cubic spline through points with continuous second derivative. Outside the points it goes on linearly.
///
/// Source: de Boor, A Practical Guide to Splines (1978), ch. IV.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    x: Vec<f64>,
    y: Vec<f64>,
    /// Second derivative at every point.
    curvature: Vec<f64>,
}

/// What determines the second derivative at the two ends.
#[derive(Clone, Copy, PartialEq)]
enum Ends {
    /// The third derivative does not jump at the first and the last inner point.
    NotAKnot,
    /// It is zero.
    Natural,
}

impl Spline {
    /// Not-a-knot spline through points of strictly increasing `x`, which reproduces a cubic exactly.
    ///
    /// `None` when the lengths differ, there are fewer than four points, or `x` does not increase.
    pub fn new(x: &[f64], y: &[f64]) -> Option<Self> {
        Self::with_ends(x, y, 4, Ends::NotAKnot)
    }

    /// Natural spline through points of strictly increasing `x`: second derivative 0 at both ends.
    ///
    /// `None` when the lengths differ, there are fewer than two points, or `x` does not increase.
    pub fn natural(x: &[f64], y: &[f64]) -> Option<Self> {
        Self::with_ends(x, y, 2, Ends::Natural)
    }

    fn with_ends(x: &[f64], y: &[f64], least: usize, ends: Ends) -> Option<Self> {
        let n = x.len();
        if n < least || y.len() != n || !x.windows(2).all(|w| w[0] < w[1]) {
            return None;
        }
        let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
        let secant: Vec<f64> = y.windows(2).zip(&h).map(|(w, h)| (w[1] - w[0]) / h).collect();
        // h_{k−1} m_{k−1} + 2 (h_{k−1} + h_k) m_k + h_k m_{k+1} = 6 (s_k − s_{k−1}) for the inner points.
        let inner = n - 2;
        let (mut lower, mut diagonal, mut upper, mut right) =
            (vec![0.0; inner], vec![0.0; inner], vec![0.0; inner], vec![0.0; inner]);
        for i in 0..inner {
            let (a, b) = (h[i], h[i + 1]);
            (lower[i], diagonal[i], upper[i]) = (a, 2.0 * (a + b), b);
            right[i] = 6.0 * (secant[i + 1] - secant[i]);
        }
        if ends == Ends::NotAKnot {
            // m_0 = m_1 + (m_1 − m_2) h_0/h_1 and so at the end.
            let (a, b) = (h[0], h[1]);
            diagonal[0] += a * (1.0 + a / b);
            upper[0] -= a * a / b;
            let (a, b) = (h[n - 2], h[n - 3]);
            diagonal[inner - 1] += a * (1.0 + a / b);
            lower[inner - 1] -= a * a / b;
        }
        // Thomas; diagonally dominant but for the two ends, whose pivots stay positive.
        for i in 1..inner {
            let factor = lower[i] / diagonal[i - 1];
            diagonal[i] -= factor * upper[i - 1];
            right[i] -= factor * right[i - 1];
        }
        let mut curvature = vec![0.0; n];
        for i in (0..inner).rev() {
            let next = if i + 1 < inner { upper[i] * curvature[i + 2] } else { 0.0 };
            curvature[i + 1] = (right[i] - next) / diagonal[i];
        }
        if ends == Ends::NotAKnot {
            curvature[0] = curvature[1] + (curvature[1] - curvature[2]) * h[0] / h[1];
            curvature[n - 1] = curvature[n - 2] + (curvature[n - 2] - curvature[n - 3]) * h[n - 2] / h[n - 3];
        }
        Some(Self { x: x.to_vec(), y: y.to_vec(), curvature })
    }

    /// Value, first and second derivative at `x`.
    pub fn evaluate(&self, x: f64) -> [f64; 3] {
        let last = self.x.len() - 1;
        let inside = x.clamp(self.x[0], self.x[last]);
        let k = self.x.partition_point(|&p| p <= inside).clamp(1, last) - 1;
        let h = self.x[k + 1] - self.x[k];
        let (m0, m1) = (self.curvature[k], self.curvature[k + 1]);
        let slope = (self.y[k + 1] - self.y[k]) / h - h * (2.0 * m0 + m1) / 6.0;
        let t = inside - self.x[k];
        let third = (m1 - m0) / h;
        let value = self.y[k] + t * (slope + t * (m0 / 2.0 + t * third / 6.0));
        let speed = slope + t * (m0 + t * third / 2.0);
        if x == inside { [value, speed, m0 + t * third] } else { [value + speed * (x - inside), speed, 0.0] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reproduces_a_cubic() {
        let f =
            |x: f64| [1.0 - x + 2.0 * x * x - 0.3 * x.powi(3), -1.0 + 4.0 * x - 0.9 * x * x, 4.0 - 1.8 * x];
        for n in [4, 5, 9] {
            let x: Vec<f64> = (0..n).map(|k| f64::from(k) * 0.4 + 0.01 * f64::from(k * k)).collect();
            let y: Vec<f64> = x.iter().map(|x| f(*x)[0]).collect();
            let spline = Spline::new(&x, &y).unwrap();
            for at in [0.0, 0.1, 0.77, x[x.len() - 1]] {
                for (a, b) in spline.evaluate(at).iter().zip(f(at)) {
                    assert!((a - b).abs() < 1e-11, "{n} {at}: {a} {b}");
                }
            }
            assert_eq!(spline.evaluate(-1.0)[2], 0.0);
        }
    }

    #[test]
    fn a_natural_spline_is_straight_at_the_ends() {
        let line = Spline::natural(&[1.0, 3.0], &[2.0, 6.0]).unwrap();
        assert_eq!(line.evaluate(2.5), [5.0, 2.0, 0.0]);
        // By hand: the inner second derivatives are −120/27.75 and 104/27.75.
        let spline = Spline::natural(&[0.0, 1.0, 2.5, 4.0], &[1.0, 3.0, 2.0, 5.0]).unwrap();
        assert!(spline.evaluate(0.0)[2] == 0.0 && spline.evaluate(4.0)[2].abs() < 1e-14);
        for (x, y) in [(0.5, 2.0 + 7.5 / 27.75), (3.0, 3.0 - 390.0 / 749.25)] {
            assert!((spline.evaluate(x)[0] - y).abs() < 1e-14, "{x}: {} {y}", spline.evaluate(x)[0]);
        }
    }

    #[test]
    fn curvature_is_continuous() {
        let x: Vec<f64> = (0..12).map(|k| f64::from(k) + 0.3 * f64::from(k).sin()).collect();
        let y: Vec<f64> = x.iter().map(|x| (1.3 * x).sin()).collect();
        let spline = Spline::new(&x, &y).unwrap();
        for (x, y) in x[1..11].iter().zip(&y[1..]) {
            let (before, at) = (spline.evaluate(x - 1e-9), spline.evaluate(*x));
            assert!((at[0] - y).abs() < 1e-14);
            assert!((before[1] - at[1]).abs() < 1e-8 && (before[2] - at[2]).abs() < 1e-8);
        }
        assert!(Spline::new(&x[..3], &y[..3]).is_none());
    }
}
