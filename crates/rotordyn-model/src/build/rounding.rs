//! Values in two digits.

/// A value above zero, rounded down to two digits.
pub(super) fn rounded_down(value: f64) -> f64 {
    in_two_digits(value, f64::floor)
}

/// A value above zero, rounded up to two digits.
pub(super) fn rounded_up(value: f64) -> f64 {
    in_two_digits(value, f64::ceil)
}

fn in_two_digits(value: f64, round: fn(f64) -> f64) -> f64 {
    // Divided where the digits are behind the point, so that the value is as it is written.
    match value.log10().floor() as i32 - 1 {
        power if power < 0 => {
            let factor = 10f64.powi(-power);
            round(value * factor) / factor
        }
        power => {
            let unit = 10f64.powi(power);
            round(value / unit) * unit
        }
    }
}
