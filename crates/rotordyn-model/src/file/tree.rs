//! The TOML document as a tree in file order, every key and value with its source span.

use std::collections::HashMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value and its source span.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub span: Range<usize>,
    pub value: Value,
}

#[derive(Clone, Debug)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    List(Vec<Node>),
    Table(Table),
    /// A date, or an integer beyond 64 bits.
    Other,
}

impl Value {
    /// Name of the type, for messages.
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Text(_) => "a string",
            Self::Integer(_) | Self::Float(_) => "a bare number",
            Self::Boolean(_) => "a boolean",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
            Self::Other => "a date or huge number",
        }
    }
}

/// Entries in file order, no key twice.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table {
    entries: Vec<Entry>,
    /// Place of every key: a file may have a hundred thousand of them.
    places: HashMap<String, usize>,
}

#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub key: String,
    /// Former spelling of the key, if the file uses it.
    pub former_key: Option<String>,
    pub key_span: Range<usize>,
    pub node: Node,
}

impl Entry {
    /// The key as it is written in the file.
    pub fn written_key(&self) -> &str {
        self.former_key.as_deref().unwrap_or(&self.key)
    }
}

impl Table {
    fn of(entries: Vec<Entry>) -> Self {
        let places = entries.iter().enumerate().map(|(place, e)| (e.key.clone(), place)).collect();
        Self { entries, places }
    }

    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    pub fn get(&self, key: &str) -> Option<&Entry> {
        self.places.get(key).map(|place| &self.entries[*place])
    }

    /// The value of a key.
    pub fn node_mut(&mut self, key: &str) -> Option<&mut Node> {
        self.places.get(key).map(|place| &mut self.entries[*place].node)
    }

    /// Replaces an entry, or adds it at the end.
    pub fn set(&mut self, entry: Entry) {
        match self.places.get(&entry.key) {
            Some(place) => self.entries[*place] = entry,
            None => {
                self.places.insert(entry.key.clone(), self.entries.len());
                self.entries.push(entry);
            }
        }
    }

    /// Gives the entry at a place the present spelling of its key, which no other has.
    pub fn rename(&mut self, place: usize, key: &str) {
        let entry = &mut self.entries[place];
        let former = std::mem::replace(&mut entry.key, key.into());
        self.places.remove(&former);
        self.places.insert(key.into(), place);
        entry.former_key = Some(former);
    }

    pub fn remove(&mut self, key: &str) -> Option<Entry> {
        let place = self.places.remove(key)?;
        self.places.values_mut().filter(|later| **later > place).for_each(|later| *later -= 1);
        Some(self.entries.remove(place))
    }

    pub fn into_entries(self) -> Vec<Entry> {
        self.entries
    }

    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|e| e.key.as_str())
    }

    /// Parse TOML text whose spans start at `offset`.
    pub fn parse(text: &str, offset: usize) -> Result<Self, toml::de::Error> {
        let root = DeTable::parse(text)?;
        Ok(table(root.get_ref(), offset))
    }
}

fn table(from: &DeTable<'_>, offset: usize) -> Table {
    let entry = |(key, value): (&Spanned<_>, &Spanned<DeValue<'_>>)| -> Entry {
        let name: &std::borrow::Cow<'_, str> = key.get_ref();
        Entry {
            key: name.to_string(),
            former_key: None,
            key_span: shift(key.span(), offset),
            node: node(value, offset),
        }
    };
    let mut entries: Vec<Entry> = from.iter().map(entry).collect();
    entries.sort_by_key(|e| e.key_span.start);
    Table::of(entries)
}

fn node(from: &Spanned<DeValue<'_>>, offset: usize) -> Node {
    let value = match from.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(i) => {
            i64::from_str_radix(i.as_str(), i.radix()).map_or(Value::Other, Value::Integer)
        }
        DeValue::Float(f) => f.as_str().parse().map_or(Value::Other, Value::Float),
        DeValue::Boolean(b) => Value::Boolean(*b),
        DeValue::Array(items) => Value::List(items.iter().map(|item| node(item, offset)).collect()),
        DeValue::Table(inner) => Value::Table(table(inner, offset)),
        DeValue::Datetime(_) => Value::Other,
    };
    Node { span: shift(from.span(), offset), value }
}

fn shift(span: Range<usize>, offset: usize) -> Range<usize> {
    span.start + offset..span.end + offset
}
