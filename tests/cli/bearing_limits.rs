//! Limits of ball bearings: warned of exactly where their criterion says, in `bearing` and in every study.

use crate::{json_of, rotordyn};
use serde_json::Value;

fn found(model: &str, command: &str, more: &[&str]) -> (Vec<String>, Value) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("machine.toml");
    std::fs::write(&path, model).unwrap();
    let mut run = rotordyn();
    run.arg(command).arg(&path).args(more).args(["--no-figures", "--out"]).arg(folder.path().join("out"));
    let document = json_of(&mut run);
    let warnings = document["warnings"].as_array().unwrap().iter();
    (warnings.map(|w| w.as_str().unwrap().to_string()).collect(), document)
}

fn alone(designation: &str, keys: &str) -> String {
    let thrust = if designation.starts_with('7') { "thrust = \"+z\"" } else { "" };
    format!(
        "[model]\nname = \"alone\"\n[bearing.A]\nmodel = \"ball\"\ndesignation = \"{designation}\"\n{thrust}\n{keys}\n"
    )
}

fn has(warnings: &[String], text: &str) -> bool {
    warnings.iter().any(|w| w.contains(text))
}

#[test]
fn angular_contact_row_without_thrust_slides() {
    let of = |load: &str| {
        let flags =
            ["--load", load, "--constrain", "theta_x,theta_y", "--speed", "1500 rpm", "--sweep", "speed"];
        found(&alone("7206B", "ball_inertia = \"none\""), "bearing", &flags)
    };
    // 1000 N needs 1.25 · 1000 N · tan 40° for half the balls; a twentieth of it leaves none at its angle.
    let (radial, document) = of("0, -1000, 20 N");
    assert!(has(&radial, "slides") && has(&radial, "instead of 40 deg"), "{radial:?}");
    let state = &document["bearings"][0]["operating"];
    let angles = |of: &Value| -> Vec<f64> {
        let balls = of["balls"].as_array().unwrap().iter();
        let loaded = balls.filter(|b| b["inner"]["load"].as_f64().unwrap() > 0.0);
        loaded.map(|b| b["inner"]["contact_angle"].as_f64().unwrap().to_degrees().abs()).collect()
    };
    assert!(angles(state).iter().all(|angle| *angle < 20.0), "{:?}", angles(state));
    let (combined, document) = of("0, -1000, 1100 N");
    assert!(!has(&combined, "slides"), "{combined:?}");
    assert!(angles(&document["bearings"][0]["operating"]).iter().all(|angle| *angle > 30.0));
}

/// p₀ ∝ Q^{1/3}: the warning comes between the loads at which the largest pressure passes 4.2 GPa.
#[test]
fn pressure_above_the_static_rating() {
    let at = |load: f64| {
        let load = format!("0, -{load}, 0 N");
        let (warnings, document) = found(
            &alone("6206", "radial_clearance = \"0 um\"\nball_inertia = \"none\""),
            "bearing",
            &["--load", &load, "--sweep", "speed"],
        );
        let pressure = document["bearings"][0]["operating"]["largest_pressure"].as_f64().unwrap();
        assert_eq!(has(&warnings, "above the 4.2 GPa"), pressure > 4.2e9, "{pressure} {warnings:?}");
        pressure
    };
    let first = at(2000.0);
    let limit = 2000.0 * (4.2e9 / first).powi(3);
    assert!(at(0.9 * limit) < 4.2e9 && at(1.1 * limit) > 4.2e9);
}

/// 0.025 (ν n/1000)^{2/3} (d_m/100)² kN with unloaded balls, by hand for a 6206 with an oil of 30 mm²/s.
#[test]
fn load_below_the_minimum_load() {
    let oil = "[lubricant.oil]\nviscosity = \"0.0261 Pa s\"\ndensity = \"870 kg/m^3\"\npressure_viscosity = \"2e-8 1/Pa\"\n";
    let model =
        alone("6206", "lubricant = \"oil\"\nradial_clearance = \"10 um\"\nball_inertia = \"none\"") + oil;
    let pitch = 46.0f64;
    let minimum = 25.0 * (30.0 * 6000.0 / 1e3f64).powf(2.0 / 3.0) * (pitch / 100.0).powi(2);
    for (share, below) in [(0.7, true), (1.4, false)] {
        let load = format!("0, -{}, 0 N", share * minimum);
        let flags = ["--load", &load, "--speed", "6000 rpm", "--sweep", "speed"];
        let (warnings, document) = found(&model, "bearing", &flags);
        let d = document["bearings"][0]["operating"]["orders"].to_string();
        assert_eq!(has(&warnings, "below the minimum load"), below, "{share} {minimum} {warnings:?} {d}");
    }
    // Axially loaded, no ball is unloaded.
    let flags = ["--load", "0, 0, 60 N", "--speed", "6000 rpm", "--sweep", "speed"];
    assert!(!has(&found(&model, "bearing", &flags).0, "minimum"), "axial");
}

