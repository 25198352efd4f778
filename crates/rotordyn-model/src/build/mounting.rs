//! Mounting of ball bearings: preload, duplex arrangements (matched pairs), fits, axial location of the
//! shaft.

use super::loading;
use crate::file::diagnostic::{Kind, Log, Problem};
use crate::file::key::{
    Flag, Quantity, SubTable, Words, any, flag, keys, not_negative, positive, quantity, sub_table, words,
};
use crate::file::reader::Reader;
use crate::{Drive, Model};
use rotordyn_bearing::{Arrangement, BallBearing, BallGeometry, Bearing, Duplex, Fit, Preload};
use rotordyn_core::element::Anchor;
use rotordyn_units::{EXPANSION, FORCE, LENGTH, STIFFNESS, TEMPERATURE_DIFFERENCE};
use std::ops::Range;

keys! {
    /// Of `model = "ball"` only.
    pub(super) static MOUNTING: MountingKeys {
        preload: SubTable = sub_table(PreloadKeys::TABLE);
        fit: SubTable = sub_table(FitKeys::TABLE);
    }
}

keys! {
    /// Of a matched pair of two rows.
    pub(super) static PAIR: PairKeys {
        arrangement: Words<Arrangement> = words(&[
            ("back_to_back", Arrangement::BackToBack),
            ("face_to_face", Arrangement::FaceToFace),
            ("tandem", Arrangement::Tandem),
        ], "Duplex pair of angular contact bearings.").optional();
        row_spacing: Quantity = quantity(positive(LENGTH), "Distance of the two rows, of a pair in any arrangement.")
            .required("with arrangement").with("arrangement = \"back_to_back\"").example("\"16 mm\"");
    }
}

keys! {
    /// `preload = { ... }`.
    pub(super) static PRELOAD: PreloadKeys = "Axial preload in the direction of thrust, in one of five forms; rows in tandem share it." {
        force: Quantity = quantity(positive(FORCE), "Force with centred rings at speed, or of the spring.")
            .required("or another form").example("\"150 N\"");
        dry_force: Quantity = quantity(positive(FORCE), "Force with centred rings at rest.").optional()
            .example("\"150 N\"");
        mounted_force: Quantity = quantity(positive(FORCE), "Force in the assembled machine at standstill.").optional()
            .example("\"150 N\"");
        interference: Quantity = quantity(any(LENGTH), "Rigid axial approach of the rings from their nominal position.")
            .optional().example("\"1.5 um\"");
        spring: Quantity = quantity(positive(STIFFNESS), "Stiffness of a spring on a sliding outer ring, with the force when undeflected.")
            .optional().with("force = \"150 N\"").example("\"2e5 N/m\"");
    }
}

keys! {
    /// `fit = { ... }`.
    static FIT: FitKeys = "Fits of the rings, their temperatures and growth, which change the clearance." {
        shaft_interference: Quantity = quantity(not_negative(LENGTH), "Diametral interference on the shaft.")
            .default("0 um").example("\"8 um\"");
        shaft_bore: Quantity = quantity(not_negative(LENGTH), "Bore of a hollow shaft.").default("0 mm")
            .example("\"10 mm\"");
        housing_interference: Quantity = quantity(not_negative(LENGTH), "Diametral interference in the housing.")
            .default("0 um").example("\"8 um\"");
        housing_diameter: Quantity = quantity(positive(LENGTH), "Outside diameter of the housing.")
            .computed("a rigid housing").example("\"80 mm\"");
        inner_temperature_rise: Quantity = quantity(any(TEMPERATURE_DIFFERENCE), "Temperature rise of the inner ring.")
            .default("0 K");
        outer_temperature_rise: Quantity = quantity(any(TEMPERATURE_DIFFERENCE), "Temperature rise of the outer ring.")
            .default("0 K");
        expansion: Quantity = quantity(any(EXPANSION), "Coefficient of thermal expansion; bearing steel by default.")
            .default("12e-6 1/K");
        speed_growth: Flag = flag("Whether the inner ring grows with speed.").default("false");
    }
}

/// Duplex pair: `arrangement` with `row_spacing`.
pub(super) fn duplex(r: &Reader, contact_angle: f64) -> Option<Duplex> {
    let arrangement = r.choice(&PAIR.arrangement);
    if !r.has(&PAIR.arrangement) {
        if r.has(&PAIR.row_spacing) {
            let message = format!("{} applies only with an arrangement", r.name(&PAIR.row_spacing));
            let problem = Problem::new(Kind::Conflict, &r.span_of(&PAIR.row_spacing), message);
            r.log.error(problem.hint("add arrangement = \"back_to_back\", or remove row_spacing"));
        }
        return None;
    }
    if contact_angle == 0.0 {
        let message = format!("{} has rows without contact angle", r.path);
        let problem = Problem::new(Kind::Conflict, &r.span_of(&PAIR.arrangement), message);
        r.log.error(problem.expected("an angular contact bearing").hint(
            "give contact_angle or a designation such as \"7205B\"; a deep groove bearing has no thrust direction",
        ));
    }
    let spacing = r.value(&PAIR.row_spacing);
    arrangement.map(|arrangement| Duplex { arrangement, spacing })
}

