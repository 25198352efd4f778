//! Scalar root finding: the root of an increasing function, with its slope (safeguarded Newton) or between bounds.

/// Largest number of evaluations: more than bisection to the last digit takes.
const MAX_EVALUATIONS: usize = 200;

/// Root of a non-decreasing function from its value and slope: Newton's method safeguarded by a bracket and
/// bisection. `guess` also sets the search step while the bracket is one-sided.
pub(super) fn increasing_root(f: impl Fn(f64) -> [f64; 2], guess: f64) -> f64 {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut x = guess;
    let mut reach = guess.abs().max(1e-9);
    for _ in 0..200 {
        let [value, slope] = f(x);
        if value == 0.0 {
            return x;
        }
        if value > 0.0 {
            high = x;
        } else {
            low = x;
        }
        let newton = x - value / slope;
        if slope > 0.0 && newton > low && newton < high {
            // Convergence is quadratic: a step this small leaves nothing to correct.
            if (newton - x).abs() <= 1e-9 * x.abs() + 1e-18 {
                return newton;
            }
            x = newton;
            continue;
        }
        reach *= 2.0;
        x = if high.is_infinite() {
            x + reach
        } else if low.is_infinite() {
            x - reach
        } else if high - low <= 1e-15 * x.abs() {
            return x;
        } else {
            0.5 * (low + high)
        };
    }
    x
}

/// Root of an increasing function between two arguments, to round-off; without a change of sign the end next to it.
///
/// Inverse quadratic interpolation where three points agree with one, else bisection: about ten evaluations for a smooth
/// function, and few more than bisection takes for any other.
/// Source: Chandrupatla 1997, Advances in Engineering Software 28, 145-149.
pub(super) fn bracketed_root(f: impl Fn(f64) -> f64, [low, high]: [f64; 2]) -> f64 {
    let (mut a, mut b) = ((low, f(low)), (high, f(high)));
    if a.1 > 0.0 {
        return low;
    }
    if b.1 <= 0.0 {
        return high;
    }
    let mut share = 0.5;
    for _ in 0..MAX_EVALUATIONS {
        let x = a.0 + share * (b.0 - a.0);
        let new = (x, f(x));
        let c = if (new.1 > 0.0) == (a.1 > 0.0) { a } else { std::mem::replace(&mut b, a) };
        a = new;
        let best = if a.1.abs() < b.1.abs() { a } else { b };
        let smallest = f64::EPSILON * best.0.abs() / (b.0 - a.0).abs();
        if smallest > 0.5 || best.1 == 0.0 || smallest.is_nan() {
            return best.0;
        }
        let (xi, phi) = ((a.0 - b.0) / (c.0 - b.0), (a.1 - b.1) / (c.1 - b.1));
        share = if phi * phi < xi && (1.0 - phi).powi(2) < 1.0 - xi {
            a.1 / (b.1 - a.1) * c.1 / (b.1 - c.1)
                + (c.0 - a.0) / (b.0 - a.0) * a.1 / (c.1 - a.1) * b.1 / (c.1 - b.1)
        } else {
            0.5
        };
        share = if share.is_nan() { 0.5 } else { share.clamp(smallest, 1.0 - smallest) };
    }
    a.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// Name, function, range, root, most evaluations.
    type Case = (&'static str, fn(f64) -> f64, [f64; 2], f64, usize);

    #[test]
    fn roots_to_round_off_in_few_evaluations() {
        let functions: [Case; 6] = [
            ("cube", |x| x * x * x - 2.0, [0.0, 10.0], 2.0_f64.cbrt(), 16),
            // A contact that opens at 0.3, as steep as a race.
            ("contact", |x| 1e9 * (x - 0.3_f64).max(0.0).powf(1.5) - 1e-3, [0.0, 1.0], 0.3 + 1e-8, 60),
            ("exponential", |x| x.exp() - 1e-8, [-100.0, 100.0], 1e-8_f64.ln(), 60),
            ("step", |x| if x < 0.7 { -1.0 } else { 1.0 }, [0.0, 1.0], 0.7, 60),
            ("beyond", |x| x - 2.0, [0.0, 1.0], 1.0, 2),
            ("before", |x| x + 2.0, [0.0, 1.0], 0.0, 2),
        ];
        for (name, f, range, expected, most) in functions {
            let count = Cell::new(0);
            let found = bracketed_root(
                |x| {
                    count.set(count.get() + 1);
                    f(x)
                },
                range,
            );
            assert!((found - expected).abs() <= 1e-15 * range[1].abs(), "{name}: {found} for {expected}");
            assert!(count.get() <= most, "{name}: {} evaluations", count.get());
        }
    }
}
