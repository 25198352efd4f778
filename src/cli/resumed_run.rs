//! A resumed run: finished studies and the samples of a run-up restored from its checkpoint.

use std::path::Path;

use rotordyn::error::Error;
use rotordyn::io::hdf5::{
    COMPLETE, ChannelStream, RunFormat, channel_names, open_reader, read_channel, read_time, recorded_samples,
};
use rotordyn::io::results_file;

use super::checkpoint::{CheckpointWriter, Finished, Resumed};
use super::failure::Failure;
use super::limits::limits;
use super::studies::{Job, Study};

/// Samples copied at a time.
const BLOCK_SAMPLES: usize = 4096;

impl Job<'_> {
    /// Writes checkpoints, and goes on where one was taken.
    pub fn resume(&mut self, writer: CheckpointWriter, resumed: Option<Resumed>) {
        self.checkpoints = Some(writer);
        let Some(Resumed { finished, running }) = resumed else { return };
        self.running = running;
        if !finished.studies.is_empty() {
            (self.done, self.results) = (finished.studies, finished.results);
            (self.motion, self.warnings) = (finished.motion, finished.warnings);
            // A study that failed is run again.
            self.results.ball_inertia.retain(|(study, _)| self.done.contains(study));
        }
    }

    /// Takes the result of an earlier run for a study; whether there is one.
    pub fn restore(&mut self, study: Study) -> Result<bool, Failure> {
        let known = self.done.contains(study.name());
        if known && study == Study::RunUp {
            self.restore_run_up()?;
        }
        Ok(known)
    }

    /// Writes the samples of a finished run-up to the new file.
    fn restore_run_up(&mut self) -> Result<(), Failure> {
        let (Some(mut run), Some(checkpoints)) = (self.results.run_up.take(), &self.checkpoints) else {
            return Ok(());
        };
        let path = checkpoints.samples_path();
        run.history = results_file::read_history(&path, limits())?;
        let channels = results_file::channels_of(&run.history);
        let format = RunFormat { channels: &channels, sample_rate: run.history.sample_rate, start: 0.0 };
        let count = run.report.samples;
        let (writer, machine) = (&mut self.output.writer, &self.machine);
        let others = self.results.sections(&machine.assembly.dofs);
        let mut stream = writer.begin_run(&format, count, (&others, machine))?;
        replay(&path, count, &mut stream)?;
        let motion = &self.motion;
        writer.end_run(stream, COMPLETE, (&others, machine), |store| match motion {
            Some(motion) => results_file::write_motion(store, motion),
            None => Ok(()),
        })?;
        self.results.run_up = Some(run);
        Ok(())
    }

    /// Keeps the result of a study that has ended for the checkpoints.
    pub fn keep_finished(&mut self, study: Study) {
        self.done.insert(study.name().into());
        if !self.checkpoints.as_ref().is_some_and(CheckpointWriter::is_on) {
            return;
        }
        // The samples stay in their file.
        let history = self.results.run_up.as_mut().map(|run| std::mem::take(&mut run.history));
        let finished = Finished {
            studies: self.done.clone(),
            results: self.results.clone(),
            motion: self.motion.clone(),
            warnings: self.warnings.clone(),
        };
        if let (Some(run), Some(history)) = (&mut self.results.run_up, history) {
            run.history = history;
        }
        if let Some(checkpoints) = &mut self.checkpoints {
            checkpoints.study_ended(finished, self.running.as_ref(), self.terminal);
        }
    }
}

/// Copies the first samples of a run to another file.
pub fn replay(from: &Path, count: usize, to: &mut ChannelStream) -> Result<(), Error> {
    let store = open_reader(from, limits())?;
    let recorded = recorded_samples(&*store, "")?;
    if recorded < count {
        let problem = format!("it has {recorded} samples of the {count} before the checkpoint");
        let advice = "start afresh without --resume".into();
        return Err(Error::Content { path: from.into(), problem, advice });
    }
    let names = channel_names(&*store, "")?;
    for begin in (0..count).step_by(BLOCK_SAMPLES) {
        let range = begin..count.min(begin + BLOCK_SAMPLES);
        let [time, angle, speed] =
            ["t", "theta", "speed"].map(|name| read_time(&*store, "", name, range.clone()));
        let (time, angle, speed) = (time?, angle?, speed?);
        let channels = names
            .iter()
            .map(|name| read_channel(&*store, "", name, range.clone()))
            .collect::<Result<Vec<_>, Error>>()?;
        let mut row = vec![0.0; channels.len()];
        for k in 0..range.len() {
            row.iter_mut().zip(&channels).for_each(|(value, channel)| *value = channel[k]);
            to.push(time[k], angle[k], speed[k], &row)?;
        }
    }
    Ok(())
}
