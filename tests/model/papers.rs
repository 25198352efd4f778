//! The models of two papers contain the printed values and the values derived from them.

use rotordyn::bearing::{BallBearing, BallInertia, Bearing, Preload};
use rotordyn::contact::ContactLaw;
use rotordyn::model::study::ModalStudy;
use rotordyn::model::{self, Model, Options};
use rotordyn::study::Machine;

const BAL: &str = include_str!("../../models/bal_2022.toml");
const ZHANG: &str = include_str!("../../models/zhang_2016.toml");

fn load(text: &str, variant: Option<&str>) -> Model {
    let options = Options { variant: variant.map(String::from), ..Options::default() };
    let loaded = model::load("paper.toml", text, &options).unwrap();
    assert_eq!(loaded.warnings, []);
    loaded.model
}

fn balls(model: &Model) -> Vec<&BallBearing> {
    model
        .bearings
        .iter()
        .filter_map(|site| match &site.bearing {
            Bearing::Ball(ball) => Some(ball),
            Bearing::Linear(_) | Bearing::RadialBall(_) | Bearing::FreeBall(_) => None,
        })
        .collect()
}

#[track_caller]
fn near(a: f64, b: f64, tolerance: f64) {
    assert!((a / b - 1.0).abs() < tolerance, "{a} {b}");
}

/// Inertias and series stiffness of an independent implementation of the paper, to its stated 1e-6.
#[test]
fn bal_2022() {
    let model = load(BAL, None);
    let rotor = model.rigid_rotor.as_ref().unwrap();
    near(rotor.diametral_inertia, 0.121_48, 1e-12);
    near(rotor.polar_inertia, 0.000_96, 1e-12);
    for (ball, direction) in balls(&model).into_iter().zip([1.0, -1.0]) {
        near(ball.hertz().stiffness, 9_971_423_251.0, 1e-6);
        assert_eq!(ball.geometry.thrust_direction, direction);
        assert_eq!(ball.preload, Preload::DryForce(150.0));
        assert!(matches!(ball.contact, ContactLaw::Film { .. }));
    }
    for force in [20.0, 50.0, 100.0, 150.0, 200.0, 500.0] {
        let dry = load(BAL, Some(&format!("preload_{force}")));
        assert!(balls(&dry).iter().all(|ball| ball.preload == Preload::DryForce(force)));
        let name = if force == 150.0 { "force".into() } else { format!("force_{force}") };
        let constant_force = load(BAL, Some(&name));
        assert!(balls(&constant_force).iter().all(|ball| ball.preload == Preload::Force(force)));
    }
    assert!(balls(&load(BAL, Some("dry_20"))).iter().all(|ball| ball.contact == ContactLaw::Hertz));
}

/// Table 2, and the series stiffness 1.073671e10 N/m^1.5 that follows from table 1.
#[test]
fn zhang_2016() {
    let model = load(ZHANG, None);
    near(balls(&model)[0].hertz().stiffness, 1.073_671e10, 1e-6);
    for (variant, stiffness, exponent, offset) in [
        ("dry10", 1.078e10, 1.5, -19.214),
        ("dry30", 1.180e10, 1.51, -155.465),
        ("ehl10", 8.562e9, 1.475, 30.207),
        ("ehl30", 7.281e9, 1.457, -57.05),
    ] {
        let model = load(ZHANG, Some(variant));
        for ball in balls(&model) {
            let ContactLaw::PowerLaw(law) = &ball.contact else { panic!("{variant}") };
            assert_eq!((law.stiffness, law.exponent, law.offset), (stiffness, exponent, offset));
            assert_eq!(law.range, [600.0, 2000.0]);
        }
        let rpm = if variant.ends_with("30") { 18924.0 } else { 6308.0 };
        near(model.profile.top_speed(), rpm * std::f64::consts::PI / 30.0, 1e-14);
    }
    let slow = load(ZHANG, Some("film_of_the_paper"));
    let ContactLaw::Film { speed_factor, lubricant } = &balls(&slow)[0].contact else { panic!() };
    near(speed_factor * std::f64::consts::TAU, 1.0, 1e-14);
    assert_eq!((lubricant.viscosity, lubricant.pressure_viscosity), (0.096, 1.82e-8));
    let inertia = load(ZHANG, Some("centrifugal"));
    assert_eq!(balls(&inertia)[0].inertia, BallInertia::OuterRaceControl);
}

/// A body mode is labelled by its body; only a bearing's own housing is called housing.
#[test]
fn labels_of_body_modes() {
    for (file, present, absent) in [
        ("overhung_rig", "housing B, u_", "housing disc"),
        ("atef_2022", "resonator, u_", "housing resonator"),
    ] {
        let path = format!("{}/models/{file}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap();
        let machine = Machine::new(model::load(&path, text, &Default::default()).unwrap().model).unwrap();
        let found = machine.modal(&ModalStudy { speeds: vec![0.0], modes: 16 }).unwrap();
        let labels: Vec<&str> = found[0].modes.iter().map(|mode| mode.label.as_str()).collect();
        assert!(labels.iter().any(|label| label.contains(present)), "{file}: {labels:?}");
        assert!(!labels.iter().any(|label| label.contains(absent)), "{file}: {labels:?}");
    }
}
