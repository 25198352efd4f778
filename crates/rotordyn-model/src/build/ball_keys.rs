//! Keys that all ball bearing models share.

use super::catalogue::CatalogueEntry;
use super::mounting::{MOUNTING, PAIR};
use super::{catalogue, contact, imperfections, material};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Declared, Key, Quantity, Text, Words, any, count, keys, not_negative, positive, quantity, text,
    within, words,
};
use crate::file::reader::Reader;
use crate::file::tree::Value;
use rotordyn_bearing::contact::{ContactDamping, ContactLaw, Race};
use rotordyn_bearing::{BallBearing, BallGeometry, BallInertia, Cage, Fit, Preload, Service};
use rotordyn_core::element::Material;
use rotordyn_units::{ANGLE, LENGTH, NUMBER};
use std::f64::consts::{FRAC_PI_2, PI};

keys! {
    /// Of every ball bearing.
    pub(super) static BALL: BallKeys {
        designation: Text = text("a designation of the catalogue", "Bearing of the built-in catalogue; keys override it.")
            .optional().example("\"6205\"");
        balls: Count = count([3, 1000], "Number of balls.").required("without designation").example("9");
        ball_diameter: Quantity = quantity(positive(LENGTH), "Diameter D_w of the balls.").required("without designation")
            .example("\"7.94 mm\"");
        pitch_diameter: Quantity = quantity(positive(LENGTH), "Diameter D_pw of the circle through the ball centres.")
            .required("without designation").example("\"38.5 mm\"");
        inner_osculation: Quantity = quantity(positive(NUMBER), "Radius of the inner groove over the ball diameter.")
            .required("without designation").example("0.52");
        outer_osculation: Quantity = quantity(positive(NUMBER), "Radius of the outer groove over the ball diameter.")
            .required("without designation").example("0.53");
        inner_groove_radius: Quantity = quantity(positive(LENGTH), "Radius of the inner groove, instead of its osculation.")
            .computed("from inner_osculation").example("\"4.13 mm\"");
        outer_groove_radius: Quantity = quantity(positive(LENGTH), "Radius of the outer groove, instead of its osculation.")
            .computed("from outer_osculation").example("\"4.21 mm\"");
        radial_clearance: Quantity = quantity(any(LENGTH), "Radial internal clearance, diametral; negative: preload.")
            .computed("by clearance, with a contact angle 0").example("\"10 um\"");
        clearance: Words<&'static str> = words(&CLEARANCES, "Clearance class of ISO 5753-1, instead of radial_clearance.")
            .default("CN");
        bore: Quantity = quantity(positive(LENGTH), "Bore of the inner ring.")
            .computed("of the designation, else D_pw - 2.2 D_w").example("\"25 mm\"");
        outside_diameter: Quantity = quantity(positive(LENGTH), "Outside diameter of the outer ring.")
            .computed("of the designation, else D_pw + 2.2 D_w").example("\"52 mm\"");
        width: Quantity = quantity(positive(LENGTH), "Width of the rings.")
            .computed("of the designation, else 1.8 D_w").example("\"15 mm\"");
        material: Text = text("name of a material", "Material of balls and rings.").computed("bearing steel")
            .example("\"steel\"");
        ball_material: Text = text("name of a material", "Material of the balls.").computed("material")
            .example("\"steel\"");
        ring_material: Text = text("name of a material", "Material of the rings.").computed("material")
            .example("\"steel\"");
        cage: Words<()> = words(&[("rolling", ())], "Cage speed of balls that roll without slip.").default("rolling");
        cage_ratio: Quantity = quantity(within(NUMBER, [0.0, 1.0]), "Cage speed over shaft speed.").named("cage")
            .optional().example("0.3969");
        cage_angle: Quantity = quantity(any(ANGLE), "Position of a ball at the start of a run, from +x towards +y.")
            .default("0 deg").example("\"20 deg\"");
        cage_pocket_diameter: Quantity = quantity(positive(LENGTH), "Diameter of the cage pockets.")
            .computed("from the geometry").example("\"8.2 mm\"");
    }
}

