//! Discs, rigid bodies, housings and sensors.

use super::material;
use super::places::{Place, Places};
use super::springs::{self, MatrixKind};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative, positive};
use rotordyn_core::element::{Bushing, Disc, Material, PointMass, RigidBody};
use rotordyn_units::{INERTIA, LENGTH, MASS};
use std::f64::consts::PI;

pub(super) fn discs(top: &Reader, materials: &[Material], places: &mut Places) -> Vec<Disc> {
    let mut discs = Vec::new();
    for (name, r) in top.items("disc") {
        let (node, z) = places.station(&r, "station");
        let disc = disc(name, &r, node, materials);
        r.finish();
        places.add(format!("disc.{name}"), node, [0.0, 0.0, z]);
        discs.push(disc);
    }
    discs
}

/// Disc by mass and moments of inertia, or by dimensions: m = ρ π/4 (D² − d²) h, I_p = m (D² + d²)/8,
/// I_d = I_p/2 + m h²/12.
fn disc(name: &str, r: &Reader, node: usize, materials: &[Material]) -> Disc {
    let by_mass = ["mass", "polar_inertia", "diametral_inertia"].iter().any(|k| r.has(k));
    let (outer, thickness) = if by_mass {
        (r.or("outer_diameter", positive(LENGTH), 0.0), r.or("thickness", positive(LENGTH), 0.0))
    } else {
        (r.need("outer_diameter", positive(LENGTH)), r.need("thickness", positive(LENGTH)))
    };
    let inner = r.or("inner_diameter", not_negative(LENGTH), 0.0);
    if (outer > 0.0 || !by_mass) && inner >= outer && r.has_no_errors() {
        let message = format!("{} is not less than the outer diameter", r.name("inner_diameter"));
        r.error(Kind::Geometry, "inner_diameter", message);
    }
    let (mass, polar, diametral) = if by_mass {
        if r.has("material") {
            r.error(
                Kind::Conflict,
                "material",
                format!("{} has no effect with a given mass", r.name("material")),
            );
        }
        let mass = r.need("mass", positive(MASS));
        let polar = r.need("polar_inertia", not_negative(INERTIA));
        (mass, polar, r.need("diametral_inertia", not_negative(INERTIA)))
    } else {
        let density = material(r, "material", materials).map_or(1.0, |m| m.density);
        let mass = density * PI / 4.0 * (outer * outer - inner * inner) * thickness;
        let polar = mass * (outer * outer + inner * inner) / 8.0;
        (mass, polar, polar / 2.0 + mass * thickness * thickness / 12.0)
    };
    // I_p = I_xx' + I_yy' of any mass distribution with I_d = I_xx' + m z² is at most 2 I_d
    if polar > 2.0 * diametral * (1.0 + 1e-9) && r.has_no_errors() {
        let message = format!(
            "{} is more than twice the diametral inertia, which is impossible",
            r.name("polar_inertia")
        );
        r.error(Kind::OutOfRange, "polar_inertia", message);
    }
    Disc {
        name: name.into(),
        node,
        mass,
        polar_inertia: polar,
        diametral_inertia: diametral,
        outer_diameter: outer,
        thickness,
    }
}

/// Rigid bodies and the support springs of housings.
pub(super) struct Bodies {
    pub bodies: Vec<RigidBody>,
    pub bushings: Vec<Bushing>,
}

