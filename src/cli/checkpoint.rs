//! Checkpoints of a run that is under way, in its results folder: written at an interval, read by `--resume`.
//!
//! `checkpoint.bin` holds the identity of the run, the results of finished studies and the snapshot of the running one;
//! it is replaced as a whole. The samples of a run-up stay in the file they are recorded to, which has
//! `checkpoint_samples.h5` as a second name (hard link), so that they outlive what happens to the first.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use rotordyn::error::Error;
use rotordyn::io::checkpoint_file;
use rotordyn::io::results_file::UNFINISHED_PREVIOUS;
use rotordyn::results::Motion;
use rotordyn::study::{
    Checkpoints, FinishedValues, MotionSnapshot, RecorderSnapshot, Results, SettledSnapshot,
};
use rotordyn::transient::run::RunSnapshot;
use rotordyn::transient::steady::SteadySnapshot;
use rotordyn::warning::Warning;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::args::{CheckpointArgs, Interval};
use super::failure::Failure;
use super::run_identity::RunIdentity;
use super::terminal::Terminal;

/// Name of the checkpoint, and second name of the file with the samples of its run-up.
const FILE: &str = "checkpoint.bin";
const SAMPLES: &str = "checkpoint_samples.h5";
/// Interval of the checkpoints by default; longer where they would take more than one part of this many of the time.
const DEFAULT_INTERVAL: Duration = Duration::from_secs(30);
const LONGEST_SHARE: u32 = 100;

/// Studies that have ended, with what later ones and the files need of them.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Finished {
    pub studies: BTreeSet<String>,
    /// Without the samples of the run-up.
    pub results: Results,
    /// Frames of the run-up.
    pub motion: Option<Motion>,
    pub warnings: Vec<Warning>,
}

/// The study under way.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Running {
    RunUp(Box<RunUpSnapshot>),
    Poincare(Box<SettledSnapshot>),
    Lyapunov(Box<SteadySnapshot>),
    Bifurcation(FinishedValues),
}

/// A run-up at a sample, beside its samples.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RunUpSnapshot {
    pub run: RunSnapshot,
    /// States for the error of the step.
    pub states: Checkpoints,
    pub motion: Option<MotionSnapshot>,
    pub recorder: RecorderSnapshot,
}

impl Running {
    /// Study and place, in words.
    pub fn place(&self) -> String {
        match self {
            Self::RunUp(found) => format!("run-up at t = {:.4} s", found.run.time()),
            Self::Poincare(found) => format!("poincare at t = {:.4} s", found.time()),
            Self::Lyapunov(found) => format!("lyapunov at t = {:.4} s", found.time()),
            Self::Bifurcation(found) => format!("bifurcation after {} runs", found.len()),
        }
    }
}

/// Where a resumed run goes on.
#[derive(Clone, Debug, Default)]
pub struct Resumed {
    pub finished: Finished,
    pub running: Option<Running>,
}

impl Resumed {
    /// Words of the place from which it goes on.
    fn place(&self) -> String {
        match (&self.running, self.finished.studies.is_empty()) {
            (Some(running), _) => running.place(),
            (None, false) => {
                let names: Vec<&str> = self.finished.studies.iter().map(String::as_str).collect();
                format!("the end of {}", names.join(", "))
            }
            (None, true) => "the start".into(),
        }
    }
}

/// The checkpoints of one run.
pub struct CheckpointWriter {
    folder: PathBuf,
    identity: Vec<u8>,
    finished: Finished,
    /// The same as it is written, once it was.
    encoded: Option<Vec<u8>>,
    /// Whether a study has ended since the last checkpoint.
    unwritten: bool,
    interval: Interval,
    last: Instant,
    /// Time that the last one and all together took.
    cost: Duration,
    spent: Duration,
    written: usize,
    /// From where the run went on.
    resumed: Option<String>,
}

impl CheckpointWriter {
    /// The writer of a run, and where it goes on if that is asked for and possible.
    ///
    /// # Errors
    /// A checkpoint of another run, or one that cannot be read.
    pub fn open(
        folder: &Path,
        args: &CheckpointArgs,
        identity: &RunIdentity,
        terminal: &Terminal,
    ) -> Result<(Self, Option<Resumed>), Failure> {
        let path = folder.join(FILE);
        let resumed = if args.resume { read(&path, identity)? } else { None };
        match &resumed {
            Some(found) => terminal.note(&format!("goes on from {}", found.place())),
            None if args.resume => {
                terminal.note(&format!("nothing to resume in {}: starts afresh", folder.display()));
            }
            None if path.exists() => terminal.note(&format!(
                "starts afresh; {} of a run that did not end is removed (--resume would have gone on from there)",
                path.display()
            )),
            None => {}
        }
        let writer = Self {
            folder: folder.into(),
            identity: checkpoint_file::encode(identity)?,
            finished: resumed.as_ref().map_or_else(Finished::default, |found| found.finished.clone()),
            interval: args.checkpoint.unwrap_or(Interval::Default),
            encoded: None,
            unwritten: false,
            last: Instant::now(),
            cost: Duration::ZERO,
            spent: Duration::ZERO,
            written: 0,
            resumed: resumed.as_ref().map(Resumed::place),
        };
        if resumed.is_none() {
            // One of another run must not outlive the start of this one.
            writer.remove();
        }
        Ok((writer, resumed))
    }

