//! `--set PATH=VALUE` over a model of this repository.
//!
//! The first line names a model and perhaps a variant, `overhung_rig loose`; every other line is an assignment.

use std::path::Path;
use std::sync::OnceLock;

use rotordyn::model::Options;
use toml::Value;

use super::model;
use crate::folders;
use crate::outcome::Outcome;

/// Assignments of one seed.
const ASSIGNMENTS: usize = 3;

/// Names and texts of the models.
fn models() -> &'static [(String, String)] {
    static MODELS: OnceLock<Vec<(String, String)>> = OnceLock::new();
    MODELS.get_or_init(|| {
        let text = |(path, bytes): (std::path::PathBuf, Vec<u8>)| {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            (name, String::from_utf8_lossy(&bytes).into_owned())
        };
        folders::files(&folders::top().join("models"), "toml").into_iter().map(text).collect()
    })
}

pub fn run(bytes: &[u8], _: &Path) -> Outcome {
    // An argument of a command line is not always UTF-8; clap refuses what is not.
    let Ok(text) = std::str::from_utf8(bytes) else { return Outcome::refused("not UTF-8") };
    let mut lines = text.lines();
    let mut head = lines.next().unwrap_or_default().split_whitespace();
    let name = head.next().unwrap_or_default();
    let models = models();
    let Some((_, model)) = models.iter().find(|(of, _)| of == name).or(models.first()) else {
        return Outcome::refused("no model");
    };
    let mut options = Options { variant: head.next().map(String::from), set: Vec::new() };
    for line in lines {
        // As the command line splits it.
        match line.split_once('=') {
            Some((path, value)) if !path.trim().is_empty() => {
                options.set.push((path.trim().into(), value.trim().into()));
            }
            _ => return Outcome::refused("expected PATH=VALUE"),
        }
    }
    model::load(model.as_bytes(), &options)
}

/// Every value of every model and variant, assigned to what it is already.
pub fn seeds() -> Vec<Vec<u8>> {
    let mut seeds = Vec::new();
    for (name, text) in models() {
        let Ok(Value::Table(root)) = text.parse::<toml::Table>().map(Value::Table) else { continue };
        let mut assignments = Vec::new();
        leaves("", &Value::Table(root), &mut assignments);
        let variants = rotordyn::model::variants(text);
        for (k, chunk) in assignments.chunks(ASSIGNMENTS).enumerate() {
            let variant = variants.get(k % (variants.len() + 1)).map(String::as_str).unwrap_or_default();
            seeds.push(format!("{name} {variant}\n{}", chunk.join("\n")).into_bytes());
        }
    }
    seeds
}

fn leaves(path: &str, value: &Value, into: &mut Vec<String>) {
    match value {
        Value::Table(table) if path.split('.').count() < 4 && !path.starts_with("variant") => {
            for (key, value) in table {
                let at = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                leaves(&at, value, into);
            }
        }
        Value::Table(_) if path.starts_with("variant") => {}
        value => into.push(format!("{path} = {value}")),
    }
}
