//! The worker process, which runs a target on inputs from its standard input and answers each on its standard output.
//!
//! A crash, an abort or a failed allocation ends only the worker; the engine then knows the input by the answers it has.

use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::{Mutex, PoisonError};

use crate::feature::{self, EdgeCounts, Feature};
use crate::hdf5_reader::{self, PLACE_VARIABLE};
use crate::limits;
use crate::targets::Target;

/// Argument that makes a program a worker: `--worker TARGET FOLDER`.
pub const ARGUMENT: &str = "--worker";

/// Longest text of an answer \[characters\].
const MAX_TEXT: usize = 2000;

/// Answer of a worker to one input.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    pub reading: Reading,
    /// Processor time \[s\].
    pub seconds: f64,
    /// Features that this worker has not reported before.
    pub features: Vec<Feature>,
    /// Messages of the program, or the place and message of a panic.
    pub text: String,
}

/// What became of an input in a worker that lives on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    Accepted,
    Refused,
    Panicked,
}

/// Place and message of the panics since the last input, of any thread.
static PANICS: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// Runs as a worker until the input ends.
///
/// # Errors
/// The pipes cannot be used: the engine has ended.
pub fn serve(target: &Target, folder: &Path) -> io::Result<()> {
    limits::impose();
    set_hook(Box::new(|panic| {
        PANICS.lock().unwrap_or_else(PoisonError::into_inner).push(panic.to_string());
    }));
    let edges_file = std::env::var_os(feature::EDGES_VARIABLE).map(PathBuf::from);
    let mut edges = edges_file.and_then(|path| EdgeCounts::open(&path).ok().flatten());
    let here = folder.to_string_lossy();
    let allowed = match target.hdf5 && hdf5_reader::is_here() {
        true => limits::SECONDS_OF_FIRST_TRY,
        false => limits::SECONDS,
    };
    let mut from = BufReader::new(io::stdin().lock());
    let mut to = io::stdout().lock();
    while let Some(input) = read_block(&mut from)? {
        if let Some(edges) = &mut edges {
            edges.clear()?;
        }
        let start = limits::start(allowed);
        let outcome = catch_unwind(AssertUnwindSafe(|| (target.run)(&input, folder)));
        let seconds = limits::stop(start);
        let panics = std::mem::take(&mut *PANICS.lock().unwrap_or_else(PoisonError::into_inner));
        let mut features = Vec::new();
        if let Some(edges) = &mut edges {
            edges.new_features(&mut features)?;
        }
        let (reading, messages) = match outcome {
            // A panic of another thread that the program hides is one all the same.
            Ok(_) | Err(_) if !panics.is_empty() => (Reading::Panicked, panics),
            Ok(outcome) if outcome.accepted => (Reading::Accepted, outcome.messages),
            Ok(outcome) => (Reading::Refused, outcome.messages),
            Err(_) => (Reading::Panicked, vec!["a panic without a place".into()]),
        };
        // The folder has another name in every run.
        let messages: Vec<String> = messages.iter().map(|message| message.replace(&*here, "")).collect();
        features.extend(messages.iter().map(|message| feature::of_message(message)));
        features.sort_unstable();
        features.dedup();
        let text = messages.join("\n").chars().take(MAX_TEXT).collect();
        write_answer(&mut to, &Answer { reading, seconds, features, text })?;
    }
    Ok(())
}

/// A worker process, seen from the engine.
pub struct Worker {
    process: Child,
    to: Option<ChildStdin>,
    from: BufReader<ChildStdout>,
    /// What it writes to its standard error: the message of an abort.
    errors: PathBuf,
}

