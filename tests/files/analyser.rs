//! FRF estimates compared with an analyser's (SignalCalc): impact test of a plane with three accelerometers.
//!
//! The file contains time blocks X, windowed blocks W and spectra S of the last hit, and the averages over
//! all hits: G (auto-spectra as peak amplitudes, cross spectra as half products), H and C, all in single
//! precision, 6e-8 of the largest value of each kind.

use rotordyn::io::measured::read;
use rotordyn::signal::Complex;
use rotordyn::signal::impact::{Hit, ImpactWindows, Limits, frf_from_hits, frf_from_spectra, inspect};
use rotordyn::signal::record::{MeasuredData, Values};

use crate::measured_data::measured;

/// Round-off of single precision after a few operations.
const SINGLE: f64 = 3e-7;

fn file() -> Option<MeasuredData> {
    measured("plane_ema/lab1_DPsv00001.mat").map(|path| read(&path).unwrap())
}

fn real<'a>(file: &'a MeasuredData, name: &str) -> &'a [f64] {
    match &file.record(name).unwrap().values {
        Values::Real(values) => values,
        Values::Complex(_) => panic!("{name} is complex"),
    }
}

fn complex<'a>(file: &'a MeasuredData, name: &str) -> &'a [Complex<f64>] {
    match &file.record(name).unwrap().values {
        Values::Complex(values) => values,
        Values::Real(_) => panic!("{name} is real"),
    }
}

fn largest(values: &[Complex<f64>]) -> f64 {
    values.iter().map(|v| v.norm()).fold(0.0, f64::max)
}

/// The analyser's windows from W/X: force window of 1 % of 16 s, exponential window e^{−t/14.4 s} (0.9 of the
/// block).
const WINDOWS: ImpactWindows = ImpactWindows { force_length: Some(82), time_constant: Some(14.4) };

#[test]
fn windows_match_the_analyser() {
    let Some(file) = file() else { return };
    let rate = file.record("X1").unwrap().sample_rate().unwrap();
    let (force, response) = WINDOWS.samples(8192, rate).unwrap();
    for channel in 1..=4 {
        let (x, w) = (real(&file, &format!("X{channel}")), real(&file, &format!("W{channel}")));
        let window = if channel == 1 { &force } else { &response };
        let top = x.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        assert!((0..8192).all(|n| (window[n] * x[n] - w[n]).abs() <= SINGLE * top), "channel {channel}");
    }
}

#[test]
fn single_hit_frf_is_ratio_of_spectra() {
    let Some(file) = file() else { return };
    let rate = file.record("X1").unwrap().sample_rate().unwrap();
    let f = complex(&file, "S1");
    for channel in 2..=4 {
        let hit = Hit { force: real(&file, "X1"), response: real(&file, &format!("X{channel}")) };
        let estimate = frf_from_hits(&[hit], rate, WINDOWS).unwrap();
        let x = complex(&file, &format!("S{channel}"));
        for k in 0..f.len() {
            let own = x[k] / f[k];
            let precision = SINGLE * (largest(x) + own.norm() * largest(f)) / f[k].norm();
            assert!((estimate.h1[k] - own).norm() <= precision, "channel {channel}, line {k}");
        }
        assert_eq!(estimate.frequencies[3200], 200.0);
        assert!(estimate.coherence.iter().all(|c| (c - 1.0).abs() < 1e-9), "coherence of a single hit");
    }
}

#[test]
fn averaged_h1_and_coherence_match_the_analyser() {
    let Some(file) = file() else { return };
    let square = |name: &str| real(&file, name).iter().map(|a| a * a).collect::<Vec<f64>>();
    let frequencies = file.record("H1_2").unwrap().axis.points(3201).unwrap();
    for channel in 2..=4 {
        let force = square("G1_1");
        let response = square(&format!("G{channel}_{channel}"));
        let cross: Vec<_> = complex(&file, &format!("G1_{channel}")).iter().map(|g| 2.0 * g).collect();
        let estimate = frf_from_spectra(&frequencies, &force, &response, &cross, 1.0 / 14.4).unwrap();
        let (h, c) = (complex(&file, &format!("H1_{channel}")), real(&file, &format!("C1_{channel}")));
        for k in 0..h.len() {
            assert!((estimate.h1[k] - h[k]).norm() <= SINGLE * h[k].norm(), "channel {channel}, line {k}");
            assert!((estimate.coherence[k] - c[k]).abs() <= 2.0 * SINGLE, "channel {channel}, line {k}");
            let order = [estimate.h1[k], estimate.hv[k], estimate.h2[k]].map(|h| h.norm());
            assert!(order[0] <= order[1] * (1.0 + 1e-12) && order[1] <= order[2] * (1.0 + 1e-12));
            assert!((estimate.hv[k].norm_sqr() / (order[0] * order[2]) - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn measured_hit_passes_quality_checks() {
    let Some(file) = file() else { return };
    let (_, window) = WINDOWS.samples(8192, 512.0).unwrap();
    let hit = Hit { force: real(&file, "X1"), response: real(&file, "X2") };
    let quality = inspect(&hit, &Limits::default(), Some(&window)).unwrap();
    assert_eq!((quality.peak.0, quality.contact.clone()), (5, 5..7));
    assert!(quality.is_good() && quality.faults().is_empty(), "{quality:?}");
}
