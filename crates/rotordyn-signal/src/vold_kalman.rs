//! Vold-Kalman order tracking: complex amplitudes of several orders at once, sample by sample.
//!
//! Second generation, two poles. The record y is split into orders with slowly varying complex amplitudes X_k,
//! y = Σ Re(X_k e^{jν_kθ}) + remainder, by the least squares
//!
//! ```text
//! Σ_n (y_n − Σ_k Re(X_k,n e^{jν_k θ_n}))² + Σ_k Σ_n r²_k,n |X_k,n−1 − 2 X_k,n + X_k,n+1|²  →  min
//! ```
//!
//! No window in angle is needed, and orders that beat within a window or cross are separated by their phases. The real
//! form is solved, with real and imaginary parts as unknowns, so that nothing is lost to the conjugate of a slow order.
//! The equations are solved by conjugate gradients, preconditioned by the equations of the single orders (pentadiagonal).
//! Sources: Vold and Leuridan, SAE 931288 (1993); Feldbauer and Höldrich, EURASIP J. Adv. Signal Process. 2000;
//! Tuma, Mech. Syst. Signal Process. 19 (2005).

use std::f64::consts::{PI, SQRT_2, TAU};

use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::{check, check_length, check_rate, check_record, check_same_length};

/// Relative size of the remaining gradient at which the iteration ends.
const TOLERANCE: f64 = 1e-8;
/// More iterations than this are needed only by orders that the bandwidth cannot separate.
const MAX_ITERATIONS: usize = 2000;
/// Smallest bandwidth over the sampling rate: r² stays below 10¹³, where round-off is 10⁻⁴ of the amplitude.
const MIN_RELATIVE_BANDWIDTH: f64 = 1e-4;

/// Width of the pass band around an order between its −3 dB points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bandwidth {
    /// Constant \[Hz\].
    Hertz(f64),
    /// Proportional to the shaft speed, in orders; constant below the speed of that many \[Hz\].
    Orders { width: f64, min_hertz: f64 },
}

/// An order to be tracked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackedOrder {
    /// Cycles per shaft revolution; 0 is a slowly varying mean.
    pub order: f64,
    pub bandwidth: Bandwidth,
}

/// Complex amplitude of one order at every sample.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderEnvelope {
    pub order: f64,
    /// X with x = |X| cos(νθ + arg X), peak values.
    pub amplitude: Vec<Complex<f64>>,
}

/// The orders of a record and what they leave.
#[derive(Clone, Debug, PartialEq)]
pub struct VoldKalman {
    /// In the sequence of the request.
    pub orders: Vec<OrderEnvelope>,
    /// The record less the tracked orders.
    pub remainder: Vec<f64>,
    pub iterations: usize,
}

/// Splits a record into orders with slowly varying complex amplitudes.
///
/// `record` (N), `theta` (N) shaft angle \[rad\], `sample_rate` \[Hz\]. The weight of an order follows from its −3 dB
/// bandwidth B: r² = (√2 − 1)/(2 (2 − 2 cos(πB/f_s))²), without the factor 2 for order 0.
///
/// # Errors
/// NaN, other lengths, an order twice, an order above half the sampling rate, a bandwidth below 10⁻⁴ of the sampling rate
/// or that of a record of two periods, orders that the bandwidths cannot separate.
pub fn vold_kalman(
    record: &[f64],
    theta: &[f64],
    sample_rate: f64,
    orders: &[TrackedOrder],
) -> Result<VoldKalman, SignalError> {
    check_record("record", record)?;
    check_record("shaft angle", theta)?;
    check_rate(sample_rate)?;
    check_same_length("shaft angle", theta.len(), "the record", record.len())?;
    check_length("record", record.len(), 16, "Vold-Kalman order tracking")?;
    let speed = shaft_speed(theta, sample_rate);
    check_orders(orders, &speed, record.len(), sample_rate)?;
    let problem = Problem::new(theta, &speed, sample_rate, orders);
    let (solution, iterations) = problem.solve(record).ok_or(SignalError::Unknown {
        what: "orders further apart, or a narrower bandwidth",
        purpose: "Vold-Kalman order tracking",
    })?;
    let tracked = problem.sum(&solution);
    let remainder = record.iter().zip(&tracked).map(|(y, sum)| y - sum).collect();
    let mut column = 0;
    let envelopes = orders.iter().map(|tracked| {
        let parts = if tracked.order == 0.0 { 1 } else { 2 };
        let rows = solution.chunks_exact(problem.columns);
        let amplitude = rows.map(|row| match parts {
            1 => Complex::new(row[column], 0.0),
            _ => Complex::new(row[column], row[column + 1]),
        });
        let envelope = OrderEnvelope { order: tracked.order, amplitude: amplitude.collect() };
        column += parts;
        envelope
    });
    Ok(VoldKalman { orders: envelopes.collect(), remainder, iterations })
}

