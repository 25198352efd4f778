//! The speed a record shows, beside the stated one.

use std::f64::consts::TAU;

use rayon::prelude::*;
use rotordyn_signal::bearing_lines::DefectFrequencies;
use rotordyn_signal::grading::{SpeedFinding, shaft_speed};

use super::path::{sum, tones, white};
use super::random::Random;
use super::{RATE, SAMPLES};

/// Five shaft harmonics of falling level in noise.
fn machine(number: usize, speed: f64) -> Vec<f64> {
    let random = &mut Random::of_record(3, number);
    let lines: Vec<_> = (1..=5).map(|n| (f64::from(n) * speed, 0.3 / f64::from(n), random.phase())).collect();
    sum(&white(random), &tones(&lines), 1.0)
}

/// Shaft harmonics of a level in white noise of deviation 1 that run 1.5 to 2.5 % above the stated speed: of 200
/// errors 95 % are within 1.96 stated deviations, and these are no more than twice the Cramér–Rao bound.
///
/// Bound of a family of known orders n with free amplitudes A_n and phases: σ_ω² = 24 σ²/(N³ Σ n² A_n²) \[rad/sample\]
/// (Rife and Boorstyn, Bell Syst. Tech. J. 55 (1976)).
#[test]
fn true_speed_with_its_uncertainty() {
    let stated = 1000.0 / 60.0;
    let inside = (0..200usize).into_par_iter().filter(|&number| {
        let random = &mut Random::of_record(17, number);
        let speed = stated * random.range(1.015, 1.025);
        let level = random.log_range(0.2, 1.0);
        let orders: Vec<f64> = (1..=random.integer(3, 6)).map(|n| n as f64).collect();
        let lines: Vec<_> = orders.iter().map(|n| (n * speed, level / n, random.phase())).collect();
        let record = sum(&white(random), &tones(&lines), 1.0);
        let found = shaft_speed(&record, RATE, stated, 0.03, None).unwrap();
        let SpeedFinding::Found(found) = found else { panic!("{number}: {found:?}") };
        let samples = SAMPLES as f64;
        let bound = (24.0 / (samples.powi(3) * orders.len() as f64 * level * level)).sqrt() * RATE / TAU;
        assert!(
            (bound..2.0 * bound).contains(&found.uncertainty),
            "{number}: {found:?}, Cram\u{e9}r-Rao {bound:.2e}"
        );
        (found.speed - speed).abs() < 1.96 * found.uncertainty
    });
    // 190 ± 3 are expected.
    let inside = inside.count();
    assert!((180..=196).contains(&inside), "{inside} of 200");
}

/// A line that is no shaft harmonic, half a bin off 2x: the lines scatter more than noise and the speed is less certain.
#[test]
fn foreign_line_makes_the_speed_less_certain() {
    let random = &mut Random::of_record(19, 0);
    let lines: Vec<_> = [20.0, 40.1, 60.0, 80.0].map(|f| (f, 0.3, random.phase())).into();
    let record = sum(&white(random), &tones(&lines), 1.0);
    let SpeedFinding::Found(found) = shaft_speed(&record, RATE, 20.0, 0.02, None).unwrap() else { panic!() };
    // Without its scatter the deviation would be 4e-4 rev/s.
    assert!(found.uncertainty > 2e-3 && (found.speed - 20.0).abs() < 2.0 * found.uncertainty, "{found:?}");
}

/// A record at 48 kHz read as one at 12 kHz has its shaft at a quarter of the stated speed.
#[test]
fn wrong_sampling_rate_is_noticed() {
    let stated = 1797.0 / 60.0;
    let found = shaft_speed(&machine(40, 0.25 * stated), RATE, stated, 0.02, None).unwrap();
    let SpeedFinding::Elsewhere { ratio, speed } = found else { panic!("{found:?}") };
    assert_eq!(ratio, 0.25);
    assert!((speed.speed / (0.25 * stated) - 1.0).abs() < 2e-3, "{speed:?}");
}

