//! What was computed survives: commands killed or refused at their system calls, locks, signals, output that cannot be
//! written.

mod full_disk;
mod identity;
mod killed;
mod locks;
mod scenarios;
mod signals;
mod strace;

use assert_cmd::cargo::cargo_bin;
use std::path::Path;
use std::process::Command;

/// The `rotordyn` binary, run in the repository root.
fn rotordyn() -> Command {
    let mut command = Command::new(cargo_bin("rotordyn"));
    command.current_dir(env!("CARGO_MANIFEST_DIR")).stdin(std::process::Stdio::null());
    command
}

/// A second of a Jeffcott rotor at 4 kHz: several blocks of samples, and every study in milliseconds.
const SHORT: [&str; 24] = [
    "--set",
    "speed.settle=0.1 s",
    "--set",
    "speed.ramp=0.8 s",
    "--set",
    "speed.hold=0.1 s",
    "--set",
    "study.run_up.sample_rate=4 kHz",
    "--set",
    "study.run_up.step=250 us",
    "--set",
    "study.spectrogram.length=0.2 s",
    "--set",
    "study.frf.frequencies={ from = \"1 Hz\", to = \"300 Hz\", step = \"10 Hz\" }",
    "--set",
    "study.unbalance.speeds={ from = \"500 rpm\", to = \"4000 rpm\", step = \"500 rpm\" }",
    "--set",
    "study.orders.resolution=0.5",
    "--set",
    "study.campbell.modes=4",
    "--set",
    "study.campbell.speeds={ from = \"0 rpm\", to = \"6000 rpm\", step = \"2000 rpm\" }",
    "--set",
    "shaft.element_length=100 mm",
];
const MODEL: &str = "models/jeffcott.toml";

/// Names of the entries of a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
