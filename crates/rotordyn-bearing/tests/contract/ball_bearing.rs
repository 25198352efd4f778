//! Ball bearing: tangents compared with finite differences, rotational symmetry, energy and power balance.

use crate::bearing::rig_6205;
use rotordyn_bearing::{BallElement, Fit, Rotation, Wave};

/// Deterministic pseudo-random numbers in [−1, 1); every test sets its seed.
pub struct Random(pub u64);
impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64 / (1u64 << 53) as f64) * 2.0 - 1.0
    }
    pub fn scaled(&mut self, scale: [f64; 6]) -> [f64; 6] {
        scale.map(|s| s * self.next())
    }
}

const LENGTHS: [f64; 6] = [12e-6, 12e-6, 60e-6, 8e-4, 8e-4, 0.0];
const SPEEDS: [f64; 6] = [3e-3, 3e-3, 3e-3, 0.2, 0.2, 0.0];

fn variants() -> Vec<BallElement> {
    let plain = rig_6205();
    let mut wavy = rig_6205();
    wavy.imperfections.inner_waviness =
        (2..=15).map(|n| Wave { order: n, amplitude: 2e-6 / n as f64, phase: n as f64 }).collect();
    wavy.imperfections.outer_waviness = vec![Wave { order: 8, amplitude: 0.5e-6, phase: 0.3 }];
    let mut angular = rig_6205();
    angular.geometry.contact_angle = 0.4;
    angular.geometry.radial_clearance = 0.0;
    angular.geometry.thrust_direction = -1.0;
    [plain, wavy, angular].iter().map(BallElement::new).collect()
}

#[test]
fn tangents_match_finite_differences() {
    let mut random = Random(7);
    let mut loaded = 0;
    for element in variants() {
        for _ in 0..200 {
            let (d, v) = (random.scaled(LENGTHS), random.scaled(SPEEDS));
            let rotation = Rotation {
                cage_angle: 3.0 * random.next(),
                cage_speed: Some(40.0),
                shaft_angle: 3.0 * random.next(),
                shaft_speed: 100.0,
            };
            let here = element.reaction(&d, &v, &rotation);
            // A contact near opening or at the end of the damping ramp has a kink within the difference step.
            let smooth = element
                .ball_loads(&d, &rotation)
                .iter()
                .all(|b| b.deflection.abs() > 1e-8 && (b.deflection - 1e-6).abs() > 1e-8);
            if !smooth || here.force.iter().all(|f| *f == 0.0) {
                continue;
            }
            loaded += 1;
            for column in 0..5 {
                let step = [1e-10, 1e-10, 1e-10, 1e-8, 1e-8][column];
                let shifted = |vector: [f64; 6], by: f64| {
                    let mut w = vector;
                    w[column] += by;
                    w
                };
                let plus = element.reaction(&shifted(d, step), &v, &rotation).force;
                let minus = element.reaction(&shifted(d, -step), &v, &rotation).force;
                let rate = 1e-5;
                let plus_v = element.reaction(&d, &shifted(v, rate), &rotation).force;
                let minus_v = element.reaction(&d, &shifted(v, -rate), &rotation).force;
                for row in 0..5 {
                    // Scale of a row and column: stiffness of the whole bearing with the lever arm.
                    let lever = |k: usize| if k < 3 { 1.0 } else { 0.02 };
                    let scale = lever(row) * lever(column);
                    let k = -(plus[row] - minus[row]) / (2.0 * step);
                    let c = -(plus_v[row] - minus_v[row]) / (2.0 * rate);
                    let (dk, dc) = (k - here.stiffness[row][column], c - here.damping[row][column]);
                    // 1e-10 m of step on Hertz: truncation ~1e-4 of the local stiffness 1e7 N/m.
                    assert!(dk.abs() < 3e3 * scale, "K[{row}][{column}]: {k} off by {dk}");
                    assert!(dc.abs() < 1e-4 * 300.0 * scale + 1e-6, "C[{row}][{column}] off by {dc}");
                }
            }
        }
    }
    assert!(loaded > 200, "only {loaded} loaded samples");
}

