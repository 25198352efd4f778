//! Grades of mineral oil compared with ISO 3448, ASTM D2270, typical data sheets and measured α.

use crate::agree;
use rotordyn::contact::Lubricant;

const ZERO: f64 = 273.15;

fn at(name: &str, celsius: f64) -> Lubricant {
    Lubricant::grade(name, ZERO + celsius).unwrap()
}

/// ν in mm²/s.
fn kinematic(name: &str, celsius: f64) -> f64 {
    at(name, celsius).kinematic_viscosity() * 1e6
}

#[test]
fn viscosity_at_40_degrees_and_monotone_temperature_dependence() {
    let mut count = 0;
    for name in Lubricant::grades() {
        let number: f64 = name.strip_prefix("ISO VG ").unwrap().parse().unwrap();
        agree::relative(
            format_args!("{name}: viscosity at 40 °C [mm²/s]"),
            kinematic(name, 40.0),
            number,
            1e-12,
        );
        let mut before = at(name, -10.0);
        for celsius in (-9..=130).map(f64::from) {
            let here = at(name, celsius);
            assert!(here.viscosity < before.viscosity && here.density < before.density);
            assert!(here.pressure_viscosity < before.pressure_viscosity, "{name} at {celsius}");
            before = here;
        }
        count += 1;
    }
    assert_eq!(count, 12);
}

#[test]
fn viscosity_index_is_95() {
    // ASTM D2270: VI = 100 (L − U)/(L − H), L and H by its quadratics for the range of Y = ν(100 °C) named.
    let ranges = [
        ("ISO VG 46", 6.4..7.0, [3.35714, -23.5643, 78.466], [0.22619, 7.7369, -16.656]),
        ("ISO VG 100", 9.0..12.0, [0.88779, 7.5527, -16.600], [0.26665, 6.7015, -10.810]),
        ("ISO VG 150", 12.0..15.0, [0.76720, 10.7972, -38.180], [0.20073, 8.4658, -22.490]),
        ("ISO VG 220", 18.0..22.0, [0.97256, 5.2500, -0.980], [0.24504, 7.4160, -16.730]),
        ("ISO VG 680", 28.0..40.0, [0.87031, 9.7157, -50.770], [0.18411, 10.1015, -46.750]),
    ];
    for (name, range, low, high) in ranges {
        let (u, y) = (kinematic(name, 40.0), kinematic(name, 100.0));
        assert!(range.contains(&y), "{name}: {y}");
        let value = |c: [f64; 3]| c[0] * y * y + c[1] * y + c[2];
        let index = 100.0 * (value(low) - u) / (value(low) - value(high));
        agree::absolute(format_args!("{name}: viscosity index"), index, 95.0, 0.3);
    }
}

#[test]
fn typical_data_sheets_at_100_degrees() {
    // Mineral bearing oils with indices of 95 to 100, in mm²/s.
    for (name, sheet) in [
        ("ISO VG 32", 5.4),
        ("ISO VG 46", 6.8),
        ("ISO VG 68", 8.7),
        ("ISO VG 100", 11.2),
        ("ISO VG 220", 19.0),
    ] {
        let here = kinematic(name, 100.0);
        agree::relative(format_args!("{name}: viscosity of the data sheet"), here, sheet, 0.03);
    }
}

#[test]
fn pressure_viscosity_of_mineral_oils() {
    // Oils of published EHL computations and measurements: η₀ in mPa s, α in 1e-8 1/Pa. The correlation uses
    // the viscosity only; its accuracy is about 25 %.
    for (name, celsius, range) in [
        ("ISO VG 32", 40.0, 1.8..2.3),
        ("ISO VG 100", 40.0, 2.0..2.6),
        ("ISO VG 100", 100.0, 1.3..1.8),
        ("ISO VG 46", 42.0, 1.8..2.4),
    ] {
        let alpha = at(name, celsius).pressure_viscosity * 1e8;
        assert!(range.contains(&alpha), "{name} at {celsius}: {alpha}");
    }
}

#[test]
fn unknown_grades_and_temperatures_are_rejected() {
    assert!(Lubricant::grade("ISO VG 69", 313.15).is_none());
    assert!(Lubricant::grade("ISO VG 68", 40.0).is_none());
    assert!(Lubricant::grade("ISO VG 68", f64::NAN).is_none());
}
