//! The declared keys of the model file, described: for `rotordyn help`, a schema or a reference.
//!
//! ```
//! use rotordyn_model::keys;
//! let found = keys::find("bearing.preload.force").unwrap();
//! assert_eq!(found.keys[0].unit, "N");
//! assert_eq!(found.keys[0].range, "greater than zero");
//! ```

use crate::build::FILE;
use crate::file::key::{Absent, Declared, Group, Key, Quantity, Table, ValueKind};
use crate::file::quantities::{SPACED, SpacedKeys, range_words};
use crate::file::renamed::renamed_part;
use rotordyn_units::NUMBER;
use rotordyn_units::names::nearest;
use serde_json::{Value, json};
use std::rc::Rc;

/// A key as plain text.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyDescription {
    /// Path without names of items: "bearing.preload.force".
    pub path: String,
    pub name: &'static str,
    pub kind: KindName,
    /// What the value is: "length", "one of hertz, film", "name of a station".
    pub value: String,
    /// SI unit of a quantity.
    pub unit: &'static str,
    /// Range of the value, "greater than zero"; empty without one.
    pub range: String,
    /// Words that are accepted; empty if the value is none of several words.
    pub words: Vec<&'static str>,
    /// Whether the key must always be given.
    pub required: bool,
    /// Default as it would be written in a file, if it is fixed.
    pub default: Option<String>,
    /// What holds without the key: its default, how it follows, or when the key is required; empty: nothing.
    pub absent: String,
    /// Assignments in the same table, in TOML, with which the key's group applies: alternatives, "" is always.
    pub groups: Vec<&'static str>,
    /// Example of further assignments, in TOML, with which the key applies; "" is always.
    pub condition: &'static str,
    pub meaning: &'static str,
    /// Value as it could be written in a file; empty for a table.
    pub example: String,
    /// Number of keys of a table.
    pub members: usize,
}

impl KeyDescription {
    /// Examples of assignments in the same table, in TOML, with which the key applies, one per group: "" is always.
    pub fn conditions(&self) -> Vec<String> {
        let both = |group: &&str| {
            [*group, self.condition]
                .into_iter()
                .filter(|words| !words.is_empty())
                .collect::<Vec<_>>()
                .join(", ")
        };
        self.groups.iter().map(both).collect()
    }
}

/// What `rotordyn help --json` says of a key.
impl From<&KeyDescription> for Value {
    fn from(key: &KeyDescription) -> Self {
        json!({
            "path": key.path,
            "name": key.name,
            "kind": key.kind.name(),
            "value": key.value,
            "unit": key.unit,
            "range": key.range,
            "words": key.words,
            "required": key.required,
            "default": key.default,
            "absent": key.absent,
            "conditions": key.conditions(),
            "meaning": key.meaning,
            "example": key.example,
            "members": key.members,
        })
    }
}

/// Type of a key's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KindName {
    Quantity,
    Quantities,
    Spaced,
    NamedQuantities,
    Count,
    Flag,
    Word,
    Text,
    Texts,
    PowerStiffness,
    Special,
    Table,
    NamedTables,
    TableList,
}

impl KindName {
    /// Name in documents.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quantity => "quantity",
            Self::Quantities => "quantities",
            Self::Spaced => "spaced quantities",
            Self::NamedQuantities => "named quantities",
            Self::Count => "count",
            Self::Flag => "flag",
            Self::Word => "word",
            Self::Text => "text",
            Self::Texts => "texts",
            Self::PowerStiffness => "stiffness of a power law",
            Self::Special => "special",
            Self::Table => "table",
            Self::NamedTables => "named tables",
            Self::TableList => "list of tables",
        }
    }
}

/// A key found by its path.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// Path without names of items; empty for the whole file.
    pub path: String,
    /// What it is: empty for the whole file, several for a key with several forms.
    pub keys: Vec<KeyDescription>,
    /// Keys of the tables that it is.
    pub members: Vec<KeyDescription>,
    /// The path as asked for, if a part of it has been renamed.
    pub former: Option<String>,
}

/// What `rotordyn help --json` says of a path.
impl From<&Found> for Value {
    fn from(found: &Found) -> Self {
        json!({
            "command": "help",
            "path": found.path,
            "keys": found.keys.iter().map(Self::from).collect::<Vec<_>>(),
            "members": found.members.iter().map(Self::from).collect::<Vec<_>>(),
        })
    }
}

/// A path that is not declared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the model file has no key `{path}`{}", suggestion(.nearest))]
pub struct UnknownKey {
    pub path: String,
    /// Paths that may be meant, nearest first.
    pub nearest: Vec<String>,
}

fn suggestion(nearest: &[String]) -> String {
    match nearest {
        [] => String::new(),
        [one] => format!("; did you mean {one}?"),
        several => format!("; did you mean one of {}?", several.join(", ")),
    }
}

