//! The unit at the end of a channel's name: "acc [g]", "v / mm/s", "Weg in mm", "acc, g", "Vel mm/s", "x_um".

use super::axis_names::{Role, meaning};
use super::unit_label::{self, SiUnit};

/// Longest name that is searched for a unit \[bytes\].
const MAX_NAME: usize = 200;

const ALL_ROLES: [Role; 6] =
    [Role::Rate, Role::Step, Role::Start, Role::Count, Role::Times, Role::Frequencies];

/// Units that behind a blank mean something else: directions, ends and limits ("Sensor rad", "Pump in", "Value min").
const WORDS: [&str; 7] = ["in", "min", "rad", "rev", "none", "kg", "sec"];

/// A name, its unit as written, and that unit if it is known. `None` for a name without a unit.
///
/// A unit in brackets at the end is one even if it is not known; others are known ones.
pub(crate) fn split(name: &str) -> Option<(&str, &str, Option<SiUnit>)> {
    if name.len() > MAX_NAME {
        return None;
    }
    if let Some(found) = in_brackets(name) {
        return Some(found);
    }
    // A column that is named by its unit alone.
    if name.contains(['/', '^', '²'])
        && !name.starts_with('/')
        && let Some(si) = unit_label::si(name)
    {
        return Some((name, name, Some(si)));
    }
    // The longest unit wins: "m/s^2" before "s^2".
    for (at, mark) in name.match_indices([' ', '/', ',', '_']) {
        let (base, behind) = (name[..at].trim_end_matches([' ', ',', '/', ':']), &name[at + 1..]);
        if base.is_empty() {
            continue;
        }
        if mark == " "
            && let Some(unit) = behind.strip_prefix("in ")
        {
            if let Some(si) = of_text(unit.trim()) {
                return Some((base, unit.trim(), Some(si)));
            }
            continue;
        }
        let unit = behind.trim();
        let fits = |si: &SiUnit| match mark {
            // "a / m/s²" and "a/g", as ISO 80000-1 has it, but not the last part of a path.
            "/" => !name[..at].contains('/'),
            // Not directions: "DE, V".
            "," => unit == "g" || unit.chars().count() > 1,
            "_" => is_composed(unit),
            _ => is_composed(unit) || is_word(base, unit, si),
        };
        if let Some(si) = of_text(unit).filter(fits) {
            return Some((base, unit, Some(si)));
        }
    }
    let (base, si) = unit_label::split_unit_suffix(name)?;
    Some((base, &name[base.len() + 1..], Some(si)))
}

/// The unit of a text that has a letter of it first, or "1/" before.
fn of_text(unit: &str) -> Option<SiUnit> {
    let first = unit.strip_prefix("1/").unwrap_or(unit).chars().next()?;
    (first.is_alphabetic() || matches!(first, '°' | '%' | '(' | '[')).then(|| unit_label::si(unit)).flatten()
}

/// Whether a unit is no single word, which may be part of the name.
fn is_composed(unit: &str) -> bool {
    unit.contains(['/', '^', '²', '*', '·'])
}

/// Whether a single word behind a blank is the unit: "Weg mm", "acc g", "Time s", but not "Sensor V" (vertical).
fn is_word(base: &str, unit: &str, si: &SiUnit) -> bool {
    if let Some(meaning) = meaning(base, &ALL_ROLES) {
        return meaning.role.factor(si).is_some();
    }
    let is_bare = unit.chars().all(|c| c.is_alphabetic() || c == '°' || c == '%');
    !WORDS.contains(&unit)
        && (unit == "g" || unit.chars().count() > 1 && (is_bare || unit.ends_with(['2', '3'])))
}

