//! Bearing-only files, and the bearings of a machine's file.

use rotordyn::model::{self, Options};

const HEAD: &str =
    "[model]\nname = \"b\"\n[bearing.front]\nmodel = \"ball\"\ndesignation = \"7205C\"\nthrust = \"+z\"\n";

#[test]
fn bearings_without_a_machine() {
    let file = model::load_bearings("b.toml", HEAD, &Options::default()).unwrap();
    assert_eq!((file.bearings.len(), file.bearings[0].0.as_str()), (1, "front"));
    assert!(file.model.is_none() && file.warnings.is_empty());
    let set = vec![("bearing.front.balls".into(), "12".into())];
    let file = model::load_bearings("b.toml", HEAD, &Options { set, ..Options::default() }).unwrap();
    assert_eq!(file.bearings[0].1.geometry.balls, 12);
}

#[test]
fn bearings_of_a_machine() {
    let text = include_str!("../../models/overhung_rig.toml");
    let file = model::load_bearings("rig.toml", text, &Options::default()).unwrap();
    assert_eq!(file.bearings.iter().map(|b| b.0.as_str()).collect::<Vec<_>>(), ["A", "B"]);
    assert_eq!(file.model.unwrap().bearings.len(), 2);
}

#[test]
fn invalid_keys_of_a_bearing_file() {
    let refusal =
        |text: &str| model::load_bearings("b.toml", text, &Options::default()).unwrap_err().to_string();
    assert_eq!(refusal(&format!("{HEAD}station = \"A\"")), "unknown key bearing.front.station");
    assert_eq!(refusal(&format!("{HEAD}[disc.a]\nmass = \"1 kg\"")), "unknown key disc");
    assert_eq!(refusal("[model]\nname = \"b\""), "the file has no ball bearing");
}
