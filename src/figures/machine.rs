//! Figures of the machine layout, the static equilibrium and the mode shapes.

use super::{Named, TO_RPM};
use crate::analysis::Mode;
use crate::analysis::equilibrium::{BearingState, Equilibrium};
use crate::analysis::mode_kind::ModeKind;
use crate::element::Anchor;
use crate::geometry::scene;
use crate::model::Model;
use crate::plot::{
    BallLoads, BallRow, BodyMotion, Deflection, Figure, LayoutBearing, LayoutBelt, LayoutBlock,
    LayoutSection, LayoutSpring, MachineLayout, Mark, ModeShape, ModeShapes, Rotor, Whirl,
};
use crate::results::ModalResult;
use crate::study::Machine;

/// Drawn width and radial height of a bearing without dimensions, in shaft diameters.
const DEFAULT_BEARING_SIZE: [f64; 2] = [0.5, 0.35];

pub fn layout(machine: &Machine) -> Named {
    let model = &machine.model;
    let sections = scene::shaft_sections(model);
    let sections = sections.into_iter().map(|s| LayoutSection { z: s.z, outer: s.outer, inner: s.inner });
    let discs = model.discs.iter().map(|disc| {
        let (radius, thickness) = scene::disc_size(disc);
        let z = model.node_z[disc.node];
        LayoutBlock {
            label: disc.name.clone(),
            z: [z - 0.5 * thickness, z + 0.5 * thickness],
            y: [-radius, radius],
            rotating: true,
        }
    });
    let bodies = model.bodies.iter().map(|body| {
        let ([_, height, length], _) = scene::equivalent_box(body);
        let [_, y, z] = body.position;
        LayoutBlock {
            label: match model.bearings.iter().any(|b| b.name == body.name) {
                true => format!("housing {}", body.name),
                false => body.name.clone(),
            },
            z: [z - 0.5 * length, z + 0.5 * length],
            y: [y - 0.5 * height, y + 0.5 * height],
            rotating: false,
        }
    });
    let springs = model.bushings.iter().filter(|b| b.stiffness.as_flattened().iter().any(|k| *k != 0.0));
    let springs = springs.filter_map(|bushing| {
        let (a, b) = (place(model, &bushing.a), place(model, &bushing.b));
        let grounded = bushing.a.node.is_none() || bushing.b.node.is_none();
        let [from, to] = if bushing.a.node.is_none() { [b, a] } else { [a, b] };
        // A zero-length spring is drawn from the lower edge of the body to the ground.
        let below = bushing.a.node.or(bushing.b.node).map_or(0.0, |node| lower_edge(model, node));
        let drop = 0.35 * below.abs().max(0.02);
        match (from[1] - to[1]).hypot(from[0] - to[0]) < 1e-6 {
            true if grounded => {
                Some(LayoutSpring { from: [from[0], below], to: [from[0], below - drop], grounded })
            }
            true => None,
            false => Some(LayoutSpring { from, to, grounded }),
        }
    });
    let supports = model.bearings.iter().map(|site| {
        let (z, shaft) = (model.node_z[site.node], 0.5 * scene::shaft_diameter(model, site.node));
        match site.bearing.ball() {
            Some(ball) => LayoutBearing {
                label: format!("bearing {}", site.name),
                z,
                width: ball.geometry.width,
                bore: 0.5 * ball.geometry.bore,
                outside: 0.5 * ball.geometry.outside_diameter,
            },
            None => plain_support(format!("bearing {}", site.name), z, shaft),
        }
    });
    let joints = model.joints.iter().filter_map(|joint| {
        let node = joint.a.node.into_iter().chain(joint.b.node).find(|node| *node < model.node_z.len())?;
        let shaft = 0.5 * scene::shaft_diameter(model, node);
        Some(plain_support(format!("joint {}", joint.name), model.node_z[node], shaft))
    });
    let belts = model.belts.iter().map(|belt| {
        let disc = model.discs.iter().find(|d| d.node == belt.node);
        let shaft = 0.5 * scene::shaft_diameter(model, belt.node);
        let [x, y] = belt.pull;
        let pull = match (x != 0.0, y != 0.0) {
            (false, false) => String::new(),
            (true, false) => format!(" {x:.0} N along x"),
            (false, true) => format!(" {y:.0} N along y"),
            (true, true) => format!(" {x:.0}, {y:.0} N along x, y"),
        };
        LayoutBelt {
            label: format!("{}{pull}", belt.name),
            z: model.node_z[belt.node],
            radius: disc.map_or(shaft, |d| scene::disc_size(d).0),
            pull: belt.pull,
        }
    });
    let figure = MachineLayout {
        title: model.title.clone(),
        note: String::new(),
        sections: sections.collect(),
        blocks: bodies.chain(discs).collect(),
        supports: supports.chain(joints).collect(),
        springs: springs.collect(),
        belts: belts.collect(),
        stations: model.stations.iter().map(|s| (s.name.clone(), s.z)).collect(),
    };
    ("machine_layout".into(), Figure::MachineLayout(figure))
}

