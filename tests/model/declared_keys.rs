//! The declared keys against the reader: every key is read as declared, with its example, default and range, and
//! every key of a file in the repository is declared.

use super::key_contexts::{Context, contexts_of, load};
use rotordyn::model::keys::{self, KeyDescription, KindName};
use rotordyn::model::{Diagnostic, Kind};
use std::path::Path;
use toml::{Table, Value};

/// Value from its TOML text.
fn value(text: &str) -> Value {
    format!("x = {text}").parse::<Table>().unwrap_or_else(|error| panic!("{text}: {error}"))["x"].clone()
}

fn is_table(key: &KeyDescription) -> bool {
    matches!(
        key.kind,
        KindName::Table | KindName::NamedTables | KindName::TableList | KindName::NamedQuantities
    )
}

/// Keys that hold a value.
fn value_keys() -> impl Iterator<Item = KeyDescription> {
    keys::all().into_iter().filter(|key| !is_table(key))
}

/// Errors of a file with this value of the key, without keys that exclude it.
fn errors(context: &Context, key: &str, value: &Value) -> Vec<Diagnostic> {
    let mut context = context.clone();
    loop {
        let text = context.with(key, Some(value.clone()));
        let found = load(&text).err().map_or_else(Vec::new, |errors| errors.diagnostics);
        let excluded = |d: &Diagnostic| -> Vec<String> {
            let names = d.hint.as_deref().and_then(|hint| hint.strip_prefix("give one of ")).unwrap_or("");
            let names: Vec<String> = names.split(", ").map(String::from).collect();
            if names.iter().any(|name| name == key) { names } else { Vec::new() }
        };
        let others: Vec<String> = found.iter().flat_map(excluded).filter(|name| name != key).collect();
        if others.is_empty() {
            return found;
        }
        others.iter().for_each(|name| context.remove(name));
    }
}

fn assert_none(failures: &[String]) {
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
}

#[test]
fn every_key_is_read() {
    let mut failures = Vec::new();
    for key in value_keys() {
        assert!(!key.example.is_empty(), "{} has no example", key.path);
        for context in contexts_of(&key) {
            let found = errors(&context, key.name, &value(&key.example));
            let is_key = |d: &&Diagnostic| d.message.rsplit(['.', ' ']).next() == Some(key.name);
            let refused = found.iter().filter(is_key).find(|d| d.kind == Kind::UnknownKey);
            let foreign = found
                .iter()
                .find(|d| d.kind == Kind::Conflict && d.message.contains("does not belong to model"));
            failures.extend(refused.or(foreign).map(|d| format!("{}: {}", key.path, d.message)));
        }
    }
    assert_none(&failures);
}

#[test]
fn every_default_is_the_value_without_the_key() {
    let (mut tested, mut failures) = (0, Vec::new());
    for key in value_keys() {
        let Some(default) = &key.default else { continue };
        for context in contexts_of(&key) {
            match (load(&context.with(key.name, None)), load(&context.with(key.name, Some(value(default))))) {
                (Ok(without), Ok(given)) if given.model == without.model => tested += 1,
                (Ok(_), Ok(_)) => failures.push(format!("{} = {default} changes the model", key.path)),
                (without, given) => {
                    let errors = [without.err(), given.err()].map(|e| e.map(|e| e.to_string()));
                    failures.push(format!("{} = {default}: {errors:?}", key.path));
                }
            }
        }
    }
    assert_none(&failures);
    assert!(tested > 100, "{tested}");
}

#[test]
fn a_required_key_is_missed() {
    for key in value_keys().filter(|key| key.required) {
        for context in contexts_of(&key) {
            let found = load(&context.with(key.name, None)).err().map_or_else(Vec::new, |e| e.diagnostics);
            let missed = found.iter().any(|d| d.kind == Kind::MissingKey);
            assert!(missed, "{}: {found:?}", key.path);
        }
    }
}

/// Values that the declaration does not allow, and kinds of the error.
fn wrong_values(key: &KeyDescription) -> Vec<(Value, Kind)> {
    let quantity = |number: f64| Value::String(format!("{number} {}", key.unit).trim_end().to_string());
    let ends: Vec<f64> = key.range.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let mut wrong = match key.kind {
        KindName::Flag => vec![(Value::Integer(3), Kind::WrongType)],
        KindName::Word => vec![(Value::String("no such word".into()), Kind::UnknownName)],
        KindName::Text => vec![(Value::Boolean(true), Kind::WrongType)],
        KindName::Count => {
            let ends: Vec<i64> = key.range.split_whitespace().filter_map(|word| word.parse().ok()).collect();
            let mut outside = vec![Value::Integer(ends[0] - 1)];
            outside.extend(ends.get(1).map(|greatest| Value::Integer(greatest + 1)));
            outside.into_iter().map(|value| (value, Kind::OutOfRange)).collect()
        }
        KindName::Quantity | KindName::Quantities | KindName::Spaced => {
            let outside = match &*key.range {
                "" => vec![],
                "greater than zero" => vec![0.0, -1.0],
                "zero or greater" => vec![-1.0],
                range if range.contains("below") => vec![ends[0] - 1.0, ends[1]],
                _ => vec![ends[0] - 1e-3, ends[1] + 1e-3],
            };
            outside.into_iter().map(|number| (quantity(number), Kind::OutOfRange)).collect()
        }
        _ => vec![],
    };
    if matches!(key.kind, KindName::Quantity | KindName::Quantities | KindName::Spaced) {
        wrong.push((Value::String("1 kg^7".into()), Kind::WrongDimension));
    }
    wrong
}