keys! {
    /// Of `model = "ball"` only.
    pub(super) static AXIAL: AxialKeys {
        contact_angle: Quantity = quantity(not_negative(ANGLE), "Nominal contact angle, below 90 deg.")
            .computed("of the designation, else 0 deg").example("\"15 deg\"");
        thrust: Words<f64> = words(&[("+z", 1.0), ("-z", -1.0)],
            "Direction of the shaft's axial load that the bearing transmits to the housing.")
            .required("with a contact angle or preload");
        moment_arm: Quantity = quantity(positive(LENGTH), "Radius at which axial ball forces act.")
            .computed("that of the inner groove centres").example("\"19 mm\"");
    }
}

/// Clearance classes, each standing for itself.
const CLEARANCES: [(&str, &str); 5] = [("C2", "C2"), ("CN", "CN"), ("C3", "C3"), ("C4", "C4"), ("C5", "C5")];

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
    let part = |key: &Key<Text>| match (r.has(key), r.has(&BALL.material)) {
        (true, _) => material(r, key, materials),
        (_, true) => material(r, &BALL.material, materials),
        _ => None,
    };
    let steel = catalogue::bearing_steel();
    let pocket = geometry.default_cage_pocket();
    if !r.has(&BALL.cage_pocket_diameter) {
        r.taken_by_default(&BALL.cage_pocket_diameter, format!("\"{:.3} mm\"", 1e3 * pocket));
    }
    BallBearing {
        ball_material: part(&BALL.ball_material).unwrap_or_else(|| steel.clone()),
        ring_material: part(&BALL.ring_material).unwrap_or(steel),
        service: Service::default(),
        contact: ContactLaw::Hertz,
        contact_stiffness: contact::stiffness(r),
        damping: ContactDamping::Constant { coefficient: 0.0, ramp: 1e-6 },
        inertia: BallInertia::None,
        preload: Preload::None,
        duplex: None,
        fit: Fit::default(),
        cage: cage(r),
        cage_angle: r.value(&BALL.cage_angle),
        imperfections: imperfections::read(r, &geometry, r.has(&PAIR.arrangement)),
        cage_pocket_diameter: r.or(&BALL.cage_pocket_diameter, pocket),
        estimated_geometry: entry.filter(|e| e.estimated && !gives_geometry(r)).map(|e| e.origin.into()),
        geometry,
    }
}

pub(super) fn designation(r: &Reader) -> Option<CatalogueEntry> {
    let name = r.text(&BALL.designation)?;
    let found = catalogue::find(name);
    if found.is_none() {
        let message = format!("unknown bearing designation `{name}`");
        let problem = Problem::new(Kind::UnknownName, &r.span_of(&BALL.designation), message);
        let problem = problem.expected("a ball bearing of `rotordyn catalogue`, or its geometry");
        r.log.error(problem.hint(match catalogue::is_roller_bearing(name) {
            true => "a roller bearing: use model = \"linear\" with its stiffness k_xx, k_yy ...".into(),
            false => format!("nearest in the catalogue: {}", catalogue::nearest(name, 6).join(", ")),
        }));
    }
    found
}

