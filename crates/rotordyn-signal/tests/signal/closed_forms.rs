//! Tones, chirps, Parseval, modulated tones, orbits, statistics, in closed form.

use std::f64::consts::{PI, SQRT_2, TAU};

use rotordyn_signal::WindowKind;
use rotordyn_signal::envelope::{envelope, envelope_spectrum};
use rotordyn_signal::orbit::{FilteredOrbit, full_spectrum};
use rotordyn_signal::ridge::{find_hann_lines, find_peaks, interpolate_peak, trace_line};
use rotordyn_signal::spectrum::{Level, Welch, amplitude_spectrum, decibel, power_spectral_density};
use rotordyn_signal::statistics::statistics;
use rotordyn_signal::stft::{Stft, StftSettings};
use rotordyn_signal::waterfall::waterfall;
use rotordyn_signal::window::{coherent_gain, noise_bandwidth};

use crate::{assert_close, noise, sampled};

const KINDS: [WindowKind; 5] = [
    WindowKind::Rectangular,
    WindowKind::Hann,
    WindowKind::Hamming,
    WindowKind::Blackman,
    WindowKind::FlatTop,
];

/// Harris 1978, table I, and a₀, (a₀² + Σa²/2)/a₀² of each window's coefficients.
#[test]
fn window_gains() {
    let expected = [(1.0, 1.0), (0.5, 1.5), (0.54, 1.362826), (0.42, 1.726757), (0.215579, 3.770246)];
    for (kind, (gain, bandwidth)) in KINDS.iter().zip(expected) {
        let w = kind.samples(64);
        assert_close("gain", coherent_gain(&w), gain, 1e-6);
        assert_close("noise bandwidth", noise_bandwidth(&w), bandwidth, 1e-6);
    }
}

#[test]
fn amplitude_of_a_tone_at_a_bin_with_every_window() {
    let x = sampled(1000, 1000.0, |t| 2.0 + 3.0 * (TAU * 120.0 * t + 0.7).cos());
    for kind in KINDS {
        let peak = amplitude_spectrum(&x, 1000.0, kind, Level::Peak).unwrap();
        let rms = amplitude_spectrum(&x, 1000.0, kind, Level::Rms).unwrap();
        assert_eq!(peak.frequencies[120], 120.0);
        assert_close("peak", peak.values[120], 3.0, 1e-12);
        assert_close("rms", rms.values[120], 3.0 / SQRT_2, 1e-12);
        assert_close("mean", peak.values[0], 2.0, 1e-12);
        assert_close("mean", rms.values[0], 2.0, 1e-12);
    }
}

/// The worst case of a tone between bins: a flat top loses less than 0.02 dB.
#[test]
fn flat_top_amplitude_between_bins() {
    let x = sampled(1000, 1000.0, |t| (TAU * 120.5 * t).cos());
    let spectrum = amplitude_spectrum(&x, 1000.0, WindowKind::FlatTop, Level::Peak).unwrap();
    assert!(decibel(spectrum.values[120], 1.0).abs() < 0.02, "{}", spectrum.values[120]);
}

#[test]
fn nyquist_line_is_not_doubled() {
    let x: Vec<f64> = (0..64).map(|n| if n % 2 == 0 { 1.5 } else { -1.5 }).collect();
    let spectrum = amplitude_spectrum(&x, 64.0, WindowKind::Rectangular, Level::Peak).unwrap();
    assert_close("Nyquist", spectrum.values[32], 1.5, 1e-14);
}

/// Σ S Δf = mean square (rectangular, any parity); Σ A_rms² / B = mean square for windowed steady signals.
#[test]
fn parseval() {
    for n in [999, 1000] {
        let x = noise(5, n);
        let mean_square = x.iter().map(|v| v * v).sum::<f64>() / n as f64;
        let welch = Welch { window: WindowKind::Rectangular, segment: n, overlap: 0, remove_mean: false };
        let psd = power_spectral_density(&x, 500.0, &welch).unwrap();
        assert_close("density", psd.values.iter().sum::<f64>() * psd.frequencies[1], mean_square, 1e-12);
        let rms = amplitude_spectrum(&x, 500.0, WindowKind::Rectangular, Level::Rms).unwrap();
        assert_close("amplitude", rms.values.iter().map(|a| a * a).sum(), mean_square, 1e-12);
    }
    let x = sampled(1000, 1000.0, |t| (TAU * 100.0 * t).sin() + 0.5 * (TAU * 300.3 * t).sin());
    let rms = amplitude_spectrum(&x, 1000.0, WindowKind::Hann, Level::Rms).unwrap();
    let power = rms.values.iter().map(|a| a * a).sum::<f64>() * rms.frequencies[1] / rms.noise_bandwidth_hz;
    // The windowed energy of the tone between bins depends on its phase at the ends, by 1e-4 here.
    assert_close("windowed", power, 0.5 + 0.125, 1e-3);
}

