//! The items of a file: tables of names that the user chose, and lists of tables.

use super::diagnostic::{Kind, Problem};
use super::key::{Declared, Key, NamedTables, TableList};
use super::reader::Reader;
use super::tree::{Entry, Value};
use rotordyn_units::names::item_problem;
use std::ops::Range;

/// Most items of one kind, far more than a machine has: each may be compared with all others.
pub(crate) const MAX_ITEMS: usize = 5000;

impl<'a> Reader<'a> {
    /// The named tables under a key, `[disc.a]`, `[disc.b]`, in file order.
    pub fn items(&self, key: &Key<NamedTables>) -> Vec<(&'a str, Reader<'a>)> {
        let declared = key.value.0;
        let Some(all) = self.table_of(key, declared) else { return Vec::new() };
        let entries = all.table.entries();
        self.check_count(key, entries.len(), entries.get(MAX_ITEMS).map(|entry| &entry.key_span));
        let is_key = |entry: &&Entry| {
            let is_table = matches!(entry.node.value, Value::Table(_));
            !is_table && declared.keys().any(|known| known.name() == entry.key)
        };
        if let Some(first) = entries.iter().find(is_key) {
            let path = &all.path;
            let problem =
                Problem::new(Kind::WrongType, &first.key_span, format!("[{path}] has keys but no name"));
            self.log.error_once(problem.hint(format!("write [{path}.NAME], with a name of your choice")));
            self.log.add_cause(key.about.name);
        }
        let mut items = Vec::new();
        for entry in entries.iter().filter(|entry| !is_key(entry)).take(MAX_ITEMS) {
            let path = all.entry_name(&entry.key);
            self.check_item_name(key.about.name, entry);
            match &entry.node.value {
                Value::Table(table) => {
                    let paths = [path, all.declared_path.clone()];
                    let reader = Reader::new(table, declared, paths, entry.key_span.clone(), self.log);
                    items.push((entry.key.as_str(), reader));
                }
                _ => all.wrong_type(&entry.key, &entry.node, &format!("a table [{path}]")),
            }
        }
        items
    }

    /// The named table under a key.
    pub fn item(&self, key: &Key<NamedTables>, name: &str) -> Option<Reader<'a>> {
        let all = self.table_of(key, key.value.0)?;
        let entry = all.table.get(name)?;
        let Value::Table(table) = &entry.node.value else { return None };
        let paths = [all.entry_name(&entry.key), all.declared_path.clone()];
        Some(Reader::new(table, key.value.0, paths, entry.key_span.clone(), self.log))
    }

    /// Refuses the name of an item under a key, which becomes that of a group and part of names of files.
    pub(super) fn check_item_name(&self, of: &str, item: &Entry) {
        if let Some(reason) = item_problem(&item.key) {
            let message = format!("{:?} cannot be the name of a {of}: {reason}", item.key);
            let problem = Problem::new(Kind::OutOfRange, &item.key_span, message);
            self.log.error_once(problem.hint("names become groups of the results file and names of files"));
        }
    }

    /// The tables of a list, `[[shaft.section]]`.
    pub fn tables(&self, key: &Key<TableList>) -> Vec<Reader<'a>> {
        let Some(entry) = self.entry(key) else { return Vec::new() };
        let items = match &entry.node.value {
            Value::List(items) => items.as_slice(),
            _ => std::slice::from_ref(&entry.node),
        };
        self.check_count(key, items.len(), items.get(MAX_ITEMS).map(|item| &item.span));
        let mut readers = Vec::new();
        for (k, item) in items.iter().take(MAX_ITEMS).enumerate() {
            match &item.value {
                Value::Table(table) => {
                    let [path, declared_path] = self.paths(key);
                    let paths = [format!("{path}[{k}]"), declared_path];
                    readers.push(Reader::new(table, key.value.0, paths, item.span.clone(), self.log));
                }
                _ => self.wrong_type(key.name(), item, &format!("tables [[{}]]", self.name(key))),
            }
        }
        readers
    }

    /// Refuses more than [`MAX_ITEMS`] items; `beyond` is the first one too many.
    fn check_count(&self, key: &dyn Declared, count: usize, beyond: Option<&Range<usize>>) {
        let Some(span) = beyond else { return };
        let message = format!("{} has {count} items", self.name(key));
        let problem = Problem::new(Kind::OutOfRange, span, message);
        self.log.error_once(problem.expected(format!("at most {MAX_ITEMS}")));
    }
}