/// Orders 2 and 4 of the stated speed are too few for its family, and no family of a slower shaft.
#[test]
fn lines_of_the_stated_speed_suggest_no_other() {
    let stated = 29.95;
    for number in 0..20 {
        let random = &mut Random::of_record(23, number);
        let lines = [2.0, 4.0].map(|n| (n * stated, 0.3, random.phase()));
        let record = sum(&white(random), &tones(&lines), 1.0);
        let found = shaft_speed(&record, RATE, stated, 0.02, None).unwrap();
        assert!(
            !matches!(found, SpeedFinding::Elsewhere { ratio, .. } if ratio < 1.0),
            "{number}: {found:?}"
        );
    }
}

/// Orders of a 14-ball bearing at a shaft speed.
fn bearing(shaft: f64) -> DefectFrequencies {
    let [cage, outer, inner, ball] = [0.4158, 5.82116, 8.17884, 2.86385].map(|order| order * shaft);
    DefectFrequencies { shaft, cage, outer, inner, ball }
}

/// An inner race at 8.179 orders less slip, with side bands: 2.1 % above the true speed its lines are 7x, 8x and 9x. Lower
/// than 1x to 3x, they are no shaft.
#[test]
fn lines_of_the_bearing_are_no_shaft() {
    let speed = 27.3322;
    for number in 0..20 {
        let random = &mut Random::of_record(29, number);
        let seconds = random.range(1.0, 5.0);
        let base = 8.17884 * speed * (1.0 - random.range(0.0, 0.006));
        let mut lines = vec![(speed, 0.44, 0.3), (2.0 * speed, 0.22, 1.0), (3.0 * speed, 0.14, 2.0)];
        for (order, level) in [(-2.0, 0.03), (-1.0, 0.06), (0.0, 0.08), (1.0, 0.06), (2.0, 0.03)] {
            lines.push((base + order * speed, level, random.phase()));
        }
        let mut record = sum(&tones(&lines), &white(random), 0.1);
        record.truncate((seconds * RATE) as usize);
        let found = shaft_speed(&record, RATE, speed, 0.02, Some(&bearing(speed))).unwrap();
        let SpeedFinding::Found(found) = found else { panic!("{number}: {found:?}") };
        assert!((found.speed / speed - 1.0).abs() < 5e-4, "{number}: {found:?}");
    }
}

/// Harmonics of BPFO alone, 3.04 orders, are no shaft, and neither is hum with its harmonics.
#[test]
fn families_of_bearing_and_mains_are_no_shaft() {
    let rates =
        DefectFrequencies { outer: 3.04 * 24.7, inner: 4.96 * 24.7, cage: 0.38 * 24.7, ..bearing(24.7) };
    for number in 0..20 {
        let random = &mut Random::of_record(31, number);
        for base in [rates.outer, 50.0] {
            let lines: Vec<_> = (1..=6).map(|n| (f64::from(n) * base, 0.3, random.phase())).collect();
            let record = sum(&white(random), &tones(&lines), 1.0);
            let found = shaft_speed(&record, RATE, 24.7, 0.02, Some(&rates)).unwrap();
            assert!(!matches!(found, SpeedFinding::Found(_)), "{number}: {found:?}");
        }
    }
}

/// A record at 12 kHz read as one at 24 kHz: 1x to 3x stand in as 2x, 4x and 6x.
#[test]
fn even_harmonics_alone_are_those_of_twice_the_speed() {
    let stated = 1770.0 / 60.0;
    for number in 0..20 {
        let random = &mut Random::of_record(37, number);
        let lines: Vec<_> =
            (1..=3).map(|n| (f64::from(n) * stated, 0.4 / f64::from(n), random.phase())).collect();
        let record = sum(&white(random), &tones(&lines), 1.0);
        let found = shaft_speed(&record, 2.0 * RATE, stated, 0.02, Some(&bearing(stated))).unwrap();
        let SpeedFinding::Elsewhere { ratio, speed } = found else { panic!("{number}: {found:?}") };
        assert!(ratio == 2.0 && (speed.speed / (2.0 * stated) - 1.0).abs() < 1e-3, "{number}: {speed:?}");
        // At its true rate the same record has its stated speed.
        let found = shaft_speed(&record, RATE, stated, 0.02, Some(&bearing(stated))).unwrap();
        assert!(matches!(found, SpeedFinding::Found(_)), "{number}: {found:?}");
    }
}

