//! `update --fit frf`: FRFs that the rig with other housings gives with noise, fitted by the rig as it is.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crate::{json_of, output_of, rotordyn};

const RIG: &str = "models/overhung_rig.toml";

/// FRFs by blows on the disc along y and on housing B along x, stored by `frf --noise`.
static TEST: LazyLock<(tempfile::TempDir, PathBuf)> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("test");
    let mut command = rotordyn();
    command
        .args(["frf", RIG, "--no-figures", "--noise", "40 dB", "--averages", "10", "--seed", "1"])
        .args(["--set", "study.frf.excitation.rim.offset=0, 0, 0 mm"])
        .args(["--set", "study.frf.excitation.rim.direction=[0, 1, 0]", "--out"])
        .arg(&out);
    for (path, value) in [("A.k_x", "4.2e6"), ("B.k_x", "4.2e6"), ("A.k_y", "2.1e7"), ("B.k_y", "2.1e7")] {
        command.args(["--set", &format!("housing.{path}={value} N/m")]);
    }
    command.assert().success();
    let file = out.join("frf_noisy.uff");
    (folder, file)
});

fn update(fit: &str, out: &Path) -> assert_cmd::Command {
    let mut command = rotordyn();
    command
        .args([
            "update",
            RIG,
            "--free",
            "housing.*.k_x,housing.*.k_y",
            "--band",
            "5 .. 300 Hz",
            "--no-figures",
        ])
        .args(["--fit", fit, "--measured"])
        .arg(&TEST.1)
        .arg("--out")
        .arg(out);
    command
}

#[test]
fn housings_come_back_by_every_fit_of_frfs() {
    let folder = tempfile::tempdir().unwrap();
    for fit in ["frf", "frf-complex", "frequency,mac,frf"] {
        let document = json_of(&mut update(fit, folder.path()));
        for (k, truth) in [(0, 4.2e6), (1, 2.1e7)] {
            let parameter = &document["parameters"][k];
            assert_eq!(parameter["verdict"], "found", "{fit}: {parameter}");
            let value = parameter["value"].as_f64().unwrap();
            assert!((value / truth - 1.0).abs() < 0.02, "{fit}: {parameter}");
        }
        assert_eq!(document["converged"], true);
        let apart = |when: &str| document[format!("frf_db_{when}")].as_f64().unwrap();
        // Noise of 40 dB is some tenths of a dB between resonances.
        assert!(apart("before") > 3.0 && apart("after") < 1.0, "{} {}", apart("before"), apart("after"));
    }
}

#[test]
fn the_report_tells_what_was_fitted() {
    let folder = tempfile::tempdir().unwrap();
    let text = output_of(&mut update("frf-complex", folder.path()));
    println!("{text}");
    for part in [
        "housing.*.k_x",
        "standard error %",
        "found",
        "degrees of freedom",
        "FRAC",
        "dB apart after the update",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

#[test]
fn a_blow_askew_has_no_frfs_to_fit() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("test");
    let mut test = rotordyn();
    test.args(["frf", RIG, "--no-figures", "--noise", "60 dB", "--seed", "1", "--out"]).arg(&out);
    test.assert().success();
    let mut command = rotordyn();
    command.args(["update", RIG, "--free", "housing.*.k_x", "--fit", "frf", "--no-figures", "--measured"]);
    command.arg(out.join("frf_noisy.uff")).arg("--out").arg(folder.path());
    let said = command.assert().code(2).get_output().stderr.clone();
    let said = String::from_utf8(said).unwrap();
    println!("{said}");
    for part in ["cannot be compared", "--mapping", "FRFs are not compared"] {
        assert!(said.contains(part), "{said}");
    }
}