/// Geometric feasibility check: balls do not overlap, groove radii exceed ball radii, rings enclose the
/// balls.
pub(super) fn check_geometry(r: &Reader, bearing: &BallBearing) {
    let g = &bearing.geometry;
    let balls = g.balls as f64;
    let spacing = g.pitch_diameter * (PI / balls).sin();
    let problem =
        |key: &dyn Declared, message: String| Problem::new(Kind::Geometry, &r.span_of(key), message);
    let mm = |x: f64| x * 1e3;
    if spacing <= g.ball_diameter {
        let keys: [&dyn Declared; 3] = [&BALL.balls, &BALL.ball_diameter, &BALL.pitch_diameter];
        let key = keys.into_iter().find(|key| r.has(*key)).unwrap_or(&BALL.balls);
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
        r.log.error(problem(&BALL.cage_pocket_diameter, message).expected(range));
    }
    for (keys, radius) in [
        ([&BALL.inner_groove_radius, &BALL.inner_osculation], g.inner_groove_radius),
        ([&BALL.outer_groove_radius, &BALL.outer_osculation], g.outer_groove_radius),
    ] {
        if radius <= 0.5 * g.ball_diameter {
            let key = keys.into_iter().find(|key| r.has(*key)).unwrap_or(keys[0]);
            let message = format!("the groove of {} is narrower than its balls", r.path);
            let least = format!("a radius above {:.4} mm (osculation above 0.5)", 500.0 * g.ball_diameter);
            r.log.error(problem(key, message).expected(least));
        }
    }
    if g.contact_angle >= FRAC_PI_2 {
        r.log.error(problem(
            &AXIAL.contact_angle,
            format!("{} must be below 90 deg", r.name(&AXIAL.contact_angle)),
        ));
    }
    let (inside, outside) = (g.pitch_diameter - g.ball_diameter, g.pitch_diameter + g.ball_diameter);
    if g.bore >= inside || g.bore <= 0.0 {
        let message = format!("the balls of {} cut into its bore of {:.3} mm", r.path, mm(g.bore));
        r.log.error(problem(&BALL.bore, message).expected(format!("a bore below {:.3} mm", mm(inside))));
    }
    if g.outside_diameter <= outside {
        let message = format!(
            "the balls of {} extend beyond its outside diameter of {:.3} mm",
            r.path,
            mm(g.outside_diameter)
        );
        let least = format!("an outside diameter above {:.3} mm", mm(outside));
        r.log.error(problem(&BALL.outside_diameter, message).expected(least));
    }
    let [inner, outer] = bearing.service.shoulder_diameters;
    let [inner_bottom, outer_bottom] = [Race::Inner, Race::Outer].map(|race| g.groove_bottom_diameter(race));
    for (key, diameter, [least, most]) in [
        (&contact::SERVICE.inner_shoulder_diameter, inner, [inner_bottom, g.pitch_diameter]),
        (&contact::SERVICE.outer_shoulder_diameter, outer, [g.pitch_diameter, outer_bottom]),
    ] {
        if diameter.is_some_and(|diameter| diameter <= least || diameter >= most) {
            let message = format!("{} is not between the groove's bottom and the ball centres", r.name(key));
            let range = format!("from {:.3} to {:.3} mm", mm(least), mm(most));
            r.log.error(problem(key, message).expected(range));
        }
    }
    if g.radial_clearance.abs() > 0.1 * g.ball_diameter {
        let message = format!("{} is more than a tenth of the ball diameter", r.name(&BALL.radial_clearance));
        r.log.error(
            problem(&BALL.radial_clearance, message).expected("a clearance of some micrometres, diametral"),
        );
    }
}

/// Whether the file itself gives all of the internal geometry.
pub(super) fn gives_geometry(r: &Reader) -> bool {
    let given = |keys: [&dyn Declared; 2]| keys.into_iter().any(|key| r.has(key));
    [&BALL.balls as &dyn Declared, &BALL.ball_diameter, &BALL.pitch_diameter]
        .into_iter()
        .all(|key| r.has(key))
        && given([&BALL.inner_osculation, &BALL.inner_groove_radius])
        && given([&BALL.outer_osculation, &BALL.outer_groove_radius])
}

/// Geometry from the catalogue; the file may override each field.
pub(super) fn geometry(r: &Reader, entry: Option<&CatalogueEntry>, default: Option<f64>) -> BallGeometry {
    // an unknown designation was already reported; do not report its fields as missing
    let reported = r.has(&BALL.designation) && entry.is_none();
    let field = |key: &Key<Quantity>, from: fn(&CatalogueEntry) -> f64| match (r.get(key), entry) {
        (Some(given), _) => given,
        (None, Some(entry)) => from(entry),
        (None, None) if reported || r.has(key) => 1.0,
        (None, None) => r.value(key),
    };
    let ball_diameter = field(&BALL.ball_diameter, |e| e.ball_diameter);
    let pitch_diameter = field(&BALL.pitch_diameter, |e| e.pitch_diameter);
    let balls = match entry {
        None if !reported => r.count(&BALL.balls),
        _ => r.count_or(&BALL.balls, entry.map_or(BALL.balls.value.least, |e| e.balls)),
    };
    let groove = |radius: &Key<Quantity>, osculation: &Key<Quantity>, k: usize| match r
        .one_of(&[radius, osculation])
    {
        Some(given) if given.is(radius) => r.value(radius),
        Some(_) => r.value(osculation) * ball_diameter,
        None => match (entry, default) {
            (Some(e), _) => e.osculation[k] * ball_diameter,
            (None, _) if reported => ball_diameter,
            (None, Some(default)) => default * ball_diameter,
            (None, None) => r.value(osculation) * ball_diameter,
        },
    };
    let inner_groove_radius = groove(&BALL.inner_groove_radius, &BALL.inner_osculation, 0);
    let outer_groove_radius = groove(&BALL.outer_groove_radius, &BALL.outer_osculation, 1);
    let contact_angle = r.or(&AXIAL.contact_angle, entry.map_or(0.0, |e| e.contact_angle));
    let thrust = thrust(r, contact_angle);
    let bore = r.or(&BALL.bore, entry.map_or(pitch_diameter - 2.2 * ball_diameter, |e| e.bore));
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
        moment_arm: r.get(&AXIAL.moment_arm),
        bore,
        outside_diameter: r.or(&BALL.outside_diameter, outside),
        width: r.or(&BALL.width, entry.map_or(1.8 * ball_diameter, |e| e.width)),
    }
}

