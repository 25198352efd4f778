//! Every bearing model of the list: its force, tangents, energy and internal coordinates agree with each other.
//!
//! A new model is covered by its sample in [`samples`].

use std::collections::BTreeSet;

use crate::ball_bearing::Random;
use crate::bearing::rig_6205;
use rotordyn_bearing::contact::Traction;
use rotordyn_bearing::free_ball::{Drag, FreeBallBearing, FrictionLaw, SlipModel};
use rotordyn_bearing::internal::{InternalStep, Motion, NewmarkGain};
use rotordyn_bearing::{
    Bearing, BearingElement, InternalCoordinates, LinearBearing, LinearBearingRow, RadialBallBearing,
    Reaction, Rotation,
};

/// One bearing of every model.
fn samples() -> Vec<Bearing> {
    let matrix = |scale: f64| {
        let entry = |a: usize, b: usize| if a == b { 1e7 } else { 1e5 * (a as f64 - 0.4 * b as f64) };
        std::array::from_fn(|a| std::array::from_fn(|b| scale * entry(a, b)))
    };
    let row =
        |speed| LinearBearingRow { speed, stiffness: matrix(1.0 + speed / 300.0), damping: matrix(1e-4) };
    let linear = LinearBearing { table: vec![row(0.0), row(300.0)], ..Default::default() };
    let radial = RadialBallBearing {
        ball: rig_6205(),
        stiffness_damping: [1e-4, 0.7e-4],
        tensile_contact: false,
        gravity: [2.0, -9.0],
    };
    let slip = Traction { friction: 0.06, slip_speed: 0.02 };
    let free = FreeBallBearing {
        ball: rig_6205(),
        friction: FrictionLaw::Coulomb(slip),
        slip: SlipModel::default(),
        damping: 1.0,
        rolling_loss: 0.007,
        cage: None,
        ball_friction: slip,
        drag: Drag::default(),
        gravity: [0.0, -9.8, 0.0],
    };
    vec![linear.into(), rig_6205().into(), radial.into(), free.into()]
}

fn for_each_sample(mut visit: impl FnMut(&str, &dyn BearingElement)) {
    for bearing in samples() {
        visit(bearing.keyword(), bearing.element().as_ref());
    }
}

fn for_each_with_internal(mut visit: impl FnMut(&str, &dyn BearingElement, &dyn InternalCoordinates)) {
    let mut visited = 0;
    for_each_sample(|name, element| {
        if let Some(internal) = element.internal() {
            visited += 1;
            visit(name, element, internal);
        }
    });
    assert!(visited > 0);
}

fn spinning(random: &mut Random) -> Rotation {
    Rotation {
        cage_angle: 3.0 * random.next(),
        cage_speed: Some(200.0),
        shaft_angle: 3.0 * random.next(),
        shaft_speed: 520.0,
    }
}

fn at_rest(random: &mut Random) -> Rotation {
    Rotation { cage_angle: 3.0 * random.next(), cage_speed: Some(0.0), ..Rotation::default() }
}

/// Displacement \[m, rad\] that closes contacts, and velocity.
fn state(random: &mut Random) -> ([f64; 6], [f64; 6]) {
    (random.scaled([2e-5, 2e-5, 2e-5, 3e-4, 3e-4, 3e-4]), random.scaled([3e-3, 3e-3, 3e-3, 0.1, 0.1, 0.1]))
}

/// −∂f/∂q by differences to both sides; `None` where they differ: at a contact that opens or closes.
fn slope(at: impl Fn(f64) -> Vec<f64>, step: f64, tolerance: f64) -> Option<Vec<f64>> {
    let (minus, here, plus) = (at(-step), at(0.0), at(step));
    let sides = minus.iter().zip(&here).zip(&plus);
    let smooth = sides.clone().all(|((m, h), p)| (p - 2.0 * h + m).abs() <= step * tolerance);
    smooth.then(|| sides.map(|((m, _), p)| -(p - m) / (2.0 * step)).collect())
}

#[test]
fn every_model_has_a_sample() {
    let samples = samples();
    let keywords: BTreeSet<&str> = samples.iter().map(|bearing| bearing.keyword()).collect();
    assert_eq!(keywords.len(), Bearing::MODELS.len(), "{:?}", Bearing::MODELS);
    for bearing in &samples {
        let [supports, dofs] =
            [bearing.supports().iter().rposition(|s| *s), Some(bearing.element().relative_dofs())];
        assert!(supports < dofs, "{}", bearing.keyword());
        assert_eq!(
            bearing.cage().is_some(),
            bearing.element().rolling_elements() > 0,
            "{}",
            bearing.keyword()
        );
    }
}

