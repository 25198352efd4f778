//! Messages about radial ball bearings with ball degrees of freedom (`model = "radial_ball"`).

use crate::sample::Sample;
use rotordyn::model::{self, Options};

/// A rigid rotor on one such bearing; each case introduces one error.
const GOOD: &str = r#"[model]
name = "rotor"

[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7800 kg/m^3"

[rotor]
centre = "0 m"
length = "60 mm"
outer_diameter = "36 mm"
mass = "0.6 kg"

[station]
B = "0 m"

[bearing.B]
station = "B"
model = "radial_ball"
balls = 8
ball_diameter = "9.524 mm"
pitch_diameter = "47 mm"
radial_clearance = "20 um"
material = "steel"
contact_stiffness = { inner = "9.8e9 N/m^1.5", outer = "1.1e10 N/m^1.5" }
stiffness_damping = "1e-4 s"

[joint.plane]
between = ["station.B", "ground"]
constrain = ["z", "tx", "ty"]
"#;

const ROTOR: Sample = Sample { file: "rotor.toml", text: GOOD };

fn changed(from: &str, to: &str) -> String {
    ROTOR.changed(from, to)
}

/// The valid model with lines added to the bearing.
fn added(lines: &str) -> String {
    changed("material = \"steel\"\n", &format!("material = \"steel\"\n{lines}\n"))
}

#[test]
fn valid_rotor_has_no_warnings() {
    assert_eq!(model::load("rotor.toml", GOOD, &Options::default()).unwrap().warnings, []);
}

const BOTH: &str = "contact_stiffness = { inner = \"9.8e9 N/m^1.5\", outer = \"1.1e10 N/m^1.5\" }\n";

cases! {
    damping_missing: changed("stiffness_damping = \"1e-4 s\"\n", "");
    damping_negative: changed("\"1e-4 s\"", "\"-1e-4 s\"");
    damping_of_another_unit: changed("\"1e-4 s\"", "{ inner = \"300 N s/m\" }");
    neither_stiffness_nor_grooves: changed(BOTH, "");
    stiffness_of_one_race: changed(", outer = \"1.1e10 N/m^1.5\"", "");
    negative_stiffness: changed("\"9.8e9 N/m^1.5\"", "\"-9.8e9 N/m^1.5\"");
    unknown_key: added("tensile_contacts = true");
    preload_of_a_bearing_in_its_plane: added("preload = { force = \"50 N\" }\ncontact_angle = \"15 deg\"");
    damping_of_the_other_model: added("contact_damping = \"300 N s/m\"\nball_inertia = \"shared\"");
    angular_contact_bearing: changed("balls = 8\nball_diameter = \"9.524 mm\"\npitch_diameter = \"47 mm\"\n", "designation = \"7206B\"\n");
    too_few_balls: changed("balls = 8", "balls = 2");
    too_many_balls: changed("balls = 8", "balls = 17");
    off_size_ball_that_is_none: added("off_size = [{ ball = 8, diameter_difference = \"0.2 um\" }]");
    off_size_ball_larger_than_the_gap_between_races: added("off_size = [{ ball = 1, diameter_difference = \"5 mm\" }]");
    defects_by_the_printed_force: added("defect_law = \"force\"\ndefect = [{ on = \"outer\", kind = \"dent\", angle = \"0 deg\", width = \"0.2 mm\" }]");
    massless_balls: changed("\"7800 kg/m^3\"", "\"0 kg/m^3\"");
    cage_faster_than_the_shaft: added("cage = 1.2");
}
