//! Impact tests: FRFs from hits with an instrumented hammer.
//!
//! | module | contents |
//! |---|---|
//! | [`trigger`] | detection of hits in a force record |
//! | [`quality`] | double hits, overloads and truncated responses of a hit |
//! | [`frf`] | force and exponential window; H1, H2, Hv and coherence from hits or random excitation |
//! | [`records`] | from time records to averaged FRFs, without unusable hits |

mod decay;
pub mod frf;
pub mod quality;
pub mod records;
pub mod trigger;

pub use frf::{Estimator, FrfEstimate, ImpactWindows, frf_from_hits, frf_from_random, frf_from_spectra};
pub use quality::{HitQuality, Limits, inspect};
pub use records::{ImpactTest, frfs};
pub use trigger::Trigger;

/// One hit: force and response sampled together.
#[derive(Clone, Copy, Debug)]
pub struct Hit<'a> {
    pub force: &'a [f64],
    pub response: &'a [f64],
}

/// Index and magnitude of the largest |value|; (0, 0) for an empty record.
fn peak(record: &[f64]) -> (usize, f64) {
    let largest = record.iter().enumerate().map(|(n, v)| (n, v.abs()));
    largest.fold((0, 0.0), |best, here| if here.1 > best.1 { here } else { best })
}
