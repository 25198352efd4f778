//! Keys that all ball bearing models share.

use super::catalogue::CatalogueEntry;
use super::{catalogue, contact, imperfections, material};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative, positive};
use crate::file::tree::Value;
use rotordyn_bearing::contact::{ContactDamping, ContactLaw, Race};
use rotordyn_bearing::{BallBearing, BallGeometry, BallInertia, Cage, Fit, Preload, Service};
use rotordyn_core::element::Material;
use rotordyn_units::{ANGLE, LENGTH, NUMBER};
use std::f64::consts::{FRAC_PI_2, PI};

/// Properties common to all ball bearing models: geometry, materials, dry contacts, cage, imperfections; the
/// rest are defaults.
///
/// `osculation`: default of both grooves if neither file nor catalogue gives it; `None` if it is required.
pub(super) fn common_properties(
    r: &Reader,
    materials: &[Material],
    entry: Option<&CatalogueEntry>,
    osculation: Option<f64>,
) -> BallBearing {
    let geometry = geometry(r, entry, osculation);
    let part = |key: &str| match (r.has(key), r.has("material")) {
        (true, _) => material(r, key, materials),
        (_, true) => material(r, "material", materials),
        _ => None,
    };
    let steel = catalogue::bearing_steel();
    let pocket = geometry.default_cage_pocket();
    BallBearing {
        ball_material: part("ball_material").unwrap_or_else(|| steel.clone()),
        ring_material: part("ring_material").unwrap_or(steel),
        service: Service::default(),
        contact: ContactLaw::Hertz,
        contact_stiffness: contact::stiffness(r),
        damping: ContactDamping::Constant { coefficient: 0.0, ramp: 1e-6 },
        inertia: BallInertia::None,
        preload: Preload::None,
        duplex: None,
        fit: Fit::default(),
        cage: cage(r),
        cage_angle: r.or("cage_angle", any(ANGLE), 0.0),
        imperfections: imperfections::read(r, &geometry, r.has("arrangement")),
        cage_pocket_diameter: r.or("cage_pocket_diameter", positive(LENGTH), pocket),
        estimated_geometry: entry.filter(|e| e.estimated && !gives_geometry(r)).map(|e| e.origin.into()),
        geometry,
    }
}

pub(super) fn designation(r: &Reader) -> Option<CatalogueEntry> {
    let name = r.text("designation")?;
    let found = catalogue::find(name);
    if found.is_none() {
        let message = format!("unknown bearing designation `{name}`");
        let problem = Problem::new(Kind::UnknownName, &r.span_of("designation"), message);
        r.log.error(
            problem
                .expected("a bearing of assets/bearings.csv, or its geometry")
                .hint(format!("nearest in the catalogue: {}", catalogue::nearest(name, 6).join(", "))),
        );
    }
    found
}