/// Shaft speed at every sample \[Hz\], by central differences, without sign.
pub(super) fn shaft_speed(theta: &[f64], sample_rate: f64) -> Vec<f64> {
    let last = theta.len() - 1;
    let at = |n: usize| {
        let (a, b) = (n.saturating_sub(1), (n + 1).min(last));
        ((theta[b] - theta[a]) * sample_rate / ((b - a) as f64 * TAU)).abs()
    };
    (0..=last).map(at).collect()
}

/// Smallest bandwidth that is accepted \[Hz\]: of two periods in the record, and by round-off.
pub(super) fn smallest_bandwidth(samples: usize, sample_rate: f64) -> f64 {
    (2.0 * sample_rate / samples as f64).max(MIN_RELATIVE_BANDWIDTH * sample_rate)
}

fn check_orders(
    orders: &[TrackedOrder],
    speed: &[f64],
    samples: usize,
    sample_rate: f64,
) -> Result<(), SignalError> {
    check(!orders.is_empty(), "number of orders", "one or more", 0.0)?;
    let fastest = speed.iter().copied().fold(0.0, f64::max);
    check(fastest > 0.0, "highest shaft speed [Hz]", "a shaft that turns", fastest)?;
    let smallest = smallest_bandwidth(samples, sample_rate);
    for (k, tracked) in orders.iter().enumerate() {
        let order = tracked.order;
        check(order >= 0.0 && order.is_finite(), "order", "0 or more", order)?;
        check(orders[..k].iter().all(|o| o.order != order), "order", "every order once", order)?;
        let needed = 2.0 * order * fastest;
        if needed > sample_rate {
            let purpose = "the highest order at the highest speed";
            return Err(SignalError::RateTooLow { given: sample_rate, needed, purpose });
        }
        let (low, high) = match tracked.bandwidth {
            Bandwidth::Hertz(width) => (width, width),
            Bandwidth::Orders { width, min_hertz } => {
                check(width > 0.0, "bandwidth in orders", "more than 0", width)?;
                (min_hertz, (width * fastest).max(min_hertz))
            }
        };
        let expected = "at least two periods in the record, and 1e-4 of the sampling rate";
        check(low >= smallest, "bandwidth [Hz]", expected, low)?;
        let expected = "below a quarter of the sampling rate";
        check(high < 0.25 * sample_rate, "bandwidth [Hz]", expected, high)?;
    }
    Ok(())
}

/// The normal equations (CᵀC + DᵀR²D) u = Cᵀy. Vectors have a row of unknowns for each sample: real and imaginary part
/// of every order.
struct Problem {
    /// Unknowns of a sample.
    columns: usize,
    samples: usize,
    /// C: cos ν_kθ and −sin ν_kθ at every sample.
    carrier: Vec<f64>,
    /// r² at every sample and unknown, of the difference centred there; zero at the ends.
    weight: Vec<f64>,
    preconditioner: Pentadiagonal,
}

