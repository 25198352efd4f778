//! Static instability: negative stiffness and axial forces beyond the buckling load, against closed forms.

use rotordyn::analysis::divergence::divergence;
use rotordyn::model::study::CriticalStudy;
use rotordyn::model::{Options, load};
use rotordyn::study::{Machine, Results};
use rotordyn::warning::Code;
use std::f64::consts::{PI, TAU};

fn machine(text: &str) -> Machine {
    let loaded = load("machine.toml", text, &Options::default());
    Machine::new(loaded.unwrap_or_else(|errors| panic!("{errors:?}")).model).unwrap()
}

/// A rigid rotor of 10 kg on two equal supports 0.4 m apart.
fn rigid_rotor(stiffness: &str) -> Machine {
    let bearing = |name: &str| {
        format!(
            "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"linear\"\nk_z = \"1e7 N/m\"\nc_x = \"100 N s/m\"\n\
             c_y = \"100 N s/m\"\n{stiffness}\n"
        )
    };
    let rotor = "[model]\nname = \"rigid\"\ngravity = \"0 m/s^2\"\n[rotor]\ncentre = \"200 mm\"\nmass = \"10 kg\"\n\
                 polar_inertia = \"0.02 kg m^2\"\ndiametral_inertia = \"2 kg m^2\"\n[station]\nA = \"0 mm\"\n\
                 B = \"400 mm\"\n";
    machine(&format!("{rotor}{}{}", bearing("A"), bearing("B")))
}

/// A uniform shaft of 1 m and 20 mm on two stiff supports under an axial force \[N\].
fn shaft_under(force: f64) -> Machine {
    let bearing = |name: &str, axial: &str| {
        format!(
            "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"linear\"\nk_x = \"1e12 N/m\"\nk_y = \"1e12 N/m\"\n{axial}\n"
        )
    };
    let shaft = format!(
        "[model]\nname = \"column\"\n[material.steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\
         [shaft]\nelement_length = \"20 mm\"\naxial_force = \"{force} N\"\n\
         section = [{{ length = \"1 m\", outer_diameter = \"20 mm\" }}]\n[station]\nA = \"0 m\"\nB = \"1 m\"\n"
    );
    machine(&format!("{shaft}{}{}", bearing("A", "k_z = \"1e9 N/m\""), bearing("B", "")))
}

fn rate(machine: &Machine, speed: f64) -> Option<f64> {
    divergence(&machine.assembly, &machine.linear_system(speed).unwrap()).map(|found| found.rate)
}

/// m λ² + 2 c λ − 2 k = 0 along x, faster than the tilting motion; y is stable.
#[test]
fn a_negative_stiffness_diverges_at_its_rate() {
    let rotor = rigid_rotor("k_x = \"-1e6 N/m\"\nk_y = \"1e6 N/m\"");
    let expected = (-200.0 + (200.0_f64.powi(2) + 4.0 * 10.0 * 2e6).sqrt()) / 20.0;
    assert!((rate(&rotor, 0.0).unwrap() / expected - 1.0).abs() < 1e-9);
    // Also in both directions, where both motions have one rate.
    let both = rigid_rotor("k_x = \"-1e6 N/m\"\nk_y = \"-1e6 N/m\"");
    assert!((rate(&both, 0.0).unwrap() / expected - 1.0).abs() < 1e-6);
    for at in [&rotor, &both] {
        assert!(at.support_warnings(&[0.0]).iter().any(|w| w.code == Code::StaticInstability));
    }
}

/// λ² = ω₁² (P/P_E − 1) with the first frequency ω₁ without force, P_E the buckling load with shear.
#[test]
fn a_column_diverges_beyond_its_buckling_load() {
    let (young, area, inertia) = (207e9, PI / 4.0 * 0.02_f64.powi(2), PI / 64.0 * 0.02_f64.powi(4));
    let euler = PI * PI * young * inertia;
    // Shear coefficient 6(1 + ν)/(7 + 6ν) of a circle.
    let shear = 6.0 * 1.3 / 8.8 * young / 2.6 * area;
    let buckling = euler / (1.0 + euler / shear);
    let omega = PI * PI * (young * inertia / (7850.0 * area)).sqrt();
    for over in [1.005, 1.02, 1.2] {
        let found = rate(&shaft_under(-over * buckling), 0.0).unwrap();
        let expected = omega * (over - 1.0_f64).sqrt();
        assert!((found / expected - 1.0).abs() < 0.02, "{over}: {found} {expected}");
    }
    for below in [0.995, 0.5, -2.0] {
        assert_eq!(rate(&shaft_under(-below * buckling), 0.0), None, "{below}");
    }
}

/// The symmetric part of K is indefinite, but K has the double eigenvalue k: no motion diverges. With the sign of one
/// coefficient changed, det K < 0.
#[test]
fn coupling_alone_is_no_divergence() {
    let stable = rigid_rotor("k_x = \"1e6 N/m\"\nk_y = \"1e6 N/m\"\nk_xy = \"4e6 N/m\"\nk_yx = \"0 N/m\"");
    assert_eq!(rate(&stable, 0.0), None);
    let coupled = rigid_rotor("k_x = \"1e6 N/m\"\nk_y = \"1e6 N/m\"\nk_xy = \"2e6 N/m\"\nk_yx = \"2e6 N/m\"");
    // The eigenvalue k − k_xy = −k.
    let expected = (-200.0 + (200.0_f64.powi(2) + 4.0 * 10.0 * 2e6).sqrt()) / 20.0;
    assert!((rate(&coupled, 0.0).unwrap() / expected - 1.0).abs() < 1e-9);
}

