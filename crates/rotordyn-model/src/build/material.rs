//! The material that a key names.

use super::super::file::diagnostic::{Kind, Problem};
use super::super::file::key::{Key, Text};
use super::super::file::reader::{Reader, missing_table_problem};
use rotordyn_core::element::Material;

/// What a file without materials needs.
const STEEL: &str = "[material.steel] with young = \"207 GPa\", poisson = 0.3 and density = \"7850 kg/m^3\"";

/// Material named by a key; without the key, the only material of the file.
pub(super) fn material(r: &Reader, key: &Key<Text>, materials: &[Material]) -> Option<Material> {
    let Some(name) = r.text(key) else {
        if !r.has(key) {
            if let [only] = materials {
                return Some(only.clone());
            }
            match materials.first() {
                Some(first) => r.missing_as(key, &format!("\"{}\"", first.name)),
                None => r.log.error_once(missing_table_problem("material").hint(format!("add {STEEL}"))),
            }
        }
        return None;
    };
    let found = materials.iter().find(|m| m.name == name);
    if found.is_none() {
        let message = format!("unknown material `{name}`");
        let problem = Problem::new(Kind::UnknownName, &r.span_of(key), message);
        let problem = problem.suggest(r.log, name, materials.iter().map(|m| m.name.as_str()));
        r.log.error(if materials.is_empty() {
            problem.hint(format!("add [material.{name}]")).follows("material")
        } else {
            problem.follows("material")
        });
    }
    found.cloned()
}
