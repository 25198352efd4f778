//! Order lines of a Campbell diagram.

/// A line of constant order with its usual name ("1x", "BPFO").
#[derive(Clone, Debug, PartialEq)]
pub struct OrderLine {
    pub label: String,
    pub order: f64,
    /// Whether it is a bearing's characteristic order rather than a shaft order.
    pub bearing: bool,
}