/// Thrust direction: required with a contact angle or a preload, except for a pair that carries thrust both
/// ways.
pub(super) fn thrust(r: &Reader, contact_angle: f64) -> f64 {
    let arrangement = r.given_text(&PAIR.arrangement);
    let both_ways = matches!(arrangement, Some("back_to_back" | "face_to_face"));
    let thrust = r.choice(&AXIAL.thrust);
    if both_ways && thrust.is_some() {
        let message = format!(
            "{} does not apply to a pair that carries thrust in both directions",
            r.name(&AXIAL.thrust)
        );
        r.error(Kind::Conflict, &AXIAL.thrust, message);
    }
    // a misspelt arrangement was already reported; whether it needs a direction is unknown
    let one_way = !r.has(&PAIR.arrangement) || arrangement == Some("tandem");
    if one_way && (contact_angle > 0.0 || r.has(&MOUNTING.preload)) && !r.has(&AXIAL.thrust) {
        r.missing_or(
            &AXIAL.thrust,
            " (direction of the shaft's axial load that the bearing transmits to the housing)",
        );
    }
    thrust.unwrap_or(1.0)
}

/// Whether the bore is stated, by itself or by a designation, not estimated.
pub(super) fn states_bore(r: &Reader) -> bool {
    r.has(&BALL.designation) || r.has(&BALL.bore)
}

/// Diametral (radial internal) clearance: as given, or the mean of the clearance class (default CN); an
/// angular contact bearing has none by default.
pub(super) fn clearance(r: &Reader, bore: f64, contact_angle: f64) -> f64 {
    let class = match r.one_of(&[&BALL.radial_clearance, &BALL.clearance]) {
        Some(given) if given.is(&BALL.radial_clearance) => {
            return r.get(&BALL.radial_clearance).unwrap_or(0.0);
        }
        Some(_) => r.choice(&BALL.clearance),
        None if contact_angle > 0.0 => {
            r.taken_by_default(&BALL.radial_clearance, "\"0 um\"");
            return 0.0;
        }
        None => Some(r.word(&BALL.clearance)),
    };
    let Some(class) = class else { return 0.0 };
    match catalogue::clearance(class, bore) {
        Some([least, greatest]) => 0.5 * (least + greatest),
        None if !r.has_no_errors() => 0.0,
        None => {
            let message = format!("no clearance class is tabulated for a bore of {:.3} mm", bore * 1e3);
            let problem = Problem::new(Kind::OutOfRange, &r.span_of(&BALL.clearance), message);
            r.log.error(problem.hint("give radial_clearance = \"10 um\""));
            0.0
        }
    }
}

pub(super) fn cage(r: &Reader) -> Cage {
    match r.entry(&BALL.cage).map(|e| &e.node.value) {
        None => Cage::Rolling,
        Some(Value::Text(text)) if text == "rolling" => Cage::Rolling,
        Some(Value::Integer(_) | Value::Float(_)) => Cage::Ratio(r.get(&BALL.cage_ratio).unwrap_or(0.4)),
        Some(_) => {
            let message = format!("{} is neither \"rolling\" nor a ratio", r.name(&BALL.cage));
            let problem = Problem::new(Kind::WrongType, &r.span_of(&BALL.cage), message);
            r.log.error(problem.expected("\"rolling\", or cage speed over shaft speed such as 0.3969"));
            Cage::Rolling
        }
    }
}
