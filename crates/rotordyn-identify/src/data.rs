//! FRF preparation for identification: one band, one quantity, a common scale.

use std::f64::consts::TAU;

use super::frf_power::{noise_rms, rms};
use super::{IdentifyError, ResidualTerms, Settings};
use rotordyn_linalg::{Complex64, StopRequest};
use rotordyn_signal::Quantity;
use rotordyn_signal::record::FrfMatrix;

/// FRFs over a band; outputs are the larger side of the test (responses or references), inputs the other.
///
/// ψ and l are interchangeable in the modal form Σ ψ lᵀ/(s − λ), so that either side may carry the shapes: a
/// roving-hammer test has many references and few responses.
#[derive(Clone, Debug)]
pub(super) struct Data {
    /// Uniformly spaced frequencies \[Hz\].
    pub frequencies: Vec<f64>,
    /// Step Δf \[Hz\].
    pub step: f64,
    /// Power p of jω that converts a receptance to the quantity (0, 1, 2: receptance, mobility, accelerance).
    pub power: i32,
    /// `values[output][input][line]`, each over its output's and its input's scale.
    pub values: Vec<Vec<Vec<Complex64>>>,
    pub output_scale: Vec<f64>,
    pub input_scale: Vec<f64>,
    /// Whether the outputs are the references of the test.
    pub swapped: bool,
    pub residual_terms: ResidualTerms,
    /// σ of an exponential window \[1/s\].
    pub added_decay: f64,
    /// After a request fits return where they are; their result is not used.
    pub stop: StopRequest,
}

/// Tolerated deviation from uniform spacing, over the step (rounding of printed digits).
const MAX_JITTER: f64 = 0.02;

impl Data {
    pub fn new(frfs: &FrfMatrix, settings: &Settings) -> Result<Self, IdentifyError> {
        check_motion_over_force(frfs)?;
        let f = &frfs.frequencies;
        let (first, last) = (f.first().copied().unwrap_or(0.0), f.last().copied().unwrap_or(0.0));
        let [from, to] = settings.band.unwrap_or([first, last]);
        let step = if f.len() > 1 { (last - first) / (f.len() - 1) as f64 } else { 0.0 };
        if let Some(k) = (0..f.len()).find(|&k| {
            let off = (f[k] - first - step * k as f64).abs();
            off.is_nan() || off > MAX_JITTER * step
        }) {
            return Err(IdentifyError::NonUniform {
                index: k,
                given: f[k],
                expected: first + step * k as f64,
            });
        }
        // Exclude 0 Hz: no mode is there, and only accelerance is finite for rigid-body motion.
        let lines: Vec<usize> = (0..f.len())
            .filter(|&k| f[k] >= from - 1e-6 * step && f[k] <= to + 1e-6 * step && f[k] > 0.0)
            .collect();
        if lines.len() < 2 * MIN_ORDER + 2 || step <= 0.0 {
            return Err(IdentifyError::EmptyBand { from, to, lines: lines.len(), first, last });
        }
        if let Some(order) = settings.max_order {
            let possible = highest_order(lines.len());
            if order < MIN_ORDER {
                let reason = format!("{order} is too low; stable poles need {MIN_ORDER} or more");
                return Err(IdentifyError::Setting { what: "highest order", reason });
            }
            if order > possible {
                return Err(IdentifyError::TooFewLines {
                    lines: lines.len(),
                    order,
                    needed: 2 * order + 2,
                    possible,
                });
            }
        }
        let powers = powers(frfs, settings);
        let power = powers.iter().flatten().copied().max().unwrap_or(0);
        let swapped = frfs.references.len() > frfs.responses.len();
        let (outputs, inputs) = if swapped {
            (frfs.references.len(), frfs.responses.len())
        } else {
            (frfs.responses.len(), frfs.references.len())
        };
        let mut values = Vec::with_capacity(outputs);
        for o in 0..outputs {
            let mut row = Vec::with_capacity(inputs);
            for i in 0..inputs {
                let (response, reference) = if swapped { (i, o) } else { (o, i) };
                let more = power - powers[response][reference];
                let frf = &frfs.values[response][reference];
                let own = lines
                    .iter()
                    .map(|&k| frf[k] * windowed_s(settings.added_decay, f[k]).powi(more))
                    .collect();
                row.push(own);
            }
            values.push(row);
        }
        let mut data = Self {
            frequencies: lines.iter().map(|&k| f[k]).collect(),
            step,
            power,
            values,
            output_scale: vec![1.0; outputs],
            input_scale: vec![1.0; inputs],
            swapped,
            residual_terms: settings.residual_terms,
            added_decay: settings.added_decay,
            stop: settings.stop.clone(),
        };
        data.check(frfs)?;
        data.check_dead_channels(frfs)?;
        data.rescale(&data.sizes(frfs));
        Ok(data)
    }

