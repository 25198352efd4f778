//! Atef et al. 2022: spectral lines of two defects and of an inner-race defect, on the machine of
//! models/atef_2022.toml by the ids of tests/data/atef_2022.json.

use crate::agree;
use crate::atef_2022_records::{BPFI, BPFO, Records, band_envelope, harmonics, lines, simulate};
use rayon::prelude::*;
use rotordyn::signal::envelope::envelope;

fn largest(values: &[f64]) -> usize {
    (0..values.len()).reduce(|a, b| if values[b] > values[a] { b } else { a }).unwrap() + 1
}

/// A dent at 0 and another defect at an angle from it, by its kind and height.
fn pair(angle: f64, other: &str, more: &[(&str, &str)]) -> Records {
    let common = "on = \"outer\", width = \"0.17 mm\"";
    let defects = format!(
        "[{{ kind = \"dent\", angle = \"0 deg\", {common} }}, {{ {other}, angle = \"{angle} deg\", {common} }}]"
    );
    let set = [&[("bearing.B.defect", defects.as_str())], more].concat();
    simulate("two_dents", &set, 0.25, 0.5)
}

/// A30: which harmonic of the envelope is the strongest follows from the resonator's decay rate σ.
///
/// Responses to impulses at 0 and β decay with σ: |H_n| = 2 |cos(πnβ/40)|/√(σ² + (2πn BPFO)²), the second
/// strongest from 332 to 1182 1/s. This holds in a band around the resonance; the unfiltered envelope also
/// contains the forced motion while a ball is on a dent, and at 10 kHz and 1000 1/s its third harmonic is
/// larger by up to 2 %.
#[test]
fn strongest_harmonic_of_two_dents() {
    let cases: Vec<(f64, f64, f64)> = [5000.0, 10000.0]
        .into_iter()
        .flat_map(|hz| [15.0, 25.0].map(|angle| (hz, angle)))
        .flat_map(|(hz, angle)| [200.0, 400.0, 700.0, 1000.0, 2500.0].map(|sigma| (hz, angle, sigma)))
        .collect();
    cases.into_par_iter().for_each(|(hz, angle, sigma)| {
        let stiffness = format!("{} N/m", (std::f64::consts::TAU * hz).powi(2));
        let damping = format!("{} N s/m", 2.0 * sigma);
        let resonator = [
            ("bushing.resonator.k_x", stiffness.as_str()),
            ("bushing.resonator.k_y", &stiffness),
            ("bushing.resonator.c_x", &damping),
            ("bushing.resonator.c_y", &damping),
        ];
        let got = pair(angle, "kind = \"dent\"", &resonator);
        let expected = match sigma {
            s if s <= 200.0 => 1,
            s if s <= 1000.0 => 2,
            _ => 3,
        };
        let case = format!("{hz} Hz, {angle} deg, {sigma} 1/s");
        let ringing = band_envelope(&got.resonator, got.rate, (0.7 * hz, 1.3 * hz));
        let ringing = lines(&ringing, got.rate, &harmonics(BPFO, 6));
        let raw = lines(&envelope(&got.resonator).unwrap(), got.rate, &harmonics(BPFO, 6));
        assert_eq!(largest(&ringing), expected, "{case}: {ringing:?}");
        let top = raw[largest(&raw) - 1];
        if sigma == 1000.0 && hz == 10000.0 {
            assert!(raw[expected - 1] > 0.97 * top, "{case}: {raw:?}");
        } else {
            assert_eq!(largest(&raw), expected, "{case}: {raw:?}");
        }
        if sigma >= 300.0 {
            assert!(raw[3] < 0.05 * top, "{case}: {raw:?}");
        }
    });
}

/// Angles of a second defect, none of which overlaps the first \[deg\].
const ANGLES: [f64; 15] =
    [1.0, 2.5, 5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0, 22.5, 25.0, 27.5, 30.0, 35.0, 39.0];

/// Angle of the smallest value (sign 1) or of the largest (sign −1).
fn angle_of_extremum(values: &[f64], sign: f64) -> f64 {
    let best = |a: usize, b: usize| if sign * values[b] < sign * values[a] { b } else { a };
    ANGLES[(0..values.len()).reduce(best).unwrap()]
}

