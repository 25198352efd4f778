//! Bearings: linear bearings, and ball bearings from the catalogue or by their geometry.

use super::ball_inertia::{self, BALL_INERTIA, BallInertiaKeys};
use super::ball_keys::{AxialKeys, BallKeys, check_geometry, common_properties, designation};
use super::contact::{BallContactKeys, ContactStiffnessKeys, ServiceKeys};
use super::defects::DefectsKeys;
use super::free_ball::{self, FreeBallKeys};
use super::free_cage::FreeCageKeys;
use super::imperfections::{DefectLawKeys, ImperfectionKeys};
use super::increasing::check_increasing;
use super::lubricants::OilOfBearingKeys;
use super::mounting::{MountingKeys, PairKeys};
use super::places::Places;
use super::radial_bearing::{self, RadialBallKeys};
use super::springs::{
    BEARING_DAMPING, BEARING_DAMPING_LIST, BEARING_STIFFNESS, BEARING_STIFFNESS_LIST, MatrixKeys,
};
use super::{contact, imperfections, mounting};
use crate::BearingSite;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Group, NamedTables, Quantities, Table, Text, Words, keys, named_tables, not_negative, quantities, text,
    words,
};
use crate::file::reader::Reader;
use rotordyn_bearing::contact::Lubricant;
use rotordyn_bearing::{BallBearing, Bearing, BeyondTable, LinearBearing, LinearBearingRow};
use rotordyn_core::element::{Anchor, Material};
use rotordyn_units::SPEED;

keys! {
    /// Tables of this file.
    pub(super) static TOP: TopKeys {
        bearing: NamedTables = named_tables(&BEARING_TABLE);
    }
}

static BEARING_TABLE: Table = Table {
    meaning: "A bearing between the shaft and a housing, a body or ground.",
    groups: &[
        Group::always(BearingKeys::LIST),
        Group { condition: BALL, keys: BallKeys::LIST },
        Group { condition: BALL, keys: AxialKeys::LIST },
        Group { condition: BALL, keys: BallInertiaKeys::LIST },
        Group { condition: BALL, keys: BallContactKeys::LIST },
        Group { condition: BALL, keys: ContactStiffnessKeys::LIST },
        Group { condition: BALL, keys: OilOfBearingKeys::LIST },
        Group { condition: BALL, keys: MountingKeys::LIST },
        Group { condition: BALL, keys: PairKeys::LIST },
        Group { condition: BALL, keys: ImperfectionKeys::LIST },
        Group { condition: BALL, keys: DefectsKeys::LIST },
        Group { condition: BALL, keys: DefectLawKeys::LIST },
        Group { condition: BALL, keys: ServiceKeys::LIST },
        Group { condition: RADIAL_BALL, keys: BallKeys::LIST },
        Group { condition: RADIAL_BALL, keys: ContactStiffnessKeys::LIST },
        Group { condition: RADIAL_BALL, keys: RadialBallKeys::LIST },
        Group { condition: RADIAL_BALL, keys: ImperfectionKeys::LIST },
        Group { condition: RADIAL_BALL, keys: DefectsKeys::LIST },
        Group { condition: FREE_BALL, keys: BallKeys::LIST },
        Group { condition: FREE_BALL, keys: AxialKeys::LIST },
        Group { condition: FREE_BALL, keys: BallInertiaKeys::LIST },
        Group { condition: FREE_BALL, keys: ContactStiffnessKeys::LIST },
        Group { condition: FREE_BALL, keys: FreeBallKeys::LIST },
        Group { condition: FREE_BALL, keys: FreeCageKeys::LIST },
        Group { condition: FREE_BALL, keys: OilOfBearingKeys::LIST },
        Group { condition: FREE_BALL, keys: MountingKeys::LIST },
        Group { condition: FREE_BALL, keys: ImperfectionKeys::LIST },
        Group { condition: FREE_BALL, keys: DefectsKeys::LIST },
        Group { condition: FREE_BALL, keys: DefectLawKeys::LIST },
        Group { condition: FREE_BALL, keys: ServiceKeys::LIST },
        Group { condition: LINEAR, keys: LinearKeys::LIST },
        Group { condition: LINEAR, keys: &BEARING_STIFFNESS_LIST },
        Group { condition: LINEAR, keys: &BEARING_DAMPING_LIST },
        Group { condition: LINEAR, keys: MatrixKeys::LIST },
    ],
};

const BALL: &str = "model = \"ball\"";
const RADIAL_BALL: &str = "model = \"radial_ball\"";
const FREE_BALL: &str = "model = \"free_ball\"";
const LINEAR: &str = "model = \"linear\"";

keys! {
    /// Of every bearing.
    static BEARING: BearingKeys {
        station: Text = text("name of a station", "Where it sits on the shaft; not in a file with bearings only.")
            .example("\"A\"");
        housing: Text = text("ground or name of a housing or body", "What holds its outer ring.").default("ground");
        model: Words<ReadBearing> = words(MODELS,
            "Ball bearing in space, plane bearing with one radial DOF per ball, balls and cage as free bodies, or stiffness matrix.");
    }
}