/// Geometric feasibility check: balls do not overlap, groove radii exceed ball radii, rings enclose the
/// balls.
pub(super) fn check_geometry(r: &Reader, bearing: &BallBearing) {
    let g = &bearing.geometry;
    let balls = g.balls as f64;
    let spacing = g.pitch_diameter * (PI / balls).sin();
    let problem = |key: &str, message: String| Problem::new(Kind::Geometry, &r.span_of(key), message);
    let mm = |x: f64| x * 1e3;
    if spacing <= g.ball_diameter {
        let key =
            ["balls", "ball_diameter", "pitch_diameter"].into_iter().find(|k| r.has(k)).unwrap_or("balls");
        let message = format!(
            "the balls of {} overlap: {} balls of {:.3} mm on a pitch circle of {:.3} mm",
            r.path,
            g.balls,
            mm(g.ball_diameter),
            mm(g.pitch_diameter)
        );
        // largest integer Z below the real root of D_pw sin(π/Z) = D_w
        let most = (PI / (g.ball_diameter / g.pitch_diameter).min(1.0).asin()).ceil() - 1.0;
        let room = format!("at most {most} balls of this size, or balls below {:.3} mm", mm(spacing));
        r.log.error(problem(key, message).expected(room));
        return;
    }
    if bearing.cage_pocket_diameter < g.ball_diameter || bearing.cage_pocket_diameter > spacing {
        let message = format!("the cage pockets of {} do not fit", r.path);
        let range = format!(
            "from {:.3} mm (the ball) to {:.3} mm (the next pocket)",
            mm(g.ball_diameter),
            mm(spacing)
        );
        r.log.error(problem("cage_pocket_diameter", message).expected(range));
    }
    for (keys, radius) in [
        (["inner_groove_radius", "inner_osculation"], g.inner_groove_radius),
        (["outer_groove_radius", "outer_osculation"], g.outer_groove_radius),
    ] {
        if radius <= 0.5 * g.ball_diameter {
            let key = keys.into_iter().find(|k| r.has(k)).unwrap_or(keys[0]);
            let message = format!("the groove of {} is narrower than its balls", r.path);
            let least = format!("a radius above {:.4} mm (osculation above 0.5)", 500.0 * g.ball_diameter);
            r.log.error(problem(key, message).expected(least));
        }
    }
    if g.contact_angle >= FRAC_PI_2 {
        r.log.error(problem("contact_angle", format!("{} must be below 90 deg", r.name("contact_angle"))));
    }
    let (inside, outside) = (g.pitch_diameter - g.ball_diameter, g.pitch_diameter + g.ball_diameter);
    if g.bore >= inside || g.bore <= 0.0 {
        let message = format!("the balls of {} cut into its bore of {:.3} mm", r.path, mm(g.bore));
        r.log.error(problem("bore", message).expected(format!("a bore below {:.3} mm", mm(inside))));
    }
    if g.outside_diameter <= outside {
        let message = format!(
            "the balls of {} extend beyond its outside diameter of {:.3} mm",
            r.path,
            mm(g.outside_diameter)
        );
        let least = format!("an outside diameter above {:.3} mm", mm(outside));
        r.log.error(problem("outside_diameter", message).expected(least));
    }
    let [inner, outer] = bearing.service.shoulder_diameters;
    let [inner_bottom, outer_bottom] = [Race::Inner, Race::Outer].map(|race| g.groove_bottom_diameter(race));
    for (key, diameter, [least, most]) in [
        ("inner_shoulder_diameter", inner, [inner_bottom, g.pitch_diameter]),
        ("outer_shoulder_diameter", outer, [g.pitch_diameter, outer_bottom]),
    ] {
        if diameter.is_some_and(|diameter| diameter <= least || diameter >= most) {
            let message = format!("{} is not between the groove's bottom and the ball centres", r.name(key));
            let range = format!("from {:.3} to {:.3} mm", mm(least), mm(most));
            r.log.error(problem(key, message).expected(range));
        }
    }
    if g.radial_clearance.abs() > 0.1 * g.ball_diameter {
        let message = format!("{} is more than a tenth of the ball diameter", r.name("radial_clearance"));
        r.log.error(
            problem("radial_clearance", message).expected("a clearance of some micrometres, diametral"),
        );
    }
}

/// Whether the file itself gives all of the internal geometry.
pub(super) fn gives_geometry(r: &Reader) -> bool {
    let groove = |keys: [&str; 2]| keys.iter().any(|key| r.has(key));
    ["balls", "ball_diameter", "pitch_diameter"].iter().all(|key| r.has(key))
        && groove(["inner_osculation", "inner_groove_radius"])
        && groove(["outer_osculation", "outer_groove_radius"])
}

/// Geometry from the catalogue; the file may override each field.
pub(super) fn geometry(r: &Reader, entry: Option<&CatalogueEntry>, default: Option<f64>) -> BallGeometry {
    // an unknown designation was already reported; do not report its fields as missing
    let reported = r.has("designation") && entry.is_none();
    let field = |key: &str, from: fn(&CatalogueEntry) -> f64| match (r.get(key, positive(LENGTH)), entry) {
        (Some(given), _) => given,
        (None, Some(entry)) => from(entry),
        (None, None) if reported || r.has(key) => 1.0,
        (None, None) => r.need(key, positive(LENGTH)),
    };
    let ball_diameter = field("ball_diameter", |e| e.ball_diameter);
    let pitch_diameter = field("pitch_diameter", |e| e.pitch_diameter);
    let balls = match entry {
        None if !reported && !r.has("balls") => {
            r.missing("balls", "9");
            3
        }
        _ => r.count("balls", entry.map_or(3, |e| e.balls), 3..=1000),
    };
    let groove = |radius: &str, osculation: &str, k: usize| match r.one_of(&[radius, osculation]) {
        Some(key) if key == radius => r.need(radius, positive(LENGTH)),
        Some(_) => r.need(osculation, positive(NUMBER)) * ball_diameter,
        None => match entry {
            Some(e) => e.osculation[k] * ball_diameter,
            None if reported => ball_diameter,
            None => {
                default.unwrap_or_else(|| {
                    r.missing(osculation, "0.52");
                    1.0
                }) * ball_diameter
            }
        },
    };
    let inner_groove_radius = groove("inner_groove_radius", "inner_osculation", 0);
    let outer_groove_radius = groove("outer_groove_radius", "outer_osculation", 1);
    let contact_angle = r.or("contact_angle", not_negative(ANGLE), entry.map_or(0.0, |e| e.contact_angle));
    let thrust = thrust(r, contact_angle);
    let bore = r.or("bore", positive(LENGTH), entry.map_or(pitch_diameter - 2.2 * ball_diameter, |e| e.bore));
    let outside = entry.map_or(pitch_diameter + 2.2 * ball_diameter, |e| e.outside_diameter);
    BallGeometry {
        balls,
        ball_diameter,
        pitch_diameter,
        inner_groove_radius,
        outer_groove_radius,
        radial_clearance: clearance(r, bore, contact_angle),
        contact_angle,
        thrust_direction: thrust,
        moment_arm: r.get("moment_arm", positive(LENGTH)),
        bore,
        outside_diameter: r.or("outside_diameter", positive(LENGTH), outside),
        width: r.or("width", positive(LENGTH), entry.map_or(1.8 * ball_diameter, |e| e.width)),
    }
}

