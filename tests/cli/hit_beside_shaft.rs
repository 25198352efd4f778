//! A tangential hit at the rim of the disc, positioned by the mapping: it excites torsion, and the FRFs match the model.

use crate::{json_of, rotordyn};

const RIG: &str = "models/overhung_rig.toml";

#[test]
fn mapping_positions_a_hit_off_the_shaft_axis() {
    let folder = tempfile::tempdir().unwrap();
    let (test, mapping) = (folder.path().join("test"), folder.path().join("points.toml"));
    rotordyn()
        .args([
            "frf",
            RIG,
            "--no-figures",
            "--noise",
            "60 dB",
            "--set",
            "study.frf.excitation.rim.direction=y",
        ])
        .arg("--out")
        .arg(&test)
        .assert()
        .success();
    // The file's own coordinates place it as well.
    let mut command = rotordyn();
    command.args(["validate", RIG, "--no-figures", "--band", "5 .. 300 Hz", "--measured"]);
    let document =
        json_of(command.arg(test.join("frf_noisy.uff")).arg("--out").arg(folder.path().join("own")));
    let frac = document["measured"][0]["frac"].as_array().unwrap();
    assert!(frac.len() == 8 && frac.iter().all(|row| row.as_array().unwrap().len() == 2), "{frac:?}");
    for value in frac.iter().flat_map(|row| row.as_array().unwrap()) {
        // What a force does not move has none.
        assert!(value.as_f64().is_none_or(|f| f > 0.999), "{frac:?}");
    }
    let mut text = String::new();
    let responses = [
        ("disc_x", "disc.main", "x"),
        ("disc_y", "disc.main", "y"),
        ("disc_twist", "disc.main", "theta_z"),
        ("B_ay", "housing.B", "y"),
    ];
    for (name, station, direction) in responses {
        let rim = "{ station = \"disc.main\", offset = \"150, 0, 0 mm\", direction = \"y\" }";
        text += &format!(
            "[channel.\"{name}/rim\"]\nstation = \"{station}\"\ndirection = \"{direction}\"\nreference = {rim}\n\n"
        );
    }
    std::fs::write(&mapping, text).unwrap();
    let mut command = rotordyn();
    command.args(["validate", RIG, "--no-figures", "--band", "5 .. 300 Hz", "--measured"]);
    command.arg(test.join("frf_noisy.uff")).arg("--mapping").arg(&mapping);
    let document = json_of(command.arg("--out").arg(folder.path().join("out")));
    let measured = &document["measured"][0];
    let torsion =
        measured["modes"].as_array().unwrap().iter().find(|m| m["label"] == "1st torsional").unwrap();
    assert!(torsion["error"].as_f64().unwrap().abs() < 2e-3, "{torsion}");
    // The rig held against itself: what is left is noise.
    let frac: Vec<f64> =
        measured["frac"].as_array().unwrap().iter().map(|row| row[0].as_f64().unwrap_or(f64::NAN)).collect();
    println!("{frac:?} {torsion}");
    assert_eq!(frac.len(), 4);
    // A hit along y at x = 150 mm moves the disc along y and turns it.
    assert!(frac[1..].iter().all(|f| *f > 0.9999), "{frac:?}");
}
