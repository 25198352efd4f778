//! Unusable records and settings: an error with the expected and the given value, never a panic.

use rotordyn_signal::bearing_lines::{DefectFrequencies, LineSettings};
use rotordyn_signal::cepstrum::{Lifter, lifter, liftered_spectrum, power_cepstrum, real_cepstrum};
use rotordyn_signal::cyclic::cyclic_coherence;
use rotordyn_signal::diagnosis::{BandRule, ShaftRotation, diagnose};
use rotordyn_signal::envelope::{
    analytic_signal, band_analytic_signal, envelope_spectrum, squared_envelope_spectrum,
};
use rotordyn_signal::filter::{Band, butterworth};
use rotordyn_signal::impact::{Hit, ImpactWindows, frf_from_hits};
use rotordyn_signal::jerk::{impulses, jerk, jerk_jumps};
use rotordyn_signal::kurtogram::{fast_kurtogram, scored_bands, spectral_kurtosis};
use rotordyn_signal::orbit::{FilteredOrbit, full_spectrum};
use rotordyn_signal::order::{OrderSettings, OrderTracker};
use rotordyn_signal::race_defects::{BallPassage, race_defects};
use rotordyn_signal::resample::{AngleResampler, integrate_speed, to_uniform_time, uniform_rate};
use rotordyn_signal::ridge::{find_peaks, trace_line};
use rotordyn_signal::spectrum::{
    Level, Welch, amplitude_spectrum, coherence, cross_spectral_density, power_spectral_density,
};
use rotordyn_signal::statistics::statistics;
use rotordyn_signal::stft::{Stft, StftSettings};
use rotordyn_signal::synchronous::synchronous_average;
use rotordyn_signal::tacho::rising_edges;
use rotordyn_signal::waterfall::waterfall;
use rotordyn_signal::{SignalError, WindowKind};

/// Errors of every function that takes a record, applied to `x`.
fn errors_of_all_functions(x: &[f64], rate: f64) -> Vec<(&'static str, Option<SignalError>)> {
    let welch = Welch::hann(16);
    let hann = WindowKind::Hann;
    let stft = || Stft::new(StftSettings::new(hann, 16, 0.5)?, rate)?.spectrogram(x);
    let filter = || butterworth(2, Band::LowPass(0.1 * rate), rate)?.filter_zero_phase(x);
    let once = || butterworth(2, Band::LowPass(0.1 * rate), rate)?.filter(x);
    let rates = DefectFrequencies { shaft: 1.0, cage: 0.4, outer: 3.6, inner: 5.4, ball: 2.4 };
    let passage = BallPassage { frequency: 3.6, balls: 9, race_speed: 0.0, datum: 0.0 };
    let hit = [Hit { force: x, response: x }];
    vec![
        ("amplitude", amplitude_spectrum(x, rate, hann, Level::Rms).err()),
        ("psd", power_spectral_density(x, rate, &welch).err()),
        ("csd", cross_spectral_density(x, x, rate, &welch).err()),
        ("coherence", coherence(x, x, rate, &welch).err()),
        ("stft", stft().err()),
        ("zero phase", filter().err()),
        ("filter", once().err()),
        ("analytic", analytic_signal(x).err()),
        ("envelope", envelope_spectrum(x, rate, Some((0.1 * rate, 0.2 * rate)), hann, Level::Peak).err()),
        ("orbit", FilteredOrbit::fit(x, x, x, 1.0).err()),
        ("full spectrum", full_spectrum(x, x, rate, hann).err()),
        ("statistics", statistics(x).err()),
        ("hits", frf_from_hits(&hit, rate, ImpactWindows::default()).err()),
        ("angle", AngleResampler::new(x, rate, 32, 0.05).err()),
        ("orders", OrderTracker::new(x, rate, OrderSettings::new(0.05, 10.0)).err()),
        ("speed", integrate_speed(x, rate, 0.0).err()),
        ("rate", uniform_rate(x).err()),
        ("spline", to_uniform_time(x, x, rate).err()),
        ("peaks", find_peaks(x, x, 0.0).err()),
        ("ridge", trace_line(x, x, &[1.0], 1.0).err()),
        ("waterfall", waterfall(x, x, &[1.0], &[1.0], 1.0).err()),
        ("band", band_analytic_signal(x, rate, (0.1 * rate, 0.2 * rate)).err()),
        (
            "squared envelope",
            squared_envelope_spectrum(x, rate, Some((0.0, 0.5 * rate)), hann, Level::Peak).err(),
        ),
        ("cepstrum", real_cepstrum(x, rate).err()),
        ("power cepstrum", power_cepstrum(x, rate).err()),
        ("lifter", lifter(x, rate, Lifter::LowTime(1.0)).err()),
        ("liftered spectrum", liftered_spectrum(x, rate, Lifter::HighTime(1.0)).err()),
        ("kurtogram", fast_kurtogram(x, rate, 1).err()),
        ("scored bands", scored_bands(x, rate, 1, |_| 0.0).err()),
        ("spectral kurtosis", spectral_kurtosis(x, rate, &welch).err()),
        ("cyclic", cyclic_coherence(x, rate, &[0.1], &welch).err()),
        ("synchronous", synchronous_average(x, 4).err()),
        ("jerk", jerk(x, rate).err()),
        ("jumps", jerk_jumps(x, rate, 8.0).err()),
        ("impulses", impulses(&[x, x], rate, 0.01, 0.1, 0.5).err()),
        ("edges", rising_edges(x, rate, None, 0.1).err()),
        ("defects", race_defects(x, Some(x), rate, &passage).err()),
        (
            "diagnosis",
            diagnose(
                x,
                rate,
                ShaftRotation::ConstantSpeed,
                &rates,
                BandRule::Lines,
                &LineSettings::default(),
            )
            .err(),
        ),
    ]
}

