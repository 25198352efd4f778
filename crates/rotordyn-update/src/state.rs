//! Correlation of a model with measurements: its modes at the measured points, paired with the measured ones.

use rayon::prelude::*;

use super::pairing::{Candidate, Pairing, pair_modes};
use super::target::{Target, TargetFrfs};
use super::{UpdateFailure, repeated};
use rotordyn_core::analysis::modal::{self, Mode};
use rotordyn_core::analysis::sensitivity::{Linearised, frf_sensitivity};
use rotordyn_core::model::Model;
use rotordyn_linalg::{Complex64, SparseRow};

/// Linearised model with its modes at the sensors, paired with the measured modes.
#[derive(Clone, Debug)]
pub struct ModelState {
    pub linearised: Linearised,
    pub modes: Vec<Mode>,
    /// `shapes[mode][sensor]`.
    pub shapes: Vec<Vec<Complex64>>,
    /// The other mode of a repeated (double) eigenvalue, aligned together with it to the measured shapes.
    pub repeated: Vec<Option<usize>>,
    /// Output matrix: sensors as rows over the free DOFs.
    pub sensor_rows: Vec<SparseRow>,
    pub pairing: Pairing,
}

/// Number of modes computed in addition to twice the measured ones.
const EXTRA_MODES: usize = 8;

impl ModelState {
    /// Linearises the model at the speed of the measurement, computes its modes and pairs them; the
    /// equilibrium iteration starts from `start` or from zero.
    ///
    /// # Errors
    /// No equilibrium, or failure of the eigenvalue computation.
    pub fn new(model: Model, target: &Target, start: Option<&[f64]>) -> Result<Self, UpdateFailure> {
        let linear = Linearised::new(model, target.speed, start)?;
        let count = 2 * target.modes.len() + EXTRA_MODES;
        let mut modes = modal::modes(&linear.assembly, &linear.system, count)?;
        // Modes far above the last measured one cannot be paired.
        let top = target.modes.iter().map(|m| m.frequency_hz).fold(0.0, f64::max);
        modes.retain(|m| m.frequency_hz() < 2.0 * top);
        let rows: Vec<SparseRow> = target.sensors.iter().map(|s| s.row(&linear.assembly)).collect();
        let doubles = modal::double_eigenvalue_partners(&linear.system, &modes);
        repeated::align_repeated_modes(&linear.assembly, &mut modes, &doubles, &rows, &target.modes);
        let shapes: Vec<Vec<Complex64>> =
            modes.iter().map(|m| rows.iter().map(|r| r.dot_complex(&m.shape)).collect()).collect();
        let measured: Vec<Candidate> = target
            .modes
            .iter()
            .map(|m| Candidate { frequency_hz: m.frequency_hz, shape: &m.shape })
            .collect();
        let computed: Vec<Candidate> = modes
            .iter()
            .zip(&shapes)
            .map(|(m, shape)| Candidate { frequency_hz: m.frequency_hz(), shape })
            .collect();
        let pairing = pair_modes(&measured, &computed);
        Ok(Self { linearised: linear, modes, shapes, repeated: doubles, sensor_rows: rows, pairing })
    }

    /// The computed mode paired with a measured mode, and their MAC.
    pub fn paired_mode(&self, measured: usize) -> Option<(&Mode, f64)> {
        let pair = self.pairing.pairs.iter().find(|p| p.measured == measured)?;
        Some((&self.modes[pair.computed], pair.mac))
    }

    /// The model's FRFs at the measured points and frequencies, `[response][reference][line]`.
    ///
    /// # Errors
    /// A singular dynamic stiffness.
    pub fn frfs(&self, measured: &TargetFrfs) -> Result<Vec<Vec<Vec<Complex64>>>, UpdateFailure> {
        const CHUNK: usize = 64;
        let rows = |sensors: &[super::target::Sensor]| -> Vec<SparseRow> {
            sensors.iter().map(|s| s.row(&self.linearised.assembly)).collect()
        };
        let (responses, references) = (rows(&measured.responses), rows(&measured.references));
        let parts: Vec<_> = measured
            .frequencies
            .par_chunks(CHUNK)
            .map(|f| frf_sensitivity(&self.linearised, f, &references, &responses, &measured.quantities, &[]))
            .collect::<Result<_, _>>()?;
        let joined = |r: usize, e: usize| parts.iter().flat_map(|p| p.values[r][e].iter().copied()).collect();
        Ok((0..responses.len()).map(|r| (0..references.len()).map(|e| joined(r, e)).collect()).collect())
    }
}