/// Linear chirp from 50 to 450 Hz in 10 s: the ridge follows f = 50 + 40 t and keeps its amplitude.
#[test]
fn chirp_through_the_stft() {
    let rate = 2000.0;
    let x = sampled(20_000, rate, |t| 1.7 * (TAU * (50.0 * t + 20.0 * t * t)).cos());
    let settings = StftSettings::new(WindowKind::Hann, 256, 0.75).unwrap();
    let map = Stft::new(settings, rate).unwrap().spectrogram(&x).unwrap();
    let line: Vec<f64> = map.times.iter().map(|t| 50.0 + 40.0 * t).collect();
    let ridge = trace_line(&map.frequencies, &map.amplitude, &line, 20.0).unwrap();
    let bin = map.frequencies[1];
    for (peak, f) in ridge.iter().zip(&line) {
        let peak = peak.expect("a peak in every frame");
        assert_close("frequency", peak.position, *f, 0.05 * bin);
        // The chirp sweeps 0.65 bins within a frame, which widens the lobe; parabolic interpolation of
        // a Hann lobe is up to 3.7 % high.
        assert_close("amplitude", peak.amplitude, 1.7, 0.04 * 1.7);
    }
    let speed = sampled(x.len(), rate, |t| 60.0 * (50.0 + 40.0 * t));
    for (rpm, f) in map.speed_at_frames(&speed, rate).unwrap().iter().zip(&line) {
        assert_close("speed", *rpm, 60.0 * f, 1e-9);
    }
}

#[test]
fn zero_padding_only_interpolates() {
    let x = noise(3, 300);
    let mut settings = StftSettings::new(WindowKind::Blackman, 100, 0.5).unwrap();
    let plain = Stft::new(settings, 100.0).unwrap().spectrogram(&x).unwrap();
    settings.fft_length = 400;
    let padded = Stft::new(settings, 100.0).unwrap().spectrogram(&x).unwrap();
    for frame in 0..plain.times.len() {
        // Zero frequency and Nyquist are bins of both.
        for (k, a) in plain.row(frame).iter().enumerate() {
            assert_close("common bin", padded.row(frame)[4 * k], *a, 1e-13);
        }
    }
    assert_close("noise bandwidth", padded.noise_bandwidth_bins, 4.0 * plain.noise_bandwidth_bins, 1e-12);
}

/// A parabola in ln A is exact for a Gaussian lobe.
#[test]
fn peak_between_bins() {
    let axis: Vec<f64> = (0..20).map(|k| 0.5 * k as f64).collect();
    let lobe: Vec<f64> = axis.iter().map(|f| 3.0 * (-(f - 4.13f64).powi(2)).exp()).collect();
    let peak = interpolate_peak(&axis, &lobe, 8);
    assert_close("position", peak.position, 4.13, 1e-12);
    assert_close("amplitude", peak.amplitude, 3.0, 1e-12);
    let found = find_peaks(&axis, &lobe, 1.0).unwrap();
    assert_eq!(found, vec![peak]);
}

/// Frequency and amplitude of a sine at any place between the bins, from a Hann-windowed spectrum.
#[test]
fn lines_of_a_hann_window_are_exact() {
    for step in 0..=20 {
        let frequency = 50.0 + 0.05 * f64::from(step);
        let x = sampled(10_000, 1000.0, |t| 3.0 * (TAU * frequency * t + 0.4).sin());
        let spectrum = amplitude_spectrum(&x, 1000.0, WindowKind::Hann, Level::Peak).unwrap();
        let lines = find_hann_lines(&spectrum.frequencies, &spectrum.values, 1.0).unwrap();
        assert_eq!(lines.len(), 1, "{lines:?}");
        // The mirrored line, a thousand bins away, has 1e-9 of it.
        assert_close("frequency", lines[0].position, frequency, 1e-6);
        assert_close("amplitude", lines[0].amplitude, 3.0, 1e-5);
    }
}