keys! {
    /// Of a linear bearing.
    static LINEAR_BEARING: LinearKeys {
        speed: Quantities = quantities(not_negative(SPEED), "one or more, increasing",
            "Speeds of a table; every component then has one value or one per speed.").default("0 rpm");
        whirl_frequency: Quantities = quantities(not_negative(SPEED), "two or more, increasing",
            "Frequencies of motion of a table, one value per frequency for each speed; only FRFs take others than the speed.").optional().example("\"0, 50, 100 Hz\"");
        beyond_table: Words<BeyondTable> = words(BEYOND,
            "At speeds beyond a table of two or more: its last value, an error, or on along the last slope.").default("hold")
            .with("speed = \"0, 3000 rpm\"");
    }
}

/// Rows of a table over speed and whirl frequency, each of two matrices; more are no measurement.
const MAX_TABLE_ROWS: usize = 20_000;

const BEYOND: &[(&str, BeyondTable)] = &[
    ("hold", BeyondTable::Hold),
    ("refuse", BeyondTable::Refuse),
    ("extrapolate", BeyondTable::Extrapolate),
];

pub(super) fn read(
    top: &Reader,
    materials: &[Material],
    lubricants: &[Lubricant],
    gravity: [f64; 3],
    places: &Places,
) -> Vec<BearingSite> {
    let context = Context { materials, lubricants, gravity };
    let read = |(name, r): (&str, Reader)| {
        let (node, z) = places.station(&r, &BEARING.station);
        let housing = r.text(&BEARING.housing).unwrap_or_default();
        let housing = places
            .find(&r, housing, &r.span_of(&BEARING.housing), &["ground", "housing", "body"])
            .map_or(Anchor::GROUND, |place| place.anchor_at([0.0, 0.0, z]));
        let bearing = bearing(&r, &context);
        r.finish();
        BearingSite { name: name.into(), node, housing, bearing }
    };
    top.items(&TOP.bearing).into_iter().map(read).collect()
}

/// Tells the places which stations and housings the bearings act between.
pub(super) fn name_ends(top: &Reader, places: &mut Places) {
    for (name, r) in top.items(&TOP.bearing) {
        let Some(station) = r.given_text(&BEARING.station) else { continue };
        let housing = r.given_text(&BEARING.housing).unwrap_or("ground");
        places.add_connection(
            format!("bearing.{name}"),
            format!("station `{station}` of the shaft and `{housing}`"),
        );
    }
}

/// Bearings of a bearing-only file, without station and housing.
pub(super) fn read_bearings_only(
    top: &Reader,
    materials: &[Material],
    lubricants: &[Lubricant],
    gravity: [f64; 3],
) -> Vec<(String, Bearing)> {
    let context = Context { materials, lubricants, gravity };
    let read = |(name, r): (&str, Reader)| {
        let bearing = bearing(&r, &context);
        r.finish();
        (name.to_string(), bearing)
    };
    top.items(&TOP.bearing).into_iter().map(read).collect()
}

/// What the reader of a bearing needs beside its table.
struct Context<'a> {
    materials: &'a [Material],
    lubricants: &'a [Lubricant],
    gravity: [f64; 3],
}

/// Reads a bearing of one model from its table.
type ReadBearing = fn(&Reader, &Context) -> Bearing;

/// Values of the key `model`, with the reader of each.
const MODELS: &[(&str, ReadBearing)] = &[
    ("ball", |r, context| ball(r, context.materials, context.lubricants).into()),
    ("radial_ball", |r, context| radial_bearing::read(r, context.materials, context.gravity).into()),
    ("free_ball", |r, context| {
        free_ball::read(r, context.materials, context.lubricants, context.gravity).into()
    }),
    ("linear", |r, _| linear(r).into()),
];

fn bearing(r: &Reader, context: &Context) -> Bearing {
    if !r.has(&BEARING.model) {
        let names: Vec<String> = MODELS.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        let (last, others) = names
            .split_last()
            .map_or((String::new(), String::new()), |(last, others)| (last.clone(), others.join(", ")));
        r.missing_as(&BEARING.model, &format!("{others} or {last}"));
    }
    if unknown_kind(r) {
        r.entries();
        return LinearBearing::default().into();
    }
    r.choice(&BEARING.model).map_or_else(
        || {
            // what the other keys mean depends on the model, but not what they say of it
            for entry in r.entries().iter().filter(|entry| ["type", "kind"].contains(&entry.key.as_str())) {
                let message = format!("unknown key {}.{}", r.path, entry.key);
                let problem = Problem::new(Kind::UnknownKey, &entry.key_span, message);
                r.log.error(problem.hint("did you mean `model`?"));
            }
            LinearBearing::default().into()
        },
        |read| read(r, context),
    )
}

