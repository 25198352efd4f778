//! Bushings, joints and belts.

use super::places::{BetweenKeys, Places};
use super::springs::{
    DOFS, MatrixKeys, PASSIVE_DAMPING, PASSIVE_DAMPING_LIST, PASSIVE_STIFFNESS, PASSIVE_STIFFNESS_LIST,
};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Flag, Group, NamedTables, Quantities, Quantity, Table, Text, Texts, Words, any, flag, keys, named_tables,
    not_negative, quantities, quantity, text, texts, words,
};
use crate::file::reader::Reader;
use rotordyn_core::element::{Anchor, Belt, Bushing, Joint};
use rotordyn_units::{DAMPING, FORCE, STIFFNESS, TILT_DAMPING, TILT_STIFFNESS};

keys! {
    /// Tables of this file.
    pub(super) static TOP: TopKeys {
        bushing: NamedTables = named_tables(&BUSHING);
        joint: NamedTables = named_tables(&JOINT);
        belt: NamedTables = named_tables(BeltKeys::TABLE);
    }
}

static BUSHING: Table = Table {
    meaning: "Springs and dampers between two places.",
    groups: &[
        Group::always(BetweenKeys::LIST),
        Group::always(BushingKeys::LIST),
        Group::always(&PASSIVE_STIFFNESS_LIST),
        Group::always(&PASSIVE_DAMPING_LIST),
        Group::always(MatrixKeys::LIST),
    ],
};

static JOINT: Table = Table {
    meaning: "An exact constraint between two places.",
    groups: &[Group::always(BetweenKeys::LIST), Group::always(JointKeys::LIST)],
};

keys! {
    /// Of `[bushing.x]`.
    static OWN: BushingKeys {
        unsymmetric: Flag = flag("Whether unsymmetric matrices are accepted, which may bring in energy, as those of fluid films.")
            .default("false");
        lever_arms: Flag = flag("Whether it acts at one point, with lever arms to both places; otherwise on their displacements, \
            as a coupling without length.").default("true");
    }
}

keys! {
    /// `[joint.x]`.
    static CONSTRAINT: JointKeys {
        kind: Words<[bool; 6]> = words(KINDS, "Constrained DOFs by the kind of joint.").required("or constrain");
        axial: Words<bool> = words(&[("fixed", true), ("free", false)], "Overrides the constraint along z, of any kind.")
            .computed("by kind").with("kind = \"spherical\"");
        constrain: Texts = texts("some of x, y, z, tx, ty, tz", "Constrained DOFs one by one.").required("or kind")
            .example("[\"z\", \"tx\", \"ty\"]");
    }
}

keys! {
    /// `[belt.x]`.
    static BELT: BeltKeys = "A belt on the shaft, to ground." {
        station: Text = text("name of a station", "Where it runs.").example("\"A\"");
        pull: Quantities = quantities(any(FORCE), "two: x, y", "Static force on the shaft.").default("0, 0 N")
            .example("\"0, -120 N\"");
        constant_pull: Flag = flag("Pull is that of the machine at rest; otherwise of the undeflected shaft.")
            .default("false");
        k_x: Quantity = quantity(not_negative(STIFFNESS), "Stiffness along x.").default("0 N/m");
        k_y: Quantity = quantity(not_negative(STIFFNESS), "Stiffness along y.").default("0 N/m");
        k_spin: Quantity = quantity(not_negative(TILT_STIFFNESS), "Stiffness of rotation about z.")
            .default("0 N m/rad");
        c_x: Quantity = quantity(not_negative(DAMPING), "Damping along x.").default("0 N s/m");
        c_y: Quantity = quantity(not_negative(DAMPING), "Damping along y.").default("0 N s/m");
        c_spin: Quantity = quantity(not_negative(TILT_DAMPING), "Damping of rotation about z.")
            .default("0 N m s/rad");
    }
}

pub(super) fn bushings(top: &Reader, places: &Places) -> Vec<Bushing> {
    let read = |(name, r): (&str, Reader)| {
        let [mut a, mut b] = places.between(&r);
        if !r.flag(&OWN.lever_arms) {
            [a, b] = [a, b].map(|end| Anchor { offset: [0.0; 3], ..end });
        }
        let passive = !r.flag(&OWN.unsymmetric);
        let stiffness = PASSIVE_STIFFNESS.matrix_of(&r, passive);
        let damping = PASSIVE_DAMPING.matrix_of(&r, passive);
        if r.has_no_errors() && stiffness.iter().chain(&damping).flatten().all(|&v| v == 0.0) {
            r.missing_or(PASSIVE_STIFFNESS.diagonal(0), " or another component of stiffness or damping");
        }
        r.finish();
        Bushing { name: name.into(), a, b, stiffness, damping }
    };
    top.items(&TOP.bushing).into_iter().map(read).collect()
}

