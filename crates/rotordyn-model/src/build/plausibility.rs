//! Input that is valid but rarely meant: values off by a power of ten, parts in each other's place, items without use.

use super::ball_keys::{BALL, states_bore};
use super::{bearing, inertia, loading, shaft};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Key, NamedTables, Quantity};
use crate::file::reader::Reader;
use crate::file::tree::{Table, Value};
use crate::{BearingSite, Model};
use rotordyn_bearing::rating::limit_checks::{speed_limit, speed_parameter};
use rotordyn_bearing::{Bearing, Cage};
use rotordyn_core::element::{Anchor, Disc, Material};
use rotordyn_core::warning::Code;
use std::collections::HashSet;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Density of parts that are not massless \[kg/m³\]: from light foam and wood to osmium.
const DENSITY: [f64; 2] = [300.0, 23000.0];
/// Young's modulus \[Pa\]: from polymers to diamond.
const MODULUS: [f64; 2] = [0.5e9, 1.5e12];
/// Speed of sound in a bar √(E/ρ) \[m/s\] up to a density \[kg/m³\]: polymers to carbon fibre; metals and ceramics, from
/// tin to beryllium and silicon carbide; lead to molybdenum; gold to tungsten.
const SOUND: [(f64, [f64; 2]); 4] = [
    (2300.0, [300.0, 14000.0]),
    (10200.0, [2000.0, 14000.0]),
    (13000.0, [900.0, 6500.0]),
    (f64::INFINITY, [1800.0, 6500.0]),
];
/// Diameter of a section over that of its neighbour.
const SECTION_RATIO: f64 = 30.0;
/// Difference of bore and seat, as a share of the bore.
const BORE_DIFFERENCE: f64 = 0.1;
/// Overlap of two parts along the shaft, as a share of the narrower one.
const OVERLAP: f64 = 0.1;
/// Balance quality grade e ω \[m/s\]: G 100 of ISO 21940-11.
const BALANCE_QUALITY: f64 = 0.1;

/// Warns of implausible input.
///
/// `materials`: the table of materials and its keys of Young's modulus and density.
pub(super) fn check(top: &Reader, model: &Model, materials: (&Key<NamedTables>, [&Key<Quantity>; 2])) {
    check_materials(top, model, materials);
    sections(top, model);
    seats(top, model);
    discs(top, model);
    single_bearing(top, model);
    bearing_speeds(top, model);
    cage_speeds(top, model);
    overlapping_bearings(top, model);
    balance_quality(top, model);
}

fn item_span(top: &Reader, collection: &Key<NamedTables>, name: &str) -> Range<usize> {
    top.item(collection, name).map_or(0..0, |r| r.span)
}

/// E, ρ and √(E/ρ) of every material with mass.
fn check_materials(
    top: &Reader,
    model: &Model,
    (table, [young, density]): (&Key<NamedTables>, [&Key<Quantity>; 2]),
) {
    let items = top.items(table);
    for material in &model.materials {
        let Some((_, r)) = items.iter().find(|(name, _)| *name == material.name) else { continue };
        let Some(Implausible { of_density, what, expected }) = implausible_material(material) else {
            continue;
        };
        let message = format!("material.{}: {what}", material.name);
        let key = if of_density { density } else { young };
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(key), message).expected(expected);
        let hint = "check the units of young and density; for a shaft of hardly any mass the answers are right, and this warning \
                    stays";
        top.log.warn(Code::MaterialRange, format!("material.{}", material.name), problem.hint(hint));
    }
}

/// What is implausible of a material, and what is expected.
struct Implausible {
    /// Of its density alone; else of its modulus, alone or with the density.
    of_density: bool,
    what: String,
    expected: String,
}

fn implausible_material(material: &Material) -> Option<Implausible> {
    let (young, density) = (material.young, material.density);
    let outside = |value: f64, [low, high]: [f64; 2]| value < low || value > high;
    if outside(young, MODULUS) {
        let what =
            format!("Young's modulus of {:.4} GPa is not that of an engineering material", young / 1e9);
        let expected = "0.5 to 1500 GPa; steel has 210 GPa".into();
        return Some(Implausible { of_density: false, what, expected });
    }
    if density == 0.0 {
        return None;
    }
    if outside(density, DENSITY) {
        let what = format!("a density of {density:.4} kg/m^3 is not that of an engineering material");
        let expected = "300 to 23000 kg/m^3; steel has 7850 kg/m^3".into();
        return Some(Implausible { of_density: true, what, expected });
    }
    let (_, range) = SOUND.iter().find(|(up_to, _)| density < *up_to)?;
    let sound = (young / density).sqrt();
    outside(sound, *range).then(|| {
        let what = format!(
            "no material of {density:.0} kg/m^3 has a Young's modulus of {:.4} GPa (speed of sound {sound:.0} m/s)",
            young / 1e9
        );
        let at = |sound: f64| 1e-9 * density * sound * sound;
        let expected = format!(
            "{:.2} to {:.0} GPa at this density; steel has 210 GPa and 7850 kg/m^3",
            at(range[0]),
            at(range[1])
        );
        Implausible { of_density: false, what, expected }
    })
}