    /// Whether it is time for the next one.
    pub fn is_due(&self) -> bool {
        match self.interval {
            Interval::Off => false,
            Interval::Given(interval) => self.last.elapsed() >= interval,
            Interval::Default => self.last.elapsed() >= DEFAULT_INTERVAL.max(self.cost * LONGEST_SHARE),
        }
    }

    pub fn is_on(&self) -> bool {
        self.interval != Interval::Off
    }

    /// Takes over the results with another finished study; `ahead`: one that a resumed run has not come to yet.
    pub fn study_ended(&mut self, finished: Finished, ahead: Option<&Running>, terminal: &Terminal) {
        (self.finished, self.encoded, self.unwritten) = (finished, None, true);
        if self.is_due() {
            self.write(ahead, terminal);
        }
    }

    /// Writes the studies that have ended since the last checkpoint, if there are any; none is running.
    pub fn stop(&mut self, ahead: Option<&Running>, terminal: &Terminal) {
        if self.unwritten {
            self.write(ahead, terminal);
        }
    }

    /// Whether a checkpoint is to be written at an instant of a study: if it is time, or if the study `stops` there.
    pub fn is_wanted(&self, stops: bool) -> bool {
        self.is_on() && (stops || self.is_due())
    }

    /// Writes a checkpoint; the samples of a run-up are on the disk.
    ///
    /// One that cannot be written ends the checkpoints, not the run.
    pub fn write(&mut self, running: Option<&Running>, terminal: &Terminal) {
        if !self.is_on() {
            return;
        }
        let start = Instant::now();
        if let Err(error) = self.save(running) {
            terminal.note(&format!("no further checkpoints: {error}"));
            self.interval = Interval::Off;
        }
        self.unwritten = false;
        self.cost = start.elapsed();
        self.spent += self.cost;
        self.written += 1;
        self.last = Instant::now();
    }

    fn save(&mut self, running: Option<&Running>) -> Result<(), Error> {
        let finished = match self.encoded.take() {
            Some(encoded) => encoded,
            None => checkpoint_file::encode(&self.finished)?,
        };
        let running = checkpoint_file::encode(&running)?;
        let path = self.folder.join(FILE);
        let saved = checkpoint_file::save(&path, &[&self.identity, &finished, &running]);
        self.encoded = Some(finished);
        saved
    }

    /// Gives the file with the samples of a run-up its second name; they are on the disk.
    ///
    /// Before a checkpoint that needs them: the former file has the samples of the former checkpoint.
    pub fn keep_samples(&mut self, file: &Path, terminal: &Terminal) {
        if !self.is_on() {
            return;
        }
        let kept = self.samples_path();
        let new = self.folder.join(format!(".{SAMPLES}.{}", std::process::id()));
        let _ = std::fs::remove_file(&new);
        let linked = std::fs::hard_link(file, &new).and_then(|()| std::fs::rename(&new, &kept));
        if let Err(error) = linked {
            terminal.note(&format!("no checkpoints of the run-up: link {}: {error}", kept.display()));
            self.interval = Interval::Off;
        }
        // Renaming one name of a file to another of the same file does nothing.
        let _ = std::fs::remove_file(&new);
    }

    /// File with the samples of the run-up of the checkpoint.
    pub fn samples_path(&self) -> PathBuf {
        self.folder.join(SAMPLES)
    }

    /// Tells how a run that was stopped goes on.
    pub fn say_how_to_go_on(&self, terminal: &Terminal) {
        if self.is_on() && self.folder.join(FILE).exists() {
            terminal.note("the same command with --resume goes on from here");
        }
    }

    /// Removes the checkpoint of a run that has ended.
    pub fn remove(&self) {
        // The checkpoint first: without its samples it could not be resumed.
        let names = [FILE, SAMPLES].into_iter();
        // What the resumed run left is part of this one.
        for name in names.chain(self.resumed.is_some().then_some(UNFINISHED_PREVIOUS)) {
            let _ = std::fs::remove_file(self.folder.join(name));
        }
    }

    /// For the JSON document: from where the run went on, the number of checkpoints and their time.
    pub fn to_json(&self) -> Value {
        json!({
            "resumed_from": self.resumed,
            "written": self.written,
            "seconds": self.spent.as_secs_f64(),
        })
    }
}

/// Reads the checkpoint of a run; `None` without one.
fn read(path: &Path, now: &RunIdentity) -> Result<Option<Resumed>, Failure> {
    let Some(blocks) = checkpoint_file::load(path)? else { return Ok(None) };
    let [identity, finished, running] = &blocks[..] else {
        return Err(other(path, &[format!("it has {} parts instead of 3", blocks.len())]));
    };
    let before: RunIdentity = checkpoint_file::decode(path, identity)?;
    let differences = before.differences(now);
    if !differences.is_empty() {
        return Err(other(path, &differences));
    }
    Ok(Some(Resumed {
        finished: checkpoint_file::decode(path, finished)?,
        running: checkpoint_file::decode(path, running)?,
    }))
}

fn other(path: &Path, differences: &[String]) -> Failure {
    Failure::Library(Error::Content {
        path: path.into(),
        problem: format!("it belongs to another run:\n  {}\n", differences.join("\n  ")),
        advice: "resume with what the run was started with, or start afresh without --resume".into(),
    })
}
