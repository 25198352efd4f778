//! Invariants of every contact law: slope and energy match finite differences, continuity, no tension,
//! dissipative damping.

use crate::bearing::steel;
use crate::ehl_table::tabulated;
use rotordyn_bearing::contact::{
    BallContacts, ContactDamping, ContactLaw, ContactLoad, FilmSpring, HertzPair, Lubricant, PowerLaw, Race,
    SpeedContacts, fit_power_law,
};

fn pair() -> HertzPair {
    HertzPair::new(9.5e-3, 46e-3, [4.9e-3, 5.06e-3], 0.6, &steel(), &steel())
}

fn oil() -> Lubricant {
    Lubricant { name: "oil".into(), viscosity: 0.04, pressure_viscosity: 2.3e-8, density: 870.0 }
}

/// Every law at a very low, a usual and a high entrainment speed.
fn laws() -> Vec<(BallContacts, f64)> {
    let power = |stiffness, exponent, offset| {
        ContactLaw::PowerLaw(PowerLaw { stiffness, exponent, offset, range: [600.0, 2000.0] })
    };
    let laws = [
        ContactLaw::Hertz,
        ContactLaw::Film { lubricant: oil(), speed_factor: 1.0 },
        power(8.562e9, 1.475, 30.207),
        power(1.18e10, 1.51, -155.465),
        power(2.149e9, 1.3255, 235.4),
    ];
    let at = |law: &ContactLaw, speeds: [f64; 3]| {
        speeds.map(|speed| (BallContacts::new(pair(), law.clone()), speed))
    };
    // The synthetic table is not valid far outside its speeds.
    let solved = at(&tabulated(&pair()), [0.7, 3.0, 18.0]);
    laws.iter().flat_map(|law| at(law, [1e-4, 1.2, 40.0])).chain(solved).collect()
}

/// Loads at which the slope of a law has a kink.
fn kinks() -> [f64; 4] {
    [FilmSpring::THRESHOLD, 150.0, 155.465, 417.7]
}

/// Approaches spaced logarithmically above the onset of load, up to 0.1 mm.
fn approaches(contacts: &SpeedContacts) -> Vec<f64> {
    (0..=140).map(|k| contacts.onset() + 1e-11 * 10f64.powf(f64::from(k) / 20.0)).collect()
}

#[test]
fn slope_and_energy_match_finite_differences() {
    for (contacts, speed) in laws() {
        let at = contacts.at_speed(speed);
        let pieces: [&dyn Fn(f64) -> ContactLoad; 3] =
            [&|x| at.series(x), &|x| at.single(Race::Inner, x), &|x| at.single(Race::Outer, x)];
        for law in pieces {
            for x in approaches(&at) {
                let here = law(x);
                // Central differences with a step small against the scale of curvature.
                let step = 1e-4 * here.load / here.slope;
                let (low, high) = (law(x - step), law(x + step));
                // dQ/dδ has a kink at the threshold.
                let kink = kinks().iter().any(|q| low.load < *q && high.load > *q);
                if here.load == 0.0 || low.load == 0.0 || kink {
                    continue;
                }
                // Truncation, and rounding of δ against the step.
                let tolerance = 1e-7 + 4.0 * f64::EPSILON * x.abs() / step;
                let slope = (high.load - low.load) / (2.0 * step);
                assert!((slope / here.slope - 1.0).abs() < tolerance, "speed {speed}, δ {x}: slope");
                let load = (high.energy - low.energy) / (2.0 * step);
                assert!((load / here.load - 1.0).abs() < tolerance, "speed {speed}, δ {x}: energy");
            }
        }
    }
}

#[test]
fn load_rises_continuously_from_onset() {
    for (contacts, speed) in laws() {
        let at = contacts.at_speed(speed);
        let onset = at.onset();
        assert_eq!(at.series(onset), ContactLoad::default());
        assert_eq!(at.series(onset - 1e-6), ContactLoad::default());
        let mut before = ContactLoad::default();
        for x in approaches(&at) {
            let here = at.series(x);
            assert!(here.load > before.load && here.slope > before.slope && here.energy > before.energy);
            before = here;
        }
    }
}

#[test]
fn load_and_slope_are_continuous_at_threshold() {
    let contacts = BallContacts::new(pair(), ContactLaw::Film { lubricant: oil(), speed_factor: 1.0 });
    for speed in [1e-4, 1.2, 40.0] {
        let at = contacts.at_speed(speed);
        let threshold = (FilmSpring::THRESHOLD / pair().stiffness).powf(2.0 / 3.0)
            - at.film(Race::Inner, FilmSpring::THRESHOLD)
            - at.film(Race::Outer, FilmSpring::THRESHOLD);
        // Two points within round-off of the threshold, one on each side.
        let (low, high) = (at.series(threshold - 1e-18), at.series(threshold + 1e-18));
        assert!((high.load / low.load - 1.0).abs() < 1e-6);
        assert!((high.slope / low.slope - 1.0).abs() < 1e-6);
        assert!((high.energy / low.energy - 1.0).abs() < 1e-6);
        // Load vanishes at −(1 + 1.5 · 0.067) times the film thickness at the threshold.
        let film = at.film(Race::Inner, FilmSpring::THRESHOLD) + at.film(Race::Outer, FilmSpring::THRESHOLD);
        assert!((at.onset() / (-1.1005 * film) - 1.0).abs() < 1e-9);
        assert!(
            (at.film(Race::Inner, 0.0) / at.film(Race::Inner, FilmSpring::THRESHOLD) - 1.1005).abs() < 1e-9
        );
    }
}

