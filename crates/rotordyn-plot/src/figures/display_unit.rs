//! Display units of figures.

use rotordyn_core::series::Series;

/// Display unit: factor from SI and name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayUnit {
    pub factor: f64,
    pub name: &'static str,
}

/// Display unit of a quantity stored in the unit `si`; also the reference of dB levels.
pub fn unit(si: &str) -> DisplayUnit {
    let (factor, name) = match si {
        "m" => (1e6, "µm"),
        "m/s" => (1e3, "mm/s"),
        "m/s^2" => (1.0, "m/s²"),
        "rad" => (1e6, "µrad"),
        "rad/s" => (1e3, "mrad/s"),
        "rad/s^2" => (1.0, "rad/s²"),
        "N" => (1.0, "N"),
        "J" => (1.0, "J"),
        _ => (1.0, "SI"),
    };
    DisplayUnit { factor, name }
}

/// Name of the quantity with a unit.
pub fn quantity(si: &str) -> &'static str {
    match si {
        "m" => "displacement",
        "m/s" => "velocity",
        "m/s^2" => "acceleration",
        "rad" => "rotation",
        "rad/s" => "angular velocity",
        "rad/s^2" => "angular acceleration",
        "N" => "force",
        "J" => "energy",
        _ => "level",
    }
}

/// Levels in dB re 1 unit of `display`.
pub fn decibels(amplitude: &[f64], display: DisplayUnit) -> Vec<f64> {
    amplitude.iter().map(|a| decibel(*a, display)).collect()
}

/// The same, computed when they are read.
pub fn decibels_of(amplitude: &Series, display: DisplayUnit) -> Series {
    amplitude.mapped(move |a| decibel(a, display))
}

fn decibel(amplitude: f64, display: DisplayUnit) -> f64 {
    20.0 * (amplitude * display.factor).log10()
}

/// Typographic unit: `m/s^2` becomes `m/s²`.
pub fn typographic_unit(si: &str) -> String {
    si.replace("^2", "²").replace("N m", "N·m")
}
