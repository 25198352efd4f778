//! Distances of free balls by parry against their closed forms, and the pairs that rapier detects.

use crate::agree;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::free_balls::{ball_bearing, free, geometry_6205, plastic_cage, rings, touch};
use crate::parry_distance::Random;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::{Ball, TriMesh};
use rotordyn::bearing::OffSize;
use rotordyn::bearing::free_ball::{
    BallBody, CageBody, ClosedForms, ContactPart, FreeBallBearing, FreeBallState, FreeBalls, GrooveSurface,
    Guidance, Land, Pocket, Proximity, RingState, SlipModel,
};
use rotordyn::contact::Race;
use rotordyn::geometry::parry::ParryDistances;
use rotordyn::geometry::rapier::{BodyCollisions, overlaps};

type V = nalgebra::Vector3<f64>;

/// Vector with coordinates in [−size, size).
fn random_vector(random: &mut Random, size: f64) -> V {
    V::new(random.next(), random.next(), random.next()) * size
}

/// A 6205 with balls of different size and a cage; without one full of balls, 66 um apart.
fn bearing(cage: Option<(Pocket, Guidance)>) -> FreeBallBearing {
    let mut ball = ball_bearing(geometry_6205(if cage.is_some() { 9 } else { 15 }, 10e-6));
    ball.imperfections.off_size = vec![OffSize { row: None, ball: 3, diameter_difference: 4e-6 }];
    let mut bearing = free(ball, 0.06, 1e-2, SlipModel::Centre);
    bearing.cage = cage.map(|(pocket, guidance)| plastic_cage(pocket, guidance, 0.1));
    bearing
}

fn land(race: Race) -> Guidance {
    let radius = if race == Race::Inner { 17e-3 - 0.1e-3 } else { 21.5e-3 + 0.1e-3 };
    Guidance::Land(Land { race, radius, clearance: 0.1e-3, width: 10e-3, contact: touch(1e6, 1.0, 0.1) })
}

fn bearings() -> Vec<FreeBalls> {
    let closed = Pocket::Closed { radial_clearance: 2e-5 };
    let cages = [
        Some((Pocket::Cylindrical, land(Race::Outer))),
        Some((Pocket::Spherical, land(Race::Inner))),
        Some((closed, Guidance::Balls)),
        None,
    ];
    cages.into_iter().map(|cage| FreeBalls::new(bearing(cage), 0.0).unwrap()).collect()
}

/// Balls, cage and rings about their centred places: balls displaced by `size` \[m\], axially also by `axial`.
fn random_state(
    balls: &FreeBalls,
    random: &mut Random,
    size: f64,
    axial: f64,
) -> (FreeBallState, [RingState; 2]) {
    let radius = 0.5 * balls.bearing().ball.geometry.pitch_diameter;
    let count = balls.ball_radii().len();
    let turn = 3.0 * random.next();
    let bodies: Vec<BallBody> = (0..count)
        .map(|j| {
            let (sin, cos) = (turn + TAU * j as f64 / count as f64).sin_cos();
            let position =
                V::new(radius * cos, radius * sin, axial * random.next()) + random_vector(random, size);
            BallBody { position, ..BallBody::default() }
        })
        .collect();
    let cage = CageBody::rotating(random_vector(random, size), V::zeros(), turn, 0.0, 1e-6);
    let mut state = FreeBallState::new(&bodies, balls.bearing().cage.as_ref().map(|_| &cage));
    let tilt = [1e-3 * random.next(), 1e-3 * random.next()];
    if let Some(cage) = state.values.get_mut(9 * count + 6..9 * count + 10) {
        cage[1] += tilt[0];
        cage[2] += tilt[1];
        let length = cage.iter().map(|q| q * q).sum::<f64>().sqrt();
        cage.iter_mut().for_each(|q| *q /= length);
    }
    let ring = |random: &mut Random| RingState {
        position: random_vector(random, size).into(),
        tilt: [1e-3 * random.next(), 1e-3 * random.next()],
        angle: random.next(),
        ..RingState::default()
    };
    let [inner, outer] = [ring(random), ring(random)];
    (state, [inner, outer])
}

