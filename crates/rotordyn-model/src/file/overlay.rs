//! Overrides of the document before validation: variants and `--set` arguments.

use super::diagnostic::{Kind, Log, Problem, Sources};
use super::items::MAX_ITEMS;
use super::key::{NamedTables, Text, Texts, keys, named_tables, text, texts};
use super::renamed;
use super::tree::{Entry, Node, Table, Value};
use rotordyn_units::names::folder_problem;
use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

/// Tables whose entries are named items: `bearing.B`, `housing.A`.
pub(crate) const COLLECTIONS: &[&str] = &[
    "material",
    "lubricant",
    "disc",
    "body",
    "housing",
    "sensor",
    "bushing",
    "joint",
    "bearing",
    "belt",
    "unbalance",
    "load",
    "probe",
];

/// Most variants of a file: `check` reads the file once for each.
const MAX_VARIANTS: usize = 1000;

keys! {
    /// Tables of this file.
    pub(crate) static TOP: VariantTopKeys {
        variant: NamedTables = named_tables(VariantKeys::TABLE);
    }
}

keys! {
    /// `[variant.x]`.
    pub(crate) static VARIANT: VariantKeys = "A variant of the machine: besides these keys any other of the file, which it overrides." {
        based_on: Text = text("name of another variant", "Variant that it builds on.").optional()
            .example("\"wavy\"");
        remove: Texts = texts("paths of items", "Items that it lacks.").optional()
            .example("[\"housing.A\", \"belt.drive\"]");
    }
}

/// Merge the named variant into the document and remove the `variant` table.
///
/// A variant may build on another (`based_on = "wavy"`), remove items (`remove = ["housing.A"]`), and set any
/// other key of the file: tables are merged, all other values are replaced.
pub(crate) fn apply_variant(root: &mut Table, wanted: Option<&str>, log: &Log) {
    let (variants, place) = match root.remove(TOP.variant.about.name) {
        Some(Entry { key_span, node: Node { value: Value::Table(table), .. }, .. }) => (table, key_span),
        Some(entry) => {
            log.error(
                Problem::new(
                    Kind::WrongType,
                    &entry.node.span,
                    "`variant` must be a table of named variants",
                )
                .hint("write [variant.NAME]"),
            );
            return;
        }
        None => (Table::default(), 0..0),
    };
    check_names(&variants, log);
    let Some(name) = wanted else { return };
    let mut chain: Vec<&Entry> = Vec::new();
    let mut next = Some((name.to_string(), place));
    while let Some((name, asked_at)) = next.take() {
        let Some(entry) = variants.get(&name) else {
            let problem = Problem::new(Kind::UnknownName, &asked_at, format!("unknown variant `{name}`"));
            log.error(match variants.entries().len() {
                0 => problem.hint("the file has no variants"),
                _ => problem.suggest(log, &name, variants.keys()),
            });
            return;
        };
        if chain.iter().any(|e| e.key == name) {
            log.error(Problem::new(
                Kind::Conflict,
                &asked_at,
                format!("variant `{name}` is based on itself"),
            ));
            return;
        }
        chain.push(entry);
        if let Value::Table(table) = &entry.node.value
            && let Some(base) = table.get(VARIANT.based_on.about.name)
        {
            match &base.node.value {
                Value::Text(base_name) => next = Some((base_name.clone(), base.node.span.clone())),
                _ => log.error(Problem::new(
                    Kind::WrongType,
                    &base.node.span,
                    "`based_on` must be the name of a variant",
                )),
            }
        }
    }
    for entry in chain.into_iter().rev() {
        let Value::Table(table) = &entry.node.value else {
            log.error(Problem::new(
                Kind::WrongType,
                &entry.node.span,
                format!("variant `{}` must be a table", entry.key),
            ));
            continue;
        };
        let mut overrides = table.clone();
        overrides.remove(VARIANT.based_on.about.name);
        if let Some(list) = overrides.remove(VARIANT.remove.about.name) {
            remove(root, &list, log);
        }
        renamed::translate(&mut overrides, log);
        let mut keys = Vec::new();
        key_starts(&overrides, &mut keys);
        log.add_variant(keys);
        note_added_items(root, &overrides, log);
        merge(root, overrides);
    }
}

/// Refuses names that would lead out of the folder of results, or to that of another variant.
fn check_names(variants: &Table, log: &Log) {
    if let Some(beyond) = variants.entries().get(MAX_VARIANTS) {
        let message = format!("the file has {} variants", variants.entries().len());
        let problem = Problem::new(Kind::OutOfRange, &beyond.key_span, message);
        log.error(problem.expected(format!("at most {MAX_VARIANTS}")));
    }
    let mut in_lower_case = HashMap::new();
    for Entry { key, key_span, .. } in variants.entries() {
        let refuse = |reason: String| {
            let message = format!("{key:?} cannot be the name of a variant: {reason}");
            let problem = Problem::new(Kind::OutOfRange, key_span, message);
            log.error(
                problem
                    .hint("its results go to the folder out/NAME_VARIANT: use letters, digits, `_` and `-`"),
            );
        };
        match folder_problem(key) {
            Some(reason) => refuse(reason),
            None => {
                let other = *in_lower_case.entry(key.to_lowercase()).or_insert(key);
                if other != key {
                    refuse(format!("it differs from `{other}` only in upper and lower case"));
                }
            }
        }
    }
}

