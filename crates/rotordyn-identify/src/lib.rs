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
//! | [`operational`] | modes from responses alone: SSI-cov, FDD, harmonics of the shaft |
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
pub mod operational;
mod plscf;
mod pole_selection;
mod refine;
mod result;
pub mod sdof;
mod settings;
mod stabilisation;
mod uncertainty;
mod whirl;

pub use data::quantity_of;
pub use error::IdentifyError;
use mode_selection::synthesise;
pub use result::{DiagramPole, ModalIdentification, Mode, Stability};
pub use settings::Settings;

use data::Data;
use plscf::{NormalEquations, Pole};
use rotordyn_linalg::Complex64;
use rotordyn_signal::Quantity;
use rotordyn_signal::record::FrfMatrix;

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
