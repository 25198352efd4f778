//! Unit labels of measured files, "g", "mm/s2", "(m/s^2)/N", "gn²/Hz", converted to SI.
//!
//! `g` is the standard acceleration of free fall, never a gram; rpm stays rpm. Products by a space, `*`, `.`
//! or touching brackets, quotients by `/`, powers as `^2`, `**2`, `²`, or digits after the name.

use rotordyn_units as units;

/// A unit's name in SI; a value times `numerator` over `divisor` is in it.
#[derive(Clone, Debug, PartialEq)]
pub struct SiUnit {
    pub name: String,
    pub numerator: f64,
    pub divisor: f64,
}

/// Powers of m, kg, s, rad, V, K.
type Powers = [i32; 6];

const NONE: Powers = [0; 6];

/// Names of SI units by their powers of the base units.
#[rustfmt::skip]
const NAMES: &[(&str, Powers)] = &[
    ("1", NONE), ("m", [1, 0, 0, 0, 0, 0]), ("m/s", [1, 0, -1, 0, 0, 0]), ("m/s^2", [1, 0, -2, 0, 0, 0]),
    ("m/s^3", [1, 0, -3, 0, 0, 0]), ("N", [1, 1, -2, 0, 0, 0]), ("N m", [2, 1, -2, 0, 0, 0]),
    ("Pa", [-1, 1, -2, 0, 0, 0]), ("kg", [0, 1, 0, 0, 0, 0]), ("s", [0, 0, 1, 0, 0, 0]),
    ("rad", [0, 0, 0, 1, 0, 0]), ("rad/s", [0, 0, -1, 1, 0, 0]), ("rad/s^2", [0, 0, -2, 1, 0, 0]),
    ("V", [0, 0, 0, 0, 1, 0]), ("K", [0, 0, 0, 0, 0, 1]), ("Hz", [0, 0, -1, 0, 0, 0]),
    ("N/m", [0, 1, -2, 0, 0, 0]), ("W", [2, 1, -3, 0, 0, 0]),
    ("m/N", [0, -1, 2, 0, 0, 0]), ("(m/s)/N", [0, -1, 1, 0, 0, 0]), ("(m/s^2)/N", [0, -1, 0, 0, 0, 0]),
    ("rad/N", [-1, -1, 2, 1, 0, 0]), ("(rad/s)/N", [-1, -1, 1, 1, 0, 0]), ("(rad/s^2)/N", [-1, -1, 0, 1, 0, 0]),
    ("m/(N m)", [-1, -1, 2, 0, 0, 0]), ("(m/s)/(N m)", [-1, -1, 1, 0, 0, 0]),
    ("(m/s^2)/(N m)", [-1, -1, 0, 0, 0, 0]), ("rad/(N m)", [-2, -1, 2, 1, 0, 0]),
    ("(rad/s)/(N m)", [-2, -1, 1, 1, 0, 0]), ("(rad/s^2)/(N m)", [-2, -1, 0, 1, 0, 0]),
    ("m^2/Hz", [2, 0, 1, 0, 0, 0]), ("(m/s)^2/Hz", [2, 0, -1, 0, 0, 0]), ("(m/s^2)^2/Hz", [2, 0, -3, 0, 0, 0]),
    ("N^2/Hz", [2, 2, -3, 0, 0, 0]), ("Pa^2/Hz", [-2, 2, -3, 0, 0, 0]), ("V^2/Hz", [0, 0, 1, 0, 2, 0]),
    ("(m/s)^2", [2, 0, -2, 0, 0, 0]), ("(m/s^2)^2", [2, 0, -4, 0, 0, 0]), ("N^2", [2, 2, -4, 0, 0, 0]),
    ("N (m/s^2)", [2, 1, -4, 0, 0, 0]), ("(m/s^2)/V", [1, 0, -2, 0, -1, 0]),
];

