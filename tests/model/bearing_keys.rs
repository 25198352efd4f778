//! Every key of a ball bearing's contact, mounting and service is read into the model, in SI units.

use rotordyn::bearing::{Arrangement, BallBearing, BallInertia, Duplex, Fit, Preload};
use rotordyn::contact::{ContactDamping, ContactLaw, ContactStiffness, Lubricant, PowerLaw};
use rotordyn::model::{self, Options};

fn bearing(lines: &str) -> BallBearing {
    let text = format!(
        "[model]\nname = \"b\"\n\
         [lubricant.thin]\nviscosity = \"40 mPa s\"\npressure_viscosity = \"23 1/GPa\"\ndensity = \"0.85 g/cm^3\"\n\
         [lubricant.graded]\ngrade = \"ISO VG 68\"\ntemperature = \"60 degC\"\n\
         [bearing.b]\nmodel = \"ball\"\ndesignation = \"7206B\"\n{lines}\n"
    );
    let file = model::load_bearings("b.toml", text, &Options::default()).unwrap_or_else(|e| panic!("{e}"));
    file.bearings[0].1.clone()
}

#[test]
fn contact_laws() {
    let default = bearing("thrust = \"+z\"");
    assert_eq!((default.contact, default.inertia), (ContactLaw::Hertz, BallInertia::Auto(None)));
    let film = bearing("thrust = \"+z\"\ncontact = \"film\"\nlubricant = \"thin\"\nspeed_factor = 0.5");
    let thin = Lubricant { name: "thin".into(), viscosity: 0.04, pressure_viscosity: 2.3e-8, density: 850.0 };
    assert_eq!(film.contact, ContactLaw::Film { lubricant: thin, speed_factor: 0.5 });
    let film = bearing("thrust = \"+z\"\ncontact = \"film\"\nlubricant = \"graded\"");
    let graded = Lubricant { name: "graded".into(), ..Lubricant::grade("ISO VG 68", 333.15).unwrap() };
    assert_eq!(film.contact, ContactLaw::Film { lubricant: graded, speed_factor: 1.0 });
    let law = "{ stiffness = \"8.562e9 N/m^1.475\", exponent = 1.475, offset = \"30.207 N\", range = \"0.6, 2 kN\" }";
    let fitted = bearing(&format!("thrust = \"+z\"\ncontact = \"power_law\"\npower_law = {law}"));
    let expected = PowerLaw { stiffness: 8.562e9, exponent: 1.475, offset: 30.207, range: [600.0, 2000.0] };
    assert_eq!(fitted.contact, ContactLaw::PowerLaw(expected));
}

/// A given contact stiffness replaces the Hertzian one, in series or for each contact.
#[test]
fn contact_stiffness() {
    let with = |line: &str| bearing(&format!("thrust = \"+z\"\n{line}"));
    let elastic = with("");
    assert_eq!(elastic.contact_stiffness, ContactStiffness::Elastic);
    let (own, of) = (elastic.hertz(), with("contact_stiffness = \"1.5e10 N/m^1.5\""));
    assert_eq!(of.contact_stiffness, ContactStiffness::Series(1.5e10));
    let given = of.hertz();
    assert_eq!(given.stiffness, 1.5e10);
    let [inner, outer] = [&given.inner, &given.outer].map(|c| c.stiffness);
    assert!((inner / outer / (own.inner.stiffness / own.outer.stiffness) - 1.0).abs() < 1e-14);
    let series = (inner.powf(-2.0 / 3.0) + outer.powf(-2.0 / 3.0)).powf(-1.5);
    assert!((series / 1.5e10 - 1.0).abs() < 1e-14);
    let each = with("contact_stiffness = { inner = \"4e10 N/m^1.5\", outer = \"4e10 N/m^1.5\" }").hertz();
    assert_eq!((each.inner.stiffness, each.outer.stiffness), (4e10, 4e10));
    // Two equal springs of power 3/2 in series: 2^(-3/2) of one.
    assert!((each.stiffness / (4e10 / 8f64.sqrt()) - 1.0).abs() < 1e-14);
}

#[test]
fn damping_and_inertia() {
    let with = |line: &str| bearing(&format!("thrust = \"+z\"\n{line}"));
    let constant = ContactDamping::Constant { coefficient: 300.0, ramp: 1e-6 };
    assert_eq!(with("").damping, constant);
    assert_eq!(with("hunt_crossley = \"0.1 s/m\"").damping, ContactDamping::HuntCrossley { factor: 0.1 });
    let film = "contact = \"film\"\nlubricant = \"thin\"\nfilm_damping = 1.5";
    assert_eq!(with(film).damping, ContactDamping::Film { factor: 1.5 });
    for (word, inertia) in [
        ("none", BallInertia::None),
        ("outer_race_control", BallInertia::OuterRaceControl),
        ("inner_race_control", BallInertia::InnerRaceControl),
        ("shared", BallInertia::Shared),
        ("auto", BallInertia::Auto(None)),
        ("harris_inner_race_control", BallInertia::HarrisInnerRaceControl),
        ("centrifugal", BallInertia::Centrifugal),
    ] {
        assert_eq!(with(&format!("ball_inertia = \"{word}\"")).inertia, inertia);
    }
    let given = with("ball_inertia = { centrifugal_force = \"0.12 kN\" }").inertia;
    assert_eq!(given, BallInertia::CentrifugalForce(120.0));
}

