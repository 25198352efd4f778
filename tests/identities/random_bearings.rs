//! Random ball bearings under any load at any speed: an equilibrium, and its stiffness by differences.

use crate::speed_dependent_bearings::spindle;
use rotordyn::analysis::bearing_stiffness::{BearingEquilibrium, BearingSolver, Condition};
use rotordyn::analysis::equilibrium::CageTreatment;
use rotordyn::bearing::rating::LoadRating;
use rotordyn::bearing::{
    Arrangement, BallBearing, BallGeometry, BallInertia, Bearing, Cage, Duplex, Fit, Preload,
};
use rotordyn::contact::{ContactDamping, ContactLaw, Lubricant};
use rotordyn::element::Material;
use rotordyn::model::study::EquilibriumStudy;
use rotordyn::study::Machine;
use std::f64::consts::{PI, TAU};

pub struct Random(pub u64);

impl Random {
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * ((self.0 >> 33) as f64 / (1u64 << 31) as f64)
    }

    fn pick<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.between(0.0, of.len() as f64) as usize].clone()
    }
}

fn steel() -> Material {
    Material { name: "steel".into(), young: 207e9, shear: 207e9 / 2.6, poisson: 0.3, density: 7850.0 }
}

/// A bearing of random size, contact angle, clearance, arrangement and fit, with inertia of any control.
pub fn bearing(random: &mut Random) -> BallBearing {
    let d = 10f64.powf(random.between(-2.5, -1.5));
    let balls = random.between(6.0, 24.0) as usize;
    let pitch = d / (PI / balls as f64).sin() * random.between(1.05, 1.5);
    let angular = random.between(0.0, 1.0) < 0.6;
    let contact_angle = if angular { random.between(0.2, 0.75) } else { 0.0 };
    let clearance = if angular { 0.0 } else { random.between(-4e-4, 2e-3) * d };
    let pair = [Arrangement::BackToBack, Arrangement::FaceToFace, Arrangement::Tandem];
    let duplex = angular && random.between(0.0, 1.0) < 0.5;
    let fit = random.between(0.0, 1.0) < 0.3;
    BallBearing {
        geometry: BallGeometry {
            balls,
            ball_diameter: d,
            pitch_diameter: pitch,
            inner_groove_radius: random.between(0.508, 0.54) * d,
            outer_groove_radius: random.between(0.508, 0.54) * d,
            radial_clearance: clearance,
            contact_angle,
            thrust_direction: random.pick(&[1.0, -1.0]),
            moment_arm: None,
            bore: pitch - 2.2 * d,
            outside_diameter: pitch + 2.2 * d,
            width: 1.8 * d,
        },
        ball_material: steel(),
        ring_material: steel(),
        contact: ContactLaw::Hertz,
        contact_stiffness: Default::default(),
        damping: ContactDamping::Constant { coefficient: 300.0, ramp: 1e-6 },
        inertia: random.pick(&[
            BallInertia::OuterRaceControl,
            BallInertia::InnerRaceControl,
            BallInertia::HarrisInnerRaceControl,
            BallInertia::Shared,
            BallInertia::Centrifugal,
            BallInertia::CentrifugalForce(5e4 * d * d),
        ]),
        preload: if duplex { Preload::Interference(random.between(0.0, 5e-4) * d) } else { Preload::None },
        duplex: duplex
            .then(|| Duplex { arrangement: random.pick(&pair), spacing: random.between(1.5, 6.0) * d }),
        fit: Fit {
            shaft_interference: if fit { 5e-4 * d } else { 0.0 },
            speed_growth: fit,
            ..Fit::default()
        },
        cage: Cage::Rolling,
        cage_angle: random.between(0.0, 3.0),
        imperfections: Default::default(),
        cage_pocket_diameter: 1.02 * d,
        service: Default::default(),
        estimated_geometry: None,
    }
}