#[test]
fn a_value_outside_its_declaration_is_refused() {
    // both forms of a key read its value: the message of the other form is as good
    let forms = |path: &str| keys::all().iter().filter(|key| key.path == path).count();
    let mut failures = Vec::new();
    // a variant is applied before the file is read
    let of_file = |key: &KeyDescription| !key.path.starts_with("variant.");
    let one_form = |key: &KeyDescription| forms(&key.path) == 1 || key.kind == KindName::Word;
    for key in value_keys().filter(|key| of_file(key) && one_form(key)) {
        // a unit of temperatures in the words of the range is not the SI unit
        let key = match key.range.ends_with("degC") {
            true => KeyDescription { unit: "degC", ..key },
            false => key,
        };
        for context in contexts_of(&key) {
            for (value, kind) in wrong_values(&key) {
                let found = errors(&context, key.name, &value);
                let at_key = |d: &&Diagnostic| d.kind == kind || forms(&key.path) > 1;
                let refused = found.iter().filter(at_key).any(|d| {
                    d.message.contains(key.name) || d.kind == Kind::UnknownName || forms(&key.path) > 1
                });
                if !refused {
                    let messages: Vec<&str> = found.iter().map(|d| d.message.as_str()).collect();
                    failures.push(format!("{} = {value}: {messages:?}", key.path));
                }
            }
        }
    }
    assert_none(&failures);
}

#[test]
fn every_description_is_complete() {
    for key in keys::all() {
        assert!(key.meaning.ends_with('.'), "{}: {}", key.path, key.meaning);
        assert!(key.meaning.chars().count() <= 130, "{}: {}", key.path, key.meaning);
        assert!(!key.value.is_empty(), "{}", key.path);
        let found = keys::find(&key.path).unwrap();
        assert!(found.keys.contains(&key), "{}", key.path);
        let pair = |k: &&KeyDescription| k.kind == key.kind && k.path == key.path;
        assert_eq!(
            found.keys.iter().filter(pair).count(),
            keys::all().iter().filter(pair).count(),
            "{}",
            key.path
        );
    }
}

/// Report every path of a document that is not declared.
fn check_declared(file: &str, table: &Table, path: &str) {
    for (name, value) in table {
        let here = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        if path == "variant" {
            let mut variant = value.as_table().unwrap().clone();
            for key in ["based_on", "remove"] {
                assert!(keys::find(&format!("variant.{key}")).is_ok());
                variant.remove(key);
            }
            check_declared(file, &variant, "");
            continue;
        }
        let found = keys::find(&here);
        // the name of an item is no key
        let parent = path.rsplit_once('.').map_or(path, |(_, last)| last);
        let is_item = keys::find(path).is_ok_and(|found| {
            found.keys.iter().any(|key| {
                matches!(key.kind, KindName::NamedTables | KindName::NamedQuantities) && key.name == parent
            })
        });
        assert!(found.is_ok() || is_item, "{file}: {}", found.unwrap_err());
        match value {
            Value::Table(inner) => check_declared(file, inner, &here),
            Value::Array(items) => {
                items.iter().filter_map(Value::as_table).for_each(|item| check_declared(file, item, &here));
            }
            _ => {}
        }
    }
}

#[test]
fn every_key_of_a_file_of_the_repository_is_declared() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf();
    let mut checked = 0;
    for entry in std::fs::read_dir(root.join("models")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let text = std::fs::read_to_string(&path).unwrap();
            check_declared(&path.display().to_string(), &text.parse().unwrap(), "");
            checked += 1;
        }
    }
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    for block in readme.split("```toml\n").skip(1) {
        let text = block.split("```").next().unwrap();
        if text.starts_with("[model]") {
            check_declared("README.md", &text.parse().unwrap(), "");
            checked += 1;
        }
    }
    assert!(checked > 10, "{checked}");
}

#[test]
fn a_path_is_found_with_and_without_names() {
    let at = |path: &str| keys::find(path).unwrap();
    assert_eq!(at("").members[0].name, "model");
    assert_eq!(at("bearing.B.preload").path, "bearing.preload");
    assert_eq!(at("bearing.preload").members.len(), 5);
    assert_eq!(at("station.A").path, "station");
    assert!(keys::find("station.A.x").is_err());
    assert_eq!(at("shaft.section.0.length").path, "shaft.section.length");
    assert_eq!(at("study.modal.speeds.step").keys[0].unit, "rad/s");
    let former = at("bearing.contacts_pull");
    assert_eq!(
        (&*former.path, former.former.as_deref()),
        ("bearing.tensile_contact", Some("bearing.contacts_pull"))
    );
    assert_eq!(at("bearing.B.off_size.0.by").path, "bearing.off_size.diameter_difference");
    assert_eq!(keys::find("bearing.prelod").unwrap_err().nearest, ["bearing.preload"]);
    assert_eq!(keys::find("preload").unwrap_err().nearest, ["bearing.preload"]);
    assert!(keys::find("bearing.B").is_err());
    assert!(keys::find("nonsense").unwrap_err().nearest.is_empty());
}

/// Every key that the README names in its table of bearings is declared.
#[test]
fn the_bearing_keys_of_the_readme_are_declared() {
    let readme = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap();
    let table = readme.split("| of a ball bearing |").nth(1).unwrap().split("\n\n").next().unwrap();
    let words = table.split('`').skip(1).step_by(2);
    let names = words.filter(|word| word.chars().all(|c| c.is_ascii_lowercase() || c == '_'));
    let mut checked = 0;
    for name in names.filter(|name| *name != "points") {
        assert!(keys::find(&format!("bearing.{name}")).is_ok(), "{name}");
        checked += 1;
    }
    assert!(checked > 40, "{checked}");
}
