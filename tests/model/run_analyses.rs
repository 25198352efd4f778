//! Spectrograms and orders of a run-up against what the speed profile gives; empty tables of studies; names of probes.

use rotordyn::model::{self, Kind, Model, ModelErrors, Options};
use std::f64::consts::TAU;

const MACHINE: &str = r#"
    model = { name = "m" }
    material.steel = { young = "207 GPa", poisson = 0.3, density = "7850 kg/m^3" }
    station = { A = "30 mm", B = "380 mm", fan = "480 mm" }
    shaft = { element_length = "50 mm", section = [{ length = "500 mm", outer_diameter = "25 mm" }] }
    disc.fan = { station = "fan", outer_diameter = "250 mm", thickness = "15 mm" }
    bearing.A = { model = "ball", station = "A", designation = "6205" }
    bearing.B = { model = "linear", station = "B", k_xx = "1e7 N/m", k_yy = "1e7 N/m" }
    unbalance.fan = { station = "fan", magnitude = "10 g mm" }
"#;

fn loaded(speed: &str, more: &str) -> Result<Model, Vec<(Kind, String)>> {
    let speed = format!("speed = {{ profile = \"ramp\", {speed} }}\n");
    match model::load("m.toml", format!("{MACHINE}{speed}{more}"), &Options::default()) {
        Ok(loaded) => loaded.refuse_conflicts().map(|()| loaded.model).map_err(listed),
        Err(errors) => Err(listed(errors)),
    }
}

fn listed(errors: ModelErrors) -> Vec<(Kind, String)> {
    errors.diagnostics.iter().map(|d| (d.kind, d.message.clone())).collect()
}

/// 3000 rpm in 2 s.
const RAMP: &str = "to = \"3000 rpm\", ramp = \"2 s\"";

/// The one message of a file that is refused.
fn refused(speed: &str, more: &str) -> String {
    let found = loaded(speed, more).expect_err(more);
    assert_eq!(found.len(), 1, "{more}: {found:?}");
    assert!(matches!(found[0].0, Kind::Conflict | Kind::OutOfRange), "{found:?}");
    found[0].1.clone()
}

#[test]
fn studies_of_a_run_up_work_together_by_default() {
    let studies = loaded(RAMP, "study = { run_up = {}, orders = {}, spectrogram = {} }").unwrap().studies;
    // 20 orders of 50 Hz, each 2.56 samples.
    let rate = studies.run_up.unwrap().sample_rate;
    assert!((2560.0..2700.0).contains(&rate), "{rate}");
    assert!((studies.orders.unwrap().max_order - 20.0).abs() < 1e-12);
    assert!((studies.spectrogram.unwrap().max_frequency - 0.5 * rate).abs() < 1e-9);
    // Without orders, and at a lower speed, the rate stays.
    for (speed, more) in [
        (RAMP, "study = { run_up = {} }"),
        ("to = \"1200 rpm\", ramp = \"2 s\"", "study = { run_up = {}, orders = {} }"),
    ] {
        let rate = loaded(speed, more).unwrap().studies.run_up.unwrap().sample_rate;
        assert!((rate - 2000.0).abs() < 1e-9, "{rate}");
    }
    // A given rate limits the orders.
    let more = "study = { run_up = { sample_rate = \"1 kHz\" }, orders = {} }";
    let highest = loaded(RAMP, more).unwrap().studies.orders.unwrap().max_order;
    assert!((7.0..1000.0 / 2.56 / 50.0).contains(&highest), "{highest}");
}

#[test]
fn orders_beyond_the_sampling_rate_are_refused_with_both_keys() {
    for orders in ["max_order = 10", "cuts = [9]", "max_order = 10, cuts = [9]"] {
        let more = format!("study = {{ run_up = {{ sample_rate = \"1 kHz\" }}, orders = {{ {orders} }} }}");
        let message = refused(RAMP, &more);
        let key = if orders.contains("max_order") { "study.orders.max_order" } else { "study.orders.cuts" };
        assert!(message.contains(key) && message.contains("study.run_up.sample_rate"), "{message}");
    }
}

