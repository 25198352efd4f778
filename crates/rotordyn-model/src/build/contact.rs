//! Contact laws (Hertz, film, power law, EHL), contact damping and service conditions of a bearing.

use super::lubricants::{self, OIL_OF_BEARING};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Declared, Key, PowerStiffness, Quantities, Quantity, SubTable, Words, any, count, keys,
    not_negative, positive, power_stiffness, quantities, quantity, sub_table, within, words,
};
use crate::file::reader::Reader;
use crate::file::tree::Value;
use rotordyn_bearing::Service;
use rotordyn_bearing::ball::{CONTAMINATION, RELIABILITY};
use rotordyn_bearing::contact::ehl::{DEFAULT_POINTS, EhlLaw};
use rotordyn_bearing::contact::{
    ContactDamping, ContactLaw, ContactStiffness, HertzPair, Lubricant, PowerLaw,
};
use rotordyn_bearing::friction::{Lubrication, SLIDING_FRICTION};
use rotordyn_units::{self as units, DAMPING, FORCE, INVERSE_SPEED, LENGTH, NUMBER, VELOCITY};

/// Keywords of the key `contact`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ContactKeyword {
    Hertz,
    Film,
    PowerLaw,
    Ehl,
}

keys! {
    /// Contacts of `model = "ball"` only.
    pub(super) static BALL_CONTACT: BallContactKeys {
        contact: Words<ContactKeyword> = words(&[
            ("hertz", ContactKeyword::Hertz),
            ("film", ContactKeyword::Film),
            ("power_law", ContactKeyword::PowerLaw),
            ("ehl", ContactKeyword::Ehl),
        ], "Dry contact, with the film thickness of Hamrock and Dowson, fitted, or with a solved film.")
            .default("hertz");
        speed_factor: Quantity = quantity(positive(NUMBER), "Factor of the entrainment speed, of the contacts film and ehl.").default("1")
            .with("contact = \"film\"");
        power_law: SubTable = sub_table(PowerLawKeys::TABLE).required("with contact = \"power_law\"")
            .with("contact = \"power_law\"");
        ehl: SubTable = sub_table(EhlKeys::TABLE).with("contact = \"ehl\"");
        contact_damping: Quantity = quantity(not_negative(DAMPING), "Damping of a loaded contact; or one of the next two.")
            .default("300 N s/m");
        damping_ramp: Quantity = quantity(positive(LENGTH), "Deflection over which this damping sets in.")
            .default("1 um");
        hunt_crossley: Quantity = quantity(not_negative(INVERSE_SPEED), "Damping by Hunt and Crossley.").optional();
        film_damping: Quantity = quantity(positive(NUMBER), "Damping by the film, factor of its relaxation time, about 1; of the contacts film and ehl.")
            .optional().with("contact = \"film\"").example("1");
    }
}

keys! {
    /// Contacts of every ball bearing.
    pub(super) static CONTACT_STIFFNESS: ContactStiffnessKeys {
        contact_stiffness: PowerStiffness = power_stiffness("1.5", "Stiffness of both contacts in series, instead of Hertz.")
            .computed("Hertz").example("\"1.58e10 N/m^1.5\"");
        each: SubTable = sub_table(EachStiffnessKeys::TABLE).named("contact_stiffness");
    }
}

keys! {
    /// `contact_stiffness = { ... }`.
    static EACH_STIFFNESS: EachStiffnessKeys = "Stiffness of each contact, instead of Hertz." {
        inner: PowerStiffness = power_stiffness("1.5", "At the inner race.");
        outer: PowerStiffness = power_stiffness("1.5", "At the outer race.");
    }
}

keys! {
    /// `power_law = { ... }`.
    static POWER_LAW: PowerLawKeys = "A fitted law of both contacts in series, F = K d^n + offset." {
        exponent: Quantity = quantity(within(NUMBER, [1.0, 3.0]), "Exponent n; a dry point contact has 1.5.")
            .example("1.5");
        stiffness: PowerStiffness = power_stiffness("n", "Stiffness K.").example("\"1e10 N/m^1.5\"");
        offset: Quantity = quantity(any(FORCE), "Load without deflection, below the range.").default("0 N")
            .example("\"30 N\"");
        range: Quantities = quantities(positive(FORCE), "two: least and greatest", "Loads of the fit.")
            .example("\"600, 2000 N\"");
    }
}