/// Units of measured signals beyond those of model files, and other spellings: numerator, divisor, powers.
#[rustfmt::skip]
const ADDITIONAL_UNITS: &[(&str, f64, f64, Powers)] = &[
    ("g", 9.80665, 1.0, [1, 0, -2, 0, 0, 0]), ("G", 9.80665, 1.0, [1, 0, -2, 0, 0, 0]),
    ("gn", 9.80665, 1.0, [1, 0, -2, 0, 0, 0]), ("g_n", 9.80665, 1.0, [1, 0, -2, 0, 0, 0]),
    ("mg", 9.80665, 1e3, [1, 0, -2, 0, 0, 0]),
    ("Hz", 1.0, 1.0, [0, 0, -1, 0, 0, 0]), ("kHz", 1e3, 1.0, [0, 0, -1, 0, 0, 0]),
    ("MHz", 1e6, 1.0, [0, 0, -1, 0, 0, 0]),
    ("HZ", 1.0, 1.0, [0, 0, -1, 0, 0, 0]), ("hz", 1.0, 1.0, [0, 0, -1, 0, 0, 0]),
    ("V", 1.0, 1.0, [0, 0, 0, 0, 1, 0]), ("mV", 1.0, 1e3, [0, 0, 0, 0, 1, 0]),
    ("Volt", 1.0, 1.0, [0, 0, 0, 0, 1, 0]), ("volt", 1.0, 1.0, [0, 0, 0, 0, 1, 0]),
    ("K", 1.0, 1.0, [0, 0, 0, 0, 0, 1]), ("W", 1.0, 1.0, [2, 1, -3, 0, 0, 0]), ("J", 1.0, 1.0, [2, 1, -2, 0, 0, 0]),
    ("sec", 1.0, 1.0, [0, 0, 1, 0, 0, 0]), ("Sec", 1.0, 1.0, [0, 0, 1, 0, 0, 0]),
    ("S", 1.0, 1.0, [0, 0, 1, 0, 0, 0]), ("inch", 254.0, 1e4, [1, 0, 0, 0, 0, 0]),
    ("micron", 1.0, 1e6, [1, 0, 0, 0, 0, 0]), ("lbs", 4.4482216152605, 1.0, [1, 1, -2, 0, 0, 0]),
    ("Nm", 1.0, 1.0, [2, 1, -2, 0, 0, 0]), ("bar", 1e5, 1.0, [-1, 1, -2, 0, 0, 0]),
    ("-", 1.0, 1.0, NONE), ("none", 1.0, 1.0, NONE),
];

/// Labels without a mark between metres and seconds: no signal is in squares of milliseconds.
const RUN_TOGETHER: [(&str, &str); 20] = [
    ("ms2", "m/s^2"),
    ("ms^2", "m/s^2"),
    ("ms²", "m/s^2"),
    ("ms-2", "m/s^2"),
    ("ms^-2", "m/s^2"),
    ("ms⁻²", "m/s^2"),
    ("mps2", "m/s^2"),
    ("mss", "m/s^2"),
    ("mms2", "mm/s^2"),
    ("mms^2", "mm/s^2"),
    ("mms-2", "mm/s^2"),
    ("mms⁻²", "mm/s^2"),
    ("mmps2", "mm/s^2"),
    ("ms-1", "m/s"),
    ("ms^-1", "m/s"),
    ("ms⁻¹", "m/s"),
    ("mps", "m/s"),
    ("mms", "mm/s"),
    ("mms-1", "mm/s"),
    ("mmps", "mm/s"),
];

/// Longest label \[bytes\].
const MAX_LABEL: usize = 100;

/// The SI unit of a label; `None` if the label is empty or unknown.
pub fn si(label: &str) -> Option<SiUnit> {
    let label = label.trim();
    // Brackets within each other are read by recursion.
    if label.len() > MAX_LABEL {
        return None;
    }
    if ["rpm", "cpm"].iter().any(|same| label.eq_ignore_ascii_case(same))
        || label == "rev/min"
        || label == "1/min"
    {
        return Some(SiUnit { name: "rpm".into(), numerator: 1.0, divisor: 1.0 });
    }
    let label = RUN_TOGETHER.iter().find(|(written, _)| *written == label).map_or(label, |(_, meant)| meant);
    let mut reader = UnitParser { rest: label };
    let product = reader.product()?;
    if label.is_empty() || !reader.rest.trim().is_empty() {
        return None;
    }
    let name = match NAMES.iter().find(|(_, powers)| *powers == product.powers) {
        Some((name, _)) => (*name).to_owned(),
        None => spell_base_units(product.powers),
    };
    Some(SiUnit { name, numerator: product.numerator, divisor: product.divisor })
}

