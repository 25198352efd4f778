//! Pages of machines in headless Chromium: no error and no request, every figure has its curves, hovers say what
//! the results file says, every mode moves, the keyboard reaches every control, axe finds no serious fault.
//!
//! Needs Chromium (`ROTORDYN_CHROMIUM`, or in the path) and a Python with h5py, playwright and axe-playwright-python.
//! `ROTORDYN_PAGES=all` opens those of more machines, `ROTORDYN_SHOTS=FOLDER` keeps pictures: light, dark, narrow, and a PDF.

use assert_cmd::Command;
use std::path::{Path, PathBuf};

/// Machines, each with settings that keep it short: a run-up with ball bearings and a belt, a rotor
/// on linear bearings, a bearing alone. `ROTORDYN_PAGES=all` adds the others.
const MACHINES: [(&str, &[&str]); 3] = [
    (
        "overhung_rig",
        &[
            "speed.settle=0.1 s",
            "speed.ramp=0.6 s",
            "speed.hold=0.1 s",
            "study.spectrogram.length=0.1 s",
            "study.orders.resolution=0.5",
        ],
    ),
    ("nelson_mcvaugh", &[]),
    ("zhang_2016", &[]),
];
const OTHER_MACHINES: [(&str, &[&str]); 2] =
    [("jeffcott", &["speed.ramp=1 s", "speed.hold=0.2 s"]), ("two_disc_pedestals", &[])];

fn chromium() -> Option<PathBuf> {
    let named = std::env::var_os("ROTORDYN_CHROMIUM").map(PathBuf::from);
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = std::env::split_paths(&folders).collect();
    let in_path = ["chromium", "chromium-browser", "google-chrome"].into_iter();
    named.or_else(|| in_path.flat_map(|name| folders.iter().map(move |f| f.join(name))).find(|p| p.is_file()))
}

/// Chromium and Python; else the test is skipped, or fails with `CI` set.
fn tools() -> Option<(PathBuf, String)> {
    let python = std::env::var("ROTORDYN_PYTHON").unwrap_or_else(|_| "python3".into());
    let import = ["-c", "import h5py, playwright, axe_playwright_python"];
    let has_modules =
        std::process::Command::new(&python).args(import).output().is_ok_and(|done| done.status.success());
    let found = chromium().filter(|_| has_modules);
    if found.is_none() {
        let message = "no Chromium, or no Python with h5py, playwright and axe-playwright-python";
        let must_run = std::env::var_os("CI").is_some() && std::env::var_os("ROTORDYN_ALLOW_SKIP").is_none();
        assert!(!must_run, "{message}; set ROTORDYN_ALLOW_SKIP to skip the test");
        eprintln!("skipped: {message}");
    }
    Some((found?, python))
}

/// Puts NaN into every number of the linear studies.
const SPOIL: &str = "
import sys, h5py
with h5py.File(sys.argv[1], 'r+') as results:
    for name in ['campbell/frequency', 'campbell/log_dec', 'campbell/shapes', 'modes/frequency', 'modes/shapes', 'unbalance/rpm']:
        results[name][...] = float('nan')
";

/// A machine with markup in title and names, a title of 10⁵ characters, few elements.
fn hostile_model() -> String {
    let title =
        format!("</script><script>alert(1)</script><img src=x onerror='alert(2)'>{}", "x".repeat(100_000));
    let disc = "<b onclick=alert(3)>&'</b>";
    let text = include_str!("../../models/nelson_mcvaugh.toml")
        .replace("[disc.main]", &format!("[disc.{disc:?}]"))
        .replace("\"disc.main\"", &format!("\"disc.{disc}\""));
    let mut model: toml::Table = text.parse().unwrap();
    model["model"].as_table_mut().unwrap().insert("title".into(), title.into());
    toml::to_string(&model).unwrap()
}

fn output_of(command: &mut std::process::Command) {
    let done = command.output().unwrap();
    let [output, errors] =
        [&done.stdout, &done.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    println!("{output}");
    assert!(done.status.success(), "{output}\n{errors}");
}

/// Texts with markup, numbers that are none, no run-up, one study only: the page opens and shows text as text.
#[test]
fn pages_of_hostile_models_open() {
    let Some((chromium, python)) = tools() else { return };
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("hostile.toml");
    std::fs::write(&model, hostile_model()).unwrap();
    let rotordyn = || Command::cargo_bin("rotordyn").unwrap();
    let outs = ["markup", "nan", "modal"].map(|name| folder.path().join(name));
    for (study, out) in ["run", "run", "modal"].iter().zip(&outs) {
        rotordyn().arg(study).arg(&model).arg("--quiet").arg("--out").arg(out).assert().success();
    }
    output_of(std::process::Command::new(&python).args(["-c", SPOIL]).arg(outs[1].join("results.h5")));
    for out in &outs {
        rotordyn().arg("report").arg(out).assert().success();
    }
    let mut check = std::process::Command::new(python);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    check.arg(root.join("tests/browser/check_reports.py")).arg("--only-open").arg(chromium);
    output_of(check.args(outs.map(|out| out.join("report.html"))));
}

#[test]
fn pages_work_in_a_browser() {
    let Some((chromium, python)) = tools() else { return };
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut arguments = Vec::new();
    let others = std::env::var_os("ROTORDYN_PAGES").is_some().then_some(OTHER_MACHINES);
    for (name, settings) in MACHINES.into_iter().chain(others.into_iter().flatten()) {
        let out = folder.path().join(name);
        let mut run = Command::cargo_bin("rotordyn").unwrap();
        run.current_dir(root)
            .arg("run")
            .arg(format!("models/{name}.toml"))
            .arg("--quiet")
            .arg("--out")
            .arg(&out);
        run.args(settings.iter().flat_map(|value| ["--set", value])).assert().success();
        arguments.extend([out.join("report.html"), out.join("results.h5")]);
    }
    let mut check = std::process::Command::new(python);
    check.arg(root.join("tests/browser/check_reports.py")).arg(chromium).args(&arguments);
    if let Some(shots) = std::env::var_os("ROTORDYN_SHOTS") {
        check.arg("--shots").arg(shots);
    }
    output_of(&mut check);
}
