//! What a checkpoint belongs to: command, model text, settings, side files, version; and how it differs from another run.

use std::collections::BTreeMap;

use rotordyn::model::{ExternalColumn, ExternalFile, Options};
use serde::{Deserialize, Serialize};
use similar::{ChangeTag, TextDiff};

/// Lines of a changed model file that a message shows.
const SHOWN_LINES: usize = 12;

/// Everything on which the results of a command depend.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunIdentity {
    /// Name of the command, and version of the program.
    pub command: String,
    pub version: String,
    /// Text of the model file.
    pub model: Vec<u8>,
    pub variant: Option<String>,
    /// Paths and values of `--set` and of flags, in order.
    pub settings: Vec<(String, String)>,
    /// Files that the model reads, with their content.
    pub files: Vec<ExternalFile>,
}

impl RunIdentity {
    pub fn new(command: &str, model: &[u8], options: &Options, files: &[ExternalFile]) -> Self {
        Self {
            command: command.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            model: model.into(),
            variant: options.variant.clone(),
            settings: options.set.clone(),
            files: files.to_vec(),
        }
    }

    /// What differs between this run and one `now`, a line each; empty if nothing does.
    pub fn differences(&self, now: &Self) -> Vec<String> {
        let mut found = Vec::new();
        if self.version != now.version {
            found.push(format!("rotordyn was {}, is {}", self.version, now.version));
        }
        if self.command != now.command {
            found.push(format!("the command was `{}`, is `{}`", self.command, now.command));
        }
        if self.variant != now.variant {
            let name = |variant: &Option<String>| variant.clone().unwrap_or_else(|| "base".into());
            found.push(format!("the variant was {}, is {}", name(&self.variant), name(&now.variant)));
        }
        found.extend(changed_settings(&self.settings, &now.settings));
        let paths = |identity: &Self| identity.files.iter().map(|f| f.path.clone()).collect::<Vec<_>>();
        if paths(self) != paths(now) {
            let list = |paths: Vec<String>| if paths.is_empty() { "none".into() } else { paths.join(", ") };
            found.push(format!("the side files were {}, are {}", list(paths(self)), list(paths(now))));
        } else {
            let changed = self.files.iter().zip(&now.files).filter(|(before, now)| !same_bits(before, now));
            found.extend(changed.map(|(before, _)| format!("the content of {} has changed", before.path)));
        }
        if self.model != now.model {
            found.push("the model file has changed:".into());
            found.extend(changed_lines(
                &String::from_utf8_lossy(&self.model),
                &String::from_utf8_lossy(&now.model),
            ));
        }
        found
    }
}

/// Whether two files have the same columns, their numbers compared by their bits.
fn same_bits(a: &ExternalFile, b: &ExternalFile) -> bool {
    let same = |(a, b): (&ExternalColumn, &ExternalColumn)| {
        let bits = |column: &ExternalColumn| column.values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        a.name == b.name && a.unit == b.unit && bits(a) == bits(b)
    };
    match (&a.content, &b.content) {
        (Ok(a), Ok(b)) => a.len() == b.len() && a.iter().zip(b).all(same),
        (Err(a), Err(b)) => a == b,
        _ => false,
    }
}

/// Settings that differ, key by key.
fn changed_settings(before: &[(String, String)], now: &[(String, String)]) -> Vec<String> {
    if before == now {
        return Vec::new();
    }
    // The last value of a path holds.
    let map = |settings: &[(String, String)]| settings.iter().cloned().collect::<BTreeMap<_, _>>();
    let [old, new] = [map(before), map(now)];
    let shown = |value: Option<&String>| value.map_or("not set".to_string(), Clone::clone);
    let mut paths: Vec<&String> = old.keys().chain(new.keys()).collect();
    paths.sort();
    paths.dedup();
    let changed = paths.into_iter().filter(|path| old.get(*path) != new.get(*path));
    let mut lines: Vec<String> = changed
        .map(|path| format!("{path} was {}, is {}", shown(old.get(path)), shown(new.get(path))))
        .collect();
    if lines.is_empty() {
        lines.push("the settings are in another order".into());
    }
    lines
}

/// Lines of a text that were removed (-) and added (+), with their numbers.
fn changed_lines(before: &str, now: &str) -> Vec<String> {
    let diff = TextDiff::from_lines(before, now);
    let changes = diff.iter_all_changes().filter_map(|change| {
        let (sign, index) = match change.tag() {
            ChangeTag::Delete => ('-', change.old_index()?),
            ChangeTag::Insert => ('+', change.new_index()?),
            ChangeTag::Equal => return None,
        };
        Some(format!("  {sign} line {}: {}", index + 1, change.value().trim_end()))
    });
    let mut lines: Vec<String> = changes.collect();
    if lines.len() > SHOWN_LINES {
        let more = lines.len() - SHOWN_LINES;
        lines.truncate(SHOWN_LINES);
        lines.push(format!("  and {more} more lines"));
    }
    if lines.is_empty() {
        // Bytes that are no text.
        lines.push("  in characters that are not shown".into());
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(model: &str, set: &[(&str, &str)]) -> RunIdentity {
        let set = set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
        RunIdentity::new("run", model.as_bytes(), &Options { variant: None, set }, &[])
    }

    #[test]
    fn differences_name_settings_and_lines() {
        let before = identity("a = 1\nb = 2\nc = 3\n", &[("speed.to", "\"1200 rpm\""), ("x", "1")]);
        assert!(before.differences(&before).is_empty());
        let now = identity("a = 1\nb = 5\nc = 3\n", &[("speed.to", "\"1500 rpm\"")]);
        assert_eq!(
            before.differences(&now),
            [
                "speed.to was \"1200 rpm\", is \"1500 rpm\"",
                "x was 1, is not set",
                "the model file has changed:",
                "  - line 2: b = 2",
                "  + line 2: b = 5",
            ]
        );
        let other = RunIdentity { command: "run-up".into(), version: "0.0.1".into(), ..before.clone() };
        assert_eq!(before.differences(&other).len(), 2);
        let swapped = identity("a = 1\nb = 2\nc = 3\n", &[("x", "1"), ("speed.to", "\"1200 rpm\"")]);
        assert_eq!(before.differences(&swapped), ["the settings are in another order"]);
    }

    #[test]
    fn a_side_file_differs_by_one_bit() {
        let file = |value: f64| ExternalFile {
            path: "tacho.csv".into(),
            content: Ok(vec![rotordyn::model::ExternalColumn {
                name: "time".into(),
                unit: "s".into(),
                values: vec![0.0, value, f64::NAN],
            }]),
        };
        let with = |value| RunIdentity::new("run", b"", &Options::default(), &[file(value)]);
        assert!(with(0.1).differences(&with(0.1)).is_empty());
        let next = f64::from_bits(0.1f64.to_bits() + 1);
        assert_eq!(with(0.1).differences(&with(next)), ["the content of tacho.csv has changed"]);
    }
}
