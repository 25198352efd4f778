//! Lubricants, contact laws (Hertz, film, power law, EHL) and contact damping of a bearing.

use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative, positive};
use crate::file::tree::Value;
use rotordyn_bearing::Service;
use rotordyn_bearing::contact::ehl::{DEFAULT_POINTS, EhlLaw};
use rotordyn_bearing::contact::{
    ContactDamping, ContactLaw, ContactStiffness, HertzPair, Lubricant, PowerLaw,
};
use rotordyn_bearing::friction::Lubrication;
use rotordyn_units::{
    self as units, DAMPING, DENSITY, FORCE, INVERSE_SPEED, LENGTH, NUMBER, PRESSURE_VISCOSITY, TEMPERATURE,
    VELOCITY, VISCOSITY,
};

/// Default density: mineral oil \[kg/m³\].
const OIL_DENSITY: f64 = 870.0;
/// Limit viscosity η_p of the Roelands equation \[Pa s\]; the viscosity of an oil must be greater.
const ROELANDS_VISCOSITY: f64 = 6.315e-5;

/// `[lubricant.x]`: oils at their operating temperature.
pub(super) fn lubricants(top: &Reader) -> Vec<Lubricant> {
    let read = |(name, r): (&str, Reader)| {
        let oil = match r.one_of(&["grade", "viscosity"]) {
            Some("grade") => {
                let oil = grade(&r).unwrap_or_else(|| Lubricant {
                    name: String::new(),
                    viscosity: 1.0,
                    pressure_viscosity: 1.0,
                    density: 1.0,
                });
                Lubricant {
                    name: name.into(),
                    pressure_viscosity: r.or(
                        "pressure_viscosity",
                        positive(PRESSURE_VISCOSITY),
                        oil.pressure_viscosity,
                    ),
                    density: r.or("density", positive(DENSITY), oil.density),
                    ..oil
                }
            }
            _ => Lubricant {
                name: name.into(),
                viscosity: r.need("viscosity", positive(VISCOSITY)),
                pressure_viscosity: r.need("pressure_viscosity", positive(PRESSURE_VISCOSITY)),
                density: r.or("density", positive(DENSITY), OIL_DENSITY),
            },
        };
        if oil.viscosity <= ROELANDS_VISCOSITY && r.has_no_errors() {
            let message = format!("{} is too low for an oil", r.name("viscosity"));
            let problem = Problem::new(Kind::OutOfRange, &r.span_of("viscosity"), message);
            r.log.error(problem.expected(format!("above {ROELANDS_VISCOSITY:e} Pa s (Roelands' limit)")));
        }
        r.finish();
        oil
    };
    top.items("lubricant").into_iter().map(read).collect()
}

/// `grade = "ISO VG 68"` at `temperature`.
fn grade(r: &Reader) -> Option<Lubricant> {
    let temperature = r.need("temperature", positive(TEMPERATURE));
    let [coldest, hottest] = Lubricant::GRADE_TEMPERATURES;
    if r.has_no_errors() && !(coldest..=hottest).contains(&temperature) {
        let message =
            format!("{} is outside the temperature range of the viscosity grades", r.name("temperature"));
        let problem = Problem::new(Kind::OutOfRange, &r.span_of("temperature"), message);
        let celsius = |kelvin: f64| kelvin - 273.15;
        r.log.error(problem.expected(format!("{:.0} to {:.0} degC", celsius(coldest), celsius(hottest))));
    }
    let name = r.text("grade")?;
    if !Lubricant::grades().any(|grade| grade == name) {
        let message = format!("unknown grade `{name}`");
        let problem = Problem::new(Kind::UnknownName, &r.span_of("grade"), message);
        r.log.error(problem.suggest(name, Lubricant::grades()));
    }
    Lubricant::grade(name, temperature)
}

/// Whether the requested contact law has a lubricant film.
fn has_film(r: &Reader) -> bool {
    matches!(r.entry("contact").map(|e| &e.node.value), Some(Value::Text(word)) if word == "film" || word == "ehl")
}

