//! Changes numbers of a model file in place; comments, order, layout and units are preserved.

use toml_edit::{DocumentMut, Item, Table, TableLike, Value};

use rotordyn_units::leading_number;

/// A number to change.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// Such as "housing.B.k_x".
    pub path: String,
    /// New value, in the unit used in the file.
    pub value: f64,
    /// Its standard error, which determines the number of digits.
    pub error: f64,
}

/// The file's text with changed numbers.
///
/// With a variant, the variant's own value is changed if present (else that of the variant it is based on,
/// else that of the base model).
///
/// # Errors
/// A path without a number in the file, by its name.
pub fn rewrite(text: &str, variant: Option<&str>, changes: &[Change]) -> Result<String, String> {
    let (mark, body) = match text.strip_prefix('\u{feff}') {
        Some(body) => ("\u{feff}", body),
        None => ("", text),
    };
    let mut document: DocumentMut = body.parse().map_err(|e: toml_edit::TomlError| e.to_string())?;
    let chain = variant_chain(&document, variant);
    for change in changes {
        let mut prefixes: Vec<String> = chain.iter().map(|name| format!("variant.{name}.")).collect();
        prefixes.push(String::new());
        let done = prefixes.iter().any(|prefix| {
            let path = format!("{prefix}{}", change.path);
            let parts: Vec<&str> = path.split('.').collect();
            in_table(document.as_table_mut(), &parts).is_some_and(|value| replace_number(value, change))
        });
        if !done {
            return Err(format!("the file states no number at {}", change.path));
        }
    }
    Ok(format!("{mark}{document}"))
}

/// A variant and those it is based on, nearest first.
fn variant_chain(document: &DocumentMut, variant: Option<&str>) -> Vec<String> {
    let mut chain: Vec<String> = Vec::new();
    let mut next = variant.map(String::from);
    while let Some(name) = next.take().filter(|name| !chain.contains(name)) {
        let table = document.get("variant").and_then(|v| v.get(&name));
        next = table.and_then(|t| t.get("based_on")).and_then(Item::as_str).map(String::from);
        chain.push(name);
    }
    chain
}

fn in_table<'a>(table: &'a mut dyn TableLike, parts: &[&str]) -> Option<&'a mut Value> {
    let (first, rest) = parts.split_first()?;
    in_item(table.get_mut(first)?, rest)
}

fn in_item<'a>(item: &'a mut Item, parts: &[&str]) -> Option<&'a mut Value> {
    match item {
        Item::Table(table) => in_table(table, parts),
        Item::ArrayOfTables(tables) => {
            let (first, rest) = parts.split_first()?;
            let table: &mut Table = tables.get_mut(first.parse().ok()?)?;
            in_table(table, rest)
        }
        Item::Value(value) => in_value(value, parts),
        Item::None => None,
    }
}

fn in_value<'a>(value: &'a mut Value, parts: &[&str]) -> Option<&'a mut Value> {
    let Some((first, rest)) = parts.split_first() else { return Some(value) };
    match value {
        Value::Array(items) => in_value(items.get_mut(first.parse().ok()?)?, rest),
        Value::InlineTable(table) => in_value(table.get_mut(first)?, rest),
        _ => None,
    }
}

/// Replaces the number and keeps the text around it; false if there is none.
fn replace_number(value: &mut Value, change: &Change) -> bool {
    let old = match value {
        Value::String(text) => text.value().trim_start().to_string(),
        Value::Integer(i) => i.value().to_string(),
        Value::Float(f) => f.display_repr().into_owned(),
        _ => return false,
    };
    let Some((_, length)) = leading_number(&old) else { return false };
    let number = format_like(&old[..length], change.value, change.error);
    let new = match value {
        Value::String(_) => Value::from(format!("{number}{}", &old[length..])),
        // A number without point or exponent would become an integer, which reads the same.
        _ => match number.parse::<Value>() {
            Ok(new) => new,
            Err(_) => return false,
        },
    };
    let decor = value.decor().clone();
    *value = new;
    *value.decor_mut() = decor;
    true
}

/// Formats a value with digits to a hundredth of its error, at least those of `like`, with an exponent if
/// `like` has one.
pub fn format_like(like: &str, value: f64, error: f64) -> String {
    let mantissa = like.split(['e', 'E']).next().unwrap_or(like);
    let given =
        mantissa.trim_start_matches(['+', '-', '0', '.']).chars().filter(char::is_ascii_digit).count();
    let digits_of_error = if error > 0.0 { (value.abs() / error).log10().floor() + 3.0 } else { 6.0 };
    let digits = (digits_of_error.clamp(3.0, 12.0) as usize).max(given);
    let trimmed = |number: &str| -> String {
        if number.contains('.') {
            number.trim_end_matches('0').trim_end_matches('.').into()
        } else {
            number.into()
        }
    };
    if like.contains(['e', 'E']) {
        let text = format!("{value:.*e}", digits - 1);
        return match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
            None => text,
        };
    }
    let size = if value == 0.0 { 0.0 } else { value.abs().log10().floor() };
    let decimals = (digits as f64 - 1.0 - size).max(0.0) as usize;
    trimmed(&format!("{value:.decimals$}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "# my rig\n[housing.B]   # near the disc\nk_x = \"6e6 N/m\"  # guessed\nk_y=\"15000 N/mm\"\n\
        [belt]\ndrive = { k_x = \"4e5 N/m\", ratio = 0.50 } # belt\n[[shaft.section]]\nlength = \"625 mm\"\n\
        [variant.soft]\nbased_on = \"base2\"\n[variant.base2]\nhousing.B.k_x = '5e6 N/m'\n";

    fn change(path: &str, value: f64) -> Change {
        Change { path: path.into(), value, error: 1e-3 * value }
    }

    #[test]
    fn only_the_numbers_change() {
        let changes = [
            change("housing.B.k_x", 4_195_091.234),
            change("housing.B.k_y", 20_934.876_5),
            change("belt.drive.k_x", 3.0635e5),
            change("belt.drive.ratio", 0.333_333_3),
            change("shaft.section.0.length", 610.123_45),
        ];
        let new = rewrite(FILE, None, &changes).unwrap();
        let expected = FILE
            .replace("6e6 N/m", "4.19509e6 N/m")
            .replace("15000 N/mm", "20934.9 N/mm")
            .replace("4e5", "3.0635e5")
            .replace("0.50", "0.333333")
            .replace("625 mm", "610.123 mm");
        assert_eq!(new, expected);
    }

    #[test]
    fn value_of_the_variant_is_changed() {
        let new = rewrite(FILE, Some("soft"), &[change("housing.B.k_x", 4.5e6)]).unwrap();
        assert!(
            new.contains("housing.B.k_x = \"4.5e6 N/m\"") && new.contains("k_x = \"6e6 N/m\"  # guessed"),
            "{new}"
        );
        assert!(rewrite(FILE, None, &[change("housing.B.c_x", 1.0)]).is_err());
    }

    #[test]
    fn number_of_digits_follows_the_error() {
        assert_eq!(format_like("6e6", 4_195_091.2, 13_000.0), "4.1951e6");
        assert_eq!(format_like("250", 251.239, 0.5), "251.24");
        assert_eq!(format_like("0.01", 0.012_345_678, 0.001), "0.01235");
        assert_eq!(format_like("10", 9.70602, 0.6), "9.706");
    }
}
