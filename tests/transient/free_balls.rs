//! Free balls and cage in a machine: energy balance, mean forces, friction on the rotation, comparison with kinematic cages.

use crate::rig::variant;
use rotordyn::model::study::{
    BearingStudy, Integrator, LyapunovStudy, Plane, PoincareStudy, RunUpStudy, SectionTrigger,
    SteadyRunSettings,
};
use rotordyn::model::{Drive, Model, SpeedProfile};
use rotordyn::results::History;
use rotordyn::study::{Machine, Recorder};
use rotordyn::transient::run::{End, Report};
use std::ops::ControlFlow;

/// The rig with free balls in bearing B, at once at a constant speed \[rad/s\].
fn steady(speed: f64, duration: f64) -> Model {
    let mut model = variant(Some("free_balls"), &[("bearing.B.slip", "\"centre\"")]);
    model.profile = SpeedProfile::Constant { speed, duration };
    model
}

fn run(machine: &Machine, study: &RunUpStudy) -> (History, Report) {
    let reduction = machine.reduce(study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let report = machine.run_up(study, &reduction, |sample| {
        recorder.record(sample);
        ControlFlow::Continue(())
    });
    (recorder.into_history(), report)
}

fn study(machine: &Machine) -> RunUpStudy {
    machine.model.studies.run_up.clone().unwrap()
}

fn channel<'a>(history: &'a History, name: &str) -> &'a [f64] {
    history.channel(name).unwrap().values.in_memory().unwrap()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The energy of rotor, balls and cage changes by the work of loads and rotation less the losses; the mean force of the
/// bearing is that of statics; the cage turns within its pocket clearance of rolling.
#[test]
fn energy_force_and_cage_speed_at_constant_speed() {
    let machine = Machine::new(steady(125.7, 0.15)).unwrap();
    let (history, report) = run(&machine, &study(&machine));
    assert_eq!(report.end, End::Complete);
    let energy = report.energy;
    println!("residual {:.2e} of {:.3e} J, {} steps", energy.residual(), energy.exchanged(), report.steps);
    assert!(energy.contact_loss > 1e-3, "balls slip and lose energy: {energy:?}");
    assert!(energy.residual().abs() < 1e-4 * energy.exchanged(), "{energy:?}");

    let at_rest =
        machine.equilibrium(&rotordyn::model::study::EquilibriumStudy { speed: 0.0, cage_average: true });
    let expected = at_rest.unwrap().bearings[1].force;
    // Three turns of the shaft: unbalance cancels.
    for (axis, expected) in ["x", "y"].into_iter().zip(expected) {
        let found = mean(channel(&history, &format!("B_force_{axis}")));
        println!("mean F_{axis} {found:.2} N, statics {expected:.2} N");
        assert!((found / expected - 1.0).abs() < 0.01);
    }
    let speed = mean(channel(&history, "B_cage_speed")) / 125.7;
    println!("FTF {speed:.4}");
    assert!((speed / 0.396_93 - 1.0).abs() < 0.04, "{speed}");
    assert!(channel(&history, "B_pocket_force").iter().any(|force| *force > 0.0));
}

/// Without drive the friction torque of the balls slows the shaft: J (Ω₁ − Ω₀) = −∫ M dt, J without the free balls.
#[test]
fn friction_of_free_balls_slows_a_coasting_shaft() {
    let mut model = steady(60.0, 0.1);
    let Drive::Prescribed { node: Some(node) } = model.drive else { panic!("the rig is driven") };
    model.drive = Drive::Torque { node, table: vec![[0.0, 0.0]], drag: 0.0 };
    model.bushings.retain(|bushing| bushing.damping[5][5] == 0.0);
    model.unbalances.clear();
    let machine = Machine::new(model).unwrap();
    // The torque vibrates with the contacts, at tens of kHz.
    let (history, report) = run(&machine, &RunUpStudy { sample_rate: 2e5, ..study(&machine) });
    assert_eq!(report.end, End::Complete);
    let energy = report.energy;
    println!("residual {:.2e} of {:.3e} J", energy.residual(), energy.exchanged());
    assert!(energy.residual().abs() < 1e-3 * energy.exchanged(), "{energy:?}");
    let torque = channel(&history, "B_friction_torque");
    let [first, last] = history.speed.ends().unwrap().unwrap();
    let impulse = 0.1 * mean(torque);
    let slowed = machine.assembly.polar_inertia * (first - last);
    println!("friction {impulse:.4e} N m s, momentum lost {slowed:.4e} N m s");
    assert!(impulse > 1e-5 && (slowed / impulse - 1.0).abs() < 0.05, "{slowed} {impulse}");
}

