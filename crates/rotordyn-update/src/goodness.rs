//! Goodness of fit: whether the fitted model explains the data within their standard deviations.

use nalgebra::DMatrix;

use super::chi_squared::{lower_probability, upper_probability};
use super::data_kind::KindFit;
use super::identifiability::identifiability;
use super::least_squares::{Evaluation, Prior};

/// Probability of χ² below which a model does not explain the data, and of a smaller χ² below which the stated
/// standard deviations are larger than the differences of model and data.
pub const MIN_PROBABILITY: f64 = 0.01;

/// What the probability of χ² says of a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FitQuality {
    /// The differences of model and data are those of the stated standard deviations.
    Explained,
    /// They are larger: the model has an error that the free parameters cannot remove.
    NotExplained,
    /// They are smaller: the stated standard deviations are too large, and the standard errors with them.
    DeviationsTooLarge,
    /// As many parameters as data: any model fits.
    NotTested,
}

impl FitQuality {
    /// Label.
    pub fn label(self) -> &'static str {
        match self {
            FitQuality::Explained => "explained",
            FitQuality::NotExplained => "not explained",
            FitQuality::DeviationsTooLarge => "explained, deviations too large",
            FitQuality::NotTested => "not tested",
        }
    }
}

/// χ² of a fit with its degrees of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct GoodnessOfFit {
    /// |r|² of the data over their standard deviations.
    pub chi_squared: f64,
    /// ν: data minus the effective number of fitted parameters, which need not be whole.
    pub degrees_of_freedom: f64,
    /// The same for every kind of data.
    pub by_kind: Vec<KindFit>,
}

impl GoodnessOfFit {
    /// Of a solution in which only the parameters `fitted` were free.
    pub fn new(at: &Evaluation, prior: &Prior, fitted: &[usize]) -> Self {
        let pick = |values: &[f64]| fitted.iter().map(|&j| values[j]).collect::<Vec<f64>>();
        let jacobian =
            DMatrix::from_fn(at.jacobian.nrows(), fitted.len(), |i, k| at.jacobian[(i, fitted[k])]);
        let own = Evaluation { jacobian, ..at.clone() };
        let prior = Prior {
            mean: pick(&prior.mean),
            deviation: pick(&prior.deviation),
            lower: pick(&prior.lower),
            upper: pick(&prior.upper),
        };
        let found = identifiability(&own, &prior);
        Self {
            chi_squared: found.chi_squared,
            degrees_of_freedom: found.degrees_of_freedom,
            by_kind: found.by_kind,
        }
    }

    /// Probability of a larger χ² if the model is right and the standard deviations are those of the data; below one
    /// degree of freedom that of one.
    pub fn probability(&self) -> f64 {
        upper_probability(self.chi_squared, self.degrees_of_freedom.max(1.0))
    }

    fn tested_kinds(&self) -> impl Iterator<Item = &KindFit> {
        self.by_kind.iter().filter(|fit| fit.is_tested())
    }

    /// Probability below which the data of one kind are not explained: [`MIN_PROBABILITY`] over the number of kinds.
    pub fn min_kind_probability(&self) -> f64 {
        MIN_PROBABILITY / self.tested_kinds().count().max(1) as f64
    }

    /// The least probable kind of data, if the model does not explain it.
    pub fn misfit_kind(&self) -> Option<&KindFit> {
        let worst = self.tested_kinds().min_by(|a, b| a.probability().total_cmp(&b.probability()))?;
        (worst.probability() < self.min_kind_probability()).then_some(worst)
    }

    /// Whether the fitted model explains the data, all together and those of each kind.
    pub fn quality(&self) -> FitQuality {
        if self.probability() < MIN_PROBABILITY || self.misfit_kind().is_some() {
            FitQuality::NotExplained
        } else if self.degrees_of_freedom < 0.5 {
            FitQuality::NotTested
        } else if lower_probability(self.chi_squared, self.degrees_of_freedom) < MIN_PROBABILITY {
            FitQuality::DeviationsTooLarge
        } else {
            FitQuality::Explained
        }
    }

    /// Whether the model does not explain the data.
    pub fn is_rejected(&self) -> bool {
        self.quality() == FitQuality::NotExplained
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data_kind::DataKind;

    #[test]
    fn quality_by_the_probability() {
        let of = |chi_squared, degrees_of_freedom| {
            GoodnessOfFit { chi_squared, degrees_of_freedom, by_kind: Vec::new() }.quality()
        };
        // 1 % points of 14 degrees of freedom: 29.14 above, 4.66 below.
        for (chi_squared, quality) in [
            (35.9, FitQuality::NotExplained),
            (29.2, FitQuality::NotExplained),
            (29.1, FitQuality::Explained),
            (14.0, FitQuality::Explained),
            (4.7, FitQuality::Explained),
            (4.6, FitQuality::DeviationsTooLarge),
            (0.0, FitQuality::DeviationsTooLarge),
        ] {
            assert_eq!(of(chi_squared, 14.0), quality, "{chi_squared}");
        }
        assert_eq!(of(0.0, 0.1), FitQuality::NotTested);
        assert_eq!(of(500.0, 0.1), FitQuality::NotExplained);
    }

    #[test]
    fn parameters_that_are_not_fitted_take_no_degrees_of_freedom() {
        let jacobian = DMatrix::from_row_slice(3, 2, &[1e4, 0.0, 0.0, 1e4, 0.0, 0.0]);
        let at = Evaluation::of_frequencies(vec![1.0, 2.0, 2.0], jacobian);
        let prior =
            Prior { mean: vec![0.0; 2], deviation: vec![1.0; 2], lower: vec![-9.0; 2], upper: vec![9.0; 2] };
        for (fitted, degrees) in [(&[][..], 3.0), (&[1][..], 2.0), (&[0, 1][..], 1.0)] {
            let found = GoodnessOfFit::new(&at, &prior, fitted);
            assert_eq!(found.chi_squared, 9.0);
            assert!((found.degrees_of_freedom - degrees).abs() < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn misfit_of_one_kind_is_not_hidden_by_cautious_deviations_of_another() {
        let kind = |kind, chi_squared, degrees_of_freedom| KindFit {
            kind,
            data: degrees_of_freedom + 1.0,
            chi_squared,
            degrees_of_freedom,
        };
        let of = |frequencies: f64, shapes: f64| GoodnessOfFit {
            chi_squared: frequencies + shapes,
            degrees_of_freedom: 13.0,
            by_kind: vec![kind(DataKind::Frequency, frequencies, 5.0), kind(DataKind::Shape, shapes, 8.0)],
        };
        // 17.1 with 5 degrees of freedom has a probability of 0.43 %, 16.7 of 0.51 %; with 13 both are plausible.
        assert_eq!(of(17.1, 0.2).quality(), FitQuality::NotExplained);
        assert_eq!(of(17.1, 0.2).misfit_kind().unwrap().kind, DataKind::Frequency);
        assert_eq!(of(16.7, 0.2).quality(), FitQuality::Explained);
        // Of a kind without degrees of freedom nothing is said.
        let untested = GoodnessOfFit { by_kind: vec![kind(DataKind::Frequency, 17.1, 0.5)], ..of(17.1, 0.2) };
        assert_eq!(untested.quality(), FitQuality::Explained);
    }
}
