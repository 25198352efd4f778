//! `[rotor]`: a rigid rotor instead of a flexible shaft.

use super::material;
use super::shaft::{self, MeshedShaft};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Quantity, SubTable, Text, any, keys, not_negative, positive, quantity, sub_table, text,
};
use crate::file::reader::Reader;
use rotordyn_core::element::{Disc, Material};
use rotordyn_units::{INERTIA, LENGTH, MASS};
use std::f64::consts::PI;

keys! {
    /// Tables of this file.
    pub(super) static TOP: TopKeys {
        rotor: SubTable = sub_table(RotorKeys::TABLE);
    }
}

keys! {
    /// `[rotor]`.
    static ROTOR: RotorKeys = "A rigid rotor instead of a flexible shaft: by mass and inertia, or a cylinder." {
        centre: Quantity = quantity(any(LENGTH), "Position of the centre of mass along z.");
        length: Quantity = quantity(positive(LENGTH), "Length of the cylinder; the stations lie on it.")
            .required("without inertia");
        outer_diameter: Quantity = quantity(positive(LENGTH), "Diameter of the cylinder.").required("without inertia");
        inner_diameter: Quantity = quantity(not_negative(LENGTH), "Diameter of its bore.").default("0 mm")
            .example("\"20 mm\"");
        material: Text = text("name of a material", "Material of the cylinder; or give its mass.")
            .computed("the only material of the file").example("\"steel\"");
        mass: Quantity = quantity(positive(MASS), "Mass.").required("with inertia");
        polar_inertia: Quantity = quantity(not_negative(INERTIA), "Moment of inertia about z.")
            .required("or length and outer_diameter").example("\"0.001 kg m^2\"");
        diametral_inertia: Quantity = quantity(positive(INERTIA), "Moment of inertia about x and y.")
            .required("with polar_inertia").example("\"0.001 kg m^2\"");
        minimum_spacing: Quantity = quantity(positive(LENGTH), "Smallest distance of two stations.")
            .default("100 um");
    }
}

/// Stations closer than this to the centre of mass share its node \[m\].
const POSITION_TOLERANCE: f64 = 1e-9;

/// Nodes at the centre of mass and at every station.
pub(super) fn read(top: &Reader, materials: &[Material]) -> MeshedShaft {
    let r = top.table_or_empty(&TOP.rotor);
    if top.has(&shaft::TOP.shaft) {
        let problem = Problem::new(Kind::Conflict, &r.span, "rotor and shaft are mutually exclusive");
        top.log.error(problem.hint("use [shaft] for a flexible shaft, [rotor] for a rigid rotor"));
        top.table(&shaft::TOP.shaft).inspect(|s| _ = s.entries());
    }
    let centre = r.value(&ROTOR.centre);
    let spacing = r.value(&ROTOR.minimum_spacing);
    let length = r.get(&ROTOR.length);
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
        outer_diameter: r.or(&ROTOR.outer_diameter, 0.0),
        thickness: length.unwrap_or(0.0),
    };
    let inner = r.value(&ROTOR.inner_diameter);
    let outer = rotor.outer_diameter;
    if outer > 0.0 && inner >= outer {
        let message = format!("{} is not less than the outer diameter", r.name(&ROTOR.inner_diameter));
        r.error(Kind::Geometry, &ROTOR.inner_diameter, message);
    }
    if r.has(&ROTOR.polar_inertia) || r.has(&ROTOR.diametral_inertia) {
        rotor.mass = r.value(&ROTOR.mass);
        rotor.polar_inertia = r.value(&ROTOR.polar_inertia);
        rotor.diametral_inertia = r.value(&ROTOR.diametral_inertia);
        // holds for any rigid body, see the discs
        if rotor.polar_inertia > 2.0 * rotor.diametral_inertia * (1.0 + 1e-9) && r.has_no_errors() {
            let message = format!(
                "{} is more than twice the diametral inertia, which is impossible",
                r.name(&ROTOR.polar_inertia)
            );
            r.error(Kind::OutOfRange, &ROTOR.polar_inertia, message);
        }
        return rotor;
    }
    if !r.has(&ROTOR.length) && !r.has(&ROTOR.outer_diameter) {
        r.missing_or(&ROTOR.polar_inertia, " and diametral_inertia, or length and outer_diameter");
        r.has(&ROTOR.mass);
        r.has(&ROTOR.material);
        return rotor;
    }
    let (length, outer) = (r.value(&ROTOR.length), r.value(&ROTOR.outer_diameter));
    rotor.mass = match r.one_of(&[&ROTOR.mass, &ROTOR.material]) {
        Some(given) if given.is(&ROTOR.mass) => r.value(&ROTOR.mass),
        _ => {
            let density = material(r, &ROTOR.material, materials).map_or(1.0, |m| m.density);
            density * PI / 4.0 * (outer * outer - inner * inner) * length
        }
    };
    rotor.polar_inertia = rotor.mass * (outer * outer + inner * inner) / 8.0;
    rotor.diametral_inertia = 0.5 * rotor.polar_inertia + rotor.mass * length * length / 12.0;
    rotor
}
