//! Rows of weighted residuals and their derivatives.

/// Residual rows and their derivatives by every parameter, under construction.
pub(super) struct ResidualRows {
    pub(super) residual: Vec<f64>,
    pub(super) slopes: Vec<Vec<f64>>,
    /// Effective number of data.
    pub data: f64,
}

impl ResidualRows {
    pub fn push(&mut self, residual: f64, slopes: impl Iterator<Item = f64>) {
        self.residual.push(residual);
        self.slopes.push(slopes.collect());
    }
}
