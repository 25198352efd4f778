//! Pull of belts at equilibrium: printed by `check` and `static`, with a warning when little remains.

use crate::{json_of, output_of, rotordyn};

/// A rigid rotor in a block on springs, its pulley in the middle between two equal bearings of 4e6 N/m together.
fn model(mount: f64, constant: bool, more: &str) -> String {
    format!(
        r#"[model]
name = "block"
gravity = "0 m/s^2"
[rotor]
length = "0.5 m"
outer_diameter = "40 mm"
mass = "5 kg"
centre = "0 m"
[station]
A = "-0.2 m"
pulley = "0 m"
B = "0.2 m"
[body.block]
mass = "30 kg"
position = "0, 0, 0 m"
inertia = "0.5, 0.5, 0.5 kg m^2"
[bearing.A]
model = "linear"
station = "A"
housing = "body.block"
k_xx = "2e6 N/m"
k_yy = "2e6 N/m"
k_zz = "2e6 N/m"
[bearing.B]
model = "linear"
station = "B"
housing = "body.block"
k_xx = "2e6 N/m"
k_yy = "2e6 N/m"
[bushing.mount]
between = ["body.block", "ground"]
k_x = "{mount} N/m"
k_y = "{mount} N/m"
k_z = "{mount} N/m"
k_tilt = "1e6 N m/rad"
k_spin = "1e6 N m/rad"
[belt.main]
station = "pulley"
pull = "0, -400 N"
k_x = "3e4 N/m"
k_y = "5e5 N/m"
constant_pull = {constant}
{more}
[drive]
kind = "prescribed"
station = "A"
[study.static]
"#
    )
}

/// Share of the pull that remains: 1/(1 + k s) with the compliance s of bearings and mount in series.
fn share(mount: f64) -> f64 {
    1.0 / (1.0 + 5e5 * (1.0 / 4e6 + 1.0 / mount))
}

#[test]
fn remaining_pull_is_printed_and_a_loss_is_reported() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("block.toml");
    let load = "[load.up]\nat = \"pulley\"\nforce = \"0, -900, 0 N\"\n";
    // The load adds its own displacement and takes 900 k s/(1 + k s) of the pull.
    for (mount, constant, more, expected) in [
        (5e6, false, "", share(5e6)),
        (2e5, false, "", share(2e5)),
        (2e5, true, "", 1.0),
        (2e5, false, load, share(2e5) - 900.0 / 400.0 * (1.0 - share(2e5))),
    ] {
        std::fs::write(&path, model(mount, constant, more)).unwrap();
        let run = |command: &str| {
            let mut run = rotordyn();
            run.arg(command).arg(&path);
            if command == "static" {
                run.args(["--no-figures", "--out"]).arg(folder.path().join("out"));
            }
            run
        };
        let what = format!("mount {mount}, constant {constant}, {more}");
        let statics = json_of(&mut run("static"));
        let check = json_of(&mut run("check"));
        for belts in [&statics["equilibrium"]["belts"], &check["variants"][0]["belts"]] {
            assert_eq!(belts[0]["name"], "main");
            assert_eq!(belts[0]["stated_pull_n"][1], -400.0);
            let found = belts[0]["remaining_share"].as_f64().unwrap();
            assert!((found - expected).abs() < 1e-7, "{what}: {found}, {expected} expected");
            let pull = belts[0]["pull_n"][1].as_f64().unwrap();
            assert!((pull + 400.0 * expected).abs() < 1e-4, "{what}: {pull}");
        }
        let text = output_of(&mut run("check"));
        assert!(text.contains("Belt pull on the shaft at equilibrium"), "{text}");
        assert!(text.contains(&format!("{:.1}", 100.0 * expected)), "{what}:\n{text}");
        let wanted = match expected {
            share if share <= 0.0 => Some("belt.main is slack".to_string()),
            share if share < 0.8 => Some(format!("belt.main keeps {:.0} % of its pull", 100.0 * share)),
            _ => None,
        };
        for document in [&statics, &check] {
            let warnings = document["warnings"].to_string();
            assert_eq!(warnings.contains("belt.main"), wanted.is_some(), "{what}: {warnings}");
            assert!(wanted.as_ref().is_none_or(|text| warnings.contains(text)), "{what}: {warnings}");
        }
    }
}

/// The rig on a rigid foundation is plausible: no warning; on its block on springs the belt keeps 38 %.
#[test]
fn belt_of_the_rig_on_its_block_loses_its_pull() {
    let check = json_of(rotordyn().args(["check", "models/overhung_rig.toml", "--variant", "base"]));
    let share = check["variants"][0]["belts"][0]["remaining_share"].as_f64().unwrap();
    assert!(share > 0.8 && share < 1.0, "{share}");
    let warnings = check["warnings"].as_array().unwrap();
    let [only] = &warnings.iter().filter(|w| w["code"] == "belt-pull").collect::<Vec<_>>()[..] else {
        panic!("{warnings:?}")
    };
    assert_eq!(only["item"], "belt.drive");
    assert!(only["text"].as_str().unwrap().starts_with("block: belt.drive keeps"), "{only}");
}