/// Splits the unit suffix off a column's name, `B_ax_m_s2` to `B_ax` and m/s²; `None` if there is none.
///
/// Parts after the first are divisors, as written by [`crate::csv::Column::header`]; `N_m` is a moment.
pub fn split_unit_suffix(name: &str) -> Option<(&str, SiUnit)> {
    const SUFFIX_UNITS: [&str; 24] = [
        "m", "mm", "um", "nm", "s", "ms", "us", "N", "mN", "kN", "g", "V", "mV", "Pa", "kPa", "MPa", "rad",
        "deg", "Hz", "kHz", "K", "W", "kg", "rpm",
    ];
    if let Some((base, last)) = name.rsplit_once('_')
        && !base.is_empty()
        && RUN_TOGETHER.iter().any(|(written, _)| *written == last)
    {
        return Some((base, si(last)?));
    }
    // The longest unit wins: m_s2 before s2.
    let near = |&at: &usize| at > 0 && name.len() - at <= MAX_LABEL;
    let starts: Vec<usize> = name.match_indices('_').map(|(at, _)| at).filter(near).collect();
    starts.into_iter().find_map(|at| {
        let parts: Vec<&str> = name[at + 1..].split('_').collect();
        let known = |part: &str| {
            let base = part.strip_suffix(['2', '3']);
            SUFFIX_UNITS.contains(&part) || base.is_some_and(|base| SUFFIX_UNITS.contains(&base))
        };
        let moment = parts.ends_with(&["N", "m"]);
        let factors = &parts[..parts.len() - if moment { 2 } else { 0 }];
        let mut joined = String::new();
        for (k, part) in factors.iter().enumerate() {
            joined = match *part {
                part if known(part) && k == 0 => part.to_owned(),
                part if known(part) => format!("{joined}/{part}"),
                // Written for "(m/s^2)^2".
                "2" | "3" if k > 0 => format!("({joined})^{part}"),
                _ => return None,
            };
        }
        if moment {
            joined = if joined.is_empty() { "N m".into() } else { format!("{joined}/(N m)") };
        }
        Some((&name[..at], si(&joined)?))
    })
}

struct Product {
    numerator: f64,
    divisor: f64,
    powers: Powers,
}

/// Parser of a unit label; `rest` is the unread text.
struct UnitParser<'a> {
    rest: &'a str,
}

impl UnitParser<'_> {
    fn product(&mut self) -> Option<Product> {
        let mut sum = Product { numerator: 1.0, divisor: 1.0, powers: NONE };
        let mut divide = false;
        loop {
            self.rest = self.rest.trim_start_matches([' ', '*', '·', '.', '\u{a0}']);
            if self.rest.is_empty() || self.rest.starts_with([')', ']']) {
                return (!divide).then_some(sum);
            }
            if let Some(after) = self.rest.strip_prefix('/') {
                (self.rest, divide) = (after, true);
                continue;
            }
            let factor = self.factor()?;
            let power = if divide { -self.power()? } else { self.power()? };
            for _ in 0..power.unsigned_abs() {
                let (up, down) = match power > 0 {
                    true => (factor.numerator, factor.divisor),
                    false => (factor.divisor, factor.numerator),
                };
                sum.numerator *= up;
                sum.divisor *= down;
            }
            for (total, p) in sum.powers.iter_mut().zip(factor.powers) {
                *total = total.checked_add(power.checked_mul(p)?)?;
            }
            divide = false;
        }
    }

    fn factor(&mut self) -> Option<Product> {
        if let Some(inside) = self.rest.strip_prefix(['(', '[']) {
            self.rest = inside;
            let product = self.product()?;
            self.rest = self.rest.strip_prefix([')', ']'])?;
            return Some(product);
        }
        // A single "1" or "-" is dimensionless.
        for one in ["1", "-"] {
            if let Some(after) = self.rest.strip_prefix(one)
                && !after.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '^' | '²' | '³' | '⁻'))
            {
                self.rest = after;
                return Some(Product { numerator: 1.0, divisor: 1.0, powers: NONE });
            }
        }
        let letter = |c: char| c.is_alphabetic() || matches!(c, '%' | '°' | '_');
        let end = self.rest.find(|c| !letter(c)).unwrap_or(self.rest.len());
        let (name, after) = self.rest.split_at(end);
        self.rest = after;
        let (numerator, divisor, powers) = known_unit(name)?;
        Some(Product { numerator, divisor, powers })
    }

    fn power(&mut self) -> Option<i32> {
        for (mark, power) in [("²", 2), ("³", 3), ("⁻¹", -1), ("⁻²", -2), ("⁻³", -3)] {
            if let Some(after) = self.rest.strip_prefix(mark) {
                self.rest = after;
                return Some(power);
            }
        }
        let marked = self.rest.strip_prefix("**").or(self.rest.strip_prefix('^'));
        let digits = marked.unwrap_or(self.rest);
        let end = digits[usize::from(digits.starts_with('-'))..]
            .find(|c: char| !c.is_ascii_digit())
            .map_or(digits.len(), |at| at + usize::from(digits.starts_with('-')));
        if digits[..end].trim_start_matches('-').is_empty() {
            return marked.is_none().then_some(1);
        }
        self.rest = &digits[end..];
        digits[..end].parse().ok().filter(|power| (-9..=9).contains(power))
    }
}

