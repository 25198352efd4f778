//! Quantities as text, "60 um" or "3000 rpm", to plain SI numbers; for model files, and for labels of measured ones.
//!
//! A unit is a product of names with integer powers: factors are joined by a space, `*` or `·`, a `/` divides by
//! the one factor behind it, powers are written `^2`, `²` or `³`: `N m/rad`, `kg m^2`, `m/s²`, `kg/m^3`, `1/s`.
//! Conversions are stored as divisors (60 um is 60/10⁶ m, the double nearest to 60e-6) and powers of 2π
//! (turns) separately, so that 50 Hz is exactly 50 as a frequency and 2π·50 rad/s as a speed.
//!
//! Decisions: a speed takes rpm, rad/s, deg/s, rev/s and Hz (turns per second); a frequency takes the same and is
//! a number of Hz; `1/s` is neither. Of both, `1/min`, `min^-1`, `r/min`, `U/min` and `RPM` are rpm. `lb` is a mass, `lbf` a force. Rotational stiffness may be written with or
//! without `/rad`. A dimensionless number may be written without unit or in per cent. `degC` is accepted for
//! a temperature only, and not in products; temperature differences and quantities per degree take K.

pub mod names;

use std::f64::consts::TAU;

/// Physical dimension of a quantity, with its name, SI unit and an example for messages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimension {
    /// Name for messages: "length".
    pub name: &'static str,
    /// SI unit: "m".
    pub unit: &'static str,
    /// Well-written example: "30 mm".
    pub example: &'static str,
    /// Powers of metre, kilogram, second.
    base: [i32; 3],
    angle: Angle,
    /// Power of the kelvin.
    kelvin: i32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Angle {
    /// Power of the radian that is required.
    Power(i32),
    /// `/rad` may be written or not.
    Free,
    /// A number of whole turns per second: Hz.
    Turns,
}

const fn dimension(
    name: &'static str,
    unit: &'static str,
    example: &'static str,
    base: [i32; 3],
    angle: Angle,
) -> Dimension {
    Dimension { name, unit, example, base, angle, kelvin: 0 }
}

const fn thermal(name: &'static str, unit: &'static str, example: &'static str, kelvin: i32) -> Dimension {
    Dimension { name, unit, example, base: [0; 3], angle: Angle::Power(0), kelvin }
}

pub const LENGTH: Dimension = dimension("length", "m", "30 mm", [1, 0, 0], Angle::Power(0));
pub const MASS: Dimension = dimension("mass", "kg", "1.5 kg", [0, 1, 0], Angle::Power(0));
pub const TIME: Dimension = dimension("time", "s", "10 s", [0, 0, 1], Angle::Power(0));
pub const RATE: Dimension = dimension("rate", "1/s", "0.5 1/s", [0, 0, -1], Angle::Power(0));
pub const INERTIA: Dimension =
    dimension("moment of inertia", "kg m^2", "0.003 kg m^2", [2, 1, 0], Angle::Power(0));
pub const DENSITY: Dimension = dimension("density", "kg/m^3", "7850 kg/m^3", [-3, 1, 0], Angle::Power(0));
pub const PRESSURE: Dimension =
    dimension("pressure or modulus", "Pa", "207 GPa", [-1, 1, -2], Angle::Power(0));
pub const FORCE: Dimension = dimension("force", "N", "250 N", [1, 1, -2], Angle::Power(0));
pub const MOMENT: Dimension = dimension("moment", "N m", "12 N m", [2, 1, -2], Angle::Power(0));
pub const ACCELERATION: Dimension =
    dimension("acceleration", "m/s^2", "9.80665 m/s^2", [1, 0, -2], Angle::Power(0));
pub const UNBALANCE: Dimension = dimension("unbalance", "kg m", "560 g mm", [1, 1, 0], Angle::Power(0));
pub const ANGLE: Dimension = dimension("angle", "rad", "12 deg", [0, 0, 0], Angle::Power(1));
pub const SPEED: Dimension = dimension("speed of rotation", "rad/s", "1200 rpm", [0, 0, -1], Angle::Power(1));
pub const FREQUENCY: Dimension = dimension("frequency", "Hz", "46 Hz", [0, 0, -1], Angle::Turns);
pub const STIFFNESS: Dimension = dimension("stiffness", "N/m", "6e6 N/m", [0, 1, -2], Angle::Power(0));
pub const CROSS_STIFFNESS: Dimension =
    dimension("stiffness between translation and tilt", "N/rad", "1e4 N/rad", [1, 1, -2], Angle::Free);
