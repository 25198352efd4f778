//! Writes the datasets of one group.

use super::super::hdf5::{Attribute, Store};
use crate::error::Error;

/// Writer of one group.
pub(super) struct GroupWriter<'a> {
    pub(super) store: &'a Store,
    pub(super) group: String,
}

impl<'a> GroupWriter<'a> {
    /// The group, recreated without its previous members.
    pub(super) fn new(store: &'a Store, group: &str) -> Result<Self, Error> {
        store.remove(group)?;
        store.create_group(group)?;
        Ok(Self { store, group: group.into() })
    }

    pub(super) fn subgroup(&self, name: &str) -> Result<Self, Error> {
        Self::new(self.store, &self.path(name))
    }

    pub(super) fn path(&self, name: &str) -> String {
        format!("{}/{name}", self.group)
    }

    pub(super) fn set_attribute(&self, name: &str, value: impl Into<Attribute>) -> Result<(), Error> {
        self.store.set_attribute(&self.group, name, value)
    }

    pub(super) fn write_array(
        &self,
        name: &str,
        shape: &[usize],
        data: &[f64],
        unit: &str,
    ) -> Result<(), Error> {
        self.store.write(&self.path(name), shape, data, &[("unit", unit.into())])
    }

    pub(super) fn write_texts<T: AsRef<str>>(
        &self,
        name: &str,
        shape: &[usize],
        texts: &[T],
    ) -> Result<(), Error> {
        self.store.write_text_array(&self.path(name), shape, texts, &[])
    }
}
