//! Classification of modes: bending, torsional, axial or body (housing); forward, backward or mixed whirl.

use super::modal::Mode;
use super::mode::inner;
pub use super::mode::{Energy, ModeKind};
use crate::assembly::Assembly;
use rotordyn_linalg::Complex64;
use std::collections::HashMap;

/// A mode is planar when its orbits enclose less than this fraction of the area of circular orbits.
const MAX_PLANAR_AREA: f64 = 0.01;
/// A mode is mixed when the minority whirl direction encloses more than this fraction of the orbit area.
const MIN_MIXED_AREA: f64 = 0.05;

/// The mode with phase-normalised shape, kind, energies and effective modal masses; without label.
pub(super) fn characterise(assembly: &Assembly, eigenvalue: Complex64, mut shape: Vec<Complex64>) -> Mode {
    let mut full_shape = assembly.dofs.expand_complex(&shape);
    normalise_phase(&mut shape, &mut full_shape);
    let momentum = assembly.full_mass.mul_complex(&full_shape);
    let shaft = assembly.dofs.shaft_nodes;
    let energy = energy_shares(&full_shape, &momentum, shaft);
    let whirl: Vec<f64> = full_shape.chunks(6).take(shaft).map(|n| whirl_index(n[0], n[1])).collect();
    let kind = classify(&energy, &full_shape[..6 * shaft], &whirl);
    let total = translation_masses(assembly);
    let effective_mass = std::array::from_fn(|d| {
        let part: Complex64 = momentum.iter().skip(d).step_by(6).sum();
        part.norm_sqr() / (total[d] * inner(&full_shape, &momentum).re)
    });
    Mode { eigenvalue, shape, full_shape, kind, label: String::new(), whirl, energy, effective_mass }
}

/// Total mass along x, y, z.
fn translation_masses(assembly: &Assembly) -> [f64; 3] {
    let mut total = [0.0; 3];
    for (i, j, v) in assembly.full_mass.iter() {
        if i % 6 < 3 && i % 6 == j % 6 {
            total[i % 6] += v;
        }
    }
    total
}

/// Rotates the phase so that the largest translation (if none, rotation) is real and positive.
fn normalise_phase(shape: &mut [Complex64], full: &mut [Complex64]) {
    let largest = |translation: bool| {
        let candidates = full.iter().enumerate().filter(move |(i, _)| (i % 6 < 3) == translation);
        // The first of nearly equal values, so that round-off of symmetric nodes rarely changes the choice.
        candidates
            .fold(Complex64::default(), |m, (_, v)| if v.norm() > m.norm() * 1.000_001 { *v } else { m })
    };
    let (translation, rotation) = (largest(true), largest(false));
    let lead = if translation.norm() > 1e-6 * rotation.norm() { translation } else { rotation };
    if lead.norm() > 0.0 {
        let phase = lead.conj() / lead.norm();
        shape.iter_mut().chain(full).for_each(|v| *v *= phase);
    }
}

fn energy_shares(full: &[Complex64], momentum: &[Complex64], shaft_nodes: usize) -> Energy {
    let mut energy = Energy { bodies: vec![[0.0; 6]; full.len() / 6 - shaft_nodes], ..Energy::default() };
    let mut total = 0.0;
    for (i, (q, p)) in full.iter().zip(momentum).enumerate() {
        let e = (q.conj() * p).re;
        total += e;
        let (node, dof) = (i / 6, i % 6);
        match (node.checked_sub(shaft_nodes), dof) {
            (Some(body), _) => energy.bodies[body][dof] += e,
            (None, 0 | 4) => energy.bending_x += e,
            (None, 1 | 3) => energy.bending_y += e,
            (None, 2) => energy.axial += e,
            (None, _) => energy.torsion += e,
        }
    }
    for e in [&mut energy.bending_x, &mut energy.bending_y, &mut energy.axial, &mut energy.torsion] {
        *e /= total;
    }
    energy.bodies.iter_mut().flatten().for_each(|e| *e /= total);
    energy
}

/// Whirl index (|F|² − |B|²)/(|F|² + |B|²) with x + j y = F e^{jωt} + B e^{−jωt}.
pub fn whirl_index(x: Complex64, y: Complex64) -> f64 {
    // |X + jY|² − |X − jY|² = 4 Im(X* Y) (−1).
    let sum = x.norm_sqr() + y.norm_sqr();
    if sum > 0.0 { -2.0 * (x.conj() * y).im / sum } else { 0.0 }
}

