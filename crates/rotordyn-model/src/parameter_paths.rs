//! Values of a model file by parameter path: the numbers that model updating may change.

use super::file::overlay::COLLECTIONS;
use super::file::renamed::renamed_path;
use super::file::tree::{Entry, Node, Table, Value};
use super::load::{Document, Options};
use rotordyn_units::leading_number;
use rotordyn_units::names::nearest;

/// A number or quantity string of a model file, with its parameter path.
#[derive(Clone, Debug, PartialEq)]
pub struct ParameterValue {
    /// Dotted path such as "housing.B.k_x", in the spelling of the file.
    pub path: String,
    /// Value as written, without quotes: "6e6 N/m".
    pub text: String,
    /// Whether it is a string rather than a bare number.
    pub quoted: bool,
}

/// Values of a file at a parameter path, with variant and settings applied; the wildcard `*` matches every
/// item of a table or list that has the rest of the path, `housing.*.k_x`, `damping.modal.ratio.*`.
///
/// # Errors
/// Unknown path, with the nearest known name; a value that is not a number.
pub fn resolve_parameter_path(
    text: &[u8],
    options: &Options,
    path: &str,
) -> Result<Vec<ParameterValue>, String> {
    let document = Document::read("model", text, options).map_err(|errors| errors.to_string())?;
    let present = renamed_path(path);
    let parts: Vec<&str> = present.as_deref().unwrap_or(path).split('.').map(str::trim).collect();
    let mut found = Vec::new();
    let root = Node { span: 0..0, value: Value::Table(document.root) };
    collect_values(&root, &parts, 0, &mut Vec::new(), &mut found)
        .map_err(|problem| format!("{path}: {problem}"))?;
    if found.is_empty() {
        return Err(format!("{path}: no item has this path"));
    }
    Ok(found)
}

/// All single numbers and quantities of a file with their paths, with variant and settings applied.
///
/// # Errors
/// A file that cannot be read.
pub fn all_values(text: &[u8], options: &Options) -> Result<Vec<ParameterValue>, String> {
    let document = Document::read("model", text, options).map_err(|errors| errors.to_string())?;
    let mut found = Vec::new();
    let root = Node { span: 0..0, value: Value::Table(document.root) };
    collect_all(&root, &mut Vec::new(), &mut found);
    Ok(found)
}

fn collect_all(node: &Node, at: &mut Vec<String>, found: &mut Vec<ParameterValue>) {
    let mut into = |name: &str, node: &Node| {
        at.push(name.to_string());
        collect_all(node, at, found);
        at.pop();
    };
    let (text, quoted) = match &node.value {
        Value::Table(table) => {
            return table.entries().iter().for_each(|entry| into(entry.written_key(), &entry.node));
        }
        Value::List(items) => {
            return items.iter().enumerate().for_each(|(k, item)| into(&k.to_string(), item));
        }
        Value::Text(text) if leading_number(text.trim()).is_some() => (text.clone(), true),
        Value::Integer(i) => (i.to_string(), false),
        Value::Float(f) => (f.to_string(), false),
        _ => return,
    };
    found.push(ParameterValue { path: at.join("."), text, quoted });
}

fn collect_values(
    node: &Node,
    parts: &[&str],
    depth: usize,
    at: &mut Vec<String>,
    found: &mut Vec<ParameterValue>,
) -> Result<(), String> {
    let Some(part) = parts.get(depth) else {
        let (text, quoted) = match &node.value {
            Value::Text(text) => (text.clone(), true),
            Value::Integer(i) => (i.to_string(), false),
            Value::Float(f) => (f.to_string(), false),
            Value::List(items) => {
                let here = at.join(".");
                return Err(format!(
                    "it is a list; use one of its {} numbers, {here}.0, or all of them, {here}.*",
                    items.len()
                ));
            }
            Value::Table(table) => {
                let inner: Vec<&str> = table.keys().take(6).collect();
                return Err(format!("it is a table; use one of its values, such as {}", inner.join(", ")));
            }
            other => return Err(format!("it is {}, not a number", other.type_name())),
        };
        if quoted && leading_number(text.trim()).is_none() {
            return Err(format!("\"{text}\" is not a number"));
        }
        found.push(ParameterValue { path: at.join("."), text, quoted });
        return Ok(());
    };
    let mut into = |name: &str, node: &Node, found: &mut Vec<ParameterValue>| {
        at.push(name.to_string());
        let done = collect_values(node, parts, depth + 1, at, found);
        at.pop();
        done
    };
    match &node.value {
        Value::Table(table) if *part == "*" => {
            // Skip items without that key.
            let has = |entry: &&Entry| has_path(&entry.node, &parts[depth + 1..]);
            table
                .entries()
                .iter()
                .filter(has)
                .try_for_each(|entry| into(entry.written_key(), &entry.node, found))
        }
        Value::Table(table) => match table.get(part) {
            Some(entry) => into(entry.written_key(), &entry.node, found),
            None => Err(unknown_key_message(table, part, parts, depth)),
        },
        Value::List(items) if *part == "*" => {
            let mut meant = items.iter().enumerate().filter(|(_, item)| has_path(item, &parts[depth + 1..]));
            meant.try_for_each(|(k, item)| into(&k.to_string(), item, found))
        }
        Value::List(items) => match part.parse::<usize>().ok().and_then(|k| items.get(k)) {
            Some(item) => into(part, item, found),
            None => Err(format!("`{part}` is not one of the {} items, counted from 0", items.len())),
        },
        _ => Err(format!("`{}` is a value without members", parts[depth - 1])),
    }
}

