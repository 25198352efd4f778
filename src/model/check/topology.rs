//! What hangs on what: every body must be held by ground or by the shaft.

use crate::element::Anchor;
use crate::model::Model;
use crate::model::file::diagnostic::{Kind, Problem};
use crate::model::file::reader::Reader;

/// Report bodies that nothing connects to the shaft or to ground, and warn of a shaft that nothing holds.
pub(super) fn check(top: &Reader, model: &Model) {
    let first_body = model.node_z.len();
    // parts: 0 ground, 1 the shaft, 2.. bodies
    let part = |anchor: &Anchor| match anchor.node {
        None => 0,
        Some(node) if node < first_body => 1,
        Some(node) => 2 + node - first_body,
    };
    let mut links: Vec<(usize, usize)> = Vec::new();
    // a bushing that only damps does not hold
    let held = |k: &[[f64; 6]; 6]| k.iter().flatten().any(|&v| v != 0.0);
    links.extend(model.bushings.iter().filter(|b| held(&b.stiffness)).map(|b| (part(&b.a), part(&b.b))));
    links.extend(model.joints.iter().map(|j| (part(&j.a), part(&j.b))));
    links.extend(model.bearings.iter().map(|b| (1, part(&b.housing))));
    links.extend(model.belts.iter().filter(|b| b.stiffness.iter().any(|&k| k != 0.0)).map(|_| (1, 0)));
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
    let held = reach(&[0, 1]);
    for (_, body) in model.bodies.iter().enumerate().filter(|(k, _)| !held[2 + k]) {
        let kind = ["body", "housing"].into_iter().find(|kind| named(top, kind, &body.name).is_some());
        let kind = kind.unwrap_or("body");
        let span = named(top, kind, &body.name).unwrap_or(0..0);
        let message = format!("{kind} `{}` is disconnected: nothing holds it", body.name);
        let hint =
            format!("add a [bushing.{}] between it and ground, a joint, or a bearing in it", body.name);
        top.log.error(Problem::new(Kind::Disconnected, &span, message).hint(hint));
    }
    if !reach(&[0])[1] {
        let span = top.table("shaft").map_or(0..0, |r| r.span);
        let problem = Problem::new(Kind::Disconnected, &span, "nothing holds the shaft: it floats freely");
        top.log.warn(problem.hint("add a bearing, joint or bushing if that is not meant"));
    }
}

fn named(top: &Reader, collection: &str, name: &str) -> Option<std::ops::Range<usize>> {
    top.items(collection).into_iter().find(|(n, _)| *n == name).map(|(_, r)| r.span)
}
