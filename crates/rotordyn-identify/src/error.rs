//! Errors of modal identification: what is wrong, and what to do.

use super::DroppedPole;
use rotordyn_linalg::StopRequest;

/// FRFs or settings from which no modes can be identified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IdentifyError {
    #[error(
        "the frequencies are not uniformly spaced: line {index} is {given:.6} Hz, not {expected:.6} Hz; interpolate the FRFs, or measure with a constant resolution"
    )]
    NonUniform { index: usize, given: f64, expected: f64 },
    #[error(
        "the band {from:.3} .. {to:.3} Hz contains {lines} lines of the {first:.3} .. {last:.3} Hz measured; choose a wider band in this range"
    )]
    EmptyBand { from: f64, to: f64, lines: usize, first: f64, last: f64 },
    #[error(
        "{lines} lines are too few for order {order}: a fit needs {needed} or more; widen the band, lower the order to {possible}, or measure with a finer resolution"
    )]
    TooFewLines { lines: usize, order: usize, needed: usize, possible: usize },
    #[error(
        "the FRF of response {response} to reference {reference} is NaN or infinite at {frequency:.3} Hz; leave it out (of the file or of the mapping), or choose a band without it"
    )]
    NotFinite { response: String, reference: String, frequency: f64 },
    #[error(
        "the FRF of response {response} to reference {reference} is in {unit}: force over motion (dynamic stiffness, mechanical impedance or apparent mass), whose peaks are antiresonances; give motion over force (receptance, mobility or accelerance), of a single FRF its reciprocal, of several the inverse of their matrix at every frequency"
    )]
    ForceOverMotion { response: String, reference: String, unit: String },
    #[error(
        "response {response} is zero over the whole band: a dead channel; leave it out (of the file or of the mapping)"
    )]
    DeadResponse { response: String },
    #[error(
        "all responses to reference {reference} are zero in the band: a dead channel; leave it out (of the file or of the mapping)"
    )]
    DeadReference { reference: String },
    #[error(
        "no mode was found in {from:.3} .. {to:.3} Hz: of {poles} poles in {orders} orders none is stable{}; choose a band with a resonance, raise the order, or check the coherence",
        left_out(dropped)
    )]
    NoMode { from: f64, to: f64, poles: usize, orders: usize, dropped: Vec<DroppedPole> },
    #[error(
        "no mode was found in {from:.3} .. {to:.3} Hz: the phase of the FRFs rises through the resonances, as of the time convention e^(-j omega t) or of a reversed imaginary part; reverse its sign"
    )]
    ReversedPhase { from: f64, to: f64 },
    #[error(
        "the record of response {response} is NaN or infinite at {time:.6} s; leave the channel out, or choose a time range without it"
    )]
    NotFiniteSample { response: String, time: f64 },
    #[error(
        "{duration:.3} s of record are too short for modes from {lowest:.3} Hz on: {needed:.3} s or more are needed for standard errors; record longer, or raise the lower end of the band"
    )]
    ShortRecord { duration: f64, needed: f64, lowest: f64 },
    #[error("the identification was stopped")]
    Stopped,
    #[error("{what}: {reason}")]
    Setting { what: &'static str, reason: String },
    #[error("an eigenvalue computation failed: {0}")]
    Eigen(#[from] rotordyn_linalg::eigen::EigenError),
}

impl IdentifyError {
    /// [`Self::Stopped`] after a request.
    pub(crate) fn if_stopped(stop: &StopRequest) -> Result<(), Self> {
        if stop.is_requested() { Err(Self::Stopped) } else { Ok(()) }
    }
}

/// What was left out, in parentheses; nothing if no pole was.
fn left_out(dropped: &[DroppedPole]) -> String {
    let list: Vec<String> = dropped.iter().map(ToString::to_string).collect();
    if list.is_empty() { String::new() } else { format!(" (left out: {})", list.join("; ")) }
}
