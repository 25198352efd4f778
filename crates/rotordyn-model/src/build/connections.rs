//! Bushings, joints and belts.

use super::places::Places;
use super::springs::{self, DOFS, MatrixKind};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative};
use rotordyn_core::element::{Belt, Bushing, Joint};
use rotordyn_units::{DAMPING, FORCE, STIFFNESS, TILT_DAMPING, TILT_STIFFNESS};

pub(super) fn bushings(top: &Reader, places: &Places) -> Vec<Bushing> {
    let read = |(name, r): (&str, Reader)| {
        let [a, b] = places.between(&r);
        let stiffness = springs::matrix(&r, MatrixKind::Stiffness, true);
        let damping = springs::matrix(&r, MatrixKind::Damping, true);
        if r.has_no_errors() && stiffness.iter().chain(&damping).flatten().all(|&v| v == 0.0) {
            r.missing("k_x", "\"1e6 N/m\" or another component of stiffness or damping");
        }
        r.finish();
        Bushing { name: name.into(), a, b, stiffness, damping }
    };
    top.items("bushing").into_iter().map(read).collect()
}

const SPHERICAL: [bool; 6] = [true, true, true, false, false, false];
const CYLINDRICAL: [bool; 6] = [true, true, false, true, true, false];
const REVOLUTE: [bool; 6] = [true, true, true, true, true, false];
const FIXED: [bool; 6] = [true; 6];

/// Joints by kind, or by their constrained DOFs.
pub(super) fn joints(top: &Reader, places: &Places) -> Vec<Joint> {
    let read = |(name, r): (&str, Reader)| {
        let [a, b] = places.between(&r);
        let locked = match r.one_of(&["kind", "constrain"]) {
            Some("constrain") => constrained_dofs(&r),
            _ => constrained_by_kind(&r),
        };
        r.finish();
        Joint { name: name.into(), a, b, locked }
    };
    top.items("joint").into_iter().map(read).collect()
}

/// Constrained DOFs of a `kind`; `axial = "free"` or `"fixed"` overrides its constraint along z.
fn constrained_by_kind(r: &Reader) -> [bool; 6] {
    let kinds =
        [("spherical", SPHERICAL), ("cylindrical", CYLINDRICAL), ("revolute", REVOLUTE), ("fixed", FIXED)];
    if !r.has("kind") {
        r.missing("kind", "\"spherical\", or constrain = [\"z\", \"tx\", \"ty\"]");
    }
    let mut locked = r.choice("kind", &kinds).unwrap_or(FIXED);
    if let Some(constrained) = r.choice("axial", &[("fixed", true), ("free", false)]) {
        locked[2] = constrained;
    }
    locked
}

/// Constrained DOFs as listed, e.g. `constrain = ["z", "tx", "ty"]` for planar motion.
fn constrained_dofs(r: &Reader) -> [bool; 6] {
    let mut locked = [false; 6];
    for (motion, span) in r.texts("constrain").unwrap_or_default() {
        match DOFS.iter().position(|m| *m == motion) {
            Some(k) if locked[k] => {
                let message = format!("{} names {motion} twice", r.name("constrain"));
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
            "constrain",
            format!("{} constrains no degree of freedom", r.name("constrain")),
        );
    }
    locked
}

pub(super) fn belts(top: &Reader, places: &Places) -> Vec<Belt> {
    let read = |(name, r): (&str, Reader)| {
        let (node, _) = places.station(&r, "station");
        let pull = match r.list("pull", any(FORCE)).as_deref() {
            None => [0.0; 2],
            Some(&[x, y]) => [x, y],
            Some(_) => {
                r.error(Kind::WrongType, "pull", format!("{} has two components, x and y", r.name("pull")));
                [0.0; 2]
            }
        };
        let k = |key| r.or(key, not_negative(STIFFNESS), 0.0);
        let c = |key| r.or(key, not_negative(DAMPING), 0.0);
        let belt = Belt {
            name: name.into(),
            node,
            pull,
            constant_pull: r.flag("constant_pull", false),
            stiffness: [k("k_x"), k("k_y"), r.or("k_spin", not_negative(TILT_STIFFNESS), 0.0)],
            damping: [c("c_x"), c("c_y"), r.or("c_spin", not_negative(TILT_DAMPING), 0.0)],
        };
        r.finish();
        belt
    };
    top.items("belt").into_iter().map(read).collect()
}
