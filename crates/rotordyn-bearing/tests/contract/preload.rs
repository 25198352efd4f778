//! Preload: the specified force is reached; tilt stiffness of pairs by arrangement.

use crate::ball_combinations::{angular, film};
use crate::bearing::rig_6205;
use rotordyn_bearing::contact::ContactLaw;
use rotordyn_bearing::{Arrangement, BallBearing, BallElement, BallInertia, Duplex, Preload, Rotation};

const SPEED: f64 = 1500.0;

fn close(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * b.abs()
}

#[test]
fn specified_preload_force_is_reached() {
    let still = Rotation { shaft_speed: SPEED, ..Rotation::default() };
    for law in [ContactLaw::Hertz, film()] {
        for inertia in [BallInertia::None, BallInertia::OuterRaceControl, BallInertia::Shared] {
            for base in [angular(), rig_6205()] {
                for direction in [1.0, -1.0] {
                    let mut bearing = BallBearing { contact: law.clone(), inertia, ..base.clone() };
                    bearing.geometry.thrust_direction = direction;
                    bearing.preload = Preload::Force(250.0);
                    let element = BallElement::new(&bearing);
                    let state = element.preload_state(SPEED);
                    assert!(close(state.axial_force, 250.0, 1e-10), "{law:?} {inertia:?}: {state:?}");
                    let found = element.reaction(&[0.0; 6], &[0.0; 6], &still).force;
                    assert!(close(found[2], -250.0 * direction, 1e-10), "{found:?}");

                    // With spring preload the axial force is F₀ − k e at offset e.
                    bearing.preload = Preload::Spring { stiffness: 2e6, force: 250.0 };
                    let element = BallElement::new(&bearing);
                    let state = element.preload_state(SPEED);
                    assert!(close(state.axial_force, 250.0 - 2e6 * state.offset, 1e-9), "{state:?}");
                    let moved = [0.0, 0.0, 5e-6, 0.0, 0.0, 0.0];
                    let reaction = element.reaction(&moved, &[0.0; 6], &still);
                    let stiffness = (reaction.force[2] + state.axial_force * direction) / -5e-6;
                    assert!(stiffness > 0.0 && stiffness < 2e6, "softer than the spring: {stiffness}");
                }
            }
        }
    }
}

/// The preload of a tandem pair is that of both rows, those of other pairs press against each other with the whole of it: the
/// centred pair carries the stated force outwards, or none; a soft spring is the axial stiffness.
#[test]
fn rows_in_tandem_share_the_preload() {
    let still = Rotation { shaft_speed: SPEED, ..Rotation::default() };
    for (arrangement, outwards) in
        [(Arrangement::Tandem, 400.0), (Arrangement::BackToBack, 0.0), (Arrangement::FaceToFace, 0.0)]
    {
        let pair = Duplex { arrangement, spacing: 0.016 };
        let of = |preload| {
            let bearing = BallBearing { duplex: Some(pair), preload, ..angular() };
            let direction = bearing.geometry.thrust_direction;
            (BallElement::new(&bearing), direction)
        };
        let (element, direction) = of(Preload::Force(400.0));
        let state = element.preload_state(SPEED);
        assert!(close(state.axial_force, 400.0, 1e-9), "{arrangement:?}: {state:?}");
        let force = element.reaction(&[0.0; 6], &[0.0; 6], &still).force[2];
        assert!((force + direction * outwards).abs() < 1e-6, "{arrangement:?}: {force}");

        let spring = 1e4;
        let (element, direction) = of(Preload::Spring { stiffness: spring, force: 400.0 });
        let at = |z: f64| element.reaction(&[0.0, 0.0, z, 0.0, 0.0, 0.0], &[0.0; 6], &still);
        let rows = if arrangement == Arrangement::Tandem { 1.0 } else { 2.0 };
        let stiffness = at(0.0).stiffness[2][2];
        assert!(close(stiffness, rows * spring, 0.01), "{arrangement:?}: {stiffness}");
        let difference = (at(1e-7).force[2] - at(-1e-7).force[2]) / -2e-7;
        assert!(close(difference, stiffness, 1e-3), "{arrangement:?}: {difference}");
        let force = at(0.0).force[2] + direction * outwards;
        assert!(force.abs() < 0.01 * 400.0, "{arrangement:?}: {force}");
    }
}

