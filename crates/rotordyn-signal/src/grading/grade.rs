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
        -4.847370, 1.783923, 0.000000, -0.721973, -1.066658, 0.000000, 0.000000, -0.677576, 2.613331,
        0.000000, -0.011298, 0.000000, -1.459414, 0.000000, 0.000000, 0.000000, 1.257427, 0.000000,
        -1.554070, -1.337231, 1.207444, -2.771874, 0.509928, 0.000000, 0.000000, 0.998994, 0.000000,
    ],
    [
        -0.581625, 0.742925, 0.000000, -0.904798, -1.989821, -3.225479, 0.000000, -3.925076, 1.936202,
        0.000000, 0.000000, -0.206586, -0.405754, -0.450185, 0.000000, 0.000000, 0.412607, -0.333652,
        0.000000, -2.889037, 0.602911, -1.614113, 0.000000, 0.237241, 0.025170, 0.410176, 0.895205,
    ],
    [
        -1.872361, 0.308461, 0.000000, -1.291734, -3.157504, -2.767312, 0.000000, -2.186190, 2.339222,
        0.220299, -0.126823, -0.104210, -0.796563, -0.588586, 0.000000, 2.707109, 0.000000, -1.328578,
        0.000000, -0.700174, 0.795033, -1.446867, 0.000000, 0.000000, 0.090183, 0.532260, 0.930500,
    ],
    [
        -0.136555, 0.000000, -0.632350, 0.000000, 0.000000, 0.000000, 0.527458, -2.250340, 1.130362,
        0.000000, -0.151596, -0.151596, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
        -3.839884, 0.000000, 0.834147, -2.731155, 8.808636, 0.000000, 0.000000, 0.000000, 0.000000,
    ],
];

/// Probability 0.995/(1 + e^(−β·x)).
pub(super) fn probability(part: BearingPart, features: &Features) -> f64 {
    let log_odds: f64 = COEFFICIENTS[part as usize].iter().zip(features).map(|(b, x)| b * x).sum();
    MOST_CERTAIN / (1.0 + (-log_odds).exp())
}
