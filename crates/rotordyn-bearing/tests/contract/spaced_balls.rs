//! Balls at given angles: evenly spaced they are the bearing with a cage; tangents follow the force.

use crate::ball_combinations::angular;
use crate::bearing::rig_6205;
use rotordyn_bearing::{BallBearing, BallElement, BearingElement, OffSize, Preload, Rotation, SpacedBalls};
use std::f64::consts::TAU;

const D: [f64; 6] = [7e-6, -9e-6, 3e-6, 1e-4, -2e-4, 0.0];
const V: [f64; 6] = [1e-3, 2e-3, -1e-3, 1e-2, 2e-2, 0.0];

/// Angles of all balls over a shaft that turns by 1 rad, the cage by 0.4 rad from 0.3 rad, each with an offset.
fn spaced(bearing: &BallBearing, offset: impl Fn(usize) -> f64) -> SpacedBalls {
    let balls = bearing.geometry.balls;
    let at = |cage: f64| (0..balls).map(|j| cage + TAU * j as f64 / balls as f64 + offset(j)).collect();
    SpacedBalls::new(bearing, vec![2.0, 3.0], vec![at(0.3), at(0.7)]).unwrap()
}

fn rotation() -> Rotation {
    Rotation { cage_angle: 0.4, cage_speed: Some(40.0), shaft_angle: 2.25, shaft_speed: 100.0 }
}

#[test]
fn evenly_spaced_balls_are_those_in_a_cage() {
    let mut preloaded = angular();
    preloaded.preload = Preload::DryForce(250.0);
    let mut off_size = rig_6205();
    off_size.imperfections.off_size = vec![OffSize { row: None, ball: 7, diameter_difference: 4e-6 }];
    for bearing in [rig_6205(), preloaded, off_size] {
        let row = BallElement::new(&bearing).reaction(&D, &V, &rotation());
        let own = spaced(&bearing, |_| 0.0).reaction(&D, &V, &rotation());
        let scale = row.force[1].abs();
        for a in 0..6 {
            // The offset of the preload is found to 1e-10 of the force.
            assert!(
                (own.force[a] - row.force[a]).abs() < 1e-8 * scale,
                "{a} {:?} {:?}",
                own.force,
                row.force
            );
            for b in 0..6 {
                let [k, c] = [[own.stiffness, row.stiffness], [own.damping, row.damping]]
                    .map(|[own, row]| (own[a][b] - row[a][b]).abs() / row[b][b].abs().max(row[0][0].abs()));
                assert!(k < 1e-7 && c < 1e-7, "{a} {b} {k:e} {c:e}");
            }
        }
        assert!((own.mean_cos - row.mean_cos).abs() < 1e-2);
    }
}

/// A ball moved towards the load carries more of it, and the stiffness is the difference quotient of the force.
#[test]
fn uneven_spacing_changes_the_force_and_its_tangent() {
    let bearing = rig_6205();
    let even = spaced(&bearing, |_| 0.0).reaction(&D, &[0.0; 6], &rotation());
    let uneven = spaced(&bearing, |j| if j % 2 == 0 { 0.02 } else { -0.02 });
    let found = uneven.reaction(&D, &[0.0; 6], &rotation());
    assert!((found.force[1] / even.force[1] - 1.0).abs() > 1e-4, "{:?} {:?}", found.force, even.force);
    for b in 0..2 {
        let [mut below, mut above] = [D; 2];
        below[b] -= 1e-9;
        above[b] += 1e-9;
        let [below, above] = [below, above].map(|d| uneven.reaction(&d, &[0.0; 6], &rotation()).force);
        for a in 0..2 {
            let quotient = (below[a] - above[a]) / 2e-9;
            assert!((quotient - found.stiffness[a][b]).abs() < 1e-4 * found.stiffness[b][b], "{a} {b}");
        }
    }
}

#[test]
fn angles_that_do_not_fit_are_refused() {
    let bearing = rig_6205();
    let balls = bearing.geometry.balls;
    let refused = |shaft: Vec<f64>, rows: Vec<Vec<f64>>| SpacedBalls::new(&bearing, shaft, rows).is_none();
    assert!(refused(vec![0.0, 0.0], vec![vec![0.0; balls]; 2]), "a shaft that stands");
    assert!(refused(vec![0.0, 1.0], vec![vec![0.0; balls - 1]; 2]), "a ball without angle");
    assert!(refused(vec![0.0], vec![vec![0.0; balls]]), "one angle of the shaft");
}
