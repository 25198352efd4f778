//! A simulated hit, small enough to keep contact, gives the linearised FRF.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use crate::rig::variant;
use rotordyn::analysis::equilibrium::{CageTreatment, equilibrium};
use rotordyn::analysis::frf::frf;
use rotordyn::analysis::modal::modes;
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::element::Anchor;
use rotordyn::linalg::Complex64;
use rotordyn::model::study::Integrator;
use rotordyn::model::{Load, LoadFactor, Quantity, SpeedProfile};
use rotordyn::transient::reduction::reduce;
use rotordyn::transient::run::{Settings, run};

const RATE: f64 = 4000.0;
const DURATION: f64 = 16.0;
/// Half width of the triangular pulse \[s\]: its spectrum reaches 1 kHz.
const PULSE: f64 = 1e-3;

/// Fourier transform of uniform samples at one frequency, ∫ x e^{−jωt} dt by the rectangle rule.
fn transform(samples: &[f64], hz: f64) -> Complex64 {
    let step = Complex64::from_polar(1.0, -TAU * hz / RATE);
    let mut turn = Complex64::new(1.0, 0.0);
    let mut sum = Complex64::default();
    for (k, x) in samples.iter().enumerate() {
        // The recurrence drifts by round-off; start it afresh now and then.
        if k % 1024 == 0 {
            turn = Complex64::from_polar(1.0, -TAU * hz * k as f64 / RATE);
        }
        sum += turn * *x;
        turn *= step;
    }
    sum / RATE
}

/// Frequency of the largest |H| near `hz`, by golden section, and that |H|.
fn peak(h: impl Fn(f64) -> f64, hz: f64) -> (f64, f64) {
    let (mut a, mut b) = (0.995 * hz, 1.005 * hz);
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..30 {
        let (c, d) = (b - ratio * (b - a), a + ratio * (b - a));
        if h(c) > h(d) { b = d } else { a = c }
    }
    let at = 0.5 * (a + b);
    (at, h(at))
}

#[test]
fn small_hit_gives_the_linear_frf() {
    let mut model = variant(None, &[]);
    model.unbalances.clear();
    model.profile = SpeedProfile::Constant { speed: 0.0, duration: DURATION };
    let disc = Anchor::node(model.discs[0].node);
    // 1 N for a millisecond moves the shaft in its bearings by nanometres; the loaded balls are squeezed by
    // micrometres, and none of the others comes within reach.
    let direction = [0.8, 0.6, 0.0, 0.0, 0.0, 0.0];
    model.loads.push(Load {
        name: "hammer".into(),
        at: disc,
        force: direction.map(|d| 0.02 * d),
        factor: LoadFactor::Table(vec![[0.0, 0.0], [PULSE, 1.0], [2.0 * PULSE, 0.0]]),
    });
    let assembly = Assembly::new(&model).unwrap();
    let start = equilibrium(&model, &assembly, 0.0, CageTreatment::FixedAngle, None).unwrap();
    let reduction = reduce(&model, &assembly, &start, 1500.0).unwrap();
    let probes: Vec<usize> = ["disc_x", "disc_y"]
        .map(|name| model.probes.iter().position(|p| p.name == name).expect("a probe of the rig"))
        .to_vec();
    let rest: Vec<f64> =
        probes.iter().map(|&p| reduction.system.channels.list()[p].row.dot(&reduction.equilibrium)).collect();
    let mut responses = [Vec::new(), Vec::new()];
    let settings = Settings {
        integrator: Integrator::Newmark,
        step: 2.5e-5,
        defect_step: f64::INFINITY,
        sample_rate: RATE,
        duration: DURATION,
        energy_balance: true,
    };
    let state =
        reduction.system.initial_state(reduction.equilibrium.clone(), &reduction.equilibrium * 0.0).unwrap();
    let balls_before = start.bearings.iter().flat_map(|b| &b.balls).filter(|b| b.load > 0.0).count();
    run(&reduction.system, state, &settings, |sample| {
        for k in 0..2 {
            responses[k].push(sample.channels[probes[k]] - rest[k]);
        }
        ControlFlow::Continue(())
    });
    assert!(balls_before >= 4);

    let system = LinearSystem::new(&assembly, &start.tangents(), 0.0).unwrap();
    let excitation = assembly.direction_row(&disc, &direction);
    // Triangle of unit height: its transform is exact.
    let force = |hz: f64| {
        let x = std::f64::consts::PI * hz * PULSE;
        Complex64::from_polar(0.02 * PULSE * (x.sin() / x).powi(2), -TAU * hz * PULSE)
    };
    let mut compared = 0;
    for (probe, response) in probes.iter().zip(&responses) {
        let row = assembly.direction_row(&disc, &model.probes[*probe].direction);
        let linear = |hz: f64| {
            let one = std::slice::from_ref;
            let h = frf(&assembly, &system, &[hz], one(&excitation), one(&row), Quantity::Acceleration);
            h.unwrap().values[0][0][0].norm()
        };
        let measured = |hz: f64| (transform(response, hz) / force(hz)).norm() * (TAU * hz).powi(2);
        for mode in modes(&assembly, &system, 8).unwrap() {
            let hz = mode.frequency_hz();
            let (f_linear, h_linear) = peak(linear, hz);
            // A mode that hardly shows in this direction makes no peak near its frequency: the search ends at
            // its bracket, 0.5 % away.
            if (f_linear / hz - 1.0).abs() > 4.5e-3 {
                continue;
            }
            let (f_measured, h_measured) = peak(measured, hz);
            println!("{hz:8.3} Hz: {f_linear:.4} {f_measured:.4}, {h_linear:.4e} {h_measured:.4e}");
            assert!((f_measured / f_linear - 1.0).abs() < 1e-3, "{f_measured} against {f_linear} Hz");
            assert!((h_measured / h_linear - 1.0).abs() < 1e-2, "{h_measured} against {h_linear} m/(s^2 N)");
            compared += 1;
        }
    }
    assert!(compared >= 4, "only {compared} peaks");
}
