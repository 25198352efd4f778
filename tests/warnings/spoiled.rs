//! A spoiled copy of a plausible machine has the warning of its fault, and no other.

use crate::copies::without_modal;
use crate::machines::{self, Description};
use crate::program;
use crate::{codes, warnings_of};
use rotordyn::assembly::rigid_body_modes::motion_of;

pub fn machine(name: &str) -> Description {
    machines::all().into_iter().find(|m| m.name == name).unwrap_or_else(|| panic!("{name}"))
}

/// Replaces a part of the text, which must be there.
pub fn replaced(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from} is not in\n{text}");
    text.replacen(from, to, 1)
}

fn only(text: &str, code: &str) {
    let found = warnings_of(text);
    assert_eq!(codes(&found).into_iter().collect::<Vec<_>>(), [code], "{found:#?}\n{text}");
}

#[test]
fn a_modulus_or_density_off_by_a_power_of_ten() {
    let text = machine("two_discs_soft").text();
    for (from, to) in
        [("210 GPa", "21 GPa"), ("210 GPa", "2100 GPa"), ("7850 kg", "78500 kg"), ("7850 kg", "785 kg")]
    {
        only(&replaced(&text, from, to), "material-range");
    }
    // Other materials of engineering.
    for [young, density] in [
        ["70 GPa", "2700"],
        ["115 GPa", "4430"],
        ["45 GPa", "1740"],
        ["120 GPa", "7200"],
        ["135 GPa", "1600"],
    ] {
        let text = replaced(&replaced(&text, "210 GPa", young), "7850", density);
        assert!(warnings_of(&text).is_empty(), "{young} {density}");
    }
}

#[test]
fn a_section_in_metres_among_millimetres() {
    let text = machine("motor_small").text();
    let found = warnings_of(&replaced(&text, "outer_diameter = \"35 mm\"", "outer_diameter = \"1 m\""));
    assert!(codes(&found).contains("section-step"), "{found:?}");
}

#[test]
fn a_bearing_of_another_bore_than_its_seat() {
    let text = machine("motor_large").text();
    only(&replaced(&text, "\"6312\"", "\"6310\""), "bore-mismatch");
}

#[test]
fn discs_in_one_place() {
    let mut two = machine("two_discs_soft");
    two.discs[1].1 = two.discs[0].1 + 12.0;
    only(&two.text(), "overlapping-discs");
}

#[test]
fn a_disc_through_a_bearing() {
    let mut fan = machine("fan_small");
    fan.discs[0].1 = fan.bearings[0].1 - 10.0;
    let found = warnings_of(&fan.text());
    assert!(codes(&found).contains("disc-collision"), "{found:?}");
}

#[test]
fn a_single_bearing() {
    let mut motor = machine("motor_small");
    motor.bearings.truncate(1);
    let found = warnings_of(&motor.text());
    assert!(codes(&found).contains("single-bearing"), "{found:?}");
}

#[test]
fn a_speed_beyond_the_bearing() {
    let mut motor = machine("gear_shaft");
    motor.rpm = 30000.0;
    motor.unbalance = 1.0;
    let found = warnings_of(&motor.text());
    assert!(codes(&found).contains("bearing-speed"), "{found:?}");
}

#[test]
fn an_unbalance_in_the_wrong_unit() {
    let text = machine("two_discs_soft").text();
    only(&replaced(&text, "\"40 g mm\"", "\"40 kg mm\""), "balance-quality");
}

#[test]
fn unused_materials() {
    let text = machine("two_discs_soft").text();
    let brass = "[material.brass]\nyoung = \"105 GPa\"\npoisson = 0.34\ndensity = \"8400 kg/m^3\"\n[shaft]";
    only(&replaced(&text, "[shaft]", brass), "unused-item");
}

#[test]
fn an_axially_free_shaft() {
    let text = machine("two_discs_soft").text();
    only(&replaced(&text, "k_zz = \"1e7 N/m\"\n", ""), "free-axial-motion");
}

#[test]
fn cross_coupling_beyond_the_damping() {
    let text = machine("two_discs_soft").text();
    let unstable = replaced(&text, "k_xx = ", "k_xy = \"5e6 N/m\"\nk_yx = \"-5e6 N/m\"\nk_xx = ");
    only(&unstable, "unstable-mode");
    // Also where only responses are computed.
    let without_modal = &unstable[..unstable.find("[study.modal]").unwrap()];
    for study in [
        "[study.unbalance]\nspeeds = { from = \"100 rpm\", to = \"3000 rpm\", step = \"100 rpm\" }\n",
        "[study.frf]\nfrequencies = { from = \"5 Hz\", to = \"100 Hz\", step = \"1 Hz\" }\nspeed = \"3000 rpm\"\n\
         [study.frf.excitation.x]\nat = \"disc.one\"\ndirection = \"x\"\n",
    ] {
        let probe = "[probe.x]\nat = \"disc.one\"\ndirection = \"x\"\n";
        only(&format!("{without_modal}{probe}{study}"), "unstable-mode");
    }
}