#[test]
fn preload_pairs_and_fits() {
    let with = |line: &str| bearing(&format!("thrust = \"-z\"\n{line}"));
    assert_eq!(with("").preload, Preload::None);
    assert_eq!(with("preload = { force = \"150 N\" }").preload, Preload::Force(150.0));
    assert_eq!(with("preload = { dry_force = \"0.15 kN\" }").preload, Preload::DryForce(150.0));
    assert_eq!(with("preload = { interference = \"1.5 um\" }").preload, Preload::Interference(1.5e-6));
    let spring = with("preload = { spring = \"200 N/mm\", force = \"150 N\" }").preload;
    assert_eq!(spring, Preload::Spring { stiffness: 2e5, force: 150.0 });
    assert_eq!(with("").duplex, None);
    let tandem = with("arrangement = \"tandem\"\nrow_spacing = \"16 mm\"");
    assert_eq!(tandem.duplex, Some(Duplex { arrangement: Arrangement::Tandem, spacing: 0.016 }));
    assert_eq!(tandem.geometry.thrust_direction, -1.0);
    for (word, arrangement) in
        [("back_to_back", Arrangement::BackToBack), ("face_to_face", Arrangement::FaceToFace)]
    {
        let pair = bearing(&format!("arrangement = \"{word}\"\nrow_spacing = \"16 mm\""));
        assert_eq!(pair.duplex, Some(Duplex { arrangement, spacing: 0.016 }));
    }
    let fit = with(
        "fit = { shaft_interference = \"8 um\", shaft_bore = \"10 mm\", housing_interference = \"2 um\", \
         housing_diameter = \"90 mm\", inner_temperature_rise = \"20 K\", outer_temperature_rise = \"5 K\", \
         expansion = \"11.5e-6 1/K\", speed_growth = true }",
    );
    let expected = Fit {
        shaft_interference: 8e-6,
        shaft_bore: 0.01,
        housing_interference: 2e-6,
        housing_diameter: 0.09,
        inner_temperature_rise: 20.0,
        outer_temperature_rise: 5.0,
        expansion: 11.5e-6,
        speed_growth: true,
    };
    assert_eq!((fit.fit, with("").fit), (expected, Fit::default()));
}

#[test]
fn moment_arm_and_service() {
    let given = bearing(
        "thrust = \"+z\"\nmoment_arm = \"23 mm\"\nlubricant = \"thin\"\ndynamic_rating = \"20.5 kN\"\n\
         static_rating = \"13.5 kN\"\nfatigue_limit = \"570 N\"\ncontamination = 0.8\nreliability = 0.95",
    );
    assert_eq!(given.geometry.moment_arm, Some(0.023));
    let s = &given.service;
    assert_eq!((s.dynamic_rating, s.static_rating), (Some(20_500.0), Some(13_500.0)));
    assert_eq!((s.fatigue_limit, s.contamination, s.reliability), (Some(570.0), 0.8, 0.95));
    assert_eq!(given.lubricant().map(|oil| oil.name.as_str()), Some("thin"));
    let film = bearing("thrust = \"+z\"\ncontact = \"film\"\nlubricant = \"graded\"");
    assert_eq!(film.lubricant().map(|oil| oil.name.as_str()), Some("graded"));
    assert_eq!(bearing("thrust = \"+z\"").lubricant(), None);
}

#[test]
fn lubrication_and_sliding_friction() {
    use rotordyn::bearing::friction::Lubrication;
    let by_default = bearing("thrust = \"+z\"").service;
    assert_eq!((by_default.lubrication, by_default.sliding_friction), (Lubrication::OilBath, 0.06));
    for (key, method) in [
        ("\"oil_mist\"", Lubrication::OilMist),
        ("\"oil_jet\"", Lubrication::OilJet),
        ("\"grease\"", Lubrication::Grease),
        ("{ f_0 = 1.6 }", Lubrication::Factor(1.6)),
    ] {
        let keys =
            format!("thrust = \"+z\"\nlubricant = \"thin\"\nlubrication = {key}\nsliding_friction = 0.09");
        let given = bearing(&keys).service;
        assert_eq!((given.lubrication, given.sliding_friction), (method, 0.09));
    }
}

/// Shoulder diameters of both races, and the range they must have.
#[test]
fn shoulder_diameters() {
    let with = |line: &str| bearing(&format!("thrust = \"+z\"\n{line}"));
    assert_eq!(with("").service.shoulder_diameters, [None; 2]);
    let given = with("inner_shoulder_diameter = \"42.5 mm\"\nouter_shoulder_diameter = \"51 mm\"");
    assert_eq!(given.service.shoulder_diameters, [Some(0.0425), Some(0.051)]);
    for (line, valid) in [
        ("inner_shoulder_diameter = \"30 mm\"", false),
        ("inner_shoulder_diameter = \"47 mm\"", false),
        ("inner_shoulder_diameter = \"40 mm\"", true),
        ("outer_shoulder_diameter = \"45 mm\"", false),
        ("outer_shoulder_diameter = \"70 mm\"", false),
        ("outer_shoulder_diameter = \"52 mm\"", true),
    ] {
        let text = format!(
            "[model]\nname = \"b\"\n[bearing.b]\nmodel = \"ball\"\ndesignation = \"7206B\"\nthrust = \"+z\"\n{line}\n"
        );
        let read = model::load_bearings("b.toml", text, &Options::default());
        assert_eq!(read.is_ok(), valid, "{line}");
    }
}
