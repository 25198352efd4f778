//! Messages about invalid defects of races and balls, and warnings about defects that no ball reaches.

use crate::sample::Sample;
use rotordyn::model::{self, Options};

/// A rotor whose bearing A has one dent, last in the file so that lines can be added to it.
const GOOD: &str = r#"[model]
name = "worn"

[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"

[shaft]
element_length = "50 mm"
section = [{ length = "400 mm", outer_diameter = "25 mm" }]

[station]
A = "50 mm"
B = "350 mm"

[bearing.B]
station = "B"
model = "ball"
designation = "6205"

[bearing.A]
station = "A"
model = "ball"
designation = "6205"

[[bearing.A.defect]]
kind = "dent"
on = "outer"
angle = "0 deg"
width = "0.17 mm"
"#;

const WORN: Sample = Sample { file: "worn.toml", text: GOOD };
const DEFECT: &str = "kind = \"dent\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\n";

/// With these lines in place of the defect's.
fn defect(lines: &str) -> String {
    WORN.changed(DEFECT, lines)
}

fn warned(lines: &str) -> String {
    WORN.warned(DEFECT, lines)
}

/// With lines added to bearing A.
fn added(lines: &str) -> String {
    WORN.changed("\n[[bearing.A", &format!("{lines}\n\n[[bearing.A"))
}

#[test]
fn valid_bearing_has_no_warnings() {
    assert_eq!(model::load("worn.toml", GOOD, &Options::default()).unwrap().warnings, []);
}

cases! {
    wider_than_the_ball_spacing: warned("kind = \"dent\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"18 mm\"\ndepth = \"1 um\"\n");
    wider_than_half_a_ball: warned("kind = \"bump\"\non = \"ball\"\nball = 2\nangle = \"0 deg\"\nwidth = \"14 mm\"\nheight = \"1 um\"\n");
    deeper_than_the_ball_reaches: warned("kind = \"dent\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\ndepth = \"0.28 mm\"\n");
    spall_deeper_than_the_ball_reaches: warned("kind = \"spall\"\non = \"inner\"\nangle = \"0 deg\"\nwidth = \"1 mm\"\ndepth = \"0.1 mm\"\nedge_radius = \"0.1 mm\"\n");
    all_the_way_round: defect("kind = \"spall\"\non = \"inner\"\nangle = \"0 deg\"\nwidth = \"100 mm\"\ndepth = \"1 um\"\n");
    wider_than_a_ball_without_depth: defect("kind = \"dent\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"9 mm\"\n");
    race_that_is_not_there: defect("kind = \"dent\"\non = \"middle\"\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\n");
    race_misspelt: defect("kind = \"dent\"\non = \"outter\"\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\n");
    ball_that_is_not_there: defect("kind = \"dent\"\non = \"ball\"\nball = 9\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\n");
    which_ball: defect("kind = \"dent\"\non = \"ball\"\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\n");
    ball_of_a_race: defect("kind = \"dent\"\non = \"outer\"\nball = 1\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\n");
    row_of_a_single_row: defect("kind = \"dent\"\non = \"outer\"\nrow = 1\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\n");
    nothing_said_of_it: defect("");
    unknown_kind: defect("kind = \"pit\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\ndepth = \"2 um\"\n");
    bump_without_height: defect("kind = \"bump\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\n");
    dent_with_a_height: defect("kind = \"dent\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"0.17 mm\"\nheight = \"1 um\"\n");
    spall_without_depth: defect("kind = \"spall\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"1 mm\"\nedge_radius = \"0.1 mm\"\n");
    edges_wider_than_the_pit: defect("kind = \"spall\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"1 mm\"\ndepth = \"10 um\"\nedge_radius = \"0.6 mm\"\n");
    cap_beyond_a_half_sphere: defect("kind = \"bump\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"0.1 mm\"\nheight = \"60 um\"\nshape = \"cap\"\n");
    angle_and_centre: defect("kind = \"dent\"\non = \"outer\"\nangle = \"0 deg\"\ncentre = \"1 deg\"\nwidth = \"0.17 mm\"\n");
    negative_and_not_a_number: defect("kind = \"bump\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"-0.17 mm\"\nheight = \"nan um\"\n");
    width_as_an_angle: defect("kind = \"dent\"\non = \"outer\"\nangle = 15\nwidth = \"0.4 deg\"\n");
    unknown_key_of_a_defect: defect("kind = \"spall\"\non = \"outer\"\nangle = \"0 deg\"\nwidth = \"1 mm\"\ndepth = \"10 um\"\nedge_radus = \"0.1 mm\"\n");
    unknown_defect_law: added("defect_law = \"forces\"");
    stiffness_without_force: added("defect_stiffness = \"1.5e10 N/m^1.5\"");
    stiffness_in_another_unit: added("defect_law = \"force\"\ndefect_stiffness = \"1.5e10 N/m\"");
    force_on_balls_with_inertia: added("defect_law = \"force\"\nball_inertia = \"shared\"");
    force_on_a_sprung_ring: added("defect_law = \"force_on_loaded\"\nthrust = \"+z\"\npreload = { spring = \"1e6 N/m\", force = \"50 N\" }");
    force_beside_a_fitted_law: added("defect_law = \"force\"\ncontact = \"power_law\"\npower_law = { stiffness = \"1e10 N/m^1.5\", exponent = 1.5, range = \"60, 2000 N\" }");
    wave_order_beyond_range: added("outer_waviness = [{ order = 0, amplitude = \"1 um\" }, { order = 20000, amplitude = \"1 um\" }]");
    wave_law_and_exponent: added("inner_waviness = { amplitude = \"1 um\", law = \"1/n\", roughness_exponent = 2, from = 5, to = 3 }");
    same_phase_of_a_race: added("inner_waviness = { amplitude = \"1 um\", same_phase = true }");
    wave_on_a_ball_that_is_not_there: added("ball_waviness = [{ ball = 9, order = 2, amplitude = \"1 um\" }]");
    size_of_a_ball_that_is_not_there: added("off_size = [{ ball = 12, diameter_difference = \"0.2 um\" }, { diameter_difference = \"0.2 um\" }]");
    ball_a_thousand_times_too_large: added("off_size = [{ ball = 0, diameter_difference = \"0.2 mm\" }]");
    eccentricity_as_a_length: added("inner_eccentricity = \"2 um\"");
    unknown_spin: added("ball_spin = \"shafts\"");
}