    /// Scale of every FRF: its RMS, but at least 30 times its noise and 1e-6 of the largest of its kind
    /// (force or moment, translation or rotation), so that FRFs of noise only are not weighted like a
    /// resonance.
    fn sizes(&self, frfs: &FrfMatrix) -> Vec<Vec<f64>> {
        const NOISE: f64 = 30.0;
        const MIN_SIZE: f64 = 1e-6;
        let kind = |o: usize, i: usize| {
            let (r, e) = if self.swapped { (i, o) } else { (o, i) };
            [frfs.responses[r].is_rotation(), frfs.references[e].is_rotation()]
        };
        let own: Vec<Vec<f64>> =
            self.values.iter().map(|row| row.iter().map(|frf| rms(frf)).collect()).collect();
        let largest = |of: [bool; 2]| {
            let all = own
                .iter()
                .enumerate()
                .flat_map(|(o, row)| row.iter().enumerate().map(move |(i, v)| (o, i, v)));
            all.filter(|(o, i, _)| kind(*o, *i) == of).map(|(_, _, v)| *v).fold(0.0, f64::max)
        };
        let of_kind = [[false, false], [false, true], [true, false], [true, true]].map(|k| (k, largest(k)));
        let least = |o, i| of_kind.iter().find(|(k, _)| *k == kind(o, i)).map_or(0.0, |(_, v)| MIN_SIZE * v);
        let size = |o: usize, i: usize| match own[o][i] {
            // An FRF of zeros has no scale.
            0.0 => 0.0,
            rms => rms.max(NOISE * noise_rms(&self.values[o][i])).max(least(o, i)),
        };
        (0..self.outputs()).map(|o| (0..self.inputs()).map(|i| size(o, i)).collect()).collect()
    }

    /// First and last frequency \[Hz\].
    pub fn band(&self) -> [f64; 2] {
        [self.frequencies[0], self.frequencies[self.lines() - 1]]
    }

    /// Highest model order: as set, else 60 or the maximum for the number of lines.
    pub fn max_order(&self, settings: &Settings) -> usize {
        settings.max_order.unwrap_or(60.min(highest_order(self.lines())))
    }

    fn check(&self, frfs: &FrfMatrix) -> Result<(), IdentifyError> {
        for (o, row) in self.values.iter().enumerate() {
            for (i, frf) in row.iter().enumerate() {
                let (r, e) = if self.swapped { (i, o) } else { (o, i) };
                let (response, reference) = (frfs.responses[r].to_string(), frfs.references[e].to_string());
                if let Some(k) = frf.iter().position(|h| !(h.re.is_finite() && h.im.is_finite())) {
                    return Err(IdentifyError::NotFinite {
                        response,
                        reference,
                        frequency: self.frequencies[k],
                    });
                }
            }
        }
        Ok(())
    }

