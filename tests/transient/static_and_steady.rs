//! The static state of a high-speed bearing is the end of its steady run: the same loads, at the same cage
//! speed.

use rotordyn::model::study::EquilibriumStudy;
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

/// Rigid rotor: bearing A under study, B supports the other end radially.
const ROTOR: &str = r#"
[model]
name = "spindle"
gravity = "0 m/s^2"
[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[rotor]
length = "0.3 m"
outer_diameter = "40 mm"
mass = "1.5 kg"
centre = "0.1 m"
[station]
A = "0 m"
B = "0.2 m"
[bearing.A]
station = "A"
model = "ball"
thrust = "+z"
cage = "rolling"
BEARING
[bearing.B]
station = "B"
model = "linear"
k_xx = "1e7 N/m"
k_yy = "1e7 N/m"
c_xx = "1500 N s/m"
c_yy = "1500 N s/m"
[bearing.damper]            # damping that does not turn with the cage
station = "A"
model = "linear"
k_xx = "1 N/m"
k_yy = "1 N/m"
c_xx = "1500 N s/m"
c_yy = "1500 N s/m"
c_zz = "1500 N s/m"
[load.thrust]
at = "A"
force = "FORCE N"
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "constant"
speed = "SPEED rad/s"
duration = "DURATION s"
[study.run_up]
step = "20 us"
sample_rate = "50 kHz"
cutoff = "20 kHz"
"#;

struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        low + (high - low) * ((self.0 >> 33) as f64 / (1u64 << 31) as f64)
    }
}

struct Case {
    machine: Machine,
    speed: f64,
}

/// A random angular contact bearing of 11 to 21 balls at n d_m from 0.8 to 1.8 million mm/min under a contact
/// pressure of some 1.2 GPa, with a radial share of the thrust.
fn case(random: &mut Random, radial: f64, duration: f64) -> Case {
    let d = random.between(5e-3, 15e-3);
    let balls = random.between(11.0, 21.0).floor();
    let pitch = d * balls / std::f64::consts::PI * random.between(1.15, 1.35);
    let angle = random.between(15.0, 40.0);
    let speed = random.between(0.8e6, 1.8e6) / (1e3 * pitch) * TAU / 60.0;
    // 40 to 70 N per ball and (8 mm)².
    let thrust = balls * random.between(40.0, 70.0) * (d / 8e-3).powi(2) * 2.0 * angle.to_radians().sin();
    let inertia = ["outer_race_control", "shared"][(random.between(0.0, 2.0)) as usize];
    let bearing = format!(
        "ball_diameter = \"{d} m\"\npitch_diameter = \"{pitch} m\"\nballs = {balls}\ninner_osculation = {}\n\
         outer_osculation = {}\ncontact_angle = \"{angle} deg\"\nball_inertia = \"{inertia}\"\n\
         contact_damping = \"0 N s/m\"\n",
        random.between(0.515, 0.53),
        random.between(0.515, 0.53),
    );
    let text = ROTOR
        .replace("BEARING", &bearing)
        .replace("FORCE", &format!("0, {}, {thrust}", -radial * thrust))
        .replace("SPEED", &format!("{speed}"))
        .replace("DURATION", &format!("{duration}"));
    let model = load("spindle.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
    Case { machine: Machine::new(model).unwrap(), speed }
}

/// Displacement x, y, z of bearing A in equilibrium.
fn statics(case: &Case, cage_average: bool) -> [f64; 3] {
    let found = case.machine.equilibrium(&EquilibriumStudy { speed: case.speed, cage_average }).unwrap();
    let [x, y, z, ..] = found.bearings[0].displacement;
    [x, y, z]
}

#[test]
fn thrust() {
    let mut random = Random(11);
    for number in 0..20 {
        let case = case(&mut random, 0.0, 0.1);
        let [.., expected] = statics(&case, false);
        let study = case.machine.model.studies.run_up.clone().unwrap();
        let reduction = case.machine.reduce(&study).unwrap();
        let mut end = 0.0;
        let report = case.machine.run_up(&study, &reduction, |sample| {
            end = sample.state.d[2];
            ControlFlow::Continue(())
        });
        assert_eq!(report.end, End::Complete);
        assert!(
            (end / expected - 1.0).abs() < 1e-7,
            "bearing {number}: {end} in motion, {expected} in statics"
        );
    }
}

#[test]
fn radial_load_on_average() {
    let mut random = Random(23);
    for number in 0..20 {
        let case = case(&mut random, 0.3, 0.08);
        let expected = statics(&case, true);
        let study = case.machine.model.studies.run_up.clone().unwrap();
        let reduction = case.machine.reduce(&study).unwrap();
        // Mean over the last revolution of the cage.
        let (mut sum, mut count, mut last) = ([0.0; 3], 0.0, Vec::new());
        let report = case.machine.run_up(&study, &reduction, |sample| {
            let d = &sample.state.d;
            last.push((sample.state.rotations[0].cage_angle, [d[0], d[1], d[2]]));
            ControlFlow::Continue(())
        });
        assert_eq!(report.end, End::Complete);
        let end = last.last().unwrap().0;
        for (_, d) in last.iter().filter(|(angle, _)| *angle > end - TAU) {
            count += 1.0;
            sum.iter_mut().zip(d).for_each(|(s, d)| *s += d);
        }
        let size = expected.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        for (mean, expected) in sum.map(|s| s / count).iter().zip(expected) {
            // The ring hardly moves while the balls pass; contact damping, which turns with the cage, is zero.
            assert!((mean - expected).abs() < 1e-5 * size, "bearing {number}: {mean} {expected}");
        }
    }
}