pub const TILT_STIFFNESS: Dimension =
    dimension("rotational stiffness", "N m/rad", "1e5 N m/rad", [2, 1, -2], Angle::Free);
pub const DAMPING: Dimension = dimension("damping", "N s/m", "300 N s/m", [0, 1, -1], Angle::Power(0));
pub const CROSS_DAMPING: Dimension =
    dimension("damping between translation and tilt", "N s/rad", "10 N s/rad", [1, 1, -1], Angle::Free);
pub const TILT_DAMPING: Dimension =
    dimension("rotational damping", "N m s/rad", "0.3 N m s/rad", [2, 1, -1], Angle::Free);
pub const VISCOSITY: Dimension =
    dimension("dynamic viscosity", "Pa s", "0.04 Pa s", [-1, 1, -1], Angle::Power(0));
pub const PRESSURE_VISCOSITY: Dimension =
    dimension("pressure-viscosity coefficient", "1/Pa", "2.2e-8 1/Pa", [1, -1, 2], Angle::Power(0));
pub const VELOCITY: Dimension = dimension("velocity", "m/s", "2 m/s", [1, 0, -1], Angle::Power(0));
pub const INVERSE_SPEED: Dimension =
    dimension("damping per speed of approach", "s/m", "0.1 s/m", [-1, 0, 1], Angle::Power(0));
/// A temperature on its scale; `degC` is shifted to kelvins.
pub const TEMPERATURE: Dimension = thermal("temperature", "K", "40 degC", 1);
pub const TEMPERATURE_DIFFERENCE: Dimension = thermal("temperature difference", "K", "30 K", 1);
pub const EXPANSION: Dimension = thermal("coefficient of thermal expansion", "1/K", "12e-6 1/K", -1);
pub const NUMBER: Dimension = dimension("number", "", "0.5", [0, 0, 0], Angle::Power(0));

/// Why a text is not a quantity of the expected dimension.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UnitError {
    #[error("`{0}` does not start with a number")]
    NoNumber(String),
    #[error("{0} has no unit")]
    NoUnit(String),
    #[error("{0} is not a finite number")]
    NotFinite(String),
    #[error("unknown unit `{0}`")]
    UnknownUnit(String),
    #[error("`{0}` is not a power of a unit")]
    BadPower(String),
    #[error("`{unit}` is a unit of {found}, not of {expected}")]
    WrongDimension { unit: String, found: String, expected: &'static str },
    #[error("`{0}` is a point on a temperature scale, not a temperature difference")]
    ScaleOfTemperature(String),
    #[error("{found} values where {expected} are expected")]
    WrongCount { found: usize, expected: usize },
}

