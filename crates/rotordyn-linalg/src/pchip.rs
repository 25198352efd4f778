//! Monotone piecewise-cubic interpolation (PCHIP).

/// Monotone cubic through points; shape-preserving, C¹, with exact integral.
///
/// Slopes by the weighted harmonic mean of Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5 (1984), ends by the
/// three-point formula limited to keep the shape (the scheme of scipy's `PchipInterpolator`). Outside the points it
/// goes on linearly.
#[derive(Clone, Debug, PartialEq)]
pub struct Pchip {
    x: Vec<f64>,
    y: Vec<f64>,
    slope: Vec<f64>,
    /// ∫ from x\[0\] to x\[k\].
    integral: Vec<f64>,
}

impl Pchip {
    /// Interpolant through points of strictly increasing `x`; one point makes a constant.
    ///
    /// `None` when the lengths differ, there is no point, or `x` does not increase.
    pub fn new(x: &[f64], y: &[f64]) -> Option<Self> {
        if x.is_empty() || x.len() != y.len() || !x.windows(2).all(|w| w[0] < w[1]) {
            return None;
        }
        let n = x.len();
        let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
        let secant: Vec<f64> = (1..n).map(|k| (y[k] - y[k - 1]) / h[k - 1]).collect();
        let slope = match n {
            1 => vec![0.0],
            2 => vec![secant[0]; 2],
            _ => {
                let mut slope = vec![0.0; n];
                slope[0] = end_slope(h[0], h[1], secant[0], secant[1]);
                slope[n - 1] = end_slope(h[n - 2], h[n - 3], secant[n - 2], secant[n - 3]);
                for k in 1..n - 1 {
                    let (a, b) = (secant[k - 1], secant[k]);
                    if a * b > 0.0 {
                        let (w1, w2) = (2.0 * h[k] + h[k - 1], h[k] + 2.0 * h[k - 1]);
                        slope[k] = (w1 + w2) / (w1 / a + w2 / b);
                    }
                }
                slope
            }
        };
        let mut integral = vec![0.0; n];
        for k in 1..n {
            let h = h[k - 1];
            integral[k] =
                integral[k - 1] + h * (0.5 * (y[k - 1] + y[k]) + h * (slope[k - 1] - slope[k]) / 12.0);
        }
        Some(Self { x: x.to_vec(), y: y.to_vec(), slope, integral })
    }

    fn interval(&self, x: f64) -> usize {
        self.x.partition_point(|&p| p <= x).clamp(1, self.x.len() - 1) - 1
    }

    /// Value, slope and integral from the first point, at `x`.
    pub fn evaluate(&self, x: f64) -> [f64; 3] {
        let last = self.x.len() - 1;
        for (end, outside) in [(0, x <= self.x[0]), (last, x >= self.x[last])] {
            if outside {
                let d = x - self.x[end];
                let (y, s) = (self.y[end], self.slope[end]);
                return [y + s * d, s, self.integral[end] + d * (y + 0.5 * s * d)];
            }
        }
        let k = self.interval(x);
        let h = self.x[k + 1] - self.x[k];
        let t = (x - self.x[k]) / h;
        let (y0, y1) = (self.y[k], self.y[k + 1]);
        let (m0, m1) = (h * self.slope[k], h * self.slope[k + 1]);
        // Power form y0 + m0 t + b t² + a t³.
        let a = 2.0 * (y0 - y1) + m0 + m1;
        let b = -3.0 * (y0 - y1) - 2.0 * m0 - m1;
        let value = y0 + t * (m0 + t * (b + t * a));
        let slope = (m0 + t * (2.0 * b + t * 3.0 * a)) / h;
        let integral = self.integral[k] + h * t * (y0 + t * (m0 / 2.0 + t * (b / 3.0 + t * a / 4.0)));
        [value, slope, integral]
    }
}

/// Three-point end slope, limited so that the curve keeps the data's shape.
fn end_slope(h0: f64, h1: f64, s0: f64, s1: f64) -> f64 {
    let slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
    if slope * s0 <= 0.0 {
        0.0
    } else if s0 * s1 <= 0.0 && slope.abs() > 3.0 * s0.abs() {
        3.0 * s0
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reproduces_lines_and_stays_within_data() {
        let p = Pchip::new(&[0.0, 1.0, 3.0], &[1.0, 3.0, 7.0]).unwrap();
        for x in [-1.0, 0.2, 1.0, 2.9, 5.0] {
            let [v, s, i] = p.evaluate(x);
            assert!((v - (1.0 + 2.0 * x)).abs() < 1e-14 && (s - 2.0).abs() < 1e-14);
            assert!((i - (x + x * x)).abs() < 1e-13);
        }
        let step = Pchip::new(&[0.0, 1.0, 2.0, 3.0], &[0.0, 0.0, 1.0, 1.0]).unwrap();
        for k in 0..=300 {
            let v = step.evaluate(k as f64 / 100.0)[0];
            assert!((0.0..=1.0).contains(&v));
        }
    }

    #[test]
    fn equals_scipy() {
        // scipy.interpolate.PchipInterpolator([0,1,2.5,4],[1,3,2,5]) at 0.5, 1.7, 3 (scipy 1.17.1).
        let p = Pchip::new(&[0.0, 1.0, 2.5, 4.0], &[1.0, 3.0, 2.0, 5.0]).unwrap();
        for (x, v) in SCIPY {
            assert!((p.evaluate(x)[0] - v).abs() < 1e-14, "{x}: {} {v}", p.evaluate(x)[0]);
        }
    }
    const SCIPY: [(f64, f64); 3] =
        [(0.5, 2.3833333333333333), (1.7, 2.5499259259259257), (3.0, 2.4074074074074074)];
}
