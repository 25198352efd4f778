//! Times as a table writes them: rounded to some digits.

/// The digits of the numbers of a column.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Digits {
    /// Most digits behind the decimal sign of numbers without an exponent.
    decimals: Option<i32>,
    /// Most digits of numbers with an exponent.
    significant: Option<i32>,
}

impl Digits {
    pub fn note(&mut self, cell: &str) {
        let mantissa = cell.split(['e', 'E', 'd', 'D']).next().unwrap_or_default();
        if mantissa.len() < cell.len() {
            let digits = mantissa.trim_start_matches(|c: char| !matches!(c, '1'..='9'));
            let count = digits.bytes().filter(u8::is_ascii_digit).count() as i32;
            self.significant = self.significant.max(Some(count));
        } else if cell.starts_with(|c: char| c.is_ascii_digit() || "+-.,".contains(c)) {
            let decimals = cell.find(['.', ',']).map_or(0, |at| cell.len() - at - 1) as i32;
            self.decimals = self.decimals.max(Some(decimals));
        }
    }

    /// Unit of the last digit of a value.
    fn last_digit(&self, value: f64) -> f64 {
        let fixed = self.decimals.map(|decimals| 10.0_f64.powi(-decimals));
        let floating = self.significant.map(|significant| {
            let exponent = value.abs().max(f64::MIN_POSITIVE).log10().floor() as i32;
            10.0_f64.powi(exponent - significant + 1)
        });
        fixed.into_iter().chain(floating).fold(f64::INFINITY, f64::min)
    }
}

/// A uniform step behind rounded times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RoundedStep {
    pub start: f64,
    /// Middle of the steps that the rounding of all times admits.
    pub step: f64,
    /// Half the range of these steps, over the step.
    pub error: f64,
    /// Whether nearly all steps are one multiple of the last digit: the others may be lost or doubled samples.
    pub may_have_slips: bool,
}

/// Fewest times of a step.
const MIN_TIMES: usize = 3;
/// Fewest steps, and their share, that differ from the most frequent one by rounding.
const FEWEST_OTHERS: usize = 10;
const SHARE_OF_OTHERS: f64 = 0.01;
/// Halvings of the range of a step at its edges.
const EDGE_HALVINGS: usize = 20;
/// Smallest step \[s\]: shorter ones are of days.
const SHORTEST_STEP: f64 = 1e-7;

/// The step of times that deviate from equal steps by no more than their rounding.
pub(super) fn rounded_step(times: &[f64], digits: &Digits) -> Option<RoundedStep> {
    let (start, end) = (*times.first()?, *times.last()?);
    let step = (end - start) / (times.len() - 1) as f64;
    if times.len() < MIN_TIMES || !(step >= SHORTEST_STEP && step.is_finite()) {
        return None;
    }
    let mut largest: f64 = 0.0;
    let [first, last] = [start, end].map(|time| digits.last_digit(time));
    for (k, time) in times.iter().enumerate() {
        // Half a digit of this time and half of the ends' there, or a whole one where digits are cut off.
        let digit = digits.last_digit(*time);
        largest = largest.max(digit);
        let share = k as f64 / (times.len() - 1) as f64;
        let bound = 0.5 * (digit + first + (last - first) * share);
        let even = step.mul_add(k as f64, start);
        if !digit.is_finite() || (time - even).abs() > 1.001 * bound + f64::EPSILON * end.abs() {
            return None;
        }
    }
    let usual = (step / largest).round();
    let others = times.windows(2).filter(|pair| ((pair[1] - pair[0]) / largest).round() != usual).count();
    let few = (others as f64) < (SHARE_OF_OTHERS * times.len() as f64).max(FEWEST_OTHERS as f64);
    let [shortest, longest] = admitted_steps(times, digits, step, largest / (end - start))?;
    Some(RoundedStep {
        start,
        step: 0.5 * (shortest + longest),
        error: (longest - shortest) / (longest + shortest),
        may_have_slips: usual >= 1.0 && few,
    })
}

/// Shortest and longest step within `error` of `step` (relative) from which no time is farther than its rounding.
fn admitted_steps(times: &[f64], digits: &Digits, step: f64, error: f64) -> Option<[f64; 2]> {
    let halves: Vec<f64> = times.iter().map(|time| 0.5 * digits.last_digit(*time)).collect();
    // Σ of floating-point errors of the times.
    let tolerance = 4.0 * f64::EPSILON * times.last()?.abs();
    // By how much the times lie too far apart: a convex function of the step, positive where it is not admitted.
    let excess = |step: f64| {
        let start = |(k, (time, half)): (usize, (&f64, &f64))| {
            let off = time - step * k as f64;
            (off - half, off + half)
        };
        let range = times.iter().zip(&halves).enumerate().map(start);
        let (low, high) = range.fold((f64::NEG_INFINITY, f64::INFINITY), |range, (low, high)| {
            (range.0.max(low), range.1.min(high))
        });
        low - high - tolerance
    };
    let (mut low, mut high) = (step * (1.0 - error), step * (1.0 + error));
    let mut inside = step;
    while excess(inside) > 0.0 {
        // Towards the minimum, by thirds.
        let third = (high - low) / 3.0;
        let [left, right] = [low + third, high - third];
        if excess(left) < excess(right) {
            high = right
        } else {
            low = left
        }
        if third < f64::EPSILON * step {
            return None;
        }
        inside = 0.5 * (low + high);
    }
    let edge = |outside: f64| {
        let (mut inside, mut outside) = (inside, outside);
        for _ in 0..EDGE_HALVINGS {
            let middle = 0.5 * (inside + outside);
            if excess(middle) > 0.0 { outside = middle } else { inside = middle }
        }
        inside
    };
    Some([edge(step * (1.0 - error)), edge(step * (1.0 + error))])
}

/// Whether times are those of a step but for their rounding: a lost sample would move those behind it by a step.
pub(super) fn are_of_step(times: &[f64], digits: &Digits, step: f64) -> bool {
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    let mut largest: f64 = 0.0;
    for (k, time) in times.iter().enumerate() {
        let off = time - step * k as f64;
        range = (range.0.min(off), range.1.max(off));
        largest = largest.max(digits.last_digit(*time));
    }
    range.1 - range.0 < largest * (1.0 - 1e-4)
}