/// Neighbouring elements of very different diameters.
fn sections(top: &Reader, model: &Model) {
    let pairs = model.shaft.windows(2).map(|pair| [pair[0].outer_diameter[1], pair[1].outer_diameter[0]]);
    let steps = pairs.enumerate().map(|(k, d)| (k, d, (d[0] / d[1]).max(d[1] / d[0])));
    let Some((k, d, ratio)) = steps.max_by(|a, b| a.2.total_cmp(&b.2)).filter(|step| step.2 > SECTION_RATIO)
    else {
        return;
    };
    let message = format!(
        "the diameter of the shaft changes from {:.4} mm to {:.4} mm at z = {:.4} mm, by a factor of {ratio:.0}",
        1e3 * d[0],
        1e3 * d[1],
        1e3 * model.node_z[k + 1]
    );
    let span = top.table(&shaft::TOP.shaft).map_or(0..0, |r| r.span);
    let problem = Problem::new(Kind::OutOfRange, &span, message).hint("check the units of the sections");
    top.log.warn(Code::SectionStep, "shaft", problem);
}

/// Diameters of the shaft on both sides of a node.
fn diameters_at(model: &Model, node: usize) -> Vec<f64> {
    let left = node.checked_sub(1).and_then(|k| model.shaft.get(k)).map(|element| element.outer_diameter[1]);
    let right = model.shaft.get(node).map(|element| element.outer_diameter[0]);
    left.into_iter().chain(right).collect()
}

/// Bores of bearings with a designation or a stated bore against the shaft at their seats.
fn seats(top: &Reader, model: &Model) {
    for (name, r) in top.items(&bearing::TOP.bearing) {
        let Some(site) = model.bearings.iter().find(|site| site.name == name) else { continue };
        let Some(ball) = site.bearing.ball() else { continue };
        if !states_bore(&r) {
            continue;
        }
        let bore = ball.geometry.bore;
        let diameters = diameters_at(model, site.node);
        let nearest = diameters.iter().copied().min_by(|a, b| (a - bore).abs().total_cmp(&(b - bore).abs()));
        let Some(seat) = nearest.filter(|seat| (seat / bore - 1.0).abs() > BORE_DIFFERENCE) else { continue };
        let message = format!(
            "bearing.{name} has a bore of {:.4} mm, but the shaft at its seat has a diameter of {:.4} mm",
            1e3 * bore,
            1e3 * seat
        );
        let problem = Problem::new(Kind::Geometry, &r.span, message)
            .hint("choose the bearing of that size, or the diameter of the section under it");
        top.log.warn(Code::BoreMismatch, format!("bearing.{name}"), problem);
    }
}

/// Discs in each other's place, or through a bearing.
fn discs(top: &Reader, model: &Model) {
    let centre = |disc: &Disc| model.node_z[disc.node];
    for (k, disc) in model.discs.iter().enumerate() {
        let item = format!("disc.{}", disc.name);
        let span = item_span(top, &inertia::TOP.disc, &disc.name);
        let other = model.discs[..k].iter().find(|other| {
            let room = 0.5 * (disc.thickness + other.thickness);
            let narrower = disc.thickness.min(other.thickness);
            (centre(disc) - centre(other)).abs() < room - OVERLAP * narrower || disc.node == other.node
        });
        if let Some(other) = other {
            let message = format!("disc.{} and disc.{} are in the same place", other.name, disc.name);
            let problem = Problem::new(Kind::Geometry, &span, message)
                .hint("check their stations and thickness; one disc can have the sum of both masses");
            top.log.warn(Code::OverlappingDiscs, item.clone(), problem);
        }
        let hit = |site: &&BearingSite| {
            site.bearing.ball().is_some_and(|ball| {
                let g = &ball.geometry;
                let room = 0.5 * (disc.thickness + g.width);
                let overlap = room - (centre(disc) - model.node_z[site.node]).abs();
                disc.thickness > 0.0
                    && g.width > 0.0
                    && disc.outer_diameter > g.bore
                    && overlap > OVERLAP * disc.thickness.min(g.width)
            })
        };
        if let Some(site) = model.bearings.iter().find(hit) {
            let message = format!("disc.{} and bearing.{} are in the same place", disc.name, site.name);
            let problem = Problem::new(Kind::Geometry, &span, message)
                .hint("check their stations and the thickness of the disc");
            top.log.warn(Code::DiscCollision, item, problem);
        }
    }
}

