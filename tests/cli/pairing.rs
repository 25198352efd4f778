//! `compare`, speeds beyond a bearing's table and resonance peaks, at the command line.

use super::{json_of, output_of, rotordyn};

const MODEL: &str = "models/two_disc_pedestals.toml";

/// The diagrams over speed are computed too, and not looked at here.
const FEW_SPEEDS: [&str; 6] = [
    "--set",
    "study.campbell.speeds=[\"0 rpm\", \"3000 rpm\"]",
    "--set",
    "study.unbalance.speeds=[\"1000 rpm\", \"3000 rpm\"]",
    "--set",
    "study.frf.frequencies=[\"10 Hz\", \"100 Hz\"]",
];

fn compared(min_mac: Option<&str>, folder: &std::path::Path) -> serde_json::Value {
    let mut command = rotordyn();
    command.args(["compare", MODEL, "--variants", "base,stiff_pedestals", "--no-figures", "--modes", "16"]);
    command.args(FEW_SPEEDS).args(["--speed", "0, 1200 rpm", "--out"]).arg(folder);
    if let Some(limit) = min_mac {
        command.args(["--min-mac", limit]);
    }
    json_of(&mut command)
}

/// Rows (pairs, modes without a pair) of a comparison; every pair is above its limit, every other row says why.
fn pairs(document: &serde_json::Value, limit: f64) -> (usize, usize) {
    let (mut paired, mut alone) = (0, 0);
    assert_eq!(document["min_pair_mac"].as_f64(), Some(limit));
    for row in document["speeds"].as_array().unwrap().iter().flat_map(|s| s["modes"].as_array().unwrap()) {
        let found = row["frequency_hz"].as_array().unwrap().iter().filter(|f| !f.is_null()).count();
        let unpaired = row["unpaired"].as_array().unwrap();
        assert_eq!(found + unpaired.len(), 2);
        if found == 2 {
            assert!(row["min_mac"].as_f64().unwrap() >= limit, "{row}");
            paired += 1;
        } else {
            assert!(row["min_mac"].is_null() && unpaired[0]["variant"].is_string(), "{row}");
            assert!((0.0..=1.0).contains(&unpaired[0]["best_mac"].as_f64().unwrap()));
            assert!(unpaired[0]["best_frequency_hz"].as_f64().unwrap() > 0.0);
            alone += 1;
        }
    }
    (paired, alone)
}

#[test]
fn compare_pairs_no_modes_below_the_limit() {
    let folder = tempfile::tempdir().unwrap();
    let by_default = pairs(&compared(None, folder.path()), 0.5);
    let loose = pairs(&compared(Some("0.05"), folder.path()), 0.05);
    let strict = pairs(&compared(Some("0.99"), folder.path()), 0.99);
    assert!(strict.0 < by_default.0 && by_default.0 < loose.0, "{strict:?} {by_default:?} {loose:?}");
    // Two speeds and 16 modes each: a pair takes two modes, the others one.
    for (paired, alone) in [by_default, loose, strict] {
        assert_eq!(2 * paired + alone, 64);
    }
    let mut command = rotordyn();
    command.args(["compare", MODEL, "--variants", "base,stiff_pedestals", "--no-figures", "--modes", "16"]);
    command.args(FEW_SPEEDS).arg("--out");
    let text = output_of(command.arg(folder.path()));
    assert!(text.contains("stiff_pedestals: no pair, best MAC 0."), "{text}");
    command.args(["--min-mac", "1.5"]).assert().code(2);
}

/// The Jeffcott rotor on a bearing tabulated up to 2500 rpm.
#[test]
fn studies_beyond_a_table_warn_or_fail() {
    let folder = tempfile::tempdir().unwrap();
    let run = |study: &str, beyond: &str| {
        let mut command = rotordyn();
        command.args([
            study,
            "models/jeffcott.toml",
            "--no-figures",
            "--set",
            "bearing.B.speed=\"0, 2500 rpm\"",
        ]);
        command
            .args(["--set", "bearing.B.k_xx=\"2e7, 5e6 N/m\"", "--set", beyond, "--out"])
            .arg(folder.path());
        command
    };
    for study in ["modal", "campbell", "critical", "unbalance", "run-up"] {
        let held = json_of(&mut run(study, "bearing.B.beyond_table=\"hold\""));
        let warnings: Vec<&str> =
            held["warnings"].as_array().unwrap().iter().filter_map(|w| w["text"].as_str()).collect();
        let named = |w: &&str| w.contains("bearing B: its table covers 0 to 2500 rpm") && w.contains(study);
        assert_eq!(warnings.iter().filter(|w| named(w)).count(), 1, "{study}: {warnings:?}");
        let refused = run(study, "bearing.B.beyond_table=\"refuse\"").arg("--json").assert().code(3);
        let output = String::from_utf8(refused.get_output().stdout.clone()).unwrap();
        assert!(output.contains("bearing B: its table covers 0 to 2500 rpm"), "{study}: {output}");
    }
    // Standstill lies within the table, and a constant bearing has none.
    let frf = json_of(&mut run("frf", "bearing.B.beyond_table=\"refuse\""));
    assert_eq!(frf["warnings"].as_array().unwrap().len(), 0);
    let mut command = rotordyn();
    command.args(["check", "models/jeffcott.toml", "--set", "bearing.B.beyond_table=\"refuse\""]);
    let output = command.assert().code(2).get_output().stderr.clone();
    assert!(String::from_utf8(output).unwrap().contains("speed"));
    let mut command = rotordyn();
    command.args(["check", "models/jeffcott.toml", "--set", "bearing.B.speed=\"0, 2500 rpm\""]);
    command.args(["--set", "bearing.B.beyond_table=\"guess\""]).assert().code(2);
}