/// The row of the table that a pair belongs to.
fn row(balls: &FreeBalls, pair: &Proximity, shoulder: bool) -> &'static str {
    match (pair.parts[1], balls.bearing().cage.map(|cage| cage.pocket)) {
        (ContactPart::InnerRace | ContactPart::OuterRace, _) if shoulder => "edge of a shoulder",
        (ContactPart::InnerRace, _) => "inner groove",
        (ContactPart::OuterRace, _) => "outer groove",
        (ContactPart::Pocket(_), Some(Pocket::Cylindrical)) => "cylindrical pocket",
        (ContactPart::Pocket(_), Some(Pocket::Spherical)) => "spherical pocket",
        (ContactPart::Pocket(_), _) => "closed pocket",
        (ContactPart::InnerLand, _) => "inner land",
        (ContactPart::OuterLand, _) => "outer land",
        _ => "ball and ball",
    }
}

/// The table of `geometry::rapier`: worst difference of distance \[m\] and normal \[-\] over random places near contact.
///
/// Places of 20 mm have a last bit of 3.5e-18 m; a dozen roundings of poses and projections give 1e-17 m.
#[test]
fn distances_of_parry_equal_the_closed_forms() {
    let mut random = Random(1);
    let mut worst: BTreeMap<&str, [f64; 3]> = BTreeMap::new();
    for balls in bearings() {
        for (axial, shoulder, count) in [(0.0, false, 400), (3.5e-3, true, 400)] {
            for _ in 0..count {
                let (state, rings) = random_state(&balls, &mut random, 1e-4, axial);
                let closed = balls.proximities(&ClosedForms, &state, &rings, 1.0);
                let by_shapes = balls.proximities(&ParryDistances, &state, &rings, 1.0);
                assert_eq!(closed.len(), by_shapes.len());
                for (exact, found) in closed.iter().zip(&by_shapes) {
                    assert_eq!(exact.parts, found.parts);
                    let on_race = matches!(exact.parts[1], ContactPart::InnerRace | ContactPart::OuterRace);
                    // Balls far along the axis belong to the shoulders' row alone.
                    let near = exact.approach.depth.abs() < if shoulder { 1e-3 } else { 2e-4 };
                    let beyond = on_race && is_beyond_shoulder(&balls, exact, &state, &rings);
                    if !near || shoulder && !beyond || !shoulder && beyond {
                        continue;
                    }
                    let [distance, normal, pairs] = worst.entry(row(&balls, exact, shoulder)).or_default();
                    *distance = distance.max((exact.approach.depth - found.approach.depth).abs());
                    *normal = normal.max((exact.approach.normal - found.approach.normal).norm());
                    *pairs += 1.0;
                }
            }
        }
    }
    for (name, [distance, normal, pairs]) in &worst {
        println!("{name:20} {distance:.1e} m, normal {normal:.1e}, {pairs} pairs");
    }
    assert_eq!(worst.len(), 9);
    for (name, [distance, normal, pairs]) in &worst {
        assert!(*pairs > 100.0, "{name}: {pairs}");
        agree::absolute(format_args!("{name}: distance, largest difference [m]"), *distance, 0.0, 2e-17);
        agree::absolute(format_args!("{name}: normal, largest difference"), *normal, 0.0, 1e-12);
    }
}

