//! `validate` and `update`: simulated measurements of the rig with changed parameters, and invalid requests.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use crate::result_documents::column;
use crate::{json_of, output_of, rotordyn, struck_rig};

const RIG: &str = "models/overhung_rig.toml";

/// Modes of the rig with softer and stiffer housings, stored by `modal`.
static TRUTH: LazyLock<(tempfile::TempDir, PathBuf)> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("truth");
    let mut command = rotordyn();
    command.args(["modal", RIG, "--speed", "0 rpm", "--no-figures", "--out"]).arg(&out);
    for (path, value) in [("A.k_x", "4.2e6"), ("B.k_x", "4.2e6"), ("A.k_y", "2.1e7"), ("B.k_y", "2.1e7")] {
        command.args(["--set", &format!("housing.{path}={value} N/m")]);
    }
    command.assert().success();
    let file = out.join("results.h5");
    (folder, file)
});

fn truth() -> &'static Path {
    &TRUTH.1
}

#[test]
fn validate_pairs_all_modes() {
    let folder = tempfile::tempdir().unwrap();
    let document = json_of(
        rotordyn().args(["validate", RIG, "--measured"]).arg(truth()).arg("--out").arg(folder.path()),
    );
    let modes = document["measured"][0]["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 12);
    // Housings softer along x and stiffer along y split the pairs and rotate their shapes.
    let paired = modes.iter().filter(|m| m["mac"].as_f64().is_some_and(|mac| mac > 0.5)).count();
    assert!(paired >= 8, "{modes:#?}");
    for file in ["validation.h5", "validation_mac.svg", "validation_mac.png", "validation_frequencies.svg"] {
        assert!(folder.path().join(file).exists(), "{file}");
    }
    let text = output_of(
        rotordyn()
            .args(["validate", RIG, "--no-figures", "--csv", "--measured"])
            .arg(truth())
            .arg("--out")
            .arg(folder.path()),
    );
    let measured: Vec<f64> = modes.iter().map(|m| m["measured_hz"].as_f64().unwrap()).collect();
    assert_eq!(column(&folder.path().join("csv/measured_modes.csv"), "measured_hz [Hz]"), measured);
    for part in ["12 modes of the file", "measured Hz", "MAC", "1st torsional"] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

/// Modes stored by `modal` and written by `export` agree with the model, rotations and translations.
#[test]
fn model_agrees_with_its_own_modes() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("own");
    rotordyn()
        .args(["modal", RIG, "--speed", "600 rpm", "--no-figures", "--out"])
        .arg(&out)
        .assert()
        .success();
    rotordyn().args(["export", RIG, "--no-figures", "--out"]).arg(&out).assert().success();
    for (file, speed) in [("results.h5", 600.0), ("modes.uff", 0.0)] {
        let document = json_of(
            rotordyn()
                .args(["validate", RIG, "--no-figures", "--measured"])
                .arg(out.join(file))
                .arg("--out")
                .arg(folder.path().join("out")),
        );
        let measured = &document["measured"][0];
        assert!((measured["rpm"].as_f64().unwrap() - speed).abs() < 1e-6, "{measured}");
        for mode in measured["modes"].as_array().unwrap() {
            let value = |key: &str| mode[key].as_f64().unwrap();
            assert!(value("mac") > 0.99999 && value("error").abs() < 1e-5, "{file}: {mode}");
        }
    }
}

#[test]
fn update_changes_only_the_updated_values_in_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let document = json_of(
        rotordyn()
            .args([
                "update",
                RIG,
                "--free",
                "housing.*.k_x,housing.*.k_y",
                "--band",
                "5 .. 300 Hz",
                "--csv",
                "--measured",
            ])
            .arg(truth())
            .arg("--out")
            .arg(folder.path()),
    );
    for (k, value) in [(0, 4.2e6), (1, 2.1e7)] {
        let parameter = &document["parameters"][k];
        assert_eq!(parameter["identifiability"], "identifiable", "{parameter}");
        assert!((parameter["value"].as_f64().unwrap() / value - 1.0).abs() < 1e-3, "{parameter}");
        let table = folder.path().join("csv/update_parameters.csv");
        let written = column(&table, "value [in the parameter's unit]");
        assert_eq!(written[k], parameter["value"].as_f64().unwrap());
    }
    let old = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(RIG)).unwrap();
    let new = std::fs::read_to_string(folder.path().join("overhung_rig_updated.toml")).unwrap();
    let changed: Vec<(&str, &str)> = old.lines().zip(new.lines()).filter(|(a, b)| a != b).collect();
    assert_eq!(old.lines().count(), new.lines().count());
    assert_eq!(changed.len(), 4, "{changed:?}");
    for (a, b) in changed {
        assert!(a.starts_with("k_") && b.starts_with(&a[..6]) && b.ends_with(" N/m\""), "{a} became {b}");
    }
    for file in ["update.h5", "update_mac_before.svg", "update_mac_after.png", "update_frequencies.png"] {
        assert!(folder.path().join(file).exists(), "{file}");
    }
    output_of(rotordyn().arg("check").arg(folder.path().join("overhung_rig_updated.toml")));
    copy_figures(folder.path(), "update");
}

