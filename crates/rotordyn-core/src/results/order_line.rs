//! Order lines of a Campbell diagram.

use serde::{Deserialize, Serialize};

/// A line of constant order with its usual name ("1x", "BPFO").
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderLine {
    pub label: String,
    pub order: f64,
    /// Whether it is a bearing's characteristic order rather than a shaft order.
    pub bearing: bool,
}