/// Every known unit name, with its scale (numerator, divisor), power of 2π, and powers of m, kg, s, rad, K.
#[rustfmt::skip]
const UNITS: &[(&str, f64, f64, i32, [i32; 5])] = &[
    ("1", 1.0, 1.0, 0, [0; 5]), ("%", 1.0, 100.0, 0, [0; 5]),
    ("m", 1.0, 1.0, 0, [1, 0, 0, 0, 0]), ("cm", 1.0, 100.0, 0, [1, 0, 0, 0, 0]),
    ("mm", 1.0, 1e3, 0, [1, 0, 0, 0, 0]),
    ("um", 1.0, 1e6, 0, [1, 0, 0, 0, 0]), ("µm", 1.0, 1e6, 0, [1, 0, 0, 0, 0]),
    ("μm", 1.0, 1e6, 0, [1, 0, 0, 0, 0]),
    ("nm", 1.0, 1e9, 0, [1, 0, 0, 0, 0]), ("in", 254.0, 1e4, 0, [1, 0, 0, 0, 0]),
    ("inch", 254.0, 1e4, 0, [1, 0, 0, 0, 0]), ("micron", 1.0, 1e6, 0, [1, 0, 0, 0, 0]),
    ("ft", 3048.0, 1e4, 0, [1, 0, 0, 0, 0]),
    ("mil", 254.0, 1e7, 0, [1, 0, 0, 0, 0]),
    ("kg", 1.0, 1.0, 0, [0, 1, 0, 0, 0]), ("g", 1.0, 1e3, 0, [0, 1, 0, 0, 0]),
    ("mg", 1.0, 1e6, 0, [0, 1, 0, 0, 0]),
    ("t", 1e3, 1.0, 0, [0, 1, 0, 0, 0]), ("lb", 45_359_237.0, 1e8, 0, [0, 1, 0, 0, 0]),
    ("oz", 45_359_237.0, 16e8, 0, [0, 1, 0, 0, 0]),
    ("s", 1.0, 1.0, 0, [0, 0, 1, 0, 0]), ("ms", 1.0, 1e3, 0, [0, 0, 1, 0, 0]),
    ("us", 1.0, 1e6, 0, [0, 0, 1, 0, 0]),
    ("µs", 1.0, 1e6, 0, [0, 0, 1, 0, 0]), ("min", 60.0, 1.0, 0, [0, 0, 1, 0, 0]),
    ("h", 3600.0, 1.0, 0, [0, 0, 1, 0, 0]),
    ("rad", 1.0, 1.0, 0, [0, 0, 0, 1, 0]), ("mrad", 1.0, 1e3, 0, [0, 0, 0, 1, 0]),
    ("urad", 1.0, 1e6, 0, [0, 0, 0, 1, 0]),
    ("deg", 1.0, 360.0, 1, [0, 0, 0, 1, 0]), ("°", 1.0, 360.0, 1, [0, 0, 0, 1, 0]),
    ("rev", 1.0, 1.0, 1, [0, 0, 0, 1, 0]),
    ("rpm", 1.0, 60.0, 1, [0, 0, -1, 1, 0]), ("Hz", 1.0, 1.0, 1, [0, 0, -1, 1, 0]),
    ("kHz", 1e3, 1.0, 1, [0, 0, -1, 1, 0]), ("krpm", 1e3, 60.0, 1, [0, 0, -1, 1, 0]),
    ("N", 1.0, 1.0, 0, [1, 1, -2, 0, 0]), ("mN", 1.0, 1e3, 0, [1, 1, -2, 0, 0]),
    ("kN", 1e3, 1.0, 0, [1, 1, -2, 0, 0]),
    ("MN", 1e6, 1.0, 0, [1, 1, -2, 0, 0]), ("lbf", 4.4482216152605, 1.0, 0, [1, 1, -2, 0, 0]),
    ("Pa", 1.0, 1.0, 0, [-1, 1, -2, 0, 0]), ("kPa", 1e3, 1.0, 0, [-1, 1, -2, 0, 0]),
    ("MPa", 1e6, 1.0, 0, [-1, 1, -2, 0, 0]), ("GPa", 1e9, 1.0, 0, [-1, 1, -2, 0, 0]),
    ("mPa", 1.0, 1e3, 0, [-1, 1, -2, 0, 0]), ("P", 1.0, 10.0, 0, [-1, 1, -1, 0, 0]),
    ("cP", 1.0, 1e3, 0, [-1, 1, -1, 0, 0]), ("K", 1.0, 1.0, 0, [0, 0, 0, 0, 1]),
    ("psi", 4.4482216152605e8, 64516.0, 0, [-1, 1, -2, 0, 0]),
    ("ksi", 4.4482216152605e11, 64516.0, 0, [-1, 1, -2, 0, 0]),
    ("bar", 1e5, 1.0, 0, [-1, 1, -2, 0, 0]), ("kgf", 9.80665, 1.0, 0, [1, 1, -2, 0, 0]),
];

/// Other names of rpm, of a speed or a frequency only.
const PER_MINUTE: [&str; 7] = ["RPM", "1/min", "/min", "min^-1", "min⁻¹", "r/min", "U/min"];

/// Names of the only unit with an offset.
const CELSIUS: [&str; 2] = ["degC", "°C"];
/// 0 °C \[K\].
const ZERO_CELSIUS: f64 = 273.15;

/// Names of every unit that [`parse`] knows.
pub fn unit_names() -> impl Iterator<Item = &'static str> {
    UNITS.iter().map(|unit| unit.0).chain(CELSIUS)
}

/// Size of a named unit in SI and its powers of m, kg, s, rad, K: value · numerator / divisor is in SI.
pub fn unit_by_name(name: &str) -> Option<(f64, f64, [i32; 5])> {
    let unit = UNITS.iter().find(|unit| unit.0 == name)?;
    Some((unit.1 * TAU.powi(unit.3), unit.2, unit.4))
}