/// An insufficient fit gives warnings, also in the JSON document.
#[test]
fn insufficient_fits_give_warnings() {
    let folder = tempfile::tempdir().unwrap();
    let warnings = |more: &[&str]| {
        let mut command = rotordyn();
        command.args(["update", RIG, "--free", "housing.B.k_x", "--no-figures", "--band", "5 .. 300 Hz"]);
        command.args(more).arg("--measured").arg(truth()).arg("--out").arg(folder.path());
        json_of(&mut command)["warnings"].to_string()
    };
    // Both housings differ in both planes, and one parameter is free.
    let text = warnings(&[]);
    assert!(text.contains("lack-of-fit") && text.contains("does not explain the data"), "{text}");
    let text = warnings(&["--prior", "housing.B.k_x=+- 0.1 %"]);
    assert!(text.contains("prior standard deviations away from the prior mean"), "{text}");
    // No warning if all differing parameters are free.
    let mut command = rotordyn();
    command.args(["update", RIG, "--free", "housing.*.k_x,housing.*.k_y", "--no-figures", "--band"]);
    command.args(["5 .. 300 Hz", "--measured"]).arg(truth()).arg("--out").arg(folder.path());
    let document = json_of(&mut command);
    assert!(!document["warnings"].to_string().contains("explain"), "{}", document["warnings"]);
    assert_eq!(document["schema"], "rotordyn-results-3");
}

/// JSON document of `update` of the rig with free parameters and further arguments.
fn update_of(folder: &Path, free: &str, more: &[&str]) -> serde_json::Value {
    let mut command = rotordyn();
    command.args(["update", RIG, "--free", free, "--band", "5 .. 300 Hz"]).args(more);
    json_of(command.arg("--measured").arg(truth()).arg("--out").arg(folder))
}

/// Housings that differ along x and y, free along x only: the stiffness along y of both is named with its value.
#[test]
fn culprit_of_a_misfit_is_named_with_its_value() {
    let folder = tempfile::tempdir().unwrap();
    let document = update_of(folder.path(), "housing.*.k_x", &["--no-figures"]);
    assert_eq!(document["parameters"][0]["identifiability"], "poor fit", "{}", document["parameters"]);
    assert_eq!(document["fit"], "not explained");
    assert_eq!(document["standard_errors_valid"], false);
    let probability = |of: &serde_json::Value| of["chi_squared_probability"].as_f64().unwrap();
    assert!(probability(&document) < 0.01, "{document}");
    let culprit = &document["culprits"][0];
    assert_eq!(culprit["name"], "housing.*.k_y", "{}", document["culprits"]);
    assert!(culprit["explains"] == true && probability(culprit) > 0.01, "{culprit}");
    assert!((culprit["value"].as_f64().unwrap() / 2.1e7 - 1.0).abs() < 0.01, "{culprit}");
    let left = culprit["chi_squared"].as_f64().unwrap();
    let gain = document["chi_squared"].as_f64().unwrap() - left;
    assert!((culprit["chi_squared_gain"].as_f64().unwrap() / gain - 1.0).abs() < 1e-9, "{culprit}");
    let warnings = document["warnings"].as_array().unwrap();
    let warning = warnings.iter().find(|w| w["code"] == "lack-of-fit").unwrap().to_string();
    for part in ["degrees of freedom", "probability", "housing.*.k_y"] {
        assert!(warning.contains(part), "{part} is not in {warning}");
    }
}

