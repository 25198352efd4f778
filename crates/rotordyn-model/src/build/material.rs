//! The material that a key names.

use super::super::file::diagnostic::{Kind, Problem};
use super::super::file::key::{Key, Text};
use super::super::file::reader::Reader;
use rotordyn_core::element::Material;

/// Material named by a key; without the key, the only material of the file.
pub(super) fn material(r: &Reader, key: &Key<Text>, materials: &[Material]) -> Option<Material> {
    let Some(name) = r.text(key) else {
        if !r.has(key) {
            if let [only] = materials {
                return Some(only.clone());
            }
            let example = materials.first().map_or("steel", |m| &m.name);
            r.missing_as(key, &format!("\"{example}\""));
        }
        return None;
    };
    let found = materials.iter().find(|m| m.name == name);
    if found.is_none() {
        let message = format!("unknown material `{name}`");
        let problem = Problem::new(Kind::UnknownName, &r.span_of(key), message);
        let problem = problem.suggest(r.log, name, materials.iter().map(|m| m.name.as_str()));
        r.log.error(if materials.is_empty() {
            problem.hint(format!("add [material.{name}]"))
        } else {
            problem
        });
    }
    found.cloned()
}
