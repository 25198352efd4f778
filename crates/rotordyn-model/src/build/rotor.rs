//! `[rotor]`: a rigid rotor instead of a flexible shaft.

use super::material;
use super::shaft::{self, MeshedShaft};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative, positive};
use rotordyn_core::element::{Disc, Material};
use rotordyn_units::{INERTIA, LENGTH, MASS};
use std::f64::consts::PI;

/// Stations closer than this to the centre of mass share its node \[m\].
const POSITION_TOLERANCE: f64 = 1e-9;

/// Nodes at the centre of mass and at every station.
pub(super) fn read(top: &Reader, materials: &[Material]) -> MeshedShaft {
    let r = top.table_or_empty("rotor");
    if top.has("shaft") {
        let problem = Problem::new(Kind::Conflict, &r.span, "rotor and shaft are mutually exclusive");
        top.log.error(problem.hint("use [shaft] for a flexible shaft, [rotor] for a rigid rotor"));
        top.table("shaft").inspect(|s| _ = s.entries());
    }
    let centre = r.need("centre", any(LENGTH));
    let spacing = r.or("minimum_spacing", positive(LENGTH), 1e-4);
    let length = r.get("length", positive(LENGTH));
    let mut rotor = inertia(&r, length, materials);
    let ends = length.map(|l| [centre - 0.5 * l, centre + 0.5 * l]);
    let sound = r.has_no_errors();
    r.finish();
    let mut stations = shaft::stations(top, if sound { ends } else { None }, spacing);
    let mut node_z: Vec<f64> = stations.iter().map(|s| s.z).collect();
    if node_z.iter().all(|z| (z - centre).abs() > POSITION_TOLERANCE) {
        node_z.push(centre);
    }
    node_z.sort_by(f64::total_cmp);
    let node_at = |z: f64| {
        let distance = |k: &usize| (node_z[*k] - z).abs();
        (0..node_z.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
    };
    for station in &mut stations {
        station.node = node_at(station.z);
    }
    rotor.node = node_at(centre);
    MeshedShaft { node_z, elements: Vec::new(), stations, rigid_rotor: Some(rotor) }
}

/// Rotor by mass and moments of inertia about the centre of mass, or as a cylinder:
/// I_p = m (D² + d²)/8, I_d = I_p/2 + m L²/12.
fn inertia(r: &Reader, length: Option<f64>, materials: &[Material]) -> Disc {
    let mut rotor = Disc {
        name: "rotor".into(),
        node: 0,
        mass: 1.0,
        polar_inertia: 0.0,
        diametral_inertia: 0.0,
        outer_diameter: r.or("outer_diameter", positive(LENGTH), 0.0),
        thickness: length.unwrap_or(0.0),
    };
    let inner = r.or("inner_diameter", not_negative(LENGTH), 0.0);
    let outer = rotor.outer_diameter;
    if outer > 0.0 && inner >= outer {
        let message = format!("{} is not less than the outer diameter", r.name("inner_diameter"));
        r.error(Kind::Geometry, "inner_diameter", message);
    }
    if r.has("polar_inertia") || r.has("diametral_inertia") {
        rotor.mass = r.need("mass", positive(MASS));
        rotor.polar_inertia = r.need("polar_inertia", not_negative(INERTIA));
        rotor.diametral_inertia = r.need("diametral_inertia", positive(INERTIA));
        // holds for any rigid body, see the discs
        if rotor.polar_inertia > 2.0 * rotor.diametral_inertia * (1.0 + 1e-9) && r.has_no_errors() {
            let message = format!(
                "{} is more than twice the diametral inertia, which is impossible",
                r.name("polar_inertia")
            );
            r.error(Kind::OutOfRange, "polar_inertia", message);
        }
        return rotor;
    }
    if !r.has("length") && !r.has("outer_diameter") {
        r.missing("polar_inertia", "\"0.001 kg m^2\" and diametral_inertia, or length and outer_diameter");
        r.has("mass");
        r.has("material");
        return rotor;
    }
    let (length, outer) = (r.need("length", positive(LENGTH)), r.need("outer_diameter", positive(LENGTH)));
    rotor.mass = match r.one_of(&["mass", "material"]) {
        Some("mass") => r.need("mass", positive(MASS)),
        _ => {
            let density = material(r, "material", materials).map_or(1.0, |m| m.density);
            density * PI / 4.0 * (outer * outer - inner * inner) * length
        }
    };
    rotor.polar_inertia = rotor.mass * (outer * outer + inner * inner) / 8.0;
    rotor.diametral_inertia = 0.5 * rotor.polar_inertia + rotor.mass * length * length / 12.0;
    rotor
}
