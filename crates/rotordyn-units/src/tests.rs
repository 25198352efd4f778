//! Units, quantities and their errors.

use super::*;

#[test]
fn divisors_give_the_nearest_double() {
    assert_eq!(parse("60 um", LENGTH), Ok(60e-6));
    assert_eq!(parse("0.5 in", LENGTH), Ok(0.0127));
    assert_eq!(parse("2 um", LENGTH), Ok(2e-6));
    assert_eq!(parse("0.56 kg mm", UNBALANCE), Ok(0.56 / 1e3));
    assert_eq!(parse("207 GPa", PRESSURE), Ok(207e9));
    assert_eq!(parse("5 g mm", UNBALANCE), Ok(5e-6));
}

#[test]
fn compound_units() {
    assert_eq!(parse("1e5 N m/rad", TILT_STIFFNESS), Ok(1e5));
    assert_eq!(parse("1e5 N*m", TILT_STIFFNESS), Ok(1e5));
    assert_eq!(parse("9.80665 m/s²", ACCELERATION), Ok(9.80665));
    assert_eq!(parse("7850 kg/m^3", DENSITY), Ok(7850.0));
    assert_eq!(parse("3 N s/mm", DAMPING), Ok(3000.0));
    assert_eq!(parse("5 1/s", RATE), Ok(5.0));
    assert_eq!(parse("5 s^-1", RATE), Ok(5.0));
    assert_eq!(parse("5mm", LENGTH), Ok(5e-3));
    assert_eq!(parse("2 kN/mm", STIFFNESS), Ok(2e6));
    assert!((parse("1 lbf s^2*in", INERTIA).unwrap() - 0.112_984_829).abs() < 1e-9);
    assert!((parse("1 psi", PRESSURE).unwrap() - 6_894.757_293).abs() < 1e-6);
    assert!((parse("1 N m/deg", TILT_STIFFNESS).unwrap() - 57.295_779_513_082_32).abs() < 1e-12);
}

/// The inch, the pound and the standard gravity are exact by definition: 25.4 mm, 0.45359237 kg, 9.80665 m/s².
#[test]
fn inch_pound_units_are_exact() {
    let pound_force = 0.453_592_37 * 9.806_65;
    for (text, dimension, value) in [
        ("1 in", LENGTH, 0.0254),
        ("2 inch", LENGTH, 0.0508),
        ("1 mil", LENGTH, 25.4e-6),
        ("10 micron", LENGTH, 10e-6),
        ("1 lb", MASS, 0.453_592_37),
        ("1 lbf", FORCE, pound_force),
        ("1 lbf", FORCE, 4.448_221_615_260_5),
        ("1 kgf", FORCE, 9.806_65),
        ("1 psi", PRESSURE, pound_force / (0.0254 * 0.0254)),
        ("30 ksi", PRESSURE, 3e4 * pound_force / (0.0254 * 0.0254)),
        ("1 bar", PRESSURE, 1e5),
        ("1 lbf/in", STIFFNESS, pound_force / 0.0254),
        ("1 lbf s/inch", DAMPING, pound_force / 0.0254),
        ("1 rev/min", SPEED, TAU / 60.0),
        ("3 krpm", SPEED, 100.0 * std::f64::consts::PI),
        ("3 krpm", FREQUENCY, 50.0),
    ] {
        let found = parse(text, dimension).unwrap();
        assert!((found - value).abs() <= 4.0 * f64::EPSILON * value, "{text}: {found} is not {value}");
    }
}

#[test]
fn likely_units_are_valid_and_usual() {
    for (dimension, value, name, unit) in [
        (SPEED, 3000.0, "speed", "rpm"),
        (SPEED, 5.0, "speed", "rad/s"),
        (LENGTH, 25.0, "outer_diameter", "mm"),
        (LENGTH, 0.025, "outer_diameter", "m"),
        (LENGTH, 20.0, "radial_clearance", "um"),
        (ANGLE, 15.0, "contact_angle", "deg"),
        (PRESSURE, 207.0, "young", "GPa"),
        (PRESSURE, 207e9, "young", "Pa"),
        (TEMPERATURE, 40.0, "temperature", "degC"),
        (STIFFNESS, 1e7, "k_x", "N/m"),
    ] {
        assert_eq!(likely_unit(dimension, value, name), unit, "{value} {name}");
        assert!(parse(&format!("{value} {unit}"), dimension).is_ok(), "{value} {unit}");
    }
}

