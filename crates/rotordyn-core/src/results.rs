//! Results of single studies: plain data in SI, and what is written of them to files.

mod bearing;
mod bearing_force;
mod bifurcation;
mod cage_comparison;
mod campbell;
mod case_comparison;
mod critical;
mod critical_map;
mod free_ball;
mod frf;
mod history;
mod lyapunov;
mod modal;
mod motion;
mod order_line;
mod order_tracks;
mod poincare;
mod response_grid;
mod run_summary;
mod run_up;
mod run_up_comparison;
mod run_up_correlation;
mod signal;
mod spectra;
mod steady;
mod torsional;
mod trend;
mod unbalance;
mod variant_comparison;

pub use bearing::{
    BallState, BearingLife, BearingPoint, BearingResult, BearingSweepResult, ContactState, EhlFilm,
    PickContact,
};
pub use bearing_force::BearingForce;
pub use bifurcation::{BifurcationPoint, BifurcationResult, BifurcationSweep, SteadyMotion};
pub use cage_comparison::{CageLine, CageSpeed, RollingCageComparison};
pub use campbell::{CampbellResult, LeastDamped};
pub use case_comparison::{
    CaseFrf, CaseUnbalance, ComparedFrf, ComparedUnbalance, FrfComparison, FrfPeak, FrfPoint,
    UnbalanceComparison, UnbalancePeak, UnbalancePoint,
};
pub use critical::CriticalResult;
pub use critical_map::CriticalMap;
pub use free_ball::{CageComparison, FreeBallMean, FreeBallRecord, FreeBallResult, LOSS_NAMES, SkiddingMap};
pub use frf::{FrfResult, LeastDampedMode};
pub use history::{History, HistoryChannel};
pub use lyapunov::LyapunovResult;
pub use modal::ModalResult;
pub use motion::{BearingMotion, BodyMotion, Motion};
pub use order_line::OrderLine;
pub use poincare::{PlaneSection, PoincareResult, Whirl};
pub use response_grid::{UndampedPeak, is_rotation, unit_of};
pub use run_summary::{ChannelSummary, RunSummary};
pub use run_up::{CagePhaseBand, CagePhaseChannel, CagePhaseLine, RunUpResult, StepError, StepErrorLine};
pub use run_up_comparison::{CaseCut, CaseRun, ComparedChannel, CutPoint, RunUpComparison};
pub use run_up_correlation::{Agreement, ChannelPair, CutAgreement, CutPair, CutPeak, level_difference_db};
pub use signal::{
    BearingWithOrders, CyclicLine, CyclicResult, EnvelopeResult, JerkResult, KurtogramResult, RaceResult,
    ShaftAverage, ShaftOrders, ShaftSummary, SignalResult, SpectrogramWithSpeed,
};
pub use spectra::{OrderResult, SpectrogramPeak, SpectrogramResult};
pub use steady::{RecordedPeriods, SectionChannel, SectionClock};
pub use torsional::{Interference, TorsionalResult};
pub use trend::{
    Change, LineLevel, RecordDiagnosis, RecordState, TrendAxis, TrendQuantity, TrendRecord, TrendResult,
};
pub use unbalance::{DiscOrbit, ResponsePeak, UnbalanceChannel, UnbalanceResult};
pub use variant_comparison::{PairedMode, PairedModes, UnpairedVariant, VariantComparison, VariantMode};

pub use crate::document::Column;
use crate::document::{Document, Section};
use crate::warning::Warning;

/// The warnings; none without any.
pub fn warnings_section(warnings: &[Warning]) -> Option<Section<'_>> {
    let content = || Document::new().with("", Warning::list(warnings));
    (!warnings.is_empty()).then(|| Section::new("warnings", "warnings", content()))
}
