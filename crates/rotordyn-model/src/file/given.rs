//! The values that a model file gives, after its variant and the overrides.

use super::tree::{Table, Value};

/// A value of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GivenValue {
    /// Path of its key: `bearing.A.balls`, `shaft.section[0].length`.
    pub path: String,
    /// As it is written.
    pub value: String,
}

/// Every value of the file in its order, without the variants.
pub(crate) fn given_values(root: &Table) -> Vec<GivenValue> {
    let mut out = Vec::new();
    for entry in root.entries().iter().filter(|entry| entry.key != "variant") {
        collect(&entry.key, &entry.node.value, &mut out);
    }
    out
}

fn collect(path: &str, value: &Value, out: &mut Vec<GivenValue>) {
    match value {
        Value::Table(table) => {
            table.entries().iter().for_each(|e| collect(&format!("{path}.{}", e.key), &e.node.value, out));
        }
        Value::List(items)
            if items.iter().any(|item| matches!(item.value, Value::Table(_) | Value::List(_))) =>
        {
            items.iter().enumerate().for_each(|(k, item)| collect(&format!("{path}[{k}]"), &item.value, out));
        }
        Value::List(items) => {
            let words: Vec<String> = items.iter().map(|item| plain(&item.value)).collect();
            out.push(GivenValue { path: path.into(), value: words.join(", ") });
        }
        value => out.push(GivenValue { path: path.into(), value: plain(value) }),
    }
}

fn plain(value: &Value) -> String {
    match value {
        Value::Text(text) => text.clone(),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Boolean(flag) => flag.to_string(),
        Value::List(_) | Value::Table(_) | Value::Other => String::new(),
    }
}
