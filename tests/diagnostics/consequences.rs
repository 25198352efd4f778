//! A mistake is one message: what only follows from it is not listed. The machine is the starter that users change first.

use crate::sample::Sample;
use rotordyn::model::Options;

const FAN: Sample = Sample { file: "fan.toml", text: include_str!("../../assets/init/fan.toml") };

fn changed(from: &str, to: &str) -> String {
    FAN.changed(from, to)
}

fn set(path: &str, value: &str) -> String {
    let set = vec![(path.to_string(), value.to_string())];
    FAN.refused_with(FAN.text, &Options { set, ..Options::default() })
}

fn without_material() -> String {
    let text = FAN.text;
    let [from, to] = ["[material.steel]", "[shaft]"].map(|table| text.find(table).unwrap());
    FAN.refused(format!("{}{}", &text[..from], &text[to..]))
}

const C3: &str = "bearing.B.clearance = \"C3\"";

cases! {
    misspelt_shaft: changed("[shaft]", "[shaf]");
    misspelt_station_table: changed("[station]", "[stations]");
    no_station_table: changed("[station] ", "[probe.q]\nat = \"ground\"\ndirection = \"x\"\n[shaft.x]");
    misspelt_kind_of_place: changed("[housing.", "[housng.");
    misspelt_bearings: changed("[bearing.", "[bearngs.");
    bare_designation: changed("designation = \"6208\"\nclearance = \"CN\"                 #", "designation = 6208 #");
    unknown_designation: set("bearing.A.designation", "6208-XYZ");
    misspelt_choice: changed("grade =", "grad =");
    no_choice: changed("grade = \"G6.3\"", "");
    tilt_of_another_program: changed("c_spin = \"0.05 N m s/rad\"", "k_tx = \"1e3 N m/rad\"");
    no_material: without_material();
    table_without_name: changed("[unbalance.impeller]", "[unbalance]");
    bearing_without_name: changed("[bearing.A]", "[bearing]");
    range_downwards: set("study.unbalance.speeds", "{ from = \"2250 rpm\", to = \"100 rpm\", step = \"25 rpm\" }");
    range_of_nothing: set("study.unbalance.speeds", "{ from = \"100 rpm\", to = \"100 rpm\", count = 3 }");
    decimal_comma_in_text: set("disc.impeller.mass", "9,5 kg");
    decimal_comma: changed("poisson = 0.3", "poisson = 0,3");
    negative_decimal_comma: changed("poisson = 0.3", "poisson = -0,25  # ,");
    misspelt_item_of_a_variant: FAN.refused_with(
        FAN.with(C3, "bearing.C.clearance = \"C3\""),
        &Options { variant: Some("C3".into()), ..Options::default() },
    );
    no_such_item_in_list: set("shaft.section[7].length", "81 mm");
}

/// What looks like a number is the text that a key wants, and an item of a list is written as in messages.
#[test]
fn settings_as_they_are_typed() {
    let load = |path: &str, value: &str| {
        let set = vec![(path.to_string(), value.to_string())];
        rotordyn::model::load(FAN.file, FAN.text, &Options { set, ..Options::default() }).unwrap().model
    };
    let bore = |model: &rotordyn::model::Model| model.bearings[0].bearing.ball().unwrap().geometry.bore;
    assert_eq!(bore(&load("bearing.A.designation", "6308")), 40e-3);
    assert_eq!(bore(&load("bearing.A.designation", "61908")), 40e-3);
    assert_eq!(load("model.title", "2024").title, "2024");
    let longer = load("shaft.section[0].length", "90 mm");
    assert_eq!(longer.node_z, load("shaft.section.0.length", "90 mm").node_z);
}
