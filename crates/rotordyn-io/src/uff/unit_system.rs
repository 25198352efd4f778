//! Unit system of a universal file (dataset 164), and the problem of a block.

/// Error in a file, with a hint how to correct it.
#[derive(Debug)]
pub(super) struct ParseError {
    /// Line, from 1.
    pub(super) line: usize,
    pub(super) problem: String,
    pub(super) advice: String,
}

/// Unit factors of set 164: a value in the file's units divided by them is in SI.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnitSystem {
    pub(super) length: f64,
    pub(super) force: f64,
}

pub(super) const SI: UnitSystem = UnitSystem { length: 1.0, force: 1.0 };