fn remove(root: &mut Table, list: &Entry, log: &Log) {
    let Value::List(paths) = &list.node.value else {
        log.error(
            Problem::new(Kind::WrongType, &list.node.span, "`remove` must be a list of paths")
                .expected("such as [\"housing.A\", \"belt.drive\"]"),
        );
        return;
    };
    if let Some(beyond) = paths.get(MAX_ITEMS) {
        let problem =
            Problem::new(Kind::OutOfRange, &beyond.span, format!("`remove` has {} paths", paths.len()));
        log.error(problem.expected(format!("at most {MAX_ITEMS}")));
    }
    for path in paths.iter().take(MAX_ITEMS) {
        let Value::Text(text) = &path.value else {
            log.error(Problem::new(Kind::WrongType, &path.span, "a path to remove must be a string"));
            continue;
        };
        let mut table = &mut *root;
        let present = renamed::renamed_path(text);
        if let Some(present) = &present {
            log.hint(Problem::new(Kind::FormerName, &path.span, renamed::hint(text, present)));
        }
        let parts: Vec<&str> = present.as_deref().unwrap_or(text).split('.').collect();
        for (depth, part) in parts.iter().enumerate() {
            if table.get(part).is_none() {
                let problem =
                    Problem::new(Kind::BadPath, &path.span, format!("there is no `{text}` to remove"));
                log.error(problem.suggest(log, part, table.keys()));
                break;
            }
            if depth + 1 == parts.len() {
                table.remove(part);
                break;
            }
            match table.node_mut(part) {
                Some(Node { value: Value::Table(inner), .. }) => table = inner,
                _ => {
                    log.error(Problem::new(Kind::BadPath, &path.span, format!("`{part}` is not a table")));
                    break;
                }
            }
        }
    }
}

/// Most names of other items in a message.
const MAX_NAMES: usize = 12;

/// Records the items that a variant adds to others of their kind: they may be misspelt.
fn note_added_items(root: &Table, overrides: &Table, log: &Log) {
    for kind in COLLECTIONS {
        let (Some(known), Some(given)) = (items(root, kind), items(overrides, kind)) else { continue };
        let mut names: Vec<&str> = known.keys().take(MAX_NAMES).collect();
        names.extend((known.entries().len() > MAX_NAMES).then_some("..."));
        let names: Rc<str> = names.join(", ").into();
        for entry in given.entries().iter().filter(|entry| known.get(&entry.key).is_none()) {
            log.add_item(entry.key_span.start, Rc::clone(&names));
        }
    }
}

/// The named tables of a kind.
fn items<'t>(table: &'t Table, kind: &str) -> Option<&'t Table> {
    match table.get(kind).map(|entry| &entry.node.value) {
        Some(Value::Table(items)) => Some(items),
        _ => None,
    }
}

/// Starts of all keys of a table and of those within.
fn key_starts(table: &Table, found: &mut Vec<usize>) {
    for entry in table.entries() {
        found.push(entry.key_span.start);
        if let Value::Table(inner) = &entry.node.value {
            key_starts(inner, found);
        }
    }
}

fn merge(into: &mut Table, from: Table) {
    for entry in from.into_entries() {
        let Some(Node { value: Value::Table(old), .. }) = into.node_mut(&entry.key) else {
            into.set(entry);
            continue;
        };
        match entry.node.value {
            Value::Table(new) => merge(old, new),
            value => into.set(Entry { node: Node { span: entry.node.span, value }, ..entry }),
        }
    }
}

/// Most parts of a path, far above what any key needs (`study.bifurcation.a.parameter.1.path`): tables within tables are
/// followed by calls within calls.
const MAX_PARTS: usize = 32;

