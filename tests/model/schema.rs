//! The JSON Schema of the model file: every declared key is in it, and every model is valid.

use rotordyn::model::keys::{self, KindName};
use rotordyn::model::schema::json_schema;
use serde_json::Value;
use std::path::Path;

/// A schema and all its alternatives.
fn forms(schema: &Value) -> Vec<&Value> {
    let alternatives = schema["anyOf"].as_array().into_iter().flatten().flat_map(forms);
    std::iter::once(schema).chain(alternatives).collect()
}

/// Schemas of the keys of a table: of a table itself, of every item of named tables or of a list.
fn members<'a>(schema: &'a Value, name: &str) -> Vec<&'a Value> {
    let tables =
        forms(schema).into_iter().flat_map(|form| [form, &form["additionalProperties"], &form["items"]]);
    tables.flat_map(forms).map(|table| &table["properties"][name]).filter(|found| !found.is_null()).collect()
}

#[test]
fn every_declared_key_is_in_the_schema() {
    let schema = json_schema();
    let all = keys::all();
    // `rotordyn help` and the reader use the same list.
    assert!(all.len() > 400, "{} keys", all.len());
    for key in all {
        let mut here = vec![&schema];
        for part in key.path.split('.') {
            here = here.into_iter().flat_map(|at| members(at, part)).collect();
            assert!(!here.is_empty(), "{} is not in the schema", key.path);
        }
        let described = |at: &&Value| {
            forms(at)
                .into_iter()
                .any(|form| form["description"].as_str().is_some_and(|words| words.contains(key.meaning)))
        };
        assert!(here.iter().any(described), "{}: {}", key.path, key.meaning);
        if key.kind == KindName::Word {
            let has = |word: &str| {
                here.iter().flat_map(|at| forms(at)).any(|form| {
                    form["enum"].as_array().is_some_and(|words| words.iter().any(|known| known == word))
                })
            };
            assert!(key.words.iter().all(|word| has(word)), "{}: {:?}", key.path, key.words);
        }
    }
}

fn as_json(text: &str) -> Value {
    serde_json::to_value(text.parse::<toml::Table>().unwrap()).unwrap()
}

#[test]
fn models_are_valid_and_slips_are_not() {
    let schema = json_schema();
    let validator = jsonschema::draft7::new(&schema).unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for folder in ["models", "assets/init"] {
        for file in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = file.unwrap().path();
            if path.extension().is_none_or(|e| e != "toml") {
                continue;
            }
            let model = as_json(&std::fs::read_to_string(&path).unwrap());
            let wrong: Vec<String> =
                validator.iter_errors(&model).map(|e| format!("{}: {e}", e.instance_path())).collect();
            assert!(wrong.is_empty(), "{}:\n{}", path.display(), wrong.join("\n"));
            count += 1;
        }
    }
    assert!(count >= 12, "{count} models");
    let text = std::fs::read_to_string(root.join("models/jeffcott.toml")).unwrap();
    let slip = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        !validator.is_valid(&as_json(&text.replacen(from, to, 1)))
    };
    assert!(slip("[shaft]", "[shaft]\ncolour = \"red\""), "unknown key");
    assert!(slip("poisson", "poison"), "misspelt key");
    assert!(slip("[study.modal]", "[study.model]"), "unknown study");
    assert!(!slip("[shaft]", "[shaft]\n# a comment"));
}

#[test]
fn a_schema_line_is_accepted() {
    let text = include_str!("../../models/jeffcott.toml");
    for line in ["#:schema rotordyn.schema.json", "\"$schema\" = \"rotordyn.schema.json\""] {
        let loaded = rotordyn::model::load("m.toml", format!("{line}\n{text}"), &Default::default()).unwrap();
        assert!(loaded.warnings.is_empty(), "{line}");
    }
}