/// Poincaré sections at every ball passage of the free cage, whose frequency is that of its speed in a run; a Lyapunov
/// exponent is refused with a hint.
#[test]
fn sections_follow_the_free_cage() {
    let machine = Machine::new(steady(125.7, 0.3)).unwrap();
    let (history, _) = run(&machine, &study(&machine));
    let plane = ["disc_x", "disc_y"]
        .map(|name| machine.model.probes.iter().find(|probe| probe.name == name).unwrap().clone());
    let [x, y] = plane;
    let (balls, periods) = (9, 18);
    let steady = SteadyRunSettings {
        speed: 125.7,
        integrator: Integrator::RungeKutta4,
        step: 25e-6,
        cutoff: 1500.0,
        trigger: SectionTrigger::BallPass { bearing: 1, balls },
        phase: 0.0,
        transient_periods: 1,
        periods,
        transient_limit: 0,
    };
    let section = PoincareStudy {
        steady: steady.clone(),
        planes: vec![Plane { name: "disc".into(), x, y }],
        tolerance: 1e-3,
        longest_period: 2,
    };
    let found = machine.poincare(&section, &mut |_| ControlFlow::Continue(())).unwrap().unwrap();
    let cage = mean(channel(&history, "B_cage_speed")) / std::f64::consts::TAU;
    let frequency = found.clock.frequency / balls as f64;
    println!("{frequency:.4} Hz, cage {cage:.4} Hz");
    assert_eq!(found.planes[0].section[0].len(), periods);
    // Over times that differ a little; a cage that rolls is slower by 1 %.
    assert!((frequency / cage - 1.0).abs() < 5e-3, "{frequency} {cage}");
    let lyapunov = LyapunovStudy { steady, perturbation: 1e-9 };
    let error = machine.lyapunov(&lyapunov, &mut |_| ControlFlow::Continue(())).unwrap_err().to_string();
    assert!(error.contains("bearing B") && error.contains("model = \"ball\""), "{error}");
}

/// The forecast counts the steps that the free balls divide: those of a run to 30 %, whose loads change.
#[test]
fn forecast_counts_divided_steps() {
    let machine = Machine::new(steady(125.7, 0.02)).unwrap();
    let (_, report) = run(&machine, &study(&machine));
    let forecasts = machine.forecasts();
    let found = forecasts.iter().find(|forecast| forecast.study == "run-up").unwrap();
    println!("forecast {} steps, taken {}", found.count, report.steps);
    assert!((found.count / report.steps as f64 - 1.0).abs() < 0.3);
}

/// An implicit integrator is refused by name, by the reader and by the run itself.
#[test]
fn implicit_steps_are_refused() {
    let machine = Machine::new(steady(100.0, 0.01)).unwrap();
    assert_eq!(study(&machine).integrator, Integrator::RungeKutta4);
    let (_, report) = run(&machine, &RunUpStudy { integrator: Integrator::Newmark, ..study(&machine) });
    let End::Failed(error) = report.end else { panic!("{:?}", report.end) };
    assert!(error.to_string().starts_with("bearing B at t = 0.000000 s"), "{error}");
    assert!(error.to_string().contains("rk4"), "{error}");
    let options = rotordyn::model::Options {
        variant: Some("free_balls".into()),
        set: vec![("study.run_up.integrator".into(), "\"newmark\"".into())],
    };
    let text = include_str!("../../models/overhung_rig.toml");
    let problems = rotordyn::model::load("overhung_rig.toml", text, &options).err().unwrap();
    assert!(format!("{problems:?}").contains("does not take balls and cage as free bodies"), "{problems:?}");
}

/// Order lines far above the noise of the collisions: 1x of the disc agrees with kinematic cages within 1 %; BPFO at the disc
/// and at housing A with kinematic balls at the angles of the free ones within 10 %, twice what 30 revolutions over the ellipse
/// give, while a rolling cage is off by more.
#[test]
fn levels_are_those_of_kinematic_balls_at_the_same_angles() {
    let machine = Machine::new(steady(125.7, 1.5)).unwrap();
    let (history, _) = run(&machine, &study(&machine));
    let found = machine.compare_cages(&study(&machine), &history, &mut || ControlFlow::Continue(()));
    let found = found.unwrap().expect("a machine with free balls");
    println!("{:#?}\n{}", found.cages, found.conclusion());
    let line = |channel: &str, label: &str| {
        let line = found.lines.iter().find(|l| l.channel == channel && l.line.label == label).unwrap();
        println!(
            "{label} of {channel}: free {:.4e}, noise {:.1e}, rolling {:+.2} %, mean angle {:+.2} %, every ball {:+.2} %",
            line.free,
            line.noise,
            100.0 * line.difference(),
            100.0 * line.difference_driven(),
            100.0 * line.difference_spaced()
        );
        line
    };
    for name in ["disc_x", "disc_y"] {
        let once = line(name, "1x");
        assert!(once.difference().abs() < 0.01 && once.difference_driven().abs() < 0.01);
        assert!(once.difference_spaced().abs() < 0.01);
    }
    for name in ["disc_x", "disc_y", "A_ax", "A_ay"] {
        let passage = line(name, "BPFO");
        assert!(passage.difference_spaced().abs() < 0.1 && passage.noise < 0.2 * passage.free);
    }
    // What the free cages of the machine are compared with is the free bearing alone.
    assert_eq!(found.cages.iter().map(|cage| &*cage.bearing).collect::<Vec<_>>(), ["B"]);
    let stopped = machine.compare_cages(&study(&machine), &history, &mut || ControlFlow::Break(()));
    assert!(stopped.unwrap().is_none());
    let kinematic = Machine::new(variant(None, &[])).unwrap();
    let none = kinematic.compare_cages(&study(&kinematic), &history, &mut || ControlFlow::Continue(()));
    assert!(none.unwrap().is_none());
}