/// Whether a ball lies beyond the angle of the groove's shoulders.
fn is_beyond_shoulder(
    balls: &FreeBalls,
    pair: &Proximity,
    state: &FreeBallState,
    rings: &[RingState; 2],
) -> bool {
    let ContactPart::Ball(j) = pair.parts[0] else { return false };
    let k = usize::from(pair.parts[1] == ContactPart::OuterRace);
    let (groove, at) = (balls.grooves()[k], rings[k].placement());
    let from_ring = state.ball(j).position - at.centre;
    let height = from_ring.dot(&at.axes[2]);
    let rho = (from_ring - height * at.axes[2]).norm();
    let [radial, axial] = [groove.side * (groove.centre_radius - rho), groove.axial - height];
    radial < groove.shoulder[0] * radial.hypot(axial)
}

/// A groove as a mesh of triangles errs by the sagitta of its facets, ten thousand times a micrometre's rounding.
#[test]
fn triangle_mesh_of_a_groove_is_not_accurate_enough() {
    let balls = FreeBalls::new(bearing(None), 0.0).unwrap();
    let GrooveSurface { side, centre_radius, radius, shoulder: [cos, sin], .. } = balls.grooves()[0];
    let half = sin.atan2(cos);
    let (around, across) = (1440u32, 96u32);
    let mut vertices = Vec::new();
    for k in 0..around {
        let (s, c) = (TAU * f64::from(k) / f64::from(around)).sin_cos();
        for l in 0..=across {
            let angle = half * (2.0 * f64::from(l) / f64::from(across) - 1.0);
            let rho = centre_radius - side * radius * angle.cos();
            vertices.push(Vector::new(rho * c, rho * s, radius * angle.sin()));
        }
    }
    let mut triangles = Vec::new();
    for k in 0..around {
        let [this, next] = [k, (k + 1) % around].map(|k| k * (across + 1));
        for l in 0..across {
            triangles.push([this + l, next + l, next + l + 1]);
            triangles.push([this + l, next + l + 1, this + l + 1]);
        }
    }
    let count = triangles.len();
    let mesh = TriMesh::new(vertices, triangles).unwrap();
    let ball_radius = balls.ball_radii()[0];
    let mut random = Random(3);
    let mut worst: f64 = 0.0;
    for _ in 0..20 {
        let (state, _) = random_state(&balls, &mut random, 2e-5, 0.0);
        let centre = state.ball(0).position;
        let exact = balls.proximities(&ClosedForms, &state, &rings(0.0, 0.0), 1.0);
        let exact = exact.iter().find(|pair| pair.parts == [ContactPart::Ball(0), ContactPart::InnerRace]);
        let at = Pose::from_translation(Vector::new(centre.x, centre.y, centre.z));
        let found = query::contact(&Pose::IDENTITY, &mesh, &at, &Ball::new(ball_radius), 1e-3);
        let found = found.unwrap().unwrap();
        worst = worst.max((exact.unwrap().approach.depth + found.dist).abs());
    }
    println!("mesh of {count} triangles: {worst:.1e} m");
    assert!(worst > 1e-8, "{worst:e}");
    agree::absolute("depth in a mesh of the race, off the closed form [m]", worst, 0.0, 1e-6);
}

/// rapier's broad and narrow phase find the pairs of the closed forms, none besides, at the same distance.
#[test]
fn detected_pairs_are_those_of_the_closed_forms() {
    let margin = 5e-5;
    for balls in bearings() {
        let mut random = Random(5);
        let mut bodies = BodyCollisions::new(&balls, margin);
        let (mut pairs, mut overlapping) = (0, 0);
        for _ in 0..200 {
            let (state, rings) = random_state(&balls, &mut random, 1e-4, 0.0);
            let mut closed = balls.proximities(&ClosedForms, &state, &rings, margin);
            let found = bodies.detect(&state, &rings);
            // Neighbouring balls are listed in the order of their numbers.
            for pair in closed.iter_mut().filter(|pair| pair.parts[0] > pair.parts[1]) {
                pair.parts.swap(0, 1);
                pair.approach.normal = -pair.approach.normal;
            }
            closed.sort_by(|a, b| a.parts.cmp(&b.parts).then(a.approach.depth.total_cmp(&b.approach.depth)));
            let names = |all: &[Proximity]| all.iter().map(|pair| pair.parts).collect::<Vec<_>>();
            assert_eq!(names(&closed), names(&found));
            for (exact, found) in closed.iter().zip(&found) {
                let normal = (exact.approach.normal - found.approach.normal).norm();
                let depth = exact.approach.depth - found.approach.depth;
                // Bodies are stored as unit quaternions: an angle of 2e-16 at 20 mm.
                agree::absolute("depth of an overlap, difference [m]", depth, 0.0, 5e-17);
                agree::absolute("normal of an overlap, difference", normal, 0.0, 1e-10);
                pairs += 1;
                overlapping += usize::from(exact.approach.depth > 0.0);
            }
        }
        println!("{pairs} pairs, {overlapping} overlapping");
        assert!(overlapping > 100 && pairs > overlapping);
    }
}