/// From housings thousands of times too soft no fit finds the data: the start is named as the cause, and nothing is said of a
/// contradiction between data and prior.
#[test]
fn start_far_from_the_data_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = rotordyn();
    command.args(["update", RIG, "--free", "housing.A.k_x,housing.B.k_x", "--no-figures"]);
    command.args([
        "--set",
        "housing.A.k_x=2e3 N/m",
        "--set",
        "housing.B.k_x=2e3 N/m",
        "--band",
        "5 .. 100 Hz",
    ]);
    let document = json_of(command.arg("--measured").arg(truth()).arg("--out").arg(folder.path()));
    assert_eq!(document["parameters"][0]["identifiability"], "not identifiable", "{document}");
    let warnings = document["warnings"].to_string();
    for part in
        ["the start is far from the data", " Hz with none", "start housing.A.k_x and housing.B.k_x nearer"]
    {
        assert!(warnings.contains(part), "{part} is not in {warnings}");
    }
    assert!(!warnings.contains("data and prior are inconsistent"), "{warnings}");
}

/// A bound that excludes the stiffness of the housings: widening it is proposed, and nothing else.
#[test]
fn bound_that_excludes_the_fit_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let free = "housing.*.k_x,housing.*.k_y";
    let bounds = ["--no-figures", "--bounds", "housing.*.k_x=5e6 .. 7e6 N/m"];
    let document = update_of(folder.path(), free, &bounds);
    let released = &document["released_bounds"][0];
    assert!(released["name"] == "housing.*.k_x" && released["explains"] == true, "{released}");
    assert!((released["value"].as_f64().unwrap() / 4.2e6 - 1.0).abs() < 0.01, "{released}");
    let warnings = document["warnings"].to_string();
    assert!(warnings.contains("widen the bounds of housing.*.k_x, which becomes 4.2"), "{warnings}");
    assert!(!warnings.contains("besides"), "{warnings}");
}

/// Young's modulus and the diameter of the shaft absorb a pulley 3 % lighter so well that chi^2 is smaller than its degrees
/// of freedom.
#[test]
fn values_that_depend_on_a_fixed_mass_are_not_identifiable() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("truth");
    let mut modal = rotordyn();
    modal.args([
        "modal",
        RIG,
        "--speed",
        "0 rpm",
        "--no-figures",
        "--set",
        "disc.pulley.mass=0.97 kg",
        "--out",
    ]);
    modal.arg(&out).assert().success();
    let update = |free: &str| {
        let mut command = rotordyn();
        command
            .args(["update", RIG, "--no-figures", "--free", free, "--measured"])
            .arg(out.join("results.h5"));
        json_of(command.arg("--out").arg(folder.path()))
    };
    let document = update("material.steel.young,shaft.section.0.outer_diameter");
    assert!(document["chi_squared_probability"].as_f64().unwrap() > 0.5, "{document}");
    for (k, row) in document["parameters"].as_array().unwrap().iter().enumerate() {
        assert_eq!(row["identifiability"], "depends on a fixed value");
        let dependence = &document["dependences"][k];
        assert_eq!(dependence["depends_on"], "disc.pulley.mass");
        let number = |key: &str| dependence[key].as_f64().unwrap();
        // Both values were right at the start.
        assert!((number("depends_on_predicted") - 0.97).abs() < 0.002, "{dependence}");
        let [start, value] = ["start", "value"].map(|key| row[key].as_f64().unwrap());
        assert!((number("value_predicted") - start).abs() < 0.1 * (value - start).abs(), "{dependence}");
    }
    assert!(document["warnings"].to_string().contains("disc.pulley.mass is not free"), "{document}");
    // Of the parameters that are right none has a warning.
    let document = update("disc.pulley.mass,material.steel.young,shaft.section.0.outer_diameter");
    assert!(document["dependences"].is_null(), "{document}");
    assert_eq!(document["parameters"][0]["identifiability"], "identifiable");
    assert!(!document["warnings"].to_string().contains("is not free"), "{document}");
}

