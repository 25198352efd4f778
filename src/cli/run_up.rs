//! The run-up of a job: samples streamed to the results file, checkpoints, and what follows the run.

use std::ops::ControlFlow;
use std::time::Instant;

use rotordyn::error::Error;
use rotordyn::io::budget::Limits;
use rotordyn::io::hdf5::{COMPLETE, ChannelStream, RunFormat};
use rotordyn::io::results_file;
use rotordyn::model::Drive;
use rotordyn::model::study::RunUpStudy;
use rotordyn::results::{CagePhaseBand, History, RollingCageComparison, RunSummary, RunUpResult};
use rotordyn::study::{
    Checkpoints, MotionRecorder, RecordedSample, Recorder, StudyError, run_for_step_error,
};
use rotordyn::transient::run::{End, Sample};
use rotordyn::warning::{Code, Warning};

use super::checkpoint::{RunUpSnapshot, Running};
use super::failure::Failure;
use super::studies::{Job, Study};
use super::terminal::rpm;
use super::{cage_tables, interrupt, resumed_run, run_up_tables, tables};

/// Samples of a run-up from one look at the clock to the next.
const SAMPLES_TO_CHECK: usize = 8;

impl Job<'_> {
    /// Transient run-up, streamed to the file sample by sample.
    pub fn run_up(&mut self) -> Result<(), Failure> {
        let machine = &self.machine;
        let Some(settings) = &machine.model.studies.run_up else { return Ok(()) };
        let profile = &machine.model.profile;
        let reduction = machine.reduce(settings)?;
        let frequency_error = machine.reduction_error(&reduction, settings.cutoff, profile.top_speed())?;
        let recorder = Recorder::new(&machine.model, &reduction.system, settings.sample_rate);
        // The samples are in the file only.
        let mut recorder = recorder.without_samples();
        let channels = results_file::channels_of(&recorder.history);
        let mut motion = settings
            .motion
            .map(|motion| MotionRecorder::new(machine, &reduction, motion, settings.sample_rate));
        let format = RunFormat { channels: &channels, sample_rate: settings.sample_rate, start: 0.0 };
        let finished = self.results.sections(&machine.assembly.dofs);
        // Both ends are sampled.
        let samples = (profile.duration() * settings.sample_rate).round() as usize + 2;
        let mut stream = self
            .output
            .writer
            .begin_run(&format, samples, (&finished, machine))
            .map_err(|error| Failure::from(error).with_consequence("the run-up is not computed"))?;
        let mut checkpoints = Checkpoints::new(settings, profile.duration());
        let mut last = (0.0, 0.0);
        let resumed = match self.running.take_if(|running| matches!(running, Running::RunUp(_))) {
            Some(Running::RunUp(found)) => Some(*found),
            _ => None,
        };
        let snapshot = match (resumed, &self.checkpoints) {
            (Some(found), Some(writer)) => {
                let (path, count) = (writer.samples_path(), found.run.index() + 1 - found.recorder.waiting());
                resumed_run::replay(&path, count, &mut stream)?;
                checkpoints = found.states;
                motion.iter_mut().zip(found.motion).try_for_each(|(own, kept)| own.resume(kept))?;
                recorder.resume(found.recorder);
                last = (found.run.time(), rpm(found.run.speed()));
                Some(found.run)
            }
            _ => None,
        };
        let bar = self.terminal.time_bar(profile.duration());
        let mut disk: Result<(), Error> = Ok(());
        // What follows the run takes long enough to go on from its end.
        let long_end = settings.cage_phases > 1 || reduction.system.has_bodies();
        let mut kept = false;
        let observe = |sample: &Sample| {
            let (time, spin) = (sample.state.time, &sample.state.spin);
            last = (time, rpm(spin.speed));
            checkpoints.observe(sample);
            if let Some(motion) = &mut motion {
                motion.observe(sample);
            }
            disk = write(&mut stream, recorder.record(sample));
            if sample.index.is_multiple_of(64) {
                bar.set_position((1e3 * time) as u64);
                bar.set_message(format!("{:.0} rpm", last.1));
            }
            let stopped = interrupt::requested();
            let at_end = stopped || long_end && sample.is_last();
            if disk.is_ok()
                && (at_end || sample.index.is_multiple_of(SAMPLES_TO_CHECK))
                && let Some(writer) = self.checkpoints.as_mut().filter(|writer| writer.is_wanted(at_end))
            {
                // The samples come to the disk before the checkpoint that needs them.
                disk = stream.sync();
                if disk.is_ok() && !kept {
                    writer.keep_samples(&self.output.writer.unfinished(), self.terminal);
                    kept = true;
                }
                if disk.is_ok() {
                    let (run, states) = (sample.snapshot(), checkpoints.clone());
                    let motion = motion.as_ref().map(MotionRecorder::snapshot);
                    let running = Running::RunUp(Box::new(RunUpSnapshot {
                        run,
                        states,
                        motion,
                        recorder: recorder.snapshot(),
                    }));
                    writer.write(Some(&running), self.terminal);
                }
            }
            if disk.is_err() || stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let report = match snapshot {
            None => machine.run_up(settings, &reduction, observe),
            Some(snapshot) => machine.resume_run_up(settings, &reduction, snapshot, observe),
        };
        bar.finish_and_clear();
        let disk = disk.and_then(|()| write(&mut stream, recorder.finish()));
        let failure = match (disk, &report.end) {
            (Err(error), _) => Some(error.into()),
            (Ok(()), End::Complete) => None,
            (Ok(()), End::Stopped) => Some(Failure::Interrupted),
            (Ok(()), End::Failed(error)) => Some(Failure::Library(error.clone().into())),
        };
        let state = match &failure {
            None => COMPLETE.to_string(),
            Some(why) => format!("stopped: {} at t = {:.4} s, {:.1} rpm", why.message(), last.0, last.1),
        };
        let motion = motion.filter(|recorder| !recorder.motion.time.is_empty());
        // Later checkpoints refer to the samples too.
        if failure.is_none()
            && !kept
            && let Some(writer) = self.checkpoints.as_mut().filter(|writer| writer.is_on())
        {
            stream.sync()?;
            writer.keep_samples(&self.output.writer.unfinished(), self.terminal);
        }
        let ended = self.output.writer.end_run(stream, &state, (&finished, machine), |store| match &motion {
            Some(recorder) => results_file::write_motion(store, &recorder.motion),
            None => Ok(()),
        });
        // What ended the run is reported, and that its samples could not be copied only if nothing else did.
        let failure = failure.or(ended.err().map(|error| {
            Failure::from(error).with_consequence("the samples so far are kept as they were recorded")
        }));
        self.motion = motion.map(|recorder| recorder.motion);
        // What follows reads the samples from the file, one channel after another.
        let samples = self.output.writer.unfinished();
        let history = match results_file::read_history(&samples, &Limits::default()) {
            Ok(history) => history,
            // What ended the run may have taken the file, too.
            Err(error) => return Err(failure.unwrap_or_else(|| error.into())),
        };
        let summary = RunSummary::of(&history)?;
        let spinner = self.terminal.spinner("step error");
        let orders = machine.checked_orders();
        let start = Instant::now();
        let step_error =
            machine.step_error(settings, &reduction, &orders, (&checkpoints, &history, &report))?;
        let check_seconds = start.elapsed().as_secs_f64();
        spinner.finish_and_clear();
        let cage_comparison =
            if failure.is_none() { self.cage_comparison(settings, &history) } else { Ok(None) };
        // A kinematic run that fails does not take the run with free balls with it.
        let cage_comparison = cage_comparison.unwrap_or_else(|error| {
            let text = format!("no comparison with kinematic cages: {error}");
            self.warnings.push(Warning::new(Code::FreeBalls, "study.run_up", text));
            None
        });
        let found = RunUpResult {
            modes: reduction.modes,
            corrections: reduction.corrections,
            static_error: reduction.static_error,
            frequency_error,
            history,
            summary,
            report,
            requested_step: settings.step,
            cage_angles: machine.cage_angles(),
            step_error,
            cage_comparison,
            peak_loads: recorder.peak_loads(),
        };
        let needed = run_for_step_error(settings.sample_rate, &orders, settings.integrator);
        tables::run_up(self.terminal, &found, check_seconds, needed);
        if let Some(comparison) = &found.cage_comparison {
            cage_tables::comparison(self.terminal, comparison);
        }
        let failure = match (failure, &machine.model.drive) {
            (None, Drive::Torque { .. }) => {
                let reached = found.summary.speed_range.as_slice().as_flattened();
                machine.check_tables(Study::RunUp.name(), reached).err().map(Failure::from)
            }
            (failure, _) => failure,
        };
        let phases = match failure {
            None if settings.cage_phases > 1 => self.cage_phases(settings, &found),
            _ => Ok(None),
        };
        if matches!(machine.model.drive, Drive::Torque { .. }) {
            self.note_reached_speed(found.summary.speed_range.as_slice().as_flattened());
        }
        self.results.run_up = Some(found);
        self.results.cage_phases = phases?;
        match failure {
            // A comparison of cages may have been left out.
            None if interrupt::requested() => Err(Failure::Interrupted),
            failure => failure.map_or(Ok(()), Err),
        }
    }

    /// Run-up with kinematic cages beside one with free balls.
    fn cage_comparison(
        &self,
        settings: &RunUpStudy,
        history: &History,
    ) -> Result<Option<RollingCageComparison>, StudyError> {
        let spinner = self.terminal.spinner("kinematic cages");
        let found = self.machine.compare_cages(settings, history, &mut || {
            if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        spinner.finish_and_clear();
        found
    }

    /// Range of the order cuts over the initial cage phases.
    fn cage_phases(
        &self,
        settings: &RunUpStudy,
        found: &RunUpResult,
    ) -> Result<Option<CagePhaseBand>, Failure> {
        let Some(orders) = &self.machine.model.studies.orders else { return Ok(None) };
        let spinner = self.terminal.spinner("cage phases");
        let base = self.machine.orders(orders, &found.history)?;
        let progress =
            || if interrupt::requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let band = self.machine.cage_phase_band(settings, orders, &base, &progress)?;
        spinner.finish_and_clear();
        let band = band.ok_or(Failure::Interrupted)?;
        run_up_tables::cage_phases(self.terminal, &band);
        Ok(Some(band))
    }
}

/// Writes complete samples to the file.
fn write(stream: &mut ChannelStream, samples: &[RecordedSample]) -> Result<(), Error> {
    samples.iter().try_for_each(|sample| stream.push(sample.time, sample.angle, sample.speed, &sample.values))
}
