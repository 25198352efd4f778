//! Figures of the machine layout, the static equilibrium and the mode shapes.

use super::{Named, TO_RPM};
use crate::{
    BallLoads, BallRow, BodyBox, BodyMotion, Deflection, Figure, JointSymbol, LayoutBearing, LayoutBelt,
    LayoutBlock, LayoutRow, LayoutSection, LayoutSpring, LayoutSupport, MachineLayout, Mark, ModeShape,
    ModeShapes, Rotor, RotorDisc, RotorSupport, SupportSymbol, Whirl,
};
use rotordyn_bearing::{BallBearing, BearingSymbol};
use rotordyn_core::analysis::Mode;
use rotordyn_core::analysis::equilibrium::{BearingState, Equilibrium};
use rotordyn_core::analysis::mode_kind::ModeKind;
use rotordyn_core::element::{Anchor, Bushing, Joint, RigidBody};
use rotordyn_core::geometry::scene;
use rotordyn_core::model::Model;
use rotordyn_core::results::ModalResult;
use rotordyn_core::study::Machine;

/// Side view of the machine to scale.
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
            label: body_name(model, body),
            z: [z - 0.5 * length, z + 0.5 * length],
            y: [y - 0.5 * height, y + 0.5 * height],
            rotating: false,
        }
    });
    let bearings = model.bearings.iter().filter_map(|site| {
        let ball = site.bearing.ball()?;
        Some(LayoutBearing {
            label: format!("bearing {}", site.name),
            bore: 0.5 * ball.geometry.bore,
            outside: 0.5 * ball.geometry.outside_diameter,
            rows: rows(ball, model.node_z[site.node]),
        })
    });
    let supports = shaft_supports(model).into_iter().filter(|s| s.symbol != SupportSymbol::Ball);
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
        bearings: bearings.collect(),
        supports: supports.collect(),
        springs: model.bushings.iter().filter_map(|bushing| spring(model, bushing)).collect(),
        belts: belts.collect(),
        stations: model.stations.iter().map(|s| (s.name.clone(), s.z)).collect(),
    };
    ("machine_layout".into(), Figure::MachineLayout(figure))
}

/// The rows of a ball bearing at an axial position \[m\].
fn rows(ball: &BallBearing, z: f64) -> Vec<LayoutRow> {
    let g = &ball.geometry;
    let row = |(offset, thrust): (f64, f64)| LayoutRow {
        z: z + offset,
        width: g.width,
        pitch: 0.5 * g.pitch_diameter,
        ball: 0.5 * g.ball_diameter,
        contact_angle: thrust * g.contact_angle,
    };
    ball.rows().into_iter().map(row).collect()
}

/// Supports of the shaft: bearings, joints and bushings without length between a shaft node and something
/// else.
fn shaft_supports(model: &Model) -> Vec<LayoutSupport> {
    let nodes = model.node_z.len();
    let at = |label: String, node: usize, symbol, grounded| LayoutSupport {
        label,
        z: model.node_z[node],
        radius: 0.5 * scene::shaft_diameter(model, node),
        symbol,
        grounded,
    };
    let bearings = model.bearings.iter().map(|site| {
        let symbol = match site.bearing.symbol() {
            BearingSymbol::RollingElement => SupportSymbol::Ball,
            BearingSymbol::Springs(matrices) => {
                let none = SupportSymbol::SpringDamper { spring: false, damper: false, axial: false };
                matrix_symbol(&matrices).unwrap_or(none)
            }
        };
        at(format!("bearing {}", site.name), site.node, symbol, site.housing.node.is_none())
    });
    let joints = model.joints.iter().filter_map(|joint| {
        let node = [joint.a.node, joint.b.node].into_iter().flatten().find(|node| *node < nodes)?;
        let grounded = joint.a.node.is_none() || joint.b.node.is_none();
        Some(at(format!("joint {}", joint.name), node, SupportSymbol::Joint(joint_symbol(joint)), grounded))
    });
    let bushings = model.bushings.iter().filter_map(|bushing| {
        let node = bushing.a.node.into_iter().chain(bushing.b.node).find(|node| *node < nodes)?;
        let grounded = bushing.a.node.is_none() || bushing.b.node.is_none();
        if length(model, bushing) > ZERO_LENGTH {
            return None;
        }
        let symbol = matrix_symbol(&[[&bushing.stiffness, &bushing.damping]])?;
        // Below a disc at the node, which would cover it.
        let discs = model.discs.iter().filter(|d| d.node == node).map(|d| scene::disc_size(d).0);
        let support = at(format!("bushing {}", bushing.name), node, symbol, grounded);
        Some(LayoutSupport { radius: discs.fold(support.radius, f64::max), ..support })
    });
    bearings.chain(joints).chain(bushings).collect()
}

