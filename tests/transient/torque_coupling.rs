//! The rotation under a torque drive coupled to the lateral motion: an independent integration of the Jeffcott rotor's
//! three equations, the energy account, the order of the integrators, the Sommerfeld effect.

use std::ops::ControlFlow;

use rotordyn::model::study::Integrator;
use rotordyn::model::{Model, Options, load};
use rotordyn::study::Machine;
use rotordyn::transient::run::{End, Report};

const GRAVITY: f64 = 9.80665;
const GENERALISED_ALPHA: Integrator = Integrator::GeneralisedAlpha { rho_infinity: 0.8 };

/// A rigid rotor in the middle between two bearings: its centre moves in x and y, and it rotates.
#[derive(Clone, Copy)]
struct Jeffcott {
    mass: f64,
    inertia: f64,
    unbalance: f64,
    phase: f64,
    stiffness: [f64; 2],
    damping: f64,
    torque: f64,
    drag: f64,
}

const PASSED: Jeffcott = Jeffcott {
    mass: 4.0,
    inertia: 0.02,
    unbalance: 4e-3,
    phase: 0.7,
    stiffness: [4e4, 5e4],
    damping: 16.0,
    torque: 1.6,
    drag: 2e-3,
};

/// The same rotor with too little torque for its resonance.
const STUCK: Jeffcott = Jeffcott { torque: 0.6, ..PASSED };

impl Jeffcott {
    fn model(&self, duration: f64) -> Model {
        let Self { mass, inertia, unbalance, phase, stiffness: [k_x, k_y], damping, torque, drag } = *self;
        let bearing = |name: &str| {
            format!(
                "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"linear\"\nk_xx = \"{} N/m\"\nk_yy = \"{} N/m\"\n\
                 k_zz = \"1e5 N/m\"\nc_xx = \"{c} N s/m\"\nc_yy = \"{c} N s/m\"\nc_zz = \"10 N s/m\"\n",
                0.5 * k_x,
                0.5 * k_y,
                c = 0.5 * damping
            )
        };
        let text = format!(
            "[model]\nname = \"jeffcott\"\n[rotor]\ncentre = \"0 m\"\nmass = \"{mass} kg\"\n\
             polar_inertia = \"{inertia} kg m^2\"\ndiametral_inertia = \"0.015 kg m^2\"\n\
             [station]\nA = \"-0.2 m\"\nC = \"0 m\"\nB = \"0.2 m\"\n{}{}\
             [unbalance.u]\nstation = \"C\"\nmagnitude = \"{unbalance} kg m\"\nphase = \"{phase} rad\"\n\
             [drive]\nkind = \"torque\"\nstation = \"A\"\nspeed = [\"0 rpm\", \"1000 rpm\"]\n\
             torque = [\"{torque} N m\", \"{torque} N m\"]\ndrag = \"{drag} N m s/rad\"\n\
             [speed]\nprofile = \"constant\"\nspeed = \"0 rpm\"\nduration = \"{duration} s\"\n\
             [probe.x]\nat = \"station.C\"\ndirection = \"x\"\n[probe.y]\nat = \"station.C\"\ndirection = \"y\"\n\
             [study.run_up]\nstep = \"100 us\"\nsample_rate = \"200 Hz\"\n",
            bearing("A"),
            bearing("B"),
        );
        model(&text)
    }

    /// ẋ, ẏ, θ̇ and ẍ, ÿ, θ̈ from the 3 × 3 system of the equations of motion, by Cramer's rule.
    fn rate(&self, state: &[f64; 6]) -> [f64; 6] {
        let [x, y, angle, vx, vy, speed] = *state;
        let (sin, cos) = (angle + self.phase).sin_cos();
        let u = self.unbalance;
        // m ẍ − U sin θ̈ = .., m ÿ + U cos θ̈ = .., J θ̈ − U sin ẍ + U cos ÿ = ..
        let fx = u * speed * speed * cos - self.damping * vx - self.stiffness[0] * x;
        let fy = u * speed * speed * sin - self.damping * vy - self.stiffness[1] * y - self.mass * GRAVITY;
        let moment = self.torque - self.drag * speed - u * GRAVITY * cos;
        let turn = (moment + u * (sin * fx - cos * fy) / self.mass) / (self.inertia - u * u / self.mass);
        [vx, vy, speed, (fx + u * sin * turn) / self.mass, (fy - u * cos * turn) / self.mass, turn]
    }