keys! {
    /// `ehl = { ... }`.
    static EHL: EhlKeys = "Range and resolution of the tables of the solved film." {
        loads: Quantities = quantities(positive(FORCE), "two: least and greatest", "Contact loads.")
            .computed("contact pressures of 0.4 to 4.2 GPa").example("\"5, 5000 N\"");
        speeds: Quantities = quantities(positive(VELOCITY), "two: least and greatest", "Entrainment speeds.")
            .computed("0.1 to 16 m/s times speed_factor").example("\"0.1, 16 m/s\"");
        load_count: Count = count([2, 100], "Number of loads.").default("8");
        speed_count: Count = count([2, 100], "Number of speeds.").default("5");
        points: Count = count([2, 24], "Grid points per half contact width; the default interpolates stored films.")
            .default_count(DEFAULT_POINTS);
    }
}

keys! {
    /// For friction torque and rating life of `model = "ball"`.
    pub(super) static SERVICE: ServiceKeys {
        lubrication: Words<Lubrication> = words(&[
            ("oil_bath", Lubrication::OilBath),
            ("oil_mist", Lubrication::OilMist),
            ("oil_jet", Lubrication::OilJet),
            ("grease", Lubrication::Grease),
        ], "Lubrication with a lubricant or film, for the friction torque; oil_jet is also an oil bath with a vertical shaft.")
            .default("oil_bath").with("lubricant = \"oil\"");
        lubrication_factor: SubTable = sub_table(LubricationKeys::TABLE).named("lubrication")
            .with("lubricant = \"oil\"");
        sliding_friction: Quantity = quantity(within(NUMBER, [0.0, 1.0]), "Coefficient of friction of spinning balls.")
            .default_si(SLIDING_FRICTION);
        dynamic_rating: Quantity = quantity(positive(FORCE), "Basic dynamic load rating C.")
            .computed("from the geometry").example("\"14 kN\"");
        static_rating: Quantity = quantity(positive(FORCE), "Basic static load rating C_0.")
            .computed("from the geometry").example("\"7.8 kN\"");
        fatigue_limit: Quantity = quantity(positive(FORCE), "Fatigue load limit C_u.").computed("from the geometry")
            .example("\"335 N\"");
        contamination: Quantity = quantity(within(NUMBER, [0.0, 1.0]), "Contamination factor e_C of ISO 281.")
            .default_si(CONTAMINATION);
        reliability: Quantity = quantity(within(NUMBER, [0.9, 0.999]), "Reliability of the rating life.")
            .default_si(RELIABILITY);
        inner_shoulder_diameter: Quantity = quantity(positive(LENGTH), "Diameter of the inner shoulder.")
            .computed("0.2 D_w high; with a contact angle at least 25 deg beyond it").example("\"33 mm\"");
        outer_shoulder_diameter: Quantity = quantity(positive(LENGTH), "Diameter of the outer shoulder.")
            .computed("0.2 D_w high; with a contact angle at least 25 deg beyond it").example("\"44 mm\"");
    }
}

keys! {
    /// `lubrication = { ... }`.
    static LUBRICATION: LubricationKeys = "Factor of the viscous part of the friction torque with a lubricant or film, instead of a method." {
        f_0: Quantity = quantity(positive(NUMBER), "Factor f_0 of Palmgren.").example("1.5");
    }
}

/// Whether the requested contact law has a lubricant film.
fn has_film(r: &Reader) -> bool {
    matches!(r.given_text(&BALL_CONTACT.contact), Some("film" | "ehl"))
}

