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

/// Tables of the model file whose numbers are known or do not change the modes of the machine: places, operation,
/// measurement and studies.
const TABLES_LEFT_OUT: [&str; 11] = [
    "model",
    "station",
    "speed",
    "drive",
    "unbalance",
    "load",
    "lubricant",
    "probe",
    "sensor",
    "study",
    "variant",
];
/// Keys that are settings of the computation, or do not matter on average.
const KEYS_LEFT_OUT: [&str; 2] = ["element_length", "cage_angle"];

/// Parameters that could be free beside those that are: every number of the machine by itself, and equal numbers of
/// the same key of several items together, such as "housing.*.k_x".
///
/// Left out are zeros, which have no scale, and numbers of which a part is free already.
pub fn candidates(numbers: &[ModelNumber], free: &[FreeParameter]) -> Vec<FreeParameter> {
    let is_free = |n: &ModelNumber| free.iter().flat_map(|p| &p.numbers).any(|own| own.path == n.path);
    let is_candidate = |n: &&ModelNumber| {
        let parts: Vec<&str> = n.path.split('.').collect();
        let named = n.quoted && n.unit.is_empty();
        let left_out = TABLES_LEFT_OUT.contains(&parts[0])
            || parts.last().is_some_and(|key| KEYS_LEFT_OUT.contains(key));
        n.value != 0.0 && !named && !left_out && !is_free(n)
    };
    let own: Vec<&ModelNumber> = numbers.iter().filter(is_candidate).collect();
    let one = |n: &&ModelNumber| FreeParameter::new(&n.path, vec![(*n).clone()], n.value > 0.0, None);
    let mut out: Vec<FreeParameter> = own.iter().filter_map(one).collect();
    let pattern = |n: &ModelNumber| -> Option<String> {
        let (table, rest) = n.path.split_once('.')?;
        let (_, key) = rest.split_once('.')?;
        Some(format!("{table}.*.{key}"))
    };
    for (k, first) in own.iter().enumerate() {
        let Some(name) = pattern(first) else { continue };
        let same = |n: &&&ModelNumber| {
            pattern(n).as_ref() == Some(&name) && n.value == first.value && n.unit == first.unit
        };
        let members: Vec<ModelNumber> = own[k..].iter().filter(same).map(|n| (*n).clone()).collect();
        let every = numbers.iter().filter(|n| pattern(n).as_ref() == Some(&name)).count();
        // Once, at the first of them; the name stands for all items that have the key.
        if members.len() > 1 && members.len() == every {
            out.extend(FreeParameter::new(&name, members, first.value > 0.0, None));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn candidates_are_numbers_of_the_machine_alone_and_together() {
        let place = |path: &str, text: &str| ModelNumber::read(path, text, true).unwrap();
        let numbers = [
            place("model.gravity", "9.8 m/s^2"),
            place("material.steel.young", "207 GPa"),
            place("shaft.element_length", "10 mm"),
            place("housing.A.k_x", "6e6 N/m"),
            place("housing.A.k_y", "9e6 N/m"),
            place("housing.A.c_x", "3 N s/m"),
            place("housing.B.k_x", "6e6 N/m"),
            place("housing.B.k_y", "8e6 N/m"),
            place("housing.B.c_x", "3 N s/m"),
            place("bearing.A.designation", "6205"),
            place("bearing.A.c_xx", "0 N s/m"),
            place("study.frf.speed", "600 rpm"),
        ];
        let names = |free: &[FreeParameter]| -> Vec<String> {
            candidates(&numbers, free).into_iter().map(|p| p.name).collect()
        };
        let free = FreeParameter::new("housing.A.c_x", vec![numbers[5].clone()], true, None).unwrap();
        let single = [
            "material.steel.young",
            "housing.A.k_x",
            "housing.A.k_y",
            "housing.B.k_x",
            "housing.B.k_y",
            "housing.B.c_x",
        ];
        assert_eq!(names(&[free]), [&single[..], &["housing.*.k_x"]].concat());
        let all = names(&[]);
        assert!(all.contains(&"housing.A.c_x".into()) && all.contains(&"housing.*.c_x".into()), "{all:?}");
        assert!(!all.contains(&"housing.*.k_y".into()), "different numbers: {all:?}");
    }

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