/// The unit that a bare number most likely lacks, by the usual size of such quantities in rotating machines: 3000 is a
/// speed in rpm, 25 a length in mm, 207 a modulus in GPa. `name` is what the quantity is called.
pub fn likely_unit(dimension: Dimension, value: f64, name: &str) -> &'static str {
    let size = value.abs();
    let micrometres = ["clearance", "interference", "growth", "roughness", "ramp"];
    match dimension {
        LENGTH if micrometres.iter().any(|part| name.contains(part)) && size >= 0.1 => "um",
        LENGTH if size >= 0.5 => "mm",
        SPEED if size >= 10.0 => "rpm",
        ANGLE if size > TAU => "deg",
        PRESSURE if (10.0..1e3).contains(&size) => "GPa",
        PRESSURE if (1e3..1e6).contains(&size) => "MPa",
        TEMPERATURE if size < 200.0 => "degC",
        UNBALANCE if size >= 1.0 => "g mm",
        TIME if size >= 50.0 => "us",
        other => other.unit,
    }
}

/// Product of units: value · numerator / divisor · (2π)^turns is in SI.
struct Scale {
    numerator: f64,
    divisor: f64,
    turns: i32,
    powers: [i32; 5],
}

/// Read one quantity, such as `"60 um"`, as a number in SI units (Hz for a frequency).
///
/// # Errors
/// What is missing or wrong; infinities and NaN are rejected.
pub fn parse(text: &str, dimension: Dimension) -> Result<f64, UnitError> {
    let values = parse_list(text, dimension)?;
    match values[..] {
        [value] => Ok(value),
        _ => Err(UnitError::WrongCount { found: values.len(), expected: 1 }),
    }
}

/// Read several numbers followed by one unit, such as `"0, 600, 1200 rpm"`; commas are optional.
///
/// # Errors
/// As [`parse`]. A list that is returned is never empty.
pub fn parse_list(text: &str, dimension: Dimension) -> Result<Vec<f64>, UnitError> {
    let mut values = Vec::new();
    let mut rest = text.trim();
    let mut after_a_comma = false;
    while let Some((value, length)) = leading_number(rest) {
        if !value.is_finite() {
            return Err(UnitError::NotFinite(rest[..length].into()));
        }
        // the 1 of "5 1/s" belongs to the unit, those of "5, 1/s" and "1 /s" are values
        let of_unit = &rest[..length] == "1" && rest[length..].trim_start().starts_with('/');
        if of_unit && !values.is_empty() && !after_a_comma {
            break;
        }
        values.push(value);
        rest = rest[length..].trim_start();
        after_a_comma = rest.starts_with(',');
        rest = rest.strip_prefix(',').unwrap_or(rest).trim_start();
    }
    let unit = match rest.trim_end() {
        turns if is_rate_of_turns(dimension) && is_per_minute(turns) => "rpm",
        unit => unit,
    };
    if values.is_empty() {
        let word = unit.trim_start_matches(['+', '-']).to_ascii_lowercase();
        let not_finite = ["nan", "inf"].iter().any(|w| word.starts_with(w));
        return Err(if not_finite {
            UnitError::NotFinite(unit.into())
        } else {
            UnitError::NoNumber(unit.into())
        });
    }
    if unit.is_empty() && dimension != NUMBER {
        return Err(UnitError::NoUnit(text.trim().into()));
    }
    if CELSIUS.contains(&unit) {
        values.iter_mut().for_each(|value| *value += ZERO_CELSIUS);
        return match dimension {
            TEMPERATURE => Ok(values),
            _ if dimension.kelvin != 0 => Err(UnitError::ScaleOfTemperature(unit.into())),
            _ => Err(UnitError::WrongDimension {
                unit: unit.into(),
                found: TEMPERATURE.name.into(),
                expected: dimension.name,
            }),
        };
    }
    let scale = parse_unit(unit)?;
    let angle_fits = match dimension.angle {
        Angle::Power(power) => scale.powers[3] == power,
        Angle::Free => scale.powers[3] <= 0,
        Angle::Turns => scale.powers[3] == 1,
    };
    if scale.powers[..3] != dimension.base || scale.powers[4] != dimension.kelvin || !angle_fits {
        let found = dimension_name(scale.powers);
        return Err(UnitError::WrongDimension { unit: unit.into(), found, expected: dimension.name });
    }
    let turns = scale.turns - i32::from(dimension.angle == Angle::Turns);
    for value in &mut values {
        *value = *value * scale.numerator / scale.divisor;
        if dimension.angle == Angle::Turns || turns != 0 {
            *value *= TAU.powi(turns);
        }
        if !value.is_finite() {
            return Err(UnitError::NotFinite(text.trim().into()));
        }
    }
    Ok(values)
}

/// Whether a quantity counts turns in a time.
fn is_rate_of_turns(dimension: Dimension) -> bool {
    dimension == SPEED || dimension.angle == Angle::Turns
}

