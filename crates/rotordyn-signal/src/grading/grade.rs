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
            -5.827503, 0.000000, -1.471694, 0.000000, -1.729630, -0.277263, 3.137038, -0.344081, 2.745398,
            0.000000, -0.215108, -1.057432, -1.738319, -1.074920, -0.132216, 0.000000, 2.067448, 0.000000,
            -5.999379, -0.972122, 2.179759, -3.541538, 0.571246, 0.000000, 0.602193, 1.021468, 0.000000,
        ],
        [
            -5.907417, 1.088879, 0.000000, -1.474685, -1.846026, 0.000000, 0.190078, -0.374830, 0.514057,
            0.000000, 0.000000, 0.000000, -0.630648, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
            -0.526944, -1.704103, -0.509168, -1.342919, 1.230849, 0.000000, 0.186371, 0.978958, 0.000000,
        ],
    ],
    [
        [
            -7.669477, 0.000000, -0.010344, -2.136181, -3.248736, -5.176847, 0.000000, -0.525773, 1.345239,
            0.000000, 0.000000, -0.753885, -1.064828, -1.780650, -1.874632, 0.000000, 0.431313, -1.365942,
            -0.049358, -6.923638, 0.958109, -2.632916, 4.368982, 0.174269, 0.349906, 0.402159, 2.195357,
        ],
        [
            -0.128904, 0.000000, 0.000000, -0.242583, -2.574811, -1.013400, 0.000000, -3.355573, 0.684468,
            0.000000, 0.000000, -0.098630, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, -0.215158,
            0.000000, -1.868932, 0.463458, -0.446905, 0.000000, 0.000000, 0.000000, 0.212074, 0.259909,
        ],
    ],
    [
        [
            -2.580338, 0.588509, 0.000000, -3.595934, -2.763804, -5.322126, 0.000000, -4.872407, 6.057304,
            0.000000, 0.000000, -0.538232, -0.569790, 0.000000, 0.000000, 0.000000, 0.000000, -2.781482,
            0.000000, -1.435683, 1.031816, -2.143970, 0.000000, 0.000000, 0.345942, 0.918678, 1.553208,
        ],
        [
            -2.078193, 0.000000, 0.000000, -0.346519, -1.970352, 0.000000, 0.000000, -2.000491, 0.766005,
            0.011181, -0.183241, 0.000000, -0.523747, -1.708669, 0.000000, 3.005743, 0.000000, -0.176790,
            0.000000, -3.140728, 0.344767, -1.819237, 0.000000, 2.637547, 0.000000, 0.000000, 0.534170,
        ],
    ],
    [
        [
            -2.159416, 0.000000, -0.771927, -1.844637, -0.818579, 0.000000, 0.000000, -3.275324, 0.058456,
            0.000000, -0.161860, -0.161860, -0.405849, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
            -0.404848, 0.000000, 1.324483, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
        ],
        [
            -1.504827, 0.000000, -0.399447, 0.000000, 0.000000, 0.000000, 0.000000, -1.086499, 1.427927,
            0.000000, -0.134973, -0.134973, -0.067130, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
            -5.602679, 0.000000, 0.893097, -3.501665, 12.036131, 0.000000, 0.000000, 0.000000, 0.000000,
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