/// Load ratings, oil and contamination factor for the rating life; with a film its oil is used.
pub(super) fn service(r: &Reader, lubricants: &[Lubricant]) -> Service {
    let default = Service::default();
    let rating = |key: &str| r.get(key, positive(FORCE));
    let between = |key: &str, [low, high]: [f64; 2], default: f64| {
        let value = r.or(key, not_negative(NUMBER), default);
        if !(low..=high).contains(&value) {
            let problem =
                Problem::new(Kind::OutOfRange, &r.span_of(key), format!("{} is out of range", r.name(key)));
            r.log.error(problem.expected(format!("from {low} to {high}")));
        }
        value
    };
    if r.has("lubrication") && !has_film(r) && !r.has("lubricant") {
        let message = format!("{} needs the lubricant of the bearing", r.name("lubrication"));
        let problem = Problem::new(Kind::MissingKey, &r.span_of("lubrication"), message);
        r.log.error(problem.hint(
            "add lubricant = \"oil\" and [lubricant.oil]: its viscosity gives the viscous friction torque",
        ));
    }
    Service {
        dynamic_rating: rating("dynamic_rating"),
        static_rating: rating("static_rating"),
        fatigue_limit: rating("fatigue_limit"),
        lubricant: if has_film(r) || !r.has("lubricant") { None } else { lubricant(r, lubricants) },
        lubrication: lubrication(r),
        sliding_friction: between("sliding_friction", [0.0, 1.0], default.sliding_friction),
        contamination: between("contamination", [0.0, 1.0], default.contamination),
        reliability: between("reliability", [0.9, 0.999], default.reliability),
        shoulder_diameters: ["inner_shoulder_diameter", "outer_shoulder_diameter"]
            .map(|key| r.get(key, positive(LENGTH))),
    }
}

const LUBRICATIONS: [(&str, Lubrication); 4] = [
    ("oil_bath", Lubrication::OilBath),
    ("oil_mist", Lubrication::OilMist),
    ("oil_jet", Lubrication::OilJet),
    ("grease", Lubrication::Grease),
];

/// Lubrication method: a keyword, or `{ f_0 = 1.5 }`.
fn lubrication(r: &Reader) -> Lubrication {
    if !matches!(r.entry("lubrication").map(|e| &e.node.value), Some(Value::Table(_))) {
        return r.choice("lubrication", &LUBRICATIONS).unwrap_or_default();
    }
    let Some(given) = r.table("lubrication") else { return Lubrication::default() };
    let factor = given.need("f_0", positive(NUMBER));
    given.finish();
    Lubrication::Factor(factor)
}

