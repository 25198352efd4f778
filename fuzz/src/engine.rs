//! The run of a target: seeds, changed inputs, what they did; novel ones become seeds.

use std::collections::BTreeSet;
use std::io;
use std::path::Path;
use std::time::Instant;

use crate::corpus;
use crate::feature::Feature;
use crate::finding::{Execution, Finding, Findings, Kind};
use crate::hdf5_reader::{APART, HERE};
use crate::limits;
use crate::mutator::Mutator;
use crate::targets::Target;
use crate::worker::{Reading, Worker};

/// Bytes of a new seed may not exceed this factor over the longest given one, so that the corpus does not creep up.
const MAX_GROWTH: usize = 2;

/// Sends inputs to a worker and replaces it when it dies.
pub struct Runner<'t> {
    target: &'t Target,
    folder: tempfile::TempDir,
    /// None after one died.
    worker: Option<Worker>,
    /// The input begun, of a target that reads HDF5 files.
    input: Vec<u8>,
}

impl<'t> Runner<'t> {
    /// Makes the folder of the workers.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn new(target: &'t Target) -> io::Result<Self> {
        // In memory where possible: every input of a file format is written to a file.
        let memory = Path::new("/dev/shm");
        let folder = match memory.is_dir() {
            true => tempfile::tempdir_in(memory).or_else(|_| tempfile::tempdir())?,
            false => tempfile::tempdir()?,
        };
        Ok(Runner { target, folder, worker: None, input: Vec::new() })
    }

    /// Begins with an input, whose result [`finish`](Self::finish) returns.
    ///
    /// # Errors
    /// A worker cannot be started.
    pub fn begin(&mut self, input: &[u8]) -> io::Result<()> {
        let mut worker = match self.worker.take() {
            Some(worker) => worker,
            None => Worker::start(self.target, self.folder.path(), HERE)?,
        };
        if self.target.hdf5 {
            self.input = input.to_vec();
        }
        worker.send(input);
        self.worker = Some(worker);
        Ok(())
    }

    /// The result of the input begun.
    ///
    /// HDF5 files are read in the worker, as a process for each takes many times as long as reading it; an input that does
    /// something wrong there is run once more with such processes, as the program has them, and that result counts. It has
    /// no features: as a seed such an input would have the changes of it hang or crash as well, and a run would spend its
    /// time in starting workers.
    ///
    /// # Errors
    /// No input was begun, or a dead worker cannot be asked for its reason.
    pub fn finish(&mut self) -> io::Result<Execution> {
        let found = self.answer()?;
        if !self.target.hdf5 || matches!(found, Execution::Sound(_)) {
            return Ok(found);
        }
        // Whatever the library left behind goes with the worker.
        self.end_worker();
        let mut worker = Worker::start(self.target, self.folder.path(), APART)?;
        worker.send(&self.input);
        self.worker = Some(worker);
        let mut found = self.answer()?;
        self.end_worker();
        if let Execution::Sound(answer) = &mut found {
            answer.features.clear();
        }
        Ok(found)
    }

    fn end_worker(&mut self) {
        if let Some(worker) = self.worker.take() {
            let _ = worker.end();
        }
    }

    /// What the worker did with the input sent.
    fn answer(&mut self) -> io::Result<Execution> {
        let wrong = |kind, text, seconds| Execution::Wrong(Finding { kind, text, seconds });
        let mut worker = self.worker.take().ok_or_else(|| io::Error::other("no input was begun"))?;
        let Some(answer) = worker.receive() else {
            let (status, last_words) = worker.end()?;
            let kind = match status.code() {
                Some(limits::TOO_LONG | limits::BLOCKED) => Kind::Slow,
                _ => Kind::Abort,
            };
            return Ok(wrong(kind, format!("{last_words}\n{status}"), None));
        };
        self.worker = Some(worker);
        Ok(match answer.reading {
            Reading::Panicked => wrong(Kind::Panic, answer.text, Some(answer.seconds)),
            _ if answer.seconds > limits::SECONDS => {
                let text = format!("{:.1} s of processor time\n{}", answer.seconds, answer.text);
                wrong(Kind::Slow, text, Some(answer.seconds))
            }
            Reading::Accepted | Reading::Refused => Execution::Sound(answer),
        })
    }

    /// Runs one input.
    ///
    /// # Errors
    /// As [`begin`](Self::begin) and [`finish`](Self::finish).
    pub fn run(&mut self, input: &[u8]) -> io::Result<Execution> {
        self.begin(input)?;
        self.finish()
    }
}

