//! Where a comparison is written, and what it leaves out.

use std::path::PathBuf;

use super::super::args::CompareArgs;
use super::super::terminal::Terminal;

/// Results folder; default `out/NAME_comparison`.
pub fn folder(args: &CompareArgs, model: &str) -> PathBuf {
    args.study.out.clone().unwrap_or_else(|| format!("out/{model}_comparison").into())
}

/// Says what is not compared.
pub fn note_left_out(left_out: &[String], terminal: &Terminal) {
    for text in left_out {
        terminal.print_wrapped(&format!("not compared: {text}"));
    }
}