#[test]
fn a_linear_response_that_opens_the_contacts() {
    let mut motor = machine("rig_short");
    let study = "[probe.x]\nat = \"disc.disc\"\ndirection = \"x\"\n[study.unbalance]\n\
                 speeds = { from = \"100 rpm\", to = \"9000 rpm\", step = \"50 rpm\" }\n";
    motor.more = study.into();
    motor.unbalance = 0.05;
    let small = warnings_of(&motor.text());
    motor.unbalance = 200.0;
    let large = warnings_of(&motor.text());
    assert!(!codes(&small).contains("linear-range"), "{small:?}");
    assert!(codes(&large).contains("linear-range"), "{large:?}");
}

#[test]
fn a_mesh_too_coarse_for_the_modes() {
    let mut rotor = machine("two_discs_soft");
    rotor.discs.clear();
    let fine = rotor.text().replace("modes = 6", "modes = 14");
    assert!(warnings_of(&fine).is_empty());
    only(&fine.replace("element_length = \"15 mm\"", "element_length = \"250 mm\""), "mesh-limit");
}

#[test]
fn bearings_without_preload_under_a_light_rotor() {
    let mut motor = machine("motor_small");
    motor.rpm = 6000.0;
    motor.unbalance = 5.0;
    motor.bearings[1].2 = motor.bearings[0].2.clone();
    only(&motor.text(), "minimum-load");
}

#[test]
fn a_preload_that_the_shaft_gives_way_to() {
    let mut motor = machine("motor_small");
    motor.bearings[1].2 = motor.bearings[0].2.clone() + "thrust = \"+z\"\npreload = { force = \"180 N\" }\n";
    only(&motor.text(), "preload");
}

#[test]
fn a_load_beyond_the_static_rating() {
    let mut motor = machine("motor_small");
    motor.gravity = "8000 m/s^2";
    let found = warnings_of(&motor.text());
    assert!(codes(&found).contains("static-load"), "{found:?}");
}

/// A shock within the run, which the static equilibrium does not have.
#[test]
fn a_shock_beyond_the_static_rating() {
    let of = |force: &str| {
        let mut motor = machine("motor_small");
        motor.more = format!(
            "[load.shock]\nat = \"station.A\"\nforce = \"0, -{force}, 0 N\"\ntime = \"0, 0.1, 0.105, 0.15 s\"\nfactor = [0, 0, 1, 0]\n\
             [study.run_up]\nstep = \"100 us\"\n"
        );
        let text = without_modal(&motor.text(), &motor.more);
        let ramp = "ramp = \"2 s\"";
        let folder = program::folder(&[("motor.toml", replaced(&text, ramp, "ramp = \"0.2 s\""))]);
        let run = ["run-up", "motor.toml", "--no-figures", "--out", "out"];
        program::codes(folder.path(), &run, 0)
    };
    let [calm, shock] = [of("10"), of("30000")];
    assert!(!calm.contains("static-load"), "{calm:?}");
    assert!(shock.contains("static-load"), "{shock:?}");
}

/// Bores of discs with play, on a hub, and smaller than the shaft.
#[test]
fn a_disc_that_does_not_fit_the_shaft() {
    let text = machine("two_discs_soft").text();
    let with = |keys: &str| replaced(&text, "thickness = ", &format!("{keys}\nthickness = "));
    only(&with("inner_diameter = \"200 mm\""), "disc-fit");
    assert!(warnings_of(&with("inner_diameter = \"42 mm\"")).is_empty());
    let mut thin = machine("two_discs_soft");
    thin.discs[0].2 = 30.0;
    assert!(codes(&warnings_of(&thin.text())).contains("disc-fit"), "a disc within the shaft");
}

/// A disc whose unit is wrong is named, not a missing support.
#[test]
fn a_disc_of_absurd_size_is_no_missing_support() {
    let huge = r#"
        model = { name = "m" }
        material.steel = { young = "207 GPa", poisson = 0.3, density = "7850 kg/m^3" }
        station = { A = "30 mm", B = "380 mm", fan = "480 mm" }
        shaft = { element_length = "20 mm", section = [{ length = "500 mm", outer_diameter = "25 mm" }] }
        disc.fan = { station = "fan", outer_diameter = "25 m", thickness = "15 mm" }
        bearing.A = { model = "ball", station = "A", designation = "6205" }
        bearing.B = { model = "ball", station = "B", designation = "6205", clearance = "C3" }
        drive = { kind = "prescribed", station = "A" }
    "#;
    let loaded = rotordyn::model::load("motor.toml", huge, &Default::default()).unwrap();
    let warned: Vec<String> =
        loaded.warnings.iter().filter_map(|d| d.to_warning()).map(|w| w.code.name().to_string()).collect();
    assert!(warned.contains(&"disc-size".to_string()), "{warned:?}");
    let error = rotordyn::study::Machine::new(loaded.model).err().unwrap().to_string();
    assert!(!error.contains("unconstrained") && error.contains("disc.") && error.contains("Hz"), "{error}");
}