#[test]
fn speeds_angles_and_frequencies() {
    assert_eq!(parse("50 Hz", FREQUENCY), Ok(50.0));
    assert_eq!(parse("50 Hz", SPEED), Ok(50.0 * TAU));
    assert_eq!(parse("100 rad/s", SPEED), Ok(100.0));
    assert_eq!(parse("60 rpm", SPEED), Ok(TAU));
    assert_eq!(parse("1200 rpm", FREQUENCY), Ok(20.0));
    assert_eq!(parse("90 deg", ANGLE), Ok(TAU / 4.0));
    assert!(matches!(parse("100 1/s", SPEED), Err(UnitError::WrongDimension { .. })));
    assert!(matches!(parse("5 rpm", RATE), Err(UnitError::WrongDimension { .. })));
}

#[test]
fn temperatures_and_oils() {
    assert_eq!(parse("40 degC", TEMPERATURE), Ok(313.15));
    assert_eq!(parse("-10 °C", TEMPERATURE), Ok(263.15));
    assert_eq!(parse("300 K", TEMPERATURE), Ok(300.0));
    assert_eq!(parse("30 K", TEMPERATURE_DIFFERENCE), Ok(30.0));
    assert_eq!(parse("12e-6 1/K", EXPANSION), Ok(12e-6));
    assert_eq!(parse("12 um/m/K", EXPANSION), Ok(12e-6));
    assert_eq!(parse("0.04 Pa s", VISCOSITY), Ok(0.04));
    assert_eq!(parse("40 mPa s", VISCOSITY), Ok(0.04));
    assert_eq!(parse("40 cP", VISCOSITY), Ok(0.04));
    assert_eq!(parse("2.3e-8 1/Pa", PRESSURE_VISCOSITY), Ok(2.3e-8));
    assert_eq!(parse("23 1/GPa", PRESSURE_VISCOSITY), Ok(2.3e-8));
    let shifted = Err(UnitError::ScaleOfTemperature("degC".into()));
    assert_eq!(parse("30 degC", TEMPERATURE_DIFFERENCE), shifted);
    assert_eq!(parse("12e-6 1/degC", EXPANSION), shifted);
}

#[test]
fn lists_share_a_unit() {
    assert_eq!(parse_list("0, 600 1200 rpm", FREQUENCY), Ok(vec![0.0, 10.0, 20.0]));
    assert_eq!(parse_list("-0.2 -.15 0.3 m", LENGTH), Ok(vec![-0.2, -0.15, 0.3]));
    assert_eq!(parse_list("0.5", NUMBER), Ok(vec![0.5]));
    assert_eq!(parse_list("2 5 1/s", RATE), Ok(vec![2.0, 5.0]));
    assert_eq!(parse_list("0, 1/s", RATE), Ok(vec![0.0, 1.0]));
    assert_eq!(parse_list("0, 60 /min", RATE), Ok(vec![0.0, 1.0]));
    assert_eq!(parse("50 %", NUMBER), Ok(0.5));
}

#[test]
fn errors_name_the_cause() {
    assert_eq!(parse("60", LENGTH), Err(UnitError::NoUnit("60".into())));
    assert_eq!(parse("60 umm", LENGTH), Err(UnitError::UnknownUnit("umm".into())));
    assert_eq!(parse("abc", LENGTH), Err(UnitError::NoNumber("abc".into())));
    assert_eq!(parse("nan m", LENGTH), Err(UnitError::NotFinite("nan m".into())));
    assert_eq!(parse("-inf m", LENGTH), Err(UnitError::NotFinite("-inf m".into())));
    assert_eq!(parse("1e999 m", LENGTH), Err(UnitError::NotFinite("1e999".into())));
    assert_eq!(parse("1 m/", LENGTH), Err(UnitError::UnknownUnit("m/".into())));
    assert_eq!(parse("1 m^x", LENGTH), Err(UnitError::BadPower("m^x".into())));
    assert_eq!(parse("", LENGTH), Err(UnitError::NoNumber(String::new())));
    let wrong = parse("5 kg", LENGTH);
    let expected = UnitError::WrongDimension { unit: "kg".into(), found: "mass".into(), expected: "length" };
    assert_eq!(wrong, Err(expected));
}

/// Turns per minute have many names; what counts no turns keeps its unit.
#[test]
fn other_names_of_rpm() {
    for unit in ["RPM", "1/min", "/min", "min^-1", "min⁻¹", "r/min", "U/min", "rev/min", "1 / min"] {
        assert_eq!(parse(&format!("3000 {unit}"), FREQUENCY), Ok(50.0), "{unit}");
        assert_eq!(parse_list(&format!("0, 60 {unit}"), SPEED), Ok(vec![0.0, TAU]), "{unit}");
    }
    assert_eq!(parse("30 1/min", RATE), Ok(0.5));
    assert!(
        parse("3000 1/s", SPEED).is_err() && parse("3 r", ANGLE).is_err() && parse("3 RPM", RATE).is_err()
    );
}