/// Functions that need no sampling rate.
const WITHOUT_RATE: [&str; 9] =
    ["analytic", "orbit", "statistics", "rate", "peaks", "ridge", "waterfall", "filter", "synchronous"];

#[test]
fn empty_records() {
    for (name, error) in errors_of_all_functions(&[], 1000.0) {
        let error = error.unwrap_or_else(|| panic!("{name} accepted an empty record"));
        assert!(matches!(error, SignalError::Empty { .. }), "{name}: {error}");
    }
}

#[test]
fn nan_and_infinity() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut x: Vec<f64> = (0..64).map(|k| 0.01 * f64::from(k)).collect();
        x[37] = bad;
        for (name, error) in errors_of_all_functions(&x, 1000.0) {
            let error = error.unwrap_or_else(|| panic!("{name} accepted {bad}"));
            assert!(matches!(error, SignalError::NotFinite { index: 37, .. }), "{name}: {error}");
        }
    }
}

#[test]
fn wrong_rates() {
    let x: Vec<f64> = (0..64).map(f64::from).collect();
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (name, error) in errors_of_all_functions(&x, rate) {
            let refused = matches!(error, Some(SignalError::OutOfRange { name: "sampling rate", .. }));
            assert!(refused || WITHOUT_RATE.contains(&name), "{name} at {rate}: {error:?}");
        }
    }
}

/// Records of 1 to 19 samples either work or are rejected, and never give NaN.
#[test]
fn very_short_records_do_not_panic() {
    for n in 1..20 {
        let x: Vec<f64> = (0..n).map(f64::from).collect();
        let refused: Vec<_> =
            errors_of_all_functions(&x, 100.0).into_iter().filter(|(_, e)| e.is_some()).collect();
        let names: Vec<_> = refused.iter().map(|(name, _)| *name).collect();
        assert_eq!(names.contains(&"psd"), n < 16, "{n}: {names:?}");
        assert_eq!(names.contains(&"stft"), n < 16, "{n}: {names:?}");
        for always in ["kurtogram", "diagnosis", "defects", "jumps"] {
            assert!(names.contains(&always), "{n}: {names:?}");
        }
        let spectrum = amplitude_spectrum(&x, 100.0, WindowKind::Rectangular, Level::Peak).unwrap();
        assert!(spectrum.values.iter().all(|v| v.is_finite()));
    }
}

#[test]
fn messages_state_expected_and_given_values() {
    let x = [1.0; 10];
    let message = |e: SignalError| e.to_string();
    assert_eq!(
        message(power_spectral_density(&x, 1.0, &Welch::hann(16)).unwrap_err()),
        "record has 10 samples: at least 16 are needed for one segment"
    );
    assert_eq!(
        message(cross_spectral_density(&x, &x[1..], 1.0, &Welch::hann(4)).unwrap_err()),
        "second record has 9 samples: 10 were expected, as many as the first has"
    );
    assert_eq!(
        message(butterworth(2, Band::LowPass(600.0), 1000.0).unwrap_err()),
        "corner frequency = 600 is out of range: expected between 0 and half the sampling rate"
    );
    assert_eq!(
        message(statistics(&[1.0, f64::NAN]).unwrap_err()),
        "record holds NaN at sample 1: every sample must be finite"
    );
    assert_eq!(
        message(uniform_rate(&[0.0, 0.1, 0.2, 0.35]).unwrap_err()),
        "time is not uniform: the step after sample 0 is 1.000000e-1 s, the mean step is 1.166667e-1 s"
    );
    assert_eq!(
        message(StftSettings::new(WindowKind::Hann, 16, 1.0).unwrap_err()),
        "overlap = 1 is out of range: expected a fraction from 0 to below 1"
    );
}

#[test]
fn settings_out_of_range() {
    let theta: Vec<f64> = (0..1000).map(f64::from).collect();
    let base = OrderSettings::new(0.1, 10.0);
    for settings in [
        OrderSettings { resolution: 0.0, ..base },
        OrderSettings { resolution: f64::NAN, ..base },
        OrderSettings { max_order: 0.0, ..base },
        OrderSettings { max_order: f64::INFINITY, ..base },
        OrderSettings { overlap: 1.0, ..base },
        OrderSettings { min_speed: 0.0, ..base },
    ] {
        let error = OrderTracker::new(&theta, 100.0, settings).err().unwrap();
        assert!(matches!(error, SignalError::OutOfRange { .. }), "{settings:?}: {error}");
    }
    for (order, band) in [
        (0, Band::LowPass(10.0)),
        (21, Band::LowPass(10.0)),
        (2, Band::HighPass(0.0)),
        (2, Band::BandPass(20.0, 10.0)),
        (2, Band::BandPass(10.0, f64::NAN)),
    ] {
        assert!(butterworth(order, band, 100.0).is_err(), "{order} {band:?}");
    }
}
