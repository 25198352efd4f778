//! `check` of a file with bearings only: their geometry and defect frequencies, variant by variant.

use rotordyn::io::json;
use rotordyn::model::{Diagnostic, LoadedBearings};
use rotordyn::warning::Warning;
use serde_json::{Value, json};

use super::bearing_list::{self, ListedBearing};
use super::failure::Failure;
use super::machine::ModelSource;
use super::outcome::print_file_warnings;
use super::settings::Settings;
use super::terminal::Terminal;

pub fn run(origin: &ModelSource, variants: &[String], terminal: &Terminal) -> Result<Value, Failure> {
    let load = |variant: &String| origin.with_variant(variant).load_bearings(&Settings::default());
    let loaded = variants.iter().map(load).collect::<Result<Vec<_>, _>>()?;
    let mut checked = Vec::new();
    for (k, (variant, file)) in variants.iter().zip(&loaded).enumerate() {
        let bearings = listed(file);
        if k == 0 {
            terminal.heading(&format!("{}: {}", file.name, file.title));
            terminal.print("  bearings only, without a machine: `rotordyn bearing` analyses them");
        } else {
            terminal.heading(&format!("Variant {variant}"));
        }
        bearing_list::print(terminal, &bearings);
        let warnings: Vec<Warning> = file.warnings.iter().filter_map(Diagnostic::to_warning).collect();
        checked.push(json!({
            "name": variant,
            "title": file.title,
            "bearings": bearing_list::to_json(&bearings),
            "warnings": json::warnings(&warnings),
        }));
    }
    for file in &loaded {
        print_file_warnings(terminal, &file.hints, &file.warnings, &file.sources);
    }
    let named = loaded.first().map(|file| (&file.name, &file.title));
    let (name, title) = named.ok_or_else(|| Failure::Input("nothing to check".into()))?;
    Ok(json!({ "command": "check", "model": name, "title": title, "variants": checked }))
}

fn listed(file: &LoadedBearings) -> Vec<ListedBearing<'_>> {
    let is_free = |name: &str| file.free_balls.iter().any(|(free, _)| free == name);
    let bearings = file.bearings.iter();
    bearings
        .map(|(name, balls)| ListedBearing {
            name,
            keyword: if is_free(name) { "free_ball" } else { "ball" },
            description: String::new(),
            balls: Some(balls),
        })
        .collect()
}
