//! scipy reference values (oracle.py, stored in tests/data/scipy_signal.json) to 1e-10.

use rotordyn_signal::filter::{Band, butterworth};
use rotordyn_signal::spectrum::{Level, Welch, coherence, cross_spectral_density, power_spectral_density};
use rotordyn_signal::stft::{Stft, StftSettings};
use rotordyn_signal::{Complex, WindowKind, envelope::analytic_signal, statistics::statistics};
use serde_json::Value;

use crate::{assert_close, assert_close_complex, noise, sampled};

const RATE: f64 = 1000.0;
/// Results are of order 1 and both sides work in doubles.
const TOLERANCE: f64 = 1e-10;

fn oracle() -> Value {
    serde_json::from_str(include_str!("../data/scipy_signal.json")).expect("the stored file is JSON")
}

/// The inputs x and y of the script.
fn inputs() -> (Vec<f64>, Vec<f64>) {
    let n = 400;
    let tone = sampled(n, RATE, |t| (2.0 * std::f64::consts::PI * 50.0 * t).sin());
    let x: Vec<f64> = noise(1, n).iter().zip(tone).map(|(a, b)| a + b).collect();
    let y = noise(2, n).iter().enumerate().map(|(k, v)| 0.5 * x[(k + n - 3) % n] + 0.3 * v + 0.2).collect();
    (x, y)
}

pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("an array").iter().map(|v| v.as_f64().expect("a number")).collect()
}

pub fn complex(value: &Value) -> Vec<Complex<f64>> {
    numbers(&value["re"])
        .into_iter()
        .zip(numbers(&value["im"]))
        .map(|(re, im)| Complex::new(re, im))
        .collect()
}

pub fn count(value: &Value) -> usize {
    value.as_u64().expect("a whole number") as usize
}

fn kind(value: &Value) -> WindowKind {
    match value.as_str().expect("a name") {
        "Rectangular" => WindowKind::Rectangular,
        "Hann" => WindowKind::Hann,
        "Hamming" => WindowKind::Hamming,
        "Blackman" => WindowKind::Blackman,
        "FlatTop" => WindowKind::FlatTop,
        other => panic!("unknown window {other}"),
    }
}

#[track_caller]
pub fn assert_all(what: &str, got: &[f64], expected: &[f64]) {
    assert_eq!(got.len(), expected.len(), "{what}");
    for (k, (g, e)) in got.iter().zip(expected).enumerate() {
        assert_close(&format!("{what} at {k}"), *g, *e, TOLERANCE);
    }
}

#[track_caller]
pub fn assert_all_complex(what: &str, got: &[Complex<f64>], expected: &[Complex<f64>]) {
    assert_eq!(got.len(), expected.len(), "{what}");
    for (k, (g, e)) in got.iter().zip(expected).enumerate() {
        assert_close_complex(&format!("{what} at {k}"), *g, *e, TOLERANCE);
    }
}

#[test]
fn windows() {
    for case in oracle()["windows"].as_array().expect("cases") {
        let got = kind(&case["kind"]).samples(count(&case["n"]));
        assert_all(&case["kind"].to_string(), &got, &numbers(&case["samples"]));
    }
}

#[test]
fn welch_densities_and_coherence() {
    let (x, y) = inputs();
    for case in oracle()["welch"].as_array().expect("cases") {
        let welch = Welch {
            window: kind(&case["kind"]),
            segment: count(&case["segment"]),
            overlap: count(&case["overlap"]),
            remove_mean: case["remove_mean"] == true,
        };
        let what = format!("{welch:?}");
        let psd = power_spectral_density(&x, RATE, &welch).unwrap();
        assert_all(&what, &psd.frequencies, &numbers(&case["frequencies"]));
        assert_all(&what, &psd.values, &numbers(&case["xx"]));
        let csd = cross_spectral_density(&x, &y, RATE, &welch).unwrap();
        assert_all_complex(&what, &csd.values, &complex(&case["xy"]));
        let coherence = coherence(&x, &y, RATE, &welch).unwrap();
        assert_all(&what, &coherence.values, &numbers(&case["coherence"]));
    }
}

#[test]
fn short_time_transform() {
    let (x, _) = inputs();
    let case = &oracle()["stft"];
    let settings = StftSettings {
        window: WindowKind::Hann,
        length: count(&case["length"]),
        hop: count(&case["hop"]),
        fft_length: count(&case["fft_length"]),
        level: Level::Rms,
    };
    let got = Stft::new(settings, RATE).unwrap().spectrogram(&x).unwrap();
    assert_all("times", &got.times, &numbers(&case["times"]));
    assert_all("frequencies", &got.frequencies, &numbers(&case["frequencies"]));
    for (k, row) in case["rms"].as_array().expect("rows").iter().enumerate() {
        assert_all("amplitude", got.row(4 * k), &numbers(row));
    }
}

#[test]
fn hilbert() {
    let (x, _) = inputs();
    for case in oracle()["hilbert"].as_array().expect("cases") {
        let got = analytic_signal(&x[..count(&case["n"])]).unwrap();
        assert_all_complex("analytic signal", &got, &complex(&case["analytic"]));
    }
}

#[test]
fn butterworth_filters() {
    let (x, _) = inputs();
    for case in oracle()["butterworth"].as_array().expect("cases") {
        let corner = &case["corner"];
        let single = || corner.as_f64().expect("a corner");
        let band = match case["kind"].as_str().expect("a kind") {
            "lowpass" => Band::LowPass(single()),
            "highpass" => Band::HighPass(single()),
            _ => Band::BandPass(numbers(corner)[0], numbers(corner)[1]),
        };
        let what = format!("order {} {band:?}", case["order"]);
        let filter = butterworth(count(&case["order"]), band, RATE).unwrap();
        let response: Vec<_> = numbers(&case["at"]).iter().map(|f| filter.response(*f, RATE)).collect();
        assert_all_complex(&what, &response, &complex(&case["response"]));
        let every_seventh = |v: Vec<f64>| v.into_iter().step_by(7).collect::<Vec<_>>();
        let once = every_seventh(filter.filter(&x).unwrap());
        assert_all(&what, &once, &numbers(&case["filtered"]));
        let twice = every_seventh(filter.filter_zero_phase(&x).unwrap());
        assert_all(&what, &twice, &numbers(&case["zero_phase"]));
    }
}

#[test]
fn moments() {
    let (_, y) = inputs();
    let cubed: Vec<f64> = y.iter().map(|v| v.powi(3)).collect();
    let got = statistics(&cubed).unwrap();
    let expected = &oracle()["statistics"];
    for (name, value) in [
        ("skewness", got.skewness.unwrap()),
        ("kurtosis", got.kurtosis.unwrap()),
        ("standard_deviation", got.standard_deviation),
        ("rms", got.rms),
    ] {
        assert_close(name, value, expected[name].as_f64().unwrap(), TOLERANCE);
    }
}