/// Load ratings, oil and contamination factor for the rating life; with a film its oil is used.
pub(super) fn service(r: &Reader, lubricants: &[Lubricant]) -> Service {
    let has_oil = r.has(&OIL_OF_BEARING.lubricant);
    if r.has(&SERVICE.lubrication) && !has_film(r) && !has_oil {
        let message = format!("{} needs the lubricant of the bearing", r.name(&SERVICE.lubrication));
        let problem = Problem::new(Kind::MissingKey, &r.span_of(&SERVICE.lubrication), message);
        r.log.error(problem.hint(
            "add lubricant = \"oil\" and [lubricant.oil]: its viscosity gives the viscous friction torque",
        ));
    }
    Service {
        dynamic_rating: r.get(&SERVICE.dynamic_rating),
        static_rating: r.get(&SERVICE.static_rating),
        fatigue_limit: r.get(&SERVICE.fatigue_limit),
        lubricant: if has_film(r) || !has_oil { None } else { lubricant(r, lubricants) },
        // Without oil there is no viscous friction, and no method to state.
        lubrication: if has_oil || has_film(r) || r.has(&SERVICE.lubrication) {
            lubrication(r)
        } else {
            Lubrication::default()
        },
        sliding_friction: r.value(&SERVICE.sliding_friction),
        contamination: r.value(&SERVICE.contamination),
        reliability: r.value(&SERVICE.reliability),
        shoulder_diameters: [&SERVICE.inner_shoulder_diameter, &SERVICE.outer_shoulder_diameter]
            .map(|key| r.get(key)),
    }
}

/// Oil of the bearing.
fn lubricant(r: &Reader, lubricants: &[Lubricant]) -> Option<Lubricant> {
    lubricants::of_bearing(r, lubricants, &r.span_of(&BALL_CONTACT.contact))
}

/// Lubrication method: a keyword, or `{ f_0 = 1.5 }`.
fn lubrication(r: &Reader) -> Lubrication {
    if !r.has_table(&SERVICE.lubrication_factor) {
        return r.word(&SERVICE.lubrication);
    }
    let Some(given) = r.table(&SERVICE.lubrication_factor) else { return Lubrication::default() };
    let factor = given.value(&LUBRICATION.f_0);
    given.finish();
    Lubrication::Factor(factor)
}

/// `contact_stiffness = "1.58e10 N/m^1.5"` of both contacts in series, or `{ inner = "…", outer = "…" }`.
pub(super) fn stiffness(r: &Reader) -> ContactStiffness {
    if r.has_table(&CONTACT_STIFFNESS.each) {
        let Some(each) = r.table(&CONTACT_STIFFNESS.each) else { return ContactStiffness::Elastic };
        let stiffness =
            [&EACH_STIFFNESS.inner, &EACH_STIFFNESS.outer].map(|race| power_law_stiffness(&each, race, 1.5));
        each.finish();
        return ContactStiffness::Each(stiffness);
    }
    let series = &CONTACT_STIFFNESS.contact_stiffness;
    if r.has(series) {
        return ContactStiffness::Series(power_law_stiffness(r, series, 1.5));
    }
    ContactStiffness::Elastic
}

