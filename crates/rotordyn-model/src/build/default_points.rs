//! Probes and excitations of a file that has none.

use crate::study::Excitation;
use crate::{Model, Probe, Quantity};
use rotordyn_core::element::Anchor;

/// Directions with a default probe or excitation: across the shaft.
const DIRECTIONS: [(&str, [f64; 6]); 2] =
    [("x", [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]), ("y", [0.0, 1.0, 0.0, 0.0, 0.0, 0.0])];

/// Displacement along x and y of every disc, of a rigid rotor, and of the shaft at every bearing; of every station
/// without these.
pub(super) fn probes(model: &Model) -> Vec<Probe> {
    let mut points = rotating_parts(model);
    for site in &model.bearings {
        let taken = points.iter().any(|(name, _)| *name == site.name);
        let name = if taken { format!("bearing_{}", site.name) } else { site.name.clone() };
        points.push((name, site.node));
    }
    if points.is_empty() {
        points = stations(model);
    }
    let probe = |(name, node): (String, usize)| {
        DIRECTIONS.map(|(axis, direction)| Probe {
            name: format!("{name}_{axis}"),
            at: Anchor { node: Some(node), offset: [0.0; 3] },
            direction,
            quantity: Quantity::Displacement,
        })
    };
    points.into_iter().flat_map(probe).collect()
}

/// Forces along x and y at the first disc, else the rigid rotor, else the first station.
pub(super) fn excitations(model: &Model) -> Vec<Excitation> {
    let points = rotating_parts(model).into_iter().chain(stations(model));
    let node = points.map(|(_, node)| node).next();
    let force = |(axis, direction): (&str, [f64; 6])| Excitation {
        name: axis.into(),
        at: Anchor { node, offset: [0.0; 3] },
        direction,
    };
    DIRECTIONS.map(force).into()
}

/// Names and nodes of the discs and of a rigid rotor.
fn rotating_parts(model: &Model) -> Vec<(String, usize)> {
    let discs = model.discs.iter().map(|disc| (disc.name.clone(), disc.node));
    discs.chain(model.rigid_rotor.iter().map(|rotor| ("rotor".into(), rotor.node))).collect()
}

fn stations(model: &Model) -> Vec<(String, usize)> {
    model.stations.iter().map(|station| (station.name.clone(), station.node)).collect()
}
