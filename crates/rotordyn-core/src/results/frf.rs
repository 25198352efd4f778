//! Frequency response functions.

use super::UndampedPeak;
use super::response_grid::requested_mask;
use crate::analysis::frf::Frf;
use crate::document::{Array, Document, Rows, TO_RPM, in_hdf5, in_json, named};
use crate::model::Quantity;
use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};

/// FRFs with the names of excitations and responses.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FrfResult {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub excitations: Vec<String>,
    pub responses: Vec<String>,
    /// Unit of every response per excitation, `units[response][excitation]`, such as "(m/s^2)/N".
    pub units: Vec<Vec<String>>,
    /// At the requested frequencies and those added around the natural frequencies.
    pub frf: Frf,
    /// Index of every requested frequency.
    pub requested: Vec<usize>,
    /// Undamped modes, at which the FRFs are infinite, by frequency \[Hz\].
    pub undamped: Vec<UndampedPeak>,
    /// The least damped of the modes up to the highest frequency, and of the lowest twelve; `None` if they are not known, as
    /// in results of earlier versions.
    #[serde(default)]
    pub least_damped: Option<LeastDampedMode>,
}

/// The mode with the smallest damping ratio.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LeastDampedMode {
    pub label: String,
    /// ζ.
    pub damping_ratio: f64,
}

impl FrfResult {
    /// Receptance, mobility or accelerance.
    pub fn name(&self) -> &'static str {
        match self.frf.quantity {
            Quantity::Displacement => "receptance",
            Quantity::Velocity => "mobility",
            Quantity::Acceleration => "accelerance",
        }
    }
}

impl FrfResult {
    /// The FRFs at the requested frequencies only, for formats and programs that need equal spacing.
    pub fn at_requested(&self) -> Self {
        let pick = |h: &Vec<Complex64>| self.requested.iter().map(|&k| h[k]).collect();
        let values = self.frf.values.iter().map(|row| row.iter().map(pick).collect()).collect();
        let frequencies: Vec<f64> = self.requested.iter().map(|&k| self.frf.frequencies[k]).collect();
        let requested = (0..frequencies.len()).collect();
        Self { frf: Frf { frequencies, values, quantity: self.frf.quantity }, requested, ..self.clone() }
    }

    /// Whether the FRF is non-zero at any frequency; uncoupled responses have no curve and no peak.
    pub fn is_coupled(&self, response: usize, excitation: usize) -> bool {
        self.frf.values[response][excitation].iter().any(|h| h.norm_sqr() > 0.0)
    }
}

impl FrfResult {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let frequencies = &self.frf.frequencies;
        let (excitations, responses, count) = (&self.excitations, &self.responses, frequencies.len());
        let values: Vec<Complex64> = self.frf.values.iter().flatten().flatten().copied().collect();
        let pairs: Vec<(usize, usize)> =
            (0..excitations.len()).flat_map(|e| (0..responses.len()).map(move |r| (e, r))).collect();
        let functions = Rows::of(&pairs)
            .text("excitation", |(e, _)| &excitations[*e])
            .text("response", |(_, r)| &responses[*r])
            .text("unit", |(e, r)| &self.units[*r][*e])
            .complex_numbers("", "", &[count], |(e, r)| &self.frf.values[*r][*e])
            .cells_over(0, "frequency");
        let shape = [responses.len(), excitations.len(), count];
        Document::new()
            .number(named("speed_rpm", "rpm"), "rpm", self.speed * TO_RPM)
            .text("quantity", self.name())
            .numbers(named("frequency_hz", "frequency"), "Hz", frequencies)
            .array(in_json("requested"), Array::indices(&self.requested))
            .array(in_hdf5("requested"), requested_mask(&self.requested, count).over(0, "frequency"))
            .table(in_json("undamped"), UndampedPeak::columns(&self.undamped, "frequency_hz", 1.0))
            .table(in_json("functions"), functions)
            .array(in_hdf5("response"), Array::complex(&shape, "in units", values).over(2, "frequency"))
            .array(in_hdf5("units"), Array::texts(&shape[..2], self.units.iter().flatten()))
            .texts(in_hdf5("responses"), responses)
            .texts(in_hdf5("excitations"), excitations)
    }
}
