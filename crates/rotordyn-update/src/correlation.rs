//! Correlation of a model with a measurement: pairs of modes, MAC and FRAC.

use super::UpdateFailure;
use super::frf::is_coupled;
use super::frf_levels::FrfLevels;
use super::frf_scale::{FrfScale, common_scale};
use super::state::ModelState;
use super::target::{Sensor, Target, TargetFrfs, TargetMode};
use rotordyn_core::analysis::modal::Mode;
use rotordyn_core::document::{Array, Document, Rows, TO_RPM, Value, in_hdf5, in_json, named};
use rotordyn_identify::mac::frac;
use rotordyn_identify::whirl::whirl;
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::Dof;

/// A measurement beside the modes of a model and its FRFs at the measured points.
pub struct Correlation<'a> {
    pub target: &'a Target,
    pub state: &'a ModelState,
    /// `[response][reference][line]`, if FRFs are measured.
    pub frfs: Option<Vec<Vec<Vec<Complex64>>>>,
}

/// Frequency response assurance criterion `[response][reference]`; NaN where one of the two FRFs is zero, the computed one to
/// round-off.
pub fn frac_of_frfs(measured: &TargetFrfs, computed: &[Vec<Vec<Complex64>>]) -> Vec<Vec<f64>> {
    let value = |r: usize, e: usize| match measured.is_nonzero(r, e) && is_coupled(computed, r, e) {
        true => frac(&measured.values[r][e], &computed[r][e]),
        false => f64::NAN,
    };
    let references = 0..measured.references.len();
    (0..measured.responses.len()).map(|r| references.clone().map(|e| value(r, e)).collect()).collect()
}

impl<'a> Correlation<'a> {
    /// Computes the FRFs at the measured points.
    ///
    /// # Errors
    /// A singular dynamic stiffness.
    pub fn new(target: &'a Target, state: &'a ModelState) -> Result<Self, UpdateFailure> {
        let frfs = target.frfs.as_ref().map(|measured| state.frfs(measured)).transpose()?;
        Ok(Self { target, state, frfs })
    }

    /// Measured FRFs with the computed ones, `[response][reference][line]`.
    pub fn measured_and_computed(&self) -> Option<(&'a TargetFrfs, &[Vec<Vec<Complex64>>])> {
        self.target.frfs.as_ref().zip(self.frfs.as_deref())
    }

    /// [`frac_of_frfs`] of the measured FRFs.
    pub fn frac(&self) -> Option<Vec<Vec<f64>>> {
        let (measured, computed) = self.measured_and_computed()?;
        Some(frac_of_frfs(measured, computed))
    }

    /// Level of the computed FRFs over the measured ones \[dB\], median over the lines, `[response][reference]`; NaN for FRFs of
    /// which one is zero.
    pub fn frf_level_db(&self) -> Option<Vec<Vec<f64>>> {
        let levels = self.frf_levels()?.log_ratios();
        let decibel =
            |row: Vec<f64>| row.into_iter().map(|log| 20.0 * log * std::f64::consts::LOG10_E).collect();
        Some(levels.into_iter().map(decibel).collect())
    }

    /// A factor or power of ω common to all FRFs, and faults of single channels in words.
    pub fn frf_faults(&self) -> (Option<FrfScale>, Vec<String>) {
        let (Some(levels), Some((measured, computed))) = (self.frf_levels(), self.measured_and_computed())
        else {
            return (None, Vec::new());
        };
        let scale = common_scale(measured, computed, [0.0, f64::INFINITY]);
        if scale.is_some_and(|scale| scale.power != 0) {
            return (scale, Vec::new());
        }
        let model = &self.state.linearised.model;
        let names = |of: &[Sensor]| of.iter().map(|s| s.name(model)).collect::<Vec<_>>();
        let (responses, references) = (names(&measured.responses), names(&measured.references));
        let faults = levels.faults(scale.map_or(1.0, |scale| scale.ratio.recip()));
        (scale, faults.iter().map(|fault| fault.text(&responses, &references)).collect())
    }

