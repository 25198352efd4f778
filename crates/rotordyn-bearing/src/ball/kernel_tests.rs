//! The SIMD kernel of a row against the sum ball by ball.

use super::ring_motion::RingMotion;
use super::row::Row;
use crate::contact::{ContactDamping, ContactLaw};
use crate::material::Material;
use crate::{
    BallBearing, BallGeometry, BallInertia, BallWave, Cage, Defect, DefectForm, DefectLaw, Fit,
    Imperfections, OffSize, Preload, Rotation, Shape, Surface, Wave,
};

fn bearing(balls: usize, contact_angle: f64, imperfections: Imperfections) -> BallBearing {
    let steel = Material { name: "steel".into(), young: 207e9, shear: 80e9, poisson: 0.3, density: 7850.0 };
    BallBearing {
        geometry: BallGeometry {
            balls,
            ball_diameter: 7.9e-3,
            pitch_diameter: 38.5e-3,
            inner_groove_radius: 4.09e-3,
            outer_groove_radius: 4.17e-3,
            radial_clearance: 10e-6,
            contact_angle,
            thrust_direction: 1.0,
            moment_arm: None,
            bore: 25e-3,
            outside_diameter: 52e-3,
            width: 15e-3,
        },
        ball_material: steel.clone(),
        ring_material: steel,
        contact: ContactLaw::Hertz,
        contact_stiffness: Default::default(),
        damping: ContactDamping::Constant { coefficient: 300.0, ramp: 2e-6 },
        inertia: BallInertia::None,
        preload: Preload::None,
        duplex: None,
        fit: Fit::default(),
        cage: Cage::Rolling,
        cage_angle: 0.3,
        imperfections,
        cage_pocket_diameter: 8.1e-3,
        service: Default::default(),
        estimated_geometry: None,
    }
}

/// Waves of races and balls, sizes and defects on all of them.
fn imperfections(law: DefectLaw) -> Imperfections {
    let wave = |order| Wave { order, amplitude: 3e-6 / order as f64, phase: order as f64 };
    let defect = |surface, start| Defect {
        surface,
        row: None,
        start,
        width: 2e-3,
        form: DefectForm::Dent { depth: Some(4e-6), shape: Shape::HalfSine },
    };
    Imperfections {
        inner_waviness: (2..=11).map(wave).collect(),
        outer_waviness: vec![wave(8), wave(1)],
        ball_waviness: vec![BallWave { ball: Some(1), wave: wave(2) }],
        off_size: vec![OffSize { ball: 2, row: None, diameter_difference: 1.5e-6 }],
        defects: vec![
            defect(Surface::Outer, 4.0),
            defect(Surface::Inner, 1.0),
            defect(Surface::Ball(0), 2.0),
        ],
        law,
        ..Default::default()
    }
}

/// The sum ball by ball, whose tangents are those of `massless::ball_force`.
#[test]
fn force_and_tangents_are_those_of_the_sum_ball_by_ball() {
    let mut seed = 3_u64;
    let mut random = |scale: f64| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        scale * ((seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
    };
    let laws = [DefectLaw::Displacement, DefectLaw::UndampedDisplacement];
    let cases = laws.map(imperfections).into_iter().chain([Imperfections::default()]);
    let mut loaded = 0;
    for case in cases.flat_map(|imperfections| {
        [(3, 0.0), (8, 0.0), (9, 0.35), (17, 0.2)].map(|(z, a)| bearing(z, a, imperfections.clone()))
    }) {
        let row = Row::new(&case, 0, 1.0);
        for _ in 0..200 {
            let d = [15e-6, 15e-6, 40e-6, 5e-4, 5e-4, 0.0].map(&mut random);
            // Fast enough that damping opens some contacts.
            let v = [0.02, 0.02, 0.02, 0.5, 0.5, 0.0].map(&mut random);
            let rotation = Rotation {
                cage_angle: random(9.0),
                cage_speed: Some(random(300.0)),
                shaft_angle: random(20.0),
                shaft_speed: random(800.0),
            };
            let orbit = rotation.cage_speed.unwrap_or(0.0);
            let ring = RingMotion {
                d: &d,
                v: &v,
                rotation: &rotation,
                cage_speed: Some(orbit),
                orbit,
                with_defects: true,
            };
            let (expected, found) = (row.sum(&ring, &row.operating(&ring)), row.sum_at(&ring));
            let alone = row.force(&ring).unwrap_or_default();
            let size = expected.load + 10.0;
            loaded += usize::from(expected.load > 0.0);
            let near = |found: f64, expected: f64, size: f64| {
                assert!((found - expected).abs() <= 1e-12 * size, "{found} instead of {expected}")
            };
            near(found.load, expected.load, size);
            near(alone.load_cos, expected.load_cos, size);
            let [expected, found] = [expected, found].map(|sum| sum.reaction(row.arm, orbit));
            for a in 0..6 {
                near(found.force[a], expected.force[a], size);
                near(alone.force[a], expected.force[a], size);
                for b in 0..6 {
                    near(found.stiffness[a][b], expected.stiffness[a][b], 1e8);
                    near(found.damping[a][b], expected.damping[a][b], 1e3);
                }
            }
            for (alone, [found, expected]) in [
                (alone.energy, [found, expected].map(|r| r.elastic_energy)),
                (alone.power, [found, expected].map(|r| r.parametric_power)),
                (alone.dissipated, [found, expected].map(|r| r.dissipated_power)),
            ] {
                near(found, expected, size);
                near(alone, expected, size);
            }
        }
    }
    assert!(loaded > 1500, "{loaded}");
}

/// Neither a contact without distance nor a row without load gives NaN; a position that is not a number does.
#[test]
fn unloaded_rows_are_zero_and_nan_stays() {
    let row = Row::new(&bearing(9, 0.0, Imperfections::default()), 0, 1.0);
    let at = |d: [f64; 6]| {
        let rotation = Rotation::default();
        let ring = RingMotion { cage_speed: Some(0.0), ..RingMotion::at_rest(&d, &rotation, 0.0, true) };
        row.sum_at(&ring).reaction(row.arm, 0.0)
    };
    let still = at([0.0; 6]);
    assert!(still.force == [0.0; 6] && still.stiffness == [[0.0; 6]; 6]);
    // The inner groove centre of ball 0 on the outer one.
    let coincident = at([-(4.09e-3 + 4.17e-3 - 7.9e-3 - 5e-6), 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert!(coincident.force.iter().chain(coincident.stiffness.as_flattened()).all(|f| f.is_finite()));
    assert!(coincident.force[0] > 0.0);
    assert!(at([f64::NAN, 0.0, 0.0, 0.0, 0.0, 0.0]).force[0].is_nan());
}