#[test]
fn film_law_tends_to_dry_law_at_zero_speed() {
    let film = BallContacts::new(pair(), ContactLaw::Film { lubricant: oil(), speed_factor: 1.0 });
    let dry = BallContacts::new(pair(), ContactLaw::Hertz);
    for x in [-1e-6, 1e-9, 1e-6, 1e-5] {
        assert_eq!(film.at_speed(0.0).series(x), dry.at_speed(3.0).series(x));
        // Limit u → 0: h ∝ u^0.67.
        let (slow, bare) = (film.at_speed(1e-9).series(x).load, dry.at_speed(0.0).series(x).load);
        assert!((slow - bare).abs() <= 1e-3 * bare + 1e-6, "δ {x}: {slow} and {bare}");
    }
}

#[test]
fn extreme_film_parameters_give_finite_values() {
    for (viscosity, alpha) in [(0.0, 1e-8), (1e3, 1e-7)] {
        let lubricant = Lubricant { viscosity, pressure_viscosity: alpha, ..oil() };
        let contacts = BallContacts::new(pair(), ContactLaw::Film { lubricant, speed_factor: 1.0 });
        let at = contacts.at_speed(1e3);
        for x in [-1.0, -1e-3, 0.0, 1e-6, 1e-3] {
            let here = at.series(x);
            assert!(here.load.is_finite() && here.slope.is_finite() && here.energy.is_finite());
        }
    }
}

fn dampings() -> [ContactDamping; 3] {
    [
        ContactDamping::Constant { coefficient: 300.0, ramp: 1e-6 },
        ContactDamping::HuntCrossley { factor: 0.3 },
        ContactDamping::Film { factor: 1.0 },
    ]
}

