//! Grade of a diagnosis: the probability that the named part is the damaged one, by logistic regressions.

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

/// Regressions of each part, either of which suffices: clear lines show a fault, and many weak ones do.
pub const REGRESSIONS: usize = 2;

/// Coefficients β₁, β₂ of the log-odds of a part.
pub type PartCoefficients = [Features; REGRESSIONS];

/// Coefficients of each part, fitted to generated records by `tests/diagnosis` of this crate.
pub const COEFFICIENTS: [PartCoefficients; 4] = [
    [
        [
            -5.798393, 0.150137, 0.000000, -0.376827, -0.641318, 0.000000, 0.000000, -0.346513, 0.336592,
            0.000000, -0.074364, 0.000000, -0.525125, -0.741182, -0.186921, 0.000000, 0.000000, 0.000000,
            -0.478465, -1.826994, 0.003988, 0.000000, 0.222328, 0.000000, 0.243535, 1.534162, 0.000000,
        ],
        [
            -5.712710, 0.287158, -1.638893, 0.000000, -3.400345, -0.291940, 2.289230, -0.342810, 2.027098,
            0.000000, -0.209776, -0.762264, -1.727731, -0.130172, 0.000000, 0.000000, 1.659725, 0.000000,
            -4.446005, -1.239223, 1.815025, -4.793071, 1.924901, 0.000000, 0.712553, 0.877560, 0.000000,
        ],
    ],
    [
        [
            -8.191135, 0.428205, -0.978031, -1.714127, -3.466555, -2.124082, 0.000000, -0.741331, 0.944106,
            0.000000, 0.000000, -0.502369, -1.192145, -3.173712, -3.320806, 0.000000, 0.000000, -1.030026,
            -0.498252, -5.408179, 0.856683, -2.455466, 4.772985, 0.000000, 0.410849, 0.501706, 2.224458,
        ],
        [
            -0.382348, 0.000000, 0.000000, -0.128372, -3.049627, -0.505802, 0.000000, -3.018885, 0.583305,
            0.000000, 0.000000, -0.052834, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, -0.201378,
            0.000000, -1.887646, 0.595130, -0.479610, 0.000000, 0.285193, 0.000000, 0.188389, 0.222891,
        ],
    ],
    [
        [
            -1.848841, 1.108705, -1.852818, -0.430737, -5.179187, -7.546210, 0.000000, -4.499948, 7.409637,
            0.000000, -0.165068, 0.000000, -1.627756, 0.000000, 0.000000, 1.576847, 0.000000, -3.280449,
            -0.125845, -0.936334, 0.984463, -2.052858, 0.000000, 0.000000, 0.000167, 0.885701, 1.302608,
        ],
        [
            -2.617727, 0.000000, 0.000000, -3.531662, -0.671827, -1.773733, 0.000000, -3.437123, 0.685108,
            2.739467, 0.000000, -0.397804, -0.101317, -0.855072, 0.000000, 1.013456, 0.000000, -0.697920,
            0.000000, -2.388674, 0.244949, -3.234887, 0.000000, 0.704864, 0.000000, 0.754004, 0.737868,
        ],
    ],
    [
        [
            -1.786296, 0.000000, -0.409439, 0.000000, 0.000000, 0.000000, 2.414855, -0.801506, 1.431127,
            0.000000, -0.084833, -0.084833, -0.186946, -4.622676, 0.000000, 0.000000, 0.000000, 0.000000,
            -4.475959, 0.000000, 0.982193, -3.328025, 9.980084, 0.000000, 0.000000, 0.000000, 0.000000,
        ],
        [
            -2.110543, 0.000000, -0.733777, -2.114778, -1.537184, 0.000000, 0.000000, -3.035928, 0.049499,
            0.000000, -0.339335, -0.339335, -0.339733, 0.000000, -0.001241, 0.000000, 0.000000, 0.000000,
            -1.089161, 0.000000, 0.668179, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
        ],
    ],
];

/// Probability 0.995 s/(1 + s) with the odds s = e^(β₁·x) + e^(β₂·x).
pub fn probability(coefficients: &PartCoefficients, features: &Features) -> f64 {
    let log_odds = |own: &Features| own.iter().zip(features).map(|(b, x)| b * x).sum::<f64>();
    let odds: f64 = coefficients.iter().map(|own| log_odds(own).exp()).sum();
    // 1 − 1/(1 + s), which an infinite s admits.
    MOST_CERTAIN * (1.0 - 1.0 / (1.0 + odds))
}

/// Probability that `part` is the damaged one.
pub(super) fn grade(part: BearingPart, features: &Features) -> f64 {
    probability(&COEFFICIENTS[part as usize], features)
}