#[test]
fn film_adds_to_dry_preload_force() {
    let bearing = BallBearing { contact: film(), preload: Preload::DryForce(250.0), ..angular() };
    let element = BallElement::new(&bearing);
    let (rest, fast) = (element.preload_state(0.0), element.preload_state(SPEED));
    assert!(close(rest.axial_force, 250.0, 1e-10));
    assert!(fast.offset == rest.offset && fast.axial_force > 300.0, "the film adds to it: {fast:?}");
}

#[test]
fn stiff_spring_is_rigid_and_zero_stiffness_keeps_force() {
    let still = Rotation::default();
    let d = [2e-6, -1e-6, 3e-6, 1e-4, 5e-5, 0.0];
    let with =
        |preload| BallElement::new(&BallBearing { preload, ..angular() }).reaction(&d, &[0.0; 6], &still);
    let stiff = with(Preload::Spring { stiffness: 1e15, force: 1e15 * 5e-6 });
    let rigid = with(Preload::Interference(5e-6));
    let loose = with(Preload::Spring { stiffness: 0.0, force: 250.0 });
    for a in 0..5 {
        assert!((stiff.force[a] - rigid.force[a]).abs() < 1e-5 * (1.0 + rigid.force[a].abs()));
        for b in 0..5 {
            let size = (rigid.stiffness[a][a] * rigid.stiffness[b][b]).sqrt();
            assert!((stiff.stiffness[a][b] - rigid.stiffness[a][b]).abs() < 1e-5 * size);
        }
        assert!(loose.stiffness[2][a].abs() < 1e-6 * rigid.stiffness[2][2]);
    }
    assert!(close(loose.force[2], -250.0, 1e-10));
}

#[test]
fn back_to_back_tilt_stiffness_exceeds_face_to_face() {
    let reaction = |arrangement: Option<Arrangement>| {
        let duplex = arrangement.map(|arrangement| Duplex { arrangement, spacing: 15e-3 });
        // 250 N in every row: those in tandem share the preload of the pair.
        let force = if arrangement == Some(Arrangement::Tandem) { 500.0 } else { 250.0 };
        let bearing = BallBearing { duplex, preload: Preload::DryForce(force), ..angular() };
        BallElement::new(&bearing).cage_average(&[0.0; 6], &Rotation::default(), 12)
    };
    let single = reaction(None);
    let back = reaction(Some(Arrangement::BackToBack));
    let face = reaction(Some(Arrangement::FaceToFace));
    let tandem = reaction(Some(Arrangement::Tandem));
    assert!(
        back.stiffness[3][3] > 2.0 * face.stiffness[3][3],
        "{} {}",
        back.stiffness[3][3],
        face.stiffness[3][3]
    );
    // Opposed rows cancel axially; tandem rows add.
    assert!(back.force[2].abs() < 1e-9 && face.force[2].abs() < 1e-9);
    assert!(close(tandem.force[2], 2.0 * single.force[2], 1e-12) && close(single.force[2], -250.0, 1e-10));
    for pair in [&back, &face, &tandem] {
        // Axial and radial stiffness of two rows for any arrangement.
        for k in 0..3 {
            assert!(close(pair.stiffness[k][k], 2.0 * single.stiffness[k][k], 1e-9));
        }
    }
    // Two rows h off the station with K_tilt and K_cross: Σ K_tt ± 2 h K_xt + h² K_xx.
    let (h, k) = (7.5e-3, &single.stiffness);
    let expected = 2.0 * (k[3][3] + h * h * k[1][1] + 2.0 * h * k[1][3].abs());
    assert!(close(back.stiffness[3][3], expected, 1e-9), "{} {expected}", back.stiffness[3][3]);
    let loads = BallElement::new(&BallBearing {
        duplex: Some(Duplex { arrangement: Arrangement::BackToBack, spacing: 15e-3 }),
        preload: Preload::DryForce(250.0),
        ..angular()
    })
    .ball_loads(&[0.0; 6], &Rotation::default());
    assert!(loads.len() == 18 && loads.iter().filter(|b| b.row == 1).count() == 9);
    assert!(loads.iter().all(|b| b.load > 0.0 && (b.contact_angle > 0.0) == (b.row == 0)));
}

#[test]
fn invalid_combinations_are_reported() {
    assert!(angular().problems().is_empty());
    let bad = BallBearing {
        preload: Preload::Spring { stiffness: -1.0, force: 1.0 },
        duplex: Some(Duplex { arrangement: Arrangement::Tandem, spacing: 0.0 }),
        ..angular()
    };
    assert_eq!(bad.problems().len(), 2);
}
