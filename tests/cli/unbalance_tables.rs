//! Tables of the unbalance response and of static equilibrium: undamped modes, margins that the speeds do not show, headings.

use crate::{json_of, output_of, rotordyn};
use assert_cmd::Command;
use std::path::Path;

/// A disc in the middle of a shaft on bearings of stiffness 1e7 N/m with this damping; operated at 3000 rpm if `speed` is given.
fn machine(folder: &Path, diameter: &str, damping: &str, speed: &str) -> std::path::PathBuf {
    let bearing = |name: &str, axial: &str| {
        format!(
            "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"linear\"\nk_xx = \"1e7 N/m\"\nk_yy = \"1e7 N/m\"\n{axial}\
             c_xx = \"{damping}\"\nc_yy = \"{damping}\"\n"
        )
    };
    let text = format!(
        "[model]\nname = \"disc\"\n[material.s]\nyoung = \"210 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n[shaft]\n\
         element_length = \"50 mm\"\nsection = [{{ length = \"1 m\", outer_diameter = \"{diameter}\" }}]\n[station]\n\
         A = \"0 mm\"\nD = \"500 mm\"\nB = \"1 m\"\n[disc.d]\nstation = \"D\"\nmass = \"5 kg\"\n\
         polar_inertia = \"0.02 kg m^2\"\ndiametral_inertia = \"0.01 kg m^2\"\n{}{}\
         [unbalance.u]\nstation = \"D\"\nmagnitude = \"10 g mm\"\n{speed}",
        bearing("A", "k_zz = \"1e7 N/m\"\n"),
        bearing("B", "")
    );
    let path = folder.join("disc.toml");
    std::fs::write(&path, text).unwrap();
    path
}

fn command(study: &str, model: &Path, flags: &[&str]) -> Command {
    let mut command = rotordyn();
    command.arg(study).arg(model).args(flags).arg("--no-figures");
    command.arg("--out").arg(model.parent().unwrap().join("out"));
    command
}

/// Whatever the grid: the margin of an undamped mode is that of its critical speed, and what is infinite is so there.
#[test]
fn an_undamped_mode_is_infinite_at_its_critical_speed() {
    let folder = tempfile::tempdir().unwrap();
    let model = machine(folder.path(), "20 mm", "0 N s/m", "");
    let flags = ["--speed-range", "850, 858 rpm"];
    let found = json_of(&mut command("unbalance", &model, &flags));
    let unbalance = &found["unbalance"];
    assert_eq!(unbalance["peaks"], serde_json::json!([]));
    let at = unbalance["undamped"][0]["speed_rpm"].as_f64().unwrap();
    let margins = unbalance["separation_margins"].as_array().unwrap();
    let forward = margins.iter().find(|m| m["label"] == "1st bending forward").unwrap();
    let number = |key: &str| forward[key].as_f64().unwrap_or_else(|| panic!("{key}: {forward}"));
    assert_eq!((number("speed_rpm"), number("peak_rpm")), (at, at));
    assert!((number("separation_margin") - (at / 858.0 - 1.0)).abs() < 1e-9, "{forward}");
    assert_eq!(forward["assessment"], "insufficient");
    // Four tables: amplitudes, margins, bearing forces and the shaft.
    let text = output_of(&mut command("unbalance", &model, &flags));
    let place = format!("{at:.1}");
    let infinite: Vec<&str> = text.lines().filter(|line| line.contains("infinite")).collect();
    assert_eq!(infinite.len(), 7 + 1 + 2 + 1, "{text}");
    assert!(infinite.iter().all(|line| line.contains(&place)), "{place}: {text}");
    assert!(!text.contains("largest bending moment"), "{text}");

    let found = json_of(&mut command("frf", &model, &["--max-frequency", "50 Hz"]));
    let at = found["frf"]["undamped"][0]["frequency_hz"].as_f64().unwrap();
    let text = output_of(&mut command("frf", &model, &["--max-frequency", "50 Hz"]));
    let infinite: Vec<&str> = text.lines().filter(|line| line.contains("infinite")).collect();
    assert!(!infinite.is_empty() && infinite.iter().all(|line| line.contains(&format!("{at:.4}"))), "{text}");
}