/// A rotor held radially at one place that does not resist tilting by itself.
fn single_bearing(top: &Reader, model: &Model) {
    let shaft = model.node_z.len();
    let on_shaft = |a: &Anchor| a.node.filter(|node| *node < shaft);
    // (node, resists tilting) of every support with radial stiffness.
    let bearings = model.bearings.iter().filter_map(|site| {
        let [x, y, _, tilt_x, tilt_y, _] = site.bearing.supports();
        (x || y).then_some((site.node, tilt_x && tilt_y))
    });
    let joints = model.joints.iter().filter_map(|joint| {
        let node = on_shaft(&joint.a).or(on_shaft(&joint.b))?;
        let tilt = joint.locked[3] && joint.locked[4];
        (joint.locked[0] || joint.locked[1] || tilt).then_some((node, tilt))
    });
    let others = model.elements().filter_map(|(_, element)| element.connection()).filter_map(|c| {
        let node = match [on_shaft(&c.ends[0]), on_shaft(&c.ends[1])] {
            [Some(node), None] | [None, Some(node)] => node,
            _ => return None,
        };
        (c.stiff[0] || c.stiff[1]).then_some((node, c.stiff[3] && c.stiff[4]))
    });
    let supports: Vec<(usize, bool)> = bearings.chain(joints).chain(others).collect();
    let [site] = &model.bearings[..] else { return };
    if supports.iter().any(|(node, _)| *node != site.node) || supports.len() > 1 {
        return;
    }
    let is_pair = site.bearing.ball().is_some_and(|ball| ball.duplex.is_some());
    if is_pair || !matches!(site.bearing, Bearing::Ball(_)) && supports[0].1 {
        return;
    }
    let message = format!("bearing.{} is the only support of the rotor", site.name);
    let problem = Problem::new(Kind::Disconnected, &item_span(top, &bearing::TOP.bearing, &site.name), message)
        .hint("one ball bearing resists tilting very little: add the second bearing, or a joint that prevents tilting");
    top.log.warn(Code::SingleBearing, format!("bearing.{}", site.name), problem);
}

/// Speed factor n d_m of the ball bearings at the highest speed of the profile.
fn bearing_speeds(top: &Reader, model: &Model) {
    let rpm = model.profile.top_speed().abs() * 60.0 / TAU;
    for site in &model.bearings {
        let Some(ball) = site.bearing.ball() else { continue };
        let limit = speed_limit(ball);
        let factor = speed_parameter(ball, model.profile.top_speed());
        if factor > limit {
            let message = format!(
                "bearing.{} turns at n d_m = {factor:.3e} mm rpm ({rpm:.0} rpm, pitch diameter {:.4} mm), above the \
                 {limit:.1e} mm rpm of its kind",
                site.name,
                1e3 * ball.geometry.pitch_diameter
            );
            let span = item_span(top, &bearing::TOP.bearing, &site.name);
            let problem = Problem::new(Kind::OutOfRange, &span, message)
                .hint("check the unit of the speed, or choose a smaller or a spindle bearing");
            top.log.warn(Code::BearingSpeed, format!("bearing.{}", site.name), problem);
        }
    }
}

/// Stated cage speeds against those of rolling balls at the nominal contact angle. Balls that slip make a cage slower; at larger
/// contact angles it is faster, up to half the shaft speed. On an outer ring that turns with the shaft about an inner one at rest it
/// turns at one less the ratio.
fn cage_speeds(top: &Reader, model: &Model) {
    /// Slip that only a bearing without load reaches.
    const LOWEST: f64 = 0.5;
    /// Difference from the ratio of a bearing whose outer ring turns.
    const OUTER_RING: f64 = 0.02;
    for site in &model.bearings {
        let Some(ball) = site.bearing.ball() else { continue };
        let Cage::Ratio(ratio) = ball.cage else { continue };
        let g = &ball.geometry;
        let rolling = 0.5 * (1.0 - g.ball_diameter / g.pitch_diameter * g.contact_angle.cos());
        let with_outer_ring = (ratio - (1.0 - rolling)).abs() < OUTER_RING;
        if ratio == 0.0 || (LOWEST * rolling..=0.5).contains(&ratio) || with_outer_ring {
            continue;
        }
        let message = format!(
            "bearing.{}: the cage turns at {ratio} of the shaft speed, where rolling balls carry it at {rolling:.4}",
            site.name
        );
        let span = top.item(&bearing::TOP.bearing, &site.name).map_or(0..0, |r| r.span_of(&BALL.cage));
        let problem = Problem::new(Kind::OutOfRange, &span, message)
            .hint("cage is the speed of the cage over that of the shaft; without it balls are taken to roll");
        top.log.warn(Code::CageSpeed, format!("bearing.{}", site.name), problem);
    }
}