const SPHERICAL: [bool; 6] = [true, true, true, false, false, false];
const CYLINDRICAL: [bool; 6] = [true, true, false, true, true, false];
const REVOLUTE: [bool; 6] = [true, true, true, true, true, false];
const FIXED: [bool; 6] = [true; 6];
const KINDS: &[(&str, [bool; 6])] =
    &[("spherical", SPHERICAL), ("cylindrical", CYLINDRICAL), ("revolute", REVOLUTE), ("fixed", FIXED)];

/// Joints by kind, or by their constrained DOFs.
pub(super) fn joints(top: &Reader, places: &Places) -> Vec<Joint> {
    let read = |(name, r): (&str, Reader)| {
        let [a, b] = places.between(&r);
        let locked = match r.one_of(&[&CONSTRAINT.kind, &CONSTRAINT.constrain]) {
            Some(given) if given.is(&CONSTRAINT.constrain) => constrained_dofs(&r),
            _ => constrained_by_kind(&r),
        };
        r.finish();
        Joint { name: name.into(), a, b, locked }
    };
    top.items(&TOP.joint).into_iter().map(read).collect()
}

/// Constrained DOFs of a `kind`; `axial = "free"` or `"fixed"` overrides its constraint along z.
fn constrained_by_kind(r: &Reader) -> [bool; 6] {
    if !r.has(&CONSTRAINT.kind) {
        r.missing_or(&CONSTRAINT.kind, ", or constrain = [\"z\", \"tx\", \"ty\"]");
    }
    let mut locked = r.choice(&CONSTRAINT.kind).unwrap_or(FIXED);
    if let Some(constrained) = r.choice(&CONSTRAINT.axial) {
        locked[2] = constrained;
    }
    locked
}

/// Constrained DOFs as listed, e.g. `constrain = ["z", "tx", "ty"]` for planar motion.
fn constrained_dofs(r: &Reader) -> [bool; 6] {
    let mut locked = [false; 6];
    for (motion, span) in r.texts(&CONSTRAINT.constrain).unwrap_or_default() {
        match DOFS.iter().position(|m| *m == motion) {
            Some(k) if locked[k] => {
                let message = format!("{} names {motion} twice", r.name(&CONSTRAINT.constrain));
                r.log.error(Problem::new(Kind::Conflict, &span, message));
            }
            Some(k) => locked[k] = true,
            None => {
                let message = format!("`{motion}` is not a degree of freedom");
                let problem = Problem::new(Kind::UnknownName, &span, message);
                r.log.error(problem.expected("x, y, z (translations), tx, ty or tz (rotations)"));
            }
        }
    }
    if r.has_no_errors() && locked == [false; 6] {
        r.error(
            Kind::OutOfRange,
            &CONSTRAINT.constrain,
            format!("{} constrains no degree of freedom", r.name(&CONSTRAINT.constrain)),
        );
    }
    locked
}

pub(super) fn belts(top: &Reader, places: &Places) -> Vec<Belt> {
    let read = |(name, r): (&str, Reader)| {
        let (node, _) = places.station(&r, &BELT.station);
        let pull = match r.list(&BELT.pull).as_deref() {
            None => [0.0; 2],
            Some(&[x, y]) => [x, y],
            Some(_) => {
                let message = format!("{} has two components, x and y", r.name(&BELT.pull));
                r.error(Kind::WrongType, &BELT.pull, message);
                [0.0; 2]
            }
        };
        let belt = Belt {
            name: name.into(),
            node,
            pull,
            constant_pull: r.flag(&BELT.constant_pull),
            stiffness: [&BELT.k_x, &BELT.k_y, &BELT.k_spin].map(|key| r.value(key)),
            damping: [&BELT.c_x, &BELT.c_y, &BELT.c_spin].map(|key| r.value(key)),
        };
        r.finish();
        belt
    };
    top.items(&TOP.belt).into_iter().map(read).collect()
}
