//! Fitted order of every time integrator with one radial DOF per ball.

use std::ops::ControlFlow;

use rotordyn::model::study::{EquilibriumStudy, Integrator};
use rotordyn::model::{Options, SpeedProfile, load};
use rotordyn::study::Machine;
use rotordyn::transient::reduction::{Reduction, reduce};
use rotordyn::transient::run::{End, Settings, run};

const DURATION: f64 = 1e-3;
const SPEED: f64 = 523.6;

/// Upadhyay's rotor with interference, so that every ball stays in contact with both races and the law is
/// smooth.
fn reduction() -> Reduction {
    let set = [("bearing.B.radial_clearance", "-20 um"), ("bearing.B.stiffness_damping", "1e-6 s")];
    let options = Options {
        variant: None,
        set: set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect(),
    };
    let text = include_str!("../../models/upadhyay_2009.toml");
    let machine = Machine::new(load("upadhyay_2009.toml", text, &options).unwrap().model).unwrap();
    let rest = machine.equilibrium(&EquilibriumStudy { speed: SPEED, cage_average: false }).unwrap();
    let mut reduction = reduce(&machine.model, &machine.assembly, &rest, f64::INFINITY).unwrap();
    reduction.system.curve = SpeedProfile::Constant { speed: SPEED, duration: 1.0 }.curve();
    reduction
}

/// Final coordinates of rotor and balls, with a lateral initial velocity of the rotor.
fn end(reduction: &Reduction, integrator: Integrator, steps: usize) -> nalgebra::DVector<f64> {
    let mut v = &reduction.equilibrium * 0.0;
    v[0] = 5e-3;
    v[1] = -2e-3;
    let settings = Settings {
        integrator,
        step: DURATION / steps as f64,
        defect_step: f64::INFINITY,
        sample_rate: 1.0 / DURATION,
        duration: DURATION,
        energy_balance: true,
    };
    let mut last = v.clone();
    let start = reduction.system.initial_state(reduction.equilibrium.clone(), v).unwrap();
    let report = run(&reduction.system, start, &settings, |sample| {
        last.copy_from(&sample.state.x);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    last
}

#[test]
fn convergence_orders_with_radial_ball_dofs() {
    let reduction = reduction();
    let reference = end(&reduction, Integrator::RungeKutta4, 65_536);
    for (integrator, expected, steps) in [
        (Integrator::Newmark, 2.0, [2048, 8192]),
        (Integrator::GeneralisedAlpha { rho_infinity: 0.8 }, 2.0, [2048, 8192]),
        (Integrator::GeneralisedAlpha { rho_infinity: 0.0 }, 2.0, [2048, 8192]),
        (Integrator::RungeKutta4, 4.0, [512, 2048]),
    ] {
        let errors = steps.map(|n| (end(&reduction, integrator, n) - &reference).amax());
        let order = (errors[0] / errors[1]).log2() / (steps[1] as f64 / steps[0] as f64).log2();
        println!("{integrator:?}: errors {errors:?}, order {order:.2}");
        assert!((order - expected).abs() < 0.15, "{integrator:?}: order {order}");
    }
    for tolerance in [1e-6, 1e-8] {
        let integrator =
            Integrator::DormandPrince { relative_tolerance: tolerance, absolute_tolerance: 1e-16 };
        let error = (end(&reduction, integrator, 1000) - &reference).amax() / reference.amax();
        println!("tolerance {tolerance:.0e}: error {error:.1e}");
        assert!(error < 300.0 * tolerance, "{error} at {tolerance}");
    }
}
