//! Automatic experimental modal analysis (EMA): modes from measured FRFs.
//!
//! | module | contents |
//! |---|---|
//! | `data` | one band, one quantity, scales |
//! | `plscf` | poles, participations of all orders: poly-reference least-squares complex frequency (pLSCF) |
//! | `stabilisation` | shapes for each, stabilisation diagram |
//! | `pole_selection` | automatic pole selection |
//! | `lsfd` | residues, residual terms: least-squares frequency domain (LSFD) |
//! | `refine`, `mode_selection` | poles by nonlinear least squares; mode selection, duplicates |
//! | `uncertainty` | standard errors of poles (jackknife) |
//! | [`mac`](mod@mac) | MAC, FRAC, FDAC, phase collinearity |
//! | [`sdof`] | single-degree-of-freedom (SDOF) circle and peak fit of one mode |
//! | `whirl` | whirl direction from x and y |
//!
//! H(s) = s^p \[Σ_r (ψ_r l_rᵀ/(s − λ_r) + conj. pair) + U + V/s²\]: ψ is the mode shape (right eigenvector),
//! l the modal participation (left eigenvector). No reciprocity is assumed: on a rotating machine l is not
//! proportional to ψ.

mod data;
mod dense;
mod error;
mod lsfd;
pub mod mac;
mod mode_selection;
mod plscf;
mod pole_selection;
mod refine;
pub mod sdof;
mod stabilisation;
mod uncertainty;
mod whirl;

pub use data::quantity_of;
pub use error::IdentifyError;

use std::f64::consts::TAU;

use crate::linalg::Complex64;
use crate::model::Quantity;
use crate::signal::record::{Dof, FrfMatrix};
use data::Data;
use lsfd::Fit;
use plscf::{NormalEquations, Pole};

/// Settings of modal identification.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Frequency band \[Hz\]; all measured lines if `None`.
    pub band: Option<[f64; 2]>,
    /// Highest model order (of the denominator); 60, or the maximum for the number of lines, if `None`.
    pub max_order: Option<usize>,
    /// Quantity of the FRFs, if not given by their unit; accelerance if `None`.
    pub quantity: Option<Quantity>,
    /// Largest damping ratio of a mode.
    pub largest_damping: f64,
    /// Decay rate added to all poles by an exponential window \[1/s\], corrected in the result.
    pub added_decay: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { band: None, max_order: None, quantity: None, largest_damping: 0.2, added_decay: 0.0 }
    }
}

/// One identified mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// λ \[1/s\], Im λ > 0.
    pub pole: Complex64,
    /// ψ over [`ModalIdentification::responses`]; ψ lᵀ is the residue of the receptance
    /// \[m/(N s) for a displacement under a force\].
    pub shape: Vec<Complex64>,
    /// l over [`ModalIdentification::references`].
    pub participation: Vec<Complex64>,
    /// Standard error of the damped frequency \[Hz\].
    pub frequency_error: f64,
    /// Standard error of the damping ratio.
    pub damping_error: f64,
    /// Modal phase collinearity (MPC) of the side with more DOFs, 1 for a real mode.
    pub collinearity: f64,
    /// Whirl at the points measured along x and y: 1 forward circular (x towards y), 0 planar, −1 backward
    /// circular; `None` if no point has both.
    pub whirl: Option<f64>,
    /// F statistic of the mode: variance that it explains over residual variance.
    pub significance: f64,
}

impl Mode {
    /// Damped frequency Im λ / 2π \[Hz\].
    pub fn frequency_hz(&self) -> f64 {
        self.pole.im / TAU
    }

    /// Damping ratio ζ = −Re λ / |λ|.
    pub fn damping_ratio(&self) -> f64 {
        -self.pole.re / self.pole.norm()
    }
}

/// Stability of a pole relative to the next lower order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// No pole within 1 % of its frequency.
    New,
    /// Within 1 % in frequency.
    Frequency,
    /// In frequency, and within 5 % in damping.
    Damping,
    /// In frequency, and MAC above 0.95.
    Shape,
    /// In frequency, damping and shape.
    Stable,
}

