//! Lubricants: oils of a file, and the one that a bearing names.

use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Key, NamedTables, Quantity, Text, keys, named_tables, positive, quantity, text, within,
};
use crate::file::reader::Reader;
use rotordyn_bearing::contact::Lubricant;
use rotordyn_units::{DENSITY, PRESSURE_VISCOSITY, TEMPERATURE, VISCOSITY};
use std::ops::Range;

/// Limit viscosity η_p of the Roelands equation \[Pa s\]; the viscosity of an oil must be greater.
const ROELANDS_VISCOSITY: f64 = 6.315e-5;
/// Limits beyond which a value is no oil's: greases and polymers stay below, most oils by a factor of 100 and more.
const MAX_VISCOSITY: f64 = 1e3;
const MAX_PRESSURE_VISCOSITY: f64 = 1e-6;

keys! {
    /// Tables of this file.
    pub(super) static TOP: TopKeys {
        lubricant: NamedTables = named_tables(OilKeys::TABLE);
    }
}

keys! {
    /// `[lubricant.x]`.
    static OIL: OilKeys = "An oil at its operating temperature, by its viscosity grade or its properties." {
        grade: Text = text("a viscosity grade", "Viscosity grade of ISO 3448 of a mineral oil.").required("or viscosity")
            .example("\"ISO VG 68\"");
        temperature: Quantity = quantity(within(TEMPERATURE, Lubricant::GRADE_TEMPERATURES), "Temperature of the oil, of any grade.")
            .required("with grade").with("grade = \"ISO VG 68\"");
        viscosity: Quantity = quantity(positive(VISCOSITY), "Dynamic viscosity at the operating temperature.")
            .required("or grade");
        pressure_viscosity: Quantity = quantity(positive(PRESSURE_VISCOSITY), "Pressure-viscosity coefficient.")
            .required("with viscosity; of a grade from its viscosity");
        density: Quantity = quantity(positive(DENSITY), "Density; by default of a mineral oil, that of a grade at its temperature.")
            .default("870 kg/m^3");
    }
}

keys! {
    /// Of ball bearings with an oil.
    pub(super) static OIL_OF_BEARING: OilOfBearingKeys {
        lubricant: Text = text("name of a lubricant", "Oil of the film, of the friction torque and of the rating life.")
            .computed("the only one of the file, for a film").example("\"oil\"");
    }
}

/// `[lubricant.x]`: oils at their operating temperature.
pub(super) fn lubricants(top: &Reader) -> Vec<Lubricant> {
    let read = |(name, r): (&str, Reader)| {
        let oil = match r.one_of(&[&OIL.grade, &OIL.viscosity]) {
            Some(given) if given.is(&OIL.grade) => {
                let oil = grade(&r).unwrap_or_else(|| Lubricant {
                    name: String::new(),
                    viscosity: 1.0,
                    pressure_viscosity: 1.0,
                    density: 1.0,
                });
                Lubricant {
                    name: name.into(),
                    pressure_viscosity: r.or(&OIL.pressure_viscosity, oil.pressure_viscosity),
                    density: r.or(&OIL.density, oil.density),
                    ..oil
                }
            }
            _ => Lubricant {
                name: name.into(),
                viscosity: r.value(&OIL.viscosity),
                pressure_viscosity: r.value(&OIL.pressure_viscosity),
                density: r.value(&OIL.density),
            },
        };
        if r.has_no_errors() {
            check(&r, &oil);
        }
        r.finish();
        oil
    };
    top.items(&TOP.lubricant).into_iter().map(read).collect()
}

/// Refuses values that no oil has.
fn check(r: &Reader, oil: &Lubricant) {
    let refuse = |key: &Key<Quantity>, how: &str, expected: String| {
        let message = format!("{} is too {how} for an oil", r.name(key));
        r.log.error(Problem::new(Kind::OutOfRange, &r.span_of(key), message).expected(expected));
    };
    if oil.viscosity <= ROELANDS_VISCOSITY {
        refuse(&OIL.viscosity, "low", format!("above {ROELANDS_VISCOSITY:e} Pa s (Roelands' limit)"));
    }
    if oil.viscosity > MAX_VISCOSITY {
        refuse(&OIL.viscosity, "high", format!("up to {MAX_VISCOSITY} Pa s; an oil has 0.001 to 10 Pa s"));
    }
    if oil.pressure_viscosity > MAX_PRESSURE_VISCOSITY {
        let expected =
            format!("up to {MAX_PRESSURE_VISCOSITY:e} 1/Pa; an oil has 5e-9 to 4e-8 1/Pa (5 to 40 1/GPa)");
        refuse(&OIL.pressure_viscosity, "high", expected);
    }
}

/// `grade = "ISO VG 68"` at `temperature`.
fn grade(r: &Reader) -> Option<Lubricant> {
    let temperature = r.value(&OIL.temperature);
    let name = r.text(&OIL.grade)?;
    if !Lubricant::grades().any(|grade| grade == name) {
        let message = format!("unknown grade `{name}`");
        let problem = Problem::new(Kind::UnknownName, &r.span_of(&OIL.grade), message);
        r.log.error(problem.suggest(r.log, name, Lubricant::grades()));
    }
    Lubricant::grade(name, temperature)
}

/// Oil named by the key `lubricant`; without the key, the only oil of the file.
///
/// `film`: span of the contact law that needs it.
pub(super) fn of_bearing(r: &Reader, lubricants: &[Lubricant], film: &Range<usize>) -> Option<Lubricant> {
    let key: &Key<Text> = &OIL_OF_BEARING.lubricant;
    match r.text(key) {
        Some(name) => {
            let found = lubricants.iter().find(|oil| oil.name == name);
            if found.is_none() {
                let message = format!("unknown lubricant `{name}`");
                let problem = Problem::new(Kind::UnknownName, &r.span_of(key), message);
                let problem = problem.follows("lubricant");
                let problem = problem.suggest(r.log, name, lubricants.iter().map(|oil| oil.name.as_str()));
                r.log.error(match lubricants {
                    [] => problem.hint(format!(
                        "add [lubricant.{name}] with viscosity and pressure_viscosity, or grade and temperature"
                    )),
                    _ => problem,
                });
            }
            found.cloned()
        }
        None if r.has(key) => None,
        None => match lubricants {
            [only] => Some(only.clone()),
            _ => {
                let message = format!("{} has a film but no lubricant", r.path);
                let problem = Problem::new(Kind::MissingKey, film, message);
                r.log.error(match lubricants {
                    [] => problem
                        .expected("an oil for the film")
                        .hint("add lubricant = \"oil\" and [lubricant.oil] with grade = \"ISO VG 68\" and temperature = \"40 degC\""),
                    [first, ..] => problem
                        .expected("which of the lubricants")
                        .hint(format!("add lubricant = \"{}\"", first.name)),
                });
                None
            }
        },
    }
}