    /// (angle, speed, x, y) every 5 ms by the classical Runge-Kutta method.
    fn integrate(&self, duration: f64) -> Vec<[f64; 4]> {
        let step = 1e-5;
        let mut s = [0.0, -self.mass * GRAVITY / self.stiffness[1], 0.0, 0.0, 0.0, 0.0];
        let mut out = Vec::new();
        let add = |s: &[f64; 6], h: f64, r: &[f64; 6]| std::array::from_fn(|k| s[k] + h * r[k]);
        for count in 0..=(duration / step).round() as usize {
            if count % 500 == 0 {
                out.push([s[2], s[5], s[0], s[1]]);
            }
            let a = self.rate(&s);
            let b = self.rate(&add(&s, 0.5 * step, &a));
            let c = self.rate(&add(&s, 0.5 * step, &b));
            let d = self.rate(&add(&s, step, &c));
            s = std::array::from_fn(|k| s[k] + step / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
        }
        out
    }
}

fn model(text: &str) -> Model {
    match load("torque.toml", text, &Options::default()) {
        Ok(loaded) => loaded.model,
        Err(errors) => panic!("{errors:?}"),
    }
}

/// (angle, speed, channels) at every sample, and the report.
fn run(model: Model, integrator: Integrator, step: f64) -> (Vec<Vec<f64>>, Report) {
    let machine = Machine::new(model).unwrap();
    let mut study = machine.model.studies.run_up.clone().unwrap();
    (study.integrator, study.step) = (integrator, step);
    let reduction = machine.reduce(&study).unwrap();
    let mut samples = Vec::new();
    let report = machine.run_up(&study, &reduction, |sample| {
        let spin = sample.state.spin;
        samples.push([&[spin.angle, spin.speed], sample.channels].concat());
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    (samples, report)
}

/// Largest differences of angle \[rad\], speed \[rad/s\] and displacement \[m\].
fn largest_difference(samples: &[Vec<f64>], reference: &[[f64; 4]]) -> [f64; 3] {
    assert_eq!(samples.len(), reference.len());
    let mut worst = [0.0f64; 3];
    for (sample, reference) in samples.iter().zip(reference) {
        let apart: Vec<f64> = sample.iter().zip(reference).map(|(a, b)| (a - b).abs()).collect();
        for (worst, apart) in worst.iter_mut().zip([apart[0], apart[1], apart[2].max(apart[3])]) {
            *worst = worst.max(apart);
        }
    }
    worst
}

#[test]
fn jeffcott_agrees_with_its_three_coupled_equations() {
    for (rotor, end_above) in [(PASSED, true), (STUCK, false)] {
        let reference = rotor.integrate(4.0);
        let last = reference.last().unwrap()[1];
        // Natural frequencies 100 and 112 rad/s.
        assert_eq!(last > 130.0, end_above, "{last} rad/s");
        assert!(end_above || (80.0..112.0).contains(&last), "{last} rad/s");
        for integrator in [GENERALISED_ALPHA, Integrator::Newmark] {
            let difference =
                |step| largest_difference(&run(rotor.model(4.0), integrator, step).0, &reference);
            let [coarse, fine] = [difference(2e-4), difference(1e-4)];
            println!("{integrator:?} {coarse:?} {fine:?}");
            for (coarse, fine) in coarse.iter().zip(fine) {
                assert!((3.8..4.2).contains(&(coarse / fine)), "{coarse} {fine}: not of second order");
            }
            // (ω h)²/12 = 1e-5 of frequency over 60 revolutions.
            assert!(fine[2] < 2e-4, "{fine:?}");
        }
        let explicit = [
            Integrator::RungeKutta4,
            Integrator::DormandPrince { relative_tolerance: 1e-10, absolute_tolerance: 1e-12 },
        ];
        for integrator in explicit {
            let found = largest_difference(&run(rotor.model(4.0), integrator, 5e-5).0, &reference);
            println!("{integrator:?} {found:?}");
            assert!(found[0] < 1e-5 && found[1] < 1e-5 && found[2] < 1e-8, "{integrator:?}: {found:?}");
        }
    }
}

/// Residual of the energy balance relative to the work of the drive, and the final speed \[rad/s\].
fn energy_residual(model: Model, integrator: Integrator, step: f64) -> (f64, f64, Report) {
    let (samples, report) = run(model, integrator, step);
    let e = report.energy;
    println!("{integrator:?} {step}: {} of {} J, {:?}", e.residual(), e.drive, samples.last().unwrap());
    assert!(e.drive > 1.0, "{e:?}");
    (e.residual().abs() / e.drive, samples.last().unwrap()[1], report)
}

#[test]
fn motor_work_is_stored_or_dissipated_through_passed_and_stuck_resonance() {
    for (rotor, end_above) in [(PASSED, true), (STUCK, false)] {
        for integrator in [GENERALISED_ALPHA, Integrator::Newmark, Integrator::FittedNewmark] {
            let (coarse, ..) = energy_residual(rotor.model(4.0), integrator, 1e-4);
            let (fine, last, report) = energy_residual(rotor.model(4.0), integrator, 5e-5);
            assert!(fine < 1e-6, "{fine}: {report:?}");
            assert!((3.5..4.5).contains(&(coarse / fine)), "{coarse} {fine}: not of second order");
            assert_eq!(last > 130.0, end_above, "{last} rad/s");
        }
    }
}

/// A flexible shaft with an overhung, skew-mounted disc, internal damping, rotational dampers and two unbalances: every
/// term that exchanges energy with the rotation.
fn overhung() -> Model {
    model(
        "[model]\nname = \"overhung\"\n\
         [material.steel]\nyoung = \"210 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\
         [shaft]\nmaterial = \"steel\"\nelement_length = \"60 mm\"\ninternal_damping = \"20 us\"\n\
         section = [{ length = \"420 mm\", outer_diameter = \"16 mm\" }]\n\
         [station]\nA = \"0 mm\"\nB = \"240 mm\"\ndisc = \"420 mm\"\n\
         [disc.d]\nstation = \"disc\"\nouter_diameter = \"200 mm\"\nthickness = \"12 mm\"\nmaterial = \"steel\"\n\
         [bearing.A]\nstation = \"A\"\nmodel = \"linear\"\nk_xx = \"4e6 N/m\"\nk_yy = \"6e6 N/m\"\n\
         k_zz = \"1e6 N/m\"\nc_xx = \"200 N s/m\"\nc_yy = \"200 N s/m\"\nc_spin = \"2e-4 N m s/rad\"\n\
         [bearing.B]\nstation = \"B\"\nmodel = \"linear\"\nk_xx = \"4e6 N/m\"\nk_yy = \"6e6 N/m\"\n\
         c_xx = \"200 N s/m\"\nc_yy = \"200 N s/m\"\n\
         [bushing.air]\nbetween = [\"station.disc\", \"ground\"]\nc_x = \"15 N s/m\"\nc_y = \"15 N s/m\"\n\
         c_spin = \"1e-3 N m s/rad\"\n\
         [unbalance.u]\nstation = \"disc\"\nmagnitude = \"600 g mm\"\n\
         [unbalance.v]\nstation = \"B\"\nmagnitude = \"2 g mm\"\nphase = \"90 deg\"\n\
         [damping]\nstiffness = \"2 us\"\n\
         [drive]\nkind = \"torque\"\nstation = \"A\"\nspeed = [\"0 rpm\", \"3000 rpm\"]\n\
         torque = [\"1.2 N m\", \"1 N m\"]\ndrag = \"1e-3 N m s/rad\"\n\
         [speed]\nprofile = \"constant\"\nspeed = \"0 rpm\"\nduration = \"3 s\"\n\
         [probe.x]\nat = \"station.disc\"\ndirection = \"x\"\n[probe.y]\nat = \"station.disc\"\ndirection = \"y\"\n\
         [study.run_up]\nstep = \"50 us\"\nsample_rate = \"200 Hz\"\ncutoff = \"1 kHz\"\n",
    )
}

#[test]
fn tilting_disc_and_internal_damping_exchange_energy_with_the_rotation_only() {
    for integrator in [GENERALISED_ALPHA, Integrator::Newmark] {
        let (coarse, ..) = energy_residual(overhung(), integrator, 5e-5);
        let (fine, _, report) = energy_residual(overhung(), integrator, 2.5e-5);
        println!("{report:?}");
        assert!(coarse / fine > 3.0, "{coarse} {fine}: not of second order");
        // A term missing on either side would be of the order of the losses, 0.1.
        assert!(fine < 1e-8, "{fine}");
    }
}

/// The rotor of models/sommerfeld.toml under 0.15 N m, shortened by a start just below its resonance.
#[test]
fn motor_of_015_newton_metres_does_not_pass_the_resonance_of_the_jeffcott_rotor() {
    let set = [("speed.speed", "1400 rpm"), ("speed.duration", "6 s"), ("study.run_up.sample_rate", "50 Hz")];
    let options = Options {
        variant: Some("constant_torque".into()),
        set: set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect(),
    };
    let text = include_str!("../../models/sommerfeld.toml");
    let model = load("sommerfeld.toml", text, &options).unwrap_or_else(|errors| panic!("{errors:?}")).model;
    let balanced = {
        let mut model = model.clone();
        model.unbalances.clear();
        run(model, GENERALISED_ALPHA, 2.5e-4)
    };
    let (samples, report) = run(model, GENERALISED_ALPHA, 2.5e-4);
    let rpm = |samples: &[Vec<f64>]| samples.last().unwrap()[1] * 30.0 / std::f64::consts::PI;
    println!("{} rpm, balanced {} rpm, {report:?}", rpm(&samples), rpm(&balanced.0));
    assert!((1480.0..1550.0).contains(&rpm(&samples)), "{} rpm", rpm(&samples));
    assert!(rpm(&balanced.0) > 1700.0, "{} rpm", rpm(&balanced.0));
    // The power of the motor, 0.15 N m × 159 rad/s = 24 W, goes into the whirl.
    let e = report.energy;
    // Of second order in the step: 1e-6 at 12.5 us.
    assert!(e.residual().abs() < 5e-4 * e.drive, "{} of {}", e.residual(), e.drive);
}

/// Ball bearings roll with the shaft: the power of their cages comes from the motor.
#[test]
fn cages_of_ball_bearings_take_their_power_from_the_rotation() {
    let mut model = crate::rig::variant(None, &[]);
    let rotordyn::model::Drive::Prescribed { node: Some(node) } = model.drive else { panic!("driven") };
    model.drive = rotordyn::model::Drive::Torque { node, table: vec![[0.0, 8.0]], drag: 0.0 };
    model.profile = rotordyn::model::SpeedProfile::Constant { speed: 20.0, duration: 1.0 };
    let (fine, ..) = energy_residual(model, Integrator::Newmark, 2.5e-5);
    assert!(fine < 1e-5, "{fine}");
}

#[test]
fn unbalance_above_the_inertia_of_its_station_is_refused() {
    let heavy = Jeffcott { unbalance: 0.4, ..PASSED };
    let machine = Machine::new(heavy.model(1.0)).unwrap();
    let study = machine.model.studies.run_up.clone().unwrap();
    let message = machine.reduce(&study).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(
        message.contains("unbalance u of 4.000e-1 kg m") && message.contains("m = 4.000e0 kg"),
        "{message}"
    );
}
