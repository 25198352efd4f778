//! The machine's surfaces with what every point moves with, for shapes in motion.

use super::arrays::Arrays;
use rotordyn_core::model::Model;
use rotordyn_io::vtk::Grid;
use serde_json::{Value, json};

/// Points, triangles and parts of the machine; `carriers` lists for every point the nodes that it moves with.
pub(crate) fn view(model: &Model, arrays: &mut Arrays) -> Value {
    let grid = Grid::of_machine(model);
    let flat = |of: &[[f64; 3]]| of.iter().flatten().copied().collect::<Vec<f64>>();
    let triangles: Vec<f64> = grid.triangles.iter().flatten().map(|&corner| corner as f64).collect();
    let parts: Vec<f64> = grid.parts.iter().map(|&part| part as u8 as f64).collect();
    let (mut point, mut node, mut arm, mut weight) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (k, carriers) in grid.carriers.iter().enumerate() {
        for carrier in carriers {
            point.push(k as f64);
            node.push(carrier.node as f64);
            arm.push(carrier.arm);
            weight.push(carrier.weight);
        }
    }
    let discs = model.discs.iter().map(|disc| disc.node);
    let mut orbits: Vec<usize> = discs.chain(model.bearings.iter().map(|site| site.node)).collect();
    orbits.sort_unstable();
    orbits.dedup();
    json!({
        "points": arrays.add(&flat(&grid.points)),
        "triangles": arrays.add(&triangles),
        "parts": arrays.add(&parts),
        "carriers": {
            "point": arrays.add(&point),
            "node": arrays.add(&node),
            "arm": arrays.add(&flat(&arm)),
            "weight": arrays.add(&weight),
        },
        "node_z": arrays.add(&model.node_z),
        "orbit_nodes": orbits,
    })
}