/// The flank of a peak outside the search band is not taken for a ridge.
#[test]
fn flank_is_not_a_ridge() {
    let axis: Vec<f64> = (0..20).map(f64::from).collect();
    let lobe: Vec<f64> = axis.iter().map(|f| (-(f - 10.0f64).powi(2) / 8.0).exp()).collect();
    assert_eq!(trace_line(&axis, &lobe, &[5.0], 2.0).unwrap(), vec![None]);
    assert!(trace_line(&axis, &lobe, &[9.0], 2.0).unwrap()[0].is_some());
}

/// (1 + m cos ω_m t) cos ω_c t has the envelope 1 + m cos ω_m t.
#[test]
fn envelope_of_a_modulated_tone() {
    let modulation = |t: f64| 1.0 + 0.4 * (TAU * 20.0 * t).cos();
    let x = sampled(2000, 2000.0, |t| modulation(t) * (TAU * 400.0 * t).cos());
    for (k, e) in envelope(&x).unwrap().iter().enumerate() {
        assert_close("envelope", *e, modulation(k as f64 / 2000.0), 1e-12);
    }
    let plain = envelope_spectrum(&x, 2000.0, None, WindowKind::Rectangular, Level::Peak).unwrap();
    assert_close("line", plain.values[20], 0.4, 1e-12);
    assert_close("mean", plain.values[0], 0.0, 1e-12);
    // A low-frequency tone masks the modulation until the band-pass removes it.
    let with_rumble: Vec<f64> =
        x.iter().enumerate().map(|(k, v)| v + 5.0 * (TAU * 30.0 * k as f64 / 2000.0).cos()).collect();
    let band = Some((300.0, 500.0));
    let banded = envelope_spectrum(&with_rumble, 2000.0, band, WindowKind::Hann, Level::Peak).unwrap();
    // The filter's gain at ±20 Hz from the middle of its ±100 Hz band is 1 within 1e-4; transients at the ends.
    assert_close("line in the band", banded.values[20], 0.4, 2e-3);
    assert_close("rumble in the band", banded.values[30], 0.0, 2e-3);
}

#[test]
fn statistics_of_known_records() {
    let sine = statistics(&sampled(1000, 1000.0, |t| 2.0 * (TAU * 10.0 * t).sin())).unwrap();
    assert_close("rms", sine.rms, SQRT_2, 1e-12);
    assert_close("peak", sine.peak, 2.0, 1e-12);
    assert_close("peak to peak", sine.peak_to_peak, 4.0, 1e-12);
    assert_close("crest factor", sine.crest_factor.unwrap(), SQRT_2, 1e-12);
    assert_close("kurtosis", sine.kurtosis.unwrap(), 1.5, 1e-12);
    assert_close("skewness", sine.skewness.unwrap(), 0.0, 1e-12);
    // One sample of height 1 in N: m_k = p(1−p)^k + (1−p)(−p)^k with p = 1/N.
    let mut pulse = vec![0.0; 10];
    pulse[3] = 1.0;
    let pulse = statistics(&pulse).unwrap();
    assert_close(
        "kurtosis",
        pulse.kurtosis.unwrap(),
        (0.1 * 0.9f64.powi(4) + 0.9 * 0.1f64.powi(4)) / 0.0081,
        1e-12,
    );
    assert_close(
        "skewness",
        pulse.skewness.unwrap(),
        (0.1 * 0.9f64.powi(3) - 0.9 * 0.1f64.powi(3)) / 0.027,
        1e-12,
    );
    let constant = statistics(&[0.1; 7]).unwrap();
    assert_eq!((constant.kurtosis, constant.skewness), (None, None));
    assert_eq!(statistics(&[0.0; 7]).unwrap().crest_factor, None);
}