/// The kinematic start has no overlap; a ball moved into the next one is found, which the closed forms of a caged bearing
/// do not look for.
#[test]
fn overlaps_at_the_start_are_found_by_shapes() {
    let balls = FreeBalls::new(bearing(Some((Pocket::Cylindrical, land(Race::Outer)))), 0.0).unwrap();
    let at = rings(100.0, 0.0);
    let mut state = balls.initial_state(&at).unwrap();
    assert_eq!(overlaps(&balls, &state, &at, 1e-6), []);
    // Ball 1 along its orbit until its centre is 7.9 mm from that of the next.
    let [first, next] = [0, 1].map(|j| state.ball(j).position);
    let turn = next.y.atan2(next.x) - first.y.atan2(first.x) - 2.0 * (0.5 * 7.9e-3 / next.norm()).asin();
    let (sin, cos) = turn.sin_cos();
    state.values[0] = first.x * cos - first.y * sin;
    state.values[1] = first.x * sin + first.y * cos;
    let found: Vec<String> = overlaps(&balls, &state, &at, 1e-6).iter().map(ToString::to_string).collect();
    println!("{found:?}");
    assert!(found.contains(&"ball 1 and ball 2 overlap by 0.0380 mm".to_string()), "{found:?}");
    assert!(found.iter().any(|text| text.starts_with("ball 1 and cage pocket 1")), "{found:?}");
}

/// A run with every distance by parry is the run by closed forms: 1e-17 m of 1 um of approach is 1e-11 of the forces.
#[test]
fn run_by_parry_equals_the_run_by_closed_forms() {
    for balls in bearings() {
        let mut loaded = balls.bearing().clone();
        loaded.ball.geometry.radial_clearance = -4e-6;
        loaded.gravity = [0.0, -9.80665, 0.0];
        loaded.damping = 1.0;
        let balls = FreeBalls::new(loaded, 0.0).unwrap();
        let at = [rings(500.0, 0.0), rings(500.0, 2e-3)];
        let start = balls.initial_state(&at[0]).unwrap();
        let [mut closed, mut by_shapes] = [start.clone(), start];
        let one = balls.advance(&mut closed, [&at[0], &at[1]], 2e-3, 1e-6).unwrap();
        let other =
            balls.advance_with(&ParryDistances, &mut by_shapes, [&at[0], &at[1]], 2e-3, 1e-6).unwrap();
        let difference = |a: &[f64], b: &[f64]| {
            let scale = a.iter().map(|x| x.abs()).fold(0.0, f64::max);
            a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
        };
        let values = difference(&closed.values, &by_shapes.values);
        let losses = difference(&one.losses, &other.losses);
        println!("state {values:.1e}, losses {losses:.1e}");
        agree::curve("state after 2 ms, by closed forms and by shapes", values, 1.0, 1e-9);
        agree::curve("losses after 2 ms, by closed forms and by shapes", losses, 1.0, 1e-9);
        assert!(closed.values != by_shapes.values);
    }
}