    fn frf_levels(&self) -> Option<FrfLevels<'_>> {
        let (measured, computed) = self.measured_and_computed()?;
        Some(FrfLevels::new(&measured.values, computed))
    }

    /// Whether the measured shapes whirl, two modes of them against each other, while the model's do not: a rotating shaft
    /// compared at standstill.
    ///
    /// Modes closer than 0.5 % to another are left out: of equal frequencies any combination is a mode.
    pub fn whirls_at_standstill(&self) -> bool {
        if self.target.speed != 0.0 {
            return false;
        }
        let modes = &self.target.modes;
        let dofs: Vec<Dof> = self.target.sensors.iter().map(|s| s.dof).collect();
        let apart = |k: &usize| {
            let own = modes[*k].frequency_hz;
            modes.iter().enumerate().all(|(j, m)| j == *k || (m.frequency_hz / own).ln().abs() > DISTINCT)
        };
        let of_measured: Vec<f64> =
            (0..modes.len()).filter(apart).filter_map(|k| whirl(&dofs, &modes[k].shape)).collect();
        let computed = |k: usize| {
            let pair = self.state.pairing.pairs.iter().find(|p| p.measured == k)?;
            whirl(&dofs, &self.state.shapes[pair.computed])
        };
        let stands = (0..modes.len()).filter_map(computed).all(|w| w.abs() < 0.5 * WHIRLS);
        let turns = |sign: f64| of_measured.iter().any(|w| sign * w > WHIRLS);
        stands && turns(1.0) && turns(-1.0)
    }

    /// What is written to files.
    pub fn document(&self) -> Document<'a> {
        let (target, state) = (self.target, self.state);
        let sensors = target.sensors.iter().map(|s| s.name(&state.linearised.model));
        let pairs: Vec<Pair> =
            target.modes.iter().enumerate().map(|(k, mode)| (mode, state.paired_mode(k))).collect();
        let unpaired: Vec<&Mode> = state.pairing.unpaired_computed.iter().map(|&k| &state.modes[k]).collect();
        let unpaired =
            Rows::of(unpaired).text("label", |m| &m.label).number("computed_hz", "Hz", |m| m.frequency_hz());
        let mac = &state.pairing.mac;
        Document::new()
            // Factors as in the earlier files: the last digit of the two can differ.
            .number(in_json("rpm"), "rpm", target.speed * 30.0 / std::f64::consts::PI)
            .number(in_hdf5("rpm"), "rpm", target.speed * TO_RPM)
            .texts(in_hdf5("sensors"), sensors)
            .table(in_json("modes"), pair_rows(&pairs))
            .table(in_json("unpaired_computed"), unpaired)
            .group(in_hdf5("measured"), measured_modes(target, state))
            .group(in_hdf5("computed"), computed_modes(target, state))
            .array("mac", Array::real(&[mac.len(), state.modes.len()], "1", mac.concat()))
            .and(self.frf_document())
    }

    fn frf_document(&self) -> Document<'a> {
        let (Some((measured, computed)), Some(frac)) = (self.measured_and_computed(), self.frac()) else {
            return Document::new().with(in_json("frac"), Value::Missing);
        };
        let model = &self.state.linearised.model;
        let shape = [measured.responses.len(), measured.references.len(), measured.frequencies.len()];
        let frfs = |values: &[Vec<Vec<Complex64>>]| {
            let flat: Vec<Complex64> = values.iter().flatten().flatten().copied().collect();
            Array::complex(&shape, "as measured, SI", flat).over(2, "frequency")
        };
        let group = Document::new()
            .numbers("frequency", "Hz", &measured.frequencies)
            .array("measured", frfs(&measured.values))
            .array("computed", frfs(computed))
            .texts("responses", measured.responses.iter().map(|s| s.name(model)))
            .texts("references", measured.references.iter().map(|s| s.name(model)));
        let levels = self.frf_level_db().unwrap_or_default().concat();
        Document::new()
            .group(in_hdf5("frf"), group)
            .array(named("frac", "frf/frac"), Array::real(&shape[..2], "1", frac.concat()))
            .array(named("frf_level_db", "frf/level_db"), Array::real(&shape[..2], "dB", levels))
    }
}