/// An oil of 5 to 100 mPa s.
pub fn random_oil(random: &mut Random) -> Lubricant {
    let viscosity = 5e-3 * 10f64.powf(random.between(0.0, 1.3));
    Lubricant { name: "oil".into(), viscosity, pressure_viscosity: 2e-8, density: 870.0 }
}

/// A condition: a load of 1e-6 to 3 times the static rating in a random direction, one-way bearings with enough
/// thrust to hold together, at up to 2 million mm/min.
pub fn condition(random: &mut Random, bearing: &BallBearing) -> Condition {
    let (g, pair) = (&bearing.geometry, bearing.duplex.map(|pair| pair.arrangement));
    let rating = LoadRating::new(g, &bearing.ball_material, &bearing.ring_material, pair).static_rating;
    let size = rating * 10f64.powf(random.between(-6.0, 0.477));
    let (azimuth, mut rise) = (random.between(0.0, TAU), random.between(-1.0, 1.0));
    let one_way = g.contact_angle > 0.0 && matches!(pair, None | Some(Arrangement::Tandem));
    if one_way {
        // At least the axial share that loads half of the balls.
        let least = (1.3 * g.contact_angle.tan()).atan().sin();
        rise = g.thrust_direction * (least + (1.0 - least) * rise.abs());
    }
    let radial = size * (1.0 - rise * rise).sqrt();
    let tilts = random.between(0.0, 1.0) < 0.5;
    let arm = if tilts && !one_way { random.between(0.0, 0.1) * g.pitch_diameter } else { 0.0 };
    let held = |free: bool| (!free).then_some(0.0);
    Condition {
        load: [radial * azimuth.cos(), radial * azimuth.sin(), size * rise, size * arm, -0.5 * size * arm],
        prescribed: [None, None, None, held(tilts && !one_way), held(tilts && !one_way)],
        speed: random.between(-2e6, 2e6) / (1e3 * g.pitch_diameter) * TAU / 60.0,
        cage: random.pick(&[CageTreatment::FixedAngle, CageTreatment::Averaged]),
        cage_angle: bearing.cage_angle,
    }
}

/// Largest relative difference of the stiffness from Richardson's extrapolation of central differences, and the
/// difference of its two steps; `None` where they differ, at a contact about to close or open.
fn stiffness_error(solver: &BearingSolver, found: &BearingEquilibrium, deflection: f64) -> Option<[f64; 2]> {
    let unit = [1.0, 1.0, 1.0, 1.0 / solver.radius, 1.0 / solver.radius];
    let by = |column: usize, h: f64| -> [f64; 5] {
        let [plus, minus] = [h, -h].map(|h| {
            let mut d = found.displacement;
            d[column] += h * unit[column];
            solver.reaction(&found.condition, &d).force
        });
        std::array::from_fn(|row| (minus[row] - plus[row]) / (2.0 * h) * unit[row])
    };
    let (mut off, mut spread, mut size) = (0.0f64, 0.0f64, 0.0f64);
    for column in 0..5 {
        let [coarse, fine] = [4e-3, 2e-3].map(|h| by(column, h * deflection));
        for row in 0..5 {
            let expected = (4.0 * fine[row] - coarse[row]) / 3.0;
            let k = found.stiffness[row][column] * unit[row] * unit[column];
            off = off.max((k - expected).abs());
            spread = spread.max((coarse[row] - fine[row]).abs());
            size = size.max(expected.abs());
        }
    }
    (spread < 1e-4 * size).then_some([off / size, spread / size])
}