/// Samples of accelerations alias collisions at tens of kHz; means over the sampling interval do not: at order 5.3, where
/// nothing excites housing B, they have less than a third of the noise, at 1x of the disc the same level.
#[test]
fn probes_and_interval_means_do_not_alias_collisions() {
    let machine = Machine::new(steady(125.7, 0.6)).unwrap();
    let study = study(&machine);
    let (history, _) = run(&machine, &study);
    let probe = machine.model.probes.iter().position(|probe| probe.name == "B_ax").unwrap();
    let mut instants = Vec::new();
    let report = machine.run_up(&study, &machine.reduce(&study).unwrap(), |sample| {
        instants.push(sample.channels[probe]);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    let level_of = |values: &[f64], order: f64| {
        let from = history.angle.len() / 3;
        let (angle, values) = (&history.angle.in_memory().unwrap()[from..], &values[from..]);
        let span = angle[angle.len() - 1] - angle[0];
        let window = |a: f64| (std::f64::consts::PI * (a - angle[0]) / span).sin().powi(2);
        let sum = |wave: fn(f64) -> f64| -> f64 {
            angle.iter().zip(values).map(|(a, v)| window(*a) * v * wave(order * a)).sum()
        };
        sum(f64::sin).hypot(sum(f64::cos))
    };
    let level = |name: &str, order: f64| level_of(channel(&history, name), order);
    let [filtered, mean] = ["B_ax", "B_ax_interval_mean"].map(|name| level(name, 5.3));
    let instants = level_of(&instants, 5.3);
    println!("noise at housing B: instants {instants:.3e}, filtered {filtered:.3e}, means {mean:.3e}");
    assert!(filtered < instants / 3.0 && mean < instants / 3.0);
    let [sampled, mean] = ["disc_x", "disc_x_interval_mean"].map(|name| level(name, 1.0));
    assert!((mean / sampled - 1.0).abs() < 1e-3, "{mean} {sampled}");
}

/// A machine whose balls share space with a race at the start does not run; the message names both and the depth.
#[test]
fn overlap_at_the_start_is_refused() {
    let mut model = variant(Some("free_balls"), &[("bearing.B.radial_clearance", "\"-0.5 mm\"")]);
    model.profile = SpeedProfile::Constant { speed: 100.0, duration: 0.01 };
    let machine = Machine::new(model).unwrap();
    let (_, report) = run(&machine, &study(&machine));
    let End::Failed(error) = report.end else { panic!("{:?}", report.end) };
    let text = error.to_string();
    println!("{text}");
    assert!(
        text.contains("bearing B") && text.contains("overlap by") && text.contains("at the start"),
        "{text}"
    );
}

/// A light radial load, 40 N at 6000 rpm, whose mean force scatters with the collisions, is balanced to 0.1 %; the cage sags
/// towards the load zone and runs ahead of rolling by 1 %.
#[test]
fn light_radial_load_is_balanced_in_the_single_bearing_study() {
    let machine = Machine::new(variant(Some("free_balls"), &[])).unwrap();
    let study = BearingStudy {
        bearings: vec!["B".into()],
        force: Some([0.0, -40.0, 0.0]),
        speed: Some(6000.0 * std::f64::consts::TAU / 60.0),
        ..BearingStudy::default()
    };
    let found = machine.bearings(&study).unwrap().remove(0);
    let run = found.free_balls.unwrap_or_else(|| panic!("{:?}", found.warnings));
    let rest: f64 =
        run.load.iter().zip(run.force).map(|(load, force)| (load + force).powi(2)).sum::<f64>().sqrt();
    println!("slip {:.5}, {rest:.3} N not balanced, after {:.3} s", run.slip, run.settling_time);
    assert!(rest < 1e-3 * 40.0 && (-0.02..0.0).contains(&run.slip));
}
