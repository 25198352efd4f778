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
//! | `reweight` | weights of the FRFs by noise and misfit |
//! | `outside` | modes just outside the band, which act in it |
//! | `pairs` | modes that two close modes fit better: found, or marked |
//! | `two_modes` | two close poles: two modes, or one mode that differs between the FRFs |
//! | `window`, `principal_outputs` | FRFs in a part of the band, on few directions, for cheap fits |
//! | `uncertainty`, `misfit`, `nonlinearity` | standard errors of poles: noise (jackknife) and error of the modal model |
//! | `truncation` | error by the modes outside the band |
//! | `alternative_mode` | what a mode may be instead, as part of its standard errors |
//! | `mode_coherence` | coherence at the resonances |
//! | `single_lines` | lines that stand alone, such as those of the mains |
//! | `shape_errors` | standard errors of shapes |
//! | `one_band`, `bands` | modes of one band; a record that holds too much for one is split |
//! | [`mac`](mod@mac) | MAC, FRAC, FDAC, phase collinearity |
//! | [`sdof`] | single-degree-of-freedom (SDOF) circle and peak fit of one mode |
//! | [`whirl`] | whirl direction from x and y |
//! | [`operational`] | modes from responses alone: SSI-cov, FDD, harmonics of the shaft |
//!
//! H(s) = s^p \[Σ_r (ψ_r l_rᵀ/(s − λ_r) + conj. pair) + U + V/s²\]: ψ is the mode shape (right eigenvector),
//! l the modal participation (left eigenvector). No reciprocity is assumed: on a rotating machine l is not
//! proportional to ψ.

mod alternative_mode;
mod bands;
mod data;
mod dense;
mod driving_point;
mod error;
mod frf_power;
mod lsfd;
pub mod mac;
mod misfit;
mod mode_coherence;
mod mode_selection;
mod nonlinearity;
mod one_band;
pub mod operational;
mod outside;
mod pairs;
mod plscf;
mod pole_selection;
mod principal_outputs;
mod refine;
mod result;
mod reweight;
pub mod sdof;
mod settings;
mod shape_errors;
mod single_lines;
mod stabilisation;
mod truncation;
mod two_modes;
mod uncertainty;
pub mod whirl;
mod window;

pub use data::{derivatives, frfs_without_unit, is_force_over_motion, quantity_of};
pub use driving_point::driving_point_faults;
pub use error::IdentifyError;
pub use mode_coherence::low_coherence;
pub use result::{DiagramPole, DroppedPole, ModalIdentification, Mode, QualityWarning, Stability};
pub use settings::{ResidualTerms, Settings};
pub use single_lines::{single_lines_text, without_single_lines};

use data::Data;
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::FrfMatrix;

/// Identifies the modes in FRFs.
///
/// Poles of all orders by pLSCF, automatic selection of stable poles, joint refinement by nonlinear least
/// squares on all FRFs; insignificant modes are dropped and listed, doubtful ones marked. A record that holds too
/// much for one band is split into several.
///
/// # Errors
/// Non-uniform frequencies, a band without data, too few lines for the order, values that are not finite, a
/// dead channel, no mode.
pub fn identify(frfs: &FrfMatrix, settings: &Settings) -> Result<ModalIdentification, IdentifyError> {
    let data = Data::new(frfs, settings)?;
    let (rises, [from, to]) = (phase_rise(&data) > REVERSED_RISE, data.band());
    let found = match bands::split(&data) {
        bands if bands.len() > 1 => bands::identify_bands(frfs, settings, &bands),
        _ => one_band::identify_band(frfs, settings, data),
    };
    match found {
        Err(IdentifyError::NoMode { .. }) if rises => Err(IdentifyError::ReversedPhase { from, to }),
        found => found,
    }
}

/// Mean sine of the phase's rise from line to line, from which it is no chance.
const REVERSED_RISE: f64 = 0.02;

/// Mean sine of the rise of the phase from line to line, weighted by the power of each FRF's lines: Σ Im(H_{k+1} H_k*) / Σ |H_{k+1} H_k|.
///
/// Negative of a damped structure, whose phase falls by π in every resonance: between, where it rises, it has no power.
fn phase_rise(data: &Data) -> f64 {
    let of = |frf: &Vec<Complex64>| {
        let pairs = || frf.windows(2).map(|w| w[1] * w[0].conj());
        let size: f64 = pairs().map(|p| p.norm()).sum();
        if size > 0.0 { pairs().map(|p| p.im).sum::<f64>() / size } else { 0.0 }
    };
    let all: Vec<f64> = data.values.iter().flatten().map(of).collect();
    all.iter().sum::<f64>() / all.len().max(1) as f64
}