/// The modes below 200 Hz determine the diameter of the shaft for a known Young's modulus only: the error with the modulus
/// free too, and the change of the diameter by the modulus, are those of two more fits.
#[test]
fn value_that_a_fixed_one_could_replace_is_not_identifiable() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("truth");
    let mut modal = rotordyn();
    modal.args(["modal", RIG, "--speed", "0 rpm", "--no-figures", "--out"]).arg(&out).assert().success();
    let update = |young: &str, more: &str| {
        let mut command = rotordyn();
        let free = format!("shaft.section.0.outer_diameter,disc.pulley.mass{more}");
        command
            .args(["update", RIG, "--no-figures", "--band", "5 .. 200 Hz", "--free", &free])
            .args(["--set", &format!("material.steel.young={young}"), "--measured"])
            .arg(out.join("results.h5"));
        json_of(command.arg("--out").arg(folder.path()))
    };
    let number = |row: &serde_json::Value, key: &str| row[key].as_f64().unwrap();
    let document = update("207 GPa", "");
    let [diameter, mass] = [0, 1].map(|k| &document["parameters"][k]);
    assert_eq!(diameter["identifiability"], "inseparable from a fixed value", "{diameter}");
    assert_eq!(mass["identifiability"], "identifiable", "{mass}");
    let rows = document["inseparable_from_fixed"].as_array().unwrap();
    assert!(rows.len() == 1 && rows[0]["fixed"] == "material.steel.young", "{rows:?}");
    assert!(document["warnings"].as_array().unwrap().is_empty(), "{}", document["warnings"]);
    let free = update("207 GPa", ",material.steel.young");
    let error = number(&free["parameters"][0], "standard_error");
    assert!((number(&rows[0], "standard_error_if_free") / error - 1.0).abs() < 0.01, "{error} {rows:?}");
    assert!(error > 10.0 * number(diameter, "standard_error"), "{error} {diameter}");
    let stiffer = number(&update("209.07 GPa", "")["parameters"][0], "value");
    let change = stiffer - number(diameter, "value");
    assert!((number(&rows[0], "change_for_one_per_cent") / change - 1.0).abs() < 0.03, "{change} {rows:?}");
}

