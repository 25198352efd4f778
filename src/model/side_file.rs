//! Numbers that a model file takes from other files; whoever loads a model reads them.

/// A file that a model file names, as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct SideFile {
    /// Its path as the model file writes it.
    pub path: String,
    /// Its columns, or why it could not be read.
    pub content: Result<Vec<SideColumn>, String>,
}

/// A column of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct SideColumn {
    pub name: String,
    /// Unit of the values: SI, or rpm for speeds; empty when the file does not tell.
    pub unit: String,
    pub values: Vec<f64>,
}
