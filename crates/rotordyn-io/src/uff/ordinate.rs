//! Axis data characteristics of set 58: specific data type, unit exponents and labels, to SI and back.

use super::block::Block;
use super::{ParseError, UnitSystem, field};
use crate::measured::unit_label::{self, SiUnit};

/// Record 8 to 11 of set 58: data characteristics of one axis.
pub(super) struct AxisCharacteristics {
    /// 8 displacement, 11 velocity, 12 acceleration, 13 force, 17 time, 18 frequency, 19 rpm, ...
    pub data_type: i64,
    /// Exponents of length and force.
    exponents: [i64; 2],
    /// Unit label as in the file, empty for NONE.
    pub unit_label: String,
}

/// An SI unit with its exponents of length and force.
type Unit = (&'static str, [i64; 2]);

/// Units by specific data type, translational and rotational.
#[rustfmt::skip]
const TYPES: [(i64, Unit, Unit); 11] = [
    (2, ("Pa", [-2, 1]), ("Pa", [-2, 1])), (3, ("1", [0, 0]), ("1", [0, 0])),
    (8, ("m", [1, 0]), ("rad", [0, 0])), (9, ("N", [0, 1]), ("N m", [1, 1])),
    (11, ("m/s", [1, 0]), ("rad/s", [0, 0])), (12, ("m/s^2", [1, 0]), ("rad/s^2", [0, 0])),
    (13, ("N", [0, 1]), ("N m", [1, 1])), (15, ("Pa", [-2, 1]), ("Pa", [-2, 1])),
    (16, ("kg", [-1, 1]), ("m^2 kg", [1, 1])), (17, ("s", [0, 0]), ("s", [0, 0])), (18, ("Hz", [0, 0]), ("Hz", [0, 0])),
];

impl AxisCharacteristics {
    /// Reads `(I10,3I5,2(1X,20A1))`.
    pub fn of(block: &Block, k: usize) -> Result<Self, ParseError> {
        let line = block.record(k)?;
        let [kind, length, force, _, _, _, _, unit] = field::columns(line, [10, 5, 5, 5, 1, 20, 1, 20]);
        let whole = |text: &str| text.parse().unwrap_or(0);
        let unit_label = if unit.eq_ignore_ascii_case("NONE") { String::new() } else { unit };
        Ok(AxisCharacteristics {
            data_type: whole(&kind),
            exponents: [whole(&length), whole(&force)],
            unit_label,
        })
    }

    /// The SI unit with its conversion factors: by the label, else by the type and the file's unit system.
    ///
    /// `None` if neither determines it. A known type without label and unit system is taken as SI.
    pub fn si(&self, rotation: bool, system: Option<UnitSystem>) -> Option<SiUnit> {
        if let Some(known) = unit_label::si(&self.unit_label) {
            return Some(known);
        }
        // With an unknown label, the data type is not trusted either.
        if !self.unit_label.is_empty() && system.is_none() {
            return None;
        }
        let system = system.unwrap_or(super::SI);
        let listed = TYPES.iter().find(|t| t.0 == self.data_type);
        let (name, [length, force]) = match listed {
            Some(&(_, _, rotational)) if rotation => rotational,
            Some(&(_, translational, _)) => translational,
            None if self.data_type == 1 && self.exponents != [0, 0] => match self.exponents {
                [1, 1] => ("N m", [1, 1]),
                [1, 0] => ("m", [1, 0]),
                [0, 1] => ("N", [0, 1]),
                _ => return None,
            },
            None => return None,
        };
        let mut unit = SiUnit { name: name.into(), numerator: 1.0, divisor: 1.0 };
        for (base, power) in [(system.length, length), (system.force, force)] {
            for _ in 0..power.unsigned_abs() {
                if power > 0 {
                    unit.divisor *= base;
                } else {
                    unit.numerator *= base;
                }
            }
        }
        Some(unit)
    }
}

/// Specific data type of an SI unit; 0 if there is none.
pub(super) fn data_type_of(unit: &str) -> i64 {
    match unit {
        "m" | "rad" => 8,
        "m/s" | "rad/s" => 11,
        "m/s^2" | "rad/s^2" => 12,
        "N" | "N m" => 13,
        "Pa" => 15,
        "kg" => 16,
        "K" => 5,
        "s" => 17,
        "Hz" => 18,
        "rpm" => 19,
        _ => 0,
    }
}

/// Axis label of a specific data type.
pub(super) fn axis_label(kind: i64) -> &'static str {
    match kind {
        5 => "Temperature",
        8 => "Displacement",
        11 => "Velocity",
        12 => "Acceleration",
        13 => "Force",
        15 => "Pressure",
        16 => "Mass",
        17 => "Time",
        18 => "Frequency",
        19 => "RPM",
        20 => "Order",
        _ => "NONE",
    }
}

/// "(m/s^2)/N" from a numerator and a denominator.
pub(super) fn ratio(numerator: &str, denominator: &str) -> String {
    let side = |unit: &str| {
        if unit.contains(['/', ' ']) { format!("({unit})") } else { unit.to_owned() }
    };
    match denominator {
        "" | "1" => numerator.to_owned(),
        _ => format!("{}/{}", side(numerator), side(denominator)),
    }
}

/// "(m/s^2)/N" into its numerator and denominator; without one the denominator is empty.
pub(super) fn split_ratio(unit: &str) -> (&str, &str) {
    let mut depth = 0;
    let at = unit.char_indices().rev().find(|(_, c)| {
        depth += i32::from(*c == ')') - i32::from(*c == '(');
        *c == '/' && depth == 0
    });
    let bare = |side: &'_ str| -> usize { usize::from(side.starts_with('(') && side.ends_with(')')) };
    match at {
        None => (unit, ""),
        Some((at, _)) => {
            let (over, under) = (&unit[..at], &unit[at + 1..]);
            let (a, b) = (bare(over), bare(under));
            (&over[a..over.len() - a], &under[b..under.len() - b])
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratio_and_split_ratio_are_inverse() {
        for unit in ["(m/s^2)/N", "m/N", "(rad/s^2)/(N m)", "rad/N"] {
            let (over, under) = split_ratio(unit);
            assert!(!over.starts_with('(') && !under.starts_with('('));
            assert_eq!(ratio(over, under), unit);
        }
        assert_eq!(split_ratio("N"), ("N", ""));
    }
}
