//! `import`: model files from rotors that ROSS saved.

use crate::{json_of, output_of, rotordyn};
use std::path::Path;

const ROTORS: &str = "tests/data/ross/rotors";

/// The message of a command that must end with exit code 2.
fn message_of(args: &[&str], folder: &Path) -> String {
    let run = rotordyn().current_dir(folder).args(args).assert().code(2);
    String::from_utf8_lossy(&run.get_output().stderr).into_owned()
}

#[test]
fn import_writes_a_file_that_check_reads() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("machine.toml");
    let from = format!("{ROTORS}/unequal_supports.json");
    let document = json_of(rotordyn().args(["import", &from, "-o"]).arg(&file));
    assert_eq!(document["ross_version"], "3.1.0");
    assert_eq!(document["not_carried"], serde_json::json!([]));
    let carried = document["carried"].as_array().unwrap();
    let of = |what: &str| carried.iter().find(|row| row["what"] == what).map(|row| row["count"].clone());
    assert_eq!(of("ShaftElement"), Some(6.into()));
    assert_eq!(of("PointMass with a node of its own"), Some(2.into()));
    let check = json_of(rotordyn().arg("check").arg(&file));
    assert_eq!(check["warnings"], serde_json::json!([]));
    assert_eq!(check["variants"][0]["rigid_body_modes"], serde_json::json!([]));
    let text = std::fs::read_to_string(&file).unwrap();
    for part in
        ["mass = \"12, 18, 25 kg\"", "k_xy = \"1e6 N/m\"", "# DiskElement_Disk 0", "[joint.point_mass_0]"]
    {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

#[test]
fn import_prints_both_tables_and_keeps_an_existing_file() {
    let folder = tempfile::tempdir().unwrap();
    let from = std::fs::canonicalize(format!("{ROTORS}/results_rotor_with_clearances.json")).unwrap();
    let args = ["import", from.to_str().unwrap()];
    let run = rotordyn().current_dir(folder.path()).args(args).assert().success();
    let printed = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
    for part in [
        "[[shaft.section]]",
        "Not carried over",
        "radial_clearance",
        "results_rotor_with_clearances_machine.toml",
    ] {
        assert!(printed.contains(part), "{part} is not in\n{printed}");
    }
    let warned = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(warned.contains("warning[not-imported]"), "{warned}");
    assert!(message_of(&args, folder.path()).contains("--force"));
    rotordyn().current_dir(folder.path()).args(args).args(["--force", "--strict"]).assert().code(5);
    let text = output_of(rotordyn().current_dir(folder.path()).args(args).args(["-o", "-"]));
    assert!(
        text.starts_with("# Imported from results_rotor_with_clearances.json, saved by ROSS 3.1.0"),
        "{text}"
    );
}

#[test]
fn what_is_no_rotor_is_told_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let rotor = std::fs::read_to_string(format!("{ROTORS}/example_rotor.toml")).unwrap();
    let spoiled = |from: &str, to: &str| rotor.replacen(from, to, 1);
    for (text, parts) in [
        (spoiled("odl = 0.05\n", ""), ["ShaftElement_Shaft Element 0: odl is missing", "a number"]),
        (spoiled("L = 0.25", "L = -0.25"), ["L is -0.25", "greater than zero"]),
        (spoiled("L = 0.25", "L = \"long\""), ["L is \"long\"", "a finite number"]),
        (spoiled("n = 1\n", "n = 7\n"), ["no element at node 1", "coaxial"]),
        (spoiled("n = 2\nm =", "n = 20\nm ="), ["node 20 is not on the shaft", "from 0 to 6"]),
        (spoiled("idl = 0.0", "idl = 0.06"), ["inner diameters", "less than the outer"]),
        ("{\"a\": 1".into(), ["not JSON", "saved by ROSS"]),
        ("[model]\nname = \"own\"\n".into(), ["no shaft element of ROSS", "Rotor.save"]),
    ] {
        std::fs::write(folder.path().join("rotor.toml"), text).unwrap();
        let message = message_of(&["import", "rotor.toml", "-o", "out.toml"], folder.path());
        for part in parts {
            assert!(message.contains(part), "`{part}` is not in\n{message}");
        }
        assert!(!folder.path().join("out.toml").exists());
    }
}

#[test]
fn two_shafts_and_unknown_elements_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let from = std::fs::canonicalize(format!("{ROTORS}/v2_coaxial.json")).unwrap();
    let message = message_of(&["import", from.to_str().unwrap(), "-o", "out.toml"], folder.path());
    assert!(message.contains("coaxial"), "{message}");
    let rotor = std::fs::read_to_string(format!("{ROTORS}/example_rotor.toml")).unwrap();
    let with_motor = format!("{rotor}\n[\"MotorElement_motor\"]\nn = 3\n");
    std::fs::write(folder.path().join("rotor.toml"), with_motor).unwrap();
    let run =
        rotordyn().current_dir(folder.path()).args(["import", "rotor.toml", "--json", "--quiet"]).assert();
    let document: serde_json::Value = serde_json::from_slice(&run.success().get_output().stdout).unwrap();
    assert_eq!(document["not_carried"][0]["item"], "MotorElement_motor");
    assert_eq!(document["warnings"][0]["code"], "not-imported");
}