/// A spindle bearing pair at its usual preload and speed parameter (n d_m = 1.1e6 mm/min).
#[test]
fn preloaded_spindle_pair_has_no_warning() {
    let keys = "arrangement = \"back_to_back\"\nrow_spacing = \"20 mm\"\npreload = { force = \"400 N\" }";
    let model = alone("7014C", keys).replace("thrust = \"+z\"\n", "");
    let flags = ["--load", "0, -100, 0 N", "--speed", "12000 rpm", "--sweep", "load"];
    let (warnings, _) = found(&model, "bearing", &flags);
    assert!(warnings.is_empty(), "{warnings:?}");
}

/// Balls on the unloaded side touch the outer race alone: they are not loaded, and the count does not depend on
/// the inertia at low speed.
#[test]
fn balls_held_by_centrifugal_force_are_not_loaded() {
    let loaded = |inertia: &str, speed: &str| {
        let model = alone("6206", &format!("radial_clearance = \"12 um\"\nball_inertia = \"{inertia}\""));
        let (_, document) =
            found(&model, "bearing", &["--load", "0, -900, 0 N", "--speed", speed, "--sweep", "speed"]);
        document["bearings"][0]["operating"]["loaded_balls"].as_f64().unwrap()
    };
    let massless = loaded("none", "600 rpm");
    assert!(massless < 9.0);
    assert_eq!(loaded("outer_race_control", "600 rpm"), massless);
    assert!(loaded("outer_race_control", "12000 rpm") < 9.0);
}

/// The balls of a lightly loaded fast bearing slide under their gyroscopic moment; 0.4 F_c sin α_o/Q_o by hand.
#[test]
fn gyroscopic_sliding_at_light_load() {
    let at = |load: &str| {
        let model = alone("7206B", "ball_inertia = \"outer_race_control\"");
        let flags = ["--load", load, "--speed", "16000 rpm", "--sweep", "speed"];
        let (warnings, document) = found(&model, "bearing", &flags);
        let state = &document["bearings"][0]["operating"];
        let ball = &state["balls"][0]["outer"];
        let (load, angle) = (ball["load"].as_f64().unwrap(), ball["contact_angle"].as_f64().unwrap());
        let g = &document["bearings"][0];
        let cage = state["ftf"].as_f64().unwrap() * 16000.0 * std::f64::consts::PI / 30.0;
        (warnings, load, angle, cage, g.clone())
    };
    for load in ["0, 0, 60 N", "0, 0, 4000 N"] {
        let (warnings, load, angle, cage, _) = at(load);
        let (diameter, pitch) = (9.525e-3, 46e-3);
        let mass = 7850.0 * std::f64::consts::PI / 6.0 * f64::powi(diameter, 3);
        let needed = 0.4 * 0.5 * mass * pitch * cage * cage * angle.sin() / load;
        println!("{needed} {warnings:?}");
        assert!((needed - 0.07f64).abs() > 0.01);
        assert_eq!(has(&warnings, "gyroscopic moment"), needed > 0.07, "{needed} {warnings:?}");
    }
}

/// The linear studies of a machine warn as `bearing` does.
#[test]
fn fitted_law_outside_its_range_in_a_linear_study() {
    let of = |variant: &str| {
        let folder = tempfile::tempdir().unwrap();
        let mut run = rotordyn();
        run.args(["modal", "models/zhang_2016.toml", "--variant", variant, "--no-figures", "--out"]);
        let document = json_of(run.arg(folder.path()));
        document["warnings"].to_string()
    };
    let outside = of("dry10");
    assert!(
        outside.contains("bearing A") && outside.contains("outside the range 600 to 2000 N"),
        "{outside}"
    );
}
