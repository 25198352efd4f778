//! The rig of the models, for benchmarks.

use rotordyn::model::{Options, load};
use rotordyn::study::Machine;

pub fn rig(variant: Option<&str>) -> Machine {
    let options = Options { variant: variant.map(String::from), ..Options::default() };
    let text = include_str!("../../models/overhung_rig.toml");
    let loaded = load("overhung_rig.toml", text, &options).expect("the rig's file is valid");
    Machine::new(loaded.model).expect("the rig has an equilibrium")
}
