//! The data sets of an HDF5 file as named arrays, with the structures and cells of MATLAB 7.3.
//!
//! Data sets are named by their path, `run.x` for `/run/x`, and attributes as members of their object: `run.x.fs`. The
//! elements of cells and of arrays of structures, to which MATLAB keeps references, are named as in MATLAB: `c{3}`,
//! `runs(2).x`. MATLAB stores the dimensions in reverse order. Format: there is no specification; as MATLAB R2024a writes.

use std::collections::{HashMap, HashSet};

use super::array::{Array, Data};
use crate::budget::{Budget, MAX_DEPTH};
use crate::error::Error;
use crate::hdf5::{Attribute, Link, LinkTarget, Links, ObjectKind, Reader};
use crate::mat::to_row_major;
use rotordyn_signal::Complex;

/// Where MATLAB keeps the contents of cells and of arrays of structures.
const REFERENCED: &str = "/#refs#";

/// Beginnings of the names of attributes by which HDF5, netCDF, PyTables and MATLAB keep house.
const HOUSEKEEPING: [&str; 13] = [
    "CLASS",
    "DIMENSION_",
    "FLAVOR",
    "H5PATH",
    "MATLAB_",
    "NAME",
    "PYTABLES_",
    "REFERENCE_LIST",
    "TITLE",
    "VERSION",
    "_FillValue",
    "_NCProperties",
    "_Netcdf4",
];

/// MATLAB's classes of arrays that are read.
const CLASSES: [&str; 14] = [
    "double", "single", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64", "logical",
    "char", "cell", "struct",
];

/// The arrays of a file, and the names of what is not read, each with the reason.
pub(super) struct Collected<'a> {
    file: &'a dyn Reader,
    budget: &'a Budget,
    pub found: Vec<Array>,
    pub left_out: Vec<String>,
    /// Label of every group, and of every object that a reference led to, by the mark of its place.
    seen: HashMap<String, String>,
    /// Objects to which references lead, by their marks.
    referenced: HashMap<String, Link>,
    /// Marks of empty arrays, which MATLAB stores once.
    empty: HashSet<String>,
}

/// An object of the file: its path in it, and its name as an array.
struct Object<'a> {
    path: &'a str,
    name: &'a str,
    /// Groups, cells and structures around it.
    depth: usize,
}

impl Object<'_> {
    /// Name for messages.
    fn label(&self) -> &str {
        if self.path.starts_with(REFERENCED) { self.name } else { self.path }
    }
}

impl<'a> Collected<'a> {
    /// Every data set of a file.
    ///
    /// # Errors
    /// The contents exceed the budget, or the file cannot be read any more.
    pub fn of_file(file: &'a dyn Reader, budget: &'a Budget) -> Result<Self, Error> {
        let mut all = Self {
            file,
            budget,
            found: Vec::new(),
            left_out: Vec::new(),
            seen: HashMap::new(),
            referenced: HashMap::new(),
            empty: HashSet::new(),
        };
        if file.contains(REFERENCED)? {
            match file.links(REFERENCED) {
                Ok(Links { links, .. }) => {
                    all.count("links", links.len())?;
                    all.referenced = links.into_iter().map(|link| (link.mark.clone(), link)).collect();
                }
                Err(error) => all.leave_out(REFERENCED, error)?,
            }
        }
        all.group(&Object { path: "", name: "", depth: 0 })?;
        all.left_out.iter_mut().for_each(shorten);
        Ok(all)
    }