/// Ball bearings in each other's place.
fn overlapping_bearings(top: &Reader, model: &Model) {
    let widths: Vec<(&BearingSite, f64)> = model
        .bearings
        .iter()
        .filter_map(|site| Some((site, site.bearing.ball()?.geometry.width)))
        .filter(|(_, width)| *width > 0.0)
        .collect();
    for (k, (site, width)) in widths.iter().enumerate() {
        let overlap = |(other, other_width): &&(&BearingSite, f64)| {
            let distance = (model.node_z[site.node] - model.node_z[other.node]).abs();
            distance < 0.5 * (width + other_width) - OVERLAP * width.min(*other_width)
        };
        let Some((other, _)) = widths[..k].iter().find(overlap) else { continue };
        let message = format!("bearing.{} and bearing.{} are in the same place", other.name, site.name);
        let span = item_span(top, &bearing::TOP.bearing, &site.name);
        let problem = Problem::new(Kind::Geometry, &span, message)
            .hint("check their stations; one bearing with `arrangement` describes a matched pair");
        top.log.warn(Code::OverlappingBearings, format!("bearing.{}", site.name), problem);
    }
}

/// Unbalance of the rotor over its mass, times the highest speed of the profile.
fn balance_quality(top: &Reader, model: &Model) {
    let shaft = model.shaft.iter().flat_map(|e| e.with_layers()).map(|e| {
        let area = |k: usize| PI / 4.0 * (e.outer_diameter[k].powi(2) - e.inner_diameter[k].powi(2));
        0.5 * (area(0) + area(1)) * e.length * e.material.density
    });
    let mass = shaft.sum::<f64>() + model.rotating_inertias().map(|disc| disc.mass).sum::<f64>();
    let sum = model.unbalances.iter().fold([0.0; 2], |[x, y], u| {
        let (sin, cos) = u.phase.sin_cos();
        [x + u.magnitude * cos, y + u.magnitude * sin]
    });
    let largest = model.unbalances.iter().map(|u| u.magnitude).fold(0.0, f64::max);
    let speed = model.profile.top_speed().abs();
    let quality = sum[0].hypot(sum[1]).max(largest) / mass * speed;
    if mass > 0.0 && quality > BALANCE_QUALITY {
        let message = format!(
            "the unbalance of {:.4} g mm on a rotor of {mass:.4} kg is G {:.0} at {:.0} rpm",
            1e6 * sum[0].hypot(sum[1]).max(largest),
            1e3 * quality,
            speed * 60.0 / TAU
        );
        let first = top.items(&loading::TOP.unbalance).into_iter().next().map_or(0..0, |(_, r)| r.span);
        let problem = Problem::new(Kind::OutOfRange, &first, message)
            .expected("G 100 or better; fans have G 6.3, spindles G 1")
            .hint("check the unit: 1 g mm is 1e-6 kg m");
        top.log.warn(Code::BalanceQuality, "unbalance", problem);
    }
}

/// Warns of items that nothing names, of several: a single one is used without its name.
///
/// `root`: the file with its overrides; `text`: the file as written, with all its variants.
pub(super) fn check_unused(top: &Reader, root: &Table, text: &str, collections: &[&Key<NamedTables>]) {
    let mut named = Vec::new();
    texts(root, &mut named);
    let named: HashSet<&str> = named.into_iter().collect();
    // What stands between two quotation marks; that of a name with such marks in it cannot be told.
    let quoted: HashSet<&str> = text.split('"').chain(text.split('\'')).collect();
    let written = |name: &str| quoted.contains(name) || name.contains(['"', '\'']);
    for collection in collections {
        let items = top.items(collection);
        if items.len() < 2 {
            continue;
        }
        for (name, r) in items {
            if !named.contains(name) && !written(name) {
                let item = format!("{}.{name}", collection.about.name);
                let problem = Problem::new(Kind::UnknownName, &r.span, format!("{item} is used by nothing"))
                    .hint("remove it, or name it where it is meant");
                top.log.warn(Code::UnusedItem, item, problem);
            }
        }
    }
}

/// Every text value of a table and those within.
fn texts<'t>(table: &'t Table, found: &mut Vec<&'t str>) {
    fn of_value<'t>(value: &'t Value, found: &mut Vec<&'t str>) {
        match value {
            Value::Text(text) => found.push(text),
            Value::List(list) => list.iter().for_each(|node| of_value(&node.value, found)),
            Value::Table(inner) => texts(inner, found),
            _ => {}
        }
    }
    table.entries().iter().for_each(|entry| of_value(&entry.node.value, found));
}
