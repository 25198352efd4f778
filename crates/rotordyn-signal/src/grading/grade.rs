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
            -5.615889, 0.029406, 0.000000, -0.516818, 0.000000, -0.013735, 0.061659, -0.401694, 0.346056,
            0.000000, -0.093796, 0.000000, -0.546061, -0.619567, -0.140213, 0.000000, 0.000000, 0.000000,
            -0.436553, -2.054179, -0.016897, 0.000000, 0.385615, 0.000000, 0.236292, 1.533219, 0.000000,
        ],
        [
            -6.333171, 0.268477, -1.511173, -0.062498, -3.377451, 0.000000, 1.676024, 0.276838, 2.007071,
            0.000000, -0.181680, -0.801759, -1.706717, 0.000000, 0.000000, 0.000000, 1.788420, 0.000000,
            -4.473653, -1.246568, 1.803761, -4.920593, 2.302649, 0.000000, 0.723193, 0.881250, 0.000000,
        ],
    ],
    [
        [
            -8.920023, 0.164874, -0.501923, -2.160775, -3.033004, -3.526534, 0.000000, 0.623708, 1.087764,
            0.000000, 0.000000, -0.636333, -1.110209, -2.149567, -2.255830, 0.000000, 0.000000, -1.235951,
            -0.276579, -7.248579, 0.876071, -2.519346, 5.003149, 0.000000, 0.403563, 0.481276, 2.129983,
        ],
        [
            -0.182770, 0.000000, 0.000000, -0.109477, -2.728210, -0.561633, 0.000000, -3.374895, 0.679562,
            0.000000, 0.000000, -0.053019, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, -0.219056,
            0.000000, -1.936151, 0.551111, -0.525916, 0.000000, 0.381926, 0.000000, 0.248698, 0.206821,
        ],
    ],
    [
        [
            -3.113167, 0.000000, 0.000000, -0.594885, -1.600093, -1.450150, 0.000000, -0.979025, 0.000000,
            0.000000, -0.373196, -0.022621, -2.105808, -2.377284, -0.375761, 0.566779, 0.000000, -1.101044,
            -0.065550, -0.961494, 1.213045, -2.125006, 0.000000, 0.000000, 0.023911, 0.000000, 0.000000,
        ],
        [
            -1.422958, 0.753729, 0.000000, -2.068725, -3.647620, -7.483917, 0.000000, -5.264466, 6.174741,
            0.000000, -0.037734, -0.297327, -0.495902, 0.000000, 0.000000, 1.084066, 0.000000, -1.996612,
            -0.011849, -1.394905, 0.442707, -1.976215, 0.000000, 0.000000, 0.000000, 0.889486, 1.535060,
        ],
    ],
    [
        [
            -1.745612, 0.000000, -0.413421, 0.000000, 0.000000, 0.000000, 2.373453, -0.858311, 1.397475,
            0.000000, -0.080171, -0.080171, -0.178617, -4.619279, 0.000000, 0.000000, 0.000000, 0.000000,
            -4.456414, 0.000000, 0.993088, -3.392675, 10.114176, 0.000000, 0.000000, 0.000000, 0.000000,
        ],
        [
            -2.223808, 0.000000, -1.015392, -1.916003, -0.706929, 0.000000, 0.000000, -2.978970, 0.043206,
            0.000000, -0.351427, -0.351427, -0.299210, 0.000000, -0.001023, 0.000000, 0.000000, 0.000000,
            -1.097391, 0.000000, 0.563590, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000, 0.000000,
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