impl Problem {
    fn new(theta: &[f64], speed: &[f64], sample_rate: f64, orders: &[TrackedOrder]) -> Self {
        let samples = theta.len();
        let columns = orders.iter().map(|tracked| if tracked.order == 0.0 { 1 } else { 2 }).sum();
        let (mut carrier, mut weight) =
            (Vec::with_capacity(samples * columns), Vec::with_capacity(samples * columns));
        for (n, (angle, speed)) in theta.iter().zip(speed).enumerate() {
            for tracked in orders {
                let width = match tracked.bandwidth {
                    Bandwidth::Hertz(width) => width,
                    Bandwidth::Orders { width, min_hertz } => (width * speed).max(min_hertz),
                };
                let inside = n > 0 && n + 1 < samples;
                let response = 2.0 - 2.0 * (PI * width / sample_rate).cos();
                let r2 = if inside { (SQRT_2 - 1.0) / (response * response) } else { 0.0 };
                if tracked.order == 0.0 {
                    carrier.push(1.0);
                    weight.push(r2);
                } else {
                    let (sin, cos) = (tracked.order * (angle - theta[0])).sin_cos();
                    let (sin_0, cos_0) = (tracked.order * theta[0]).rem_euclid(TAU).sin_cos();
                    carrier.extend([cos * cos_0 - sin * sin_0, -(sin * cos_0 + cos * sin_0)]);
                    weight.extend([0.5 * r2; 2]);
                }
            }
        }
        // The mean of the squared carrier.
        let diagonal: Vec<f64> = orders
            .iter()
            .flat_map(|tracked| if tracked.order == 0.0 { vec![1.0] } else { vec![0.5; 2] })
            .collect();
        let preconditioner = Pentadiagonal::new(&weight, &diagonal, samples);
        Self { columns, samples, carrier, weight, preconditioner }
    }

    /// C u: the sum of the orders at every sample.
    fn sum(&self, u: &[f64]) -> Vec<f64> {
        let rows = self.carrier.chunks_exact(self.columns).zip(u.chunks_exact(self.columns));
        rows.map(|(c, u)| c.iter().zip(u).map(|(c, u)| c * u).sum()).collect()
    }

    /// Cᵀ y.
    fn project(&self, y: &[f64]) -> Vec<f64> {
        let rows = self.carrier.chunks_exact(self.columns).zip(y);
        rows.flat_map(|(c, y)| c.iter().map(move |c| c * y)).collect()
    }

    /// (CᵀC + DᵀR²D) u.
    fn apply(&self, u: &[f64], out: &mut [f64]) {
        let m = self.columns;
        for ((c, u), out) in self.carrier.chunks_exact(m).zip(u.chunks_exact(m)).zip(out.chunks_exact_mut(m))
        {
            let sum: f64 = c.iter().zip(u).map(|(c, u)| c * u).sum();
            out.iter_mut().zip(c).for_each(|(out, c)| *out = c * sum);
        }
        for n in 1..self.samples - 1 {
            let at = (n - 1) * m;
            for i in at..at + m {
                let difference = self.weight[i + m] * ((u[i] - u[i + m]) - (u[i + m] - u[i + 2 * m]));
                out[i] += difference;
                out[i + m] -= 2.0 * difference;
                out[i + 2 * m] += difference;
            }
        }
    }

