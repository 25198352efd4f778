//! Discs, rigid bodies, housings and sensors.

use super::material;
use super::places::{ANCHOR, AnchorKeys, Place, Places};
use super::springs::{
    MATRICES, MatrixKeys, PASSIVE_DAMPING, PASSIVE_DAMPING_LIST, PASSIVE_STIFFNESS, PASSIVE_STIFFNESS_LIST,
};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Group, Key, NamedTables, Quantities, Quantity, Table, Text, any, keys, named_tables, not_negative,
    positive, quantities, quantity, text,
};
use crate::file::reader::Reader;
use rotordyn_core::element::{Bushing, Disc, Material, PointMass, RigidBody};
use rotordyn_units::{INERTIA, LENGTH, MASS};
use std::f64::consts::PI;

keys! {
    /// Tables of this file.
    pub(super) static TOP: TopKeys {
        disc: NamedTables = named_tables(DiscKeys::TABLE);
        body: NamedTables = named_tables(&BODY_TABLE);
        housing: NamedTables = named_tables(&HOUSING_TABLE);
        sensor: NamedTables = named_tables(&SENSOR_TABLE);
    }
}

keys! {
    /// `[disc.x]`.
    pub(super) static DISC: DiscKeys = "A disc on the shaft, by its dimensions or by its mass." {
        station: Text = text("name of a station", "Where it sits.").example("\"A\"");
        outer_diameter: Quantity = quantity(positive(LENGTH), "Outer diameter; with a mass only for pictures.")
            .required("without mass");
        inner_diameter: Quantity = quantity(not_negative(LENGTH), "Diameter of the bore.").default("0 mm")
            .example("\"20 mm\"");
        thickness: Quantity = quantity(positive(LENGTH), "Length along the shaft; with a mass only for pictures.")
            .required("without mass");
        material: Text = text("name of a material", "Material of a disc by dimensions.")
            .computed("the only material of the file").example("\"steel\"");
        mass: Quantity = quantity(positive(MASS), "Mass, instead of dimensions and material.").required("with inertia");
        polar_inertia: Quantity = quantity(not_negative(INERTIA), "Moment of inertia about z.").required("with mass");
        diametral_inertia: Quantity = quantity(not_negative(INERTIA), "Moment of inertia about x and y.")
            .required("with mass");
    }
}

keys! {
    /// Of `[body.x]` and `[housing.x]`.
    static BODY: BodyKeys {
        station: Text = text("name of a station", "Station at the centre of mass.").required("or position")
            .example("\"A\"");
        offset: Quantities = quantities(any(LENGTH), "three: x, y, z", "Distance of the centre of mass from the station.")
            .default("0, 0, 0 m").with("station = \"A\"").example("\"0, -60, 0 mm\"");
        position: Quantities = quantities(any(LENGTH), "three: x, y, z", "Position of the centre of mass.")
            .required("or station").example("\"0, -230, 270 mm\"");
        mass: Quantities = quantities(positive(MASS), "one, or three: x, y, z",
            "Mass; by axis for the modal mass of a support.").example("\"1.5 kg\"");
        inertia: Quantities = quantities(any(INERTIA), "one, or three: xx, yy, zz",
            "Moments of inertia about the centre of mass.");
        inertia_products: Quantities = quantities(any(INERTIA), "three: xy, yz, zx",
            "Off-diagonal elements of the inertia tensor.").default("0, 0, 0 kg m^2")
            .example("\"0, 0.0001, 0 kg m^2\"");
    }
}

keys! {
    /// Of `[housing.x]`.
    static HOUSING: HousingKeys {
        on: Text = text("ground or name of a body", "What its springs stand on.").default("ground");
    }
}

static BODY_TABLE: Table = Table { meaning: "A rigid body.", groups: &[Group::always(BodyKeys::LIST)] };

