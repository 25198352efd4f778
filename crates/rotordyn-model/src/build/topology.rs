//! Connectivity check: every body must be connected to ground or to the shaft.

use super::{inertia, loading, rotor, shaft};
use crate::Model;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Key, NamedTables};
use crate::file::reader::Reader;
use rotordyn_core::element::{Anchor, Connection};
use rotordyn_core::warning::Code;

/// Report bodies without connection to the shaft or to ground, and warn of an unsupported (free-free) shaft.
pub(super) fn check(top: &Reader, model: &Model) {
    let first_body = model.node_z.len();
    // parts: 0 ground, 1 the shaft, 2.. bodies
    let part = |anchor: &Anchor| match anchor.node {
        None => 0,
        Some(node) if node < first_body => 1,
        Some(node) => 2 + node - first_body,
    };
    let mut links: Vec<(usize, usize)> = Vec::new();
    // A connection has stiffness: a bushing with damping only is no support.
    let connections: Vec<Connection> = model.elements().filter_map(|(_, e)| e.connection()).collect();
    links.extend(connections.iter().map(|c| (part(&c.ends[0]), part(&c.ends[1]))));
    links.extend(model.joints.iter().map(|j| (part(&j.a), part(&j.b))));
    links.extend(model.bearings.iter().map(|b| (1, part(&b.housing))));
    let reach = |start: &[usize]| {
        let mut reached = vec![false; 2 + model.bodies.len()];
        for &s in start {
            reached[s] = true;
        }
        while let Some(&(a, b)) = links.iter().find(|&&(a, b)| reached[a] != reached[b]) {
            reached[a] = true;
            reached[b] = true;
        }
        reached
    };
    let supported = reach(&[0, 1]);
    for (_, body) in model.bodies.iter().enumerate().filter(|(k, _)| !supported[2 + k]) {
        let of_kind = |key: &Key<NamedTables>| Some((key.about.name, top.item(key, &body.name)?.span));
        let found = of_kind(&inertia::TOP.body).or_else(|| of_kind(&inertia::TOP.housing));
        let (kind, span) = found.unwrap_or((inertia::TOP.body.about.name, 0..0));
        let message =
            format!("{kind} `{}` is disconnected: nothing connects it to ground or to the shaft", body.name);
        let hint =
            format!("add a [bushing.{}] between it and ground, a joint, or a bearing in it", body.name);
        top.log.error(Problem::new(Kind::Disconnected, &span, message).hint(hint));
    }
    if !reach(&[0])[1] {
        let span =
            top.table(&shaft::TOP.shaft).or_else(|| top.table(&rotor::TOP.rotor)).map_or(0..0, |r| r.span);
        let problem = Problem::new(
            Kind::Disconnected,
            &span,
            "the shaft has no support: it is free-free, with rigid body modes",
        );
        top.log.warn(
            Code::FreeMotion,
            "shaft",
            problem.hint("add a bearing, joint or bushing if this is not intended"),
        );
    }
    check_tilt_support(top, model);
}

/// Report every constant moment on a shaft with a single support that permits tilting, such as a ball joint.
fn check_tilt_support(top: &Reader, model: &Model) {
    let shaft = model.node_z.len();
    let shaft_node = |a: &Anchor, b: &Anchor| match [a.node, b.node].map(|n| n.filter(|&n| n < shaft)) {
        [Some(node), None] | [None, Some(node)] => Some(node),
        _ => None,
    };
    // (node, radial support, tilt support, name)
    let joints = model.joints.iter().filter_map(|j| {
        let holds = (j.locked[0] || j.locked[1], j.locked[3] && j.locked[4]);
        Some((shaft_node(&j.a, &j.b)?, holds, format!("joint.{}", j.name)))
    });
    let connections = model.elements().filter_map(|(_, element)| {
        let Connection { name, ends: [a, b], stiff: [x, y, _, tilt_x, tilt_y, _] } = element.connection()?;
        Some((shaft_node(&a, &b)?, (x || y, tilt_x && tilt_y), name))
    });
    let bearings = model.bearings.iter().map(|site| {
        let [x, y, _, tilt_x, tilt_y, _] = site.bearing.supports();
        (site.node, (x || y, tilt_x && tilt_y), format!("bearing.{}", site.name))
    });
    let supports: Vec<_> = joints.chain(bearings).chain(connections).collect();
    let Some((node, _, name)) = supports.iter().find(|(_, (sideways, _), _)| *sideways) else { return };
    if supports.iter().any(|(other, (sideways, tilt), _)| *tilt || *sideways && other != node) {
        return;
    }
    let tilts = |force: &[f64; 6]| force[3] != 0.0 || force[4] != 0.0;
    for (load, r) in model.loads.iter().filter_map(|l| Some((l, top.item(&loading::TOP.load, &l.name)?))) {
        let on_shaft = load.at.node.is_some_and(|node| node < shaft);
        if on_shaft && load.factor.is_constant() && tilts(&load.force) {
            let message = format!(
                "load.{} tilts the shaft, whose only support, {name}, permits tilting like a ball joint",
                load.name
            );
            let problem = Problem::new(Kind::Disconnected, &r.span_of(&loading::LOAD.moment), message);
            top.log.error(problem.expected("a second support, or one that resists tilting").hint(
                "a joint of kind = \"revolute\", a second support at another station, a ball bearing or k_tilt resists tilting",
            ));
        }
    }
}
