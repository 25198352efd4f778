//! Command-line tests of the binary: every model, every command, exit codes, Ctrl-C, JSON output.

mod ball_inertia;
mod bearing_limits;
mod bearings;
mod belts;
mod commands;
mod compare;
mod doubtful_modes;
mod failures;
mod first_changes;
#[cfg(target_os = "linux")]
mod flat_memory;
mod forecasts;
mod help;
mod hit_beside_shaft;
mod identify;
mod impact_test;
mod import;
mod init;
mod operational;
mod order_tracks;
mod pairing;
mod path_names;
mod preloads;
mod renamed;
mod report;
mod result_documents;
mod resume;
mod run_up_checks;
mod run_ups;
mod runs;
mod signal;
mod signal_failures;
mod signal_grade;
mod spoiled_run_ups;
mod steady;
mod trend;
mod trend_statements;
mod unbalance_tables;
mod update_frf;
mod validate_update;

use assert_cmd::Command;
use std::path::{Path, PathBuf};

/// The `rotordyn` binary, run in the repository root.
fn rotordyn() -> Command {
    let mut command = Command::cargo_bin("rotordyn").unwrap();
    command.current_dir(env!("CARGO_MANIFEST_DIR")).env_remove("NO_COLOR");
    command
}

/// Standard output of a command that must succeed.
fn output_of(command: &mut Command) -> String {
    String::from_utf8(command.assert().success().get_output().stdout.clone()).unwrap()
}

/// JSON document (`--json`) of a command that must succeed.
fn json_of(command: &mut Command) -> serde_json::Value {
    serde_json::from_str(&output_of(command.arg("--json"))).unwrap()
}

fn models() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    let mut models: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    models.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    models.sort();
    assert!(models.len() >= 4);
    models
}

/// Model file of the rig at rest with a hammer impact on the disc along y: triangular pulse, 2 ms, 1 N peak.
fn struck_rig() -> String {
    let rig = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/overhung_rig.toml");
    let text = std::fs::read_to_string(rig).unwrap();
    let (start, end) = (text.find("[speed]").unwrap(), text.find("[probe.A_ax]").unwrap());
    let hammer = "[speed]\nprofile = \"constant\"\nspeed = \"0 rpm\"\nduration = \"4 s\"\n\n\
        [load.hammer]\nat = \"disc.main\"\nforce = \"0, 1, 0 N\"\ntime = \"0, 1, 2 ms\"\nfactor = [0, 1, 0]\n\n";
    // No rotation, so no order study.
    let orders = text.find("[study.orders]").unwrap()..text.find("# --- the paper's other").unwrap();
    format!("{}{hammer}{}{}", &text[..start], &text[end..orders.start], &text[orders.end..])
}
