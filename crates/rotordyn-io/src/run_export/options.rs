//! What every format needs.

use std::path::Path;

/// Where and how a run is exported.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    pub folder: &'a Path,
    /// Record number in the variable names of a MAT file.
    pub number: u32,
}
