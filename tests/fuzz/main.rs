//! Inputs that once crashed a reader, and the seeds of the fuzzer, in worker processes with its limits.
//!
//! Each regression file is a test of its own: `cargo test --test fuzz uff/`.

use std::path::Path;
use std::process::ExitCode;

use fuzz::corpus;
use fuzz::engine::{self, Runner};
use fuzz::finding::{Execution, Kind};
use fuzz::folders;
use fuzz::hdf5_reader;
use fuzz::targets::{self, Target};
use fuzz::worker::{self, Reading};
use libtest_mimic::{Arguments, Failed, Trial};

fn main() -> ExitCode {
    if let Some(code) = hdf5_reader::run(std::env::args_os()) {
        return code;
    }
    let given: Vec<String> = std::env::args().collect();
    if let [_, argument, name, folder] = given.as_slice()
        && argument == worker::ARGUMENT
    {
        let target = targets::find(name).expect("a target of this program");
        worker::serve(target, Path::new(folder)).expect("the pipes of the test");
        return ExitCode::SUCCESS;
    }
    let mut tests = Vec::new();
    for target in &targets::ALL {
        for (path, bytes) in folders::files(&corpus::regressions(target), "*") {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            tests.push(Trial::test(format!("{}/{name}", target.name), move || is_sound(target, &bytes)));
        }
        tests.push(Trial::test(format!("{}/seeds", target.name), move || seeds_are_sound(target)));
        tests.push(Trial::test(format!("{}/changed", target.name), move || changed_inputs_are_sound(target)));
    }
    tests.push(Trial::test("wrong_behaviour_is_detected", wrong_behaviour_is_detected));
    tests.push(Trial::test("an_input_is_shortened_to_its_cause", an_input_is_shortened_to_its_cause));
    tests.push(Trial::test("the_same_seed_gives_the_same_run", the_same_seed_gives_the_same_run));
    libtest_mimic::run(&Arguments::from_args(), tests).exit_code()
}

fn is_sound(target: &Target, bytes: &[u8]) -> Result<(), Failed> {
    match Runner::new(target)?.run(bytes)? {
        Execution::Sound(_) => Ok(()),
        Execution::Wrong(finding) => Err(format!("{}: {}", finding.kind.name(), finding.text).into()),
    }
}

/// Every seed is read without a crash, and most are valid: a corpus of refused files would test little.
fn seeds_are_sound(target: &Target) -> Result<(), Failed> {
    let seeds = corpus::seeds(target);
    let mut runner = Runner::new(target)?;
    let mut accepted = 0;
    for seed in &seeds {
        match runner.run(seed)? {
            Execution::Sound(answer) => accepted += usize::from(answer.reading == Reading::Accepted),
            Execution::Wrong(finding) => return Err(finding.text.into()),
        }
    }
    let given = folders::files(&folders::top().join("fuzz/corpus").join(target.name), "*").len();
    if 2 * accepted < seeds.len().min(given.max(1)) {
        return Err(format!("{accepted} of {} seeds accepted", seeds.len()).into());
    }
    Ok(())
}

/// A hundred changed inputs, always the same: a short run of what a person runs for a night.
fn changed_inputs_are_sound(target: &Target) -> Result<(), Failed> {
    let report = engine::fuzz(target, 100, 1, &mut |_, _, _| {})?;
    if report.findings.is_empty() { Ok(()) } else { Err(format!("{:?}", report.findings).into()) }
}

/// A worker that panics, aborts, overflows its stack, takes too much memory or time is noticed, and the next input is
/// run all the same.
fn wrong_behaviour_is_detected() -> Result<(), Failed> {
    let mut runner = Runner::new(&targets::DETECTOR)?;
    for (word, kind, text) in [
        ("panic", Kind::Panic, "asked to panic"),
        ("thread", Kind::Panic, "asked to panic in a thread"),
        ("overflow", Kind::Panic, "attempt to add with overflow"),
        ("abort", Kind::Abort, "signal"),
        ("stack", Kind::Abort, "overflow"),
        ("memory", Kind::Abort, "memory allocation"),
        ("loop", Kind::Slow, "processor time"),
    ] {
        match runner.run(word.as_bytes())? {
            Execution::Wrong(found) if found.kind == kind && found.text.contains(text) => {}
            other => return Err(format!("{word}: {other:?}").into()),
        }
        match runner.run(b"nothing")? {
            Execution::Sound(answer) if answer.reading == Reading::Accepted => {}
            other => return Err(format!("after {word}: {other:?}").into()),
        }
    }
    Ok(())
}

fn an_input_is_shortened_to_its_cause() -> Result<(), Failed> {
    let short = engine::minimise(&targets::DETECTOR, b"words before, panic and words behind")?;
    if short == b"panic" { Ok(()) } else { Err(format!("{:?}", String::from_utf8_lossy(&short)).into()) }
}

fn the_same_seed_gives_the_same_run() -> Result<(), Failed> {
    let run = |seed| engine::fuzz(&targets::ALL[2], 300, seed, &mut |_, _, _| {});
    let (first, again, other) = (run(7)?, run(7)?, run(8)?);
    if first.corpus != again.corpus || first.accepted != again.accepted {
        return Err("two runs with one seed differ".into());
    }
    if first.corpus == other.corpus {
        return Err("another seed changes nothing".into());
    }
    Ok(())
}