#[test]
fn elastic_force_is_gradient_of_energy() {
    let mut random = Random(11);
    for element in variants() {
        for _ in 0..50 {
            let d = random.scaled(LENGTHS);
            let rotation = Rotation { cage_angle: random.next(), ..Rotation::default() };
            let here = element.reaction(&d, &[0.0; 6], &rotation);
            for k in 0..5 {
                let step = if k < 3 { 1e-9 } else { 1e-7 };
                let mut plus = d;
                let mut minus = d;
                plus[k] += step;
                minus[k] -= step;
                let energy = |d| element.reaction(d, &[0.0; 6], &rotation).elastic_energy;
                let slope = (energy(&plus) - energy(&minus)) / (2.0 * step);
                let scale = if k < 3 { 1.0 } else { 0.02 };
                assert!((slope + here.force[k]).abs() < scale * (1e-3 + 1e-5 * here.force[k].abs()));
                for row in 0..5 {
                    let skew = here.stiffness[row][k] - here.stiffness[k][row];
                    assert!(skew.abs() <= 1e-9 * (1.0 + here.stiffness[row][k].abs()));
                }
            }
        }
    }
}

#[test]
fn power_balance_closes() {
    // d(energy)/dt + dissipation = −f·v + parametric power, along a straight path with rotating cage and
    // waviness.
    let mut random = Random(5);
    for element in variants() {
        for _ in 0..50 {
            let (d, v) = (random.scaled(LENGTHS), random.scaled(SPEEDS));
            let at = |t: f64| {
                let mut q = d;
                for k in 0..6 {
                    q[k] += v[k] * t;
                }
                let rotation = Rotation {
                    cage_angle: 0.3 + 40.0 * t,
                    cage_speed: Some(40.0),
                    shaft_angle: 0.1 + 100.0 * t,
                    shaft_speed: 100.0,
                };
                element.reaction(&q, &v, &rotation)
            };
            let h = 1e-7;
            let rate = (at(h).elastic_energy - at(-h).elastic_energy) / (2.0 * h);
            let here = at(0.0);
            let work: f64 = here.force.iter().zip(&v).map(|(f, v)| f * v).sum();
            let residual = rate + here.dissipated_power + work - here.parametric_power;
            assert!(residual.abs() < 1e-6 * (1.0 + work.abs() + here.parametric_power.abs()), "{residual}");
            assert!(here.dissipated_power >= 0.0);
        }
    }
}

#[test]
fn contact_force_is_never_tensile() {
    let element = &variants()[0];
    let rotation = Rotation::default();
    // Fast separation from a compressed position: the contact opens instead of transmitting tension.
    let d = [8e-6, 0.0, 0.0, 0.0, 0.0, 0.0];
    let fast = element.reaction(&d, &[-10.0, 0.0, 0.0, 0.0, 0.0, 0.0], &rotation);
    assert_eq!(fast.force, [0.0; 6]);
    assert_eq!(fast.stiffness, [[0.0; 6]; 6]);
    assert!(fast.dissipated_power > 0.0);
    assert!(element.reaction(&d, &[0.0; 6], &rotation).force[0] < 0.0);
}

#[test]
fn rotating_displacement_and_cage_rotates_force() {
    let element = &variants()[0];
    let mut random = Random(3);
    for _ in 0..20 {
        let d = random.scaled(LENGTHS);
        let angle: f64 = random.next() * 3.0;
        let (s, c) = angle.sin_cos();
        let turn = |w: [f64; 6]| {
            [c * w[0] - s * w[1], s * w[0] + c * w[1], w[2], c * w[3] - s * w[4], s * w[3] + c * w[4], w[5]]
        };
        let at = |cage_angle| Rotation { cage_angle, ..Rotation::default() };
        let plain = turn(element.reaction(&d, &[0.0; 6], &at(0.2)).force);
        let turned = element.reaction(&turn(d), &[0.0; 6], &at(0.2 + angle)).force;
        for k in 0..6 {
            assert!((plain[k] - turned[k]).abs() < 1e-9 * (1.0 + plain[k].abs()));
        }
    }
}

#[test]
fn fit_changes_radial_clearance() {
    let mut mounted = rig_6205();
    mounted.fit = Fit {
        shaft_interference: 6e-6,
        inner_temperature_rise: 15.0,
        expansion: 12e-6,
        speed_growth: true,
        ..Fit::default()
    };
    let place = [12e-6, -4e-6, 30e-6, 0.0, 0.0, 0.0];
    for speed in [0.0, 1500.0] {
        let change = mounted.clearance_change(speed);
        assert!(change < -10e-6);
        let mut bare = rig_6205();
        bare.geometry.radial_clearance += change;
        let rotation = Rotation { cage_angle: 0.4, shaft_speed: speed, ..Rotation::default() };
        let force = |bearing| BallElement::new(bearing).reaction(&place, &[0.0; 6], &rotation).force;
        let (here, there) = (force(&mounted), force(&bare));
        for axis in 0..3 {
            assert!((here[axis] - there[axis]).abs() < 1e-9 * there[axis].abs(), "{here:?} {there:?}");
        }
    }
    assert!(mounted.clearance_change(1500.0) < mounted.clearance_change(0.0));
}
