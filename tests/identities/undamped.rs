//! Machines without damping: no mode grows or decays, whatever the mesh, the speed and the stiffest element.

use rotordyn::model::{Options, load};
use rotordyn::study::Machine;

/// Modal damping whose ratio is zero above 150 Hz.
const DAMPED_BELOW: &str =
    "\n[damping.modal]\nfrequency = [\"25 Hz\", \"150 Hz\", \"10 kHz\"]\nratio = [0.01, 0.0, 0.0]\n";

/// The rotor of Nelson and McVaugh, whose modes far above the shift of the solver had real parts of 4e-9 |λ|, of either sign:
/// thresholds of stability and modes "unstable from 12500 rpm on", of a machine that nothing excites.
#[test]
fn rotors_without_damping_have_neither_growth_nor_thresholds() {
    let text = std::fs::read_to_string("models/nelson_mcvaugh.toml").unwrap();
    for (length, support) in [
        ("2 in", "4.378e7 N/m"),
        ("0.5 in", "4.378e7 N/m"),
        ("0.1 in", "4.378e7 N/m"),
        ("0.2 in", "1e12 N/m"),
    ] {
        let mut set = vec![("shaft.element_length".to_string(), format!("\"{length}\""))];
        for (bearing, direction) in [("left", "k_xx"), ("left", "k_yy"), ("right", "k_xx"), ("right", "k_yy")]
        {
            set.push((format!("bearing.{bearing}.{direction}"), format!("\"{support}\"")));
        }
        let model = load("nelson.toml", text.clone(), &Options { variant: None, set }).unwrap().model;
        let study = model.studies.campbell.clone().unwrap();
        let found = Machine::new(model).unwrap().campbell(&study).unwrap();
        assert!(found.thresholds.is_empty(), "{length}, {support}: {:?}", found.thresholds.len());
        for branch in &found.diagram.branches {
            for mode in branch.modes.iter().flatten() {
                let value = mode.eigenvalue;
                let growth = value.re.abs() / value.norm();
                assert!(growth < 1e-12, "{length}, {support}: {} {growth:e}", branch.label);
            }
        }
    }
}

#[test]
fn modes_that_modal_damping_leaves_out_do_not_grow() {
    let text = std::fs::read_to_string("models/nelson_mcvaugh.toml").unwrap() + DAMPED_BELOW;
    let model = load("nelson.toml", text, &Options { variant: None, set: Vec::new() }).unwrap().model;
    let study = model.studies.campbell.clone().unwrap();
    let found = Machine::new(model).unwrap().campbell(&study).unwrap();
    assert!(found.thresholds.is_empty(), "{:?}", found.thresholds.len());
}