    /// Error for dead channels: a response that is zero for all references, or a reference without response.
    fn check_dead_channels(&self, frfs: &FrfMatrix) -> Result<(), IdentifyError> {
        let zero = |o: usize, i: usize| self.values[o][i].iter().all(|h| h.norm_sqr() == 0.0);
        let (no, ni) = (self.outputs(), self.inputs());
        let output = (0..no).find(|&o| (0..ni).all(|i| zero(o, i)));
        let input = (0..ni).find(|&i| (0..no).all(|o| zero(o, i)));
        let (response, reference) = if self.swapped { (input, output) } else { (output, input) };
        if let Some(r) = response {
            return Err(IdentifyError::DeadResponse { response: frfs.responses[r].to_string() });
        }
        match reference {
            Some(e) => Err(IdentifyError::DeadReference { reference: frfs.references[e].to_string() }),
            None => Ok(()),
        }
    }

    /// The lines of a range, less what a model explains there: `model(output, input, line)`.
    pub fn window(
        &self,
        lines: std::ops::RangeInclusive<usize>,
        model: impl Fn(usize, usize, usize) -> Complex64,
    ) -> Self {
        let rest = |o: usize, i: usize| {
            lines.clone().map(|k| self.values[o][i][k] - model(o, i, k)).collect::<Vec<_>>()
        };
        Self {
            frequencies: self.frequencies[lines.clone()].to_vec(),
            values: (0..self.outputs()).map(|o| (0..self.inputs()).map(|i| rest(o, i)).collect()).collect(),
            output_scale: self.output_scale.clone(),
            input_scale: self.input_scale.clone(),
            stop: self.stop.clone(),
            ..*self
        }
    }

    pub fn outputs(&self) -> usize {
        self.values.len()
    }

    pub fn inputs(&self) -> usize {
        self.values[0].len()
    }

    pub fn lines(&self) -> usize {
        self.frequencies.len()
    }

    /// s = jω of every line.
    pub fn s(&self) -> Vec<Complex64> {
        self.frequencies.iter().map(|f| Complex64::new(0.0, TAU * f)).collect()
    }

    /// (s + σ)^p of every line: a mobility or an accelerance from records with an exponential window e^{−σt} is that at s + σ.
    pub fn factor(&self) -> Vec<Complex64> {
        self.frequencies.iter().map(|f| windowed_s(self.added_decay, *f).powi(self.power)).collect()
    }

    /// Divides outputs and inputs by scales a_o b_i that bring the given sizes of all FRFs near 1, which
    /// preserves rank-one residues; returns the b.
    ///
    /// Alternating RMS over inputs and outputs; zero FRFs (such as torsion due to a hit along x) do no harm.
    pub fn rescale(&mut self, sizes: &[Vec<f64>]) -> Vec<f64> {
        const ROUNDS: usize = 5;
        let (no, ni) = (self.outputs(), self.inputs());
        let rms = |squares: f64, count: usize| match (squares / count as f64).sqrt() {
            size if size > 0.0 => size,
            _ => 1.0,
        };
        let (mut a, mut b) = (vec![1.0; no], vec![1.0; ni]);
        for _ in 0..ROUNDS {
            for o in 0..no {
                a[o] = rms((0..ni).map(|i| (sizes[o][i] / b[i]).powi(2)).sum(), ni);
            }
            for i in 0..ni {
                b[i] = rms((0..no).map(|o| (sizes[o][i] / a[o]).powi(2)).sum(), no);
            }
        }
        for (o, row) in self.values.iter_mut().enumerate() {
            for (i, frf) in row.iter_mut().enumerate() {
                let scale = a[o] * b[i];
                frf.iter_mut().for_each(|h| *h /= scale);
            }
            self.output_scale[o] *= a[o];
        }
        self.input_scale.iter_mut().zip(&b).for_each(|(total, b)| *total *= b);
        b
    }
}

/// s + σ at a frequency \[Hz\].
fn windowed_s(added_decay: f64, hz: f64) -> Complex64 {
    Complex64::new(added_decay, TAU * hz)
}

