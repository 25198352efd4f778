//! External data files that a model file refers to, such as a tacho record; read by the caller of the loader.

use serde::{Deserialize, Serialize};

/// External data file of a model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExternalFile {
    /// Path as written in the model file.
    pub path: String,
    /// Columns, or the reason why it could not be read.
    pub content: Result<Vec<ExternalColumn>, String>,
}

/// A column of numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExternalColumn {
    pub name: String,
    /// Unit of the values: SI, or rpm for speeds; empty if the file does not give one.
    pub unit: String,
    pub values: Vec<f64>,
}