/// Whether a unit is another name of rpm where turns are counted; nothing else turns per minute.
fn is_per_minute(unit: &str) -> bool {
    let plain: String = unit.split_whitespace().collect();
    PER_MINUTE.contains(&plain.as_str())
}

/// Number at the start of a text, and its length in bytes.
pub fn leading_number(text: &str) -> Option<(f64, usize)> {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut end = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let whole = digits(end);
    end += whole;
    let mut fraction = 0;
    if bytes.get(end) == Some(&b'.') {
        fraction = digits(end + 1);
        end += 1 + fraction;
    }
    if whole + fraction == 0 {
        return None;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        let exponent = digits((end + 1 + sign).min(bytes.len()));
        if exponent > 0 {
            end += 1 + sign + exponent;
        }
    }
    text[..end].parse().ok().map(|value| (value, end))
}

fn parse_unit(text: &str) -> Result<Scale, UnitError> {
    let mut scale = Scale { numerator: 1.0, divisor: 1.0, turns: 0, powers: [0; 5] };
    let mut divide = false;
    let mut rest = text;
    loop {
        rest = rest.trim_start_matches([' ', '*', '·', '\t']);
        if let Some(after) = rest.strip_prefix('/') {
            divide = true;
            rest = after.trim_start();
        }
        if rest.is_empty() {
            return if divide { Err(UnitError::UnknownUnit(text.into())) } else { Ok(scale) };
        }
        let end = rest.find([' ', '*', '·', '/', '\t']).unwrap_or(rest.len());
        let (factor, after) = rest.split_at(end);
        rest = after;
        let (name, power) = split_power(factor)?;
        if CELSIUS.contains(&name) {
            return Err(UnitError::ScaleOfTemperature(name.into()));
        }
        let &(_, numerator, divisor, turns, powers) =
            UNITS.iter().find(|unit| unit.0 == name).ok_or_else(|| UnitError::UnknownUnit(name.into()))?;
        let power = if divide { -power } else { power };
        for _ in 0..power.unsigned_abs() {
            let (up, down) = if power > 0 { (numerator, divisor) } else { (divisor, numerator) };
            scale.numerator *= up;
            scale.divisor *= down;
        }
        scale.turns += power * turns;
        for (sum, p) in scale.powers.iter_mut().zip(powers) {
            *sum += power * p;
        }
        divide = false;
    }
}

/// `"m^2"` to `("m", 2)`.
fn split_power(factor: &str) -> Result<(&str, i32), UnitError> {
    if let Some((name, power)) = factor.split_once('^') {
        return match power.parse() {
            Ok(power) if (-9..=9).contains(&power) => Ok((name, power)),
            _ => Err(UnitError::BadPower(factor.into())),
        };
    }
    for (mark, power) in [('²', 2), ('³', 3)] {
        if let Some(name) = factor.strip_suffix(mark) {
            return Ok((name, power));
        }
    }
    Ok((factor, 1))
}

/// Name of a dimension by its powers, or the powers themselves.
fn dimension_name(powers: [i32; 5]) -> String {
    const KNOWN: [Dimension; 23] = [
        LENGTH,
        MASS,
        TIME,
        RATE,
        INERTIA,
        DENSITY,
        PRESSURE,
        FORCE,
        MOMENT,
        ACCELERATION,
        UNBALANCE,
        ANGLE,
        STIFFNESS,
        DAMPING,
        TILT_STIFFNESS,
        TILT_DAMPING,
        VISCOSITY,
        PRESSURE_VISCOSITY,
        INVERSE_SPEED,
        VELOCITY,
        TEMPERATURE_DIFFERENCE,
        EXPANSION,
        NUMBER,
    ];
    let angle_fits = |angle: Angle| match angle {
        Angle::Power(power) => powers[3] == power,
        Angle::Free | Angle::Turns => true,
    };
    if powers == [0, 0, -1, 1, 0] {
        return "speed of rotation or frequency".into();
    }
    if let Some(known) =
        KNOWN.iter().find(|d| d.base == powers[..3] && d.kelvin == powers[4] && angle_fits(d.angle))
    {
        return known.name.into();
    }
    let factor = |(name, power): (&str, i32)| match power {
        0 => None,
        1 => Some(name.to_string()),
        _ => Some(format!("{name}^{power}")),
    };
    ["m", "kg", "s", "rad", "K"].into_iter().zip(powers).filter_map(factor).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests;
