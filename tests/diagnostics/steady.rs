//! Messages about studies of steady motion.

use crate::sample::Sample;

/// A rigid rotor on a ball bearing and a linear one, with all three studies; each case introduces one error.
const GOOD: &str = r#"[model]
name = "steady"

[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"

[shaft]
element_length = "100 mm"
section = [{ length = "400 mm", outer_diameter = "25 mm" }]

[station]
A = "0 mm"
B = "400 mm"

[bearing.A]
station = "A"
model = "linear"
k_xx = "1e7 N/m"
k_yy = "1e7 N/m"
k_zz = "1e7 N/m"

[bearing.B]
station = "B"
model = "ball"
designation = "6205"
radial_clearance = "10 um"

[probe.B_x]
at = "B"
direction = "x"

[probe.B_y]
at = "B"
direction = "y"

[speed]
profile = "constant"
speed = "1200 rpm"
duration = "1 s"

[study.poincare]
section = "cage"
bearing = "B"
planes = ["B_x, B_y"]
periods = 300

[study.lyapunov]
perturbation = "1 nm"

[study.bifurcation]
parameter = "bearing.B.radial_clearance"
values = { from = "0 um", to = "40 um", count = 41 }
section = "ball-pass"
"#;

const STEADY: Sample = Sample { file: "steady.toml", text: GOOD };

fn changed(from: &str, to: &str) -> String {
    STEADY.changed(from, to)
}

/// Another parameter with its values.
fn over(parameter: &str, values: &str) -> String {
    let text = STEADY.with("parameter = \"bearing.B.radial_clearance\"", &format!("parameter = {parameter}"));
    STEADY.refused(text.replace("{ from = \"0 um\", to = \"40 um\", count = 41 }", values))
}

const BALL: &str = "model = \"ball\"\ndesignation = \"6205\"\nradial_clearance = \"10 um\"";
const LINEAR: &str = "model = \"linear\"\nk_xx = \"1e7 N/m\"\nk_yy = \"1e7 N/m\"";
const CONSTANT: &str = "[speed]\nprofile = \"constant\"\nspeed = \"1200 rpm\"\nduration = \"1 s\"\n";
const UM: &str = "{ from = \"0 um\", to = \"40 um\", count = 41 }";

#[test]
fn valid_machine_has_no_warnings() {
    let loaded = rotordyn::model::load("steady.toml", GOOD, &Default::default()).unwrap();
    assert_eq!(loaded.warnings, []);
    assert!(loaded.model.studies.bifurcation.is_some());
    // A diagram over speed needs no `[speed]` table.
    let text = GOOD.replace(CONSTANT, "").replace("\"bearing.B.radial_clearance\"", "\"speed\"");
    let text = text.replace(UM, "{ from = \"100 rpm\", to = \"900 rpm\" }");
    let text = text.replace("[study.poincare]", "[study.poincare]\nspeed = \"9 Hz\"");
    let text = text.replace("[study.lyapunov]", "[study.lyapunov]\nspeed = \"9 Hz\"");
    rotordyn::model::load("steady.toml", text, &Default::default()).unwrap();
}

cases! {
    cage_clock_without_ball_bearing: STEADY.refused(GOOD.replace(BALL, LINEAR).replace("bearing = \"B\"\n", "").replace("\"bearing.B.radial_clearance\"", "\"bearing.B.k_xx\"").replace(UM, "\"1e6, 1e7 N/m\""));
    clock_of_a_bearing_without_balls: changed("bearing = \"B\"\n", "bearing = \"A\"\n");
    unknown_clock: changed("\"cage\"", "\"cages\"");
    unknown_probe_in_a_plane: changed("\"B_x, B_y\"", "\"B_x, B_z\"");
    plane_of_three: changed("\"B_x, B_y\"", "\"B_x, B_y, B_x\"");
    too_few_periods: changed("periods = 300", "periods = 4");
    no_speed: STEADY.refused(GOOD.replace(CONSTANT, ""));
    speed_of_zero: changed("[study.lyapunov]", "[study.lyapunov]\nspeed = \"0 rpm\"");
    perturbation_of_zero: changed("\"1 nm\"", "\"0 nm\"");
    rotation_held_under_torque: changed("[speed]", "[bushing.brake]\nbetween = [\"station.A\", \"ground\"]\nk_spin = \"10 N m/rad\"\n\n[drive]\nkind = \"torque\"\nstation = \"A\"\nspeed = \"0, 3000 rpm\"\ntorque = \"1, 0 N m\"\n\n[speed]");
    torque_holds_no_speed: changed("[speed]", "[drive]\nkind = \"torque\"\nstation = \"A\"\nspeed = \"0, 3000 rpm\"\ntorque = \"1, 0 N m\"\n\n[speed]");
    no_parameter: changed("parameter = \"bearing.B.radial_clearance\"\n", "");
    no_values: changed(&format!("values = {UM}\n"), "");
    unknown_parameter: over("\"bearing.B.radial_clearence\"", UM);
    parameter_of_no_item: over("\"bearing.C.radial_clearance\"", UM);
    parameter_in_another_unit: over("\"bearing.B.radial_clearance\"", "{ from = \"0 rpm\", to = \"40 rpm\" }");
    parameter_without_unit: over("\"bearing.B.radial_clearance\"", "[1, 2, 3]");
    two_units_in_one_list: over("\"bearing.B.radial_clearance\"", "[\"0 um\", \"0.01 mm\"]");
    from_equals_to: over("\"bearing.B.radial_clearance\"", "{ from = \"5 um\", to = \"5 um\" }");
    from_above_to: over("\"speed\"", "{ from = \"5000 rpm\", to = \"500 rpm\" }");
    step_beyond_the_range: over("\"bearing.B.radial_clearance\"", "{ from = \"0 um\", to = \"40 um\", step = \"50 um\" }");
    balls_by_halves: over("\"bearing.B.balls\"", "{ from = 7, to = 8.5, count = 4 }");
    speed_from_zero: over("\"speed\"", "{ from = \"0 rpm\", to = \"500 rpm\" }");
    parameter_that_changes_the_degrees_of_freedom: over("\"shaft.element_length\"", "{ from = \"50 mm\", to = \"100 mm\", count = 2 }");
    overlap_from_equilibrium: changed("section = \"ball-pass\"", "section = \"ball-pass\"\nstart = \"equilibrium\"\noverlap = 3");
}