/// The contact law; [`ContactLaw::Hertz`] as placeholder after an error.
pub(super) fn contact_law(r: &Reader, lubricants: &[Lubricant], hertz: &HertzPair) -> ContactLaw {
    let keys = &BALL_CONTACT;
    let word = r.choice(&keys.contact);
    let law = word.unwrap_or(keys.contact.default_word());
    if r.has(&keys.contact) && word.is_none() {
        [&keys.speed_factor as &dyn Declared, &keys.power_law, &keys.ehl]
            .iter()
            .for_each(|key| _ = r.has(*key));
        return ContactLaw::Hertz;
    }
    let without = |key: &dyn Declared, needed: &str| {
        if r.has(key) {
            let message = format!("{} applies only with contact = \"{needed}\"", r.name(key));
            r.error(Kind::Conflict, key, message);
        }
    };
    if law != ContactKeyword::PowerLaw {
        without(&keys.power_law, "power_law");
    }
    if law != ContactKeyword::Ehl {
        without(&keys.ehl, "ehl");
    }
    if !matches!(law, ContactKeyword::Film | ContactKeyword::Ehl) {
        without(&keys.speed_factor, "film");
    }
    match law {
        ContactKeyword::Hertz => ContactLaw::Hertz,
        ContactKeyword::Film => {
            let speed_factor = r.value(&BALL_CONTACT.speed_factor);
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
    let speed_factor = r.value(&BALL_CONTACT.speed_factor);
    let pressure = hertz.inner.patch(1.0).maximum_pressure;
    let mut loads = [0.4e9, 4.2e9].map(|p: f64| (p / pressure).powi(3));
    // Default speeds up to about n D_pw = 600 000 rpm mm, the limit of grease and most oil lubrication.
    let mut speeds = [0.1, 16.0].map(|u| u * speed_factor);
    let table = r.table_or_empty(&BALL_CONTACT.ehl);
    let range = |key: &Key<Quantities>, default: [f64; 2]| match table.list(key) {
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
    loads = range(&EHL.loads, loads);
    speeds = range(&EHL.speeds, speeds);
    let counts = [table.count(&EHL.load_count), table.count(&EHL.speed_count)];
    let points = table.count(&EHL.points);
    table.finish();
    lubricant(r, lubricants).map_or(ContactLaw::Hertz, |lubricant| {
        ContactLaw::Ehl(EhlLaw { lubricant, speed_factor, loads, speeds, counts, points, tables: None })
    })
}

/// `power_law = { stiffness = "8.562e9 N/m^1.475", exponent = 1.475, offset = "30 N", range = "600, 2000 N" }`.
fn power_law(r: &Reader) -> ContactLaw {
    let Some(law) = r.table(&BALL_CONTACT.power_law) else {
        if !r.has(&BALL_CONTACT.power_law) {
            r.missing_as(
                &BALL_CONTACT.power_law,
                "{ stiffness = \"1e10 N/m^1.5\", exponent = 1.5, offset = \"0 N\", range = \"600, 2000 N\" }",
            );
        }
        return ContactLaw::Hertz;
    };
    let exponent = law.value(&POWER_LAW.exponent);
    let exponent_known = law.has_no_errors();
    let stiffness = match exponent_known || !law.has(&POWER_LAW.stiffness) {
        true => power_law_stiffness(&law, &POWER_LAW.stiffness, exponent),
        false => 1.0,
    };
    let offset = law.value(&POWER_LAW.offset);
    let range = law.need_list(&POWER_LAW.range);
    let range = match range[..] {
        [from, to] if from < to => [from, to],
        _ => {
            if law.has_no_errors() {
                let message = format!("{} is not a range of loads", law.name(&POWER_LAW.range));
                let problem = Problem::new(Kind::OutOfRange, &law.span_of(&POWER_LAW.range), message);
                law.log
                    .error(problem.expected("the minimum and the maximum load of the fit, \"600, 2000 N\""));
            }
            [0.0, 1.0]
        }
    };
    if offset >= range[0] && law.has_no_errors() {
        let message = format!(
            "{} is too large: the law needs no deflection for its minimum load",
            law.name(&POWER_LAW.offset)
        );
        let problem = Problem::new(Kind::OutOfRange, &law.span_of(&POWER_LAW.offset), message);
        law.log.error(problem.expected(format!("less than the minimum load of the fit, {} N", range[0])));
    }
    law.finish();
    ContactLaw::PowerLaw(PowerLaw { stiffness, exponent, offset, range })
}

/// K in N/mⁿ; its unit must contain the exponent: "8.562e9 N/m^1.475".
pub(super) fn power_law_stiffness(r: &Reader, key: &Key<PowerStiffness>, exponent: f64) -> f64 {
    let unit = format!("N/m^{exponent}");
    let Some(entry) = r.entry(key) else {
        r.missing_as(key, &format!("\"1e10 {unit}\""));
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
    let keys = &BALL_CONTACT;
    let given = r.one_of(&[&keys.contact_damping, &keys.hunt_crossley, &keys.film_damping]);
    let is = |key: &dyn Declared| given.is_some_and(|given| given.is(key));
    if let Some(other) = given.filter(|given| !given.is(&keys.contact_damping))
        && r.has(&keys.damping_ramp)
    {
        let message = format!("{} has no effect with {}", r.name(&keys.damping_ramp), other.name());
        r.error(Kind::Conflict, &keys.damping_ramp, message);
    }
    if is(&keys.hunt_crossley) {
        return ContactDamping::HuntCrossley { factor: r.value(&keys.hunt_crossley) };
    }
    if is(&keys.film_damping) {
        if !has_film(r) {
            let message = format!("{} applies only to a contact with a film", r.name(&keys.film_damping));
            r.error(Kind::Conflict, &keys.film_damping, message);
        }
        return ContactDamping::Film { factor: r.value(&keys.film_damping) };
    }
    ContactDamping::Constant {
        coefficient: r.value(&keys.contact_damping),
        ramp: r.value(&keys.damping_ramp),
    }
}
