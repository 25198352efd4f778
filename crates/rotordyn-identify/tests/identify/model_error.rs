//! Standard errors with model error: coverage of the 95 % interval for FRFs that no modal model fits exactly.

use std::f64::consts::TAU;

use rotordyn_identify::{Settings, identify};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Dof, FrfMatrix, MeasurementNoise};

use crate::known_modes::{KnownMode, bending_shape, lines};
use crate::random::Random;

/// What makes FRFs differ from a modal model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Misfit {
    /// Noise alone.
    None,
    /// Stiffness that varies from row to row: standard deviation 0.2 %.
    Stiffness,
    /// Mass of a sensor that is moved from row to row.
    SensorMass,
    /// Stiffness that grows with the amplitude: stepped sine of constant force.
    Nonlinear,
}

const KINDS: [Misfit; 4] = [Misfit::None, Misfit::Stiffness, Misfit::SensorMass, Misfit::Nonlinear];
const POINTS: usize = 10;

fn known(seed: u64, references: &[usize]) -> Vec<KnownMode> {
    let mut random = Random::new(seed + 1000);
    let hz = [14.0, 31.0, 47.0, 71.0, 96.0];
    let mut mode = |(k, hz): (usize, &f64)| {
        let zeta = 0.003 * 5f64.powf(random.uniform());
        let hz = hz * (1.0 + 0.05 * random.gaussian());
        KnownMode::real(hz, zeta, &bending_shape(k + 1, POINTS), references)
    };
    hz.iter().enumerate().map(&mut mode).collect()
}

/// Accelerances of the modes with a misfit, before noise.
fn measured(known: &[KnownMode], references: &[usize], misfit: Misfit, seed: u64) -> FrfMatrix {
    let mut random = Random::new(seed + 5000);
    let frequencies = lines(4.0, 115.0, 0.1);
    let rows: Vec<f64> = (0..POINTS).map(|_| 0.002 * random.gaussian()).collect();
    // Up to half a per cent of the modal mass, which lowers a frequency by up to a quarter of a per cent.
    let mass = 0.005 * random.uniform();
    // Relative stiffness added at the resonance peak.
    let hardening = 0.003 * random.uniform();
    let value = |r: usize, e: usize, f: f64| {
        let omega = TAU * f;
        let sum: Complex64 = known
            .iter()
            .map(|m| {
                let (shape, hit) = (m.shape[r].re, m.shape[references[e]].re);
                let (natural, zeta) = (m.pole.norm(), m.zeta());
                let (stiffer, heavier) = match misfit {
                    Misfit::Stiffness => (1.0 + rows[r], 1.0),
                    Misfit::SensorMass => (1.0, 1.0 + mass * shape * shape),
                    _ => (1.0, 1.0),
                };
                let peak = 2.0 * zeta;
                let dynamic = |amplitude: f64| {
                    let share = if misfit == Misfit::Nonlinear { hardening * amplitude } else { 0.0 };
                    let stiffness = natural * natural * (stiffer + share);
                    Complex64::new(stiffness - heavier * omega * omega, 2.0 * zeta * natural * omega)
                };
                // Square of the amplitude over that of the resonance peak.
                let mut amplitude = 0.0;
                if misfit == Misfit::Nonlinear {
                    for _ in 0..60 {
                        let next = (peak * natural * natural / dynamic(amplitude).norm()).powi(2);
                        amplitude += 0.5 * (next - amplitude);
                    }
                }
                shape * hit / dynamic(amplitude)
            })
            .sum();
        -omega * omega * sum
    };
    let curve = |r: usize, e: usize| frequencies.iter().map(|f| value(r, e, *f)).collect();
    FrfMatrix {
        responses: (0..POINTS).map(|k| Dof::new(k as i64 + 1, 2)).collect(),
        references: references.iter().map(|k| Dof::new(*k as i64 + 1, 2)).collect(),
        values: (0..POINTS).map(|r| (0..references.len()).map(|e| curve(r, e)).collect()).collect(),
        units: vec![vec!["(m/s^2)/N".into(); references.len()]; POINTS],
        coherence: None,
        frequencies,
    }
}

#[derive(Clone, Copy, Debug, Default)]
struct Coverage {
    modes: usize,
    frequency: usize,
    damping: usize,
    missed: usize,
    /// Modes farther than 2 % from every known one, without a mark and with one.
    wrong: usize,
    wrong_marked: usize,
    marked: usize,
    /// Mean width of the interval over that of noise alone is not known; this is the mean relative error \[ppm\].
    width: f64,
}

