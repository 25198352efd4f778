//! Runs at constant speed continued until the motion has settled, up to a limit of periods.

use std::ops::ControlFlow;

use super::milestone::Milestone;
use super::settled_run::{Criteria, SettledRun, SettledSnapshot, SettledStart};
use super::steady_motion::sections;
use super::{Machine, StudyError};
use crate::model::Probe;
use crate::model::study::SteadyRunSettings;
use crate::results::{SectionChannel, SteadyMotion};
use crate::transient::reduction::Reduction;
use crate::transient::steady::{SteadySnapshot, SteadyStart};
use rotordyn_signal::motion_classification::{Classification, Motion};

/// Logarithmic change of a section's mean square change between its halves below which a motion counts as
/// quasi-periodic at once; else a second record must have the same mean square change, within the second limit.
const SURE_TREND: f64 = 0.01;
const SAME_AMPLITUDE: f64 = 0.05;
/// Number by which the estimated periods to the limit may exceed the periods left for the run to go on.
const WORTH_CONTINUING: f64 = 3.0;

/// Fewest section points of a motion that can be classified.
const FEWEST_SECTIONS: usize = 8;

impl Machine {
    /// Runs, records and classifies; while the motion has not settled, everything so far becomes transient and the
    /// record is repeated after as many periods as its decay needs, or after as many again where that is unknown,
    /// until `transient_limit`; earlier if the decay needs far more.
    ///
    /// When stopped: what is recorded by then if it can be classified, else the record before, else `None`.
    pub(super) fn settled_run(
        &self,
        reduction: &Reduction,
        start: SettledStart,
        steady: &SteadyRunSettings,
        (probes, channels): (&[&Probe], &[SectionChannel]),
        criteria: Criteria,
        progress: &mut dyn FnMut(&Milestone<SettledSnapshot>) -> ControlFlow<()>,
    ) -> Result<Option<SettledRun>, StudyError> {
        let mut settings = steady.clone();
        let (mut discarded, mut before) = (steady.transient_periods, None);
        let mut start = match start {
            SettledStart::State(state) => SteadyStart::State(state),
            SettledStart::Snapshot(snapshot) => {
                settings.transient_periods = snapshot.transient_periods;
                (discarded, before) = (snapshot.discarded, snapshot.before);
                SteadyStart::Snapshot(Box::new(snapshot.run))
            }
        };
        let mut last_record = None;
        loop {
            let (transient_periods, mut stopped) = (settings.transient_periods, false);
            let observe = &mut |now: &Milestone<SteadySnapshot>| {
                let take = || SettledSnapshot { discarded, transient_periods, before, run: now.snapshot() };
                let flow = progress(&Milestone::new(now.share, &take));
                stopped |= flow.is_break();
                flow
            };
            let perturbation = criteria.perturbation;
            let run = self.steady_run(reduction, start, &settings, (probes, perturbation), observe)?;
            if stopped && run.periods < FEWEST_SECTIONS.min(settings.periods) {
                return Ok(last_record);
            }
            let recorded = SteadyRunSettings { periods: run.periods, ..settings.clone() };
            let (strobe, mut motion) =
                sections(&run, channels, &recorded, criteria.tolerance, criteria.longest_period)?;
            motion.transient_periods = discarded;
            let unconfirmed = !confirmed(&motion.motion, before.as_ref());
            let left = steady.transient_limit.saturating_sub(discarded + steady.periods);
            let further = if unconfirmed {
                further_periods(&motion, criteria.tolerance, discarded, steady)
            } else {
                0.0
            };
            let last = !unconfirmed || left == 0 || further > WORTH_CONTINUING * left as f64;
            if stopped || last {
                if unconfirmed && motion.motion.motion == Motion::QuasiPeriodic {
                    motion.motion.motion = Motion::Unsettled;
                }
                return Ok(Some(SettledRun { run, strobe, motion, complete: !stopped }));
            }
            before = Some(motion.motion);
            settings.transient_periods = (further as usize).clamp(1, left);
            discarded += steady.periods + settings.transient_periods;
            start = SteadyStart::State(Box::new(run.state.clone()));
            last_record = Some(SettledRun { run, strobe, motion, complete: false });
        }
    }
}

/// Whether a motion has settled: a quasi-periodic one if its changes are as large in both halves of the record, or as
/// large as in the record before.
fn confirmed(found: &Classification, before: Option<&Classification>) -> bool {
    let same = |before: &Classification| {
        let ratio = found.mean_square_change / before.mean_square_change;
        found.nearest_return == before.nearest_return && ratio.ln().abs() < SAME_AMPLITUDE
    };
    match found.motion {
        Motion::QuasiPeriodic => found.amplitude_trend.abs() < SURE_TREND || before.is_some_and(same),
        motion => motion.is_settled(),
    }
}

/// Further transient periods that the motion needs, with a tenth more, or as many as have been run where its decay
/// is not known.
fn further_periods(
    motion: &SteadyMotion,
    tolerance: f64,
    discarded: usize,
    steady: &SteadyRunSettings,
) -> f64 {
    match motion.motion.periods_to_settle(tolerance) {
        Some(needed) => (1.1 * needed).max(steady.periods as f64),
        None => (discarded + steady.periods) as f64,
    }
}
