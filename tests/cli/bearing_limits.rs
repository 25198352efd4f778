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
    (warnings.map(|w| w["text"].as_str().unwrap().to_string()).collect(), document)
}

fn alone(designation: &str, keys: &str) -> String {
    let thrust = if designation.starts_with('7') { "thrust = \"+z\"" } else { "" };
    format!(
        "[model]\nname = \"alone\"\n[bearing.A]\nmodel = \"ball\"\ndesignation = \"{designation}\"\n{thrust}\n{keys}\n"
    )
}

/// A fit too light for the speeds of a spindle.
const SPINDLE_FIT: &str =
    "fit = { shaft_interference = \"5 um\", shaft_bore = \"40 mm\", speed_growth = true }";

fn has(warnings: &[String], text: &str) -> bool {
    warnings.iter().any(|w| w.contains(text))
}

/// Quantities whose limit is exceeded, as listed.
fn exceeded(document: &Value) -> Vec<String> {
    let limits = document["bearings"][0]["limits"].as_array().unwrap();
    let exceeded = limits.iter().filter(|limit| limit["state"] == "exceeded");
    exceeded.map(|limit| limit["quantity"].as_str().unwrap().to_string()).collect()
}

/// The list of limits says "exceeded" exactly where there is a warning of it.
#[test]
fn listed_limits_and_warnings_agree() {
    const OF: [(&str, &str); 10] = [
        ("bearing-unloaded", "loaded balls"),
        ("static-load", "static safety"),
        ("static-load", "contact pressure"),
        ("shoulder", "contact ellipse"),
        ("film", "film ratio"),
        ("minimum-load", "equivalent load"),
        ("gyroscopic-sliding", "friction coefficient"),
        ("contact-angle-lost", "mean contact angle"),
        ("open-side", "balls on the open side"),
        ("loose-ring", "interference of inner ring and shaft"),
    ];
    let cases = [
        ("6206", "", "0, -1000, 0 N", "3000 rpm"),
        ("6206", "", "0, -30000, 0 N", "100 rpm"),
        ("6206", "", "0, -2, 0 N", "12000 rpm"),
        ("6206", "", "0, 0, 9000 N", "1000 rpm"),
        ("7206B", "ball_inertia = \"none\"", "0, -1000, 20 N", "1500 rpm"),
        ("7206B", "", "0, -300, 400 N", "9000 rpm"),
        ("7014C", SPINDLE_FIT, "0, -300, 400 N", "25000 rpm"),
    ];
    let mut seen = std::collections::BTreeSet::new();
    for (designation, keys, load, speed) in cases {
        let flags = ["--load", load, "--constrain", "theta_x,theta_y", "--speed", speed, "--sweep", "speed"];
        let (_, document) = found(&alone(designation, keys), "bearing", &flags);
        let warned = |code: &str| document["warnings"].as_array().unwrap().iter().any(|w| w["code"] == code);
        let listed = exceeded(&document);
        for (code, _) in OF {
            let is_listed = OF.iter().any(|(of, quantity)| {
                *of == code && listed.iter().any(|listed| listed.starts_with(quantity))
            });
            assert_eq!(is_listed, warned(code), "{designation} {load} {speed}: {code}, {listed:?}");
            seen.extend(is_listed.then_some(code));
        }
        assert!(document["bearings"][0]["limits"].as_array().unwrap().len() > 3);
    }
    assert!(seen.len() >= 3, "{seen:?}");
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

/// s_0 = C_0/P_0 with P_0 = max(X_0 F_r + Y_0 F_a, F_r) by hand, on both sides of 1; one warning names it and the pressure.
#[test]
fn static_safety_below_one() {
    // Designation, keys, X_0 and Y_0 of ISO 76, direction of the load (radial, axial).
    for (designation, keys, [x, y], [radial, axial]) in [
        ("6206", "", [0.6, 0.5], [1.0, 0.0]),
        ("6308", "", [0.6, 0.5], [0.6, 1.0]),
        ("7208B", "", [0.5, 0.26], [0.3, 1.0]),
        ("7014C", "", [0.5, 0.46], [0.5, 1.0]),
        ("6004", "static_rating = \"3 kN\"", [0.6, 0.5], [1.0, 0.1]),
    ] {
        let model = alone(designation, &format!("ball_inertia = \"none\"\n{keys}"));
        let at = |load: f64| {
            let load = format!("0, -{}, {} N", load * radial, load * axial);
            found(
                &model,
                "bearing",
                &["--load", &load, "--speed", "0 rpm", "--sweep", "cage_angle=0 deg .. 1 deg"],
            )
        };
        let (_, document) = at(100.0);
        let rating = document["bearings"][0]["rating"]["static"].as_f64().unwrap();
        let unit = (x * radial + y * axial).max(radial);
        for share in [0.93, 1.07] {
            let (warnings, document) = at(share * rating / unit);
            let state = &document["bearings"][0]["operating"];
            let safety = state["static_safety"].as_f64().unwrap();
            assert!((safety * share - 1.0).abs() < 1e-3, "{designation}: {safety}");
            let dented = state["largest_pressure"].as_f64().unwrap() > 4.2e9;
            let named: Vec<&String> =
                warnings.iter().filter(|w| w.contains("static safety") || w.contains("4.2 GPa")).collect();
            assert_eq!(
                named.len(),
                usize::from(dented || share > 1.0),
                "{designation} {share}: {warnings:?}"
            );
            if share > 1.0 {
                let numbers = format!("C_0 {rating:.0} N, P_0 {:.0} N", share * rating);
                let text = named[0];
                assert!(text.contains("s_0 = C_0/P_0 = 0.93 below 1") && text.contains(&numbers), "{text}");
                assert!(text.contains("GPa at the inner race"), "{text}");
            }
            println!("{designation} {share}: {named:?}");
        }
    }
}

/// A ball with 1 % of the largest load, which centrifugal force presses against the inner race at a steep angle, is no
/// reason to warn of the shoulder; the loaded ones are.
#[test]
fn shoulder_of_loaded_balls_only() {
    for (designation, beyond) in [("7206-B-XL", 30e3), ("7000B", 6e3)] {
        let at = |flags: &[&str]| found(&alone(designation, ""), "bearing", flags);
        let (warnings, document) = at(&[]);
        let balls = document["bearings"][0]["operating"]["balls"].as_array().unwrap().clone();
        let inner = |ball: &Value, key: &str| ball["inner"][key].as_f64().unwrap();
        let largest = balls.iter().map(|ball| inner(ball, "load")).fold(0.0, f64::max);
        let worst = balls.iter().max_by(|a, b| {
            let share = |ball: &Value| inner(ball, "fraction_beyond_shoulder");
            share(a).total_cmp(&share(b))
        });
        let worst = worst.unwrap();
        assert!(inner(worst, "fraction_beyond_shoulder") > 0.0 && inner(worst, "load") < 0.02 * largest);
        assert!(warnings.is_empty(), "{warnings:?}");
        let load = format!("0, 0, {beyond} N");
        assert!(has(&at(&["--load", &load]).0, "beyond the shoulder"), "{designation}");
    }
}

/// In the studies of a machine.
#[test]
fn static_safety_in_a_machine() {
    let folder = tempfile::tempdir().unwrap();
    let warnings = |rating: &str| {
        let mut run = rotordyn();
        run.args(["static", "models/overhung_rig.toml", "--no-figures", "--out"]).arg(folder.path());
        run.args(["--set", &format!("bearing.B.static_rating=\"{rating}\"")]);
        json_of(&mut run)["warnings"].to_string()
    };
    let low = warnings("15 N");
    assert!(
        low.contains("bearing B at standstill: static safety s_0") && !low.contains("bearing A"),
        "{low}"
    );
    assert!(!warnings("7.8 kN").contains("static safety"));
}

/// M_v = 1e-7 f_0 (ν n)^{2/3} D_pw³ N mm with f_0 of the lubrication method, M_s ∝ μ, both stated in the output.
#[test]
fn friction_by_lubrication_and_sliding_friction() {
    let oil = "[lubricant.oil]\nviscosity = \"0.0261 Pa s\"\ndensity = \"870 kg/m^3\"\npressure_viscosity = \"2e-8 1/Pa\"\n";
    let of = |designation: &str, keys: &str| {
        let model = alone(designation, &format!("lubricant = \"oil\"\n{keys}")) + oil;
        let flags = ["--load", "0, -900, 700 N", "--speed", "4000 rpm", "--sweep", "load=0 N .. 1 N"];
        let (_, document) = found(&model, "bearing", &flags);
        let state = document["bearings"][0]["operating"].clone();
        move |key: &str| state[key].as_f64().unwrap()
    };
    // Pitch diameters 46 mm (6206) and 46 mm (7206B); ν n = 30 mm²/s · 4000 rpm.
    for (designation, deep_groove) in [("6206", true), ("7206B", false)] {
        for (keys, factors) in [
            ("", [2.0, 3.3]),
            ("lubrication = \"oil_bath\"", [2.0, 3.3]),
            ("lubrication = \"oil_mist\"", [1.0, 1.7]),
            ("lubrication = \"oil_jet\"", [4.0, 6.6]),
            ("lubrication = \"grease\"", [1.35, 2.0]),
            ("lubrication = { f_0 = 0.7 }", [0.7, 0.7]),
        ] {
            let state = of(designation, keys);
            let factor = if deep_groove { factors[0] } else { factors[1] };
            let expected = 1e-10 * factor * 120e3f64.powf(2.0 / 3.0) * 46f64.powi(3);
            assert!((state("friction_torque_viscous") / expected - 1.0).abs() < 1e-9, "{designation} {keys}");
            assert_eq!(state("friction_viscous_factor"), factor);
        }
        let (by_default, rough) = (of(designation, ""), of(designation, "sliding_friction = 0.11"));
        assert_eq!((by_default("sliding_friction"), rough("sliding_friction")), (0.06, 0.11));
        let ratio = rough("friction_torque_spin") / by_default("friction_torque_spin");
        assert!((ratio - 0.11 / 0.06).abs() < 1e-9, "{ratio}");
        let torque = ["load", "viscous", "spin"].map(|part| rough(&format!("friction_torque_{part}")));
        let heat = torque.iter().sum::<f64>() * 4000.0 * std::f64::consts::PI / 30.0;
        assert!((rough("friction_heat") / heat - 1.0).abs() < 1e-9);
    }
    // Deep groove: f_1 = 5e-4 (F_s/C_0)^0.55 with F_s = 0.6 · 900 + 0.5 · 700 below F_r: 900 N.
    let (state, rating) = (of("6206", "static_rating = \"11.2 kN\""), 11.2e3);
    let f_1 = 5e-4 * (900.0f64 / rating).powf(0.55);
    assert!((state("friction_load_factor") / f_1 - 1.0).abs() < 1e-9);
    let force = 3.0 * 700.0 - 0.1 * 900.0;
    assert!((state("friction_torque_load") / (f_1 * force * 46e-3) - 1.0).abs() < 1e-9);

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("b.toml");
    let keys = "lubricant = \"oil\"\nlubrication = \"oil_jet\"\nsliding_friction = 0.08";
    std::fs::write(&path, alone("7206B", keys) + oil).unwrap();
    let mut run = rotordyn();
    run.arg("bearing").arg(&path).args(["--speed", "4000 rpm", "--no-figures", "--out"]).arg(folder.path());
    let text = crate::output_of(&mut run).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("(f_0 6.60, oil jet)") && text.contains("(sliding friction 0.0800)"), "{text}");
    assert!(text.contains("N m (f_1 "), "{text}");
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

/// Speed parameter of deep groove and of angular contact bearings beside the limits that `bearing-speed` has.
#[test]
fn speed_parameter_has_the_limit_of_the_kind() {
    for (designation, limit) in [("6205", 1.5e6), ("7205B", 2.5e6)] {
        let flags = ["--speed", "28648 rpm", "--sweep", "cage_angle=0 deg .. 1 deg"];
        let (_, document) = found(&alone(designation, ""), "bearing", &flags);
        let limits = document["bearings"][0]["limits"].as_array().unwrap();
        let speed = limits.iter().find(|limit| limit["quantity"] == "speed parameter n d_m").unwrap();
        assert!((speed["limit"].as_f64().unwrap() - limit).abs() < 1.0, "{speed}");
        assert_eq!(speed["state"], "within");
    }
}

/// What `bearing` says of a bearing alone under a load, by the names of the document.
fn operating(model: &str, load: &str) -> impl Fn(&str) -> f64 + use<> {
    let flags = ["--speed", "1000 rpm", "--sweep", "cage_angle=0 deg .. 1 deg", "--load", load];
    let (_, document) = found(model, "bearing", &flags);
    move |name| document["bearings"][0]["operating"][name].as_f64().unwrap()
}

/// P, P_0 and the load part of the friction hold the preload of a pair: they are those of two single rows under its force.
#[test]
fn preload_of_a_pair_counts_in_life_and_friction() {
    let none = "ball_inertia = \"none\"";
    for force in ["2000 N", "20000 N"] {
        let keys = format!(
            "{none}\narrangement = \"back_to_back\"\nrow_spacing = \"20 mm\"\npreload = {{ force = \"{force}\" }}"
        );
        let pair = operating(&alone("7014C", &keys).replace("thrust = \"+z\"", ""), "0, -30, 0 N");
        let row = operating(&alone("7014C", none), &format!("0, -15, {force}"));
        let ratio = |name: &str| pair(name) / row(name);
        // Both rows; L of two equal rows, 2^(-9/10).
        for (name, expected) in [("friction_torque_load", 2.0), ("basic_life", 2f64.powf(-0.9))] {
            let found = ratio(name);
            assert!((found / expected - 1.0).abs() < 0.01, "{force}: {name} {found} of {expected}");
        }
        // p ∝ Q^{1/3}, 4.2 GPa at C_0.
        let safety = pair("static_safety") / (4.2e9 / pair("largest_pressure")).powi(3);
        assert!((0.8..1.25).contains(&safety), "{force}: {safety}");
    }
}

/// Interference presses every ball: life and static safety are those of the balls' loads, the reference life of ISO/TS 16281
/// and the pressure, which the equivalent loads know nothing of.
#[test]
fn interference_counts_in_life_and_friction() {
    let of = |clearance: &str| {
        let keys = format!("radial_clearance = \"{clearance}\"\nball_inertia = \"none\"");
        operating(&alone("6205", &keys), "0, -10, 0 N")
    };
    let loose = of("10 um");
    assert!(loose("basic_life") > 1e8 && loose("static_safety") > 700.0);
    for clearance in ["-10 um", "-15 um", "-30 um"] {
        let at = of(clearance);
        let life = at("basic_life") / at("reference_life");
        assert!((0.7..1.4).contains(&life), "{clearance}: {life}");
        // p ∝ Q^{1/3}, 4.2 GPa at C_0.
        let safety = at("static_safety") / (4.2e9 / at("largest_pressure")).powi(3);
        assert!((0.7..1.4).contains(&safety), "{clearance}: {safety}");
        assert!(at("friction_torque_load") > 100.0 * loose("friction_torque_load"));
    }
}

#[test]
fn a_speed_above_that_of_its_kind_is_named_without_a_machine() {
    let flags = |speed| ["--load", "0, -500, 0 N", "--speed", speed, "--sweep", "cage_angle=0 deg .. 1 deg"];
    let warned = |speed| has(&found(&alone("6205", ""), "bearing", &flags(speed)).0, "n d_m");
    assert!(warned("60000 rpm") && !warned("30000 rpm"));
}

/// The race that is stated to control needs the friction: 2 M/D at the lighter inner contact is above what it has, where the outer
/// one would hold.
#[test]
fn sliding_is_that_of_the_controlling_race() {
    let flags = ["--load", "0, 0, 1000 N", "--speed", "12000 rpm", "--sweep", "cage_angle=0 deg .. 1 deg"];
    let slides = |control: &str| {
        let keys = format!("ball_inertia = \"{control}\"");
        has(&found(&alone("7014C", &keys), "bearing", &flags).0, "the balls slide")
    };
    assert!(
        slides("inner_race_control") && slides("harris_inner_race_control") && !slides("outer_race_control")
    );
}

#[test]
fn a_defect_narrower_than_a_contact_is_named() {
    let flags = ["--load", "0, -500, 0 N", "--speed", "1000 rpm", "--sweep", "cage_angle=0 deg .. 1 deg"];
    let warned = |width: &str| {
        let keys = format!(
            "defect = [{{ on = \"outer\", centre = \"-90 deg\", kind = \"dent\", width = \"{width}\" }}]"
        );
        has(&found(&alone("6306", &keys), "bearing", &flags).0, "narrower")
    };
    assert!(warned("1 um") && !warned("0.1 mm"));
}
