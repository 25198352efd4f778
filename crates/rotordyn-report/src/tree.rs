//! A document as the tree that the page's scripts read: the same as of a results file.

use super::arrays::Arrays;
use super::stored::{attribute_value, extend};
use rotordyn_core::document::Document;
use rotordyn_io::error::Error;
use rotordyn_io::hdf5::Attribute;
use rotordyn_io::results_file::{Sink, write_document};
use rotordyn_linalg::Complex64;
use serde_json::{Map, Value, json};
use std::cell::RefCell;

/// The tree of a document, its numbers in the packed arrays.
pub(crate) fn of_document(document: &Document, arrays: &mut Arrays) -> Result<Value, Error> {
    let tree = Tree { root: RefCell::new(group()), arrays: RefCell::new(arrays) };
    write_document(&tree, "", document)?;
    Ok(tree.root.into_inner())
}

struct Tree<'a> {
    root: RefCell<Value>,
    arrays: RefCell<&'a mut Arrays>,
}

fn group() -> Value {
    json!({ "attributes": {}, "groups": {}, "sets": {} })
}

impl Tree<'_> {
    /// Changes the group of a path, which is made if it does not exist.
    fn at(&self, path: &str, change: impl FnOnce(&mut Map<String, Value>)) {
        let mut root = self.root.borrow_mut();
        let mut here = &mut *root;
        for name in path.split('/').filter(|name| !name.is_empty()) {
            let groups = &mut here["groups"];
            if groups[name].is_null() {
                groups[name] = group();
            }
            here = &mut groups[name];
        }
        if let Some(members) = here.as_object_mut() {
            change(members);
        }
    }

    fn set(&self, path: &str, set: Value) {
        let (group, name) = path.rsplit_once('/').unwrap_or(("", path));
        self.at(group, |members| members["sets"][name] = set);
    }
}

impl Sink for Tree<'_> {
    fn group(&self, path: &str) -> Result<(), Error> {
        self.at(path, |_| ());
        Ok(())
    }

    fn attribute(&self, group: &str, name: &str, value: Attribute) -> Result<(), Error> {
        self.at(group, |members| members["attributes"][name] = attribute_value(value));
        Ok(())
    }

    fn numbers(&self, path: &str, shape: &[usize], values: &[f64], unit: &str) -> Result<(), Error> {
        let mut set = json!({ "shape": shape, "unit": unit });
        extend(&mut set, self.arrays.borrow_mut().add(values));
        self.set(path, set);
        Ok(())
    }

    fn complex(&self, path: &str, shape: &[usize], values: &[Complex64], unit: &str) -> Result<(), Error> {
        let parts: Vec<f64> = values.iter().flat_map(|z| [z.re, z.im]).collect();
        let mut set = json!({ "shape": shape, "unit": unit, "complex": true });
        extend(&mut set, self.arrays.borrow_mut().add(&parts));
        self.set(path, set);
        Ok(())
    }

    fn texts(&self, path: &str, shape: &[usize], texts: &[&str]) -> Result<(), Error> {
        self.set(path, json!({ "shape": shape, "unit": "", "values": texts }));
        Ok(())
    }

    fn axis(&self, _: &str, _: usize, _: &str, _: &str) -> Result<(), Error> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_document_has_its_places_in_the_tree() {
        let document = Document::new()
            .number("speed", "rad/s", 10.0)
            .group("part", Document::new().numbers("x", "m", vec![1.0, 2.0]).texts("name", ["a", "b"]));
        let mut arrays = Arrays::default();
        let tree = of_document(&document, &mut arrays).unwrap();
        assert_eq!(tree["attributes"]["speed"], 10.0);
        let part = &tree["groups"]["part"]["sets"];
        assert_eq!((&part["x"]["count"], &part["x"]["unit"]), (&json!(2), &json!("m")));
        assert_eq!(part["name"]["values"], json!(["a", "b"]));
    }
}
