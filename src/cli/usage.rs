//! Command lines that are none: their message, and with `--json` the document of every other failure.

use std::ffi::OsString;

use clap::error::ErrorKind;
use serde_json::json;

use super::args::Output;
use super::failure::Failure;
use super::outcome::{Outcome, print_json};
use super::terminal::Terminal;

/// Prints what is wrong with the arguments, or the help or version that they ask for; returns the exit code.
pub fn report(error: &clap::Error, arguments: &[OsString]) -> u8 {
    // As clap does it: a closed terminal is no other failure.
    let _ = error.print();
    let code = u8::try_from(error.exit_code()).unwrap_or(2);
    let wants_json = arguments.iter().take_while(|word| *word != "--").any(|word| word == "--json");
    let asks_for_help = error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    if error.use_stderr() && wants_json && !asks_for_help {
        let output = Output { json: true, quiet: true, strict: false, threads: None, read_limit: None };
        let failures = vec![("", Failure::Input(message(&error.render().to_string())))];
        print_json(Outcome { document: json!({}), failures }, code, &Terminal::new(&output));
    }
    code
}

/// The message in one line, without usage and tips.
fn message(text: &str) -> String {
    let lines = text.trim_start_matches("error: ").lines().map(str::trim);
    let ends =
        |line: &str| ["tip:", "Usage:", "For more information"].iter().any(|end| line.starts_with(end));
    lines.take_while(|line| !ends(line)).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
}
