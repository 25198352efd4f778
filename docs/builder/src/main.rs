//! Builds the book of rotordyn from `docs/`: runs its commands and compares or rewrites the output shown, writes the
//! chapters that are generated, and checks the links.

mod book;
mod chapters;
mod console;
mod curves;
mod links;
mod math;
mod reference;
mod same_bytes;
mod scaling;
mod speed;
mod step_accuracy;
mod validation;

use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;

/// Builds the book: commands run, generated chapters written, links checked.
#[derive(Debug, Parser)]
#[command(name = "book")]
pub struct Arguments {
    /// Put the output of the commands into the chapters of docs/src instead of comparing it
    #[arg(long)]
    write: bool,
    /// The program that the commands run
    #[arg(long, default_value = "target/release/rotordyn")]
    program: PathBuf,
    /// Folder with the rows of the validation chapter, that tests wrote with ROTORDYN_VALIDATION
    #[arg(long, default_value = "target/validation")]
    validation: PathBuf,
    /// Fail if the validation chapter has fewer rows than a whole run of the tests gives
    #[arg(long)]
    complete: bool,
    /// Build twice, and fail if the bytes of a page or picture differ
    #[arg(long)]
    twice: bool,
    /// Folder of the built book; its pages are in html/
    #[arg(long, default_value = "target/book")]
    out: PathBuf,
}

fn main() -> ExitCode {
    match book::build(&Arguments::parse()) {
        Ok(summary) => {
            println!("{summary}");
            ExitCode::SUCCESS
        }
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}