/// Thrust direction: required with a contact angle or a preload, except for a pair that carries thrust both
/// ways.
pub(super) fn thrust(r: &Reader, contact_angle: f64) -> f64 {
    let both_ways = matches!(r.text("arrangement"), Some("back_to_back" | "face_to_face"));
    let thrust = r.choice("thrust", &[("+z", 1.0), ("-z", -1.0)]);
    if both_ways && thrust.is_some() {
        let message =
            format!("{} does not apply to a pair that carries thrust in both directions", r.name("thrust"));
        r.error(Kind::Conflict, "thrust", message);
    }
    // a misspelt arrangement was already reported; whether it needs a direction is unknown
    let one_way = !r.has("arrangement") || r.text("arrangement") == Some("tandem");
    if one_way && (contact_angle > 0.0 || r.has("preload")) && !r.has("thrust") {
        r.missing(
            "thrust",
            "\"+z\" (direction of the shaft's axial load that the bearing transmits to the housing)",
        );
    }
    thrust.unwrap_or(1.0)
}

/// Diametral (radial internal) clearance: as given, or the mean of the clearance class (default CN); an
/// angular contact bearing has none by default.
pub(super) fn clearance(r: &Reader, bore: f64, contact_angle: f64) -> f64 {
    let class = match r.one_of(&["radial_clearance", "clearance"]) {
        Some("radial_clearance") => return r.get("radial_clearance", any(LENGTH)).unwrap_or(0.0),
        Some(_) => {
            let classes = catalogue::CLEARANCE_CLASSES.map(|c| (c, c));
            r.choice("clearance", &classes)
        }
        None if contact_angle > 0.0 => return 0.0,
        None => Some("CN"),
    };
    let Some(class) = class else { return 0.0 };
    match catalogue::clearance(class, bore) {
        Some([least, greatest]) => 0.5 * (least + greatest),
        None if !r.has_no_errors() => 0.0,
        None => {
            let message = format!("no clearance class is tabulated for a bore of {:.3} mm", bore * 1e3);
            let problem = Problem::new(Kind::OutOfRange, &r.span_of("clearance"), message);
            r.log.error(problem.hint("give radial_clearance = \"10 um\""));
            0.0
        }
    }
}

pub(super) fn cage(r: &Reader) -> Cage {
    match r.entry("cage").map(|e| &e.node.value) {
        None => Cage::Rolling,
        Some(Value::Text(text)) if text == "rolling" => Cage::Rolling,
        Some(Value::Integer(_) | Value::Float(_)) => {
            let ratio = r.get("cage", not_negative(NUMBER)).unwrap_or(0.4);
            if ratio > 1.0 {
                r.error(Kind::OutOfRange, "cage", format!("{} must be at most 1", r.name("cage")));
            }
            Cage::Ratio(ratio)
        }
        Some(_) => {
            let message = format!("{} is neither \"rolling\" nor a ratio", r.name("cage"));
            let problem = Problem::new(Kind::WrongType, &r.span_of("cage"), message);
            r.log.error(problem.expected("\"rolling\", or cage speed over shaft speed such as 0.3969"));
            Cage::Rolling
        }
    }
}