fn known_unit(name: &str) -> Option<(f64, f64, Powers)> {
    if let Some(unit) = ADDITIONAL_UNITS.iter().find(|unit| unit.0 == name) {
        return Some((unit.1, unit.2, unit.3));
    }
    let (numerator, divisor, [m, kg, s, rad, kelvin]) = units::unit_by_name(name)?;
    Some((numerator, divisor, [m, kg, s, rad, 0, kelvin]))
}

/// "m^2 kg s^-1" for powers without a unit name.
fn spell_base_units(powers: Powers) -> String {
    let factor = |(name, power): (&str, i32)| match power {
        0 => None,
        1 => Some(name.to_string()),
        _ => Some(format!("{name}^{power}")),
    };
    ["m", "kg", "s", "rad", "V", "K"].into_iter().zip(powers).filter_map(factor).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(label: &str, name: &str, factor: f64) {
        let unit = si(label).unwrap_or_else(|| panic!("{label}"));
        assert_eq!(unit.name, name, "{label}");
        assert!((unit.numerator / unit.divisor / factor - 1.0).abs() < 1e-14, "{label}");
    }

    #[test]
    fn labels_of_other_programs() {
        for same in ["m/s^2", "m/s2", "m/s²", "m/s**2", "m s^-2", "m.s-2", "(m/s^2)", "[m/s/s]", "m/sec^2"] {
            check(same, "m/s^2", 1.0);
        }
        check("g", "m/s^2", 9.80665);
        check("g²/Hz", "(m/s^2)^2/Hz", 9.80665_f64.powi(2));
        check("(m/s^2)^2/Hz", "(m/s^2)^2/Hz", 1.0);
        check("g / N", "(m/s^2)/N", 9.80665);
        check("(g)(N)", "N (m/s^2)", 9.80665);
        check("(rad/s^2)/(N m)", "(rad/s^2)/(N m)", 1.0);
        check("mm/s", "m/s", 1e-3);
        check("µm", "m", 1e-6);
        check("lbf/in^2", "Pa", 6_894.757_293_168_361);
        check("deg", "rad", std::f64::consts::TAU / 360.0);
        check("RPM", "rpm", 1.0);
        check("1/s", "Hz", 1.0);
        check("kg m^2", "m^2 kg", 1.0);
        check("N^2", "N^2", 1.0);
        for unknown in ["", "EU", "dB re 1", "m/", "(m", "m^", "m^x", "counts"] {
            assert_eq!(si(unknown), None, "{unknown}");
        }
    }

    #[test]
    fn splits_unit_suffixes_of_names() {
        let behind = |name| split_unit_suffix(name).map(|(name, unit)| (name.to_owned(), unit.name));
        let some = |name: &str, unit: &str| Some((name.to_owned(), unit.to_owned()));
        assert_eq!(behind("B_ax_m_s2"), some("B_ax", "m/s^2"));
        assert_eq!(behind("time_s"), some("time", "s"));
        assert_eq!(behind("speed_rpm"), some("speed", "rpm"));
        assert_eq!(behind("drive_N_m"), some("drive", "N m"));
        assert_eq!(behind("rim_disc_y_m_s2_N"), some("rim_disc_y", "(m/s^2)/N"));
        assert_eq!(behind("twist_rad_s2_N_m"), some("twist", "(rad/s^2)/(N m)"));
        assert_eq!(behind("density_m_s2_2_Hz"), some("density", "(m/s^2)^2/Hz"));
        assert_eq!(behind("channel_2_m_s2"), some("channel_2", "m/s^2"));
        assert_eq!(behind("X105_DE_time"), None);
        assert_eq!(behind("A_ax"), None);
        assert_eq!(behind("s"), None);
    }
}
