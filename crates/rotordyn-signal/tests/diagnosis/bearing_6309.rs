//! A 6309 at 24.7 rev/s, and the grade of a record of it.

use rotordyn_signal::bearing_lines::{DefectFrequencies, LineSettings};
use rotordyn_signal::diagnosis::{BandRule, ShaftRotation, diagnose};
use rotordyn_signal::grading::GradedDiagnosis;

pub const SHAFT: f64 = 24.7;
/// FTF 0.3796, BPFO 3.0366, BPFI 4.9634, BSF 1.9554 orders.
pub const RATES: DefectFrequencies = DefectFrequencies {
    shaft: SHAFT,
    cage: 0.37957 * SHAFT,
    outer: 3.03658 * SHAFT,
    inner: 4.96342 * SHAFT,
    ball: 1.95551 * SHAFT,
};

pub fn graded(record: &[f64], rate: f64, settings: &LineSettings) -> GradedDiagnosis {
    diagnose(record, rate, ShaftRotation::ConstantSpeed, &RATES, BandRule::Lines, settings).unwrap().graded
}