/// 6 × 6 matrices K and C of a spring-damper.
type Matrices<'a> = [&'a [[f64; 6]; 6]; 2];

/// Spring, damper or both, by the entries of K and C; axial if only u_z has any. None if all are zero.
fn matrix_symbol(rows: &[Matrices]) -> Option<SupportSymbol> {
    let acts =
        |matrix: &[[f64; 6]; 6], dofs: &[usize]| dofs.iter().any(|&d| matrix[d].iter().any(|v| *v != 0.0));
    let any = |dofs: &[usize]| (rows.iter().any(|r| acts(r[0], dofs)), rows.iter().any(|r| acts(r[1], dofs)));
    let (spring, damper) = any(&[0, 1, 2, 3, 4, 5]);
    let axial = any(&[2]) != (false, false) && any(&[0, 1, 3, 4, 5]) == (false, false);
    (spring || damper).then_some(SupportSymbol::SpringDamper { spring, damper, axial })
}

fn joint_symbol(joint: &Joint) -> JointSymbol {
    let [x, y, _, tilt_x, tilt_y, _] = joint.locked;
    match (x || y, tilt_x || tilt_y) {
        (true, false) => JointSymbol::Pin,
        (true, true) => JointSymbol::Sleeve,
        (false, _) => JointSymbol::Stop,
    }
}

/// Ends of a bushing closer than this are at one place \[m\].
const ZERO_LENGTH: f64 = 1e-6;

/// Distance of the ends of a bushing in the side view \[m\]; to ground: without its own offset none.
fn length(model: &Model, bushing: &Bushing) -> f64 {
    let (a, b) = (place(model, &bushing.a), place(model, &bushing.b));
    (a[1] - b[1]).hypot(a[0] - b[0])
}

/// A bushing that is not a support of the shaft, from its body to the ground or between two points.
fn spring(model: &Model, bushing: &Bushing) -> Option<LayoutSpring> {
    let Some(SupportSymbol::SpringDamper { spring, damper, .. }) =
        matrix_symbol(&[[&bushing.stiffness, &bushing.damping]])
    else {
        return None;
    };
    let grounded = bushing.a.node.is_none() || bushing.b.node.is_none();
    let [from, to] =
        if bushing.a.node.is_none() { [&bushing.b, &bushing.a] } else { [&bushing.a, &bushing.b] };
    let ends = [from, to].map(|anchor| place(model, anchor));
    if length(model, bushing) > ZERO_LENGTH {
        return Some(LayoutSpring { from: ends[0], to: ends[1], spring, damper, grounded });
    }
    // A spring without length is drawn from the lower edge of its body to the ground.
    let body = from.node.filter(|node| grounded && *node >= model.node_z.len())?;
    let below = lower_edge(model, body);
    let drop = 0.35 * below.abs().max(0.02);
    let [from, to] = [below, below - drop].map(|y| [ends[0][0], y]);
    Some(LayoutSpring { from, to, spring, damper, grounded })
}

