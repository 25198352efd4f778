//! Cage speed of a thrust-loaded angular-contact bearing compared with the closed form at its loaded contact
//! angle.

use crate::agree;
use rotordyn::model::{Options, SpeedProfile, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

/// Rotor under pure thrust: bearing A is the locating bearing, B supports radially only.
const ROTOR: &str = r#"
[model]
name = "thrust"
gravity = "0 m/s^2"
[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[rotor]
length = "0.3 m"
outer_diameter = "40 mm"
mass = "3 kg"
centre = "0 m"
[station]
A = "-0.1 m"
B = "0.1 m"
[bearing.A]
station = "A"
model = "ball"
designation = "7205C"
material = "steel"
radial_clearance = "0 um"
thrust = "THRUST"
[bearing.B]
station = "B"
model = "linear"
k_xx = "1e7 N/m"
k_yy = "1e7 N/m"
[load.thrust]
at = "B"
force = "0, 0, FORCE N"
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "constant"
speed = "0 rad/s"
duration = "0.2 s"
[study.run_up]
step = "100 us"
sample_rate = "1 kHz"
cutoff = "3 kHz"
"#;

#[test]
fn cage_speed_at_loaded_contact_angle() {
    for (thrust, force, speed) in [("+z", 3000.0, 200.0), ("-z", -1500.0, 200.0), ("+z", 3000.0, -200.0)] {
        let text = ROTOR.replace("THRUST", thrust).replace("FORCE", &format!("{force}"));
        let mut model =
            load("thrust.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
        let ball = model.bearings[0].bearing.ball().unwrap().clone();
        let (g, nominal) = (&ball.geometry, ball.geometry.contact_angle);
        // Ball load F/(Z sin α) = K δ^1.5; the groove centres are A + δ apart at the constant radial distance
        // A cos α₀, so δ = A (cos α₀/cos α − 1) (Harris, ch. 7).
        let centre_distance = g.inner_groove_radius + g.outer_groove_radius - g.ball_diameter;
        let thrust_at = |angle: f64| {
            let approach = centre_distance * (nominal.cos() / angle.cos() - 1.0);
            g.balls as f64 * angle.sin() * ball.hertz().stiffness * approach.powf(1.5)
        };
        let (mut low, mut high) = (nominal, nominal + 0.3);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if thrust_at(middle) < f64::abs(force) { low = middle } else { high = middle }
        }
        let ratio = |angle: f64| 0.5 * (1.0 - g.ball_diameter * angle.cos() / g.pitch_diameter);
        // The cage ratio at the nominal angle differs by more than 0.12 %.
        assert!(ratio(low) / ratio(nominal) > 1.0012, "{} {}", ratio(low), ratio(nominal));

        model.profile = SpeedProfile::Constant { speed, duration: 0.2 };
        let machine = Machine::new(model).unwrap();
        let study = machine.model.studies.run_up.clone().unwrap();
        let reduction = machine.reduce(&study).unwrap();
        let mut end = [0.0; 2];
        let report = machine.run_up(&study, &reduction, |sample| {
            end = [sample.state.spin.angle, sample.state.rotations[0].cage_angle];
            ControlFlow::Continue(())
        });
        assert_eq!(report.end, End::Complete);
        let [shaft, cage] = end;
        assert!((shaft / TAU).abs() > 6.0);
        // Equilibrium tolerance 1e-10, and a ring displacement of 1e-12 m due to contact damping.
        agree::relative(format_args!("cage angle at {force} N thrust [rad]"), cage, ratio(low) * shaft, 1e-8);
    }
}
