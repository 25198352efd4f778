//! The results file as a tree: groups with their attributes and data sets, numbers in the packed arrays.

use super::arrays::Arrays;
use rotordyn_io::error::Error;
use rotordyn_io::hdf5::{Attribute, LinkTarget, ObjectKind, Reader};
use serde_json::{Map, Value, json};

/// Groups that the page shows in another form.
const SHOWN_OTHERWISE: [&str; 3] = ["/channels", "/time", "/motion"];
/// Most values of a data set in the page; larger maps are reduced, others are left out and named.
const MOST_VALUES: usize = 1 << 21;
/// Most values of all data sets.
const MOST_VALUES_IN_ALL: usize = 6 << 20;

/// The tree of a results file, and the paths of data sets that are left out for their size.
pub(crate) struct Tree {
    pub root: Value,
    pub left_out: Vec<String>,
}

/// Reads the tree of a results file.
pub(crate) fn read(reader: &dyn Reader, arrays: &mut Arrays) -> Result<Tree, Error> {
    let mut walk = Walk { reader, arrays, left: MOST_VALUES_IN_ALL, left_out: Vec::new() };
    let root = walk.group("")?;
    Ok(Tree { root, left_out: walk.left_out })
}

struct Walk<'a> {
    reader: &'a dyn Reader,
    arrays: &'a mut Arrays,
    left: usize,
    left_out: Vec<String>,
}

impl Walk<'_> {
    fn group(&mut self, path: &str) -> Result<Value, Error> {
        let at = if path.is_empty() { "/" } else { path };
        let attributes = self.reader.attributes(at)?.into_iter();
        let attributes: Map<String, Value> = attributes
            .filter(|(name, _)| !(path == "/meta" && ["model", "files"].contains(&name.as_str())))
            .map(|(name, value)| (name, attribute_value(value)))
            .collect();
        let (mut groups, mut sets) = (Map::new(), Map::new());
        for link in self.reader.links(at)?.links {
            let inner = format!("{path}/{}", link.name);
            match link.target {
                LinkTarget::Group(_) if !SHOWN_OTHERWISE.contains(&inner.as_str()) => {
                    groups.insert(link.name, self.group(&inner)?);
                }
                LinkTarget::DataSet(kind) => {
                    if let Some(set) = self.data_set(&inner, &kind)? {
                        sets.insert(link.name, set);
                    }
                }
                LinkTarget::Group(_) | LinkTarget::Nothing(_) => {}
            }
        }
        Ok(json!({ "attributes": attributes, "groups": groups, "sets": sets }))
    }

    fn data_set(&mut self, path: &str, kind: &ObjectKind) -> Result<Option<Value>, Error> {
        let (ObjectKind::Real(shape) | ObjectKind::Complex(shape) | ObjectKind::Text(shape)) = kind else {
            return Ok(None);
        };
        let values = shape.iter().product::<usize>();
        if values > MOST_VALUES || values > self.left {
            self.left_out.push(path.into());
            return Ok(None);
        }
        self.left -= values;
        let unit = match self.reader.attribute(path, "unit")? {
            Some(Attribute::Text(unit)) => unit,
            _ => String::new(),
        };
        let mut set = json!({ "shape": shape, "unit": unit });
        match kind {
            ObjectKind::Text(_) => set["values"] = json!(self.reader.read_texts(path)?),
            ObjectKind::Complex(_) => {
                let read = self.reader.read_complex(path)?;
                let parts: Vec<f64> = read.data.iter().flat_map(|z| [z.re, z.im]).collect();
                extend(&mut set, self.arrays.add(&parts));
                set["complex"] = json!(true);
            }
            _ => extend(&mut set, self.arrays.add(&self.reader.read(path)?.data)),
        }
        Ok(Some(set))
    }
}

/// The members of an object added to another.
pub(crate) fn extend(set: &mut Value, place: Value) {
    if let (Value::Object(set), Value::Object(place)) = (set, place) {
        set.extend(place);
    }
}

pub(crate) fn attribute_value(value: Attribute) -> Value {
    match value {
        Attribute::Text(text) => json!(text),
        Attribute::Unread(why) => json!(format!("not read: {why}")),
        // JSON has no infinite numbers and no NaN.
        Attribute::Number(x) if x.is_finite() => json!(x),
        Attribute::Number(x) => json!(x.to_string()),
        Attribute::Integer(n) => json!(n),
        Attribute::Texts(texts) => json!(texts.join(", ")),
        Attribute::Numbers(numbers) => {
            json!(numbers.iter().map(|x| x.to_string()).collect::<Vec<_>>().join(", "))
        }
    }
}