#[test]
fn equilibrium_and_stiffness_of_random_bearings() {
    let mut random = Random(41);
    let (mut compared, mut failures) = (0, Vec::new());
    for number in 0..200 {
        let mut bearing = bearing(&mut random);
        let condition = condition(&mut random, &bearing);
        if number % 3 == 0 {
            let lubricant = random_oil(&mut Random(number));
            bearing.contact = ContactLaw::Film { lubricant, speed_factor: 1.0 };
        }
        let solver = BearingSolver::new("random", &bearing);
        let what = || {
            let g = &bearing.geometry;
            format!(
                "bearing {number}: {} balls of {:.2} mm at {:.1} deg, {:?}, {:?}, {:?}, {condition:?}",
                g.balls,
                1e3 * g.ball_diameter,
                g.contact_angle.to_degrees(),
                bearing.duplex,
                bearing.inertia,
                bearing.preload
            )
        };
        let found = match solver.solve(&condition, None) {
            Ok(found) => found,
            Err(error) => {
                failures.push(format!("{error}: {}", what()));
                continue;
            }
        };
        let balls = solver.ball_loads(&found);
        let finite = found.displacement.iter().chain(found.stiffness.iter().flatten()).all(|v| v.is_finite());
        if !finite || !balls.iter().all(|b| b.load.is_finite() && b.outer_load.is_finite()) {
            failures.push(format!("not a number: {}", what()));
            continue;
        }
        let scale = [1.0, 1.0, 1.0, 1.0 / solver.radius, 1.0 / solver.radius];
        let load = (0..5).map(|a| (condition.load[a] * scale[a]).abs()).fold(0.0, f64::max);
        let largest = balls.iter().map(|b| b.load).fold(0.0, f64::max);
        // Round-off of the sum over preloaded balls.
        if found.residual > (1e-9 * load).max(1e-12 * largest) {
            failures.push(format!("residual {} of {load} N: {}", found.residual, what()));
        }
        let deflection = (largest / bearing.hertz().stiffness).cbrt().powi(2);
        // Steps of a smaller part of the deflection where a ball is about to close or open.
        let errors = [1.0, 0.1, 0.01].map(|part| stiffness_error(&solver, &found, part * deflection));
        let steps = errors.into_iter().flatten().min_by(|a, b| a[0].total_cmp(&b[0]));
        if let Some([error, spread]) = steps {
            compared += 1;
            if error > 1e-6 {
                failures.push(format!("stiffness off by {error:.1e}, steps {spread:.1e}: {}", what()));
            }
        }
    }
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
    assert!(compared > 150, "{compared} compared");
}

#[test]
fn vanishing_and_no_load() {
    let mut random = Random(5);
    for number in 0..40 {
        let bearing = bearing(&mut random);
        let base = condition(&mut random, &bearing);
        let size = base.load.iter().fold(0.0f64, |m, f| m.max(f.abs()));
        let solver = BearingSolver::new("light", &bearing);
        for force in [1e-9, 1e-12, 0.0] {
            for speed in [0.0, base.speed] {
                let load = base.load.map(|f| f * force / size);
                let found = solver.solve(&Condition { load, speed, ..base }, None);
                let found = found.unwrap_or_else(|e| panic!("bearing {number}, {force} N: {e}"));
                assert!(found.displacement.iter().all(|v| v.is_finite()));
            }
        }
    }
}

/// A machine without gravity and load: preloaded, and loose in its clearance; then under a vanishing load.
#[test]
fn machine_without_load() {
    for (preload, clearance) in [(4e-6, 0.0), (0.0, 12e-6), (0.0, 0.0)] {
        for force in [0.0, 1e-9] {
            let mut model = spindle("ball_inertia = \"outer_race_control\"");
            model.gravity = [0.0, -force, 0.0];
            for site in &mut model.bearings {
                let Bearing::Ball(ball) = &mut site.bearing else { panic!("a ball bearing") };
                ball.preload = if preload > 0.0 { Preload::Interference(preload) } else { Preload::None };
                ball.geometry.radial_clearance = clearance;
            }
            let machine =
                Machine::new(model).unwrap_or_else(|e| panic!("{preload} {clearance} {force}: {e}"));
            for speed in [0.0, 1500.0] {
                let found = machine.equilibrium(&EquilibriumStudy { speed, cage_average: true });
                let found = found.unwrap_or_else(|e| panic!("{preload} {clearance} {force}: {e}"));
                assert!(found.q.iter().all(|q| q.abs() < 1e-3));
            }
        }
    }
}