/// Inertias in kg mm^2 beside a mass, and gravity in mm/s^2 or on a shaft that is vertical the other way.
#[test]
fn inertias_and_gravity_in_wrong_units_are_named() {
    let codes = |gravity: &str, polar: &str, diametral: &str| {
        let text = format!(
            r#"
            model = {{ name = "m", gravity = "{gravity}" }}
            material.steel = {{ young = "207 GPa", poisson = 0.3, density = "7850 kg/m^3" }}
            station = {{ A = "0 mm", fan = "200 mm", B = "400 mm" }}
            shaft = {{ element_length = "20 mm", section = [{{ length = "400 mm", outer_diameter = "25 mm" }}] }}
            disc.fan = {{ station = "fan", mass = "5 kg", polar_inertia = "{polar}", diametral_inertia = "{diametral}" }}
            bearing.A = {{ model = "ball", station = "A", designation = "6205" }}
            bearing.B = {{ model = "ball", station = "B", designation = "6205" }}
            drive = {{ kind = "prescribed", station = "A" }}
        "#
        );
        let loaded = rotordyn::model::load("m.toml", text, &Default::default()).unwrap();
        let warnings = loaded.warnings.iter().filter_map(|d| d.to_warning());
        warnings.map(|w| w.code.name().to_string()).collect::<Vec<_>>()
    };
    let [polar, diametral] = ["0.05 kg m^2", "0.03 kg m^2"];
    let none: [&str; 0] = [];
    for gravity in ["9.81 m/s^2", "0 m/s^2", "1.62 m/s^2", "0, 0, -9.81 m/s^2", "-9.81, 0, 0 m/s^2"] {
        assert_eq!(codes(gravity, polar, diametral), none, "{gravity}");
    }
    for gravity in ["9810 m/s^2", "0, 0, -0.00981 m/s^2", "-9.81 m/s^2", "0, 9.81, 0 m/s^2"] {
        assert_eq!(codes(gravity, polar, diametral), ["gravity"], "{gravity}");
    }
    for (polar, diametral) in [("5e4 kg m^2", "3e4 kg m^2"), ("5e-8 kg m^2", "3e-8 kg m^2")] {
        assert_eq!(codes("9.81 m/s^2", polar, diametral), ["disc-size"], "{polar} {diametral}");
    }
    // A point mass is stated by zeros.
    assert_eq!(codes("9.81 m/s^2", "0 kg m^2", "0 kg m^2"), none);
}

/// Damping of 1e-6 of the critical one: a peak of no meaning.
#[test]
fn a_response_with_hardly_any_damping() {
    let mut rotor = machine("two_discs_soft");
    rotor.more = "[probe.x]\nat = \"disc.one\"\ndirection = \"x\"\n[study.unbalance]\n\
                  speeds = { from = \"100 rpm\", to = \"3000 rpm\", step = \"100 rpm\" }\n"
        .into();
    let damped = |c: &str| rotor.text().replace("\"2000 N s/m\"", &format!("\"{c} N s/m\""));
    let found = warnings_of(&damped("0.02"));
    let items: Vec<&str> =
        found.iter().filter(|w| w.code.name() == "undamped-peak").map(|w| w.item.as_str()).collect();
    assert!(items.contains(&"study.unbalance"), "{found:#?}");
    assert!(warnings_of(&damped("200")).is_empty());
}

#[test]
fn a_response_without_damping() {
    let mut rotor = machine("two_discs_soft");
    rotor.more = "[probe.x]\nat = \"disc.one\"\ndirection = \"x\"\n[study.unbalance]\n\
                  speeds = { from = \"100 rpm\", to = \"3000 rpm\", step = \"100 rpm\" }\n"
        .into();
    assert!(warnings_of(&rotor.text()).is_empty());
    let undamped = rotor.text().replace("\"2000 N s/m\"", "\"0 N s/m\"");
    only(&undamped, "undamped-peak");
}

/// Every degree of freedom at which a solution may fail stands for a motion of the shaft or of a body.
#[test]
fn the_motion_of_a_degree_of_freedom_has_a_name() {
    let motor = include_str!("../../assets/init/motor.toml");
    let model = rotordyn::model::load("motor.toml", motor, &Default::default()).unwrap().model;
    let machine = rotordyn::study::Machine::new(model).unwrap();
    let dofs = &machine.assembly.dofs;
    let mut of_bodies = 0;
    for k in 0..dofs.len() {
        let (name, motion) = (dofs.name(k), motion_of(&machine.assembly, k));
        let (direction, _) = name.split_once(" of ").unwrap();
        let of_shaft = match direction {
            "u_z" => "axial motion of the shaft",
            "u_x" | "u_y" => "lateral motion of the shaft",
            "θ_z" => "rotation of the shaft about z",
            _ => "tilting of the shaft",
        };
        of_bodies += usize::from(motion.starts_with("body `"));
        assert!(motion.starts_with(of_shaft) || motion.starts_with("body `"), "{name}: {motion}");
        assert!(motion.ends_with(&format!("({direction})")), "{name}: {motion}");
    }
    assert_eq!(of_bodies, 12, "two housings");
}
