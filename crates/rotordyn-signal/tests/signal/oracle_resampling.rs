//! scipy and numpy reference values (oracle_resampling.py, stored in tests/data/scipy_resampling.json) to 1e-10.

use rotordyn_signal::WindowKind;
use rotordyn_signal::envelope::envelope_spectrum;
use rotordyn_signal::jerk::jerk;
use rotordyn_signal::resample::to_uniform_time;
use rotordyn_signal::spectrum::Level;
use rotordyn_signal::tacho::PulseTrain;
use serde_json::Value;

use crate::noise;
use crate::oracle::{assert_all, count, numbers};

fn oracle() -> Value {
    serde_json::from_str(include_str!("../data/scipy_resampling.json")).expect("the stored file is JSON")
}

#[test]
fn nonuniform_samples_by_the_natural_spline() {
    let mut time = vec![0.25];
    for v in noise(11, 200) {
        time.push(time[time.len() - 1] + 1e-3 * (1.0 + 0.4 * v));
    }
    let case = &oracle()["uneven"];
    let got = to_uniform_time(&time, &noise(12, 201), case["rate"].as_f64().unwrap()).unwrap();
    assert_all("spline", &got, &numbers(&case["values"]));
}

/// PCHIP interpolation of the revolutions at the pulses, none of which is missing or spurious.
#[test]
fn shaft_angle_between_pulses() {
    let case = &oracle()["pulses"];
    let times = numbers(&case["times"]);
    let revolutions = (0..times.len()).map(|k| k as f64).collect();
    let samples = (times[times.len() - 1] * 2000.0) as usize + 1;
    let train = PulseTrain { times, revolutions, missing: 0, dropped: 0, marks: None };
    let (angle, first) = train.angle(2000.0, samples).unwrap();
    assert_eq!(first, count(&case["first"]));
    let every_eleventh: Vec<f64> = angle.into_iter().step_by(11).collect();
    assert_all("angle", &every_eleventh, &numbers(&case["angle"]));
}

#[test]
fn jerk_is_the_gradient() {
    // Values of order 500: their rounding is 1e-13.
    assert_all("jerk", &jerk(&noise(12, 201), 500.0).unwrap(), &numbers(&oracle()["jerk"]));
}

#[test]
fn envelope_spectrum_of_a_band() {
    let tone = |k: usize| 1.0 + 0.6 * (std::f64::consts::TAU * 20.0 * k as f64 / 1000.0).cos();
    let x: Vec<f64> = noise(14, 1500).iter().enumerate().map(|(k, v)| v * tone(k)).collect();
    let got = envelope_spectrum(&x, 1000.0, Some((100.0, 300.0)), WindowKind::Hann, Level::Peak).unwrap();
    let inner = got.values[1..got.values.len() - 1].iter().copied().step_by(5).collect::<Vec<_>>();
    assert_all("envelope", &inner, &numbers(&oracle()["envelope"]));
}
