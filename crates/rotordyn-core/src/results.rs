//! Results of the studies of a model: plain data in SI, and what is written of them to files.

mod bearing;
mod bifurcation;
mod cage_comparison;
mod campbell;
mod critical;
mod free_ball;
mod frf;
mod history;
mod lyapunov;
mod modal;
mod motion;
mod order_line;
mod poincare;
mod response_grid;
mod run_up;
mod run_up_correlation;
mod signal;
mod spectra;
mod steady;
mod unbalance;

pub use bearing::{
    BallState, BearingLife, BearingPoint, BearingResult, BearingSweepResult, ContactState, EhlFilm,
    PickContact,
};
pub use bifurcation::{BifurcationPoint, BifurcationResult, BifurcationSweep, SteadyMotion};
pub use cage_comparison::{CageLine, CageSpeed, RollingCageComparison};
pub use campbell::CampbellResult;
pub use critical::CriticalResult;
pub use free_ball::{CageComparison, FreeBallMean, FreeBallRecord, FreeBallResult, LOSS_NAMES, SkiddingMap};
pub use frf::FrfResult;
pub use history::{History, HistoryChannel};
pub use lyapunov::LyapunovResult;
pub use modal::ModalResult;
pub use motion::{BearingMotion, BodyMotion, Motion};
pub use order_line::OrderLine;
pub use poincare::{PlaneSection, PoincareResult, Whirl};
pub use response_grid::{UndampedPeak, is_rotation, unit_of};
pub use run_up::{CagePhaseBand, CagePhaseChannel, CagePhaseLine, RunUpResult, StepError, StepErrorLine};
pub use run_up_correlation::{ChannelPair, CutPair, CutPeak, level_difference_db};
use serde::{Deserialize, Serialize};
pub use signal::{
    BearingWithOrders, CyclicLine, CyclicResult, EnvelopeResult, JerkResult, KurtogramResult, RaceResult,
    ShaftAverage, ShaftOrders, ShaftSummary, SignalResult, SpectrogramWithSpeed,
};
pub use spectra::{OrderResult, SpectrogramResult};
pub use steady::{SectionChannel, SectionClock};
pub use unbalance::{DiscOrbit, ResponsePeak, UnbalanceChannel, UnbalanceResult};

use crate::analysis::ball_inertia::InertiaUse;
use crate::analysis::equilibrium::Equilibrium;
use crate::assembly::DofMap;
pub use crate::document::Column;
use crate::document::{Document, Section, in_json};
use crate::warning::Warning;

/// Everything computed from one model; studies not requested are empty.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Results {
    pub equilibrium: Option<Equilibrium>,
    pub modal: Vec<ModalResult>,
    pub campbell: Option<CampbellResult>,
    pub critical: Option<CriticalResult>,
    pub frf: Option<FrfResult>,
    pub unbalance: Option<UnbalanceResult>,
    pub run_up: Option<RunUpResult>,
    pub spectrograms: Vec<SpectrogramResult>,
    pub orders: Vec<OrderResult>,
    pub cage_phases: Option<CagePhaseBand>,
    pub poincare: Option<PoincareResult>,
    pub lyapunov: Option<LyapunovResult>,
    pub bifurcation: Option<BifurcationResult>,
    pub bearings: Vec<BearingResult>,
    /// Ball inertia used in every study, by its name.
    pub ball_inertia: Vec<(String, Vec<InertiaUse>)>,
    /// Warnings for the user, once each.
    pub warnings: Vec<Warning>,
}

impl Results {
    /// What is written to files: a section for every study that has a result.
    pub fn sections<'a>(&'a self, dofs: &DofMap) -> Vec<Section<'a>> {
        // Every field is named, so that none is forgotten.
        let Self {
            equilibrium,
            modal,
            campbell,
            critical,
            frf,
            unbalance,
            run_up,
            spectrograms,
            orders,
            cage_phases,
            poincare,
            lyapunov,
            bifurcation,
            bearings,
            ball_inertia,
            warnings,
        } = self;
        let one = |json, hdf5, document: Option<Document<'a>>| Some(Section::new(json, hdf5, document?));
        let mut out: Vec<Section> = [
            one("equilibrium", "equilibrium", equilibrium.as_ref().map(|found| found.document(dofs))),
            one("modal", "modes", (!modal.is_empty()).then(|| ModalResult::document(modal, dofs))),
            one("campbell", "campbell", campbell.as_ref().map(CampbellResult::document)),
            one("critical_speeds", "critical_speeds", critical.as_ref().map(|found| found.document(dofs))),
            one("frf", "frf", frf.as_ref().map(FrfResult::document)),
            one("unbalance", "unbalance", unbalance.as_ref().map(UnbalanceResult::document)),
            one("run_up", "run_up", run_up.as_ref().map(RunUpResult::document)),
            one("cage_phases", "run_up/cage_phases", cage_phases.as_ref().map(CagePhaseBand::document)),
            one("poincare", "poincare", poincare.as_ref().map(PoincareResult::document)),
            one("lyapunov", "lyapunov", lyapunov.as_ref().map(LyapunovResult::document)),
            one("bifurcation", "bifurcation", bifurcation.as_ref().map(BifurcationResult::document)),
        ]
        .into_iter()
        .flatten()
        .collect();
        out.extend(spectrograms.iter().map(SpectrogramResult::section));
        out.extend(orders.iter().map(OrderResult::section));
        out.extend(bearings.iter().map(BearingResult::section));
        for (study, used) in ball_inertia {
            out.extend(used.iter().map(|used| {
                let content = Document::new().text(in_json("study"), study);
                let content = content.text(in_json("bearing"), &used.bearing).and(used.document());
                Section::listed("ball_inertia", format!("ball_inertia/{study}/{}", used.bearing), content)
            }));
        }
        out.extend(warnings_section(warnings));
        out
    }
}

/// The warnings; none without any.
pub fn warnings_section(warnings: &[Warning]) -> Option<Section<'_>> {
    let content = || Document::new().with("", Warning::list(warnings));
    (!warnings.is_empty()).then(|| Section::new("warnings", "warnings", content()))
}