/// A plausible fit has no culprits; its profiles have intervals about the true value, and figures.
#[test]
fn profiles_of_a_plausible_fit() {
    let folder = tempfile::tempdir().unwrap();
    let free = "housing.*.k_x,housing.*.k_y";
    let document = update_of(folder.path(), free, &["--profile", "housing.*.k_x,housing.*.k_y"]);
    assert!(document["warnings"].as_array().unwrap().is_empty(), "{}", document["warnings"]);
    assert!(document.get("culprits").is_none() && document["fit"] != "not explained");
    for (k, truth) in [(0, 4.2e6), (1, 2.1e7)] {
        let profile = &document["profiles"][k];
        let numbers = |key: &str| -> Vec<f64> {
            profile[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
        };
        let (half, wide) = (numbers("interval_68"), numbers("interval_95"));
        assert!(wide[0] < half[0] && half[0] < truth && truth < half[1] && half[1] < wide[1], "{profile}");
        // The data depend nearly linearly on the housings: the interval is that of two standard errors.
        let error = document["parameters"][k]["standard_error"].as_f64().unwrap();
        assert!(((half[1] - half[0]) / (2.0 * error) - 1.0).abs() < 0.1, "{profile} {error}");
        let chi_squared = numbers("chi_squared");
        assert_eq!(chi_squared.len(), numbers("value").len());
        assert!(chi_squared.iter().all(|v| *v >= profile["least_chi_squared"].as_f64().unwrap()));
    }
    let figures = std::fs::read_dir(folder.path()).unwrap().map(|f| f.unwrap().file_name());
    let profiles: Vec<_> = figures.filter(|f| f.to_string_lossy().starts_with("update_profile_")).collect();
    assert_eq!(profiles.len(), 4, "{profiles:?}");
    copy_figures(folder.path(), "update_profile");
    let stderr = update_refused("housing.A.k_x", &["--profile", "housing.B.k_x"]);
    assert!(stderr.contains("--profile takes the names given to --free"), "{stderr}");
}

/// A group states the combination that the data determine and the one they do not.
#[test]
fn inseparable_parameters_are_a_group() {
    let folder = tempfile::tempdir().unwrap();
    let free = "material.steel.young,shaft.section.0.outer_diameter,housing.*.k_x,housing.*.k_y";
    let document = update_of(folder.path(), free, &["--no-figures"]);
    for group in document["groups"].as_array().unwrap() {
        let error = |of: &str| group[of]["standard_error"].as_f64().unwrap();
        assert!(error("determined") < error("undetermined"), "{group}");
        let members = group["members"].as_array().unwrap();
        assert!(
            members.len() > 1 && members.len() == group["determined"]["weights"].as_array().unwrap().len()
        );
    }
}

/// Sensors offset from a housing's centre are assigned to the same places of the model.
#[test]
fn sensors_on_housings_are_assigned_to_the_model() {
    let folder = tempfile::tempdir().unwrap();
    let (model, out) = ("models/two_disc_pedestals.toml", folder.path().join("test"));
    rotordyn().args(["frf", model, "--no-figures", "--noise", "40 dB", "--out"]).arg(&out).assert().success();
    let mut command = rotordyn();
    command.args(["validate", model, "--no-figures", "--measured"]).arg(out.join("frf_noisy.uff"));
    let document = json_of(command.arg("--out").arg(folder.path().join("out")));
    let measured = &document["measured"][0];
    for row in measured["frac"].as_array().unwrap() {
        // The noise of 1 % takes 1e-3 of the smallest response.
        assert!(row[0].as_f64().unwrap() > 0.998, "{}", measured["frac"]);
    }
    for mode in measured["modes"].as_array().unwrap() {
        assert!(mode["mac"].as_f64().unwrap() > 0.95, "{mode}");
    }
}

/// Standard error of a command that ends with exit code 2.
fn refused(command: &str, args: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let mut run = rotordyn();
    run.args([command, RIG, "--no-figures", "--out"]).arg(folder.path());
    for arg in args {
        match *arg {
            "TRUTH" => run.arg(truth()),
            arg => run.arg(arg),
        };
    }
    let stderr = run.assert().code(2).get_output().stderr.clone();
    let stderr = String::from_utf8(stderr).unwrap();
    // Temporary folders differ between runs.
    let truth = truth().display().to_string();
    stderr.replace(&truth, "truth.h5").replace(&folder.path().display().to_string(), "OUT")
}

fn update_refused(free: &str, more: &[&str]) -> String {
    let mut args = vec!["--measured", "TRUTH", "--free", free];
    args.extend_from_slice(more);
    refused("update", &args)
}

/// Writes a file into the test's folder; returns its path.
fn file(folder: &tempfile::TempDir, name: &str, text: &str) -> String {
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn bad_requests_of_validate_and_update() {
    let folder = tempfile::tempdir().unwrap();
    let far = file(&folder, "far.toml", "[point.3]\nstation = \"dics\"\n");
    let lost = file(&folder, "lost.toml", "[point.999]\nstation = \"disc\"\n");
    let channels = file(&folder, "channels.toml", "[channel.B_ax]\nstation = \"B\"\ndirection = \"x\"\n");
    let csv = file(&folder, "time.csv", "time [s],a [m/s^2]\n0,0\n0.001,1\n0.002,0\n");
    let plain = file(&folder, "no_geometry.uff", &uff_mode_without_points());
    let cases = [
        ("unknown path", update_refused("housing.B.k_xx", &[])),
        ("unknown item", update_refused("housing.C.k_x", &[])),
        ("not stated", update_refused("bearing.B.ball_diameter", &[])),
        ("no number", update_refused("bearing.B.designation", &[])),
        ("two numbers", update_refused("belt.drive.pull", &[])),
        ("a table", update_refused("housing.B", &[])),
        ("no item has it", update_refused("housing.*.k_q", &[])),
        ("several at once", update_refused("housing.B.k_xx,hosing.A.k_x", &[])),
        ("free twice", update_refused("housing.*.k_x,housing.B.k_x", &[])),
        ("two units", update_refused("housing.B.k_x+housing.B.c_x", &[])),
        ("no influence", update_refused("unbalance.residual.magnitude", &[])),
        ("zero without prior", update_refused("unbalance.residual.phase", &[])),
        (
            "more parameters than data",
            update_refused(
                "housing.*.k_x,housing.*.k_y,belt.drive.k_x",
                &["--band", "26 .. 29 Hz", "--fit", "frequency"],
            ),
        ),
        (
            "start outside bounds",
            update_refused("housing.B.k_x", &["--bounds", "housing.B.k_x=1e5 .. 1e6 N/m"]),
        ),
        ("bounds reversed", update_refused("housing.B.k_x", &["--bounds", "housing.B.k_x=1e8 .. 1e6 N/m"])),
        (
            "bounds in another unit",
            update_refused("housing.B.k_x", &["--bounds", "housing.B.k_x=1 kN/mm .. 10 kN/mm"]),
        ),
        (
            "bounds of what is not free",
            update_refused("housing.B.k_x", &["--bounds", "housing.B.k_y=1e6 .. 1e8 N/m"]),
        ),
        ("no prior", update_refused("housing.B.k_x", &["--prior", "housing.B.k_x=about right"])),
        ("frf without frfs", update_refused("housing.B.k_x", &["--fit", "frf"])),
        ("no modes in band", refused("validate", &["--measured", "TRUTH", "--band", "400 .. 500 Hz"])),
        ("band without unit", refused("validate", &["--measured", "TRUTH", "--band", "10 .. 300"])),
        ("no such station", refused("validate", &["--measured", "TRUTH", "--mapping", &far])),
        ("no such point", refused("validate", &["--measured", "TRUTH", "--mapping", &lost])),
        ("channels for shapes", refused("validate", &["--measured", "TRUTH", "--mapping", &channels])),
        ("neither modes nor FRFs", refused("validate", &["--measured", &csv])),
        ("no geometry", refused("validate", &["--measured", &plain])),
    ];
    let base = folder.path().display().to_string();
    let all: Vec<String> =
        cases.iter().map(|(name, stderr)| format!("# {name}\n{}", stderr.replace(&base, "TMP"))).collect();
    insta::assert_snapshot!(all.join("\n"));
}

/// A universal file (dataset 55) with one mode at points that are not in the model, without geometry.
fn uff_mode_without_points() -> String {
    let mut out = String::from("    -1\n    55\nmode 1\nNONE\nNONE\nNONE\nNONE\n");
    out += "         1         2         3         8         2         3\n";
    out += "         2         4         0         1\n";
    out += "  2.70000e+01  1.00000e+00  1.00000e-02  0.00000e+00\n";
    for node in [1001, 1002] {
        out += &format!("{node:>10}\n  1.00000e+00  0.00000e+00  0.00000e+00\n");
    }
    out += "    -1\n";
    out
}

/// The rig's file with texts replaced.
fn changed_rig(folder: &tempfile::TempDir, name: &str, changes: &[(&str, &str)]) -> String {
    let rig = Path::new(env!("CARGO_MANIFEST_DIR")).join(RIG);
    let mut text = std::fs::read_to_string(rig).unwrap();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    file(folder, name, &text)
}

#[test]
fn noisy_frfs_identify_the_housings_but_not_the_bearings() {
    let folder = tempfile::tempdir().unwrap();
    // A separate material for the bearings, so that their stiffness is a parameter of its own.
    let own =
        "[material.bearing_steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\n[shaft] ";
    let bearing = [
        "designation = \"6205\"\nmaterial = \"steel\"",
        "designation = \"6205\"\nmaterial = \"bearing_steel\"",
    ];
    let rig = changed_rig(&folder, "rig.toml", &[("[shaft] ", own), (bearing[0], bearing[1])]);
    let out = folder.path().join("test");
    let mut test = rotordyn();
    test.args(["frf", &rig, "--no-figures", "--noise", "40 dB", "--averages", "10", "--seed", "1", "--out"])
        .arg(&out);
    for set in [
        "housing.A.k_x=4.2e6 N/m",
        "housing.B.k_x=4.2e6 N/m",
        "housing.A.k_y=2.1e7 N/m",
        "housing.B.k_y=2.1e7 N/m",
        "belt.drive.k_x=3e5 N/m",
        "shaft.stiffness_damping=3e-5 s",
        "bushing.disc_air.c_x=18 N s/m",
        "bushing.disc_air.c_spin=0.5 N m s/rad",
    ] {
        test.args(["--set", set]);
    }
    test.assert().success();
    let free = "housing.*.k_x,housing.*.k_y,belt.drive.k_x,material.bearing_steel.young";
    let document = json_of(
        rotordyn()
            .args(["update", &rig, "--free", free, "--band", "5 .. 300 Hz", "--measured"])
            .arg(out.join("frf_noisy.uff"))
            .arg("--out")
            .arg(folder.path().join("updated")),
    );
    println!("{:#}\niterations {}", document["parameters"], document["iterations"]);
    for (k, truth) in [(0, 4.2e6), (1, 2.1e7)] {
        let parameter = &document["parameters"][k];
        assert_eq!(parameter["identifiability"], "identifiable", "{parameter}");
        assert!((parameter["value"].as_f64().unwrap() / truth - 1.0).abs() < 0.02, "{parameter}");
    }
    assert_ne!(document["parameters"][3]["identifiability"], "identifiable", "{}", document["parameters"][3]);
    copy_figures(&folder.path().join("updated"), "noisy");
}

#[test]
fn frequency_shift_between_impact_tests_of_two_forces() {
    let folder = tempfile::tempdir().unwrap();
    let model = file(&folder, "hammer.toml", &struck_rig());
    let mut runs = Vec::new();
    for force in ["1", "200"] {
        let out = folder.path().join(format!("hit_{force}N"));
        rotordyn()
            .args(["run-up", &model, "--no-figures", "--step", "50 us", "--set"])
            .arg(format!("load.hammer.force=0, {force}, 0 N"))
            .arg("--out")
            .arg(&out)
            .assert()
            .success();
        runs.push(out.join("results.h5"));
    }
    let mut command = rotordyn();
    command.args(["validate", &model, "--band", "5 .. 300 Hz", "--out"]).arg(folder.path().join("levels"));
    for run in &runs {
        command.arg("--measured").arg(run);
    }
    let text = output_of(&mut command);
    println!("{text}");
    let document = json_of(&mut command);
    let levels = document["force_level_shifts"]["modes"].as_array().unwrap();
    println!("{:#}", document["force_level_shifts"]);
    let shifts: Vec<f64> = levels.iter().filter_map(|m| m["shifts"][0]["shift"].as_f64()).collect();
    assert!(shifts.len() >= 2, "{levels:?}");
    // The small hit gives the linear response; the large one is affected by the bearing clearance.
    let largest = shifts.iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { *b } else { a });
    assert!(largest.abs() > 2e-3, "{shifts:?}");
    assert!(text.contains("Frequency shift of the measured modes relative to the first file"), "{text}");
    copy_figures(&folder.path().join("levels"), "levels");
}

/// Copies figures to the folder given by ROTORDYN_PICTURES, for visual inspection.
fn copy_figures(from: &Path, name: &str) {
    let Some(to) = std::env::var_os("ROTORDYN_PICTURES") else { return };
    let to = PathBuf::from(to).join(name);
    std::fs::create_dir_all(&to).unwrap();
    for entry in std::fs::read_dir(from).unwrap().flatten() {
        std::fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
}
