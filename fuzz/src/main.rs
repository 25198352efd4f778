//! The command `fuzz`: runs targets on changed input, replays inputs, shortens them.

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use fuzz::engine::{self, Report, Runner};
use fuzz::finding::{Execution, Kind};
use fuzz::targets::{self, Target};
use fuzz::{folders, hdf5_reader, worker};

/// Runs the readers of rotordyn on changed input, and keeps what makes them panic, abort or take too long.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Targets, or `all`
    #[arg(value_name = "TARGET", required_unless_present = "worker")]
    targets: Vec<String>,
    /// Number of changed inputs per target
    #[arg(long, default_value_t = 10_000)]
    inputs: u64,
    /// Seed of the changes: the same seed gives the same inputs
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Folder for findings, by target
    #[arg(long, value_name = "DIR", default_value = "target/fuzz")]
    out: PathBuf,
    /// Folder that keeps the inputs which did something new, by target
    #[arg(long, value_name = "DIR")]
    keep: Option<PathBuf>,
    /// Run these files, or all files of a folder, instead, and print what the target says
    #[arg(long, value_name = "PATH", conflicts_with = "inputs")]
    replay: Vec<PathBuf>,
    /// Shorten this input as long as it does the same wrong thing; written beside it with the extension `short`
    #[arg(long, value_name = "FILE", conflicts_with_all = ["inputs", "replay"])]
    shorten: Option<PathBuf>,
    /// Serve as the worker process of a target with a folder
    #[arg(long, hide = true, num_args = 2, value_names = ["TARGET", "DIR"])]
    worker: Option<Vec<String>>,
}

fn main() -> ExitCode {
    if let Some(code) = hdf5_reader::run(std::env::args_os()) {
        return code;
    }
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(4)
        }
    }
}

/// Whether nothing wrong was found.
fn run(arguments: &Arguments) -> io::Result<bool> {
    if let Some([name, folder]) = arguments.worker.as_deref() {
        worker::serve(target(name)?, Path::new(folder))?;
        return Ok(true);
    }
    let mut chosen = Vec::new();
    for name in &arguments.targets {
        match name.as_str() {
            "all" => chosen.extend(&targets::ALL),
            name => chosen.push(target(name)?),
        }
    }
    let mut sound = true;
    for target in chosen {
        sound &= match (&arguments.shorten, arguments.replay.as_slice()) {
            (Some(path), _) => shorten(target, path)?,
            (None, []) => fuzz(target, arguments)?,
            (None, paths) => replay(target, paths)?,
        };
    }
    Ok(sound)
}

fn target(name: &str) -> io::Result<&'static Target> {
    let names = || targets::ALL.map(|target| target.name).join(", ");
    targets::find(name).ok_or_else(|| io::Error::other(format!("no target `{name}`; there are {}", names())))
}

fn fuzz(target: &Target, arguments: &Arguments) -> io::Result<bool> {
    let folder = arguments.out.join(target.name);
    let mut progress = |inputs, findings: &fuzz::finding::Findings, corpus| {
        let wrong = [Kind::Panic, Kind::Abort, Kind::Slow].map(|kind| findings.count(kind));
        // A long run may be ended from outside; at its end an error of writing is reported.
        let _ = findings.write(&folder);
        eprintln!("{}: {inputs} inputs, {corpus} in the corpus, {wrong:?} panics, aborts, slow", target.name);
    };
    let report = engine::fuzz(target, arguments.inputs, arguments.seed, &mut progress)?;
    print(target, &report);
    if let Some(kept) = &arguments.keep {
        let kept = kept.join(target.name);
        std::fs::create_dir_all(&kept)?;
        for input in &report.corpus[report.given_seeds..] {
            std::fs::write(kept.join(format!("{:08x}", crc32fast::hash(input))), input)?;
        }
    }
    for path in report.findings.write(&folder)? {
        println!("  {}", path.display());
        let text = std::fs::read_to_string(path.with_extension("txt"))?;
        text.lines().take(4).for_each(|line| println!("    {line}"));
    }
    Ok(report.findings.is_empty())
}

fn print(target: &Target, report: &Report) {
    let [panics, aborts, slow] =
        [Kind::Panic, Kind::Abort, Kind::Slow].map(|kind| report.findings.count(kind));
    println!(
        "{:8} {} inputs in {:.0} s ({:.0} a second), {:.1} % accepted, {} seeds + {} novel inputs, {} features; \
         slowest {:.3} s; {panics} panics, {aborts} aborts, {slow} slow",
        target.name,
        report.inputs,
        report.seconds,
        report.inputs as f64 / report.seconds,
        1e2 * report.accepted as f64 / report.inputs.max(1) as f64,
        report.given_seeds,
        report.corpus.len() - report.given_seeds,
        report.features,
        report.slowest,
    );
}

fn replay(target: &Target, paths: &[PathBuf]) -> io::Result<bool> {
    let mut runner = Runner::new(target)?;
    let mut sound = true;
    for path in paths {
        let files = match path.is_dir() {
            true => folders::files(path, "*"),
            false => vec![(path.clone(), std::fs::read(path)?)],
        };
        for (path, bytes) in files {
            let (reading, text) = match runner.run(&bytes)? {
                Execution::Sound(answer) => {
                    (format!("{:?} {:.3} s", answer.reading, answer.seconds), answer.text)
                }
                Execution::Wrong(finding) => {
                    sound = false;
                    (finding.kind.name().to_uppercase(), finding.text)
                }
            };
            println!("{}: {reading}\n  {}", path.display(), text.replace('\n', "\n  "));
        }
    }
    Ok(sound)
}

fn shorten(target: &Target, path: &Path) -> io::Result<bool> {
    let input = std::fs::read(path)?;
    let short = engine::minimise(target, &input)?;
    let to = path.with_extension("short");
    std::fs::write(&to, &short)?;
    println!("{}: {} of {} bytes", to.display(), short.len(), input.len());
    Ok(true)
}