/// A33: two equal dents interfere, at BPFO as |cos(πβ/40)|, at 2 BPFO as |cos(2πβ/40)|.
#[test]
fn acceleration_of_two_dents_over_angle() {
    let one = |angle: &f64| {
        let got = pair(*angle, "kind = \"dent\"", &[]);
        let found = lines(&got.resonator, got.rate, &harmonics(BPFO, 2));
        [found[0], found[1]]
    };
    let found: Vec<[f64; 2]> = ANGLES.par_iter().map(one).collect();
    let [first, second] = [0, 1].map(|n| found.iter().map(|f| f[n]).collect::<Vec<f64>>());
    let ideal: Vec<f64> = ANGLES.iter().map(|b| (std::f64::consts::PI * b / 40.0).cos().abs()).collect();
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let product =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| (x - mean(a)) * (y - mean(b))).sum::<f64>();
    let correlation = product(&first, &ideal) / (product(&first, &first) * product(&ideal, &ideal)).sqrt();
    assert!(correlation > 0.98, "{correlation}");
    assert_eq!(angle_of_extremum(&first, 1.0), 20.0, "{first:?}");
    // a + b cos(2πβ/40), as eq. 23.
    let wave: Vec<f64> = ANGLES.iter().map(|b| (std::f64::consts::TAU * b / 40.0).cos()).collect();
    let slope = product(&wave, &first) / product(&wave, &wave);
    let ratio = slope / (mean(&first) - slope * mean(&wave));
    agree::absolute("b/a of equation 23", ratio, 0.656, 0.03);
    // Smallest at 10 and 30 deg, largest at both ends and at 20.
    let at = |angle: f64| second[ANGLES.iter().position(|a| *a == angle).unwrap()];
    assert!(at(10.0) < 0.1 * at(1.0) && at(30.0) < 0.1 * at(1.0), "{second:?}");
    assert!(at(20.0) > at(17.5) && at(20.0) > at(22.5) && at(39.0) > at(35.0), "{second:?}");
}

/// A34: for a dent and a bump of equal strength, 20 deg apart, acceleration is largest and the envelope
/// smallest.
#[test]
fn dent_and_bump_over_angle() {
    let one = |angle: &f64| {
        let got = pair(*angle, "kind = \"bump\", height = \"0.910049 um\"", &[]);
        let envelope = envelope(&got.resonator).unwrap();
        [lines(&got.resonator, got.rate, &[BPFO])[0], lines(&envelope, got.rate, &[BPFO])[0]]
    };
    let found: Vec<[f64; 2]> = ANGLES.par_iter().map(one).collect();
    let [acceleration, envelope] = [0, 1].map(|n| found.iter().map(|f| f[n]).collect::<Vec<f64>>());
    assert_eq!(angle_of_extremum(&acceleration, -1.0), 20.0, "{acceleration:?}");
    assert_eq!(angle_of_extremum(&envelope, 1.0), 20.0, "{envelope:?}");
}

/// A35: a defect on a loaded inner race gives BPFI with sidebands at the shaft frequency, and none at the
/// frequencies by the printed sign of eq. 3.
#[test]
fn sidebands_of_an_inner_race_defect() {
    const SHAFT: f64 = 1797.0 / 60.0;
    let got = simulate("loaded_inner_dent", &[], 0.25, 1.0);
    let envelope = envelope(&got.resonator).unwrap();
    let printed = 2.0 * BPFO / 9.0 - SHAFT;
    agree::absolute("frequency by the printed sign [Hz]", printed, -6.09, 0.01);
    let at = [0.0, -SHAFT, SHAFT, -printed, printed].map(|by| BPFI + by);
    let found = lines(&envelope, got.rate, &at);
    let [carrier, below, above, others @ ..] = &found[..] else { panic!() };
    // The resonance makes them unequal.
    let mean = 0.5 * (below + above) / carrier;
    assert!((0.82..0.94).contains(&mean), "{found:?}");
    assert!(others.iter().all(|line| line / carrier < 0.02), "{found:?}");
}