/// x = a cos(νθ + α), y = b cos(νθ + β) plus other orders and an offset.
#[test]
fn filtered_orbit_and_its_whirl() {
    let theta: Vec<f64> = (0..720).map(|k| TAU * k as f64 / 240.0).collect();
    let along = |a: f64, phase: f64, offset: f64| -> Vec<f64> {
        theta.iter().map(|t| offset + a * (t + phase).cos() + 0.3 * (2.0 * t + 0.4).sin()).collect()
    };
    let (x, y) = (along(2.0, 0.5, 0.7), along(1.0, 0.5 - PI / 2.0, -0.2));
    let orbit = FilteredOrbit::fit(&x, &y, &theta, 1.0).unwrap();
    assert_close("amplitude", orbit.x.norm(), 2.0, 1e-12);
    assert_close("phase", orbit.x.arg(), 0.5, 1e-12);
    assert_close("forward", orbit.forward().norm(), 1.5, 1e-12);
    assert_close("backward", orbit.backward().norm(), 0.5, 1e-12);
    let (major, minor) = orbit.semi_axes();
    assert_close("major", major, 2.0, 1e-12);
    assert_close("minor", minor, 1.0, 1e-12);
    assert_close("inclination", orbit.inclination(), 0.0, 1e-12);
    assert_close("centre", orbit.centre[0], 0.7, 1e-12);
    let points = orbit.points(4);
    assert_close("first point", points[0][0], 0.7 + 2.0 * 0.5f64.cos(), 1e-12);
    // Swapping the channels reverses the whirl direction.
    let swapped = FilteredOrbit::fit(&y, &x, &theta, 1.0).unwrap();
    assert!(swapped.semi_axes().1 < 0.0);

    let spectrum = full_spectrum(&x, &y, 240.0, WindowKind::Rectangular).unwrap();
    let at = |f: f64| spectrum.amplitude[spectrum.frequencies.iter().position(|v| *v == f).unwrap()];
    assert_close("forward line", at(1.0), 1.5, 1e-12);
    assert_close("backward line", at(-1.0), 0.5, 1e-12);
}

#[test]
fn full_spectrum_axis_of_odd_and_even_records() {
    for (n, first, last) in [(4, -2.0, 1.0), (5, -2.0, 2.0)] {
        let circle = |k: usize| TAU * k as f64 / n as f64;
        let x: Vec<f64> = (0..n).map(|k| circle(k).cos()).collect();
        let y: Vec<f64> = (0..n).map(|k| circle(k).sin()).collect();
        let s = full_spectrum(&x, &y, n as f64, WindowKind::Rectangular).unwrap();
        assert_eq!((s.frequencies[0], s.frequencies[n - 1]), (first, last));
        for (f, a) in s.frequencies.iter().zip(&s.amplitude) {
            assert_close("circle", *a, if *f == 1.0 { 1.0 } else { 0.0 }, 1e-14);
        }
    }
}

#[test]
fn waterfall_averages_near_each_speed() {
    let axis = [0.0, 1.0];
    let amplitude = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let rows = waterfall(&axis, &amplitude, &[100.0, 110.0, 200.0], &[105.0, 200.0, 300.0], 10.0).unwrap();
    assert_eq!(rows.rpm, vec![105.0, 200.0]);
    assert_eq!(rows.missing, vec![300.0]);
    assert_close("mean power", rows.amplitude[0], 5f64.sqrt(), 1e-14);
    assert_close("mean power", rows.amplitude[1], 10f64.sqrt(), 1e-14);
    assert_eq!(&rows.amplitude[2..], &[5.0, 6.0]);
}

/// An offset is no line: a record of 100 V with 1 mV at 10 Hz has that one.
#[test]
fn offset_is_no_line() {
    let record = sampled(4000, 1000.0, |t| 100.0 + 1e-3 * (TAU * 10.0 * t).sin());
    let found = amplitude_spectrum(&record, 1000.0, WindowKind::Hann, Level::Peak).unwrap();
    assert_close("offset", found.values[0], 100.0, 1e-9);
    let mut lines = find_hann_lines(&found.frequencies, &found.values, 0.0).unwrap();
    lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    assert_close("line", lines[0].position, 10.0, 1e-3);
    assert_close("level", lines[0].amplitude, 1e-3, 1e-6);
}