/// Apply one `--set PATH=VALUE`; the value is parsed as TOML, or taken as a string if it is not TOML
/// (`20 um`).
///
/// `is_text`: whether the key wants a text, which may look like a number (`6208`).
pub(crate) fn apply_set(
    root: &mut Table,
    [path, value]: [&str; 2],
    is_text: bool,
    sources: &mut Sources,
    log: &Log,
) {
    let text = format!("{path}={value}");
    let start = sources.push("--set", text);
    let value_start = start + path.len() + 1;
    let span = value_start..value_start + value.len();
    let parsed = Table::parse(&format!("x={value}"), value_start.saturating_sub(2));
    let mut entries = parsed.map_or(Vec::new(), Table::into_entries);
    let mut node = match entries.pop() {
        Some(Entry { node: Node { value: Value::Integer(_) | Value::Float(_), .. }, .. }) if is_text => {
            Node { span, value: Value::Text(value.trim().to_string()) }
        }
        Some(only) if entries.is_empty() && !value.contains('\n') => only.node,
        _ => Node { span, value: Value::Text(value.trim().to_string()) },
    };
    let mut parts = path_parts(path, start);
    if parts.len() > MAX_PARTS {
        let message = format!("a path of {} parts; the model file has at most {MAX_PARTS}", parts.len());
        let problem = Problem::new(Kind::BadPath, &parts[MAX_PARTS].span, message);
        log.error(problem.hint("such as bearing.B.radial_clearance"));
        return;
    }
    let mut names: Vec<&str> = parts.iter().map(|part| part.name).collect();
    for k in 0..names.len() {
        if let Some(new) = renamed::renamed_part(&names, k) {
            let old_path = names.join(".");
            names[k] = new;
            let message = renamed::hint(&old_path, &names.join("."));
            log.hint(Problem::new(Kind::FormerName, &parts[k].span, message));
            parts[k].name = new;
        }
    }
    renamed::translate_node(&mut node, &mut names.into_iter().map(String::from).collect(), log);
    if let Err(problem) = set_in_table(root, &Setting { path, parts: &parts, log }, 0, node) {
        log.error(problem);
    }
}

/// One step of a path.
struct Part<'p> {
    name: &'p str,
    span: Range<usize>,
}

/// Parts of a path that starts at an offset; items of lists as `.0` or, as messages write them, `[0]`.
fn path_parts(path: &str, start: usize) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let mut at = start;
    for name in path.split('.') {
        let of_item = name.strip_suffix(']').and_then(|name| name.split_once('['));
        match of_item.filter(|(list, item)| !list.is_empty() && item.parse::<usize>().is_ok()) {
            Some((list, item)) => {
                let item_at = at + list.len() + 1;
                parts.push(Part { name: list, span: at..at + list.len() });
                parts.push(Part { name: item, span: item_at..item_at + item.len() });
            }
            None => parts.push(Part { name, span: at..at + name.len() }),
        }
        at += name.len() + 1;
    }
    parts
}

/// A setting under way.
struct Setting<'s> {
    path: &'s str,
    parts: &'s [Part<'s>],
    log: &'s Log,
}

fn bad_path(part: &Part, message: String) -> Problem {
    Problem::new(Kind::BadPath, &part.span, message)
}

fn set_in_table(table: &mut Table, setting: &Setting, depth: usize, node: Node) -> Result<(), Problem> {
    let Setting { path, parts, log } = setting;
    let part = &parts[depth];
    if part.name.is_empty() {
        return Err(
            bad_path(part, format!("`{path}` is not a path")).hint("such as bearing.B.radial_clearance")
        );
    }
    let last = depth + 1 == parts.len();
    if table.get(part.name).is_none() {
        // a misspelt item name must not create a new item
        let item = depth == 1 && !last && COLLECTIONS.contains(&parts[0].name);
        if depth == 0 && !last && COLLECTIONS.contains(&part.name) || item {
            let what = parts[..=depth].iter().map(|p| p.name).collect::<Vec<_>>().join(".");
            let problem = bad_path(part, format!("the model has no `{what}`"));
            return Err(problem.suggest(log, part.name, table.keys()));
        }
        let empty = Node { span: part.span.clone(), value: Value::Table(Table::default()) };
        table.set(Entry {
            key: part.name.into(),
            former_key: None,
            key_span: part.span.clone(),
            node: empty,
        });
    }
    if last {
        let former_key = table.get(part.name).and_then(|entry| entry.former_key.clone());
        table.set(Entry { key: part.name.into(), former_key, key_span: part.span.clone(), node });
        return Ok(());
    }
    let Some(inner) = table.node_mut(part.name) else { return Ok(()) };
    set_in_node(inner, setting, depth + 1, node)
}

fn set_in_node(into: &mut Node, setting: &Setting, depth: usize, node: Node) -> Result<(), Problem> {
    let Setting { path, parts, .. } = setting;
    let part = &parts[depth];
    match &mut into.value {
        Value::Table(table) => set_in_table(table, setting, depth, node),
        // a number selects an item of a list: shaft.section.0.length
        Value::List(items) => {
            let count = items.len();
            let Some(item) = part.name.parse::<usize>().ok().and_then(|i| items.get_mut(i)) else {
                let message =
                    format!("`{}` is not one of the {count} items of `{}`", part.name, parts[depth - 1].name);
                return Err(bad_path(part, message).hint("items are counted from 0"));
            };
            if depth + 1 == parts.len() {
                *item = node;
                return Ok(());
            }
            set_in_node(item, setting, depth + 1, node)
        }
        _ => {
            let owner = &parts[depth - 1];
            Err(bad_path(owner, format!("`{}` is a single value, so `{path}` cannot be set", owner.name)))
        }
    }
}