/// Preload: `preload = { force = "150 N" }`, `{ dry_force = "150 N" }`, `{ mounted_force = "150 N" }`,
/// `{ interference = "1.5 um" }` or `{ spring = "2e5 N/m", force = "150 N" }`.
pub(super) fn preload(r: &Reader) -> Preload {
    let Some(p) = r.table(&MOUNTING.preload) else { return Preload::None };
    let PreloadKeys { force, dry_force, mounted_force, interference, spring } = &PRELOAD;
    let preload = if p.has(spring) {
        p.one_of(&[spring, interference, dry_force, mounted_force]);
        Preload::Spring { stiffness: p.value(spring), force: p.value(force) }
    } else {
        match p.one_of(&[force, dry_force, mounted_force, interference]) {
            Some(given) if given.is(force) => Preload::Force(p.value(force)),
            Some(given) if given.is(mounted_force) => {
                Preload::Mounted { force: p.value(mounted_force), interference: None }
            }
            Some(given) if given.is(dry_force) => Preload::DryForce(p.value(dry_force)),
            Some(_) => Preload::Interference(p.value(interference)),
            None => {
                p.missing_or(
                    force,
                    ", or dry_force, mounted_force = \"150 N\", interference = \"1.5 um\", or spring and force",
                );
                Preload::None
            }
        }
    };
    p.finish();
    preload
}

/// Fits: `fit = { shaft_interference = "8 um", inner_temperature_rise = "20 K", speed_growth = true }`.
pub(super) fn fit(r: &Reader, g: &BallGeometry) -> Fit {
    let Some(f) = r.table(&MOUNTING.fit) else { return Fit::default() };
    let geometry_known = r.has_no_errors();
    let fit = Fit {
        shaft_interference: f.value(&FIT.shaft_interference),
        shaft_bore: f.value(&FIT.shaft_bore),
        housing_interference: f.value(&FIT.housing_interference),
        housing_diameter: f.or(&FIT.housing_diameter, 0.0),
        inner_temperature_rise: f.value(&FIT.inner_temperature_rise),
        outer_temperature_rise: f.value(&FIT.outer_temperature_rise),
        expansion: f.value(&FIT.expansion),
        speed_growth: f.flag(&FIT.speed_growth),
    };
    let mm = |x: f64| x * 1e3;
    if geometry_known && fit.shaft_bore >= g.bore {
        let message = format!("{} is not less than the bearing's bore", f.name(&FIT.shaft_bore));
        let problem = Problem::new(Kind::Geometry, &f.span_of(&FIT.shaft_bore), message);
        f.log.error(problem.expected(format!("a bore of the shaft below {:.3} mm", mm(g.bore))));
    }
    if geometry_known && fit.housing_diameter > 0.0 && fit.housing_diameter <= g.outside_diameter {
        let message =
            format!("{} is not greater than the bearing's outside diameter", f.name(&FIT.housing_diameter));
        let problem = Problem::new(Kind::Geometry, &f.span_of(&FIT.housing_diameter), message);
        f.log.error(problem.expected(format!("above {:.3} mm", mm(g.outside_diameter))));
    }
    // A larger interference is probably a typing error in the magnitude.
    let widest = 2e-3 * g.bore;
    for (key, interference) in [
        (&FIT.shaft_interference, fit.shaft_interference),
        (&FIT.housing_interference, fit.housing_interference),
    ] {
        if geometry_known && interference > widest {
            let message = format!("{} is more than two thousandths of the bore", f.name(key));
            let problem = Problem::new(Kind::OutOfRange, &f.span_of(key), message);
            f.log.error(problem.expected("a diametral interference of some micrometres"));
        }
    }
    f.finish();
    fit
}

