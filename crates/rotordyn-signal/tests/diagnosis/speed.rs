//! The speed a record shows, beside the stated one.

use rotordyn_signal::grading::{SpeedFinding, shaft_speed};

use super::RATE;
use super::path::{sum, tones, white};
use super::random::Random;

/// Five shaft harmonics of falling level in noise.
fn machine(number: usize, speed: f64) -> Vec<f64> {
    let random = &mut Random::of_record(3, number);
    let lines: Vec<_> = (1..=5).map(|n| (f64::from(n) * speed, 0.3 / f64::from(n), random.phase())).collect();
    sum(&white(random), &tones(&lines), 1.0)
}

/// "1000 rpm" that runs at 1015: found, and the stated uncertainty is that of the errors.
#[test]
fn true_speed_with_its_uncertainty() {
    let mut scaled = Vec::new();
    for number in 0..24 {
        let speed = (1015.0 + 0.37 * number as f64) / 60.0;
        let found = shaft_speed(&machine(number, speed), RATE, 1000.0 / 60.0, 0.03).unwrap();
        let SpeedFinding::Found(found) = found else { panic!("{number}: {found:?}") };
        // A tenth of a bin at 1x: harmonics and interpolation make it better than the resolution of 0.2 Hz.
        assert!((found.speed - speed).abs() < 0.02, "{number}: {found:?} instead of {speed}");
        assert!(found.harmonics >= 3, "{found:?}");
        scaled.push(((found.speed - speed) / found.uncertainty).powi(2));
    }
    // The mean of 24 squared scaled errors is 1 ± 0.3; a factor of two in the uncertainty is 0.25 or 4.
    let mean = scaled.iter().sum::<f64>() / scaled.len() as f64;
    assert!((0.2..2.5).contains(&mean), "mean squared error over variance: {mean:.2}");
}

/// A record at 48 kHz read as one at 12 kHz has its shaft at a quarter of the stated speed.
#[test]
fn wrong_sampling_rate_is_noticed() {
    let stated = 1797.0 / 60.0;
    let found = shaft_speed(&machine(40, 0.25 * stated), RATE, stated, 0.02).unwrap();
    let SpeedFinding::Elsewhere { ratio, speed } = found else { panic!("{found:?}") };
    assert_eq!(ratio, 0.25);
    assert!((speed.speed / (0.25 * stated) - 1.0).abs() < 2e-3, "{speed:?}");
}

/// Noise has no shaft family: none of 40 records (a false family in one of 1000).
#[test]
fn noise_has_no_speed() {
    for number in 0..40 {
        let record = white(&mut Random::of_record(5, number));
        let found = shaft_speed(&record, RATE, 29.95, 0.02).unwrap();
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
        let text = shaft_speed(&record, RATE, speed, range).unwrap_err().to_string();
        assert!(text.contains(words), "{text}");
    }
}