/// Amplitudes |X| of the first probe.
fn amplitudes(document: &serde_json::Value) -> Vec<f64> {
    let part = |key: &str| -> Vec<f64> {
        let list = document["unbalance"]["responses"][0][key].as_array().unwrap();
        list.iter().map(|v| v.as_f64().unwrap_or(f64::INFINITY)).collect()
    };
    part("re").iter().zip(part("im")).map(|(re, im)| re.hypot(im)).collect()
}

/// The largest amplitude does not depend on the grid, and the peak is described.
#[test]
fn unbalance_peaks_do_not_depend_on_the_grid() {
    let folder = tempfile::tempdir().unwrap();
    let run = |speeds: &str, refine: bool| {
        let mut command = rotordyn();
        command
            .args(["unbalance", "models/jeffcott.toml", "--no-figures", "--set"])
            .arg(format!("study.unbalance.speeds={speeds}"));
        command.args(["--set", &format!("study.unbalance.refine={refine}"), "--out"]).arg(folder.path());
        json_of(&mut command)
    };
    let largest = |document: &serde_json::Value| amplitudes(document).into_iter().fold(0.0, f64::max);
    // Every hundredth of a rev/min about the resonance.
    let brute_force = largest(&run("{ from = \"1540 rpm\", to = \"1560 rpm\", step = \"0.01 rpm\" }", false));
    for speeds in [
        "{ from = \"20 rpm\", to = \"4000 rpm\", step = \"20 rpm\" }",
        "{ from = \"100 rpm\", to = \"4000 rpm\", step = \"390 rpm\" }",
    ] {
        let document = run(speeds, true);
        let error = largest(&document) / brute_force - 1.0;
        assert!(error.abs() < 1e-3, "{speeds}: {error:e}");
        let peaks = document["unbalance"]["peaks"].as_array().unwrap();
        let peak = peaks.iter().find(|p| p["response"] == "disc_x").unwrap();
        let number = |key: &str| peak[key].as_f64().unwrap();
        assert!((number("amplitude") / brute_force - 1.0).abs() < 1e-3, "{peak}");
        let [low, high] = [0, 1].map(|k| peak["half_power_rpm"][k].as_f64().unwrap());
        assert!((number("amplification_factor") - number("speed_rpm") / (high - low)).abs() < 1e-6);
        // Against the profile's 3000 rpm.
        assert_eq!(document["unbalance"]["operating_speed_rpm"].as_f64().map(f64::round), Some(3000.0));
        assert!((number("separation_margin") - (1.0 - number("speed_rpm") / 3000.0)).abs() < 1e-9);
        assert_eq!(document["warnings"].as_array().unwrap().len(), 0);
    }
    let requested = run("{ from = \"100 rpm\", to = \"4000 rpm\", step = \"390 rpm\" }", false);
    assert_eq!(amplitudes(&requested).len(), 11);
}

/// Without any damping the response at the critical speed is called infinite, in text and JSON.
#[test]
fn undamped_peaks_are_called_infinite() {
    let folder = tempfile::tempdir().unwrap();
    let undamped = |study: &str| {
        let mut command = rotordyn();
        command.args([study, "models/jeffcott.toml", "--set", "damping.modal.ratio=0"]);
        for key in ["A.c_xx", "A.c_yy", "B.c_xx", "B.c_yy"] {
            command.args(["--set", &format!("bearing.{key}=\"0 N s/m\"")]);
        }
        command.arg("--out").arg(folder.path());
        command
    };
    for (study, key) in [("unbalance", "unbalance"), ("frf", "frf")] {
        let document = json_of(&mut undamped(study));
        let warnings = document["warnings"].as_array().unwrap();
        let named = |w: &&serde_json::Value| {
            w["text"].as_str().is_some_and(|w| w.contains("is undamped") && w.contains("1st bending"))
        };
        assert_eq!(warnings.iter().filter(named).count(), 1, "{study}: {warnings:?}");
        assert_eq!(document[key]["undamped"].as_array().unwrap().len(), warnings.len());
        let text = output_of(&mut undamped(study));
        assert!(text.contains("infinite"), "{study}: {text}");
    }
    // Exactly at the critical speed.
    let document = json_of(&mut undamped("unbalance"));
    let critical = document["unbalance"]["undamped"][0]["speed_rpm"].as_f64().unwrap();
    let mut command = undamped("unbalance");
    command.args(["--set", &format!("study.unbalance.speeds=[\"{critical:.9} rpm\"]")]);
    let found = json_of(&mut command);
    assert!(amplitudes(&found)[0].is_infinite(), "{}", found["unbalance"]);
}