    /// Preconditioned conjugate gradients from the solution of the single orders; `None` without convergence.
    fn solve(&self, record: &[f64]) -> Option<(Vec<f64>, usize)> {
        let right = self.project(record);
        let mut u = right.clone();
        self.preconditioner.solve(&mut u);
        let target = TOLERANCE * dot(&right, &u).sqrt();
        let mut product = vec![0.0; u.len()];
        self.apply(&u, &mut product);
        let mut residual: Vec<f64> = right.iter().zip(&product).map(|(b, a)| b - a).collect();
        let mut direction = residual.clone();
        self.preconditioner.solve(&mut direction);
        let mut energy = dot(&residual, &direction);
        let mut corrected = direction.clone();
        for iteration in 0..MAX_ITERATIONS {
            if energy.max(0.0).sqrt() <= target {
                return Some((u, iteration));
            }
            self.apply(&direction, &mut product);
            let step = energy / dot(&direction, &product);
            u.iter_mut().zip(&direction).for_each(|(u, d)| *u += step * d);
            residual.iter_mut().zip(&product).for_each(|(r, a)| *r -= step * a);
            corrected.copy_from_slice(&residual);
            self.preconditioner.solve(&mut corrected);
            let next = dot(&residual, &corrected);
            let share = next / energy;
            direction.iter_mut().zip(&corrected).for_each(|(d, z)| *d = z + share * *d);
            energy = next;
        }
        None
    }
}

/// L D Lᵀ of diagonal + DᵀR²D for every unknown of a sample, which do not depend on each other.
struct Pentadiagonal {
    columns: usize,
    /// 1/d of every row, and the two columns of L below it.
    inverse: Vec<f64>,
    lower: [Vec<f64>; 2],
}

impl Pentadiagonal {
    fn new(weight: &[f64], diagonal: &[f64], samples: usize) -> Self {
        let (m, size) = (diagonal.len(), weight.len());
        let w = |i: usize| weight.get(i).copied().unwrap_or(0.0);
        let (mut d, mut l1, mut l2) = (vec![0.0; size], vec![0.0; size], vec![0.0; size]);
        for i in 0..size {
            let before = |steps: usize| i.checked_sub(steps * m);
            let previous = before(1).map_or(0.0, w);
            let next = if i / m + 1 < samples { w(i + m) } else { 0.0 };
            let main = diagonal[i % m] + previous + 4.0 * w(i) + next;
            let one = before(1).map_or(0.0, |k| d[k] * l1[k] * l1[k]);
            let two = before(2).map_or(0.0, |k| d[k] * l2[k] * l2[k]);
            d[i] = main - one - two;
            // First and second column below the diagonal: −2 (r²_n + r²_n+1) and r²_n+1.
            let coupled = before(1).map_or(0.0, |k| d[k] * l1[k] * l2[k]);
            l1[i] = (-2.0 * (w(i) + next) - coupled) / d[i];
            l2[i] = next / d[i];
        }
        Self { columns: m, inverse: d.iter().map(|d| 1.0 / d).collect(), lower: [l1, l2] }
    }

    fn solve(&self, x: &mut [f64]) {
        let (m, size) = (self.columns, x.len());
        let [l1, l2] = &self.lower;
        for i in m..2 * m {
            x[i] -= l1[i - m] * x[i - m];
        }
        for n in 2..size / m {
            let (known, rest) = x.split_at_mut(n * m);
            let (two, one) = known[(n - 2) * m..].split_at(m);
            let l1 = &l1[(n - 1) * m..n * m];
            let l2 = &l2[(n - 2) * m..(n - 1) * m];
            for i in 0..m {
                rest[i] -= l1[i] * one[i] + l2[i] * two[i];
            }
        }
        x.iter_mut().zip(&self.inverse).for_each(|(x, inverse)| *x *= inverse);
        let last = size - m;
        for i in last - m..last {
            x[i] -= l1[i] * x[i + m];
        }
        for n in (0..size / m - 2).rev() {
            let (rest, known) = x.split_at_mut((n + 1) * m);
            let row = &mut rest[n * m..];
            let (l1, l2) = (&l1[n * m..(n + 1) * m], &l2[n * m..(n + 1) * m]);
            for i in 0..m {
                row[i] -= l1[i] * known[i] + l2[i] * known[i + m];
            }
        }
    }
}

/// Scalar product in eight partial sums, always in the same sequence.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    for (a, b) in a.chunks(8).zip(b.chunks(8)) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums.iter().sum()
}
