//! Planar ball bearings with one radial degree of freedom per ball, `model = "radial_ball"`.

use super::catalogue::CatalogueEntry;
use super::{ball_keys, imperfections};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, not_negative};
use crate::file::tree::Value;
use rotordyn_bearing::{DefectLaw, RadialBallBearing};
use rotordyn_core::element::Material;
use rotordyn_units::TIME;

/// Default osculation of the grooves if the contact stiffness is given; it then has no other effect.
const DEFAULT_OSCULATION: f64 = 0.52;

/// Keys of `model = "ball"` that do not apply here, with a hint for each.
const INAPPLICABLE_KEYS: [(&str, &str); 11] = [
    ("contact_angle", "the balls move in the plane of the bearing"),
    ("thrust", "the balls move in the plane of the bearing"),
    ("moment_arm", "the balls move in the plane of the bearing"),
    ("preload", "a planar bearing carries no axial load; a negative radial_clearance preloads it radially"),
    ("arrangement", "add a second bearing at a neighbouring station"),
    ("ball_inertia", "ball inertia and centrifugal force are always included"),
    ("contact", "the contacts are dry, F = K d^1.5; give K as contact_stiffness"),
    ("contact_damping", "use stiffness-proportional damping: stiffness_damping = \"1e-4 s\""),
    ("damping_ramp", "use stiffness-proportional damping: stiffness_damping = \"1e-4 s\""),
    ("hunt_crossley", "use stiffness-proportional damping: stiffness_damping = \"1e-4 s\""),
    ("film_damping", "use stiffness-proportional damping: stiffness_damping = \"1e-4 s\""),
];

/// Read a bearing of this model; gravity in \[m/s²\].
pub(super) fn read(r: &Reader, materials: &[Material], gravity: [f64; 3]) -> RadialBallBearing {
    for (key, hint) in INAPPLICABLE_KEYS.iter().filter(|(key, _)| r.has(key)) {
        let message = format!("{} does not belong to model = \"radial_ball\"", r.name(key));
        r.log.error(Problem::new(Kind::Conflict, &r.span_of(key), message).hint(*hint));
    }
    let entry = ball_keys::designation(r).map(|entry| {
        if entry.contact_angle != 0.0 {
            let message = format!("{} is an angular-contact bearing", entry.designation);
            let problem = Problem::new(Kind::Conflict, &r.span_of("designation"), message);
            r.log.error(problem.expected("a deep-groove bearing (planar ball motion)"));
        }
        CatalogueEntry { contact_angle: 0.0, ..entry }
    });
    let given = matches!(r.entry("contact_stiffness").map(|e| &e.node.value), Some(Value::Table(_)));
    let ball =
        ball_keys::common_properties(r, materials, entry.as_ref(), given.then_some(DEFAULT_OSCULATION));
    imperfections::check_force_law(r, &ball);
    if ball.imperfections.law != DefectLaw::Displacement {
        let message = format!("{} does not belong to model = \"radial_ball\"", r.name("defect_law"));
        let problem = Problem::new(Kind::Conflict, &r.span_of("defect_law"), message);
        r.log.error(problem.expected("\"displacement\", applied to each contact separately"));
    }
    let damping = damping(r);
    let out = RadialBallBearing {
        stiffness_damping: damping,
        tensile_contact: r.flag("tensile_contact", false),
        gravity: [gravity[0], gravity[1]],
        ball,
    };
    if r.has_no_errors() {
        ball_keys::check_geometry(r, &out.ball);
    }
    if r.has_no_errors() && out.ball_mass() <= 0.0 {
        let key = if r.has("ball_material") { "ball_material" } else { "material" };
        let message = format!("the balls of {} have no mass", r.path);
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(key), message);
        r.log.error(problem.expected("a density above 0").hint("model = \"ball\" has massless balls"));
    }
    out
}

/// Stiffness-proportional contact damping: `stiffness_damping = "1e-4 s"` of both contacts, or
/// `{ inner = "1e-4 s", outer = "2e-4 s" }`.
fn damping(r: &Reader) -> [f64; 2] {
    const KEY: &str = "stiffness_damping";
    if let Some(Value::Table(_)) = r.entry(KEY).map(|e| &e.node.value) {
        let Some(each) = r.table(KEY) else { return [0.0; 2] };
        let out = ["inner", "outer"].map(|race| each.need(race, not_negative(TIME)));
        each.finish();
        return out;
    }
    [r.need(KEY, not_negative(TIME)); 2]
}