/// A response that ends below a critical speed whose margin counts does not show it, and says so.
#[test]
fn a_critical_speed_outside_the_response_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let run = "[speed]\nprofile = \"constant\"\nspeed = \"3000 rpm\"\nduration = \"1 s\"\n";
    let model = machine(folder.path(), "40 mm", "500 N s/m", run);
    let critical = json_of(&mut command("unbalance", &model, &[]));
    let margins = critical["unbalance"]["separation_margins"].as_array().unwrap();
    let forward = margins.iter().find(|m| m["label"] == "1st bending forward").unwrap();
    let at = forward["speed_rpm"].as_f64().unwrap();
    assert!((3050.0..3700.0).contains(&at), "the machine is to have its critical speed there: {at}");
    let named = |flags: &[&str]| -> Vec<String> {
        let found = json_of(&mut command("unbalance", &model, flags));
        let warnings = found["warnings"].as_array().unwrap();
        let of_range = warnings.iter().filter(|w| w["code"] == "margin-range");
        of_range.map(|w| w["text"].as_str().unwrap().to_string()).collect()
    };
    assert!(named(&[]).is_empty());
    for top in ["3020 rpm", "2500 rpm"] {
        let found = named(&["--max-speed", top]);
        assert_eq!(found.len(), 1, "{top}: {found:?}");
        assert!(found[0].contains(&format!("1st bending forward at {at:.1} rpm")), "{found:?}");
    }
    // Above a range that is wide enough none is missed.
    assert!(named(&["--max-speed", "3800 rpm"]).is_empty());
}

/// Amplitudes along the shaft are in one table, each speed by its reason.
#[test]
fn sections_of_the_shaft_are_written_once() {
    let folder = tempfile::tempdir().unwrap();
    let run = "[speed]\nprofile = \"constant\"\nspeed = \"3000 rpm\"\nduration = \"1 s\"\n";
    let model = machine(folder.path(), "40 mm", "500 N s/m", run);
    command("unbalance", &model, &["--csv"]).assert().success();
    let csv = folder.path().join("out/csv");
    let mut names: Vec<String> = std::fs::read_dir(&csv)
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.contains("shaft"))
        .collect();
    names.sort();
    assert_eq!(names, ["unbalance_shaft.csv", "unbalance_shaft_sections.csv"]);
    let text = std::fs::read_to_string(csv.join("unbalance_shaft_sections.csv")).unwrap();
    assert!(text.starts_with("at,z_m [m],"), "{text}");
    for reason in ["largest bending moment", "highest operating speed"] {
        assert!(text.lines().filter(|line| line.starts_with(reason)).count() > 20, "{text}");
    }
}

#[test]
fn loads_at_a_speed_are_not_called_those_at_rest() {
    let folder = tempfile::tempdir().unwrap();
    let model = machine(folder.path(), "40 mm", "500 N s/m", "");
    let text = output_of(&mut command("static", &model, &["--speed", "3000 rpm"]));
    assert!(text.contains("Shaft under static loads at 3000 rpm: largest deflection and loads"), "{text}");
    assert!(text.contains("Forces of the supports on the shaft under static loads at 3000 rpm"), "{text}");
    assert!(!text.contains("at rest"), "{text}");
    let text = output_of(&mut command("static", &model, &[]));
    assert!(text.contains("Shaft at rest: largest deflection and loads"), "{text}");
}

/// A probe's own quantity: at a circular frequency Ω a velocity is Ω, an acceleration Ω² times the displacement. The margins are
/// those of displacements whatever the probes record.
#[test]
fn probes_give_their_own_quantity() {
    let folder = tempfile::tempdir().unwrap();
    let run = "[speed]\nprofile = \"constant\"\nspeed = \"3000 rpm\"\nduration = \"1 s\"\n";
    let probe = |name: &str, quantity: &str| {
        format!("[probe.{name}]\nat = \"disc.d\"\ndirection = \"x\"\nquantity = \"{quantity}\"\n")
    };
    let [moved, all] = [
        probe("u", "displacement"),
        ["displacement", "velocity", "acceleration"].map(|of| probe(&of[..1], of)).concat(),
    ];
    let found = [moved, all].map(|probes| {
        let model = machine(folder.path(), "40 mm", "500 N s/m", &format!("{run}{probes}"));
        json_of(&mut command("unbalance", &model, &[]))["unbalance"].clone()
    });
    assert_eq!(found[0]["separation_margins"], found[1]["separation_margins"]);
    let (speeds, responses) = (&found[1]["speeds_rpm"], &found[1]["responses"]);
    let value = |response: usize, part: &str, k: usize| responses[response][part][k].as_f64().unwrap();
    let units: Vec<&str> = (0..3).map(|k| responses[k]["unit"].as_str().unwrap()).collect();
    assert_eq!(units, ["m", "m/s", "m/s^2"]);
    for k in (1..speeds.as_array().unwrap().len()).step_by(17) {
        let omega = speeds[k].as_f64().unwrap() * std::f64::consts::PI / 30.0;
        let size = |response| value(response, "re", k).hypot(value(response, "im", k));
        assert!((size(1) / (omega * size(0)) - 1.0).abs() < 1e-9, "{k}");
        assert!((size(2) / (omega * omega * size(0)) - 1.0).abs() < 1e-9, "{k}");
        // v = jΩ u
        assert!((value(1, "re", k) + omega * value(0, "im", k)).abs() < 1e-9 * size(1), "{k}");
    }
}
