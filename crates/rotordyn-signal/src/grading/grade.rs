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
    /// ln of the power about the part's strongest line over that of a pure line as high, what is above 1, at most 2:
    /// more than slip widens a line is the power of stronger lines beside it, of which it may be a by-product.
    pub surroundings: usize,
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
    surroundings: 21,
    count: 22,
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
        -4.773456, 2.113186, 0.000000, -1.672422, -1.111599, 0.000000, 3.351602, -1.673375, 2.107273,
        0.000000, -0.150137, -0.613056, -2.415952, 0.000000, 0.000000, 0.000000, 1.299598, 0.000000,
        -3.180842, -0.588169, 0.451564, -2.725584,
    ],
    [
        -2.918690, 1.548512, -0.983369, -0.225880, -2.437143, -1.293695, 3.237975, -2.489524, 2.087529,
        1.053751, 0.000000, -0.588595, -0.028575, 0.000000, 0.000000, 0.000000, 1.377894, -1.668237,
        0.000000, -7.008960, 0.217860, -1.455619,
    ],
    [
        -3.602699, 2.148597, 0.000000, -1.559947, -2.425777, 0.000000, 0.000000, -1.750735, 3.662062,
        1.666577, 0.000000, 0.000000, -0.881235, 0.000000, -0.691777, 3.298745, 0.000000, -0.799972,
        0.000000, 0.000000, 1.376929, -3.519003,
    ],
    [
        0.870032, 0.000000, -0.683445, 0.000000, 0.000000, 0.000000, 4.698985, -2.942403, 1.381361, 0.000000,
        -0.272329, -0.272329, -0.310639, 0.000000, 0.000000, 0.000000, 0.069867, 0.000000, -3.380123,
        0.000000, 0.667613, -1.261914,
    ],
];

/// Probability 0.995/(1 + e^(−β·x)).
pub(super) fn probability(part: BearingPart, features: &Features) -> f64 {
    let log_odds: f64 = COEFFICIENTS[part as usize].iter().zip(features).map(|(b, x)| b * x).sum();
    MOST_CERTAIN / (1.0 + (-log_odds).exp())
}
