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
    -3.307883, -1.442991, -2.306250, 1.273338, -0.529464, -0.123291, -0.742834, -0.034946, 7.760860,
    2.138065, 4.645116, 8.171574, -0.386135, -0.438968, 0.057021, 0.659030, -0.562768, -0.749798, 0.648258,
    -2.496671, 2.111106, -0.143754, -2.898361, -3.729665, 0.131647,
];

/// Probability 1/(1 + e^(−β·x)).
pub(super) fn probability(features: &Features) -> f64 {
    let log_odds: f64 = COEFFICIENTS.iter().zip(features).map(|(b, x)| b * x).sum();
    1.0 / (1.0 + (-log_odds).exp())
}
