//! Lines of the mains in FRFs, and resonances as narrow as a line.

use rotordyn_identify::{Settings, identify, low_coherence, without_single_lines};
use rotordyn_linalg::Complex64;

use crate::known_modes::{KnownMode, bending_shape, frfs, lines};
use crate::random::Random;

fn modes(zeta: f64) -> Vec<KnownMode> {
    modes_at([40.4, 45.1, 82.9, 85.3], zeta)
}

fn modes_at(hz: [f64; 4], zeta: f64) -> Vec<KnownMode> {
    let mode = |k: usize| KnownMode::real(hz[k], zeta, &bending_shape(k + 1, 6), &[0, 3]);
    (0..4).map(mode).collect()
}

/// Four modes are found although the lines at 50, 100 and 150 Hz are the mains' alone.
#[test]
fn lines_of_the_mains_are_replaced() {
    for spread in [&[1.0][..], &[0.5, 1.0, 0.5]] {
        let mut made = frfs(&modes(0.004), &lines(5.0, 160.0, 0.5), 2);
        let mut random = Random::new(5);
        let clean = made.clone();
        let largest = clean.values.iter().flatten().flatten().map(|h| h.norm()).fold(0.0, f64::max);
        let noise = 1e-4 * largest;
        made.values.iter_mut().flatten().flatten().for_each(|h| {
            *h += Complex64::new(noise * random.gaussian(), noise * random.gaussian());
        });
        for hz in [50.0, 100.0, 150.0] {
            let k = ((hz - 5.0) / 0.5) as usize;
            for frf in made.values.iter_mut().flatten() {
                let hum = Complex64::new(random.gaussian(), random.gaussian()) * 0.3 * largest;
                let first = k - spread.len() / 2;
                spread.iter().enumerate().for_each(|(j, share)| frf[first + j] += hum * *share);
            }
        }
        let (repaired, at) = without_single_lines(&made).unwrap();
        assert_eq!(at, [50.0, 100.0, 150.0]);
        let found = identify(&repaired, &Settings::default()).unwrap();
        let list: Vec<_> = found.modes.iter().map(|m| (m.frequency_hz(), m.damping_ratio())).collect();
        assert_eq!(found.modes.len(), 4, "{list:?}, dropped {:?}", found.dropped);
        for (mode, known) in found.modes.iter().zip(&modes(0.004)) {
            assert!((mode.pole - known.pole).norm() < 0.05 * known.pole.re.abs(), "{list:?}");
        }
    }
}

/// Resonances of any width, at and between the lines, and at the mains' frequencies, are none.
#[test]
fn resonances_are_no_single_lines() {
    for zeta in [1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2] {
        for shift in 0..20 {
            let from = 5.0 + 0.025 * f64::from(shift);
            for power in 0..3 {
                let made = frfs(
                    &modes_at([49.95, 60.1, 100.0, 120.2], zeta),
                    &lines(from, from + 150.0, 0.5),
                    power,
                );
                let found = without_single_lines(&made).map(|(_, at)| at);
                assert_eq!(found, None, "zeta {zeta}, from {from}, power {power}");
            }
        }
    }
}

/// Resonances at which the coherence is low are named, with it; FRFs that do not hold the mode do not count.
#[test]
fn low_coherence_at_resonances_is_named() {
    let mut made = frfs(&modes(0.004), &lines(5.0, 160.0, 0.25), 2);
    let found = identify(&made, &Settings::default()).unwrap();
    assert_eq!(low_coherence(&made, &found), None);
    let near = |hz: f64, f: f64| (hz - f).abs() < 2.0;
    let of = |f: &f64| if near(*f, 82.9) { 0.4 } else { 0.99 };
    let own: Vec<f64> = made.frequencies.iter().map(of).collect();
    made.coherence = Some(vec![vec![own; 2]; 6]);
    let text = low_coherence(&made, &found).unwrap();
    assert!(text.contains("(0.40 at 82.9") && !text.contains("45."), "{text}");
    made.coherence = Some(vec![vec![vec![0.95; made.frequencies.len()]; 2]; 6]);
    assert_eq!(low_coherence(&made, &found), None);
}