static HOUSING_TABLE: Table = Table {
    meaning: "A rigid body that holds a bearing, on springs: k_x, k_y, k_z, k_tilt and k_spin are required.",
    groups: &[
        Group::always(BodyKeys::LIST),
        Group::always(HousingKeys::LIST),
        Group::always(&PASSIVE_STIFFNESS_LIST),
        Group::always(&PASSIVE_DAMPING_LIST),
        Group::always(MatrixKeys::LIST),
    ],
};

keys! {
    /// Of `[sensor.x]`.
    static SENSOR: SensorKeys {
        mass: Quantities = quantities(not_negative(MASS), "one, or three: x, y, z",
            "Mass; by axis for the added mass of a seal or the like.").example("\"0.05 kg\"");
    }
}

static SENSOR_TABLE: Table = Table {
    meaning: "A point mass, such as an accelerometer or the added mass of a seal.",
    groups: &[Group::always(AnchorKeys::LIST), Group::always(SensorKeys::LIST)],
};

pub(super) fn discs(top: &Reader, materials: &[Material], places: &mut Places) -> Vec<Disc> {
    let mut discs = Vec::new();
    for (name, r) in top.items(&TOP.disc) {
        let (node, z) = places.station(&r, &DISC.station);
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
    let by_mass = r.has(&DISC.mass) || r.has(&DISC.polar_inertia) || r.has(&DISC.diametral_inertia);
    let (outer, thickness) = if by_mass {
        (r.or(&DISC.outer_diameter, 0.0), r.or(&DISC.thickness, 0.0))
    } else {
        (r.value(&DISC.outer_diameter), r.value(&DISC.thickness))
    };
    let inner = r.value(&DISC.inner_diameter);
    if (outer > 0.0 || !by_mass) && inner >= outer && r.has_no_errors() {
        let message = format!("{} is not less than the outer diameter", r.name(&DISC.inner_diameter));
        r.error(Kind::Geometry, &DISC.inner_diameter, message);
    }
    let (mass, polar, diametral) = if by_mass {
        if r.has(&DISC.material) {
            let message = format!("{} has no effect with a given mass", r.name(&DISC.material));
            r.error(Kind::Conflict, &DISC.material, message);
        }
        (r.value(&DISC.mass), r.value(&DISC.polar_inertia), r.value(&DISC.diametral_inertia))
    } else {
        let density = material(r, &DISC.material, materials).map_or(1.0, |m| m.density);
        let mass = density * PI / 4.0 * (outer * outer - inner * inner) * thickness;
        let polar = mass * (outer * outer + inner * inner) / 8.0;
        (mass, polar, polar / 2.0 + mass * thickness * thickness / 12.0)
    };
    // I_p = I_xx' + I_yy' of any mass distribution with I_d = I_xx' + m z² is at most 2 I_d
    if polar > 2.0 * diametral * (1.0 + 1e-9) && r.has_no_errors() {
        let message = format!(
            "{} is more than twice the diametral inertia, which is impossible",
            r.name(&DISC.polar_inertia)
        );
        r.error(Kind::OutOfRange, &DISC.polar_inertia, message);
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
    for (name, r) in top.items(&TOP.body) {
        let body = body(name, &r, places);
        places.add(format!("body.{name}"), first_node + bodies.len(), body.position);
        bodies.push(body);
        r.finish();
    }
    for (name, r) in top.items(&TOP.housing) {
        if bodies.iter().any(|b| b.name == name) {
            let message = format!("a body and a housing are both called `{name}`");
            r.log.error(Problem::new(Kind::Conflict, &r.span, message).hint("give one of them another name"));
        }
        let body = body(name, &r, places);
        let on = r.text(&HOUSING.on).unwrap_or_default();
        let base: Option<Place> = places.find(&r, on, &r.span_of(&HOUSING.on), &["ground", "body"]).cloned();
        let springs = &PASSIVE_STIFFNESS;
        let diagonal = |i: usize| r.has(springs.diagonal(i)) || r.has(springs.component(i, i));
        for (key, given) in [
            (springs.diagonal(0), diagonal(0)),
            (springs.diagonal(1), diagonal(1)),
            (springs.diagonal(2), diagonal(2)),
            (springs.tilts(), r.has(springs.tilts()) || diagonal(3) && diagonal(4)),
            (springs.diagonal(5), diagonal(5)),
        ] {
            if !given && !r.has(&MATRICES.stiffness_si) {
                r.missing(key);
            }
        }
        let own = Place {
            name: format!("housing.{name}"),
            node: Some(first_node + bodies.len()),
            position: body.position,
        };
        let stiffness = PASSIVE_STIFFNESS.matrix(&r);
        let damping = PASSIVE_DAMPING.matrix(&r);
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
    let position = match r.one_of(&[&BODY.station, &BODY.position]) {
        Some(given) if given.is(&BODY.station) => {
            let (_, z) = places.station(r, &BODY.station);
            let offset = r.vector(&BODY.offset).unwrap_or_default();
            [offset[0], offset[1], z + offset[2]]
        }
        Some(_) => r.vector(&BODY.position).unwrap_or_default(),
        None => {
            r.missing_or(&BODY.station, " or position = \"0, -230, 270 mm\"");
            [0.0; 3]
        }
    };
    let mass = axis_masses(r, &BODY.mass);
    let moments = r.need_list(&BODY.inertia);
    let products = r.list(&BODY.inertia_products).unwrap_or_else(|| vec![0.0; 3]);
    let [xx, yy, zz] = match moments[..] {
        [all] => [all; 3],
        [xx, yy, zz] => [xx, yy, zz],
        _ => {
            let message = format!("{} is one value or three (x, y, z)", r.name(&BODY.inertia));
            r.error(Kind::WrongType, &BODY.inertia, message);
            [1.0; 3]
        }
    };
    let [xy, yz, zx] = match products[..] {
        [xy, yz, zx] => [xy, yz, zx],
        _ => {
            let message = format!("{} has three values: xy, yz, zx", r.name(&BODY.inertia_products));
            r.error(Kind::WrongType, &BODY.inertia_products, message);
            [0.0; 3]
        }
    };
    let inertia = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
    let minor = xx * yy - xy * xy;
    let determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
    if !(xx > 0.0 && minor > 0.0 && determinant > 0.0) && r.has_no_errors() {
        let message = format!("{} is not positive definite", r.name(&BODY.inertia));
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(&BODY.inertia), message);
        r.log.error(problem.expected("moments of inertia greater than zero"));
    }
    RigidBody { name: name.into(), position, mass, inertia }
}

/// A mass along x, y and z: one value for all, or three.
fn axis_masses(r: &Reader, key: &Key<Quantities>) -> [f64; 3] {
    match r.need_list(key)[..] {
        [all] => [all; 3],
        [x, y, z] => [x, y, z],
        _ => {
            let message = format!("{} is one value or three (x, y, z)", r.name(key));
            r.error(Kind::WrongType, key, message);
            [1.0; 3]
        }
    }
}

/// `[sensor.x]`: point masses.
pub(super) fn masses(top: &Reader, places: &Places) -> Vec<PointMass> {
    let read = |(name, r): (&str, Reader)| {
        let mass = axis_masses(&r, &SENSOR.mass);
        let mass = PointMass { name: name.into(), anchor: places.anchor(&r), mass };
        if mass.mass == [0.0; 3] && r.has_no_errors() {
            let problem = Problem::new(
                Kind::OutOfRange,
                &r.span_of(&SENSOR.mass),
                format!("{} is zero", r.name(&SENSOR.mass)),
            );
            r.log.error(problem.expected("a mass greater than zero along one axis at least"));
        }
        if mass.anchor.node.is_none() && r.has_no_errors() {
            r.error(Kind::Conflict, &ANCHOR.at, format!("{} is on ground, where it has no effect", r.path));
        }
        r.finish();
        mass
    };
    top.items(&TOP.sensor).into_iter().map(read).collect()
}
