//! Values that the model file does not give: all of them in `check`, those that decide results beside the results.

use rotordyn::model::{DefaultValue, Model, keys};
use serde_json::{Value, json};

use super::args::keys::default_words;
use super::studies::Study;
use super::terminal::Terminal;

/// Values of one key that are equal, with the items that take them.
struct Group {
    key: String,
    items: Vec<String>,
    value: String,
}

/// Table of the values taken by default by the machine and its run-up, without zeros and what is off.
pub fn table(terminal: &Terminal, defaults: &[DefaultValue]) {
    let rows: Vec<Vec<String>> = groups(defaults)
        .into_iter()
        .filter(|group| !is_nothing(&group.value))
        .filter(|group| !group.key.starts_with("study.") || group.key.starts_with("study.run_up."))
        .map(|group| vec![group.key, group.items.join(", "), group.value])
        .collect();
    if !rows.is_empty() {
        terminal.table("Values taken by default", &["key", "of", "value"], &rows);
    }
}

/// Every value taken by default, with the path of the key that sets it.
pub fn to_json(defaults: &[DefaultValue]) -> Value {
    let entry = |default: &DefaultValue| json!({ "key": default.path, "value": plain(&default.value) });
    defaults.iter().map(entry).collect()
}

/// Prints the values taken by default that decide the results of these studies.
pub fn print_decisive(terminal: &Terminal, defaults: &[DefaultValue], model: &Model, studies: &[Study]) {
    let vibrates = studies.iter().any(|study| !matches!(study, Study::Static));
    let runs = studies.contains(&Study::RunUp);
    let decides = |group: &Group| match group.key.as_str() {
        "bearing.clearance" => true,
        "bearing.contact_damping" => vibrates,
        "study.run_up.step" | "study.run_up.cutoff" => runs,
        // Changed to fit the run.
        "study.run_up.sample_rate"
        | "study.spectrogram.length"
        | "study.orders.resolution"
        | "study.orders.max_order" => runs && group.value != default_words(&group.key),
        _ => false,
    };
    let words = |mut group: Group| {
        if group.key == "bearing.cage_pocket_diameter" {
            group.items.retain(|item| has_free_balls(model, item));
        }
        if group.key == "bearing.clearance" {
            let class = model.bearings.iter().filter(|site| group.items.contains(&site.name));
            let clearance = class.filter_map(|site| site.bearing.ball()).next()?.geometry.radial_clearance;
            group.value += &format!(" ({:.1} um)", 1e6 * clearance);
        }
        let (_, name) = group.key.rsplit_once('.')?;
        let of = match group.items.is_empty() {
            true => String::new(),
            false => format!(" of {}", group.items.join(", ")),
        };
        Some(format!("{name} = {}{of}", group.value))
    };
    let has_bodies = |group: &Group| {
        group.key == "bearing.cage_pocket_diameter"
            && runs
            && group.items.iter().any(|item| has_free_balls(model, item))
    };
    let found: Vec<String> = groups(defaults)
        .into_iter()
        .filter(|group| decides(group) || has_bodies(group))
        .filter_map(words)
        .collect();
    if !found.is_empty() {
        terminal.print_wrapped(&format!("taken by default: {}", found.join("; ")));
    }
}

fn has_free_balls(model: &Model, bearing: &str) -> bool {
    model.bearings.iter().any(|site| site.name == bearing && site.bearing.keyword() == "free_ball")
}

/// Values of the same declared key, in the order of the file.
fn groups(defaults: &[DefaultValue]) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for default in defaults {
        let key = keys::declared_path(&default.path).unwrap_or_else(|_| default.path.clone());
        let item = item_of(&default.path, &key);
        let value = plain(&default.value).to_string();
        match groups.iter_mut().find(|group| group.key == key && group.value == value) {
            Some(group) => group.items.extend(item),
            None => groups.push(Group { key, items: item.into_iter().collect(), value }),
        }
    }
    groups
}

/// Name of the item that a path has beside the path of its declaration.
fn item_of(path: &str, declared: &str) -> Option<String> {
    let mut rest: Vec<&str> = path.split('.').collect();
    for part in declared.split('.') {
        if let Some(at) = rest.iter().position(|found| *found == part) {
            rest.remove(at);
        }
    }
    (!rest.is_empty()).then(|| rest.join("."))
}

/// Value without the quotes of the file.
fn plain(value: &str) -> &str {
    value.strip_prefix('"').and_then(|value| value.strip_suffix('"')).unwrap_or(value)
}

/// Whether a value is zero, or that of something off or absent.
fn is_nothing(value: &str) -> bool {
    let words = value.split_whitespace();
    let numbers: Vec<f64> = words.filter_map(|word| word.trim_end_matches(',').parse().ok()).collect();
    matches!(value, "false" | "ground") || !numbers.is_empty() && numbers.iter().all(|number| *number == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn default(path: &str, value: &str) -> DefaultValue {
        DefaultValue { path: path.into(), value: value.into() }
    }

    #[test]
    fn equal_values_of_several_items_are_one_row() {
        let found = groups(&[
            default("bearing.A.contact_damping", "\"300 N s/m\""),
            default("bearing.B.contact_damping", "\"300 N s/m\""),
            default("study.modal.modes", "12"),
        ]);
        let rows: Vec<_> =
            found.iter().map(|g| (g.key.as_str(), g.items.join(" "), g.value.as_str())).collect();
        let expected = [
            ("bearing.contact_damping", "A B".to_string(), "300 N s/m"),
            ("study.modal.modes", String::new(), "12"),
        ];
        assert_eq!(rows, expected);
    }

    #[test]
    fn zeros_and_what_is_off_are_nothing() {
        for nothing in ["0 rpm", "0, 0, 0 m", "0", "false", "ground", "0 1/s"] {
            assert!(is_nothing(nothing), "{nothing}");
        }
        for something in ["300 N s/m", "0.75", "CN", "hertz", "true", "1e-6", "0, -9.8, 0 m/s^2"] {
            assert!(!is_nothing(something), "{something}");
        }
    }
}
