//! The model as it was understood: every value with its unit, given or taken by default, and what it means.

use super::markup::{escape, shortened, table};
use rotordyn_model::{DefaultValue, GivenValue, keys};

/// Longest value in the table; longer ones are in the text of the file.
const LONGEST: usize = 120;
/// Most rows of the table.
const MOST_ROWS: usize = 5000;

/// Table of all values and the text of the model file.
pub(crate) fn section(given: &[GivenValue], defaults: &[DefaultValue], text: &str) -> String {
    let given = given.iter().map(|value| (&value.path, &value.value, "file"));
    let by_default = defaults.iter().map(|value| (&value.path, &value.value, "default"));
    let rows: Vec<Vec<String>> = given
        .chain(by_default)
        .take(MOST_ROWS)
        .map(|(path, value, from)| {
            let value = shortened(value.trim_matches('"'), LONGEST);
            vec![shortened(path, LONGEST), value, from.into(), meaning(path)]
        })
        .collect();
    let mut out = String::new();
    if !rows.is_empty() {
        out += "<details class=\"printed\"><summary>All values, as given in the file or taken by default</summary>\n";
        out += &table("Values of the model", &["key", "value", "from", "meaning"], &rows);
        out += "</details>\n";
    }
    if !text.is_empty() {
        out += "<details><summary>Text of the model file</summary>\n";
        out += &format!(
            "<pre tabindex=\"0\" role=\"region\" aria-label=\"model file\">{}</pre></details>\n",
            escape(text)
        );
    }
    out
}

/// First sentence of what a key means.
fn meaning(path: &str) -> String {
    let plain: String =
        path.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest)).collect();
    let found = keys::describe_key(&plain).ok().flatten();
    found.map_or(String::new(), |key| key.meaning.into())
}
