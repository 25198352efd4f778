//! The studies: each computes results from a model, one method of [`Machine`] each; and the results of all of them.

mod ball_states;
mod bearing;
mod bearing_life;
mod bearing_motion;
mod bifurcation;
mod cage_comparison;
mod cage_phases;
mod cage_turns;
mod case_comparison;
mod critical_map;
mod ehl_film;
mod error;
pub mod forecast;
pub mod free_ball;
mod machine;
mod milestone;
mod motion;
mod order_agreement;
mod order_lines;
mod order_tracking;
mod probe_filter;
mod record;
mod responses;
mod run_up_comparison;
mod run_up_correlation;
mod settled_run;
mod settling;
pub mod signal;
mod speed_cache;
mod steady_motion;
mod step_error;
mod strongest_orders;
mod torsional;
pub mod trend;
mod unbalance_comparison;
mod unbalance_loads;
mod unbalance_peaks;
mod variant_comparison;
mod warnings;

pub use bearing::single_bearings;
pub use bearing_motion::bearing_motion;
pub use bifurcation::{BifurcationProgress, FinishedValues, bifurcation, bifurcation_from};
pub use case_comparison::{FrfCase, MEASURED, MeasuredFrf, compare_frfs};
pub use error::StudyError;
pub use machine::Machine;
pub use milestone::Milestone;
pub use motion::{MotionRecorder, MotionSnapshot};
pub use record::{RecordedSample, Recorder, RecorderSnapshot};
pub use run_up_comparison::{Run, compare_run_ups};
pub use run_up_correlation::MeasuredRun;
pub use settled_run::SettledSnapshot;
pub use steady_motion::{Progress, RestartState};
pub use step_error::{Checkpoints, run_for_step_error};
pub use unbalance_comparison::compare_unbalance;
pub use variant_comparison::{Variant, compare_variants};
pub use warnings::smeared_maxima;

use crate::analysis::ball_inertia::InertiaUse;
use crate::analysis::equilibrium::Equilibrium;
use crate::assembly::DofMap;
use crate::document::{Document, Section, in_json};
use crate::results::{
    BearingResult, BifurcationResult, CagePhaseBand, CampbellResult, CriticalMap, CriticalResult, FrfResult,
    LyapunovResult, ModalResult, OrderResult, PoincareResult, RunUpResult, SpectrogramResult,
    TorsionalResult, UnbalanceResult, warnings_section,
};
use crate::warning::Warning;
use serde::{Deserialize, Serialize};

/// Everything computed from one model; studies not requested are empty.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Results {
    pub equilibrium: Option<Equilibrium>,
    pub modal: Vec<ModalResult>,
    pub campbell: Option<CampbellResult>,
    pub critical: Option<CriticalResult>,
    pub critical_map: Option<CriticalMap>,
    pub torsional: Option<TorsionalResult>,
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
            critical_map,
            torsional,
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
            one("critical_map", "critical_map", critical_map.as_ref().map(CriticalMap::document)),
            one("torsional", "torsional", torsional.as_ref().map(TorsionalResult::document)),
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