impl Drop for Runner<'_> {
    /// Waits for the worker, which may write a profile of coverage at its end.
    fn drop(&mut self) {
        self.end_worker();
    }
}

/// What a run of a target found and did.
pub struct Report {
    pub inputs: u64,
    pub accepted: u64,
    pub features: usize,
    /// Given seeds and novel inputs.
    pub corpus: Vec<Vec<u8>>,
    pub given_seeds: usize,
    pub findings: Findings,
    /// Longest processor time of an input without a finding \[s\].
    pub slowest: f64,
    /// Elapsed time \[s\].
    pub seconds: f64,
}

/// Runs all seeds, then `inputs` changed inputs; calls `progress(number of inputs, findings, corpus size)` every 10,000.
///
/// # Errors
/// A worker cannot be started.
pub fn fuzz(
    target: &Target,
    inputs: u64,
    seed: u64,
    progress: &mut dyn FnMut(u64, &Findings, usize),
) -> io::Result<Report> {
    let start = Instant::now();
    let seeds = corpus::seeds(target);
    let longest = seeds.iter().map(Vec::len).max().unwrap_or(0).saturating_mul(MAX_GROWTH);
    let mut known: BTreeSet<Feature> = BTreeSet::new();
    let mut report = Report {
        inputs: 0,
        accepted: 0,
        features: 0,
        given_seeds: seeds.len(),
        corpus: seeds,
        findings: Findings::default(),
        slowest: 0.0,
        seconds: 0.0,
    };
    let mut runner = Runner::new(target)?;
    for k in 0..report.corpus.len() {
        let execution = runner.run(&report.corpus[k])?;
        if let Execution::Sound(answer) = &execution {
            known.extend(&answer.features);
        }
        report.note(execution, |finding, findings, corpus| findings.add(finding, &corpus[k]));
    }
    let mut mutator = Mutator::new(seed, (target.dictionary)(), target.text, target.max_length);
    let mut next = mutator.next(&report.corpus);
    for _ in 0..inputs {
        let input = next;
        runner.begin(&input)?;
        // Made while the worker is busy: it does not depend on the answer to this input.
        next = mutator.next(&report.corpus);
        let execution = runner.finish()?;
        if let Execution::Sound(answer) = &execution {
            let before = known.len();
            known.extend(&answer.features);
            if known.len() > before && input.len() <= longest {
                report.corpus.push(input.clone());
            }
        }
        report.note(execution, |finding, findings, _| findings.add(finding, &input));
        if report.inputs.is_multiple_of(10_000) {
            progress(report.inputs, &report.findings, report.corpus.len());
        }
    }
    report.features = known.len();
    report.seconds = start.elapsed().as_secs_f64();
    Ok(report)
}

impl Report {
    fn note(&mut self, execution: Execution, add: impl FnOnce(Finding, &mut Findings, &[Vec<u8>]) -> bool) {
        self.inputs += 1;
        match execution {
            Execution::Sound(answer) => {
                self.accepted += u64::from(answer.reading == Reading::Accepted);
                self.slowest = self.slowest.max(answer.seconds);
            }
            Execution::Wrong(finding) => {
                add(finding, &mut self.findings, &self.corpus);
            }
        }
    }
}

/// A shorter input with the same finding: blocks, then single bytes are left out as long as its cause stays.
///
/// # Errors
/// A worker cannot be started; the input has no finding.
pub fn minimise(target: &Target, input: &[u8]) -> io::Result<Vec<u8>> {
    let mut runner = Runner::new(target)?;
    let mut cause = |input: &[u8]| -> io::Result<Option<String>> {
        Ok(match runner.run(input)? {
            Execution::Sound(_) => None,
            Execution::Wrong(finding) => Some(finding.cause()),
        })
    };
    let Some(wanted) = cause(input)? else {
        return Err(io::Error::other("the input does nothing wrong"));
    };
    let mut best = input.to_vec();
    let mut size = best.len().next_power_of_two() / 2;
    while size > 0 {
        let mut at = 0;
        while at < best.len() {
            let mut shorter = best.clone();
            shorter.drain(at..(at + size).min(best.len()));
            match cause(&shorter)? {
                Some(found) if found == wanted => best = shorter,
                _ => at += size,
            }
        }
        size /= 2;
    }
    Ok(best)
}