/// Minimum model order that separates modes from noise.
const MIN_ORDER: usize = 8;

/// The order with as many unknowns as the data of one FRF.
pub(super) fn highest_order(lines: usize) -> usize {
    lines.saturating_sub(2) / 2
}

/// Refuses FRFs whose unit is that of force over motion.
fn check_motion_over_force(frfs: &FrfMatrix) -> Result<(), IdentifyError> {
    for (response, row) in frfs.responses.iter().zip(&frfs.units) {
        if let Some((reference, unit)) =
            frfs.references.iter().zip(row).find(|(_, unit)| is_force_over_motion(unit))
        {
            return Err(IdentifyError::ForceOverMotion {
                response: response.to_string(),
                reference: reference.to_string(),
                unit: unit.clone(),
            });
        }
    }
    Ok(())
}

/// Whether an SI unit is that of a dynamic stiffness, a mechanical impedance or an apparent mass: "N/m", "kg s^-1", "kg",
/// and those of rotations.
pub fn is_force_over_motion(unit: &str) -> bool {
    let of_force = ["N/", "(N)/", "N m/", "(N m)/"].iter().any(|start| unit.starts_with(start));
    let bases: Vec<&str> = unit.split(' ').collect();
    // In base units a force has a mass; electrical units have one too.
    let of_mass = bases.contains(&"kg") && !bases.iter().any(|base| base.starts_with(['V', 'K']));
    of_force || of_mass
}

/// Power of jω of every FRF: as set, else by its unit, else accelerance, usual in impact tests.
fn powers(frfs: &FrfMatrix, settings: &Settings) -> Vec<Vec<i32>> {
    let quantity = |unit: &String| settings.quantity.or_else(|| quantity_of(unit));
    let power = |unit: &String| derivatives(quantity(unit).unwrap_or(Quantity::Acceleration));
    frfs.units.iter().map(|row| row.iter().map(power).collect()).collect()
}

/// Number of time derivatives from the displacement.
pub fn derivatives(quantity: Quantity) -> i32 {
    match quantity {
        Quantity::Displacement => 0,
        Quantity::Velocity => 1,
        Quantity::Acceleration => 2,
    }
}

/// "2 of 2 FRFs have no unit (...) and are treated as accelerance"; `None` if all have one.
pub fn frfs_without_unit(frfs: &FrfMatrix) -> Option<String> {
    const NAMED: usize = 4;
    let is_unknown = |unit: &str| quantity_of(unit).is_none() && !is_force_over_motion(unit);
    let mut unknown = Vec::new();
    for (response, row) in frfs.responses.iter().zip(&frfs.units) {
        let own = frfs.references.iter().zip(row).filter(|(_, unit)| is_unknown(unit));
        unknown.extend(own.map(|(reference, _)| format!("{response}/{reference}")));
    }
    let (count, all) = (unknown.len(), frfs.responses.len() * frfs.references.len());
    let more = if count > NAMED { ", ..." } else { "" };
    unknown.truncate(NAMED);
    (count > 0).then(|| {
        let names = unknown.join(", ");
        format!("{count} of {all} FRFs have no unit ({names}{more}) and are treated as accelerance")
    })
}

/// Quantity of an FRF by its SI unit: "(m/s^2)/N" is an acceleration (accelerance), "m/N" a displacement
/// (receptance).
pub fn quantity_of(unit: &str) -> Option<Quantity> {
    let moved = match unit.rsplit_once(")/") {
        Some((moved, _)) if unit.starts_with('(') => moved.trim_start_matches('('),
        _ => unit.split('/').next().unwrap_or_default(),
    };
    match moved.trim() {
        "m" | "rad" => Some(Quantity::Displacement),
        "m/s" | "rad/s" => Some(Quantity::Velocity),
        "m/s^2" | "rad/s^2" => Some(Quantity::Acceleration),
        _ => None,
    }
}