/// Report every preload without an axial counter-support (no bearing carries the opposite thrust).
///
/// `sites`: the tables of the bearings.
pub(super) fn check_axial_location(sites: &[(&str, Reader)], model: &Model, log: &Log) {
    let shaft = model.node_z.len();
    let on_shaft = |node: Option<usize>| node.is_some_and(|node| node < shaft);
    let held = model.elements().filter_map(|(_, element)| element.connection()).any(|connection| {
        let [a, b] = connection.ends;
        on_shaft(a.node) != on_shaft(b.node) && connection.stiff[2]
    });
    let joint = model.joints.iter().any(|j| on_shaft(j.a.node) != on_shaft(j.b.node) && j.locked[2]);
    let pushed = model.gravity[2] != 0.0
        || model.loads.iter().any(|l| on_shaft(l.at.node) && l.factor.is_constant() && l.force[2] != 0.0);
    if held || joint || pushed {
        return;
    }
    let preloaded = |ball: &BallBearing| ball.preload != Preload::None;
    for (k, site) in model.bearings.iter().enumerate() {
        let Some(ball) = site.bearing.static_balls() else { continue };
        let [along, against] = site.bearing.thrust_directions();
        if !preloaded(ball) || (along && against) {
            continue;
        }
        let opposite = usize::from(along);
        let mut others = model.bearings.iter().enumerate().filter(|(j, _)| *j != k);
        if others.any(|(_, other)| other.bearing.thrust_directions()[opposite]) {
            continue;
        }
        let (way, other) = if along { ("+z", "-z") } else { ("-z", "+z") };
        let span = preload_span(sites, &site.name);
        let message = format!(
            "bearing.{} is preloaded, but nothing carries the shaft's axial load along {other}",
            site.name
        );
        let problem = Problem::new(Kind::Disconnected, &span, message)
            .expected(format!("an axial support opposite to this bearing's thrust = \"{way}\""))
            .hint(format!(
                "add a bearing with thrust = \"{other}\", make this one a pair (arrangement = \"back_to_back\"), or give a linear bearing or bushing axial stiffness"
            ));
        log.error(problem);
    }
}

/// Span of the preload of a bearing.
fn preload_span(sites: &[(&str, Reader)], name: &str) -> Range<usize> {
    let site = sites.iter().find(|(site, _)| *site == name);
    site.map_or(0..0, |(_, r)| r.span_of(&MOUNTING.preload))
}

/// Report mounted preloads that do not determine the axial position: more than one, or without the machine.
///
/// `sites`: the tables of the bearings.
pub(super) fn check_mounted_preloads<'a>(
    sites: &[(&str, Reader)],
    bearings: impl Iterator<Item = (&'a str, &'a Bearing)>,
    in_machine: bool,
    log: &Log,
) {
    let is_mounted = |bearing: &Bearing| {
        bearing.static_balls().is_some_and(|ball| matches!(ball.preload, Preload::Mounted { .. }))
    };
    let names: Vec<&str> =
        bearings.filter(|(_, bearing)| is_mounted(bearing)).map(|(name, _)| name).collect();
    let (first, others) = match names.split_first() {
        None => return,
        Some(_) if !in_machine => (None, names.as_slice()),
        Some((first, others)) => (Some(first), others),
    };
    for name in others {
        let span = preload_span(sites, name);
        log.error(match first {
            Some(first) => Problem::new(
                Kind::Conflict,
                &span,
                format!("bearing.{first} and bearing.{name} both have a mounted_force on one shaft"),
            )
            .expected("one, whose interference gives the axial force in the machine")
            .hint("the shaft's equilibrium gives the axial force of the other bearing; remove this preload"),
            None => Problem::new(
                Kind::Conflict,
                &span,
                format!(
                    "the mounted_force of bearing.{name} needs the machine, and the file has bearings only"
                ),
            )
            .expected("force or dry_force, the axial force of the bearing with centred rings"),
        });
    }
}

/// Report everything that holds the shaft's rotation against a torque drive, whose rotation is free.
pub(super) fn check_free_rotation(top: &Reader, model: &Model) {
    if !matches!(model.drive, Drive::Torque { .. }) {
        return;
    }
    let shaft = model.node_z.len();
    let on_shaft = |node: Option<usize>| node.is_some_and(|node| node < shaft);
    let apart = |a: &Anchor, b: &Anchor| on_shaft(a.node) != on_shaft(b.node);
    let connections = model.elements().filter_map(|(_, element)| element.connection());
    let connections = connections.filter(|c| apart(&c.ends[0], &c.ends[1]) && c.stiff[5]);
    let bearings = model.bearings.iter().filter(|site| site.bearing.supports()[5]);
    let joints = model.joints.iter().filter(|j| apart(&j.a, &j.b) && j.locked[5]);
    let held = connections
        .map(|c| format!("{} has k_spin", c.name))
        .chain(bearings.map(|b| format!("bearing.{} has k_spin", b.name)))
        .chain(joints.map(|j| format!("joint.{} locks theta_z", j.name)));
    let span = top.table(&loading::TOP.drive).map_or(0..0, |r| r.span_of(&loading::DRIVE.kind));
    for what in held {
        let message = format!("drive.kind = \"torque\" needs a shaft that is free to rotate, but {what}");
        let problem = Problem::new(Kind::Conflict, &span, message)
            .hint("remove this constraint of the rotation, or set drive.kind = \"prescribed\"");
        top.log.error(problem);
    }
}
