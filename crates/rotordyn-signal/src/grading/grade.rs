//! Grade of a diagnosis: the probability that the named part is the damaged one, by logistic regression.

/// Places of the features in their array.
pub(super) struct FeaturePlaces {
    pub constant: usize,
    pub inner: usize,
    pub ball: usize,
    pub cage: usize,
    /// ln(1 + evidence of the lines that nothing else explains).
    pub evidence: usize,
    /// ln of the highest unexplained line over the highest own line, −3 to 3.
    pub unexplained: usize,
    /// The same of the highest line of a rival of free rate.
    pub rival: usize,
    /// Share of the evidence that something else explains too.
    pub shared: usize,
    /// Share of the first four harmonics that stand.
    pub harmonics: usize,
    /// ln of the first harmonic over the highest.
    pub fundamental: usize,
    /// Share of the side bands of the first two harmonics that stand.
    pub inner_side_bands: usize,
    pub ball_side_bands: usize,
    /// ln of the evidence of the next best part over that of the best.
    pub runner_up: usize,
    /// Mean of ln(1 + evidence) at fractions of the defect frequency.
    pub fraction: usize,
    /// As `runner_up`, with the lines that both explain.
    pub ambiguity: usize,
    /// 1 for a band that was not chosen by the evidence in it.
    pub given_band: usize,
    /// First of the features `rival`, `shared` and `harmonics`, each for inner race, ball and cage: they weigh
    /// differently from part to part.
    pub by_part: usize,
    pub count: usize,
}

pub(super) const FEATURES: FeaturePlaces = FeaturePlaces {
    constant: 0,
    inner: 1,
    ball: 2,
    cage: 3,
    evidence: 4,
    unexplained: 5,
    rival: 6,
    shared: 7,
    harmonics: 8,
    fundamental: 9,
    inner_side_bands: 10,
    ball_side_bands: 11,
    runner_up: 12,
    fraction: 13,
    ambiguity: 14,
    given_band: 15,
    by_part: 16,
    count: 25,
};

/// Number of features of a grade, the constant included.
pub const FEATURE_COUNT: usize = FEATURES.count;

/// Features of the best candidate of a record.
pub type Features = [f64; FEATURE_COUNT];

/// Coefficients of the log-odds, fitted to generated records by `tests/diagnosis` of this crate.
pub const COEFFICIENTS: Features = [
    -3.304792, -1.387973, -2.319442, 1.250321, -0.524890, -0.125458, -0.736821, 0.083054, 7.749840, 2.135353,
    4.407306, 8.185560, -0.376270, -0.444044, 0.045883, 0.655317, -0.540560, -0.753110, 0.644426, -2.632147,
    1.996599, -0.238689, -2.840628, -3.748302, 0.145259,
];

/// Probability 1/(1 + e^(−β·x)).
pub(super) fn probability(features: &Features) -> f64 {
    let log_odds: f64 = COEFFICIENTS.iter().zip(features).map(|(b, x)| b * x).sum();
    1.0 / (1.0 + (-log_odds).exp())
}