fn coverage(misfit: Misfit, seeds: std::ops::Range<u64>) -> Coverage {
    let mut sum = Coverage::default();
    for seed in seeds {
        let references: &[usize] = if seed % 2 == 0 { &[1] } else { &[1, 5] };
        let known = known(seed, references);
        let db = [50.0, 40.0, 30.0][(seed / 2 % 3) as usize];
        let test = MeasurementNoise { signal_to_noise_db: db, averages: 10, seed };
        let made = measured(&known, references, misfit, seed).with_measurement_noise(&test).unwrap();
        let found = identify(&made, &Settings { max_order: Some(40), ..Settings::default() }).unwrap();
        let mut used = vec![false; found.modes.len()];
        for k in &known {
            let distance = |m: usize| (found.modes[m].pole - k.pole).norm();
            let best = (0..found.modes.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)));
            let Some(best) = best.filter(|b| distance(*b) < 0.02 * k.pole.norm()) else {
                sum.missed += 1;
                continue;
            };
            used[best] = true;
            let m = &found.modes[best];
            sum.modes += 1;
            sum.width += 1e6 * m.frequency_error / m.frequency_hz();
            sum.marked += usize::from(!m.quality_warnings.is_empty());
            sum.frequency += usize::from((m.frequency_hz() - k.hz()).abs() < 1.96 * m.frequency_error);
            sum.damping += usize::from((m.damping_ratio() - k.zeta()).abs() < 1.96 * m.damping_error);
        }
        for (m, used) in found.modes.iter().zip(&used) {
            if !used {
                let marked = !m.quality_warnings.is_empty();
                sum.wrong += usize::from(!marked);
                sum.wrong_marked += usize::from(marked);
                println!(
                    "wrong: {misfit:?} {seed} {:.3} Hz {:.3} % {:?} of {:?}",
                    m.frequency_hz(),
                    100.0 * m.damping_ratio(),
                    m.quality_warnings,
                    known.iter().map(KnownMode::hz).collect::<Vec<_>>()
                );
            }
        }
    }
    sum.width /= sum.modes as f64;
    let share = |count: usize| 100.0 * count as f64 / sum.modes as f64;
    println!(
        "RESULT {misfit:?}: frequency {:.1} %, damping {:.1} %, {sum:?}",
        share(sum.frequency),
        share(sum.damping)
    );
    sum
}

#[test]
fn intervals_cover_noise_and_the_error_of_the_model() {
    let sums = KINDS.map(|kind| coverage(kind, 0..6));
    let (mut frequency, mut damping) = (0, 0);
    for (kind, sum) in KINDS.iter().zip(sums) {
        assert!(sum.modes == 30 && sum.wrong == 0, "{kind:?}: {sum:?}");
        // Neither noise, common to all responses as that of the force, nor a nonlinearity looks like two modes.
        assert!(
            sum.marked == 0 || matches!(kind, Misfit::Stiffness | Misfit::SensorMass),
            "{kind:?}: {sum:?}"
        );
        frequency += sum.frequency;
        damping += sum.damping;
    }
    // Of 120 intervals; three standard deviations of 95 %. Standard errors of noise alone cover 22 % with a stiffness that varies.
    assert!(frequency >= 107 && damping >= 107, "{frequency}, {damping}");
}

/// 200 sets: 50 of each kind, of seeds on which nothing was chosen; the table of the theory chapter.
#[test]
#[ignore = "a study of minutes"]
fn coverage_of_200_sets() {
    let sums: Vec<Coverage> = KINDS.iter().map(|kind| coverage(*kind, 3000..3050)).collect();
    let total = |of: &dyn Fn(&Coverage) -> usize| sums.iter().map(of).sum::<usize>();
    let (modes, wrong) = (total(&|s| s.modes), total(&|s| s.wrong));
    let share = |of: &dyn Fn(&Coverage) -> usize| 100.0 * total(of) as f64 / modes as f64;
    let (frequency, damping) = (share(&|s| s.frequency), share(&|s| s.damping));
    println!("RESULT frequency {frequency:.1} %, damping {damping:.1} %, {wrong} wrong of {modes}");
    // Marked modes have the distance to what they may be instead, which makes their damping ratios cautious.
    assert!((90.0..=98.0).contains(&frequency) && (90.0..=99.0).contains(&damping));
    assert_eq!(wrong, 0);
}