    /// Every data set below a group.
    fn group(&mut self, group: &Object) -> Result<(), Error> {
        let whole = if group.path.is_empty() { "/" } else { group.path };
        let label = if group.path.is_empty() { "/" } else { group.label() };
        let read = self.file.links(whole).and_then(|links| Ok((links, self.file.attributes(whole)?)));
        let (Links { group: mark, links }, attributes) = match read {
            Ok(found) => found,
            Err(error) => return self.leave_out(label, error),
        };
        self.seen.insert(mark, label.into());
        self.count("links", links.len())?;
        if let Some(reason) = no_structure(&attributes) {
            self.left_out.push(format!("{label} ({reason})"));
            return Ok(());
        }
        self.attributes(group.name, &attributes);
        let is_structure = class(&attributes) == Some("struct");
        for Link { name, target, .. } in links.into_iter().filter(|link| !link.name.starts_with('#')) {
            let path = format!("{}/{name}", group.path);
            let separator = if group.name.is_empty() { "" } else { "." };
            let within = format!("{}{separator}{name}", group.name);
            let object = Object { path: &path, name: &within, depth: group.depth + 1 };
            let structure = is_structure.then_some((group.name, name.as_str()));
            self.object(&object, target, structure, None)?;
        }
        Ok(())
    }

    /// What a link or a reference leads to. `structure`: the structure and the field that it is. `mark`: of a reference.
    fn object(
        &mut self,
        object: &Object,
        target: LinkTarget,
        structure: Option<(&str, &str)>,
        mark: Option<&str>,
    ) -> Result<(), Error> {
        let label = object.label();
        match target {
            LinkTarget::Group(own) => match self.seen.get(&own) {
                Some(same) if mark.is_none() => {
                    self.left_out.push(format!("{label} (the group {same} again)"));
                }
                _ if object.depth > MAX_DEPTH => {
                    self.left_out.push(format!("{label} (more than {MAX_DEPTH} groups deep)"));
                }
                _ => self.group(object)?,
            },
            LinkTarget::DataSet(kind) => {
                let bytes = memory_of(&kind);
                let whole = Budget::of_memory(self.file.memory());
                if let Err(exceeded) = whole.take(|| "it".into(), bytes) {
                    let advice = exceeded.advice();
                    self.left_out.push(format!("{label} ({exceeded}; {advice})"));
                    return Ok(());
                }
                // All data sets together are another matter than one that nobody can read.
                let taken = self.budget.take(|| object.path.into(), bytes);
                taken.map_err(|exceeded| exceeded.of_file(self.file.path()))?;
                if let Err(error) = self.data_set(object, kind, structure, mark) {
                    self.leave_out(label, error)?;
                }
            }
            LinkTarget::Nothing(why) => self.left_out.push(format!("{label} ({why})")),
        }
        Ok(())
    }

    /// Notes an object that cannot be read, unless nothing can be read any more.
    fn leave_out(&mut self, label: &str, error: Error) -> Result<(), Error> {
        self.file.contains("/")?;
        match error {
            Error::Content { problem, advice, .. } => {
                let problem = problem.trim_start_matches(&format!("{label}: "));
                let advice =
                    if advice.contains("--read-limit") { format!("; {advice}") } else { String::new() };
                self.left_out.push(format!("{label} ({problem}{advice})"));
            }
            other => return Err(other),
        }
        Ok(())
    }

    fn count(&self, what: &str, count: usize) -> Result<(), Error> {
        self.budget.objects(what, count).map_err(|exceeded| exceeded.of_file(self.file.path()))
    }

    /// Attributes as members of their object; lists of numbers are no channels.
    fn attributes(&mut self, name: &str, attributes: &[(String, Attribute)]) {
        let own =
            attributes.iter().filter(|(key, _)| !HOUSEKEEPING.iter().any(|known| key.starts_with(known)));
        for (key, value) in own {
            let name = if name.is_empty() { key.clone() } else { format!("{name}.{key}") };
            match value {
                Attribute::Number(value) => self.found.push(Array::scalar(&name, *value)),
                Attribute::Integer(value) => self.found.push(Array::scalar(&name, *value as f64)),
                Attribute::Numbers(values) if values.len() == 1 => {
                    self.found.push(Array::scalar(&name, values[0]));
                }
                Attribute::Numbers(values) => {
                    self.left_out.push(format!("{name} (an attribute of {} numbers)", values.len()));
                }
                Attribute::Unread(why) => self.left_out.push(format!("{name} (an attribute: {why})")),
                Attribute::Text(text) => self.found.push(Array::text(&name, text)),
                Attribute::Texts(texts) => {
                    let (shape, data) = (vec![texts.len()], Data::Text(texts.clone()));
                    self.found.push(Array { name, shape, data });
                }
            }
        }
    }