fn has_path(node: &Node, parts: &[&str]) -> bool {
    match (&node.value, parts.split_first()) {
        (_, None) => true,
        (Value::Table(table), Some((&"*", rest))) => table.entries().iter().any(|e| has_path(&e.node, rest)),
        (Value::Table(table), Some((first, rest))) => {
            table.get(first).is_some_and(|e| has_path(&e.node, rest))
        }
        (Value::List(items), Some((&"*", rest))) => items.iter().any(|item| has_path(item, rest)),
        (Value::List(items), Some((first, rest))) => {
            first.parse::<usize>().ok().and_then(|k| items.get(k)).is_some_and(|item| has_path(item, rest))
        }
        _ => false,
    }
}

fn unknown_key_message(table: &Table, part: &str, parts: &[&str], depth: usize) -> String {
    let known: Vec<&str> = table.keys().collect();
    let near = nearest(part, known.iter().copied());
    let hint = match near {
        Some(near) => format!("did you mean `{near}`?"),
        None if depth > 1 => {
            format!("it is not in the file; add it to {} first", parts[..depth].join("."))
        }
        None => format!("available: {}", known.iter().take(12).copied().collect::<Vec<_>>().join(", ")),
    };
    let what = if depth == 1 && COLLECTIONS.contains(&parts[0]) { parts[0] } else { "path" };
    match what {
        "path" => format!("there is no `{part}`; {hint}"),
        item => format!("there is no {item} `{part}`; {hint}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = r#"
        gains = [1, 2]
        [housing.A]
        k_x = "6e6 N/m"
        on = "body.block"
        [housing.B]
        k_x = "5e6 N/m"
        k_y = "7e6 N/m"
        [variant.soft]
        housing.B.k_x = "1e6 N/m"
    "#;

    fn values_at(path: &str) -> Result<Vec<(String, String)>, String> {
        let found = resolve_parameter_path(FILE.as_bytes(), &Options::default(), path)?;
        Ok(found.into_iter().map(|s| (s.path, s.text)).collect())
    }

    #[test]
    fn paths_and_wildcards() {
        let one = |path: &str, text: &str| (path.to_string(), text.to_string());
        assert_eq!(values_at("housing.B.k_x").unwrap(), [one("housing.B.k_x", "5e6 N/m")]);
        assert_eq!(values_at("housing.*.k_x").unwrap().len(), 2);
        assert_eq!(values_at("housing.*.k_y").unwrap(), [one("housing.B.k_y", "7e6 N/m")]);
        assert_eq!(values_at("gains.1").unwrap(), [one("gains.1", "2")]);
        assert_eq!(values_at("gains.*").unwrap(), [one("gains.0", "1"), one("gains.1", "2")]);
        let soft = Options { variant: Some("soft".into()), ..Options::default() };
        assert_eq!(
            resolve_parameter_path(FILE.as_bytes(), &soft, "housing.B.k_x").unwrap()[0].text,
            "1e6 N/m"
        );
    }

    #[test]
    fn all_values_have_the_paths_that_find_them() {
        let soft = Options { variant: Some("soft".into()), ..Options::default() };
        let found = all_values(FILE.as_bytes(), &soft).unwrap();
        let listed: Vec<(&str, &str)> = found.iter().map(|v| (v.path.as_str(), v.text.as_str())).collect();
        let expected = [
            ("gains.0", "1"),
            ("gains.1", "2"),
            ("housing.A.k_x", "6e6 N/m"),
            ("housing.B.k_x", "1e6 N/m"),
            ("housing.B.k_y", "7e6 N/m"),
        ];
        assert_eq!(listed, expected);
        for value in &found {
            assert_eq!(
                resolve_parameter_path(FILE.as_bytes(), &soft, &value.path).unwrap(),
                std::slice::from_ref(value)
            );
        }
    }

    #[test]
    fn errors_suggest_the_nearest_name() {
        for (path, part) in [
            ("housing.B.k_xx", "did you mean `k_x`?"),
            ("housing.C.k_x", "there is no housing `C`; available: A, B"),
            ("hosing.B.k_x", "did you mean `housing`?"),
            ("housing.B", "it is a table; use one of its values, such as k_x"),
            ("housing.A.on", "\"body.block\" is not a number"),
            ("housing.A.stiff", "add it to housing.A first"),
            ("gains", "use one of its 2 numbers, gains.0, or all of them, gains.*"),
            ("housing.*.q", "no item has this path"),
        ] {
            let error = values_at(path).unwrap_err();
            assert!(error.contains(part), "{path}: {error}");
        }
    }
}
