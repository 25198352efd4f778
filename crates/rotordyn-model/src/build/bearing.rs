//! Bearings: linear bearings, and ball bearings from the catalogue or by their geometry.

use super::ball_keys::{check_geometry, common_properties, designation};
use super::increasing::check_increasing;
use super::places::Places;
use super::springs::{self, MatrixKind};
use super::{contact, imperfections, mounting, radial_bearing};
use crate::BearingSite;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, not_negative, positive};
use crate::file::tree::Value;
use rotordyn_bearing::contact::Lubricant;
use rotordyn_bearing::{BallBearing, BallInertia, Bearing, BeyondTable, LinearBearing, LinearBearingRow};
use rotordyn_core::element::{Anchor, Material};
use rotordyn_units::{FORCE, SPEED};

const INERTIAS: [(&str, BallInertia); 7] = [
    ("auto", BallInertia::Auto(None)),
    ("none", BallInertia::None),
    ("outer_race_control", BallInertia::OuterRaceControl),
    ("inner_race_control", BallInertia::InnerRaceControl),
    ("harris_inner_race_control", BallInertia::HarrisInnerRaceControl),
    ("shared", BallInertia::Shared),
    ("centrifugal", BallInertia::Centrifugal),
];

/// Ball inertia: a keyword, or `{ centrifugal_force = "120 N" }`.
fn ball_inertia(r: &Reader) -> BallInertia {
    if !matches!(r.entry("ball_inertia").map(|e| &e.node.value), Some(Value::Table(_))) {
        return r.choice("ball_inertia", &INERTIAS).unwrap_or_default();
    }
    let Some(given) = r.table("ball_inertia") else { return BallInertia::default() };
    let force = given.need("centrifugal_force", positive(FORCE));
    given.finish();
    BallInertia::CentrifugalForce(force)
}

pub(super) fn read(
    top: &Reader,
    materials: &[Material],
    lubricants: &[Lubricant],
    gravity: [f64; 3],
    places: &Places,
) -> Vec<BearingSite> {
    let context = Context { materials, lubricants, gravity };
    let read = |(name, r): (&str, Reader)| {
        let (node, z) = places.station(&r, "station");
        let housing = r.text("housing").unwrap_or("ground");
        let housing = places
            .find(&r, housing, &r.span_of("housing"), &["ground", "housing", "body"])
            .map_or(Anchor::GROUND, |place| place.anchor_at([0.0, 0.0, z]));
        let bearing = bearing(&r, &context);
        r.finish();
        BearingSite { name: name.into(), node, housing, bearing }
    };
    top.items("bearing").into_iter().map(read).collect()
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
    top.items("bearing").into_iter().map(read).collect()
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
    ("linear", |r, _| linear(r).into()),
];

fn bearing(r: &Reader, context: &Context) -> Bearing {
    if !r.has("model") {
        let names: Vec<String> = MODELS.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        let (last, others) = names
            .split_last()
            .map_or((String::new(), String::new()), |(last, others)| (last.clone(), others.join(", ")));
        r.missing("model", &format!("{others} or {last}"));
    }
    r.choice("model", MODELS).map_or_else(
        || {
            r.entries();
            LinearBearing { table: Vec::new(), beyond: BeyondTable::Hold }.into()
        },
        |read| read(r, context),
    )
}

fn linear(r: &Reader) -> LinearBearing {
    let speeds = r.list("speed", not_negative(SPEED)).unwrap_or_else(|| vec![0.0]);
    check_increasing(r, "speed", &speeds);
    let stiffness = springs::table(r, MatrixKind::Stiffness, speeds.len(), false);
    let damping = springs::table(r, MatrixKind::Damping, speeds.len(), false);
    if r.has_no_errors() && stiffness.iter().flatten().flatten().all(|&k| k == 0.0) {
        r.missing("k_xx", "\"1e7 N/m\" (and k_yy)");
    }
    let choices = [("hold", BeyondTable::Hold), ("refuse", BeyondTable::Refuse)];
    let beyond = r.choice("beyond_table", &choices);
    if beyond.is_some() && speeds.len() < 2 && r.has_no_errors() {
        r.missing("speed", "\"0, 3000 rpm\", with a value of k_xx per speed");
    }
    let rows = speeds.into_iter().zip(stiffness).zip(damping);
    LinearBearing {
        beyond: beyond.unwrap_or_default(),
        table: rows
            .map(|((speed, stiffness), damping)| LinearBearingRow { speed, stiffness, damping })
            .collect(),
    }
}

fn ball(r: &Reader, materials: &[Material], lubricants: &[Lubricant]) -> BallBearing {
    let mut bearing = common_properties(r, materials, designation(r).as_ref(), None);
    bearing.service = contact::service(r, lubricants);
    bearing.damping = contact::damping(r);
    bearing.inertia = ball_inertia(r);
    bearing.preload = mounting::preload(r);
    bearing.duplex = mounting::duplex(r, bearing.geometry.contact_angle);
    bearing.fit = mounting::fit(r, &bearing.geometry);
    bearing.contact = contact::contact_law(r, lubricants, &bearing.hertz());
    if bearing.inertia.is_on() && !bearing.contact.has_separate_contacts() {
        let message = format!(
            "{} needs separate inner and outer contacts, which a fitted power law does not have",
            r.name("ball_inertia")
        );
        let problem = Problem::new(Kind::Conflict, &r.span_of("ball_inertia"), message);
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