/// Strong lines at 1x and 2x alone confirm a speed, as near to mains as 59.9 Hz.
#[test]
fn two_strong_lines_confirm_a_speed() {
    let speed = 29.95;
    for number in 0..20 {
        let random = &mut Random::of_record(41, number);
        let lines = [(speed, 0.8, random.phase()), (2.0 * speed, 0.4, random.phase())];
        let record = sum(&tones(&lines), &white(random), 0.3);
        let found = shaft_speed(&record, RATE, speed, 0.02, Some(&bearing(speed))).unwrap();
        let SpeedFinding::Found(found) = found else { panic!("{number}: {found:?}") };
        assert!((found.speed - speed).abs() < 4.0 * found.uncertainty && found.harmonics == 2, "{found:?}");
    }
}

/// Hum at 100 Hz beside 2x of 49.3 rev/s, and hum at 50 and 100 Hz, which are 2x and 4x of 25 rev/s, with 24.7 stated: the
/// shaft's own lines tell the speed.
#[test]
fn hum_beside_shaft_harmonics_hides_no_speed() {
    for number in 0..20 {
        let random = &mut Random::of_record(43, number);
        let (speed, hum) = if number % 2 == 0 { (49.3, [0.0, 0.5]) } else { (24.7, [0.15, 0.3]) };
        let mut lines: Vec<_> = [1.0, 0.4, 0.2]
            .iter()
            .enumerate()
            .map(|(k, level)| ((k + 1) as f64 * speed, level * 0.5, random.phase()))
            .collect();
        lines.extend([(50.0, hum[0], random.phase()), (100.0, hum[1], random.phase())]);
        let mut record = sum(&tones(&lines), &white(random), 0.3);
        record.truncate(RATE as usize * if number % 4 == 0 { 2 } else { 5 });
        // Of an 8-ball bearing whose BPFO is 75 Hz at 24.7 rev/s.
        let [cage, outer, inner, ball] = [0.37957, 3.03658, 4.96342, 1.95551].map(|order| order * speed);
        let rates = DefectFrequencies { shaft: speed, cage, outer, inner, ball };
        let found = shaft_speed(&record, RATE, speed, 0.02, Some(&rates)).unwrap();
        let SpeedFinding::Found(found) = found else { panic!("{number}: {found:?}") };
        assert!((found.speed / speed - 1.0).abs() < 1e-3, "{number}: {found:?}");
    }
}

/// Noise has no shaft family: none of 40 records (a false family in one of 1000).
#[test]
fn noise_has_no_speed() {
    for number in 0..40 {
        let record = white(&mut Random::of_record(5, number));
        let found = shaft_speed(&record, RATE, 29.95, 0.02, None).unwrap();
        assert_eq!(found, SpeedFinding::NotFound, "{number}");
    }
}

#[test]
fn invalid_speeds_are_errors() {
    let record = machine(1, 20.0);
    for (speed, range, words) in [
        (f64::NAN, 0.02, "shaft speed"),
        (20.0, 0.5, "range of the shaft speed"),
        (1.0, 0.02, "10.000 are needed for shaft harmonics"),
    ] {
        let text = shaft_speed(&record, RATE, speed, range, None).unwrap_err().to_string();
        assert!(text.contains(words), "{text}");
    }
}

/// A shaft near the speed of the mains: every harmonic may be the mains' or the shaft's, and the lines stand.
#[test]
fn a_shaft_near_the_speed_of_the_mains_is_found() {
    let bearing = DefectFrequencies { shaft: 1.0, cage: 0.398, outer: 3.585, inner: 5.415, ball: 2.357 };
    for (stated, speed) in
        [(50.0, 50.0), (60.0, 60.0), (25.0, 24.98), (30.0, 29.95), (50.0, 49.75), (50.0, 49.9)]
    {
        let scaled = DefectFrequencies {
            shaft: stated,
            cage: stated * bearing.cage,
            outer: stated * bearing.outer,
            inner: stated * bearing.inner,
            ball: stated * bearing.ball,
        };
        for bearing in [None, Some(&scaled)] {
            let found = shaft_speed(&machine(7, speed), RATE, stated, 0.02, bearing).unwrap();
            let SpeedFinding::Found(found) = found else { panic!("{speed}: {found:?}") };
            let error = (found.speed - speed).abs();
            assert!(error < 4.0 * found.uncertainty.max(1e-3 * speed / 10.0), "{speed}: {found:?}");
        }
    }
}
