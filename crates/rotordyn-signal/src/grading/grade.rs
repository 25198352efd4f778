//! Grade of a diagnosis: the probability that the named part is the damaged one, by logistic regression.

use super::super::bearing_lines::BearingPart;

/// Places of the features in their array.
pub(super) struct FeaturePlaces {
    pub constant: usize,
    /// ln(1 + evidence of the lines that nothing else explains), at most 3.5.
    pub evidence: usize,
    /// ln of the highest unexplained line over the highest own line, −3 to 3, as 0 to 2; what is above −0.7.
    pub unexplained: usize,
    pub comparable: usize,
    /// The same of the highest line of a rival of free rate, as 0 to 2.
    pub rival: usize,
    /// Share of the evidence that something else explains too.
    pub shared: usize,
    /// Mean of how fully the first four harmonics (cage: eight) stand that coincide with no line of shaft or mains.
    pub harmonics: usize,
    /// Share of these harmonics that coincide with no such line.
    pub distinct: usize,
    /// ln of the first harmonic over the highest.
    pub fundamental: usize,
    /// Mean of how fully the side bands of the first two harmonics stand.
    pub side_bands: usize,
    /// ln of the evidence of the next best part over that of the best.
    pub runner_up: usize,
    /// As `runner_up`, with the lines that both explain.
    pub ambiguity: usize,
    /// Mean of ln(1 + evidence) at fractions of the defect frequency.
    pub fraction: usize,
    /// 1 at a line of shaft or mains, 0 from four tolerances on; times `shared`.
    pub near_known: usize,
    pub near_and_shared: usize,
    /// For a ball, how fully FTF stands.
    pub modulation: usize,
    /// Share of the harmonics that stand, those of shaft and mains counted as missing.
    pub standing: usize,
    /// Strong evidence without the side bands, or without the harmonics, that its kind has: ln(1 + evidence) above
    /// 3.5, at most 4, times the share of them that is missing.
    pub missing_side_bands: usize,
    pub missing_harmonics: usize,
    /// Mean of how high shaft orders stand where the part has no lines.
    pub shaft_orders: usize,
    /// 1 for a band that was not chosen by the evidence in it.
    pub given_band: usize,
    pub count: usize,
}

pub(super) const FEATURES: FeaturePlaces = FeaturePlaces {
    constant: 0,
    evidence: 1,
    unexplained: 2,
    comparable: 3,
    rival: 4,
    shared: 5,
    harmonics: 6,
    distinct: 7,
    fundamental: 8,
    side_bands: 9,
    runner_up: 10,
    ambiguity: 11,
    fraction: 12,
    near_known: 13,
    near_and_shared: 14,
    modulation: 15,
    standing: 16,
    missing_side_bands: 17,
    missing_harmonics: 18,
    shaft_orders: 19,
    given_band: 20,
    count: 21,
};

/// Number of features of a grade, the constant included.
pub const FEATURE_COUNT: usize = FEATURES.count;

/// Features of the best candidate of a record.
pub type Features = [f64; FEATURE_COUNT];

/// Highest probability: another source may be at the very rate of a part, which no feature tells.
pub const MOST_CERTAIN: f64 = 0.995;

/// Coefficients of the log-odds for each part, fitted to generated records by `tests/diagnosis` of this crate.
pub const COEFFICIENTS: [Features; 4] = [
    [
        -4.877231, 1.849184, 0.000000, -0.677686, -0.579808, -0.320668, 3.586067, -0.044380, 1.798927,
        0.000000, -0.213610, 0.000000, -1.759008, -2.749027, 0.000000, 0.000000, 0.155222, 0.000000,
        -2.983539, -4.734512, 1.167865,
    ],
    [
        0.159020, 1.585918, 0.000000, -1.017885, -3.139999, -3.723426, 0.000000, -5.403879, 2.031013,
        1.943410, -0.110083, -0.425067, -0.008338, -1.731610, 0.000000, 0.000000, 2.529366, -1.396798,
        0.000000, -5.326301, 0.688274,
    ],
    [
        -3.376518, 1.373121, 0.000000, -1.326565, -3.884191, -1.334083, 0.000000, -0.592040, 4.941668,
        3.335927, 0.000000, 0.000000, -1.095923, -0.953625, -1.827788, 3.625358, 0.000000, -0.697568,
        0.000000, -2.585296, 1.698723,
    ],
    [
        -0.239201, 0.000000, -0.596802, 0.000000, 0.000000, 0.000000, 4.801898, -2.083348, 1.012041,
        0.000000, -0.318018, -0.318018, -0.434608, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
        -3.162652, 0.000000, 0.639832,
    ],
];

/// Probability 0.995/(1 + e^(−β·x)).
pub(super) fn probability(part: BearingPart, features: &Features) -> f64 {
    let log_odds: f64 = COEFFICIENTS[part as usize].iter().zip(features).map(|(b, x)| b * x).sum();
    MOST_CERTAIN / (1.0 + (-log_odds).exp())
}