/// A declared key where it stands.
struct Place {
    /// Path of its table; empty for the whole file.
    table: Rc<str>,
    conditions: Rc<[&'static str]>,
    key: &'static dyn Declared,
    /// Dimension and range of a key of evenly spaced values.
    each: Option<Quantity>,
}

impl Place {
    fn path(&self) -> String {
        match &*self.table {
            "" => self.key.name().into(),
            table => format!("{table}.{}", self.key.name()),
        }
    }
}

/// Find a key by its path, with or without names of items: `bearing.preload.force`, `bearing.B.preload`, `station.A`.
///
/// # Errors
/// A path that is not declared, with the nearest ones.
pub fn find(path: &str) -> Result<Found, UnknownKey> {
    let Located { here, members, renamed } = locate(path)?;
    Ok(Found {
        path: here.first().map_or_else(String::new, Place::path),
        keys: here.iter().map(description).collect(),
        members: members.iter().map(description).collect(),
        former: renamed.then(|| path.to_string()),
    })
}

/// The description of a key by its path, the first one of a key with several forms; `None` for the whole file.
///
/// # Errors
/// As [`find`].
pub fn describe_key(path: &str) -> Result<Option<KeyDescription>, UnknownKey> {
    Ok(locate(path)?.here.first().map(description))
}

/// The path of a key without names of items, as [`KeyDescription::path`]; empty for the whole file.
///
/// # Errors
/// As [`find`].
pub fn declared_path(path: &str) -> Result<String, UnknownKey> {
    Ok(locate(path)?.here.first().map_or_else(String::new, Place::path))
}

/// Where a path leads.
struct Located {
    /// The key, in all its forms; empty for the whole file.
    here: Vec<Place>,
    /// Keys of the tables that it is.
    members: Vec<Place>,
    /// Whether a part of the path has been renamed.
    renamed: bool,
}

fn locate(path: &str) -> Result<Located, UnknownKey> {
    let mut here: Vec<Place> = Vec::new();
    let mut members = keys_of(&FILE, "");
    let mut canonical: Vec<String> = Vec::new();
    let mut renamed = false;
    let parts: Vec<&str> = path.split('.').map(str::trim).filter(|part| !part.is_empty()).collect();
    for (k, part) in parts.iter().enumerate() {
        let names: Vec<&str> = canonical.iter().map(String::as_str).chain([*part]).collect();
        let present = renamed_part(&names, names.len() - 1);
        let name = present.unwrap_or(part);
        let matching = |place: &Place| place.key.name() == name;
        if !members.iter().any(matching) {
            let is_item = here
                .iter()
                .any(|place| matches!(place.key.kind(), ValueKind::NamedTables(_) | ValueKind::TableList(_)));
            let is_last = k + 1 == parts.len();
            if is_item && (!is_last || part.parse::<usize>().is_ok() || *part == "*") {
                continue;
            }
            let is_quantity =
                here.iter().any(|place| matches!(place.key.kind(), ValueKind::NamedQuantities(_)));
            if is_quantity && is_last {
                continue;
            }
            return Err(unknown(path, part, &members));
        }
        renamed |= present.is_some();
        here = members.into_iter().filter(matching).collect();
        members = here.iter().flat_map(members_of).collect();
        canonical.push(name.into());
        if here.iter().any(|place| matches!(place.key.kind(), ValueKind::NamedTables(_))) {
            canonical.push("*".into());
        }
    }
    Ok(Located { here, members, renamed })
}

/// Every declared key of the file, tables before their keys.
pub fn all() -> Vec<KeyDescription> {
    fn add(places: Vec<Place>, all: &mut Vec<KeyDescription>) {
        for place in places {
            all.push(description(&place));
            add(members_of(&place), all);
        }
    }
    let mut found = Vec::new();
    add(keys_of(&FILE, ""), &mut found);
    found
}

/// What the model file is.
pub fn meaning() -> &'static str {
    FILE.meaning
}

fn unknown(path: &str, part: &str, members: &[Place]) -> UnknownKey {
    let mut found: Vec<String> = Vec::new();
    if let Some(near) = nearest(part, members.iter().map(|place| place.key.name())) {
        found.extend(members.iter().find(|place| place.key.name() == near).map(Place::path));
    }
    // the key of another table: its last part is known elsewhere
    let last = path.rsplit('.').next().unwrap_or(path);
    let elsewhere = all().into_iter().filter(|key| key.name == last).map(|key| key.path);
    found.extend(elsewhere);
    let mut seen = Vec::new();
    found.retain(|path| {
        !seen.contains(path) && {
            seen.push(path.clone());
            true
        }
    });
    found.truncate(6);
    UnknownKey { path: path.into(), nearest: found }
}

