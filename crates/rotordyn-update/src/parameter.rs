//! Free parameters of a model update: numbers of the model file.

use super::least_squares::Prior;
use rotordyn_units::leading_number;

/// One number of the model file, with its path and unit.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelNumber {
    /// Path, such as "housing.B.k_x".
    pub path: String,
    /// In the unit of the file.
    pub value: f64,
    /// Unit after the number, such as "N/m"; empty if dimensionless.
    pub unit: String,
    /// Whether it is a string in the file, not a bare number.
    pub quoted: bool,
}

impl ModelNumber {
    /// Parses the text or number at a path; `None` if it is not one number with a unit.
    pub fn read(path: &str, text: &str, quoted: bool) -> Option<Self> {
        let text = text.trim();
        let (value, length) = leading_number(text)?;
        let unit = text[length..].trim();
        // Reject two numbers, or a word.
        let more = unit.starts_with([',', '+', '-', '.']) || unit.starts_with(|c: char| c.is_ascii_digit());
        let one = !more || unit.starts_with("1/");
        (value.is_finite() && one).then(|| Self { path: path.into(), value, unit: unit.into(), quoted })
    }

    /// TOML text of another value.
    pub fn text(&self, value: f64) -> String {
        match (self.quoted, self.unit.as_str()) {
            (true, "") => format!("\"{value:e}\""),
            (true, unit) => format!("\"{value:e} {unit}\""),
            // TOML has no integer with an exponent.
            (false, _) => format!("{value:?}"),
        }
    }
}

/// A free parameter: one number of the file, or several changed together (grouped).
///
/// Its coordinate x is 0 at the start: logarithmic, value = start · e^x (positive values that keep their
/// sign), or additive, value = start + x.
#[derive(Clone, Debug, PartialEq)]
pub struct FreeParameter {
    /// As given by the user, such as "housing.*.k_x".
    pub name: String,
    /// At least one; several keep their ratios (additive: their differences).
    pub numbers: Vec<ModelNumber>,
    pub logarithmic: bool,
    /// Prior mean and standard deviation of x.
    pub mean: f64,
    pub deviation: f64,
    /// Bounds of x.
    pub lower: f64,
    pub upper: f64,
}

/// Default prior standard deviation of ln(value): a factor of two either way.
pub const DEFAULT_DEVIATION: f64 = std::f64::consts::LN_2;

impl FreeParameter {
    /// A parameter with the default prior: a factor of two either way; additive: ± its value.
    ///
    /// `None` if the value is 0 (no scale) and no deviation is given.
    pub fn new(
        name: &str,
        places: Vec<ModelNumber>,
        logarithmic: bool,
        deviation: Option<f64>,
    ) -> Option<Self> {
        let first = places.first()?.value;
        let deviation = match deviation {
            Some(deviation) => deviation,
            None if logarithmic => DEFAULT_DEVIATION,
            None => first.abs(),
        };
        let (lower, upper) = (f64::NEG_INFINITY, f64::INFINITY);
        (deviation > 0.0).then(|| Self {
            name: name.into(),
            numbers: places,
            logarithmic,
            mean: 0.0,
            deviation,
            lower,
            upper,
        })
    }

    /// Value of the first entry at x, in the file's unit.
    pub fn value(&self, x: f64) -> f64 {
        self.value_of(&self.numbers[0], x)
    }

    /// Value of one of its entries at x.
    pub fn value_of(&self, place: &ModelNumber, x: f64) -> f64 {
        if self.logarithmic { place.value * x.exp() } else { place.value + x }
    }

    /// Coordinate x of a value of the first entry.
    pub fn coordinate(&self, value: f64) -> f64 {
        if self.logarithmic { (value / self.numbers[0].value).ln() } else { value - self.numbers[0].value }
    }

    /// Derivative dvalue/dx of the first entry.
    pub fn derivative(&self, x: f64) -> f64 {
        if self.logarithmic { self.value(x) } else { 1.0 }
    }

    /// Settings on either side of x for central differences, and their distance in x: values are stepped
    /// evenly, so that quantities linear in them are differenced exactly.
    pub fn difference_settings(&self, x: f64) -> ([Vec<(String, String)>; 2], f64) {
        const STEP: f64 = 1e-4;
        let step = if self.logarithmic { STEP } else { STEP * self.deviation };
        let at = |way: f64| {
            let text = |place: &ModelNumber| {
                let here = self.value_of(place, x);
                let value = if self.logarithmic { here * (1.0 + way * step) } else { here + way * step };
                (place.path.clone(), place.text(value))
            };
            self.numbers.iter().map(text).collect()
        };
        ([at(-1.0), at(1.0)], 2.0 * step)
    }

    /// Paths and values at x, in the format of `--set`.
    pub fn settings(&self, x: f64) -> Vec<(String, String)> {
        self.numbers.iter().map(|p| (p.path.clone(), p.text(self.value_of(p, x)))).collect()
    }

    /// Unit of the first entry.
    pub fn unit(&self) -> &str {
        &self.numbers[0].unit
    }
}

/// Priors and bounds of all parameters.
pub fn prior(parameters: &[FreeParameter]) -> Prior {
    let all = |of: fn(&FreeParameter) -> f64| parameters.iter().map(of).collect();
    Prior {
        mean: all(|p| p.mean),
        deviation: all(|p| p.deviation),
        lower: all(|p| p.lower),
        upper: all(|p| p.upper),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_number_with_its_unit() {
        let place = ModelNumber::read("housing.B.k_x", "6e6 N/m", true).unwrap();
        assert_eq!((place.value, place.unit.as_str()), (6e6, "N/m"));
        assert_eq!(place.text(4.2e6), "\"4.2e6 N/m\"");
        assert_eq!(ModelNumber::read("p", "5 1/s", true).unwrap().unit, "1/s");
        assert_eq!(ModelNumber::read("p", "0.3", false).unwrap().text(2.0), "2.0");
        for no in ["250, 0 N", "ball", "", "1 2 N"] {
            assert_eq!(ModelNumber::read("p", no, true), None, "{no}");
        }
    }

    #[test]
    fn groups_keep_their_ratios() {
        let place = |path: &str, value: f64| ModelNumber {
            path: path.into(),
            value,
            unit: "N/m".into(),
            quoted: true,
        };
        let both = FreeParameter::new("k", vec![place("a", 2.0), place("b", 6.0)], true, None).unwrap();
        assert_eq!(both.value_of(&both.numbers[1], 2f64.ln()), 12.0);
        assert!((both.coordinate(both.value(0.3)) - 0.3).abs() < 1e-15);
        assert!(FreeParameter::new("k", vec![place("a", 0.0)], false, None).is_none());
    }
}