fn classify(energy: &Energy, shaft: &[Complex64], whirl: &[f64]) -> ModeKind {
    let bending = energy.bending_x + energy.bending_y;
    let bodies = energy.body_total();
    let top = bending.max(bodies).max(energy.axial).max(energy.torsion);
    if top == energy.torsion {
        return ModeKind::Torsional;
    }
    if top == energy.axial {
        return ModeKind::Axial;
    }
    if top == bodies {
        return ModeKind::Body;
    }
    let (mut forward, mut backward, mut circles) = (0.0, 0.0, 0.0);
    for (node, whirl) in shaft.chunks(6).zip(whirl) {
        let circle = node[0].norm_sqr() + node[1].norm_sqr();
        circles += circle;
        forward += circle * whirl.max(0.0);
        backward -= circle * whirl.min(0.0);
    }
    let area: f64 = forward + backward;
    if area < MAX_PLANAR_AREA * circles {
        if energy.bending_x >= energy.bending_y { ModeKind::PlaneX } else { ModeKind::PlaneY }
    } else if forward.min(backward) > MIN_MIXED_AREA * area {
        ModeKind::Mixed
    } else if forward > backward {
        ModeKind::Forward
    } else {
        ModeKind::Backward
    }
}

/// Makes a whirling mode one of the plane with most of its energy.
///
/// A shaft at rest on a symmetric stiffness has no whirl direction; orbits are ellipses only by damping that is not
/// proportional.
pub(super) fn name_by_plane(mode: &mut Mode) {
    if matches!(mode.kind, ModeKind::Forward | ModeKind::Backward | ModeKind::Mixed) {
        let along_x = mode.energy.bending_x >= mode.energy.bending_y;
        mode.kind = if along_x { ModeKind::PlaneX } else { ModeKind::PlaneY };
    }
}

/// Labels modes sorted by frequency: "1st bending forward", "2nd torsional", "housing A, u_x"; for a rigid
/// rotor "rigid-body" replaces "bending".
///
/// Bending modes come in pairs: forward and backward, x and y, or both mixed. A mode is numbered by the modes of its
/// own kind below it and, for pairs of another type, by half of their number.
pub(super) fn label(assembly: &Assembly, modes: &mut [Mode]) {
    let mut count: HashMap<String, usize> = HashMap::new();
    let [mut whirling, mut planar, mut mixed] = [0, 0, 0];
    for mode in modes {
        let name = label_without_number(assembly, mode);
        let before = *count.entry(name.clone()).and_modify(|n| *n += 1).or_insert(1) - 1;
        let place = match mode.kind {
            ModeKind::Forward | ModeKind::Backward => before + (planar + mixed) / 2,
            ModeKind::PlaneX | ModeKind::PlaneY => before + (whirling + mixed) / 2,
            ModeKind::Mixed => (whirling + planar + mixed) / 2,
            ModeKind::Torsional | ModeKind::Axial | ModeKind::Body => before,
        };
        match mode.kind {
            ModeKind::Forward | ModeKind::Backward => whirling += 1,
            ModeKind::PlaneX | ModeKind::PlaneY => planar += 1,
            ModeKind::Mixed => mixed += 1,
            ModeKind::Torsional | ModeKind::Axial | ModeKind::Body => {}
        }
        mode.label = match mode.kind {
            ModeKind::Body if before == 0 => name,
            _ => format!("{} {name}", ordinal(place + 1)),
        };
    }
}

/// The label of a mode without its number.
pub(super) fn label_without_number(assembly: &Assembly, mode: &Mode) -> String {
    match mode.kind {
        ModeKind::Body => body_name(assembly, &mode.energy),
        kind if assembly.dofs.rigid => kind.name().replace("bending", "rigid-body"),
        kind => kind.name().into(),
    }
}

/// The body and direction with most of the energy.
fn body_name(assembly: &Assembly, energy: &Energy) -> String {
    let all = energy.bodies.iter().enumerate().flat_map(|(b, e)| (0..6).map(move |d| (b, d, e[d])));
    let (body, dof, _) = all.max_by(|a, b| a.2.total_cmp(&b.2)).unwrap_or_default();
    let name = &assembly.dofs.node_names[assembly.dofs.shaft_nodes + body];
    // A housing has the name of its bearing.
    let housing = if assembly.sites.iter().any(|site| site.name == *name) { "housing " } else { "" };
    format!("{housing}{name}, {}", crate::assembly::dofs::DOF_NAMES[dof])
}

/// 1st, 2nd, 3rd, 4th ...
pub fn ordinal(n: usize) -> String {
    let ending = match (n % 100, n % 10) {
        (11..=13, _) => "th",
        (_, 1) => "st",
        (_, 2) => "nd",
        (_, 3) => "rd",
        _ => "th",
    };
    format!("{n}{ending}")
}
