//! Thresholds of stability: by their closed form between the speeds of a diagram, of the right mode, and as warnings state them;
//! and none by round-off.

use rotordyn::model::study::{CampbellStudy, CriticalStudy};
use rotordyn::model::{Options, load};
use rotordyn::study::{Machine, Results};
use rotordyn::warning::Code;
use std::f64::consts::TAU;

const RPM: f64 = TAU / 60.0;

fn machine(text: &str) -> Machine {
    let loaded = load("machine.toml", text, &Options::default());
    Machine::new(loaded.unwrap_or_else(|errors| panic!("{errors:?}")).model).unwrap()
}

/// A rigid rotor of 10 kg on two bearings of 1e6 N/m, 2 m apart, whose k_xy = -k_yx runs over speed; all frequencies without
/// rotation are 71.18 Hz, if `k_zz` is 1e6 N/m the axial one too.
fn rotor(speeds: &str, k_xy: &str, c: &str, k_zz: &str) -> Machine {
    let opposite: Vec<String> =
        k_xy.split(", ").map(|k| if k == "0" { "0".into() } else { format!("-{k}") }).collect();
    let bearing = |name: &str| {
        format!(
            "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"linear\"\nspeed = \"{speeds} rpm\"\nk_xx = \"1e6 N/m\"\n\
             k_yy = \"1e6 N/m\"\nk_zz = \"{k_zz} N/m\"\nk_xy = \"{k_xy} N/m\"\nk_yx = \"{} N/m\"\nc_xx = \"{c} N s/m\"\n\
             c_yy = \"{c} N s/m\"\n",
            opposite.join(", ")
        )
    };
    machine(&format!(
        "[model]\nname = \"rotor\"\n[rotor]\ncentre = \"0 m\"\nmass = \"10 kg\"\npolar_inertia = \"0.01 kg m^2\"\n\
         diametral_inertia = \"10 kg m^2\"\n[station]\nA = \"-1 m\"\nB = \"1 m\"\n{}{}",
        bearing("A"),
        bearing("B")
    ))
}

/// Of a diagram of 25 speeds up to 3000 rpm: thresholds \[rpm\] with the labels of their modes, and texts of the warnings.
fn diagram(machine: &Machine) -> (Vec<(f64, bool, String)>, Vec<String>) {
    let speeds: Vec<f64> = (0..25).map(|k| 125.0 * f64::from(k) * RPM).collect();
    let study = CampbellStudy {
        speeds: speeds.clone(),
        modes: 12,
        orders: vec![1.0],
        speed_dependent_bearings: true,
    };
    let found = machine.campbell(&study).unwrap();
    let thresholds = found
        .thresholds
        .iter()
        .map(|of| (of.speed / RPM, of.unstable_above, of.mode.label.clone()))
        .collect();
    let results = Results { campbell: Some(found), ..Results::default() };
    let warnings = machine.warnings(&results, &speeds);
    let unstable = warnings.into_iter().filter(|warning| warning.code == Code::UnstableMode);
    (thresholds, unstable.map(|warning| warning.text).collect())
}

/// Translation is unstable where k_xy > c ω, ω² = 2 k/m, between two speeds of the diagram. From 0 at 1200 rpm to its maximum at
/// 1210 rpm k_xy runs without a slope at either end, as 3 t² - 2 t³.
#[test]
fn a_narrow_range_of_a_table_has_its_thresholds() {
    let speeds = "0, 1190, 1200, 1210, 1220, 1230, 3000";
    let (found, warnings) = diagram(&rotor(speeds, "0, 0, 0, 5e5, 0, 0, 0", "50", "3e6"));
    let share = 50.0 * (2e6_f64 / 10.0).sqrt() / 5e5;
    let rise = |t: f64| t * t * (3.0 - 2.0 * t) - share;
    // Newton's method.
    let within = 10.0 * (0..20).fold(0.2, |t, _| t - rise(t) / (6.0 * t * (1.0 - t)));
    for (expected, above) in [(1200.0 + within, true), (1220.0 - within, false)] {
        let of = |(rpm, side, _): &&(f64, bool, String)| (rpm - expected).abs() < 1e-3 && *side == above;
        assert!(found.iter().any(|one| of(&one)), "{expected}: {found:?}");
    }
    assert_eq!(found.len(), 4, "translation and tilt: {found:?}");
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    assert!(
        warnings.iter().all(|text| text.ends_with("is unstable from 1201.3 to 1218.7 rpm")),
        "{warnings:?}"
    );
}

/// k_xy = 5 (N/m)/rpm and c = 20 N s/m per bearing: c ω is reached at 1788.9 rpm, where the forward mode has the frequency of the
/// axial one.
#[test]
fn a_threshold_where_frequencies_coincide_is_that_of_the_whirling_mode() {
    let (found, warnings) = diagram(&rotor("0, 3000", "0, 15e3", "20", "1e6"));
    let expected = 20.0 * (2e6_f64 / 10.0).sqrt() / 5.0;
    assert_eq!(found.len(), 2, "{found:?}");
    assert!((found[0].0 / expected - 1.0).abs() < 1e-6, "{found:?}");
    assert!(found.iter().all(|(_, above, label)| *above && label.contains("forward")), "{found:?}");
    // The warnings state the thresholds, not the next speed of the diagram.
    for (rpm, _, _) in &found {
        let stated = format!("is unstable above {rpm:.1} rpm");
        assert!(warnings.iter().any(|text| text.ends_with(&stated)), "{stated}: {warnings:?}");
    }
    assert_eq!(warnings.len(), 2, "{warnings:?}");
}

/// A rotor that nothing holds and nothing damps precesses slowly; the real part of that mode is round-off.
#[test]
fn the_slow_precession_of_a_free_rotor_does_not_grow() {
    for (element, diameter) in
        [("50 mm", "20 mm"), ("50 mm", "30 mm"), ("20 mm", "15 mm"), ("100 mm", "20 mm")]
    {
        let free = machine(&format!(
            "[model]\nname = \"free\"\ngravity = \"0 m/s^2\"\n[material.s]\nyoung = \"210 GPa\"\npoisson = 0.3\n\
             density = \"7850 kg/m^3\"\n[shaft]\nelement_length = \"{element}\"\nshear = \"none\"\n\
             section = [{{ length = \"2 m\", outer_diameter = \"{diameter}\" }}]\n"
        ));
        let study = CriticalStudy { max_speed: 6000.0 * RPM, orders: vec![1.0] };
        let found = free.critical(&study).unwrap();
        assert!(found.crossings.unstable.is_empty(), "{element} {diameter}: {:?}", found.crossings.unstable);
        let results = Results { critical: Some(found), ..Results::default() };
        let warnings = free.warnings(&results, &[study.max_speed]);
        assert!(warnings.iter().all(|warning| warning.code != Code::UnstableMode), "{warnings:?}");
    }
}
