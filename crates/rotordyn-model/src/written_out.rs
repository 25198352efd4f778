//! The text of a model as it stands: one file with its variant and the overrides applied.

use super::file::ModelErrors;
use super::file::tree::{Entry, Table, Value};
use super::load::{Document, Options};

/// The TOML text of a model with its variant and overrides applied, in present names, without comments.
///
/// It has no variants: reading it gives the same machine as `text` with `options`.
///
/// # Errors
/// A text that is not TOML; an unknown variant; an override whose path does not exist. Values are not validated.
///
/// ```
/// use rotordyn_model::{Options, written_out};
/// let text = "gravity = 'off'\n[disc.a]\nmass = '2 kg' # weighed\n[variant.heavy]\ndisc.a.mass = '3 kg'\n";
/// let heavy = Options { variant: Some("heavy".into()), ..Options::default() };
/// let written = "gravity = \"off\"\n\n[disc.a]\nmass = \"3 kg\"\n";
/// assert_eq!(written_out(text.as_bytes(), &heavy).unwrap(), written);
/// ```
pub fn written_out(text: &[u8], options: &Options) -> Result<String, ModelErrors> {
    let document = Document::read("model", text, options)?;
    let mut out = String::new();
    write_table(&mut out, "", &document.root);
    Ok(out)
}

/// The single values of a table, then the tables in it under their headings.
fn write_table(out: &mut String, path: &str, table: &Table) {
    let is_table = |entry: &&Entry| matches!(entry.node.value, Value::Table(_));
    for entry in table.entries().iter().filter(|entry| !is_table(entry)) {
        out.push_str(&format!("{} = {}\n", key(&entry.key), value(&entry.node.value)));
    }
    for entry in table.entries() {
        let Value::Table(inner) = &entry.node.value else { continue };
        let name = key(&entry.key);
        let path = if path.is_empty() { name } else { format!("{path}.{name}") };
        let only_tables = !inner.entries().is_empty() && inner.entries().iter().all(|e| is_table(&e));
        if !only_tables {
            let gap = if out.is_empty() { "" } else { "\n" };
            out.push_str(&format!("{gap}[{path}]\n"));
        }
        write_table(out, &path, inner);
    }
}

fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(bare) { name.into() } else { quoted(name) }
}

fn value(value: &Value) -> String {
    let list = |items: Vec<String>, [open, close]: [&str; 2]| format!("{open}{}{close}", items.join(", "));
    match value {
        Value::Text(text) => quoted(text),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => toml::Value::Float(*number).to_string(),
        Value::Boolean(flag) => flag.to_string(),
        Value::List(items) => list(items.iter().map(|item| self::value(&item.value)).collect(), ["[", "]"]),
        Value::Table(table) => {
            let pair = |entry: &Entry| format!("{} = {}", key(&entry.key), self::value(&entry.node.value));
            list(table.entries().iter().map(pair).collect(), ["{ ", " }"])
        }
        // No key of a model takes a date; the reader refuses this text as it refused the file.
        Value::Other => quoted("a date or huge number"),
    }
}

fn quoted(text: &str) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c if c.is_control() => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