#[test]
fn windows_longer_than_the_run_are_refused_and_shortened_by_default() {
    // 12.5 turns in half a second.
    let short = "to = \"3000 rpm\", ramp = \"0.5 s\"";
    let studies = loaded(short, "study = { run_up = {}, orders = {}, spectrogram = {} }").unwrap().studies;
    let (length, resolution) = (studies.spectrogram.unwrap().length, studies.orders.unwrap().resolution);
    assert!((length - 0.25).abs() < 1e-12, "{length}");
    assert!((2.0 / 12.5..0.2).contains(&resolution), "{resolution}");
    for (more, key) in [
        ("study = { run_up = {}, spectrogram = { length = \"1 s\" } }", "study.spectrogram.length"),
        ("study = { run_up = {}, orders = { resolution = 0.05 } }", "study.orders.resolution"),
        ("study = { run_up = {}, orders = { resolution = 1.5 } }", "study.orders.resolution"),
        ("study = { run_up = {}, orders = { max_order = 20000 } }", "study.orders.max_order"),
        ("study = { run_up = {}, orders = { cuts = [1], bandwidth = 2 } }", "study.orders.bandwidth"),
    ] {
        let message = refused(short, more);
        assert!(message.contains(key), "{key}: {message}");
    }
    // All problems at once.
    let more = "study = { run_up = {}, spectrogram = { length = \"1 s\" }, orders = { resolution = 0.01 } }";
    assert_eq!(loaded(short, more).unwrap_err().len(), 2);
    // Nothing is known of a run by a motor's torque.
    let motor =
        "drive = { kind = \"torque\", station = \"A\", speed = \"0, 3000 rpm\", torque = \"1, 0 N m\" }\n";
    let more =
        "study = { run_up = { sample_rate = \"1 kHz\" }, orders = { max_order = 10, resolution = 0.01 } }";
    let found = loaded(short, &format!("{motor}{more}"));
    assert!(found.is_ok(), "{:?}", found.err());
}

/// The defaults of the commands, for a machine with speeds and one without.
#[test]
fn empty_tables_of_studies_have_defaults() {
    let more = "study = { campbell = {}, critical = {}, critical_map = {}, torsional = {}, frf = {}, unbalance = {} }";
    let studies = loaded(RAMP, more).unwrap().studies;
    let rpm = TAU / 60.0;
    let close = |a: f64, b: f64| (a - b).abs() < 1e-9 * b;
    let campbell = studies.campbell.unwrap().speeds;
    assert!(campbell.len() == 25 && campbell[0] == 0.0 && close(campbell[24], 3000.0 * rpm));
    assert!(close(studies.critical.unwrap().max_speed, 9000.0 * rpm));
    assert!(close(studies.critical_map.unwrap().max_speed, 9000.0 * rpm));
    assert!(close(studies.torsional.unwrap().max_speed, 4500.0 * rpm));
    let frequencies = studies.frf.unwrap().frequencies;
    assert!(frequencies.len() == 1997 && close(frequencies[1], 1.25) && close(frequencies[1996], 500.0));
    let speeds = studies.unbalance.unwrap().speeds;
    assert!(speeds.len() == 200 && close(speeds[0], rpm) && close(speeds[199], 4500.0 * rpm));
    let found = model::load("m.toml", format!("{MACHINE}{more}"), &Options::default()).unwrap();
    assert!(close(found.model.studies.critical.unwrap().max_speed, 6000.0 * rpm));
    assert!(found.defaults.iter().any(|default| default.path == "study.campbell.speeds"));
}

#[test]
fn probes_named_like_automatic_channels_are_refused() {
    let probe = |name: &str| format!("probe.{name} = {{ at = \"disc.fan\", direction = \"x\" }}");
    for name in ["A_force_x", "A_cage_angle", "B_force_z", "energy_work"] {
        let message = refused(RAMP, &probe(name));
        assert!(
            message.contains(&format!("probe.{name} has the name of the automatic channel")),
            "{message}"
        );
    }
    // A linear bearing has no cage, a prescribed speed no work of a drive.
    for name in ["B_cage_angle", "energy_drive", "A_force", "C_force_x"] {
        assert!(loaded(RAMP, &probe(name)).is_ok(), "{name}");
    }
}