/// Relative distance of frequencies from which modes are distinct.
const DISTINCT: f64 = 0.005;
/// Share of a circular motion from which a shape whirls.
const WHIRLS: f64 = 0.5;

/// A measured mode, and the computed one paired with it with their MAC.
type Pair<'a> = (&'a TargetMode, Option<(&'a Mode, f64)>);

fn pair_rows<'a, 'r>(pairs: &'r [Pair<'r>]) -> Rows<'a, 'r, Pair<'r>> {
    Rows::of(pairs)
        .number("measured_hz", "Hz", |(m, _)| m.frequency_hz)
        .optional("measured_zeta", "1", |(m, _)| m.damping_ratio)
        .number("measured_hz_error", "Hz", |(m, _)| m.frequency_error)
        .number("measured_zeta_error", "1", |(m, _)| m.damping_error)
        .optional("computed_hz", "Hz", |(_, pair)| pair.map(|(mode, _)| mode.frequency_hz()))
        .optional("computed_zeta", "1", |(_, pair)| pair.map(|(mode, _)| mode.zeta()))
        .optional("error", "1", |(m, pair)| pair.map(|(mode, _)| mode.frequency_hz() / m.frequency_hz - 1.0))
        .optional("mac", "1", |(_, pair)| pair.map(|(_, mac)| mac))
        .optional_text("label", |(_, pair)| pair.map(|(mode, _)| &mode.label))
        .number("measured_shape_error", "1", |(m, _)| m.shape_error)
        .text("quality_warnings", |(m, _)| m.quality_text())
}

fn measured_modes<'a>(target: &'a Target, state: &ModelState) -> Document<'a> {
    let modes = &target.modes;
    let shapes: Vec<Complex64> = modes.iter().flat_map(|m| m.shape.iter().copied()).collect();
    let partner =
        |k| state.pairing.pairs.iter().find(|p| p.measured == k).map_or(-1.0, |p| p.computed as f64);
    let column = |of: &dyn Fn(usize) -> f64| (0..modes.len()).map(of).collect::<Vec<f64>>();
    Document::new()
        .numbers("frequency", "Hz", column(&|k| modes[k].frequency_hz))
        .numbers("frequency_error", "Hz", column(&|k| modes[k].frequency_error))
        .numbers("zeta", "1", column(&|k| modes[k].damping_ratio.unwrap_or(f64::NAN)))
        .numbers("zeta_error", "1", column(&|k| modes[k].damping_error))
        .numbers("shape_error", "1", column(&|k| modes[k].shape_error))
        .texts("quality_warnings", modes.iter().map(TargetMode::quality_text))
        .array("shapes", Array::complex(&[modes.len(), target.sensors.len()], "1", shapes))
        // Index of the computed mode, -1 without one.
        .numbers("paired_mode", "1", column(&partner))
}

fn computed_modes<'a>(target: &Target, state: &'a ModelState) -> Document<'a> {
    let modes = &state.modes;
    let shape = [modes.len(), target.sensors.len()];
    Document::new()
        .numbers("frequency", "Hz", modes.iter().map(Mode::frequency_hz).collect::<Vec<_>>())
        .numbers("zeta", "1", modes.iter().map(Mode::zeta).collect::<Vec<_>>())
        .array("shapes", Array::complex(&shape, "m/sqrt(kg) m", state.shapes.concat()))
        .texts("label", modes.iter().map(|m| &m.label))
}
