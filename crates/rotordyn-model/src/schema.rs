//! JSON Schema of the model file, for completion and hover in editors: from the declared keys.

use crate::build::FILE;
use crate::file::key::{Absent, Declared, Group, Quantity, Table, ValueKind};
use crate::file::quantities::{SpacedKeys, range_words};
use rotordyn_units::NUMBER;
use serde_json::{Map, Value, json};

/// The schema (draft 7) of a model file.
///
/// What it cannot express, the reader still checks: units, ranges of quantities, names of other items, keys that apply
/// only with others.
pub fn json_schema() -> Value {
    let mut schema = table(&FILE);
    // A variant overrides any key of the file.
    schema["properties"]["variant"]["additionalProperties"]["additionalProperties"] = json!(true);
    let head = json!({
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "rotordyn model file",
        "description": FILE.meaning,
    });
    if let (Value::Object(schema), Value::Object(head)) = (&mut schema, head) {
        schema.extend(head);
    }
    schema
}

/// Object with the keys of a table.
fn table(table: &Table) -> Value {
    let mut properties: Map<String, Value> = Map::new();
    let mut required = Vec::new();
    for group in table.groups {
        for key in group.keys {
            let own = property(*key, group);
            match properties.get_mut(key.name()) {
                None => {
                    properties.insert(key.name().into(), own);
                }
                Some(known) => add_form(known, own),
            }
            let always = group.condition.is_empty() && key.about().condition.is_empty();
            let is_required = matches!(key.about().absent, Absent::Required | Absent::RequiredIf(""));
            if always && is_required && !required.contains(&key.name()) {
                required.push(key.name());
            }
        }
    }
    // A table without declared keys has names of the user.
    let open = table.groups.is_empty();
    let mut out = json!({ "type": "object", "properties": properties, "additionalProperties": open });
    if !required.is_empty() {
        out["required"] = json!(required);
    }
    out
}

/// Another form of a key, or the same key under another condition.
fn add_form(known: &mut Value, own: Value) {
    if *known == own {
        return;
    }
    if let Some(Value::Array(forms)) = known.get_mut("anyOf") {
        if !forms.contains(&own) {
            forms.push(own);
        }
        return;
    }
    let first = known.take();
    *known = json!({ "description": first["description"], "anyOf": [first, own] });
}

/// Type and description of a key.
fn property(key: &dyn Declared, group: &Group) -> Value {
    let mut out = of_kind(&key.kind());
    let about = key.about();
    let mut words = vec![about.meaning.to_string()];
    if let Some(unit) = unit_of(&key.kind()) {
        words.push(unit);
    }
    let conditions: Vec<&str> =
        [group.condition, about.condition].into_iter().filter(|c| !c.is_empty()).collect();
    if !conditions.is_empty() {
        words.push(format!("With {}.", conditions.join(", ")));
    }
    match (about.absent, key.default_text()) {
        (_, Some(default)) => words.push(format!("Default: {default}.")),
        (Absent::Computed(how), _) => words.push(format!("Default: {how}.")),
        (Absent::RequiredIf(when), _) if !when.is_empty() => words.push(format!("Required, {when}.")),
        _ => {}
    }
    out["description"] = json!(words.join(" "));
    let example = key.example();
    if !example.is_empty() && !example.starts_with(['[', '{']) {
        out["examples"] = json!([example.trim_matches('"')]);
    }
    out
}

fn unit_of(kind: &ValueKind) -> Option<String> {
    let each = match kind {
        ValueKind::Quantity(each) | ValueKind::Spaced(each) | ValueKind::NamedQuantities(each) => *each,
        ValueKind::Quantities(many) => many.each,
        _ => return None,
    };
    let range = range_words(each);
    let range = if range.is_empty() { String::new() } else { format!(", {range}") };
    match each.dimension.unit {
        "" => (!range.is_empty()).then(|| format!("Number{range}.")),
        unit => Some(format!("{} with its unit, such as {unit}{range}.", capitalised(each.dimension.name))),
    }
}

fn capitalised(word: &str) -> String {
    let mut chars = word.chars();
    chars.next().map_or(String::new(), |first| first.to_uppercase().chain(chars).collect())
}

/// A quantity is text with its unit; a pure number needs no quotes.
fn quantity(each: Quantity) -> Value {
    if each.dimension == NUMBER {
        json!({ "type": ["number", "string"] })
    } else {
        json!({ "type": "string" })
    }
}

/// One quantity, text of several, or a list.
fn quantities(each: Quantity) -> Vec<Value> {
    vec![quantity(each), json!({ "type": "array", "items": quantity(each), "minItems": 1 })]
}

fn of_kind(kind: &ValueKind) -> Value {
    let named = |of: Value| json!({ "type": "object", "additionalProperties": of });
    match kind {
        ValueKind::Quantity(each) => quantity(*each),
        ValueKind::Quantities(many) => json!({ "anyOf": quantities(many.each) }),
        ValueKind::Spaced(each) => {
            let mut forms = quantities(*each);
            forms.push(spaced());
            json!({ "anyOf": forms })
        }
        ValueKind::NamedQuantities(each) => named(quantity(*each)),
        ValueKind::Count(count) => {
            json!({ "type": "integer", "minimum": count.least, "maximum": count.greatest })
        }
        ValueKind::Flag => json!({ "type": "boolean" }),
        ValueKind::Words(words) => json!({ "enum": words }),
        ValueKind::Text(_) | ValueKind::PowerStiffness(_) => json!({ "type": "string" }),
        ValueKind::Texts(_) => json!({ "type": ["string", "array"], "items": { "type": "string" } }),
        ValueKind::Special(_) => json!({}),
        ValueKind::SubTable(of) => table(of),
        ValueKind::NamedTables(of) => named(table(of)),
        ValueKind::TableList(of) => json!({ "type": "array", "items": table(of) }),
    }
}

/// Values spaced evenly: the quantities of its ends have the dimension of the key.
fn spaced() -> Value {
    let mut out = table(SpacedKeys::TABLE);
    for end in ["from", "to", "step"] {
        out["properties"][end]["type"] = json!(["string", "number"]);
    }
    out
}
