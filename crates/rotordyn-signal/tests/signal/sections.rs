//! Poincaré sections, periods and Lyapunov exponents of systems with known solutions.

use std::f64::consts::TAU;

use rotordyn_signal::SignalError;
use rotordyn_signal::lyapunov::lyapunov_exponent;
use rotordyn_signal::motion_classification::{Motion, classify_motion, zero_one_test};
use rotordyn_signal::poincare::{StroboscopicSampling, cluster_points};

use crate::assert_close;

/// One step of classical Runge-Kutta for ẋ = f(t, x).
fn rk4<const N: usize>(f: &impl Fn(f64, &[f64; N]) -> [f64; N], t: f64, x: &mut [f64; N], h: f64) {
    let along = |x: &[f64; N], k: &[f64; N], s: f64| std::array::from_fn(|i| x[i] + s * k[i]);
    let a = f(t, x);
    let b = f(t + 0.5 * h, &along(x, &a, 0.5 * h));
    let c = f(t + 0.5 * h, &along(x, &b, 0.5 * h));
    let d = f(t + h, &along(x, &c, h));
    for i in 0..N {
        x[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    }
}

/// Peak to peak.
fn size(record: &[f64]) -> f64 {
    let (low, high) = record.iter().fold((f64::MAX, f64::MIN), |(l, h), v| (v.min(l), v.max(h)));
    high - low
}

/// Iterates x → r x (1 − x), leaving out the first steps.
fn logistic(r: f64, skip: usize, n: usize) -> Vec<f64> {
    let mut x = 0.4;
    let mut step = || {
        x = r * x * (1.0 - x);
        x
    };
    for _ in 0..skip {
        step();
    }
    (0..n).map(|_| step()).collect()
}

fn motion(section: &[f64]) -> Motion {
    classify_motion(&[section], &[1.0], 1e-3, 32).unwrap().motion
}

#[test]
fn section_values_at_the_section_phase() {
    // A phase of nonuniform rate, 24.3 samples per revolution.
    let phase: Vec<f64> =
        (0..4000).map(|n| 0.37 + n as f64 * TAU / 24.3 + 0.4 * (n as f64 * 0.013).sin()).collect();
    for start in [0.0, 1.0, -17.3] {
        let strobe = StroboscopicSampling::new(&phase, start, TAU).unwrap();
        assert!((163..=166).contains(&strobe.positions.len()), "{}", strobe.positions.len());
        for order in [1.0, 2.0] {
            let record: Vec<f64> = phase.iter().map(|p| (order * p).sin()).collect();
            let inner = strobe.section(&record).unwrap();
            let inner = &inner[1..inner.len() - 1];
            let worst = inner.iter().map(|v| (v - (order * start).sin()).abs()).fold(0.0, f64::max);
            // The documented bound, with the shortest period of the phase, 23.8 samples.
            let bound = 0.005 * (TAU * order / 23.8).powi(6);
            println!("order {order} at {start}: {worst:.1e}, bound {bound:.1e}");
            assert!(worst < bound, "{worst}");
        }
        // The phase of every instant is start + k 2π.
        let at = strobe.section(&phase).unwrap();
        for (k, p) in at.iter().enumerate() {
            assert_close("phase", *p, start + (strobe.first + k as i64) as f64 * TAU, 1e-9);
        }
    }
}

#[test]
fn samples_on_the_section_are_exact() {
    // 20 samples per revolution: every 20th sample, including the first and the last.
    let phase: Vec<f64> = (0..=200).map(|n| n as f64 / 20.0).collect();
    let record: Vec<f64> = (0..=200).map(|n| f64::from(n * n % 37)).collect();
    let strobe = StroboscopicSampling::new(&phase, 0.0, 1.0).unwrap();
    let expected: Vec<f64> = record.iter().step_by(20).copied().collect();
    let found = strobe.section(&record).unwrap();
    assert_eq!(strobe.first, 0);
    assert_eq!(found.len(), 11);
    for (a, b) in found.iter().zip(&expected) {
        assert_close("sample", *a, *b, 1e-9);
    }
}

#[test]
fn sines_are_periodic_or_quasi_periodic() {
    let section = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { (0..300).map(|n| f(n as f64)).collect() };
    assert_eq!(motion(&section(&|t| (TAU * t + 0.3).sin())), Motion::Periodic(1));
    assert_eq!(motion(&section(&|t| (TAU * t / 2.0 + 0.3).cos() + (TAU * t).sin())), Motion::Periodic(2));
    assert_eq!(motion(&section(&|t| (TAU * t * 3.0 / 7.0).cos())), Motion::Periodic(7));
    // Golden mean and √2: incommensurate frequencies.
    for ratio in [0.5 * (5f64.sqrt() - 1.0), 2f64.sqrt()] {
        let found = classify_motion(
            &[&section(&|t| (TAU * t * ratio).cos() + 0.5 * (TAU * t).cos())],
            &[3.0],
            1e-3,
            32,
        )
        .unwrap();
        println!("{ratio}: {found:?}");
        assert_eq!(found.motion, Motion::QuasiPeriodic);
        assert!(found.zero_one_k.abs() < 0.2, "{found:?}");
    }
}

#[test]
fn logistic_map_period_doubling_to_chaos() {
    // Periodic windows of the map: 2 from 3, 4 from 3.4495, 8 from 3.5441, 3 from 3.8284.
    for (r, period) in [(2.8, 1), (3.2, 2), (3.5, 4), (3.55, 8), (3.83, 3), (3.845, 6)] {
        assert_eq!(motion(&logistic(r, 2000, 300)), Motion::Periodic(period), "r = {r}");
    }
    for r in [3.7, 3.9, 4.0] {
        let found = classify_motion(&[&logistic(r, 1000, 300)], &[1.0], 1e-3, 32).unwrap();
        println!("r = {r}: {found:?}");
        assert_eq!(found.motion, Motion::Chaotic);
        assert!(found.zero_one_k > 0.9, "r = {r}: {found:?}");
    }
    // At r = 2.9 the distance to the fixed point is multiplied by −0.9 per step: 60 steps are too few to settle.
    assert_eq!(motion(&logistic(2.9, 0, 60)), Motion::Settling(1));
}

/// A decaying spiral x_n = a ρⁿ cos(2πνn + φ) beside a steady motion of period 1 tends to period 1, whatever the
/// number k of points after which νk is nearly whole: a record is settled when a ρᴺ is below the tolerance.
#[test]
fn decaying_spirals_tend_to_period_one() {
    const TOLERANCE: f64 = 1e-3;
    let (mut settled, mut open) = (0, 0);
    for points in [60, 100, 300] {
        for case in 0..600 {
            let part = |factor: f64| (f64::from(case) * factor + 0.37).fract();
            // Rotations of nearly a whole number of turns in up to 32 periods, real multipliers, and any other.
            let rotation = match case % 4 {
                0 => (1.0 + (15.0 * part(0.618)).floor()) / 32.0 + 1e-4 * part(0.271),
                1 => 11.0 / 25.0 + 1e-5,
                2 => [0.0, 0.5][case as usize / 4 % 2],
                _ => 0.03 + 0.45 * part(0.618),
            };
            // Time constants from 30 to 3000 periods, amplitudes at the end from 1e-5 to 0.3.
            let rho = (-1.0 / (30.0 * 100f64.powf(part(0.414)))).exp();
            let end = 1e-5 * 3e4f64.powf(part(0.732));
            let at = |n: i32, phase: f64| {
                end * rho.powi(n - points) * (TAU * rotation * f64::from(n) + phase).cos()
            };
            let x: Vec<f64> = (0..points).map(|n| 0.3 + at(n, 0.2)).collect();
            let y: Vec<f64> = (0..points).map(|n| -0.1 + at(n, 1.3)).collect();
            let found = classify_motion(&[&x, &y], &[1.0, 1.0], TOLERANCE, 32).unwrap();
            let what =
                format!("{points} points, rotation {rotation:.5}, rho {rho:.5}, end {end:.1e}: {found:?}");
            match found.motion {
                Motion::Periodic(k) => {
                    assert_eq!(k, 1, "{what}");
                    // The estimate is from the largest of few points.
                    assert!(end < 2.0 * TOLERANCE, "{what}");
                    settled += 1;
                }
                Motion::Settling(k) => {
                    assert!(k == 1 && end > 0.3 * TOLERANCE * rho.powi(points), "{what}");
                    open += 1;
                }
                // Allowed if the changes hardly decay over the record, or differ between its halves, so that a second
                // record must confirm it.
                Motion::QuasiPeriodic | Motion::Aperiodic => {
                    assert_eq!(found.motion == Motion::Aperiodic, points < 100, "{what}");
                    assert!(rho.powi(points) > 0.98 || found.amplitude_trend.abs() > 0.01, "{what}");
                }
                Motion::Unsettled => assert!(end > 0.3 * TOLERANCE * rho.powi(points), "{what}"),
                Motion::Chaotic => panic!("{what}"),
            }
        }
    }
    assert!(settled > 300 && open > 300, "{settled} settled, {open} not");
}

/// A spiral that decays towards a motion of period 3 with three distant points is no quasi-periodic motion.
#[test]
fn decaying_spirals_around_distant_points_are_not_quasi_periodic() {
    for time_constant in [150.0, 400.0, 800.0] {
        for end in [0.003, 0.03] {
            let at = |n: usize, phase: f64| {
                let turn = TAU * n as f64 / 3.0;
                let rho = (-1.0_f64 / time_constant).exp();
                (turn + phase).cos()
                    + end * rho.powi(n as i32 - 100) * (TAU * 0.1234 * n as f64 + phase).cos()
            };
            let [x, y] = [0.0, 1.1].map(|phase| (0..100).map(|n| at(n, phase)).collect::<Vec<f64>>());
            let found = classify_motion(&[&x, &y], &[2.0, 2.0], 1e-3, 32).unwrap();
            println!("{time_constant}, {end}: {found:?}");
            assert!(!found.motion.is_settled(), "{time_constant}, {end}: {found:?}");
        }
    }
}

/// The logistic map near its first doubling at r = 3: multiplier 2 − r of the fixed point below, 4 + 2r − r² of the
/// period-2 orbit above.
#[test]
fn slow_decay_near_a_period_doubling_is_not_settled() {
    for (r, limit, multiplier) in
        [(2.99_f64, 1, 0.99_f64), (2.998, 1, 0.998), (3.003, 2, (4.0 + 6.006 - 3.003_f64.powi(2)).sqrt())]
    {
        let mut was_open = false;
        for settle in [20, 100, 400, 1600, 6400] {
            let x = logistic(r, settle, 100);
            let found = classify_motion(&[&x], &[1.0], 1e-3, 32).unwrap();
            println!("r = {r} after {settle}: {found:?}");
            // Distance of the last points from the exact orbit.
            let fixed = 1.0 - 1.0 / r;
            let pair = ((r - 3.0) * (r + 1.0)).max(0.0).sqrt();
            let orbit = [(r + 1.0 + pair) / (2.0 * r), (r + 1.0 - pair) / (2.0 * r)];
            let points: &[f64] = if limit == 1 { &[fixed] } else { &orbit };
            let away = |v: &f64| points.iter().map(|p| (v - p).abs()).fold(f64::INFINITY, f64::min);
            let distance = x[96..].iter().map(away).fold(0.0, f64::max);
            match found.motion {
                Motion::Periodic(k) => assert!(k == limit && distance < 1.5e-3, "r = {r}: {distance}"),
                motion => {
                    assert!(!motion.is_settled(), "r = {r} after {settle}: {motion:?}, off by {distance}");
                    was_open = true;
                }
            }
            if found.decay_factor.is_finite() && distance < 0.003 {
                // Of a small distance the decay is that of the linearised map.
                let rate = found.decay_factor.ln() / multiplier.ln();
                assert!((0.8..1.3).contains(&rate), "r = {r}: {rate} of the decay rate");
                assert!(
                    (0.4..5.0).contains(&(found.residual / distance)),
                    "{} for {distance}",
                    found.residual
                );
            }
        }
        assert!(was_open);
        assert_eq!(motion(&logistic(r, 6400, 100)), Motion::Periodic(limit), "r = {r}");
    }
    // At the doubling itself the distance decays as n^(−1/2): after 700 iterations it is 0.02.
    for settle in [50, 600, 3000] {
        assert!(!motion(&logistic(3.0, settle, 100)).is_settled(), "{settle}");
    }
}

/// ẍ + δ ẋ − x + x³ = γ cos ωt, sampled 100 times a period.
fn duffing(gamma: f64, delta: f64, omega: f64, settle: usize, periods: usize) -> [Vec<f64>; 3] {
    let f = |t: f64, s: &[f64; 2]| [s[1], gamma * (omega * t).cos() - delta * s[1] + s[0] - s[0].powi(3)];
    let h = TAU / omega / 100.0;
    let mut s = [1.0, 0.0];
    let [mut phase, mut x, mut v] = [const { Vec::new() }; 3];
    for n in 0..=100 * (settle + periods) {
        let t = n as f64 * h;
        if n >= 100 * settle {
            phase.push(omega * t);
            x.push(s[0]);
            v.push(s[1]);
        }
        rk4(&f, t, &mut s, h);
    }
    [phase, x, v]
}

#[test]
fn duffing_oscillator_period_doubling_to_chaos() {
    // δ = 0.3, ω = 1.2, the usual illustration of this oscillator (Jordan and Smith, Nonlinear Ordinary Differential
    // Equations): period 1, 2, 4, 5, chaos, 2 at these forces.
    let expected = [
        (0.20, Motion::Periodic(1)),
        (0.28, Motion::Periodic(2)),
        (0.29, Motion::Periodic(4)),
        (0.37, Motion::Periodic(5)),
        (0.50, Motion::Chaotic),
        (0.65, Motion::Periodic(2)),
    ];
    for (gamma, expected) in expected {
        let [phase, x, v] = duffing(gamma, 0.3, 1.2, 400, 200);
        // The motion does not depend on the section phase.
        for start in [0.0, 2.0] {
            let strobe = StroboscopicSampling::new(&phase, start, TAU).unwrap();
            let sections = [strobe.section(&x).unwrap(), strobe.section(&v).unwrap()];
            let both = [&sections[0][..], &sections[1][..]];
            let sizes = [size(&x), size(&v)];
            let found = classify_motion(&both, &sizes, 1e-3, 32).unwrap();
            let groups = cluster_points(&both, &sizes.map(|s| 1e-3 * s)).unwrap();
            println!("gamma {gamma}: {found:?}, {} groups", groups.len());
            assert_eq!(found.motion, expected, "gamma = {gamma}");
            if let Motion::Periodic(k) = expected {
                assert_eq!(groups.len(), k);
                assert!(groups.iter().all(|g| g.points >= 200 / k - 1));
            } else {
                assert!(groups.len() > 50);
            }
        }
    }
}

/// Growth over every period of a perturbation of ẍ + δ ẋ = g(x) + F cos t, and the length of a period.
fn growth(
    g: impl Fn(f64) -> f64,
    delta: f64,
    force: f64,
    settle: usize,
    periods: usize,
) -> (Vec<f64>, Vec<f64>) {
    const STEPS: usize = 200;
    const SMALL: f64 = 1e-9;
    let f = |t: f64, s: &[f64; 2]| [s[1], force * t.cos() - delta * s[1] + g(s[0])];
    let h = TAU / STEPS as f64;
    let (mut s, mut near) = ([1.0, 0.0], [1.0 + SMALL, 0.0]);
    let mut found = Vec::new();
    for period in 0..settle + periods {
        for n in 0..STEPS {
            let t = n as f64 * h;
            rk4(&f, t, &mut s, h);
            rk4(&f, t, &mut near, h);
        }
        let d: [f64; 2] = std::array::from_fn(|i| near[i] - s[i]);
        let size = d[0].hypot(d[1]);
        if period >= settle {
            found.push((size / SMALL).ln());
        }
        near = std::array::from_fn(|i| s[i] + d[i] * SMALL / size);
    }
    let intervals = vec![TAU; found.len()];
    (found, intervals)
}

#[test]
fn lyapunov_exponents_of_known_systems() {
    // The logistic map at r = 4 has λ = ln 2 exactly: growth |4 − 8x| per step.
    let logs: Vec<f64> = logistic(4.0, 100, 20_000).iter().map(|x| (4.0 - 8.0 * x).abs().ln()).collect();
    let found = lyapunov_exponent(&logs, &vec![1.0; logs.len()]).unwrap();
    println!("logistic: {} ± {}", found.value, found.standard_error);
    assert_close("ln 2", found.value, 2f64.ln(), 4.0 * found.standard_error);
    assert!(found.standard_error < 0.01);
    assert_eq!(found.history.len(), 20_000);
    assert_eq!(found.history.last(), Some(&found.value));

    // Sprott, Chaos and Time-Series Analysis (2003): Ueda's oscillator ẍ + 0.05 ẋ + x³ = 7.5 cos t has
    // λ = 0.1034, the two-well oscillator ẍ + 0.25 ẋ − x + x³ = 0.4 cos t has λ = 0.1571.
    let ueda = growth(|x| -x.powi(3), 0.05, 7.5, 100, 4000);
    let wells = growth(|x| x - x.powi(3), 0.25, 0.4, 100, 4000);
    for (name, (logs, intervals), published) in [("Ueda", ueda, 0.1034), ("two wells", wells, 0.1571)] {
        let found = lyapunov_exponent(&logs, &intervals).unwrap();
        println!("{name}: {:.4} ± {:.4}, published {published}", found.value, found.standard_error);
        assert!(found.standard_error < 0.003);
        assert_close(name, found.value, published, 4.0 * found.standard_error);
    }
    // A damped linear oscillator has λ = −δ/2; its perturbation rotates in the phase plane, so that the growth
    // differs between periods.
    let (logs, intervals) = growth(|x| -1.7 * x, 0.1, 1.0, 50, 400);
    let found = lyapunov_exponent(&logs, &intervals).unwrap();
    println!("linear: {:.6} ± {:.6}", found.value, found.standard_error);
    assert_close("linear", found.value, -0.05, 2e-4);
}

#[test]
fn zero_one_test_is_invariant_to_offset_and_scale() {
    let regular: Vec<f64> = (0..500).map(|n| (n as f64 * 2.4).cos()).collect();
    let chaotic = logistic(3.97, 100, 500);
    for (shift, factor) in [(0.0, 1.0), (0.0, 1e-6), (10.0, 1.0), (-1e-3, 1e-6)] {
        let moved = |x: &[f64]| -> Vec<f64> { x.iter().map(|x| shift + factor * x).collect() };
        let (low, high) =
            (zero_one_test(&moved(&regular)).unwrap(), zero_one_test(&moved(&chaotic)).unwrap());
        println!("{shift} {factor}: {low:.3} {high:.3}");
        assert!(low < 0.2 && high > 0.8, "{low} {high} at {shift}, {factor}");
    }
}

/// 0-1 test for chaos of tori of one and two frequencies, slow and fast, smooth and with a corner, with the hundred
/// points per value of a bifurcation diagram; and of maps in their chaotic ranges. The test as published (n up to N/10)
/// classifies half of these tori as chaotic.
#[test]
fn zero_one_test_separates_tori_from_chaos_with_a_hundred_points() {
    let mut worst = [f64::NEG_INFINITY, f64::INFINITY];
    for points in [100, 200, 300] {
        for k in 0..120 {
            // Rotation numbers from 0.0005 to 0.5, spread by √2 and the golden ratio.
            let rotation = 5e-4 + 0.4995 * (f64::from(k) * 2f64.sqrt()).fract().powf(1.5);
            let other = 0.5 * (f64::from(k) * 0.618_034 + 0.2).fract();
            let weight = (f64::from(k) * 0.317).fract();
            let at = |n: usize| {
                let turn = TAU * rotation * n as f64 + 1.0;
                match k % 4 {
                    0 => turn.cos() + weight * (2.0 * turn).cos() + 0.2 * (3.0 * turn).sin(),
                    1 => turn.cos() + weight * (TAU * other * n as f64).cos(),
                    2 => turn.cos().abs() + weight * turn.cos(),
                    _ => turn.cos() * (1.0 + 0.5 * (TAU * 0.0031 * n as f64).cos()),
                }
            };
            let chaos = zero_one_test(&(0..points).map(at).collect::<Vec<_>>()).unwrap();
            worst[0] = worst[0].max(chaos);
            assert!(chaos < 0.5, "{points} points, rotation {rotation}, kind {}: {chaos}", k % 4);
        }
        // Outside the periodic windows of the logistic map.
        for r in [3.68, 3.7, 3.72, 3.76, 3.78, 3.8, 3.82, 3.87, 3.9, 3.93, 3.97, 4.0] {
            let chaos = zero_one_test(&logistic(r, 1000, points)).unwrap();
            worst[1] = worst[1].min(chaos);
            assert!(chaos > 0.5, "{points} points, r = {r}: {chaos}");
        }
    }
    println!("tori at most {:.2}, chaos at least {:.2}", worst[0], worst[1]);
}

#[test]
fn clusters_are_chains_of_neighbouring_points() {
    // Two groups in the plane that overlap in either channel alone.
    let x = [0.0, 0.1, 0.2, 0.05, 0.15, 0.25];
    let y = [0.0, 0.1, 0.2, 1.0, 1.1, 1.2];
    let found = cluster_points(&[&x, &y], &[0.11, 0.11]).unwrap();
    assert_eq!(found.iter().map(|c| c.points).collect::<Vec<_>>(), [3, 3]);
    assert_close("centre", found[0].centre[1], 0.1, 1e-12);
    assert_close("radius", found[1].radius, 0.1, 1e-12);
    assert_eq!(cluster_points(&[&x, &y], &[0.09, 0.09]).unwrap().len(), 6);
    assert!(cluster_points(&[], &[]).unwrap().is_empty());
}

#[test]
fn invalid_sections_are_rejected() {
    let phase: Vec<f64> = (0..50).map(f64::from).collect();
    let bad = |result: Result<StroboscopicSampling, SignalError>, words: &str| {
        let text = result.unwrap_err().to_string();
        assert!(text.contains(words), "{text}");
    };
    bad(StroboscopicSampling::new(&[], 0.0, 1.0), "phase is empty");
    bad(StroboscopicSampling::new(&phase[..5], 0.0, 1.0), "at least 6");
    bad(StroboscopicSampling::new(&phase, 0.0, 0.0), "section period = 0");
    bad(StroboscopicSampling::new(&phase, f64::NAN, 1.0), "section phase");
    let mut back = phase.clone();
    back[20] = 18.5;
    bad(StroboscopicSampling::new(&back, 0.0, 7.0), "step of the phase = -0.5");
    let strobe = StroboscopicSampling::new(&phase, 0.0, 7.0).unwrap();
    assert!(matches!(strobe.section(&phase[1..]), Err(SignalError::LengthMismatch { .. })));
    assert!(matches!(classify_motion(&[&phase[..7]], &[1.0], 1e-3, 3), Err(SignalError::TooShort { .. })));
    assert!(matches!(classify_motion(&[], &[], 1e-3, 3), Err(SignalError::TooShort { .. })));
    assert!(matches!(classify_motion(&[&phase], &[1.0], 0.0, 3), Err(SignalError::OutOfRange { .. })));
    assert!(matches!(lyapunov_exponent(&[f64::NAN], &[1.0]), Err(SignalError::NotFinite { .. })));
    // A constant motion has period 1.
    assert_eq!(classify_motion(&[&[2.0; 20]], &[0.0], 1e-3, 5).unwrap().motion, Motion::Periodic(1));
}