/// Kinds of bearings that are no value of the key `model`.
const OTHER_KINDS: [&str; 12] = [
    "roller",
    "cylindrical",
    "tapered",
    "needle",
    "spherical",
    "journal",
    "sleeve",
    "plain",
    "hydrodynamic",
    "tilting",
    "magnetic",
    "foil",
];

/// Log an error if the model is a kind of bearing that there is no model of, with what to use instead.
fn unknown_kind(r: &Reader) -> bool {
    let Some(word) = r.given_text(&BEARING.model) else { return false };
    let plain = word.to_lowercase();
    let known = MODELS.iter().any(|(name, _)| *name == word);
    if known || !OTHER_KINDS.iter().any(|kind| plain.contains(kind)) {
        return false;
    }
    let message = format!("{} cannot be `{word}`: there is no such model", r.name(&BEARING.model));
    let names = MODELS.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let problem = Problem::new(Kind::UnknownName, &r.span_of(&BEARING.model), message);
    r.log.error(problem.expected(format!("one of {names}")).hint(
        "model = \"linear\" takes the stiffness and damping of any bearing, over speed if they depend on it: \
         k_xx, k_yy, k_xy, c_xx ... (`rotordyn help bearing`)",
    ));
    true
}

fn linear(r: &Reader) -> LinearBearing {
    let speeds = r.list(&LINEAR_BEARING.speed).unwrap_or_else(|| vec![0.0]);
    check_increasing(r, &LINEAR_BEARING.speed, &speeds);
    let whirl = r.list(&LINEAR_BEARING.whirl_frequency).unwrap_or_default();
    check_increasing(r, &LINEAR_BEARING.whirl_frequency, &whirl);
    if whirl.len() == 1 && r.has_no_errors() {
        let message = format!("{} has one value", r.name(&LINEAR_BEARING.whirl_frequency));
        let problem = Problem::new(Kind::WrongType, &r.span_of(&LINEAR_BEARING.whirl_frequency), message);
        r.log.error(problem.expected("two or more frequencies, or none"));
    }
    if speeds.len().saturating_mul(whirl.len()) > MAX_TABLE_ROWS {
        let message = format!("{} speeds times {} frequencies", speeds.len(), whirl.len());
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(&LINEAR_BEARING.whirl_frequency), message);
        r.log.error(problem.expected(format!("at most {MAX_TABLE_ROWS} of both")));
        r.entries();
        return LinearBearing::default();
    }
    let speeds: Vec<f64> = speeds.into_iter().flat_map(|speed| vec![speed; whirl.len().max(1)]).collect();
    let stiffness = BEARING_STIFFNESS.table(r, speeds.len());
    let damping = BEARING_DAMPING.table(r, speeds.len());
    if r.has_no_errors() && stiffness.iter().chain(&damping).flatten().flatten().all(|&k| k == 0.0) {
        r.missing_or(BEARING_STIFFNESS.component(0, 0), " (and k_yy)");
    }
    let beyond = r.word(&LINEAR_BEARING.beyond_table);
    if r.has(&LINEAR_BEARING.beyond_table) && speeds.len() < 2 && r.has_no_errors() {
        r.missing_as(&LINEAR_BEARING.speed, "\"0, 3000 rpm\", with a value of k_xx per speed");
    }
    let rows = speeds.into_iter().zip(stiffness).zip(damping);
    LinearBearing {
        beyond,
        whirl,
        table: rows
            .map(|((speed, stiffness), damping)| LinearBearingRow { speed, stiffness, damping })
            .collect(),
    }
}

fn ball(r: &Reader, materials: &[Material], lubricants: &[Lubricant]) -> BallBearing {
    let mut bearing = common_properties(r, materials, designation(r).as_ref(), None);
    bearing.service = contact::service(r, lubricants);
    bearing.damping = contact::damping(r);
    bearing.inertia = ball_inertia::read(r);
    bearing.preload = mounting::preload(r);
    bearing.duplex = mounting::duplex(r, bearing.geometry.contact_angle);
    bearing.fit = mounting::fit(r, &bearing.geometry);
    bearing.contact = contact::contact_law(r, lubricants, &bearing.hertz());
    if bearing.inertia.is_on() && !bearing.contact.has_separate_contacts() {
        let message = format!(
            "{} needs separate inner and outer contacts, which a fitted power law does not have",
            r.name(&BALL_INERTIA.ball_inertia)
        );
        let problem = Problem::new(Kind::Conflict, &r.span_of(&BALL_INERTIA.ball_inertia), message);
        r.log.error(problem.expected("contact = \"hertz\" or \"film\", with separate inner and outer contacts").hint(
            "a power law covers both contacts in series and includes the centrifugal force at the speed of the fit",
        ));
    }
    imperfections::check_force_law(r, &bearing);
    if r.has_no_errors() {
        check_geometry(r, &bearing);
    }
    if r.has_no_errors() {
        for why in bearing.problems() {
            r.log.error(Problem::new(Kind::Conflict, &r.span, format!("{}: {why}", r.path)));
        }
    }
    bearing
}
