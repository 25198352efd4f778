//! Distribution of χ², the sum of squares of ν independent standard normal deviates.

/// Probability that χ² of ν `degrees` of freedom exceeds a value: Q(ν/2, χ²/2), the regularised upper incomplete
/// gamma function; ν need not be whole.
///
/// NaN if ν is not positive or a value is not a number.
pub fn upper_probability(chi_squared: f64, degrees: f64) -> f64 {
    tails(0.5 * chi_squared, 0.5 * degrees)[1]
}

/// Probability that χ² of ν `degrees` of freedom is below a value, P(ν/2, χ²/2).
pub fn lower_probability(chi_squared: f64, degrees: f64) -> f64 {
    tails(0.5 * chi_squared, 0.5 * degrees)[0]
}

/// Both regularised incomplete gamma functions P(a, x) and Q(a, x) = 1 − P.
///
/// The smaller tail is computed and is accurate in relative terms: P below the mean by its series, Q above by its
/// continued fraction. Source: NIST Digital Library of Mathematical Functions, 8.11.4 (series), 8.9.2 (fraction).
fn tails(x: f64, a: f64) -> [f64; 2] {
    if a.is_nan() || a <= 0.0 || x.is_nan() {
        return [f64::NAN; 2];
    }
    if x <= 0.0 {
        return [0.0, 1.0];
    }
    // x^a e^−x / Γ(a)
    let front = (a * x.ln() - x - libm::lgamma(a)).exp();
    if x < a + 1.0 {
        let lower = (front * series(x, a)).min(1.0);
        [lower, 1.0 - lower]
    } else {
        let upper = (front * fraction(x, a)).min(1.0);
        [1.0 - upper, upper]
    }
}

/// Terms after which series and fraction end: several √a suffice for a relative error of 1e-15.
const MAX_TERMS: usize = 100_000;

/// Σ x^k / (a (a+1) … (a+k)).
fn series(x: f64, a: f64) -> f64 {
    let mut term = a.recip();
    let mut sum = term;
    for k in 1..MAX_TERMS {
        term *= x / (a + k as f64);
        sum += term;
        if term < sum * f64::EPSILON {
            break;
        }
    }
    sum
}

/// 1/(x+1−a− 1(1−a)/(x+3−a− 2(2−a)/(x+5−a− …))), by the modified method of Lentz.
fn fraction(x: f64, a: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let kept = |v: f64| if v.abs() < TINY { TINY } else { v };
    let mut denominator = x + 1.0 - a;
    let mut c = TINY.recip();
    let mut d = kept(denominator).recip();
    let mut value = d;
    for k in 1..MAX_TERMS {
        let k = k as f64;
        let numerator = -k * (k - a);
        denominator += 2.0;
        d = kept(numerator * d + denominator).recip();
        c = kept(denominator + numerator / c);
        let factor = c * d;
        value *= factor;
        if (factor - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabulated_percentage_points() {
        // Abramowitz & Stegun (1964), table 26.8: χ² of an upper tail, six digits.
        for (degrees, probability, chi_squared) in [
            (1.0, 0.05, 3.84146),
            (1.0, 0.01, 6.63490),
            (1.0, 0.001, 10.828),
            (2.0, 0.01, 9.21034),
            (5.0, 0.5, 4.35146),
            (10.0, 0.05, 18.3070),
            (14.0, 0.01, 29.1413),
            (14.0, 0.99, 4.66043),
            (30.0, 0.005, 53.6720),
            (100.0, 0.01, 135.807),
            (100.0, 0.99, 70.0648),
        ] {
            let found = upper_probability(chi_squared, degrees);
            // Rounding of the table's χ² in its last digit, and of 10.828 in its fifth.
            assert!((found / probability - 1.0).abs() < 3e-4, "{degrees} {chi_squared}: {found}");
            let other = lower_probability(chi_squared, degrees);
            assert!((found + other - 1.0).abs() < 1e-14, "{degrees} {chi_squared}");
        }
    }

    #[test]
    fn closed_forms() {
        // ν = 2: e^(−χ²/2); ν = 4: (1 + χ²/2) e^(−χ²/2); ν = 1: erfc √(χ²/2). Far tails keep their relative accuracy.
        for chi_squared in [1e-6, 0.3, 1.0, 4.0, 35.9, 200.0, 1200.0] {
            let half: f64 = 0.5 * chi_squared;
            for (degrees, exact) in
                [(2.0, (-half).exp()), (4.0, (1.0 + half) * (-half).exp()), (1.0, libm::erfc(half.sqrt()))]
            {
                let found = upper_probability(chi_squared, degrees);
                assert!((found / exact - 1.0).abs() < 1e-11, "{degrees} {chi_squared}: {found} {exact}");
            }
        }
    }

    #[test]
    fn limits_and_fractional_degrees() {
        assert_eq!(upper_probability(0.0, 3.0), 1.0);
        assert_eq!(lower_probability(0.0, 3.0), 0.0);
        assert_eq!(upper_probability(1e6, 3.0), 0.0);
        assert!(upper_probability(1.0, 0.0).is_nan() && upper_probability(f64::NAN, 1.0).is_nan());
        // Between the whole degrees on both sides.
        let [low, here, high] = [13.0, 13.4, 14.0].map(|n| upper_probability(35.9, n));
        assert!(low < here && here < high && high < 0.01);
        // Wilson & Hilferty: (χ²/ν)^⅓ is nearly normal, with an error of 1e-4 at ν = 1000.
        let (n, x) = (1000.0_f64, 1100.0_f64);
        let spread = 2.0 / (9.0 * n);
        let z = ((x / n).cbrt() - 1.0 + spread) / spread.sqrt();
        let normal = 0.5 * libm::erfc(z / std::f64::consts::SQRT_2);
        assert!((upper_probability(x, n) - normal).abs() < 1e-4);
    }
}
