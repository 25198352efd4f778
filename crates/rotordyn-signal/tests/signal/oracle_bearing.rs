//! numpy and scipy reference values (oracle_bearing.py, stored in tests/data/scipy_bearing_signal.json) to 1e-10.

use rotordyn_signal::WindowKind;
use rotordyn_signal::cepstrum::{Lifter, lifter, liftered_spectrum, power_cepstrum, real_cepstrum};
use rotordyn_signal::cyclic::cyclic_coherence;
use rotordyn_signal::envelope::{band_analytic_signal, squared_envelope_spectrum};
use rotordyn_signal::kurtogram::{fast_kurtogram, spectral_kurtosis};
use rotordyn_signal::spectrum::{Level, Welch};
use rotordyn_signal::statistics::statistics;
use serde_json::Value;

use crate::oracle::{assert_all, assert_all_complex, complex, count, numbers};
use crate::{assert_close, noise};

const RATE: f64 = 1000.0;

fn oracle() -> Value {
    serde_json::from_str(include_str!("../data/scipy_bearing_signal.json")).expect("the stored file is JSON")
}

/// The record x of the script: modulated noise with pulses.
fn input() -> Vec<f64> {
    let modulated = noise(5, 2500).into_iter().enumerate().map(|(n, v)| {
        let t = n as f64 / RATE;
        let pulse = if n % 97 == 0 { 3.0 } else { 0.0 };
        v * (1.0 + 0.8 * (std::f64::consts::TAU * 7.3 * t).cos()) + pulse + 0.1
    });
    modulated.collect()
}

#[test]
fn kurtogram_of_the_binary_ternary_bank() {
    let case = &oracle()["kurtogram"];
    let got = fast_kurtogram(&input(), RATE, count(&case["depth"])).unwrap();
    let levels = case["levels"].as_array().expect("levels");
    assert_eq!(got.levels.len(), levels.len());
    for (level, expected) in got.levels.iter().zip(levels) {
        assert_all(&format!("level {}", level.level), &level.values, &numbers(expected));
    }
}

#[test]
fn spectral_kurtosis_by_segments() {
    let case = &oracle()["spectral_kurtosis"];
    let (segment, overlap) = (count(&case["segment"]), count(&case["overlap"]));
    let welch = Welch { window: WindowKind::Hann, segment, overlap, remove_mean: false };
    let got = spectral_kurtosis(&input(), RATE, &welch).unwrap();
    assert_all("spectral kurtosis", &got.values, &numbers(&case["values"]));
}

#[test]
fn cepstra_and_liftering() {
    for case in oracle()["cepstra"].as_array().expect("cases") {
        let x = &input()[..count(&case["n"])];
        assert_all("real", &real_cepstrum(x, RATE).unwrap().values, &numbers(&case["real"]));
        assert_all("power", &power_cepstrum(x, RATE).unwrap().values, &numbers(&case["power"]));
        let limit = case["limit"].as_f64().unwrap();
        let comb = Lifter::Comb {
            quefrency: case["tooth"].as_f64().unwrap(),
            half_width: case["half_width"].as_f64().unwrap(),
        };
        for (name, kind) in
            [("low", Lifter::LowTime(limit)), ("high", Lifter::HighTime(limit)), ("comb", comb)]
        {
            let expected = &case["lifted"][name];
            let spectrum = liftered_spectrum(x, RATE, kind).unwrap();
            assert_all(name, &spectrum.values, &numbers(&expected["magnitude"]));
            assert_all(name, &lifter(x, RATE, kind).unwrap(), &numbers(&expected["record"]));
        }
    }
}

#[test]
fn bands_and_their_squared_envelope() {
    for case in oracle()["bands"].as_array().expect("cases") {
        let x = &input()[..count(&case["n"])];
        let band = (case["low"].as_f64().unwrap(), case["high"].as_f64().unwrap());
        let what = format!("{band:?}");
        let got = band_analytic_signal(x, RATE, band).unwrap();
        assert_all_complex(&what, &got, &complex(&case["analytic"]));
        let spectrum = squared_envelope_spectrum(x, RATE, Some(band), WindowKind::Hann, Level::Peak).unwrap();
        let inner = &spectrum.values[1..spectrum.values.len() - 1];
        assert_all(&what, inner, &numbers(&case["squared_envelope"]));
    }
}

#[test]
fn cyclic_coherence_by_the_averaged_cyclic_periodogram() {
    let case = &oracle()["cyclic"];
    let (segment, overlap) = (count(&case["segment"]), count(&case["overlap"]));
    let welch = Welch { window: WindowKind::Hann, segment, overlap, remove_mean: true };
    let rows = case["rows"].as_array().expect("rows");
    let alphas: Vec<f64> = rows.iter().map(|r| r["alpha"].as_f64().unwrap()).collect();
    let got = cyclic_coherence(&input(), RATE, &alphas, &welch).unwrap();
    for (k, row) in rows.iter().enumerate() {
        assert_all(&format!("alpha {}", alphas[k]), got.row(k), &numbers(&row["squared"]));
    }
}

#[test]
fn shape_impulse_and_clearance_factors() {
    let got = statistics(&input()).unwrap();
    let expected = &oracle()["statistics"];
    for (name, value) in [
        ("mean_absolute", got.mean_absolute),
        ("shape_factor", got.shape_factor.unwrap()),
        ("impulse_factor", got.impulse_factor.unwrap()),
        ("clearance_factor", got.clearance_factor.unwrap()),
    ] {
        assert_close(name, value, expected[name].as_f64().unwrap(), 1e-10);
    }
}