/// Oil named by the key `lubricant`; without the key, the only oil of the file.
fn lubricant(r: &Reader, lubricants: &[Lubricant]) -> Option<Lubricant> {
    match r.text("lubricant") {
        Some(name) => {
            let found = lubricants.iter().find(|oil| oil.name == name);
            if found.is_none() {
                let message = format!("unknown lubricant `{name}`");
                let problem = Problem::new(Kind::UnknownName, &r.span_of("lubricant"), message);
                let problem = problem.suggest(name, lubricants.iter().map(|oil| oil.name.as_str()));
                r.log.error(match lubricants {
                    [] => problem.hint(format!(
                        "add [lubricant.{name}] with viscosity and pressure_viscosity, or grade and temperature"
                    )),
                    _ => problem,
                });
            }
            found.cloned()
        }
        None if r.has("lubricant") => None,
        None => match lubricants {
            [only] => Some(only.clone()),
            _ => {
                let message = format!("{} has a film but no lubricant", r.path);
                let problem = Problem::new(Kind::MissingKey, &r.span_of("contact"), message);
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

/// `contact_stiffness = "1.58e10 N/m^1.5"` of both contacts in series, or `{ inner = "…", outer = "…" }`.
pub(super) fn stiffness(r: &Reader) -> ContactStiffness {
    const KEY: &str = "contact_stiffness";
    match r.entry(KEY).map(|e| &e.node.value) {
        None => ContactStiffness::Elastic,
        Some(Value::Table(_)) => {
            let Some(each) = r.table(KEY) else { return ContactStiffness::Elastic };
            let stiffness = ["inner", "outer"].map(|race| power_stiffness(&each, race, 1.5));
            each.finish();
            ContactStiffness::Each(stiffness)
        }
        Some(_) => ContactStiffness::Series(power_stiffness(r, KEY, 1.5)),
    }
}

/// Keywords of the key `contact`.
#[derive(Clone, Copy, PartialEq)]
enum ContactKeyword {
    Hertz,
    Film,
    PowerLaw,
    Ehl,
}

/// The contact law; [`ContactLaw::Hertz`] as placeholder after an error.
pub(super) fn contact_law(r: &Reader, lubricants: &[Lubricant], hertz: &HertzPair) -> ContactLaw {
    let words = [
        ("hertz", ContactKeyword::Hertz),
        ("film", ContactKeyword::Film),
        ("power_law", ContactKeyword::PowerLaw),
        ("ehl", ContactKeyword::Ehl),
    ];
    let word = r.choice("contact", &words);
    let law = word.unwrap_or(ContactKeyword::Hertz);
    if r.has("contact") && word.is_none() {
        ["speed_factor", "power_law", "ehl"].iter().for_each(|key| _ = r.entry(key));
        return ContactLaw::Hertz;
    }
    let without = |key: &str, needed: &str| {
        if r.has(key) {
            let message = format!("{} applies only with contact = \"{needed}\"", r.name(key));
            r.error(Kind::Conflict, key, message);
        }
    };
    if law != ContactKeyword::PowerLaw {
        without("power_law", "power_law");
    }
    if law != ContactKeyword::Ehl {
        without("ehl", "ehl");
    }
    if !matches!(law, ContactKeyword::Film | ContactKeyword::Ehl) {
        without("speed_factor", "film");
    }
    match law {
        ContactKeyword::Hertz => ContactLaw::Hertz,
        ContactKeyword::Film => {
            let speed_factor = r.or("speed_factor", positive(NUMBER), 1.0);
            lubricant(r, lubricants)
                .map_or(ContactLaw::Hertz, |lubricant| ContactLaw::Film { lubricant, speed_factor })
        }
        ContactKeyword::PowerLaw => power_law(r),
        ContactKeyword::Ehl => ehl_law(r, lubricants, hertz),
    }
}

/// EHL law: `ehl = { loads = "5, 5000 N", speeds = "0.1, 16 m/s", points = 6 }`, all optional: range of the
/// tables.
fn ehl_law(r: &Reader, lubricants: &[Lubricant], hertz: &HertzPair) -> ContactLaw {
    let speed_factor = r.or("speed_factor", positive(NUMBER), 1.0);
    let pressure = hertz.inner.patch(1.0).maximum_pressure;
    let mut loads = [0.4e9, 4.2e9].map(|p: f64| (p / pressure).powi(3));
    // Default speeds up to about n D_pw = 600 000 rpm mm, the limit of grease and most oil lubrication.
    let mut speeds = [0.1, 16.0].map(|u| u * speed_factor);
    let (mut counts, mut points) = ([8, 5], DEFAULT_POINTS);
    if let Some(table) = r.table("ehl") {
        let range = |key: &str, dimension, default: [f64; 2]| match table.list(key, positive(dimension)) {
            None => default,
            Some(values) => match values[..] {
                [from, to] if from < to => [from, to],
                _ => {
                    if table.has_no_errors() {
                        let message = format!("{} is not a range", table.name(key));
                        let problem = Problem::new(Kind::OutOfRange, &table.span_of(key), message);
                        table.log.error(problem.expected("the minimum and the maximum value"));
                    }
                    default
                }
            },
        };
        loads = range("loads", FORCE, loads);
        speeds = range("speeds", VELOCITY, speeds);
        counts = [table.count("load_count", 8, 2..=100), table.count("speed_count", 5, 2..=100)];
        points = table.count("points", DEFAULT_POINTS, 2..=24);
        table.finish();
    }
    lubricant(r, lubricants).map_or(ContactLaw::Hertz, |lubricant| {
        ContactLaw::Ehl(EhlLaw { lubricant, speed_factor, loads, speeds, counts, points, tables: None })
    })
}

/// `power_law = { stiffness = "8.562e9 N/m^1.475", exponent = 1.475, offset = "30 N", range = "600, 2000 N" }`.
fn power_law(r: &Reader) -> ContactLaw {
    let Some(law) = r.table("power_law") else {
        if !r.has("power_law") {
            r.missing(
                "power_law",
                "{ stiffness = \"1e10 N/m^1.5\", exponent = 1.5, offset = \"0 N\", range = \"600, 2000 N\" }",
            );
        }
        return ContactLaw::Hertz;
    };
    let exponent = law.need("exponent", positive(NUMBER));
    if !(1.0..=3.0).contains(&exponent) && law.has_no_errors() {
        let message = format!("{} is {exponent}", law.name("exponent"));
        let problem = Problem::new(Kind::OutOfRange, &law.span_of("exponent"), message);
        law.log.error(problem.expected("from 1 to 3; a dry point contact has 1.5"));
    }
    let stiffness = power_stiffness(&law, "stiffness", exponent);
    let offset = law.or("offset", any(FORCE), 0.0);
    let range = law.need_list("range", positive(FORCE));
    let range = match range[..] {
        [from, to] if from < to => [from, to],
        _ => {
            if law.has_no_errors() {
                let message = format!("{} is not a range of loads", law.name("range"));
                let problem = Problem::new(Kind::OutOfRange, &law.span_of("range"), message);
                law.log
                    .error(problem.expected("the minimum and the maximum load of the fit, \"600, 2000 N\""));
            }
            [0.0, 1.0]
        }
    };
    if offset >= range[0] && law.has_no_errors() {
        let message =
            format!("{} is too large: the law needs no deflection for its minimum load", law.name("offset"));
        let problem = Problem::new(Kind::OutOfRange, &law.span_of("offset"), message);
        law.log.error(problem.expected(format!("less than the minimum load of the fit, {} N", range[0])));
    }
    law.finish();
    ContactLaw::PowerLaw(PowerLaw { stiffness, exponent, offset, range })
}

/// K in N/mⁿ; its unit must contain the exponent: "8.562e9 N/m^1.475".
pub(super) fn power_stiffness(r: &Reader, key: &str, exponent: f64) -> f64 {
    let unit = format!("N/m^{exponent}");
    let Some(entry) = r.entry(key) else {
        r.missing(key, &format!("\"1e10 {unit}\""));
        return 1.0;
    };
    let problem = |kind, message: String| {
        Problem::new(kind, &entry.node.span, message).expected(format!("a stiffness such as \"1e10 {unit}\""))
    };
    let name = r.name(key);
    let Value::Text(text) = &entry.node.value else {
        r.log.error(problem(Kind::MissingUnit, format!("{name} has no unit")));
        return 1.0;
    };
    let number = text.split_once(|c: char| c.is_whitespace()).map(|(number, rest)| (number, rest.trim()));
    let value = number.and_then(|(number, rest)| {
        let power = rest.strip_prefix("N/m^")?.parse::<f64>().ok()?;
        Some((units::parse(number, NUMBER).ok()?, power))
    });
    match value {
        Some((_, power)) if (power - exponent).abs() > 1e-12 => {
            let message = format!("{name} has a unit with exponent {power}, not {exponent}");
            r.log.error(problem(Kind::WrongDimension, message));
            1.0
        }
        Some((value, _)) if value > 0.0 => value,
        Some(_) => {
            r.log.error(problem(Kind::OutOfRange, format!("{name} is not greater than zero")));
            1.0
        }
        None => {
            r.log.error(problem(Kind::BadQuantity, format!("{name}: `{text}` is not a stiffness in {unit}")));
            1.0
        }
    }
}

/// Contact damping: constant (default), Hunt-Crossley or film damping.
pub(super) fn damping(r: &Reader) -> ContactDamping {
    let key = r.one_of(&["contact_damping", "hunt_crossley", "film_damping"]);
    if let Some(other @ ("hunt_crossley" | "film_damping")) = key
        && r.has("damping_ramp")
    {
        let message = format!("{} has no effect with {other}", r.name("damping_ramp"));
        r.error(Kind::Conflict, "damping_ramp", message);
    }
    match key {
        Some("hunt_crossley") => {
            ContactDamping::HuntCrossley { factor: r.need("hunt_crossley", not_negative(INVERSE_SPEED)) }
        }
        Some("film_damping") => {
            if !has_film(r) {
                let message = format!("{} applies only to a contact with a film", r.name("film_damping"));
                r.error(Kind::Conflict, "film_damping", message);
            }
            ContactDamping::Film { factor: r.need("film_damping", positive(NUMBER)) }
        }
        _ => ContactDamping::Constant {
            coefficient: r.or("contact_damping", not_negative(DAMPING), 300.0),
            ramp: r.or("damping_ramp", positive(LENGTH), 1e-6),
        },
    }
}
