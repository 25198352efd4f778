//! A check of tables.

use crate::file::diagnostic::Kind;
use crate::file::key::Declared;
use crate::file::reader::Reader;

pub(super) fn check_increasing(r: &Reader, key: &dyn Declared, values: &[f64]) {
    if values.windows(2).any(|w| w[1] <= w[0]) {
        r.error(Kind::OutOfRange, key, format!("{} must increase from value to value", r.name(key)));
    }
}
