//! A top under a side force: which way it goes, and how far.

use nalgebra::Complex;
use rotordyn::model::study::{Integrator, RunUpStudy};
use rotordyn::model::{Options, SpeedProfile, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::End;
use std::ops::ControlFlow;

type C = Complex<f64>;

/// Cylinder held in a ball joint at one end, free otherwise; at t = 0 a force sets in at the other end.
const TOP: &str = r#"
[model]
name = "top"
gravity = "0 m/s^2"
[rotor]
mass = "4.8 kg"
centre = "0.1 m"
polar_inertia = "0.02 kg m^2"
diametral_inertia = "0.012 kg m^2"
[station]
A = "0 m"
tip = "0.3 m"
[joint.A]
between = ["station.A", "ground"]
kind = "spherical"
[load.side]
at = "tip"
force = "FORCE, 0 N"
time = "0, 10 s"
factor = [1, 1]
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "constant"
speed = "0 rad/s"
duration = "0.3 s"
[probe.x]
at = "tip"
direction = "x"
[probe.y]
at = "tip"
direction = "y"
[study.run_up]
step = "50 us"
sample_rate = "1 kHz"
cutoff = "1e6 Hz"
"#;

/// L = I_p Ω t + I t × ṫ with t = (β_x, β_y, 1); the force F at l z has the moment l z × F, so that with β = β_x + jβ_y
/// I β̈ − j I_p Ω β̇ = l F: β̇ = j (l F/(I_p Ω)) (1 − e^{jνt}), ν = I_p Ω/I about the joint. A force down (−y) on a
/// shaft along z that spins from x to y so drives the tip towards +x.
#[test]
fn a_spinning_top_gives_way_sideways() {
    let (polar, about_joint, arm): (f64, f64, f64) = (0.02, 0.012 + 4.8 * 0.01, 0.3);
    for (speed, force) in [(400.0, [0.0, -2.0]), (-400.0, [0.0, -2.0]), (700.0, [1.5, 0.0])] {
        let text = TOP.replace("FORCE", &format!("{}, {}", force[0], force[1]));
        let mut model =
            load("top.toml", &text, &Options::default()).unwrap_or_else(|e| panic!("{e:?}")).model;
        model.profile = SpeedProfile::Constant { speed, duration: 0.3 };
        let machine = Machine::new(model).unwrap();
        let study = RunUpStudy {
            integrator: Integrator::RungeKutta4,
            ..machine.model.studies.run_up.clone().unwrap()
        };
        let reduction = machine.reduce(&study).unwrap();
        let j = C::new(0.0, 1.0);
        let rate = j * C::new(force[0], force[1]) * arm / (polar * speed);
        let nutation = polar * speed / about_joint;
        let (mut worst, mut last) = (0.0_f64, C::default());
        let report = machine.run_up(&study, &reduction, |sample| {
            let t = sample.state.time;
            let tilt = rate * (C::from(t) - ((j * nutation * t).exp() - 1.0) / (j * nutation));
            last = C::new(sample.channels[0], sample.channels[1]);
            worst = worst.max((last - tilt * arm).norm());
            ControlFlow::Continue(())
        });
        assert_eq!(report.end, End::Complete);
        let far = (rate * 0.3 * arm).norm();
        // (ν h)⁴ of the integrator over 0.3 s.
        assert!(worst < 1e-6 * far, "{worst} of {far}");
        if force[1] < 0.0 {
            // Sideways by precession; along the force only by nutation.
            assert!(last.re * speed.signum() > 0.9 * far && last.im.abs() < 0.2 * far, "{last} of {far}");
        }
    }
}
