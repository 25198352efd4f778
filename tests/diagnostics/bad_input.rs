//! Snapshots of the error messages, rendered without colour.

use crate::sample::Sample;
use rotordyn::model::{self, Options};

/// A small valid model; each case introduces one error.
const GOOD: &str = r#"[model]
name = "good"

[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"

[shaft]
material = "steel"
element_length = "20 mm"
section = [{ length = "400 mm", outer_diameter = "25 mm" }]

[station]
A = "30 mm"
B = "300 mm"
disc = "380 mm"

[disc.main]
station = "disc"
outer_diameter = "300 mm"
thickness = "20 mm"
material = "steel"

[housing.B]
station = "B"
mass = "1.5 kg"
inertia = "0.003 kg m^2"
k_x = "6e6 N/m"
k_y = "1.5e7 N/m"
k_z = "2e7 N/m"
k_tilt = "1e5 N m/rad"
k_spin = "1e6 N m/rad"

[bearing.A]
station = "A"
model = "linear"
k_xx = "1e7 N/m"
k_yy = "1e7 N/m"

[bearing.B]
station = "B"
housing = "housing.B"
model = "ball"
designation = "6205"
clearance = "C3"

[probe.disc_x]
at = "disc.main"
direction = "x"

[study.modal]
speeds = "0, 1200 rpm"

[variant.soft]
housing.B.k_x = "1e6 N/m"
"#;

const MACHINE: Sample = Sample { file: "machine.toml", text: GOOD };

fn messages(text: impl AsRef<[u8]>, options: &Options) -> String {
    MACHINE.refused_with(text, options)
}

/// The valid model with one text replaced.
fn spoiled(from: &str, to: &str) -> String {
    assert_eq!(GOOD.matches(from).count(), 1, "`{from}`");
    GOOD.replace(from, to)
}

fn changed(from: &str, to: &str) -> String {
    messages(spoiled(from, to), &Options::default())
}

fn set(path: &str, value: &str) -> String {
    messages(GOOD, &Options { set: vec![(path.into(), value.into())], ..Options::default() })
}

#[test]
fn valid_model_has_no_warnings() {
    let options = Options { variant: Some("soft".into()), ..Options::default() };
    assert_eq!(model::load("machine.toml", GOOD, &options).unwrap().warnings, []);
}

cases! {
    unknown_key: changed("thickness = \"20 mm\"", "thicknes = \"20 mm\"");
    unknown_table: changed("[bearing.B]", "[bearings.B]");
    unknown_study: changed("[study.modal]", "[study.campbel]\nspeeds = \"0 rpm\"\n[study.modal]");
    missing_key: changed("mass = \"1.5 kg\"\n", "");
    missing_unit: changed("element_length = \"20 mm\"", "element_length = 0.02");
    missing_unit_in_text: changed("element_length = \"20 mm\"", "element_length = \"20\"");
    bare_speed: changed("speeds = \"0, 1200 rpm\"", "speeds = 3000");
    bare_diameter: changed("outer_diameter = \"25 mm\"", "outer_diameter = 25");
    bare_modulus: changed("young = \"207 GPa\"", "young = \"207\"");
    bare_designation: changed("designation = \"6205\"", "designation = 6205");
    synonym: changed("young = \"207 GPa\"", "E = \"207 GPa\"");
    type_of_bearing: changed("model = \"ball\"", "type = \"ball\"");
    preload_as_a_force: changed("clearance = \"C3\"", "clearance = \"C3\"\nthrust = \"+z\"\npreload = \"150 N\"");
    unit_after_every_number: changed("speeds = \"0, 1200 rpm\"", "speeds = \"0 rpm, 1200 rpm\"");
    roller_bearing: changed("model = \"ball\"", "model = \"cylindrical_roller\"");
    roller_designation: changed("designation = \"6205\"", "designation = \"NU 205\"");
    unknown_unit: changed("element_length = \"20 mm\"", "element_length = \"20 mmm\"");
    wrong_dimension: changed("k_y = \"1.5e7 N/m\"", "k_y = \"1.5e7 N\"");
    frequency_for_speed: changed("speeds = \"0, 1200 rpm\"", "speeds = [\"0 rpm\", \"20 1/s\"]");
    wrong_type: changed("element_length = \"20 mm\"", "element_length = [[true]]");
    unknown_station: changed("[disc.main]\nstation = \"disc\"", "[disc.main]\nstation = \"disk\"");
    unknown_housing: changed("housing = \"housing.B\"", "housing = \"housing.C\"");
    ambiguous_place: changed("at = \"disc.main\"", "at = \"B\"");
    unknown_material: changed("thickness = \"20 mm\"\nmaterial = \"steel\"", "thickness = \"20 mm\"\nmaterial = \"steal\"");
    unknown_designation: changed("designation = \"6205\"", "designation = \"6250\"");
    unknown_clearance: changed("clearance = \"C3\"", "clearance = \"C6\"");
    unknown_variant: messages(GOOD, &Options { variant: Some("sofd".into()), ..Options::default() });
    negative_dimension: changed("outer_diameter = \"300 mm\"", "outer_diameter = \"-300 mm\"");
    zero_dimension: changed("length = \"400 mm\"", "length = \"0 mm\"");
    hollow_beyond_solid: changed("outer_diameter = \"25 mm\" }", "outer_diameter = \"25 mm\", inner_diameter = \"1 in\" }");
    not_a_number: changed("poisson = 0.3", "poisson = nan");
    infinity: changed("mass = \"1.5 kg\"", "mass = \"inf kg\"");
    overflow: changed("mass = \"1.5 kg\"", "mass = \"1e999 kg\"");
    overlapping_stations: changed("B = \"300 mm\"", "B = \"30.05 mm\"");
    station_off_the_shaft: changed("disc = \"380 mm\"", "disc = \"480 mm\"");
    inverse_shear_coefficient: changed("element_length = \"20 mm\"", "element_length = \"20 mm\"\nshear = 1.11");
    material_of_one_section: changed("material = \"steel\"\nelement_length = \"20 mm\"\nsection = [{ length = \"400 mm\", outer_diameter = \"25 mm\" }]", "element_length = \"20 mm\"\nsection = [{ length = \"200 mm\", outer_diameter = \"25 mm\", material = \"steel\" }, { length = \"200 mm\", outer_diameter = \"25 mm\" }]\n[material.brass]\nyoung = \"105 GPa\"\npoisson = 0.34\ndensity = \"8400 kg/m^3\"");
    section_gap: changed("outer_diameter = \"25 mm\" }", "outer_diameter = \"25 mm\" }, { from = \"41 cm\", to = \"50 cm\", outer_diameter = \"20 mm\" }");
    overlapping_balls: changed("clearance = \"C3\"", "clearance = \"C3\"\nballs = 16");
    narrow_groove: changed("clearance = \"C3\"", "clearance = \"C3\"\ninner_osculation = 0.49");
    disconnected_body: changed("[probe.disc_x]", "[body.loose]\nposition = \"0, -1, 0 m\"\nmass = \"3 kg\"\ninertia = \"1 kg m^2\"\n\n[probe.disc_x]");
    duplicate_table: changed("[probe.disc_x]", "[bearing.A]\nstation = \"B\"\n\n[probe.disc_x]");
    duplicate_name: changed("[probe.disc_x]", "[body.B]\nposition = \"0, -1, 0 m\"\nmass = \"3 kg\"\ninertia = \"1 kg m^2\"\n\n[probe.disc_x]");
    conflicting_keys: changed("clearance = \"C3\"", "clearance = \"C3\"\nradial_clearance = \"10 um\"");
    several_at_once: messages(GOOD.replace("GPa", "GPA").replace("6205", "605").replace("\"x\"", "\"w\""), &Options::default());
    not_toml: changed("[station]", "[station");
    not_toml_at_all: messages("Dear Sir or Madam,\nplease find enclosed my rotor.\n", &Options::default());
    not_utf8: messages(b"[model]\nname = \"\xff\xfe\"\n", &Options::default());
    empty_file: messages(" \n\n", &Options::default());
    nothing_in_it: messages("[model]\nname = \"nothing\"\n", &Options::default());
    no_model_table: messages("# only a comment\n", &Options::default());
    set_unknown_item: set("bearing.C.radial_clearance", "20 um");
    set_unknown_key: set("bearing.B.radial_clearence", "20 um");
    set_wrong_unit: set("bearing.B.pitch_diameter", "38.5 kg");
    set_through_a_value: set("model.name.first", "1");
    set_list_index: set("shaft.section.3.length", "1 m");
    set_not_a_path: set("bearing..B", "1");
}

/// 10 MB of seeded random bytes, text and brackets on one line: a short message within a short time.
#[test]
fn garbage() {
    const SIZE: usize = 10_000_000;
    let mut state = 1_u64;
    let mut noise = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as u8
    };
    let bytes: Vec<u8> = (0..SIZE).map(|_| noise()).collect();
    let text: Vec<u8> = bytes.iter().map(|b| b % 0x7f).collect();
    let line: Vec<u8> = bytes.iter().map(|b| 0x21 + b % 0x5e).collect();
    let brackets = [b"[".repeat(SIZE / 10), b"a=[".repeat(SIZE / 10), b"a.".repeat(SIZE / 10)];
    for input in [bytes, text, line].into_iter().chain(brackets) {
        let message = messages(&input, &Options::default());
        assert!(message.len() < 2000, "{}", message.len());
    }
}

#[test]
fn garbage_looks_bearable() {
    insta::assert_snapshot!(messages("x=[".repeat(100_000), &Options::default()));
}