/// A unit in brackets at the end of a name.
fn in_brackets(name: &str) -> Option<(&str, &str, Option<SiUnit>)> {
    let close = name.chars().next_back().filter(|c| matches!(c, ']' | ')'))?;
    let open = if close == ']' { '[' } else { '(' };
    let mut depth = 0;
    // The bracket that belongs to the last one.
    let at = name.char_indices().rev().find_map(|(at, c)| {
        depth += i32::from(c == close) - i32::from(c == open);
        (depth == 0).then_some(at)
    })?;
    let (base, stated) =
        (name[..at].trim().trim_end_matches(['/', ',', '_']).trim(), &name[at + 1..name.len() - 1]);
    (!base.is_empty()).then(|| (base, stated, unit_label::si(stated)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(name: &str) -> Option<(String, Option<(String, f64)>)> {
        let (base, _, si) = split(name)?;
        Some((base.into(), si.map(|si| (si.name, si.numerator / si.divisor))))
    }

    #[test]
    fn units_at_the_end_of_names() {
        for (name, base, unit, factor) in [
            ("Acc m/s^2", "Acc", "m/s^2", 1.0),
            ("a in m/s²", "a", "m/s^2", 1.0),
            ("v in mm/s", "v", "m/s", 1e-3),
            ("Vel mm/s", "Vel", "m/s", 1e-3),
            ("Acc DE m/s²", "Acc DE", "m/s^2", 1.0),
            ("Acc (m/s^2)", "Acc", "m/s^2", 1.0),
            ("Acc [DE] [g]", "Acc [DE]", "m/s^2", 9.80665),
            ("v/(mm/s)", "v", "m/s", 1e-3),
            ("v / mm/s", "v", "m/s", 1e-3),
            ("a/g", "a", "m/s^2", 9.80665),
            ("PSD ((m/s^2)^2/Hz)", "PSD", "(m/s^2)^2/Hz", 1.0),
            ("acc, g", "acc", "m/s^2", 9.80665),
            ("x, um", "x", "m", 1e-6),
            ("acc_g", "acc", "m/s^2", 9.80665),
            ("ch1 g", "ch1", "m/s^2", 9.80665),
            ("Weg mm", "Weg", "m", 1e-3),
            ("acc_m/s^2", "acc", "m/s^2", 1.0),
            ("acc_ms2", "acc", "m/s^2", 1.0),
            ("acc_mms2", "acc", "m/s^2", 1e-3),
            ("vib_mms", "vib", "m/s", 1e-3),
            ("acc [ms-2]", "acc", "m/s^2", 1.0),
            ("acc [m s⁻²]", "acc", "m/s^2", 1.0),
            ("v [in/s]", "v", "m/s", 0.0254),
            ("v in/s", "v", "m/s", 0.0254),
            ("m/s²", "m/s²", "m/s^2", 1.0),
            ("Time s", "Time", "s", 1.0),
            ("Zeit in ms", "Zeit", "s", 1e-3),
            ("Drehzahl 1/min", "Drehzahl", "rpm", 1.0),
            ("B_ax_m_s2", "B_ax", "m/s^2", 1.0),
        ] {
            let Some((of, Some((si, by)))) = found(name) else { panic!("{name}: {:?}", found(name)) };
            assert_eq!((of.as_str(), si.as_str()), (base, unit), "{name}");
            assert!((by / factor - 1.0).abs() < 1e-12, "{name}: {by}");
        }
    }

    #[test]
    fn names_without_a_known_unit() {
        for name in [
            "DE/x",
            "rotor/disc_y",
            "Channel 1",
            "Sensor V",
            "Sensor G",
            "DE V",
            "Pump in",
            "Value min",
            "acc -",
            "Probe rad",
            "rig/bearing/s",
            "x",
            "g",
            "/s",
            "Acc (m/s²)_filtered",
            "a in g/1000",
            "Acc [g] DE",
            "Fan DE/1",
        ] {
            assert_eq!(found(name), None, "{name}");
        }
        // Unknown units are kept as written, and scale nothing.
        for (name, base) in [("x (um pk)", "x"), ("acc [10^-3 g]", "acc"), ("acc [g/1000]", "acc")] {
            assert_eq!(found(name), Some((base.into(), None)), "{name}");
        }
    }
}
