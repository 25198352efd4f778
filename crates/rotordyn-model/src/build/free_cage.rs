//! Cage of a bearing with free balls: mass, pockets, guidance.

use super::material::material;
use crate::file::diagnostic::Kind;
use crate::file::key::{
    Declared, Quantity, SubTable, Text, Words, keys, not_negative, positive, quantity, sub_table, text, words,
};
use crate::file::quantities::declared_default;
use crate::file::reader::Reader;
use rotordyn_bearing::contact::{Race, Traction};
use rotordyn_bearing::free_ball::{FreeCage, Guidance, Land, Pocket, PointContactLaw, pocket_stiffness};
use rotordyn_bearing::{BallBearing, BallGeometry};
use rotordyn_core::element::Material;
use rotordyn_units::{INERTIA, INVERSE_SPEED, LENGTH, MASS, NUMBER, STIFFNESS, VELOCITY};

/// Thickness and width of a cage whose mass is not given, over the ball diameter: a pressed steel cage.
const THICKNESS: f64 = 0.125;
const WIDTH: f64 = 1.4;
/// Radial clearance of a guided cage if none is given, over its land's radius.
const GUIDANCE_CLEARANCE: f64 = 5e-3;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PocketKeyword {
    Cylindrical,
    Spherical,
    Closed,
}

keys! {
    /// Of `model = "free_ball"`.
    pub(super) static FREE_CAGE: FreeCageKeys {
        free_cage: SubTable = sub_table(CageBodyKeys::TABLE);
    }
}

keys! {
    /// `free_cage = { ... }`.
    static CAGE_BODY: CageBodyKeys = "The cage as a free body; without this table a pressed steel cage guided by the balls." {
        mass: Quantity = quantity(positive(MASS), "Mass.").computed("of a plain ring").example("\"12 g\"");
        polar_inertia: Quantity = quantity(positive(INERTIA), "Moment of inertia about its axis.")
            .computed("of a plain ring").example("\"4e-6 kg m^2\"");
        transverse_inertia: Quantity = quantity(positive(INERTIA), "Moment of inertia about a diameter.")
            .computed("of a plain ring").example("\"2e-6 kg m^2\"");
        material: Text = text("name of a material", "Material of the ring, for its mass and the contact of its pockets.")
            .computed("that of the rings").example("\"steel\"");
        thickness: Quantity = quantity(positive(LENGTH), "Radial thickness of the ring about the pitch circle.")
            .computed("0.125 D_w").example("\"1 mm\"");
        width: Quantity = quantity(positive(LENGTH), "Width of the ring.").computed("1.4 D_w").example("\"11 mm\"");
        pocket: Words<PocketKeyword> = words(&[
            ("spherical", PocketKeyword::Spherical),
            ("cylindrical", PocketKeyword::Cylindrical),
            ("closed", PocketKeyword::Closed),
        ], "Shape of the pockets; cylindrical ones, with radial axes, do not centre a cage, closed ones end radially.")
            .default("spherical");
        radial_clearance: Quantity = quantity(positive(LENGTH), "Radial clearance of a ball in a closed pocket.")
            .computed("half of cage_pocket_diameter less D_w").example("\"0.1 mm\"").with("pocket = \"closed\"");
        friction: Quantity = quantity(not_negative(NUMBER), "Coefficient of friction in pockets and on lands.").default("0.1");
        slip_speed: Quantity = quantity(positive(VELOCITY), "Slip up to which this friction is proportional to slip.")
            .default("50 mm/s");
        hunt_crossley: Quantity = quantity(not_negative(INVERSE_SPEED), "Damping by Hunt and Crossley in pockets and on lands.")
            .default("1 s/m");
        guidance: Words<Option<Race>> = words(&[
            ("balls", None),
            ("inner_land", Some(Race::Inner)),
            ("outer_land", Some(Race::Outer)),
        ], "What keeps the cage in place: the balls in its pockets, or a land of a ring.").default("balls");
        guidance_clearance: Quantity = quantity(positive(LENGTH), "Radial clearance of the centred cage on its land.")
            .computed("0.5 % of the land's radius").example("\"0.1 mm\"").with("guidance = \"outer_land\"");
        guidance_diameter: Quantity = quantity(positive(LENGTH), "Diameter of the land.")
            .computed("that of the ring's shoulder, 0.2 D_w above the groove's bottom").example("\"43 mm\"")
            .with("guidance = \"outer_land\"");
        guidance_stiffness: Quantity = quantity(positive(STIFFNESS), "Stiffness of each edge on the land.")
            .default("1e7 N/m").with("guidance = \"outer_land\"");
    }
}

/// Shoulder of a ring above the bottom of its groove, over the ball diameter.
const SHOULDER: f64 = 0.2;

