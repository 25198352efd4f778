//! Record 7 of a function: type, number and spacing of its values.

use super::block::{Block, DAMAGED_HINT};
use super::{ParseError, field};
use crate::error::snippet;

pub(super) const RECORD_7: usize = 6;

/// Record 7, data form: type, number and spacing of the values.
pub(super) struct DataForm {
    pub complex: bool,
    pub double: bool,
    /// Values, or pairs of abscissa and value.
    pub count: usize,
    pub even: bool,
    pub(super) start: f64,
    pub(super) step: f64,
    pub(super) z_value: f64,
}

impl DataForm {
    /// Reads `(3I10,3E13.5)`.
    pub fn of(block: &Block) -> Result<Self, ParseError> {
        let line = block.record(RECORD_7)?;
        let fault = |problem: String, advice: &str| block.error_at(RECORD_7, problem, advice);
        let words: Vec<f64> = field::numbers(line).map_err(|word| {
            fault(format!("`{}` is expected to be a number", snippet(&word)), DAMAGED_HINT)
        })?;
        let [kind, count, even, start, step, ..] = words[..] else {
            return Err(fault(
                format!("`{}` is not a data form (record 7)", snippet(line.trim())),
                DAMAGED_HINT,
            ));
        };
        let (complex, double) = match kind as i64 {
            2 => (false, false),
            4 => (false, true),
            5 => (true, false),
            6 => (true, true),
            other => {
                let problem = format!("ordinate data type {other} is none of 2, 4, 5, 6");
                return Err(fault(problem, DAMAGED_HINT));
            }
        };
        if !(1.0..1e12).contains(&count) {
            return Err(fault(format!("the function has {count} values"), "remove the empty function"));
        }
        let even = even as i64 == 1;
        if even && !(step.is_finite() && step > 0.0 && start.is_finite()) && count > 1.0 {
            let problem = format!("the function is evenly spaced with a step of {step}");
            return Err(fault(problem, "export it with its sampling rate or frequency step"));
        }
        let z_value = words.get(5).copied().unwrap_or(0.0);
        Ok(DataForm {
            complex,
            double,
            count: count as usize,
            even,
            start,
            step: step_of_integer_rate(step),
            z_value,
        })
    }

    /// Numbers per value: abscissa if uneven, real part, imaginary part.
    pub fn width(&self) -> usize {
        usize::from(!self.even) + 1 + usize::from(self.complex)
    }

    /// Bytes of the binary data, with abscissae of the size of the values, and of 4 bytes.
    pub fn binary_sizes(&self) -> [usize; 2] {
        let value = if self.double { 8 } else { 4 };
        let same_width = self.count * self.width() * value;
        let single_abscissae =
            self.count * (4 * usize::from(!self.even) + (1 + usize::from(self.complex)) * value);
        [same_width, single_abscissae]
    }
}

/// The step with an integer inverse (sampling rate), if it is the only such step that prints like `step`.
///
/// Record 7 has six digits: 1/65536 s is written as 1.52588E-05.
pub(super) fn step_of_integer_rate(step: f64) -> f64 {
    let print = |x: f64| format!("{x:.5e}");
    let whole = (1.0 / step).round();
    let printed = print(step);
    let ambiguous = [whole - 1.0, whole + 1.0].iter().any(|&other| print(1.0 / other) == printed);
    let exact = printed.parse() == Ok(step);
    if exact && !ambiguous && print(1.0 / whole) == printed { 1.0 / whole } else { step }
}