/// Name of a body; a housing has that of its bearing.
fn body_name(model: &Model, body: &RigidBody) -> String {
    match model.bearings.iter().any(|b| b.name == body.name) {
        true => format!("housing {}", body.name),
        false => body.name.clone(),
    }
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

/// y of the lower edge of the body at a node \[m\].
fn lower_edge(model: &Model, node: usize) -> f64 {
    let body = &model.bodies[node - model.node_z.len()];
    body.position[1] - 0.5 * scene::equivalent_box(body).0[1]
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
    let row = |bearing: &BearingState, number: usize, rows: usize| {
        // Rounded first, plus zero: avoids "-0".
        let [x, y, z, ..] = bearing.force.map(|f| f.round());
        let side = match (rows, number) {
            (1, _) => "",
            (_, 0) => ", row 1 (towards −z)",
            _ => ", row 2 (towards +z)",
        };
        let balls = || bearing.balls.iter().filter(|b| b.row == number);
        BallRow {
            title: format!("bearing {}{side}", bearing.name),
            note: format!("force on the shaft: x {} N, y {} N, z {} N", x + 0.0, y + 0.0, z + 0.0),
            angle_deg: balls().map(|b| b.position.to_degrees()).collect(),
            load: balls().map(|b| b.load).collect(),
            // The shaft loads the inner ring with the opposite of the force on it.
            radial_load: [-bearing.force[0], -bearing.force[1]],
        }
    };
    // Every row of a pair has its own panel.
    let mut rows: Vec<BallRow> = Vec::new();
    for bearing in &found.bearings {
        let count = bearing.balls.iter().map(|b| b.row + 1).max().unwrap_or(0);
        rows.extend((0..count).map(|number| row(bearing, number, count)));
    }
    let mut figures = vec![("static_deflection".into(), Figure::Deflection(deflection))];
    if !rows.is_empty() {
        let loads = BallLoads { title: "Load distribution of the ball bearings".into(), note, rows };
        figures.push(("ball_loads".into(), Figure::BallLoads(loads)));
    }
    figures
}

pub fn modes(found: &ModalResult, machine: &Machine) -> Named {
    let model = &machine.model;
    let rpm = found.speed * TO_RPM;
    let disc =
        |disc: &rotordyn_core::element::Disc| RotorDisc { node: disc.node, radius: scene::disc_size(disc).0 };
    let supports = shaft_supports(model).into_iter().filter(|s| s.grounded);
    let figure = ModeShapes {
        title: format!("Mode shapes at {rpm:.0} rpm"),
        note: model.title.clone(),
        rotor: Rotor {
            z: model.node_z.clone(),
            discs: model.rotating_inertias().map(disc).collect(),
            supports: supports.map(|s| RotorSupport { z: s.z, symbol: s.symbol }).collect(),
            bodies: model.bodies.iter().enumerate().map(|(k, body)| body_box(model, k, body)).collect(),
            orbit_nodes: Vec::new(),
        },
        modes: found.modes.iter().map(|mode| shape(mode, model)).collect(),
    };
    (format!("modes_{rpm:.0}rpm"), Figure::ModeShapes(figure))
}

/// A body as its equivalent box.
fn body_box(model: &Model, k: usize, body: &RigidBody) -> BodyBox {
    let (edges, turn) = scene::equivalent_box(body);
    let half_edge = |i: usize| {
        let column = turn.to_rotation_matrix().matrix().column(i) * (0.5 * edges[i]);
        [column[0], column[1], column[2]]
    };
    let node = model.node_z.len() + k;
    let grounded = model.bushings.iter().filter(|b| match (b.a.node, b.b.node) {
        (Some(a), None) => a == node,
        (None, Some(b)) => b == node,
        _ => false,
    });
    let matrices: Vec<Matrices> = grounded.map(|b| [&b.stiffness, &b.damping]).collect();
    let to_ground = match matrix_symbol(&matrices) {
        Some(SupportSymbol::SpringDamper { spring, damper, .. }) => (spring, damper),
        _ => (false, false),
    };
    BodyBox {
        name: body_name(model, body),
        centre: body.position,
        half_edges: [0, 1, 2].map(half_edge),
        to_ground,
    }
}

fn shape(mode: &Mode, model: &Model) -> ModeShape {
    let nodes = model.node_z.len();
    let at = |node: usize, d: usize| {
        let u = mode.full_shape[6 * node + d];
        [u.re, u.im]
    };
    let column = |d: usize| (0..nodes).map(|node| at(node, d)).collect();
    let body = |k: usize| BodyMotion {
        u: [0, 1, 2].map(|d| at(nodes + k, d)),
        theta: [3, 4, 5].map(|d| at(nodes + k, d)),
    };
    ModeShape {
        title: format!("{:.1} Hz, {}, ζ = {:.2} %", mode.frequency_hz(), mode.label, 100.0 * mode.zeta()),
        whirl: whirl(mode.kind),
        u_x: column(0),
        u_y: column(1),
        u_z: column(2),
        theta_x: column(3),
        theta_y: column(4),
        theta_z: column(5),
        bodies: (0..model.bodies.len()).map(body).collect(),
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
