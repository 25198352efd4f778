//! Renamed keys and keywords of a model file: the former spelling is read as the present one, with a hint.
//!
//! All other code knows only the present spelling: the tree is translated before the variant and every `--set`
//! are applied to it, and so are their paths.

use super::diagnostic::{Kind, Log, Problem};
use super::tree::{Entry, Node, Table, Value};

/// Renamed keys: path of their table (`*` is any name), former and present spelling.
const KEYS: &[(&str, &str, &str)] = &[
    ("study.campbell", "follow_bearings", "speed_dependent_bearings"),
    ("study.bearing", "hold", "constrain"),
    ("study.poincare", "settle", "transient_periods"),
    ("study.lyapunov", "settle", "transient_periods"),
    ("study.bifurcation", "settle", "transient_periods"),
    ("joint.*", "hold", "constrain"),
    ("bearing.*", "contacts_pull", "tensile_contact"),
    ("bearing.*.off_size", "by", "diameter_difference"),
    ("bearing.*.off_size.*", "by", "diameter_difference"),
];

/// Renamed keywords: path of their key, former and present spelling.
const KEYWORDS: &[(&str, &str, &str)] =
    &[("joint.*.axial", "held", "fixed"), ("study.bifurcation.start", "carried", "continuation")];

/// Present spelling of a former key of the table at `path`, or of a former keyword at `path`.
fn renamed(
    list: &[(&str, &str, &'static str)],
    path: &[impl AsRef<str>],
    word: &str,
) -> Option<&'static str> {
    let is_at = |pattern: &str| {
        let parts: Vec<&str> = pattern.split('.').collect();
        let fits = |(part, name): (&&str, &str)| *part == name || *part == "*" || name == "*";
        parts.len() == path.len() && parts.iter().zip(path.iter().map(AsRef::as_ref)).all(fits)
    };
    list.iter().find(|(pattern, old, _)| *old == word && is_at(pattern)).map(|(.., new)| *new)
}

/// Hint for the reader of the file.
pub(crate) fn hint(old: &str, new: &str) -> String {
    format!("`{old}` is now `{new}`; the old spelling still works")
}

fn joined(path: &[String], key: &str) -> String {
    path.iter().map(String::as_str).chain([key]).collect::<Vec<_>>().join(".")
}

/// Present spelling of key `parts[k]` of a dotted path, if it has been renamed.
pub(crate) fn renamed_part(parts: &[&str], k: usize) -> Option<&'static str> {
    renamed(KEYS, &parts[..k], parts[k])
}

/// Present spelling of a parameter path such as `bearing.B.off_size.0.by`, or `None` if nothing in it has been
/// renamed; `*` stands for any name.
pub fn renamed_path(path: &str) -> Option<String> {
    let mut parts: Vec<&str> = path.split('.').map(str::trim).collect();
    let mut found = false;
    for k in 0..parts.len() {
        if let Some(new) = renamed_part(&parts, k) {
            parts[k] = new;
            found = true;
        }
    }
    found.then(|| parts.join("."))
}

/// Translate a whole document; its variants are translated when they are applied.
pub(crate) fn translate(root: &mut Table, log: &Log) {
    translate_table(root, &mut Vec::new(), log);
}

fn translate_table(table: &mut Table, path: &mut Vec<String>, log: &Log) {
    for k in 0..table.entries().len() {
        let Entry { key, key_span: span, .. } = &table.entries()[k];
        let (mut key, span) = (key.clone(), span.clone());
        if path.is_empty() && key == "variant" {
            continue;
        }
        let new = renamed(KEYS, path, &key);
        if let Some(new) = new {
            let (old_path, new_path) = (joined(path, &key), joined(path, new));
            if table.get(new).is_some() {
                let message = format!("{old_path} and `{new}` are the same key");
                let advice = format!("`{key}` is the former name of `{new}`: give only `{new}`");
                log.error(Problem::new(Kind::Conflict, &span, message).hint(advice));
                continue;
            }
            log.hint(Problem::new(Kind::FormerName, &span, hint(&old_path, &new_path)));
            table.rename(k, new);
            key = new.into();
        }
        path.push(key.clone());
        if let Some(node) = table.node_mut(&key) {
            translate_node(node, path, log);
        }
        path.pop();
    }
}

/// Translate the value at `path`.
pub(super) fn translate_node(node: &mut Node, path: &mut Vec<String>, log: &Log) {
    match &mut node.value {
        Value::Table(table) => translate_table(table, path, log),
        Value::List(items) => {
            for (k, item) in items.iter_mut().enumerate() {
                path.push(k.to_string());
                translate_node(item, path, log);
                path.pop();
            }
        }
        Value::Text(word) => {
            if let Some(new) = renamed(KEYWORDS, path, word) {
                let key = path.join(".");
                let message = hint(&format!("{key} = \"{word}\""), &format!("{key} = \"{new}\""));
                log.hint(Problem::new(Kind::FormerName, &node.span, message));
                *word = new.into();
            }
        }
        Value::Integer(_) | Value::Float(_) | Value::Boolean(_) | Value::Other => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn renamed_paths() {
        for (old, new) in [
            ("bearing.B.off_size.0.by", Some("bearing.B.off_size.0.diameter_difference")),
            ("bearing.*.off_size.*.by", Some("bearing.*.off_size.*.diameter_difference")),
            ("joint.hold.hold", Some("joint.hold.constrain")),
            ("study.lyapunov.settle", Some("study.lyapunov.transient_periods")),
            ("speed.settle", None),
            ("speed.hold", None),
            ("joint.hold", None),
            ("bearing.B.radial_clearance", None),
        ] {
            assert_eq!(renamed_path(old).as_deref(), new, "{old}");
        }
    }
}
