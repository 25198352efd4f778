//! Calibration of the grade on one half of the generated records, and its test on the other.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use rotordyn_signal::bearing_lines::{BearingPart, LineSettings};
use rotordyn_signal::diagnosis::{BandRule, ShaftRotation, diagnose};
use rotordyn_signal::grading::{COEFFICIENTS, FEATURE_COUNT, Features};

use super::RATE;
use super::baseline::plain_diagnosis;
use super::generator::Generated;
use super::others::Other;
use super::table::print_table;

/// Seeds of the records the coefficients are fitted to, and of those they are tested on.
const FITTED: u64 = 2026;
const TESTED: u64 = 1953;

/// The broad band in which each record is judged as well.
const BROAD: BandRule = BandRule::Given(500.0, 5500.0);

/// A record's truth and what was said of it.
pub struct Outcome {
    pub part: Option<BearingPart>,
    pub other: Option<Other>,
    pub snr: f64,
    pub rival_in_a_window: bool,
    pub candidate: BearingPart,
    pub probability: f64,
    pub features: Features,
    pub plain: Option<BearingPart>,
    /// Whether in the band chosen by its lines.
    pub chosen: bool,
}

impl Outcome {
    /// In a band chosen by its lines, or the broad one of 500 Hz to 5.5 kHz.
    pub fn of(record: &Generated, rule: BandRule) -> Self {
        let settings = LineSettings::default();
        let rotation = ShaftRotation::ConstantSpeed;
        let found = diagnose(&record.record, RATE, rotation, &record.rates, rule, &settings).unwrap();
        let graded = found.graded;
        Outcome {
            part: record.part,
            other: record.other,
            snr: record.snr,
            rival_in_a_window: record.rival_in_a_window(settings.slip, 1.0 / record.seconds()),
            candidate: graded.candidate,
            probability: graded.probability,
            features: graded.features,
            plain: plain_diagnosis(&record.record, &record.rates),
            chosen: rule == BandRule::Lines,
        }
    }

    pub fn is_right(&self) -> bool {
        self.part == Some(self.candidate)
    }
}

/// Two outcomes of each record: in the band of the most evidence, and in a broad one.
pub fn outcomes(seed: u64, count: usize) -> Vec<Outcome> {
    let both = |number| {
        let record = Generated::new(seed, number);
        [BandRule::Lines, BROAD].map(|rule| Outcome::of(&record, rule))
    };
    (0..count).into_par_iter().flat_map_iter(both).collect()
}

/// Penalty on the squares of the coefficients: as much as a tenth of a record.
const RIDGE: f64 = 0.1;

/// Coefficients of the logistic regression of being right on the features (Newton, ridge 0.1).
fn fitted(of: &[Outcome]) -> Features {
    let x = DMatrix::from_fn(of.len(), FEATURE_COUNT, |r, c| of[r].features[c]);
    let y = DVector::from_fn(of.len(), |r, _| f64::from(of[r].is_right()));
    let mut beta = DVector::zeros(FEATURE_COUNT);
    for _ in 0..60 {
        let p = (&x * &beta).map(|v: f64| 1.0 / (1.0 + (-v).exp()));
        let gradient = x.transpose() * (&y - &p) - RIDGE * &beta;
        let weighted = DMatrix::from_fn(x.nrows(), x.ncols(), |r, c| x[(r, c)] * p[r] * (1.0 - p[r]));
        let hessian: DMatrix<f64> =
            x.transpose() * weighted + RIDGE * DMatrix::identity(FEATURE_COUNT, FEATURE_COUNT);
        let step = hessian.lu().solve(&gradient).unwrap();
        beta += &step;
        if step.norm() < 1e-12 * beta.norm() {
            break;
        }
    }
    std::array::from_fn(|k| beta[k])
}

/// Records of each half; the coefficients in the code are those of this number.
const HALF: usize = 1000;

/// Refits the coefficients, compares them with those in the code and prints the table of the other half.
///
/// `ROTORDYN_REFIT=1` prints new coefficients instead of comparing, and grades with them.
#[test]
#[ignore = "thousands of records: minutes in a release build"]
fn grade_is_calibrated() {
    let refit = std::env::var_os("ROTORDYN_REFIT").is_some();
    let of = outcomes(FITTED, HALF);
    let coefficients = fitted(&of);
    println!("{coefficients:.6?}");
    let mut test = outcomes(TESTED, HALF);
    if refit {
        for outcome in &mut test {
            let odds: f64 = coefficients.iter().zip(&outcome.features).map(|(b, x)| b * x).sum();
            outcome.probability = 1.0 / (1.0 + (-odds).exp());
        }
    }
    if let Some(path) = std::env::var_os("ROTORDYN_FEATURES") {
        let lines = [(0, &of), (1, &test)].into_iter().flat_map(|(set, of)| of.iter().map(move |o| (set, o)));
        std::fs::write(path, lines.map(|(set, o)| format!("{set},{}", o.csv_line())).collect::<String>())
            .unwrap();
    }
    let (chosen, broad): (Vec<Outcome>, Vec<Outcome>) = test.into_iter().partition(|o| o.chosen);
    println!("Band of the most evidence");
    print_table(&chosen);
    println!("\nBand 500 Hz to 5.5 kHz");
    print_table(&broad);
    if refit {
        return;
    }
    for (got, expected) in coefficients.iter().zip(&COEFFICIENTS) {
        // Six digits are stored; functions of other C libraries move features by rounding errors.
        assert!((got - expected).abs() < 1e-4 * (1.0 + expected.abs()), "{got} instead of {expected}");
    }
}

impl Outcome {
    fn csv_line(&self) -> String {
        let part = |part: Option<BearingPart>| part.map_or("none", BearingPart::name);
        let features = self.features.map(|v| format!("{v:.5}")).join(",");
        format!(
            "{},{:?},{:.1},{},{},{},{},{features}\n",
            part(self.part),
            self.other,
            self.snr,
            u8::from(self.rival_in_a_window),
            self.candidate.name(),
            part(self.plain),
            u8::from(self.chosen)
        )
    }
}
