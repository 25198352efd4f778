//! Scalar root finding: the root of an increasing function (safeguarded Newton).

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
