//! Messages about inconsistent contact, preload or mounting of bearings.

use crate::sample::Sample;
use rotordyn::model::{self, Options};

/// A rotor on two preloaded angular-contact bearings with a lubricant film; each case introduces one error.
const GOOD: &str = r#"[model]
name = "spindle"

[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"

[lubricant.oil]
viscosity = "0.04 Pa s"
pressure_viscosity = "23 1/GPa"

[shaft]
element_length = "50 mm"
section = [{ length = "400 mm", outer_diameter = "30 mm" }]

[station]
A = "50 mm"
B = "350 mm"

[bearing.A]
station = "A"
model = "ball"
designation = "7206B"
thrust = "-z"
contact = "film"
lubricant = "oil"
preload = { dry_force = "150 N" }
ball_inertia = "outer_race_control"

[bearing.B]
station = "B"
model = "ball"
designation = "7206B"
thrust = "+z"
contact = "film"
lubricant = "oil"
fit = { shaft_interference = "8 um", inner_temperature_rise = "20 K" }
"#;

const SPINDLE: Sample = Sample { file: "spindle.toml", text: GOOD };

fn refused(text: &str) -> String {
    SPINDLE.refused(text)
}

fn changed(from: &str, to: &str) -> String {
    SPINDLE.changed(from, to)
}

/// The valid model with lines added to bearing A.
fn added(lines: &str) -> String {
    changed("thrust = \"-z\"\n", &format!("thrust = \"-z\"\n{lines}\n"))
}

#[test]
fn valid_spindle_has_no_warnings() {
    assert_eq!(model::load("spindle.toml", GOOD, &Options::default()).unwrap().warnings, []);
}

const OIL: &str = "[lubricant.oil]\nviscosity = \"0.04 Pa s\"\npressure_viscosity = \"23 1/GPa\"\n";
const FILM: &str = "contact = \"film\"\nlubricant = \"oil\"\npreload";

/// Bearing A with massless balls and these keys of a fitted power law.
fn fitted(law: &str) -> String {
    let law = format!("contact = \"power_law\"\n{law}preload");
    refused(&GOOD.replace("ball_inertia = \"outer_race_control\"\n", "").replace(FILM, &law))
}

cases! {
    film_without_lubricant: refused(&GOOD.replace(OIL, "").replace("lubricant = \"oil\"\n", ""));
    unknown_lubricant: changed("lubricant = \"oil\"\npreload", "lubricant = \"oyl\"\npreload");
    lubricant_of_no_table: refused(&GOOD.replace(OIL, ""));
    which_lubricant: refused(&GOOD.replace("lubricant = \"oil\"\n", "").replace("[shaft]", "[lubricant.grease]\nviscosity = \"0.1 Pa s\"\npressure_viscosity = \"20 1/GPa\"\n[shaft]"));
    lubricant_of_another_unit: refused(&GOOD.replace("0.04 Pa s", "4e4 Pa s").replace("23 1/GPa", "23e-3 1/Pa"));
    lubricant_too_thin: changed("0.04 Pa s", "0.04 mPa s");
    lubricant_by_its_temperature: changed("\"0.04 Pa s\"", "\"40 degC\"");
    preload_without_counterpart: changed("thrust = \"+z\"", "thrust = \"-z\"");
    preload_without_value: changed("{ dry_force = \"150 N\" }", "{}");
    two_preloads: changed("{ dry_force = \"150 N\" }", "{ dry_force = \"150 N\", interference = \"2 um\" }");
    spring_without_stiffness: changed("{ dry_force = \"150 N\" }", "{ spring = \"0 N/m\", force = \"150 N\" }");
    spring_without_force: changed("{ dry_force = \"150 N\" }", "{ spring = \"2e5 N/m\" }");
    power_law_without_numbers: fitted("");
    power_law_beyond_sense: fitted("power_law = { stiffness = \"1e10 N/m^0.5\", exponent = 0.5, range = \"2000, 600 N\" }\n");
    power_law_in_another_unit: fitted("power_law = { stiffness = \"1e10 N/m^1.5\", exponent = 1.475, range = \"600, 2000 N\" }\n");
    power_law_all_offset: fitted("power_law = { stiffness = \"1e10 N/m^1.5\", exponent = 1.5, offset = \"700 N\", range = \"600, 2000 N\" }\n");
    power_law_of_a_film: added("power_law = { stiffness = \"1e10 N/m^1.5\", exponent = 1.5, range = \"600, 2000 N\" }");
    jones_with_power_law: changed(FILM, "contact = \"power_law\"\npower_law = { stiffness = \"1e10 N/m^1.5\", exponent = 1.5, range = \"600, 2000 N\" }\npreload");
    unknown_contact: changed("contact = \"film\"\nlubricant = \"oil\"\npreload", "contact = \"flim\"\nlubricant = \"oil\"\npreload");
    unknown_inertia: changed("outer_race_control", "outer_ring_control");
    unknown_arrangement: changed("thrust = \"-z\"\n", "arrangement = \"back-to-back\"\nrow_spacing = \"16 mm\"\n");
    rows_without_spacing: changed("thrust = \"-z\"\n", "arrangement = \"back_to_back\"\n");
    spacing_without_arrangement: added("row_spacing = \"16 mm\"");
    rows_without_contact_angle: changed("designation = \"7206B\"\nthrust = \"-z\"\n", "designation = \"6206\"\nthrust = \"-z\"\narrangement = \"tandem\"\nrow_spacing = \"16 mm\"\n");
    thrust_of_a_pair: changed("thrust = \"-z\"\n", "thrust = \"-z\"\narrangement = \"back_to_back\"\nrow_spacing = \"16 mm\"\n");
    fit_that_cannot_be: changed("{ shaft_interference = \"8 um\"", "{ shaft_bore = \"30 mm\", housing_diameter = \"60 mm\", shaft_interference = \"8 um\"");
    fit_a_thousand_times_too_tight: changed("\"8 um\"", "\"8 mm\"");
    fit_by_a_scale_of_temperature: changed("\"20 K\"", "\"20 degC\"");
    two_dampings: added("contact_damping = \"200 N s/m\"\nhunt_crossley = \"0.1 s/m\"");
    film_damping_without_film: refused(&GOOD.replace("contact = \"film\"\nlubricant = \"oil\"\nfit", "film_damping = 1\nfit"));
    unknown_grade: changed("viscosity = \"0.04 Pa s\"\n", "grade = \"ISO VG 86\"\ntemperature = \"40 degC\"\n");
    grade_too_hot: changed("viscosity = \"0.04 Pa s\"\n", "grade = \"ISO VG 68\"\ntemperature = \"400 degC\"\n");
    grade_without_temperature: changed("viscosity = \"0.04 Pa s\"\n", "grade = \"ISO VG 68\"\n");
    grade_and_viscosity: changed("viscosity = \"0.04 Pa s\"\n", "viscosity = \"0.04 Pa s\"\ngrade = \"ISO VG 68\"\ntemperature = \"40 degC\"\n");
    unknown_lubrication: added("lubrication = \"oil_mits\"\nsliding_friction = 1.5");
    lubrication_without_factor: added("lubrication = { f_1 = 0.001 }");
    lubrication_without_lubricant: refused(&GOOD.replace(FILM, "lubrication = \"grease\"\npreload"));
    more_than_clean: added("contamination = 2\nreliability = 0.5");
    several_at_once: refused(&GOOD.replace("lubricant = \"oil\"\nfit", "lubricant = \"oyl\"\nfit").replace("\"150 N\"", "\"150\"").replace("outer_race_control", "jones"));
    contact_stiffness_without_unit: added("contact_stiffness = { inner = 3e10, outer = \"3e10 N/m\" }");
    contact_stiffness_of_a_fitted_law: refused(&GOOD.replace("ball_inertia = \"outer_race_control\"\n", "contact_stiffness = \"1e10 N/m^1.5\"\n").replace(FILM, "contact = \"power_law\"\npower_law = { stiffness = \"1e10 N/m^1.5\", exponent = 1.5, range = \"600, 2000 N\" }\npreload"));
    joint_that_holds_no_motion: changed("[bearing.A]", "[joint.A]\nbetween = [\"A\", \"ground\"]\nconstrain = [\"z\", \"theta_x\", \"z\"]\n[bearing.A]");
    joint_of_a_kind_that_holds: changed("[bearing.A]", "[joint.A]\nbetween = [\"A\", \"ground\"]\nkind = \"fixed\"\nconstrain = [\"z\"]\n[bearing.A]");
    moment_on_a_ball_joint: refused("[model]\nname = \"pole\"\n[material.steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n[shaft]\nelement_length = \"50 mm\"\nsection = [{ length = \"400 mm\", outer_diameter = \"30 mm\" }]\n[station]\nA = \"200 mm\"\n[joint.A]\nbetween = [\"A\", \"ground\"]\nkind = \"spherical\"\n[load.tilt]\nat = \"A\"\nmoment = \"10, 0, 0 N m\"\n");
}
