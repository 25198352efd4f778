//! `update --fit frf`: noisy FRFs of the rig with changed housings, fitted by the unchanged rig.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use rotordyn::io::measured;
use rotordyn::signal::record::{Kind, MeasuredData, Values};

use crate::{json_of, output_of, rotordyn};

const RIG: &str = "models/overhung_rig.toml";

/// FRFs of hits on the disc along y and on housing B along x, stored by `frf --noise`.
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
fn housing_stiffness_is_recovered_by_every_frf_fit() {
    let folder = tempfile::tempdir().unwrap();
    for fit in ["frf", "frf-complex", "frequency,mac,frf"] {
        let document = json_of(&mut update(fit, folder.path()));
        for (k, truth) in [(0, 4.2e6), (1, 2.1e7)] {
            let parameter = &document["parameters"][k];
            assert_eq!(parameter["identifiability"], "identifiable", "{fit}: {parameter}");
            let value = parameter["value"].as_f64().unwrap();
            assert!((value / truth - 1.0).abs() < 0.02, "{fit}: {parameter}");
        }
        assert_eq!(document["converged"], true);
        let distance_db = |when: &str| document[format!("frf_db_{when}")].as_f64().unwrap();
        // A signal-to-noise ratio of 40 dB gives some tenths of a dB between resonances.
        assert!(
            distance_db("before") > 3.0 && distance_db("after") < 1.0,
            "{} {}",
            distance_db("before"),
            distance_db("after")
        );
    }
}

/// FRFs in g that are labelled m/s^2 have all one factor.
#[test]
fn scale_of_all_frfs_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut scaled = measured::read(&TEST.1).unwrap();
    for record in scaled.records.iter_mut().filter(|record| record.kind == Kind::Frf) {
        let Values::Complex(values) = &mut record.values else { panic!("{}", record.name) };
        values.iter_mut().for_each(|h| *h /= 9.806_65);
    }
    let warnings = |data: &MeasuredData, name: &str| {
        let file = folder.path().join(name);
        measured::write(&file, data).unwrap();
        let mut command = rotordyn();
        command.args(["update", RIG, "--free", "housing.*.k_x,housing.*.k_y", "--band", "5 .. 300 Hz"]);
        command.args(["--no-figures", "--fit", "frequency,frf", "--measured"]).arg(file);
        let document = json_of(command.arg("--out").arg(folder.path()));
        (document["frf_scale"].as_f64(), document["warnings"].to_string())
    };
    let (scale, text) = warnings(&scaled, "scaled.uff");
    assert!((scale.unwrap() * 9.806_65 - 1.0).abs() < 0.05, "{scale:?}");
    for part in
        ["all measured FRFs are 0.1", "in g that are read as m/s^2", "mend the scale of the FRFs first"]
    {
        assert!(text.contains(part), "{part} is not in {text}");
    }
}

#[test]
fn report_lists_the_fitted_parameters() {
    let folder = tempfile::tempdir().unwrap();
    let text = output_of(&mut update("frf-complex", folder.path()));
    println!("{text}");
    for part in [
        "housing.*.k_x",
        "standard error %",
        "identifiable",
        "degrees of freedom",
        "FRAC",
        "dB after the update",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

/// The rig's rim excitation is along no axis: its shapes are used, but only the FRFs of the other force are fitted.
#[test]
fn skew_excitation_is_excluded_from_the_frf_fit() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("test");
    let mut test = rotordyn();
    test.args(["frf", RIG, "--no-figures", "--noise", "60 dB", "--seed", "1", "--out"]).arg(&out);
    test.assert().success();
    let mut command = rotordyn();
    command.args(["update", RIG, "--free", "housing.*.k_x", "--fit", "frf", "--no-figures", "--json"]);
    command.arg("--measured").arg(out.join("frf_noisy.uff")).arg("--out").arg(folder.path());
    let output = command.assert().success().get_output().clone();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.contains("FRFs under the force") && stderr.contains("are not compared"), "{stderr}");
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let parameter = &document["parameters"][0];
    let ratio = parameter["value"].as_f64().unwrap() / parameter["start"].as_f64().unwrap();
    assert!((ratio - 1.0).abs() < 0.01 && parameter["identifiability"] == "identifiable", "{parameter}");
}

#[test]
fn modal_damping_ratios_are_free_parameters() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("jeffcott.toml");
    let text =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("models/jeffcott.toml")).unwrap();
    let (old, new) = (
        "frequency = \"25 Hz\"\nratio = 0.005",
        "frequency = \"25, 300 Hz\"\nratio = [0.005, 0.01] # a guess",
    );
    assert!(text.contains(old));
    std::fs::write(&model, text.replace(old, new)).unwrap();
    let truth = folder.path().join("truth");
    let mut modal = rotordyn();
    modal.arg("modal").arg(&model).args(["--speed", "600 rpm", "--no-figures"]);
    modal.args(["--set", "damping.modal.ratio=[0.008, 0.013]", "--out"]).arg(&truth);
    modal.assert().success();
    let update = |free: &str| {
        let mut command = rotordyn();
        command.arg("update").arg(&model).args(["--free", free, "--fit", "damping", "--no-figures"]);
        command.arg("--measured").arg(truth.join("results.h5"));
        command.arg("--out").arg(folder.path().join("updated"));
        command
    };
    let document = json_of(&mut update("damping.modal.ratio.0,damping.modal.ratio.1"));
    for (k, truth) in [(0, 0.008), (1, 0.013)] {
        let value = document["parameters"][k]["value"].as_f64().unwrap();
        assert!((value / truth - 1.0).abs() < 0.02, "{}", document["parameters"][k]);
    }
    let new = std::fs::read_to_string(folder.path().join("updated/jeffcott_updated.toml")).unwrap();
    assert!(new.contains("# a guess"), "{new}");
    println!("{}", new.lines().find(|line| line.contains("a guess")).unwrap());
    // Freed together by a wildcard they keep their ratio.
    let document = json_of(&mut update("damping.modal.ratio.*"));
    assert_eq!(document["parameters"][0]["paths"].as_array().unwrap().len(), 2);
    let refused = update("damping.modal.ratio").assert().code(2).get_output().stderr.clone();
    assert!(String::from_utf8(refused).unwrap().contains("damping.modal.ratio.*"));
}