/// Cross-coupling from 2000 to 4000 rpm only: stable at standstill and above.
fn unstable_band() -> Machine {
    let bearing = |name: &str| {
        format!(
            "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"linear\"\nk_z = \"1e7 N/m\"\nspeed = \
             \"0, 2000, 3000, 4000, 12000 rpm\"\nk_x = \"1e6 N/m\"\nk_y = \"1e6 N/m\"\nc_x = \"300 N s/m\"\n\
             c_y = \"300 N s/m\"\nk_xy = \"0, 0, 4e5, 0, 0 N/m\"\nk_yx = \"0, 0, -4e5, 0, 0 N/m\"\n"
        )
    };
    let rotor = "[model]\nname = \"band\"\ngravity = \"0 m/s^2\"\n[rotor]\ncentre = \"200 mm\"\nmass = \"10 kg\"\n\
                 polar_inertia = \"0.02 kg m^2\"\ndiametral_inertia = \"0.5 kg m^2\"\n[station]\nA = \"0 mm\"\n\
                 B = \"400 mm\"\n[unbalance.u]\nstation = \"A\"\nmagnitude = \"10 g mm\"\n\
                 [study.unbalance]\nspeeds = { from = \"200 rpm\", to = \"12000 rpm\", step = \"200 rpm\" }\n\
                 refine = false\n";
    machine(&format!("{rotor}{}{}", bearing("A"), bearing("B")))
}

/// Unstable where k_xy > c ω, ω² = 2 k/m: between 2671 and 3329 rpm.
#[test]
fn an_instability_within_the_speeds_is_named() {
    let machine = unstable_band();
    let rpm = TAU / 60.0;
    let omega = (2e6_f64 / 10.0).sqrt();
    let threshold = 2000.0 + 1000.0 * 300.0 * omega / 4e5;
    let speed_of = |results: &Results| -> f64 {
        let warnings = machine.warnings(results, &[100.0]);
        let found =
            warnings.iter().find(|w| w.code == Code::UnstableMode).unwrap_or_else(|| panic!("{warnings:?}"));
        let (_, rest) = found.text.split_once("unstable at ").unwrap();
        rest.split_once(" rpm").unwrap().0.parse().unwrap()
    };
    let critical = CriticalStudy { max_speed: 9000.0 * rpm, orders: vec![1.0] };
    let critical = Results { critical: Some(machine.critical(&critical).unwrap()), ..Results::default() };
    let study = machine.model.studies.unbalance.clone().unwrap();
    let unbalance = Results { unbalance: Some(machine.unbalance(&study).unwrap()), ..Results::default() };
    for results in [&critical, &unbalance] {
        let speed = speed_of(results);
        assert!(speed > threshold && speed < 6000.0 - threshold, "{speed} of {threshold}");
    }
}

/// A machine as a whole a hundred times smaller: all frequencies a hundred times higher, the rotation about z still free.
#[test]
fn small_machines_turn_freely() {
    let text = |scale: f64| {
        let length = |mm: f64| format!("\"{} mm\"", mm * scale);
        format!(
            "[model]\nname = \"scaled\"\n[material.steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\
             [shaft]\nelement_length = {}\n[[shaft.section]]\nlength = {}\nouter_diameter = {}\n[[shaft.section]]\n\
             length = {}\nouter_diameter = {}\n[station]\nA = {}\nB = {}\n[bearing.A]\nstation = \"A\"\nmodel = \"linear\"\n\
             k_x = \"{k} N/m\"\nk_y = \"{k} N/m\"\nk_z = \"{k} N/m\"\n[bearing.B]\nstation = \"B\"\nmodel = \"linear\"\n\
             k_x = \"{k} N/m\"\nk_y = \"{k} N/m\"\n",
            length(52.0),
            length(600.0),
            length(60.0),
            length(400.0),
            length(100.0),
            length(100.0),
            length(900.0),
            k = 2e8 * scale
        )
    };
    let torsion = |scale: f64| {
        let machine = machine(&text(scale));
        let system = machine.linear_system(0.0).unwrap();
        let found = rotordyn::analysis::torsional::torsional_modes(&machine.assembly, &system, 6).unwrap();
        assert_eq!(found.rigid_rotations, 1, "{scale}");
        assert_eq!(machine.support_warnings(&[0.0, 1e4]), [], "{scale}");
        found.modes.iter().map(|mode| mode.frequency_hz * scale).collect::<Vec<_>>()
    };
    let usual = torsion(1.0);
    for scale in [0.1, 0.02, 0.01, 0.003] {
        for (small, usual) in torsion(scale).iter().zip(&usual) {
            assert!((small / usual - 1.0).abs() < 1e-8, "{scale}: {small} {usual}");
        }
    }
}