#[test]
fn tangents_match_differences_and_act_on_the_relative_dofs_alone() {
    for_each_sample(|name, element| {
        let mut random = Random(17);
        let mut compared = 0;
        for k in 0..60 {
            let (d, v) = state(&mut random);
            // Internal coordinates follow quasi-statically: their tangents are those of slow motions.
            let internal = element.internal().is_some();
            let v = if internal { [0.0; 6] } else { v };
            let rotation = if k % 2 == 0 || internal { at_rest(&mut random) } else { spinning(&mut random) };
            let out = element.reaction(&d, &v, &rotation);
            let dofs = element.relative_dofs();
            for row in 0..6 {
                assert!(row < dofs || out.force[row] == 0.0, "{name}: force {row}");
                let others = (0..6).filter(|column| row.max(*column) >= dofs);
                others.for_each(|column| {
                    assert!(out.stiffness[row][column] == 0.0 && out.damping[row][column] == 0.0, "{name}");
                });
            }
            for column in 0..dofs {
                // Levers of a few centimetres make moments and angles comparable.
                let lever = |k: usize| if k < 3 { 1.0 } else { 30.0 };
                let force = |by: f64, of_rate: bool| {
                    let (mut d, mut v) = (d, v);
                    (if of_rate { &mut v } else { &mut d })[column] += by * lever(column);
                    let force = element.reaction(&d, &v, &rotation).force;
                    (0..dofs).map(|row| force[row] * lever(row)).collect()
                };
                for (of_rate, step, tolerance, tangent) in
                    [(false, 1e-9, 5e-4 * 1e8, &out.stiffness), (true, 1e-6, 5e-4 * 1e4, &out.damping)]
                {
                    let Some(found) = slope(|by| force(by, of_rate), step, tolerance) else { continue };
                    compared += 1;
                    for (row, found) in found.iter().enumerate() {
                        let expected = tangent[row][column] * lever(row) * lever(column);
                        assert!(
                            (found - expected).abs() < tolerance + 2e-3 * expected.abs(),
                            "{name} at {k}, rate {of_rate}: [{row}][{column}] is {expected}, by difference {found}"
                        );
                    }
                }
            }
        }
        assert!(compared > 60 * element.relative_dofs(), "{name}: {compared}");
    });
}

#[test]
fn force_alone_is_that_of_the_reaction() {
    for_each_sample(|name, element| {
        let mut random = Random(5);
        for _ in 0..50 {
            let (d, v) = state(&mut random);
            let rotation = spinning(&mut random);
            let full = element.reaction(&d, &v, &rotation);
            let mut alone = Reaction::default();
            element.force(&d, &v, &rotation, &mut alone);
            let size = full.force.iter().fold(1.0, |size: f64, f| size.max(f.abs()));
            for k in 0..6 {
                assert!((full.force[k] - alone.force[k]).abs() < 1e-9 * size, "{name}");
            }
            assert!(
                (full.elastic_energy - alone.elastic_energy).abs() < 1e-9 * full.elastic_energy.abs() + 1e-15
            );
        }
    });
}

/// Motion of rows and internal coordinates together.
#[derive(Clone)]
struct Together {
    q: Vec<f64>,
    rate: Vec<f64>,
    rows: usize,
}

impl Together {
    fn random(random: &mut Random, element: &dyn BearingElement, internal: &dyn InternalCoordinates) -> Self {
        let rows = element.relative_dofs() + internal.housing_dofs();
        let mut draw = |scale: f64| {
            (0..rows + internal.masses().len()).map(|_| scale * random.next()).collect::<Vec<f64>>()
        };
        Self { q: draw(8e-6), rate: draw(2e-3), rows }
    }

    fn rows(&self) -> Motion<'_> {
        Motion { position: &self.q[..self.rows], velocity: &self.rate[..self.rows] }
    }

    /// Forces on rows and coordinates, with the reaction.
    fn forces(&self, internal: &dyn InternalCoordinates, rotation: &Rotation) -> (Vec<f64>, Reaction) {
        let mut out = vec![0.0; self.q.len()];
        let (on_rows, on_coordinates) = out.split_at_mut(self.rows);
        let coordinates = Motion { position: &self.q[self.rows..], velocity: &self.rate[self.rows..] };
        let reaction = internal.forces(self.rows(), coordinates, rotation, on_rows, on_coordinates);
        (out, reaction)
    }
}