    fn data_set(
        &mut self,
        object: &Object,
        kind: ObjectKind,
        structure: Option<(&str, &str)>,
        mark: Option<&str>,
    ) -> Result<(), Error> {
        let (path, label) = (object.path, object.label());
        let attributes = self.file.attributes(path)?;
        let class = class(&attributes);
        if class.is_some() && number(&attributes, "MATLAB_empty").is_some_and(|empty| empty != 0.0) {
            self.left_out.push(format!("{label} (empty)"));
            self.empty.extend(mark.map(str::to_owned));
            return Ok(());
        }
        if let Some(reason) = no_structure(&attributes) {
            self.left_out.push(format!("{label} ({reason})"));
            return Ok(());
        }
        if let ObjectKind::References(_) = kind {
            return self.elements(object, structure.filter(|_| class.is_none()));
        }
        let (shape, data) = match kind {
            ObjectKind::Complex(_) => {
                let array = self.file.read_complex(path)?;
                match class {
                    Some(_) => in_rows(&array.shape, &array.data, Data::Complex),
                    None => (array.shape, Data::Complex(array.data)),
                }
            }
            ObjectKind::Text(shape) => (shape, Data::Text(self.file.read_texts(path)?)),
            _ => {
                let array = self.file.read(path)?;
                match class {
                    Some("char") => {
                        let texts = matlab_texts(&array.shape, &array.data);
                        (vec![texts.len()], Data::Text(texts))
                    }
                    Some(_) => in_rows(&array.shape, &array.data, Data::Real),
                    None => (array.shape, Data::Real(unpacked(array.data, &attributes))),
                }
            }
        };
        let is_packing = |(key, _): &(String, Attribute)| PACKING.contains(&key.as_str()) && class.is_none();
        let others: Vec<(String, Attribute)> =
            attributes.iter().filter(|attribute| !is_packing(attribute)).cloned().collect();
        self.attributes(object.name, &others);
        self.found.push(Array { name: object.name.into(), shape, data });
        Ok(())
    }

    /// What a data set of references leads to: the elements of a cell, or a field of an array of structures.
    fn elements(&mut self, object: &Object, field: Option<(&str, &str)>) -> Result<(), Error> {
        if self.referenced.is_empty() {
            self.left_out.push(format!("{} (references to other objects)", object.label()));
            return Ok(());
        }
        let marks = self.file.references(object.path)?;
        let lone = marks.len() == 1;
        self.count("references", marks.len())?;
        // The names of elements may be longer than what they name: each has 20 digits and marks at most, and is kept twice.
        let names = (2 * marks.len() as u64).saturating_mul(object.name.len() as u64 + 20);
        let taken = self.budget.take(|| "the names of its elements".into(), names);
        taken.map_err(|exceeded| exceeded.of_file(self.file.path()))?;
        for (k, mark) in marks.iter().enumerate() {
            let name = match field {
                Some(_) if lone => object.name.to_owned(),
                Some((structure, field)) => format!("{structure}({}).{field}", k + 1),
                None => format!("{}{{{}}}", object.name, k + 1),
            };
            let Some(link) = self.referenced.get(mark) else {
                self.left_out.push(format!("{name} (a reference to nothing in #refs#)"));
                continue;
            };
            if self.empty.contains(mark) {
                self.left_out.push(format!("{name} (empty)"));
                continue;
            }
            if let Some(same) = self.seen.get(mark) {
                self.left_out.push(format!("{name} ({same} again)"));
                continue;
            }
            if object.depth >= MAX_DEPTH {
                self.left_out.push(format!("{name} (more than {MAX_DEPTH} structures or cells deep)"));
                continue;
            }
            let (path, target) = (format!("{REFERENCED}/{}", link.name), link.target.clone());
            self.seen.insert(mark.clone(), name.clone());
            let element = Object { path: &path, name: &name, depth: object.depth + 1 };
            self.object(&element, target, None, Some(mark))?;
        }
        Ok(())
    }
}