impl Worker {
    /// Starts this program as a worker with a folder for its files, in which `errors` and `edges` are its own.
    ///
    /// `hdf5`: where it reads HDF5 files, unless the environment of this program says it.
    ///
    /// # Errors
    /// The process or its files cannot be made.
    pub fn start(target: &Target, folder: &Path, hdf5: &str) -> io::Result<Self> {
        let (errors, edges) = (folder.join("errors"), folder.join("edges"));
        File::create(&edges)?;
        // Instrumented code writes a profile at its end, wanted or not.
        let unwanted = || folder.join("profile").into_os_string();
        let profile = std::env::var_os("LLVM_PROFILE_FILE").unwrap_or_else(unwanted);
        let mut process = Command::new(std::env::current_exe()?)
            .args([ARGUMENT, target.name])
            .arg(folder)
            .env(feature::EDGES_VARIABLE, &edges)
            // Two threads show races of readers as well as many, with less address space.
            .env("RAYON_NUM_THREADS", "2")
            .env("RUST_BACKTRACE", "0")
            .env(PLACE_VARIABLE, std::env::var_os(PLACE_VARIABLE).unwrap_or_else(|| hdf5.into()))
            .env("LLVM_PROFILE_FILE", profile)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(File::create(&errors)?)
            .spawn()?;
        let pipe = || io::Error::other("the worker has no pipes");
        let to = process.stdin.take().ok_or_else(pipe)?;
        let from = BufReader::new(process.stdout.take().ok_or_else(pipe)?);
        Ok(Worker { process, to: Some(to), from, errors })
    }

    /// Sends an input; the answer to the one before must have been received, or both sides could wait for the other.
    pub fn send(&mut self, input: &[u8]) {
        let Some(to) = &mut self.to else { return };
        // The length of an input is limited far below 4 GB by its target.
        let block = [&(input.len() as u32).to_le_bytes()[..], input].concat();
        // A broken pipe: the worker has died, which the missing answer shows.
        let _ = to.write_all(&block);
    }

    /// The answer to the input sent last; `None` if the worker died over it.
    pub fn receive(&mut self) -> Option<Answer> {
        read_answer(&mut self.from).ok()
    }

    /// Waits for the end of a worker: how it ended, and what it wrote to its standard error.
    ///
    /// # Errors
    /// The process cannot be waited for.
    pub fn end(mut self) -> io::Result<(ExitStatus, String)> {
        self.to = None;
        let status = self.process.wait()?;
        let errors = std::fs::read(&self.errors).unwrap_or_default();
        let errors = String::from_utf8_lossy(&errors).trim().chars().take(MAX_TEXT).collect();
        Ok((status, errors))
    }
}

fn read_block(from: &mut impl Read) -> io::Result<Option<Vec<u8>>> {
    let mut length = [0; 4];
    match from.read_exact(&mut length) {
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(None),
        other => other?,
    }
    let mut block = vec![0; u32::from_le_bytes(length) as usize];
    from.read_exact(&mut block)?;
    Ok(Some(block))
}

fn write_answer(to: &mut impl Write, answer: &Answer) -> io::Result<()> {
    let mut out = vec![match answer.reading {
        Reading::Accepted => 0,
        Reading::Refused => 1,
        Reading::Panicked => 2,
    }];
    out.extend(answer.seconds.to_le_bytes());
    out.extend((answer.features.len() as u32).to_le_bytes());
    answer.features.iter().for_each(|feature| out.extend(feature.to_le_bytes()));
    out.extend((answer.text.len() as u32).to_le_bytes());
    out.extend(answer.text.as_bytes());
    to.write_all(&out)?;
    to.flush()
}

fn read_answer(from: &mut impl Read) -> io::Result<Answer> {
    let mut reading = [0];
    from.read_exact(&mut reading)?;
    let mut seconds = [0; 8];
    from.read_exact(&mut seconds)?;
    let mut word = [0; 4];
    from.read_exact(&mut word)?;
    let mut features = Vec::new();
    for _ in 0..u32::from_le_bytes(word) {
        let mut feature = [0; 4];
        from.read_exact(&mut feature)?;
        features.push(Feature::from_le_bytes(feature));
    }
    let text = read_block(from)?.unwrap_or_default();
    let reading = match reading[0] {
        0 => Reading::Accepted,
        1 => Reading::Refused,
        _ => Reading::Panicked,
    };
    let text = String::from_utf8_lossy(&text).into_owned();
    Ok(Answer { reading, seconds: f64::from_le_bytes(seconds), features, text })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_pass_the_pipe_unchanged() {
        let answer = Answer {
            reading: Reading::Refused,
            seconds: 0.25,
            features: vec![3, 0x8000_0001],
            text: "line 3: \u{b5}m".into(),
        };
        let mut pipe = Vec::new();
        write_answer(&mut pipe, &answer).unwrap();
        assert_eq!(read_answer(&mut pipe.as_slice()).unwrap(), answer);
        assert!(read_answer(&mut &pipe[..pipe.len() - 1]).is_err());
    }
}