/// `[body.x]` and `[housing.x]`; a housing is a body with a bushing at its centre of mass.
pub(super) fn bodies(top: &Reader, places: &mut Places, first_node: usize) -> Bodies {
    let mut bodies: Vec<RigidBody> = Vec::new();
    let mut bushings = Vec::new();
    for (name, r) in top.items("body") {
        let body = body(name, &r, places);
        places.add(format!("body.{name}"), first_node + bodies.len(), body.position);
        bodies.push(body);
        r.finish();
    }
    for (name, r) in top.items("housing") {
        if bodies.iter().any(|b| b.name == name) {
            let message = format!("a body and a housing are both called `{name}`");
            r.log.error(Problem::new(Kind::Conflict, &r.span, message).hint("give one of them another name"));
        }
        let body = body(name, &r, places);
        let on = r.text("on").unwrap_or("ground");
        let base: Option<Place> = places.find(&r, on, &r.span_of("on"), &["ground", "body"]).cloned();
        for key in ["k_x", "k_y", "k_z", "k_tilt", "k_spin"] {
            let given = r.has(key)
                || r.has("stiffness_si")
                || key == "k_tilt" && r.has("k_tilt_x") && r.has("k_tilt_y")
                || r.has(&format!("k_{0}{0}", &key[2..]));
            if !given {
                let example = if key.len() == 3 { "\"1e7 N/m\"" } else { "\"1e5 N m/rad\"" };
                r.missing(key, example);
            }
        }
        let own = Place {
            name: format!("housing.{name}"),
            node: Some(first_node + bodies.len()),
            position: body.position,
        };
        let stiffness = springs::matrix(&r, MatrixKind::Stiffness, true);
        let damping = springs::matrix(&r, MatrixKind::Damping, true);
        if let Some(base) = base {
            bushings.push(Bushing {
                name: format!("housing.{name}"),
                a: own.anchor_at(body.position),
                b: base.anchor_at(body.position),
                stiffness,
                damping,
            });
        }
        places.add(own.name, first_node + bodies.len(), body.position);
        bodies.push(body);
        r.finish();
    }
    Bodies { bodies, bushings }
}

fn body(name: &str, r: &Reader, places: &Places) -> RigidBody {
    let position = match r.one_of(&["station", "position"]) {
        Some("station") => {
            let (_, z) = places.station(r, "station");
            let offset = r.vector("offset", LENGTH).unwrap_or_default();
            [offset[0], offset[1], z + offset[2]]
        }
        Some(_) => r.vector("position", LENGTH).unwrap_or_default(),
        None => {
            r.missing("station", "\"A\" or position = \"0, -230, 270 mm\"");
            [0.0; 3]
        }
    };
    let mass = r.need("mass", positive(MASS));
    let moments = r.need_list("inertia", any(INERTIA));
    let products = r.list("inertia_products", any(INERTIA)).unwrap_or_else(|| vec![0.0; 3]);
    let [xx, yy, zz] = match moments[..] {
        [all] => [all; 3],
        [xx, yy, zz] => [xx, yy, zz],
        _ => {
            r.error(
                Kind::WrongType,
                "inertia",
                format!("{} is one value or three (x, y, z)", r.name("inertia")),
            );
            [1.0; 3]
        }
    };
    let [xy, yz, zx] = match products[..] {
        [xy, yz, zx] => [xy, yz, zx],
        _ => {
            let message = format!("{} has three values: xy, yz, zx", r.name("inertia_products"));
            r.error(Kind::WrongType, "inertia_products", message);
            [0.0; 3]
        }
    };
    let inertia = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let minor = xx * yy - xy * xy;
    let determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    if !(xx > 0.0 && minor > 0.0 && determinant > 0.0) && r.has_no_errors() {
        let message = format!("{} is not positive definite", r.name("inertia"));
        let problem = Problem::new(Kind::OutOfRange, &r.span_of("inertia"), message);
        r.log.error(problem.expected("moments of inertia greater than zero"));
    }
    RigidBody { name: name.into(), position, mass, inertia }
}

/// `[sensor.x]`: point masses.
pub(super) fn masses(top: &Reader, places: &Places) -> Vec<PointMass> {
    let read = |(name, r): (&str, Reader)| {
        let mass =
            PointMass { name: name.into(), anchor: places.anchor(&r), mass: r.need("mass", positive(MASS)) };
        if mass.anchor.node.is_none() && r.has_no_errors() {
            r.error(Kind::Conflict, "at", format!("{} is on ground, where it has no effect", r.path));
        }
        r.finish();
        mass
    };
    top.items("sensor").into_iter().map(read).collect()
}