/// The cage of a bearing; `None` for a full complement of balls.
pub(super) fn read(
    r: &Reader,
    bearing: &BallBearing,
    materials: &[Material],
    present: bool,
) -> Option<FreeCage> {
    let given = r.table(&FREE_CAGE.free_cage);
    if !present {
        if given.is_some() {
            let key = &FREE_CAGE.free_cage;
            r.error(Kind::Conflict, key, format!("{} does not go with full_complement = true", r.name(key)));
        }
        if let Some(table) = given {
            table.entries();
        }
        return None;
    }
    let keys = &CAGE_BODY;
    let g = &bearing.geometry;
    let get = |key| given.as_ref().and_then(|table| table.get(key));
    let own = given.as_ref().filter(|table| table.has(&keys.material));
    let steel = own.and_then(|table| material(table, &keys.material, materials));
    let substance = steel.unwrap_or_else(|| bearing.ring_material.clone());
    let thickness = get(&keys.thickness).unwrap_or(THICKNESS * g.ball_diameter);
    let width = get(&keys.width).unwrap_or(WIDTH * g.ball_diameter);
    let radii = [-0.5, 0.5].map(|side| 0.5 * g.pitch_diameter + side * thickness);
    let [ring_mass, ring_polar, ring_transverse] = FreeCage::ring_inertia(substance.density, radii, width);
    let mass = get(&keys.mass).unwrap_or(ring_mass);
    let scale = mass / ring_mass.max(f64::MIN_POSITIVE);
    let value = |key| given.as_ref().map_or_else(|| declared_default(key), |table| table.value(key));
    let friction = Traction { friction: value(&keys.friction), slip_speed: value(&keys.slip_speed) };
    let damping = value(&keys.hunt_crossley);
    let keyword = given.as_ref().map_or(keys.pocket.default_word(), |table| table.word(&keys.pocket));
    let radial_clearance =
        get(&keys.radial_clearance).unwrap_or(0.5 * (bearing.cage_pocket_diameter - g.ball_diameter));
    let pocket = match keyword {
        PocketKeyword::Cylindrical => Pocket::Cylindrical,
        PocketKeyword::Spherical => Pocket::Spherical,
        PocketKeyword::Closed => Pocket::Closed { radial_clearance },
    };
    let race = given.as_ref().map_or(keys.guidance.default_word(), |table| table.word(&keys.guidance));
    if let Some(table) = &given {
        let foreign = |key: &dyn Declared, applies: bool, owner: &str| {
            if table.has(key) && !applies {
                table.error(Kind::Conflict, key, format!("{} belongs to {owner}", table.name(key)));
            }
        };
        foreign(&keys.radial_clearance, keyword == PocketKeyword::Closed, "pocket = \"closed\"");
        let land = "guidance = \"inner_land\" or \"outer_land\"";
        for key in [&keys.guidance_clearance, &keys.guidance_diameter, &keys.guidance_stiffness] {
            foreign(key, race.is_some(), land);
        }
    }
    let guidance = race.map_or(Guidance::Balls, |race| {
        let radius = get(&keys.guidance_diameter).map_or_else(|| shoulder_radius(g, race), |d| 0.5 * d);
        Guidance::Land(Land {
            race,
            radius,
            clearance: get(&keys.guidance_clearance).unwrap_or(GUIDANCE_CLEARANCE * radius),
            width,
            contact: PointContactLaw { stiffness: value(&keys.guidance_stiffness), damping, friction },
        })
    });
    let stiffness = pocket_stiffness(
        pocket,
        g.ball_diameter,
        bearing.cage_pocket_diameter,
        [&bearing.ball_material, &substance],
    );
    let out = FreeCage {
        mass,
        polar_inertia: get(&keys.polar_inertia).unwrap_or(ring_polar * scale),
        transverse_inertia: get(&keys.transverse_inertia).unwrap_or(ring_transverse * scale),
        pocket,
        pocket_diameter: bearing.cage_pocket_diameter,
        pocket_contact: PointContactLaw { stiffness, damping, friction },
        guidance,
    };
    if let Some(table) = given {
        if table.has(&keys.thickness) && table.has_no_errors() {
            let [inside, outside] = radii;
            let into_inner = shoulder_radius(g, Race::Inner) - inside;
            let into_outer = outside - shoulder_radius(g, Race::Outer);
            for (depth, ring) in
                [(into_inner, "inner"), (into_outer, "outer")].into_iter().filter(|(d, _)| *d > 0.0)
            {
                let message = format!(
                    "{} puts the cage {:.4} mm into the shoulder of the {ring} ring",
                    table.name(&keys.thickness),
                    1e3 * depth
                );
                table.error(Kind::OutOfRange, &keys.thickness, message);
            }
        }
        table.finish();
    }
    Some(out)
}

/// Radius of a ring's shoulder \[m\].
fn shoulder_radius(g: &BallGeometry, race: Race) -> f64 {
    let away = if race == Race::Inner { SHOULDER } else { -SHOULDER };
    0.5 * g.groove_bottom_diameter(race) + away * g.ball_diameter
}
