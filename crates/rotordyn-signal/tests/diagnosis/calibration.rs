//! Calibration of the grade on one half of the generated records, and its test on the other.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use rotordyn_signal::bearing_lines::{BearingPart, LineSettings};
use rotordyn_signal::diagnosis::{BandRule, ShaftRotation, diagnose};
use rotordyn_signal::verdict::{COEFFICIENTS, FEATURE_COUNT, Features, Finding};

use super::baseline::plain_diagnosis;
use super::generator::Generated;
use super::others::Other;
use super::table::print_table;
use super::{RATE, SECONDS};

/// Seeds of the records the coefficients are fitted to, and of those they are tested on.
const FITTED: u64 = 2026;
const TESTED: u64 = 1967;

/// A record's truth and what was said of it.
pub struct Outcome {
    pub part: Option<BearingPart>,
    pub other: Option<Other>,
    pub snr: f64,
    pub rival_in_a_window: bool,
    pub finding: Finding,
    pub candidate: BearingPart,
    pub probability: f64,
    pub features: Features,
    pub plain: Option<BearingPart>,
}

impl Outcome {
    pub fn of(record: &Generated) -> Self {
        let settings = LineSettings::default();
        let rotation = ShaftRotation::ConstantSpeed;
        let found =
            diagnose(&record.record, RATE, rotation, &record.rates, BandRule::Lines, &settings).unwrap();
        let verdict = found.verdict;
        Outcome {
            part: record.part,
            other: record.other,
            snr: record.snr,
            rival_in_a_window: record.rival_in_a_window(settings.slip, 1.0 / SECONDS),
            finding: verdict.finding,
            candidate: verdict.candidate,
            probability: verdict.probability,
            features: verdict.features,
            plain: plain_diagnosis(&record.record, &record.rates),
        }
    }

    pub fn is_right(&self) -> bool {
        self.part == Some(self.candidate)
    }
}

pub fn outcomes(seed: u64, count: usize) -> Vec<Outcome> {
    (0..count).into_par_iter().map(|number| Outcome::of(&Generated::new(seed, number))).collect()
}

/// Coefficients of the logistic regression of being right on the features (Newton, ridge 1e-2).
fn fitted(of: &[Outcome]) -> Features {
    let x = DMatrix::from_fn(of.len(), FEATURE_COUNT, |r, c| of[r].features[c]);
    let y = DVector::from_fn(of.len(), |r, _| f64::from(of[r].is_right()));
    let mut beta = DVector::zeros(FEATURE_COUNT);
    for _ in 0..60 {
        let p = (&x * &beta).map(|v: f64| 1.0 / (1.0 + (-v).exp()));
        let gradient = x.transpose() * (&y - &p) - 1e-2 * &beta;
        let weighted = DMatrix::from_fn(x.nrows(), x.ncols(), |r, c| x[(r, c)] * p[r] * (1.0 - p[r]));
        let hessian: DMatrix<f64> = x.transpose() * weighted + 1e-2 * DMatrix::identity(FEATURE_COUNT, FEATURE_COUNT);
        let step = hessian.lu().solve(&gradient).unwrap();
        beta += &step;
        if step.norm() < 1e-12 * beta.norm() {
            break;
        }
    }
    std::array::from_fn(|k| beta[k])
}

/// Records of each half.
fn half() -> usize {
    std::env::var("ROTORDYN_DIAGNOSES").ok().and_then(|n| n.parse().ok()).unwrap_or(4000)
}

#[test]
#[ignore = "thousands of records: minutes in a release build"]
fn grade_is_calibrated() {
    let of = outcomes(FITTED, half());
    let coefficients = fitted(&of);
    println!("coefficients {coefficients:.4?}");
    let mut test = outcomes(TESTED, half());
    if std::env::var("ROTORDYN_REFIT").is_ok() {
        for outcome in &mut test {
            let odds: f64 = coefficients.iter().zip(&outcome.features).map(|(b, x)| b * x).sum();
            outcome.probability = 1.0 / (1.0 + (-odds).exp());
        }
    }
    if let Ok(path) = std::env::var("ROTORDYN_DUMP") {
        let mut text = String::new();
        for (set, of) in [(0, &of), (1, &test)] {
            for o in of {
                let features = o.features.map(|v| format!("{v:.5}")).join(",");
                text += &format!(
                    "{set},{},{},{:.1},{},{},{},{features}\n",
                    o.part.map_or("none", |p| p.name()),
                    o.other.map_or("none".into(), |k| format!("{k:?}")),
                    o.snr,
                    u8::from(o.rival_in_a_window),
                    o.candidate.name(),
                    o.plain.map_or("none", |p| p.name())
                );
            }
        }
        std::fs::write(path, text).unwrap();
    }
    print_table(&test);
    let _ = COEFFICIENTS;
}