#[test]
fn internal_tangents_match_differences_and_power_balances() {
    for_each_with_internal(|name, element, internal| {
        let mut random = Random(23);
        let mut compared = 0;
        for _ in 0..40 {
            let start = Together::random(&mut random, element, internal);
            let rotation = spinning(&mut random);
            let coordinates =
                Motion { position: &start.q[start.rows..], velocity: &start.rate[start.rows..] };
            let tangent = internal.tangent(start.rows(), coordinates, &rotation);
            for column in 0..start.q.len() {
                let force = |by: f64, of_rate: bool| {
                    let mut moved = start.clone();
                    (if of_rate { &mut moved.rate } else { &mut moved.q })[column] += by;
                    moved.forces(internal, &rotation).0
                };
                for (of_rate, step, tolerance, tangent) in [
                    (false, 1e-10, 1e-4 * 1e8, &tangent.stiffness),
                    (true, 1e-6, 1e-4 * 1e4, &tangent.damping),
                ] {
                    let Some(found) = slope(|by| force(by, of_rate), step, tolerance) else { continue };
                    compared += 1;
                    for (row, found) in found.iter().enumerate() {
                        let expected = tangent[row][column];
                        assert!(
                            (found - expected).abs() < tolerance + 1e-4 * expected.abs(),
                            "{name}, rate {of_rate}: [{row}][{column}] is {expected}, by difference {found}"
                        );
                    }
                }
            }
            // Power to rows and coordinates, stored, lost and put in.
            let energy = |t: f64| {
                let q = start.q.iter().zip(&start.rate).map(|(q, v)| q + t * v).collect();
                let turned = Rotation {
                    cage_angle: rotation.cage_angle + t * rotation.cage_speed.unwrap(),
                    shaft_angle: rotation.shaft_angle + t * rotation.shaft_speed,
                    ..rotation
                };
                Together { q, ..start.clone() }.forces(internal, &turned).1.elastic_energy
            };
            let stored = (energy(1e-7) - energy(-1e-7)) / 2e-7;
            let (forces, out) = start.forces(internal, &rotation);
            let given: f64 = forces.iter().zip(&start.rate).map(|(f, v)| f * v).sum();
            let left = given + stored + out.dissipated_power - out.parametric_power;
            let size = given.abs() + stored.abs() + out.dissipated_power.abs();
            assert!(left.abs() < 1e-5 * size + 1e-9, "{name}: {left} W of {size}");
        }
        assert!(compared > 40 * internal.masses().len(), "{name}: {compared}");
    });
}

#[test]
fn implicit_step_solves_internal_coordinates_and_condenses_them() {
    let gain = NewmarkGain { position: 0.7 * 0.25 * 1e-5_f64.powi(2), velocity: 0.7 * 0.5e-5 };
    for_each_with_internal(|name, element, internal| {
        let (mut random, count) = (Random(9), internal.masses().len());
        let mut compared = 0;
        for _ in 0..60 {
            let start = Together::random(&mut random, element, internal);
            let (rotation, rows) = (spinning(&mut random), start.rows);
            let step = |state: &Together| {
                let (mut end, mut out) = (state.clone(), vec![0.0; rows + count]);
                let (mut stiffness, mut force_tangent) = (vec![0.0; rows * rows], vec![0.0; rows * count]);
                let (on_rows, force) = out.split_at_mut(rows);
                let coordinates = InternalStep {
                    position: &mut end.q[rows..],
                    velocity: &mut end.rate[rows..],
                    force,
                    force_tangent: &mut force_tangent,
                    stiffness: &mut stiffness,
                };
                internal.step(state.rows(), coordinates, &rotation, &gain, on_rows);
                (out, end, [stiffness, force_tangent].concat())
            };
            let (out, end, tangents) = step(&start);
            let (found, _) = end.forces(internal, &rotation);
            for (k, (found, given)) in found.iter().zip(&out).enumerate() {
                assert!(
                    (found - given).abs() < 1e-9 * (1.0 + given.abs()),
                    "{name}: force {k}, {found} {given}"
                );
            }
            for (k, mass) in internal.masses().iter().enumerate() {
                let acceleration = out[rows + k] / mass;
                let moved = end.q[rows + k] - start.q[rows + k];
                assert!((moved - gain.position * acceleration).abs() < 1e-19, "{name}: coordinate {k}");
            }
            for column in 0..rows {
                let force = |by: f64| {
                    let mut moved = start.clone();
                    moved.q[column] += by;
                    moved.rate[column] += by * gain.velocity / gain.position;
                    step(&moved).0
                };
                let tolerance = 1e-3 * 1e8;
                let Some(found) = slope(force, 1e-12, tolerance) else { continue };
                compared += 1;
                for (found, row) in found.iter().zip(tangents.chunks_exact(rows)) {
                    assert!((found - row[column]).abs() < tolerance, "{name}: {found} for {}", row[column]);
                }
            }
        }
        assert!(compared > 60, "{name}: {compared}");
    });
}

#[test]
fn internal_coordinates_in_equilibrium_give_the_static_force() {
    for_each_with_internal(|name, element, internal| {
        let mut random = Random(31);
        for _ in 0..50 {
            let (d, _) = state(&mut random);
            let rotation = at_rest(&mut random);
            let rows = element.relative_dofs() + internal.housing_dofs();
            let mut all =
                Together { q: vec![0.0; rows], rate: vec![0.0; rows + internal.masses().len()], rows };
            let relative = element.relative_dofs();
            all.q[..relative].copy_from_slice(&d[..relative]);
            let found = internal.equilibrium(&all.q, &rotation);
            all.q.extend(found);
            let (forces, _) = all.forces(internal, &rotation);
            let out = element.reaction(&d, &[0.0; 6], &rotation);
            let size = out.force.iter().fold(1.0, |size: f64, f| size.max(f.abs()));
            for (found, given) in forces.iter().zip(out.force).take(relative) {
                assert!((found - given).abs() < 1e-8 * size, "{name}: {found} {given}");
            }
            for force in &forces[rows..] {
                assert!(force.abs() < 1e-8 * size, "{name}: {force} N on a coordinate of {size} N");
            }
        }
    });
}
