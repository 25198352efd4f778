//! The command `rotordyn`.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    match cli::hdf5_reader::run(std::env::args_os()) {
        Some(code) => code,
        None => cli::command(std::env::args_os(), cli::limits::program()).into(),
    }
}