#[test]
fn damped_load_and_its_derivatives() {
    for (contacts, speed) in laws() {
        let at = contacts.at_speed(speed);
        for damping in dampings() {
            let law = |x: f64, rate: f64| damping.apply(&at, &at.series(x), x, rate);
            for x in approaches(&at) {
                for rate in [-1.0, -1e-3, 0.0, 1e-3, 1.0] {
                    let (here, elastic) = (law(x, rate), at.series(x));
                    assert!(here.load >= 0.0 && here.by_rate >= 0.0);
                    // Dissipated power is never negative.
                    assert!((here.load - elastic.load) * rate >= 0.0);
                    let step = 1e-4 * (x - at.onset());
                    let (low, high) = (law(x - step, rate), law(x + step, rate));
                    // The end of the ramp, the threshold and the loss of contact are kinks of the damping.
                    let kink =
                        [1e-6, 1e-6 - 2.0 * step].iter().any(|r| (x - at.onset() - r).abs() < 2.0 * step)
                            || (at.series(x - step).load < FilmSpring::THRESHOLD
                                && at.series(x + step).load > FilmSpring::THRESHOLD)
                            || low.load == 0.0;
                    if kink {
                        continue;
                    }
                    let slope = (high.load - low.load) / (2.0 * step);
                    let scale = elastic.slope.abs()
                        + here.by_approach.abs()
                        + here.by_rate * rate.abs() / x.abs().max(1e-9);
                    assert!(
                        (slope - here.by_approach).abs() < 1e-5 * scale,
                        "{damping:?} δ {x} rate {rate}: {slope} {}",
                        here.by_approach
                    );
                    let by_rate = (law(x, rate + 1e-5).load - law(x, rate - 1e-5).load) / 2e-5;
                    if law(x, rate - 1e-5).load > 0.0 {
                        assert!(
                            (by_rate - here.by_rate).abs() < 1e-5 * here.by_rate + 1e-9 * here.load / 1e-5
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn film_damping_from_film_lag() {
    // Film thickness with a first-order lag τ = b/u: integration over a slow harmonic approach must give the
    // damping coefficient. Outer and inner contact are equal, so that one time constant suffices.
    let one = HertzPair { outer: pair().inner, ..pair() };
    let one = HertzPair { stiffness: one.inner.stiffness / 2f64.powf(1.5), ..one };
    let contacts = BallContacts::new(one, ContactLaw::Film { lubricant: oil(), speed_factor: 1.0 });
    let speed = 1.2;
    let at = contacts.at_speed(speed);
    let middle = 1e-6;
    let load = at.series(middle).load;
    let lag = one.inner.patch(load).semi_minor / speed;
    let (amplitude, omega) = (1e-11, 1e-3 / lag);
    let film = |q: f64| 2.0 * at.film(Race::Inner, q);
    let force = |delta: f64, h: f64| one.stiffness * (delta + h).powf(1.5);
    let steps = 20_000;
    let dt = std::f64::consts::TAU / omega / f64::from(steps);
    let (mut h, mut work) = (film(load), 0.0);
    for _ in 0..2 {
        work = 0.0;
        for k in 0..steps {
            let t = (f64::from(k) + 0.5) * dt;
            let delta = middle + amplitude * (omega * t).sin();
            // Midpoint rule for τ ḣ = h(Q) − h.
            let half = h + 0.5 * dt / lag * (film(force(delta, h)) - h);
            let q = force(delta, half);
            work += (q - load) * amplitude * omega * (omega * t).cos() * dt;
            h += dt / lag * (film(q) - half);
        }
    }
    let measured = work / (std::f64::consts::PI * omega * amplitude * amplitude);
    let damped = ContactDamping::Film { factor: 1.0 }.apply(&at, &at.series(middle), middle, 0.0).by_rate;
    // The error is of second order in ω τ = 1e-3.
    assert!((measured / damped - 1.0).abs() < 1e-5, "{measured} and {damped}");
}

#[test]
fn power_law_is_exact_above_smoothed_onset() {
    for (stiffness, exponent, offset) in
        [(8.562e9, 1.475, 30.207), (1.18e10, 1.51, -155.465), (1e10, 1.5, 0.0)]
    {
        let law = PowerLaw { stiffness, exponent, offset, range: [600.0, 2000.0] };
        let contacts = BallContacts::new(pair(), ContactLaw::PowerLaw(law));
        let at = contacts.at_speed(0.0);
        assert!(law.smooth_below() < 158.0);
        assert!(PowerLaw { offset: 590.0, ..law }.smooth_below() <= 600.0);
        assert!(PowerLaw { offset: -900.0, ..law }.smooth_below() <= 600.0);
        for load in [158.0, 547.0, 600.0, 2000.0, 9000.0] {
            let x = ((load - offset) / stiffness).powf(1.0 / exponent);
            assert!((at.series(x).load / load - 1.0).abs() < 1e-13);
            // Both races under this load share the approach.
            let share = |race| (pair().stiffness / pair().of(race).stiffness).powf(2.0 / 3.0);
            assert!((share(Race::Inner) + share(Race::Outer) - 1.0).abs() < 1e-13);
            let inner = at.single(Race::Inner, x * share(Race::Inner)).load;
            assert!((inner / load - 1.0).abs() < 1e-13);
        }
        assert!(
            at.is_outside_range(599.0)
                && at.is_outside_range(2001.0)
                && !at.is_outside_range(600.0)
                && !at.is_outside_range(0.0)
        );
    }
    // Without an offset and n = 3/2 the smoothed onset equals the law.
    let law = PowerLaw { stiffness: 1e10, exponent: 1.5, offset: 0.0, range: [600.0, 2000.0] };
    let contacts = BallContacts::new(pair(), ContactLaw::PowerLaw(law));
    let at = contacts.at_speed(0.0);
    for x in [1e-8, 1e-7, 1e-6, 1e-5_f64] {
        assert!((at.series(x).load / (1e10 * x.powf(1.5)) - 1.0).abs() < 1e-9);
    }
    let anywhere = PowerLaw { range: [0.0, f64::INFINITY], ..law };
    let contacts = BallContacts::new(pair(), ContactLaw::PowerLaw(anywhere));
    assert_eq!(contacts.at_speed(0.0).series(0.0), ContactLoad::default());
    assert!((contacts.at_speed(0.0).series(1e-6).load / (1e10 * 1e-9) - 1.0).abs() < 1e-12);
}

#[test]
fn power_law_fit_recovers_parameters() {
    for (stiffness, exponent, offset) in
        [(8.562e9, 1.475, 30.207), (1.18e10, 1.51, -155.465), (2.1e9, 1.3, 235.0)]
    {
        let loads: Vec<f64> = (0..29).map(|k| 600.0 + 50.0 * f64::from(k)).collect();
        let approaches: Vec<f64> =
            loads.iter().map(|q| ((q - offset) / stiffness).powf(1.0 / exponent)).collect();
        let fit = fit_power_law(&loads, &approaches).unwrap();
        assert!((fit.exponent - exponent).abs() < 1e-10 && (fit.stiffness / stiffness - 1.0).abs() < 1e-9);
        assert!((fit.offset - offset).abs() < 1e-7 && fit.range == [600.0, 2000.0]);
    }
    assert!(fit_power_law(&[1.0, 2.0], &[1e-6, 2e-6]).is_none());
    assert!(fit_power_law(&[1.0, 2.0, 3.0], &[1e-6, f64::NAN, 3e-6]).is_none());
    assert!(fit_power_law(&[1.0, 2.0, 3.0], &[1e-6, 2e-6]).is_none());
}