/// Longest entry of what is left out, and what is kept of a longer one \[characters\].
const MAX_ENTRY: usize = 400;

/// Takes the middle out of an entry whose names are too long for a message.
fn shorten(entry: &mut String) {
    let count = if entry.len() > MAX_ENTRY { entry.chars().count() } else { 0 };
    if count > MAX_ENTRY {
        let begin: String = entry.chars().take(MAX_ENTRY / 4).collect();
        let end: String = entry.chars().skip(count - MAX_ENTRY / 2).collect();
        *entry = format!("{begin} ... {end}");
    }
}

fn class(attributes: &[(String, Attribute)]) -> Option<&str> {
    attributes.iter().find_map(|(name, value)| match value {
        Attribute::Text(text) if name == "MATLAB_class" => Some(text.as_str()),
        _ => None,
    })
}

fn number(attributes: &[(String, Attribute)], name: &str) -> Option<f64> {
    attributes.iter().find(|(key, _)| key == name).and_then(|(_, value)| match value {
        Attribute::Number(value) => Some(*value),
        Attribute::Integer(value) => Some(*value as f64),
        Attribute::Numbers(values) => values.first().copied(),
        _ => None,
    })
}

/// Attributes of netCDF by which integers stand for other values: stored times factor plus offset.
const PACKING: [&str; 2] = ["scale_factor", "add_offset"];

/// The values for which stored ones stand.
fn unpacked(mut stored: Vec<f64>, attributes: &[(String, Attribute)]) -> Vec<f64> {
    let [factor, offset] = PACKING.map(|name| number(attributes, name));
    if factor.is_some() || offset.is_some() {
        let (factor, offset) = (factor.unwrap_or(1.0), offset.unwrap_or(0.0));
        stored.iter_mut().for_each(|value| *value = *value * factor + offset);
    }
    stored
}

/// Why something that MATLAB wrote is no array, structure or cell; `None` if it is one, or not of MATLAB.
fn no_structure(attributes: &[(String, Attribute)]) -> Option<String> {
    let class = class(attributes)?;
    if attributes.iter().any(|(name, _)| name == "MATLAB_sparse") {
        return Some("a sparse matrix".into());
    }
    match class {
        "function_handle" => Some("a function handle".into()),
        _ if !CLASSES.contains(&class) => {
            Some(format!("a MATLAB object of class {}", crate::error::snippet(class)))
        }
        _ => None,
    }
}

/// An array whose dimensions are stored in reverse order.
fn in_rows<T: Copy>(stored: &[usize], values: &[T], data: fn(Vec<T>) -> Data) -> (Vec<usize>, Data) {
    let shape: Vec<usize> = stored.iter().rev().copied().collect();
    let values = to_row_major(values, &shape);
    (shape, data(values))
}

/// Memory of the values of a data set \[bytes\].
fn memory_of(kind: &ObjectKind) -> u64 {
    let (shape, value) = match kind {
        ObjectKind::Real(shape) => (shape, size_of::<f64>()),
        ObjectKind::Complex(shape) => (shape, size_of::<Complex<f64>>()),
        ObjectKind::Text(shape) | ObjectKind::References(shape) => (shape, size_of::<String>()),
        ObjectKind::Group | ObjectKind::Other => return 0,
    };
    shape.iter().fold(value as u64, |product, n| product.saturating_mul(*n as u64))
}

/// Rows of a text of MATLAB 7.3: codes over column and row.
fn matlab_texts(shape: &[usize], codes: &[f64]) -> Vec<String> {
    let [_, rows] = *shape else { return Vec::new() };
    let row = |k: usize| {
        let units = codes.iter().skip(k).step_by(rows).map(|&code| code as u16);
        let text: String =
            char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        text.trim_matches(|c: char| c == '\0' || c.is_whitespace()).to_owned()
    };
    // Empty ones state their size as numbers.
    if codes.len() < rows { Vec::new() } else { (0..rows).map(row).collect() }
}