/// Keys of a table, each once for all conditions under which its group is read.
fn keys_of(table: &'static Table, path: &str) -> Vec<Place> {
    let same = |a: &Group, b: &Group| std::ptr::eq(a.keys.as_ptr(), b.keys.as_ptr());
    let path: Rc<str> = path.into();
    let mut places = Vec::new();
    for (k, group) in table.groups.iter().enumerate() {
        if table.groups[..k].iter().any(|earlier| same(earlier, group)) {
            continue;
        }
        let conditions: Rc<[&str]> =
            table.groups.iter().filter(|other| same(other, group)).map(|other| other.condition).collect();
        places.extend(group.keys.iter().map(|key| Place {
            table: path.clone(),
            conditions: conditions.clone(),
            key: *key,
            each: None,
        }));
    }
    places
}

fn members_of(place: &Place) -> Vec<Place> {
    match place.key.kind() {
        ValueKind::SubTable(table) | ValueKind::NamedTables(table) | ValueKind::TableList(table) => {
            keys_of(table, &place.path())
        }
        ValueKind::Spaced(each) => {
            let mut members = keys_of(SpacedKeys::TABLE, &place.path());
            members.iter_mut().for_each(|member| member.each = Some(each));
            members
        }
        _ => Vec::new(),
    }
}

fn description(place: &Place) -> KeyDescription {
    match (place.each, place.key.kind()) {
        (Some(each), ValueKind::Quantity(own)) => {
            // the step of speeds may be any positive one
            let range = if place.key.is(&SPACED.step) { own.range } else { each.range };
            let value = Quantity { dimension: each.dimension, range };
            describe(place, &Key { about: *place.key.about(), value })
        }
        _ => describe(place, place.key),
    }
}

fn describe(place: &Place, key: &dyn Declared) -> KeyDescription {
    let about = key.about();
    let value = value_of(key);
    let default = key.default_text();
    let absent = match (about.absent, &default) {
        (_, Some(default)) => default.clone(),
        (Absent::Required | Absent::RequiredIf(""), _) => "required".into(),
        (Absent::RequiredIf(words), _) => format!("required, {words}"),
        (Absent::Computed(words), _) => words.into(),
        _ => String::new(),
    };
    KeyDescription {
        path: place.path(),
        name: key.name(),
        kind: value.kind,
        value: value.words,
        unit: value.unit,
        range: value.range,
        words: value.choices,
        required: matches!(about.absent, Absent::Required | Absent::RequiredIf("")),
        default,
        absent,
        groups: place.conditions.to_vec(),
        condition: about.condition,
        meaning: about.meaning,
        example: key.example(),
        members: members_of(place).len(),
    }
}

/// What is said of a value by its type.
struct ValueWords {
    kind: KindName,
    words: String,
    unit: &'static str,
    range: String,
    choices: Vec<&'static str>,
}

fn value_of(key: &dyn Declared) -> ValueWords {
    let plain =
        |kind, words: String| ValueWords { kind, words, unit: "", range: String::new(), choices: Vec::new() };
    let of = |kind, words: String, each: Quantity| ValueWords {
        kind,
        words,
        unit: each.dimension.unit,
        range: range_words(each),
        choices: Vec::new(),
    };
    let name = |each: Quantity| if each.dimension == NUMBER { "number" } else { each.dimension.name };
    match key.kind() {
        ValueKind::Quantity(each) => of(KindName::Quantity, name(each).into(), each),
        ValueKind::Quantities(many) => {
            of(KindName::Quantities, format!("{}: {}", name(many.each), many.count), many.each)
        }
        ValueKind::Spaced(each) => {
            of(KindName::Spaced, format!("{}: one or more, or spaced", name(each)), each)
        }
        ValueKind::NamedQuantities(each) => {
            of(KindName::NamedQuantities, format!("NAME = {}", name(each)), each)
        }
        ValueKind::Count(count) => {
            let range = match count.greatest {
                greatest if greatest > 1 << 40 => format!("{} or more", count.least),
                greatest => format!("from {} to {greatest}", count.least),
            };
            ValueWords { range, ..plain(KindName::Count, "whole number".into()) }
        }
        ValueKind::Flag => plain(KindName::Flag, "true or false".into()),
        ValueKind::Words(words) => {
            let quoted: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
            ValueWords { choices: words, ..plain(KindName::Word, quoted.join(", ")) }
        }
        ValueKind::Text(what) => plain(KindName::Text, what.into()),
        ValueKind::Texts(what) => plain(KindName::Texts, what.into()),
        ValueKind::PowerStiffness(exponent) => {
            plain(KindName::PowerStiffness, format!("stiffness in N/m^{exponent}"))
        }
        ValueKind::Special(what) => plain(KindName::Special, what.into()),
        ValueKind::SubTable(_) => plain(KindName::Table, "table".into()),
        ValueKind::NamedTables(_) => plain(KindName::NamedTables, "named tables".into()),
        ValueKind::TableList(_) => plain(KindName::TableList, "list of tables".into()),
    }
}
