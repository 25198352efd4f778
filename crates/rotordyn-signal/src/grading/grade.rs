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
    /// `harmonics` and `side_bands` up to a half: the first of them say more than the last.
    pub first_harmonics: usize,
    pub first_side_bands: usize,
    /// Joint evidence in the squared envelope, see `joint.rs`: of the first harmonic, of the others, of the side bands.
    pub joint_first: usize,
    pub joint_harmonics: usize,
    pub joint_side_bands: usize,
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
    first_harmonics: 22,
    first_side_bands: 23,
    joint_first: 24,
    joint_harmonics: 25,
    joint_side_bands: 26,
    count: 27,
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
        -4.834635, 1.784041, 0.000000, -0.732165, -1.074291, 0.000000, 0.000000, -0.690340, 2.592864,
        0.000000, -0.011840, 0.000000, -1.458625, 0.000000, 0.000000, 0.000000, 1.301726, 0.000000,
        -1.569734, -1.331292, 1.230231, -2.764446, 0.532678, 0.000000, 0.000000, 0.978168, 0.000000,
    ],
    [
        -0.758682, 0.795659, 0.000000, -0.900835, -1.993848, -3.169017, 0.000000, -3.896358, 1.902145,
        0.000000, 0.000000, -0.202772, -0.405421, -0.448653, 0.000000, 0.000000, 0.473485, -0.333029,
        0.000000, -2.899516, 0.673629, -1.590935, 0.000000, 0.443246, 0.025946, 0.388857, 0.858316,
    ],
    [
        -1.965532, 0.373521, 0.000000, -1.309419, -3.197029, -2.775962, 0.000000, -2.333539, 2.322557,
        0.402408, -0.134728, -0.108716, -0.810638, -0.531462, 0.000000, 2.670129, 0.000000, -1.407801,
        0.000000, -0.719596, 0.895441, -1.532275, 0.000000, 0.000000, 0.107648, 0.555028, 0.871391,
    ],
    [
        -0.136557, 0.000000, -0.632349, 0.000000, 0.000000, 0.000000, 0.527432, -2.250339, 1.130361,
        0.000000, -0.151596, -0.151596, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
        -3.839888, 0.000000, 0.834147, -2.731154, 8.808661, 0.000000, 0.000000, 0.000000, 0.000000,
    ],
];

/// Probability 0.995/(1 + e^(−β·x)).
pub(super) fn probability(part: BearingPart, features: &Features) -> f64 {
    let log_odds: f64 = COEFFICIENTS[part as usize].iter().zip(features).map(|(b, x)| b * x).sum();
    MOST_CERTAIN / (1.0 + (-log_odds).exp())
}