impl Stability {
    /// Label.
    pub fn label(self) -> &'static str {
        match self {
            Stability::New => "new",
            Stability::Frequency => "frequency",
            Stability::Damping => "frequency and damping",
            Stability::Shape => "frequency and shape",
            Stability::Stable => "stable",
        }
    }
}

/// A pole of the stabilisation diagram.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramPole {
    pub order: usize,
    /// λ \[1/s\], without correction for an exponential window.
    pub value: Complex64,
    pub stability: Stability,
}

/// Result of modal identification: identified modes, synthesised FRFs, stabilisation diagram.
#[derive(Clone, Debug)]
pub struct ModalIdentification {
    /// In order of frequency.
    pub modes: Vec<Mode>,
    pub responses: Vec<Dof>,
    pub references: Vec<Dof>,
    /// Quantity assumed for the measured FRFs.
    pub quantity: Quantity,
    /// Lines in the band \[Hz\].
    pub frequencies: Vec<f64>,
    /// `measured[response][reference][line]` in the band, converted to one quantity.
    pub measured: Vec<Vec<Vec<Complex64>>>,
    /// FRFs synthesised from the modal model, with the same indices.
    pub synthesised: Vec<Vec<Vec<Complex64>>>,
    /// ‖measured − synthesised‖ / ‖measured‖ of every FRF.
    pub errors: Vec<Vec<f64>>,
    /// Root mean square of all errors.
    pub total_error: f64,
    /// Upper residual U (stiffness of modes above), lower residual V (mass of modes below) of receptances.
    pub upper: Vec<Vec<f64>>,
    pub lower: Vec<Vec<f64>>,
    pub diagram: Vec<DiagramPole>,
    pub orders: Vec<usize>,
    /// Stable poles that were rejected afterwards, with the reason.
    pub dropped: Vec<String>,
}

impl ModalIdentification {
    /// The side of the test with more DOFs, and a mode's vector over it, for display and comparison.
    ///
    /// In a roving-hammer test these are the references.
    pub fn larger_side_shape<'a>(&'a self, mode: &'a Mode) -> (&'a [Dof], &'a [Complex64]) {
        if self.references.len() > self.responses.len() {
            (&self.references, &mode.participation)
        } else {
            (&self.responses, &mode.shape)
        }
    }

    /// AutoMAC: MAC of every mode with every other, over the side with more DOFs.
    pub fn auto_mac(&self) -> Vec<Vec<f64>> {
        let shapes: Vec<&[Complex64]> = self.modes.iter().map(|m| self.larger_side_shape(m).1).collect();
        mac::mac_matrix(&shapes, &shapes)
    }
}

/// Lowest order tried.
const LOWEST_ORDER: usize = 2;

/// Identifies the modes in FRFs.
///
/// Poles of all orders by pLSCF, automatic selection of stable poles, joint refinement by nonlinear least
/// squares on all FRFs; insignificant modes are dropped and listed.
///
/// # Errors
/// Non-uniform frequencies, a band without data, too few lines for the order, values that are not finite, a
/// dead channel, no mode.
pub fn identify(frfs: &FrfMatrix, settings: &Settings) -> Result<ModalIdentification, IdentifyError> {
    let mut data = Data::new(frfs, settings)?;
    let equations = NormalEquations::new(&data, settings)?;
    let orders: Vec<usize> = (LOWEST_ORDER..=data.max_order(settings)).collect();
    let candidates = stabilisation::candidates(&data, equations.poles(&orders)?)?;
    let diagram = stabilisation::diagram(&candidates, &orders);
    let poles = pole_selection::select_poles(&data, &candidates, orders.len());
    let mut dropped = Vec::new();
    let selected = if poles.is_empty() {
        None
    } else {
        mode_selection::select_modes(&mut data, poles, settings, &mut dropped)
    };
    let found = selected.ok_or(IdentifyError::NoMode {
        from: data.frequencies[0],
        to: data.frequencies[data.lines() - 1],
        poles: candidates.len(),
        orders: orders.len(),
    })?;
    Ok(assemble_result(frfs, settings, &data, found, diagram, orders, dropped))
}

