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
        -5.171386, 1.490556, 0.000000, -0.684770, -1.363720, -0.702222, 0.000000, 0.192930, 2.819401,
        0.000000, -0.048984, 0.000000, -1.494120, 0.000000, 0.000000, 0.000000, 1.344471, 0.000000,
        -0.920351, -0.413547, 1.215685, -2.906715, 0.180400, 0.000000, 0.000000, 1.080039, 0.000000,
    ],
    [
        -2.461959, 0.706752, -0.684596, -0.428644, -3.581421, -2.411986, 0.000000, -2.291941, 2.026916,
        0.000000, 0.000000, -0.264380, -0.185957, 0.000000, 0.000000, 0.000000, 0.212340, -0.265624,
        0.000000, -2.818132, 0.473133, -2.029869, 0.000000, 0.000000, 0.000000, 0.507149, 0.976295,
    ],
    [
        -1.468875, 0.433602, 0.000000, -1.241713, -2.717917, -2.291511, 0.000000, -2.684519, 2.475990,
        0.000000, -0.049298, -0.126126, -0.515239, -0.325921, 0.000000, 2.695360, 0.000000, -1.229330,
        0.000000, -1.029167, 0.753666, -1.157847, 0.000000, 0.000000, 0.136074, 0.414912, 0.873913,
    ],
    [
        -0.220540, 0.000000, -0.641671, 0.000000, 0.000000, 0.000000, 0.645773, -2.232456, 1.105055,
        0.000000, -0.146540, -0.146540, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
        -3.819604, 0.000000, 0.902034, -2.718116, 8.808440, 0.000000, 0.000000, 0.000000, 0.000000,
    ],
];

/// Probability 0.995/(1 + e^(−β·x)).
pub(super) fn probability(part: BearingPart, features: &Features) -> f64 {
    let log_odds: f64 = COEFFICIENTS[part as usize].iter().zip(features).map(|(b, x)| b * x).sum();
    MOST_CERTAIN / (1.0 + (-log_odds).exp())
}