fn plain_support(label: String, z: f64, shaft: f64) -> LayoutBearing {
    let [width, height] = DEFAULT_BEARING_SIZE.map(|part| part * 2.0 * shaft);
    LayoutBearing { label, z, width, bore: shaft, outside: shaft + height }
}

/// \[z, y\] of an anchor point.
fn place(model: &Model, at: &Anchor) -> [f64; 2] {
    let nodes = model.node_z.len();
    let [y, z] = match at.node {
        None => [0.0, 0.0],
        Some(node) if node < nodes => [0.0, model.node_z[node]],
        Some(node) => [model.bodies[node - nodes].position[1], model.bodies[node - nodes].position[2]],
    };
    [z + at.offset[2], y + at.offset[1]]
}

/// y of the lower edge of a body or of the shaft \[m\].
fn lower_edge(model: &Model, node: usize) -> f64 {
    match node.checked_sub(model.node_z.len()) {
        Some(body) => {
            let body = &model.bodies[body];
            body.position[1] - 0.5 * scene::equivalent_box(body).0[1]
        }
        None => -0.5 * scene::shaft_diameter(model, node),
    }
}

pub fn equilibrium(found: &Equilibrium, machine: &Machine) -> Vec<Named> {
    let model = &machine.model;
    let q = machine.assembly.dofs.expand(&found.q);
    let nodes = model.node_z.len();
    let column = |d: usize| (0..nodes).map(|k| q[6 * k + d]).collect();
    let note = format!("{}, static equilibrium at {:.0} rpm", model.title, found.speed * TO_RPM);
    let deflection = Deflection {
        title: "Static deflection of the shaft".into(),
        note: note.clone(),
        z: model.node_z.clone(),
        u_x: column(0),
        u_y: column(1),
        stations: model.stations.iter().map(|s| Mark { label: s.name.clone(), z: s.z }).collect(),
    };
    let row = |bearing: &BearingState| {
        // Rounded first, plus zero: avoids "-0".
        let [x, y, z, ..] = bearing.force.map(|f| f.round());
        BallRow {
            title: format!("bearing {}", bearing.name),
            note: format!("force on the shaft: x {} N, y {} N, z {} N", x + 0.0, y + 0.0, z + 0.0),
            angle_deg: bearing.balls.iter().map(|b| b.position.to_degrees()).collect(),
            load: bearing.balls.iter().map(|b| b.load).collect(),
        }
    };
    let rows: Vec<BallRow> = found.bearings.iter().filter(|b| !b.balls.is_empty()).map(row).collect();
    let mut figures = vec![("static_deflection".into(), Figure::Deflection(deflection))];
    if !rows.is_empty() {
        let loads = BallLoads { title: "Load distribution of the ball bearings".into(), note, rows };
        figures.push(("ball_loads".into(), Figure::BallLoads(loads)));
    }
    figures
}

pub fn modes(found: &ModalResult, machine: &Machine) -> Named {
    let model = &machine.model;
    let joints = model.joints.iter().flat_map(|j| [j.a.node, j.b.node]).flatten();
    let supports = model.bearings.iter().map(|b| b.node).chain(joints);
    let rpm = found.speed * TO_RPM;
    let figure = ModeShapes {
        title: format!("Mode shapes at {rpm:.0} rpm"),
        note: model.title.clone(),
        rotor: Rotor {
            z: model.node_z.clone(),
            discs: model.discs.iter().map(|d| [model.node_z[d.node], scene::disc_size(d).0]).collect(),
            bearings: supports.filter_map(|node| model.node_z.get(node).copied()).collect(),
            orbit_nodes: Vec::new(),
        },
        modes: found.modes.iter().map(|mode| shape(mode, model)).collect(),
    };
    (format!("modes_{rpm:.0}rpm"), Figure::ModeShapes(figure))
}

fn shape(mode: &Mode, model: &Model) -> ModeShape {
    let nodes = model.node_z.len();
    let at = |node: usize, d: usize| {
        let u = mode.full_shape[6 * node + d];
        [u.re, u.im]
    };
    let column = |d: usize| (0..nodes).map(|node| at(node, d)).collect();
    let body = |(k, body): (usize, &crate::element::RigidBody)| BodyMotion {
        z: body.position[2],
        u_x: at(nodes + k, 0),
        u_y: at(nodes + k, 1),
    };
    ModeShape {
        title: format!("{:.1} Hz, {}, ζ = {:.2} %", mode.frequency_hz(), mode.label, 100.0 * mode.zeta()),
        whirl: whirl(mode.kind),
        u_x: column(0),
        u_y: column(1),
        u_z: column(2),
        theta_z: column(5),
        bodies: model.bodies.iter().enumerate().map(body).collect(),
    }
}

/// Colour class of a mode kind.
pub fn whirl(kind: ModeKind) -> Whirl {
    match kind {
        ModeKind::Forward => Whirl::Forward,
        ModeKind::Backward => Whirl::Backward,
        ModeKind::Torsional => Whirl::Torsion,
        ModeKind::Axial => Whirl::Axial,
        ModeKind::Mixed | ModeKind::PlaneX | ModeKind::PlaneY | ModeKind::Body => Whirl::Mixed,
    }
}