/// FRFs of the modal model in the data's scales, `[output][input][line]`.
fn synthesise(data: &Data, poles: &[Pole], fit: &Fit) -> Vec<Vec<Vec<Complex64>>> {
    let s = data.s();
    let one = |o: usize, i: usize| {
        let value = |s: &Complex64| {
            let mut sum = fit.upper[o][i] + fit.lower[o][i] / (s * s);
            for (pole, shape) in poles.iter().zip(&fit.shapes) {
                let residue = shape[o] * pole.participation[i];
                sum += residue / (s - pole.value) + residue.conj() / (s - pole.value.conj());
            }
            sum * s.powi(data.power)
        };
        s.iter().map(value).collect()
    };
    (0..data.outputs()).map(|o| (0..data.inputs()).map(|i| one(o, i)).collect()).collect()
}

fn assemble_result(
    frfs: &FrfMatrix,
    settings: &Settings,
    data: &Data,
    found: mode_selection::SelectedModes,
    diagram: Vec<DiagramPole>,
    orders: Vec<usize>,
    dropped: Vec<String>,
) -> ModalIdentification {
    let model = synthesise(data, &found.poles, &found.fit);
    let scale = |o: usize, i: usize| data.output_scale[o] * data.input_scale[i];
    let (responses, references) = (frfs.responses.len(), frfs.references.len());
    let place = |r: usize, e: usize| if data.swapped { (e, r) } else { (r, e) };
    let table = |of: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
        (0..responses)
            .map(|r| {
                (0..references)
                    .map(|e| {
                        let (o, i) = place(r, e);
                        of(o, i)
                    })
                    .collect()
            })
            .collect()
    };
    let curves = |of: &[Vec<Vec<Complex64>>]| -> Vec<Vec<Vec<Complex64>>> {
        let one = |r: usize, e: usize| {
            let (o, i) = place(r, e);
            of[o][i].iter().map(|h| h * scale(o, i)).collect()
        };
        (0..responses).map(|r| (0..references).map(|e| one(r, e)).collect()).collect()
    };
    let errors_of = table(&|o, i| {
        let (mut rest, mut all) = (0.0, 0.0);
        for (h, m) in data.values[o][i].iter().zip(&model[o][i]) {
            rest += (h - m).norm_sqr();
            all += h.norm_sqr();
        }
        if all > 0.0 { (rest / all).sqrt() } else { 0.0 }
    });
    let count = (responses * references) as f64;
    let total_error = (errors_of.iter().flatten().map(|e| e * e).sum::<f64>() / count).sqrt();
    let mut modes: Vec<Mode> = (0..found.poles.len())
        .map(|m| {
            let pole = &found.poles[m];
            // The larger side carries the residue's magnitude, the smaller has a largest entry of 1.
            let mut small: Vec<Complex64> =
                pole.participation.iter().zip(&data.input_scale).map(|(l, b)| l * *b).collect();
            let before = small.clone();
            small = plscf::normalise_largest(small);
            let k = lsfd::normalised_input(&Pole { value: pole.value, participation: before.clone() });
            let large: Vec<Complex64> =
                found.fit.shapes[m].iter().zip(&data.output_scale).map(|(v, a)| v * *a * before[k]).collect();
            let (frequency_error, damping_error) =
                uncertainty::standard_errors(pole.value, found.covariance[m]);
            let collinearity = mac::phase_collinearity(&large);
            let (shape, participation) = if data.swapped { (small, large) } else { (large, small) };
            let whirl = whirl::whirl(&frfs.responses, &shape)
                .or_else(|| whirl::whirl(&frfs.references, &participation).map(|w| -w));
            Mode {
                pole: pole.value + settings.added_decay,
                shape,
                participation,
                frequency_error,
                damping_error,
                collinearity,
                whirl,
                significance: found.significance[m],
            }
        })
        .collect();
    modes.sort_by(|a, b| a.pole.im.total_cmp(&b.pole.im));
    ModalIdentification {
        modes,
        responses: frfs.responses.clone(),
        references: frfs.references.clone(),
        quantity: [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration][data.power as usize],
        frequencies: data.frequencies.clone(),
        measured: curves(&data.values),
        synthesised: curves(&model),
        errors: errors_of,
        total_error,
        upper: table(&|o, i| found.fit.upper[o][i] * scale(o, i)),
        lower: table(&|o, i| found.fit.lower[o][i] * scale(o, i)),
        diagram,
        orders,
        dropped,
    }
}
