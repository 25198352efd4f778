//! Planar ball bearings with one radial degree of freedom per ball, `model = "radial_ball"`.

use super::ball_inertia::BALL_INERTIA;
use super::ball_keys::{self, AXIAL, BALL};
use super::catalogue::CatalogueEntry;
use super::contact::{BALL_CONTACT, CONTACT_STIFFNESS};
use super::imperfections::{self, DEFECT_LAW};
use super::mounting::{MOUNTING, PAIR};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Declared, Flag, Quantity, SubTable, flag, keys, not_negative, quantity, sub_table};
use crate::file::reader::Reader;
use rotordyn_bearing::{DefectLaw, RadialBallBearing};
use rotordyn_core::element::Material;
use rotordyn_units::TIME;

/// Default osculation of the grooves if the contact stiffness is given; it then has no other effect.
const DEFAULT_OSCULATION: f64 = 0.52;

keys! {
    /// Of `model = "radial_ball"` only.
    pub(super) static RADIAL_BALL: RadialBallKeys {
        stiffness_damping: Quantity = quantity(not_negative(TIME),
            "Stiffness-proportional damping of both contacts, factor of the contact stiffness.").example("\"1e-4 s\"");
        each_damping: SubTable = sub_table(EachDampingKeys::TABLE).named("stiffness_damping").required("");
        tensile_contact: Flag = flag("Whether the damped force may pull while contacts separate (Upadhyay et al. 2009).")
            .default("false");
    }
}

keys! {
    /// `stiffness_damping = { ... }`.
    static EACH_DAMPING: EachDampingKeys = "Stiffness-proportional damping of each contact." {
        inner: Quantity = quantity(not_negative(TIME), "At the inner race.").example("\"1e-4 s\"");
        outer: Quantity = quantity(not_negative(TIME), "At the outer race.").example("\"1e-4 s\"");
    }
}

const DAMPING_HINT: &str = "use stiffness-proportional damping: stiffness_damping = \"1e-4 s\"";
const PLANE_HINT: &str = "the balls move in the plane of the bearing";

/// Keys of `model = "ball"` that do not apply here, with a hint for each.
const INAPPLICABLE_KEYS: [(&dyn Declared, &str); 11] = [
    (&AXIAL.contact_angle, PLANE_HINT),
    (&AXIAL.thrust, PLANE_HINT),
    (&AXIAL.moment_arm, PLANE_HINT),
    (
        &MOUNTING.preload,
        "a planar bearing carries no axial load; a negative radial_clearance preloads it radially",
    ),
    (&PAIR.arrangement, "add a second bearing at a neighbouring station"),
    (&BALL_INERTIA.ball_inertia, "ball inertia and centrifugal force are always included"),
    (&BALL_CONTACT.contact, "the contacts are dry, F = K d^1.5; give K as contact_stiffness"),
    (&BALL_CONTACT.contact_damping, DAMPING_HINT),
    (&BALL_CONTACT.damping_ramp, DAMPING_HINT),
    (&BALL_CONTACT.hunt_crossley, DAMPING_HINT),
    (&BALL_CONTACT.film_damping, DAMPING_HINT),
];

/// Read a bearing of this model; gravity in \[m/s²\].
pub(super) fn read(r: &Reader, materials: &[Material], gravity: [f64; 3]) -> RadialBallBearing {
    for (key, hint) in INAPPLICABLE_KEYS.iter().filter(|(key, _)| r.has(*key)) {
        let message = format!("{} does not belong to model = \"radial_ball\"", r.name(*key));
        r.log.error(Problem::new(Kind::Conflict, &r.span_of(*key), message).hint(*hint));
    }
    let entry = ball_keys::designation(r).map(|entry| {
        if entry.contact_angle != 0.0 {
            let message = format!("{} is an angular-contact bearing", entry.designation);
            let problem = Problem::new(Kind::Conflict, &r.span_of(&BALL.designation), message);
            r.log.error(problem.expected("a deep-groove bearing (planar ball motion)"));
        }
        CatalogueEntry { contact_angle: 0.0, ..entry }
    });
    let given = r.has_table(&CONTACT_STIFFNESS.each);
    let ball =
        ball_keys::common_properties(r, materials, entry.as_ref(), given.then_some(DEFAULT_OSCULATION));
    imperfections::check_force_law(r, &ball);
    if ball.imperfections.law != DefectLaw::Displacement {
        let message =
            format!("{} does not belong to model = \"radial_ball\"", r.name(&DEFECT_LAW.defect_law));
        let problem = Problem::new(Kind::Conflict, &r.span_of(&DEFECT_LAW.defect_law), message);
        r.log.error(problem.expected("\"displacement\", applied to each contact separately"));
    }
    let damping = damping(r);
    let out = RadialBallBearing {
        stiffness_damping: damping,
        tensile_contact: r.flag(&RADIAL_BALL.tensile_contact),
        gravity: [gravity[0], gravity[1]],
        ball,
    };
    if r.has_no_errors() {
        ball_keys::check_geometry(r, &out.ball);
    }
    if r.has_no_errors() && out.ball_mass() <= 0.0 {
        let key = if r.has(&BALL.ball_material) { &BALL.ball_material } else { &BALL.material };
        let message = format!("the balls of {} have no mass", r.path);
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(key), message);
        r.log.error(problem.expected("a density above 0").hint("model = \"ball\" has massless balls"));
    }
    out
}

/// Stiffness-proportional contact damping: `stiffness_damping = "1e-4 s"` of both contacts, or
/// `{ inner = "1e-4 s", outer = "2e-4 s" }`.
fn damping(r: &Reader) -> [f64; 2] {
    if r.has_table(&RADIAL_BALL.each_damping) {
        let Some(each) = r.table(&RADIAL_BALL.each_damping) else { return [0.0; 2] };
        let out = [each.value(&EACH_DAMPING.inner), each.value(&EACH_DAMPING.outer)];
        each.finish();
        return out;
    }
    [r.value(&RADIAL_BALL.stiffness_damping); 2]
}
