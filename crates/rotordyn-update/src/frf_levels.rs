//! Levels and signs of measured FRFs beside the computed ones: single channels with another factor, reversed, exchanged and dead
//! ones.
//!
//! FRAC is 1 for FRFs that differ by a factor, whatever the factor. For a factor of all FRFs see [`super::frf_scale`].

use rotordyn_core::document::number;
use rotordyn_identify::mac::frac;
use rotordyn_linalg::Complex64;
use rotordyn_signal::statistics::median;

/// FRAC from which two FRFs are those of the same points, and from which a smaller factor between them counts.
const ALIKE: f64 = 0.8;
const NEARLY_EQUAL: f64 = 0.95;
/// Factors between FRFs that a model does not explain: of alike and of nearly equal FRFs.
const FACTOR: f64 = 3.0;
const FACTOR_OF_EQUAL: f64 = 1.3;
/// Correlation coefficient below which the sign is reversed.
const REVERSED: f64 = -0.8;
/// 1 − FRAC with other points, or of another quantity, over the own one, and its least FRAC, from which these are meant.
const NEARER: f64 = 0.33;
const EXCHANGED: f64 = 0.9;
/// Power of a computed FRF over the largest of its response below which it is zero.
const ZERO_POWER: f64 = 1e-6;
/// Computed over measured level of a sensor that measures nothing, and the least share of the largest computed response.
const DEAD: f64 = 30.0;
const DEAD_SHARE: f64 = 0.01;
/// Responses or references from which the level of most of them is the right one.
const MOST: usize = 3;

/// What the FRFs of one response, of one reference or all of them show.
#[derive(Clone, Debug, PartialEq)]
pub enum FrfFault {
    /// Computed values are `factor` times the measured ones, beside what all have in common.
    Factor { of: FrfGroup, factor: f64 },
    /// The measured ones have the other sign.
    Reversed { of: FrfGroup },
    /// Two responses are exchanged.
    Exchanged { responses: [usize; 2] },
    /// A response measures next to nothing.
    Dead { response: usize },
}

impl FrfFault {
    fn exchanged_responses(&self) -> Vec<usize> {
        if let Self::Exchanged { responses } = self { responses.to_vec() } else { Vec::new() }
    }

    /// The fault in words, with the names of responses and references.
    pub fn text(&self, responses: &[String], references: &[String]) -> String {
        let group = |of: &FrfGroup| match of {
            FrfGroup::All => "the measured FRFs".into(),
            FrfGroup::Response(r) => format!("the FRFs of response {}", responses[*r]),
            FrfGroup::Reference(e) => format!("the FRFs of reference {}", references[*e]),
        };
        match self {
            Self::Factor { of, factor } => {
                let (times, than) = if *factor > 1.0 { (*factor, "lower") } else { (1.0 / factor, "higher") };
                format!(
                    "{} have the shape of the computed ones but are {} times {than} in proportion to the others: unit, \
                     calibration or gain",
                    group(of),
                    number(times, 3)
                )
            }
            Self::Reversed { of } => format!(
                "{} have the sign opposite to the computed ones: a reversed sensor, force or direction",
                group(of)
            ),
            Self::Exchanged { responses: [a, b] } => format!(
                "the FRFs of the responses {} and {} fit the computed ones if exchanged: exchanged channels, points or \
                 directions",
                responses[*a], responses[*b]
            ),
            Self::Dead { response } => format!(
                "the FRFs of response {} are far below the computed ones: a dead or disconnected sensor",
                responses[*response]
            ),
        }
    }
}

/// FRFs that a fault concerns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrfGroup {
    All,
    Response(usize),
    Reference(usize),
}

/// ln of computed over measured magnitude, median over the half of the lines with the larger magnitudes; `None` if one is zero.
///
/// Unlike the ratio of the powers it hardly depends on the damping and on the place of the resonances, and unlike the median
/// over all lines it does not rest on lines of noise.
pub fn log_ratio(measured: &[Complex64], computed: &[Complex64]) -> Option<f64> {
    let lines = measured.iter().zip(computed).map(|(m, c)| (m.norm(), c.norm()));
    let mut pairs: Vec<(f64, f64)> = lines.filter(|(m, c)| *m > 0.0 && *c > 0.0).collect();
    pairs.sort_by(|a, b| (a.0 * a.1).total_cmp(&(b.0 * b.1)));
    let larger = pairs.split_off(pairs.len() / 2);
    (!larger.is_empty()).then(|| median(larger.iter().map(|(m, c)| (c / m).ln()).collect()))
}

/// FRFs `[response][reference][line]`.
pub struct FrfLevels<'a> {
    measured: &'a [Vec<Vec<Complex64>>],
    computed: &'a [Vec<Vec<Complex64>>],
}

/// FRAC, ln of the factor and correlation coefficient of one FRF.
#[derive(Clone, Copy)]
struct FrfMatch {
    frac: f64,
    log_factor: f64,
    sign: f64,
}

impl<'a> FrfLevels<'a> {
    pub fn new(measured: &'a [Vec<Vec<Complex64>>], computed: &'a [Vec<Vec<Complex64>>]) -> Self {
        Self { measured, computed }
    }

    fn responses(&self) -> usize {
        self.measured.len()
    }

    fn references(&self) -> usize {
        self.measured.first().map_or(0, Vec::len)
    }

    /// ln of computed over measured, `[response][reference]`; NaN where one of the two is zero.
    pub fn log_ratios(&self) -> Vec<Vec<f64>> {
        let of =
            |r: usize, e: usize| log_ratio(&self.measured[r][e], &self.computed[r][e]).unwrap_or(f64::NAN);
        (0..self.responses()).map(|r| (0..self.references()).map(|e| of(r, e)).collect()).collect()
    }

    /// Faults of units, signs and points; none in FRFs of which the model is too far. `scale`: computed over measured, common to
    /// all FRFs.
    pub fn faults(&self, scale: f64) -> Vec<FrfFault> {
        let alike = self.matches();
        let mut found = self.exchanged();
        let exchanged: Vec<usize> = found.iter().flat_map(FrfFault::exchanged_responses).collect();
        let of_exchanged = |fault: &FrfFault| match fault {
            FrfFault::Factor { of: FrfGroup::Response(r), .. } => exchanged.contains(r),
            FrfFault::Reversed { of: FrfGroup::Response(r) } => exchanged.contains(r),
            _ => false,
        };
        let others = self.factors(&alike, scale).into_iter().chain(reversed(&alike));
        found.extend(others.filter(|fault| !of_exchanged(fault)));
        found.extend(self.dead(scale));
        found
    }

    fn matched(&self, r: usize, e: usize) -> Option<FrfMatch> {
        let (m, c) = (&self.measured[r][e], &self.computed[r][e]);
        let frac = frac(m, c);
        let product: Complex64 = m.iter().zip(c).map(|(m, c)| m.conj() * c).sum();
        let log_factor = log_ratio(m, c).filter(|_| frac >= ALIKE)?;
        Some(FrfMatch { frac, log_factor, sign: product.re / product.norm() })
    }

    /// Of the FRFs of which model and measurement have the same shape over frequency.
    fn matches(&self) -> Vec<Vec<Option<FrfMatch>>> {
        let row = |r: usize| (0..self.references()).map(|e| self.matched(r, e)).collect();
        (0..self.responses()).map(row).collect()
    }

    fn factors(&self, alike: &[Vec<Option<FrfMatch>>], scale: f64) -> Vec<FrfFault> {
        let all: Vec<f64> = alike.iter().flatten().flatten().map(|m| m.log_factor).collect();
        let groups =
            |count: usize, group: &dyn Fn(usize) -> FrfGroup, of: &dyn Fn(usize) -> Vec<FrfMatch>| {
                let base = if count >= MOST { median(all.clone()) } else { scale.ln() };
                let fault = |k: usize| {
                    let members = of(k);
                    let log = median(members.iter().map(|m| m.log_factor).collect()) - base;
                    let frac = median(members.iter().map(|m| m.frac).collect());
                    let limit: f64 = if frac >= NEARLY_EQUAL { FACTOR_OF_EQUAL } else { FACTOR };
                    let is_fault = !members.is_empty() && log.abs() > limit.ln();
                    is_fault.then(|| FrfFault::Factor { of: group(k), factor: log.exp() })
                };
                let found: Vec<FrfFault> = (0..count).filter_map(fault).collect();
                // All of them have no factor of their own.
                if found.len() < count { found } else { Vec::new() }
            };
        let of_response = |r: usize| alike[r].iter().flatten().copied().collect();
        let of_reference = |e: usize| alike.iter().filter_map(|row| row[e]).collect();
        let own = groups(self.responses(), &FrfGroup::Response, &of_response);
        if own.is_empty() { groups(self.references(), &FrfGroup::Reference, &of_reference) } else { own }
    }

    /// Mean FRAC of the measured FRFs of one response with the computed ones of another, where these differ from zero.
    fn frac_with(&self, measured: usize, computed: usize) -> f64 {
        let powers: Vec<f64> =
            self.computed[computed].iter().map(|frf| frf.iter().map(|h| h.norm_sqr()).sum()).collect();
        let least = ZERO_POWER * powers.iter().copied().fold(0.0, f64::max);
        let moved: Vec<usize> = (0..self.references()).filter(|e| powers[*e] > least).collect();
        let values = moved.iter().map(|e| frac(&self.measured[measured][*e], &self.computed[computed][*e]));
        values.sum::<f64>() / moved.len().max(1) as f64
    }

    fn exchanged(&self) -> Vec<FrfFault> {
        let pairs = (0..self.responses()).flat_map(|a| (a + 1..self.responses()).map(move |b| [a, b]));
        let is_exchanged = |[a, b]: &[usize; 2]| {
            let own = self.frac_with(*a, *a).max(self.frac_with(*b, *b));
            let crossed = self.frac_with(*a, *b).min(self.frac_with(*b, *a));
            crossed > EXCHANGED && 1.0 - crossed < NEARER * (1.0 - own)
        };
        pairs.filter(is_exchanged).map(|responses| FrfFault::Exchanged { responses }).collect()
    }

    /// `scale`: as of [`Self::faults`].
    fn dead(&self, scale: f64) -> Vec<FrfFault> {
        let power = |rows: &[Vec<Complex64>]| rows.iter().flatten().map(|h| h.norm_sqr()).sum::<f64>();
        let largest = self.computed.iter().map(|rows| power(rows)).fold(0.0, f64::max);
        let is_dead = |r: &usize| {
            let (m, c) = (power(&self.measured[*r]), power(&self.computed[*r]));
            c > (DEAD * scale).powi(2) * m
                && c > DEAD_SHARE * DEAD_SHARE * largest
                && self.frac_with(*r, *r) < ALIKE
        };
        let rows = (0..self.responses()).filter(is_dead);
        rows.map(|response| FrfFault::Dead { response }).collect()
    }
}

fn reversed(alike: &[Vec<Option<FrfMatch>>]) -> Vec<FrfFault> {
    let typical = |signs: Vec<f64>| (!signs.is_empty()).then(|| median(signs));
    let all = typical(alike.iter().flatten().flatten().map(|m| m.sign).collect());
    if all.is_some_and(|sign| sign < REVERSED) {
        return vec![FrfFault::Reversed { of: FrfGroup::All }];
    }
    let of_response = |r: &usize| typical(alike[*r].iter().flatten().map(|m| m.sign).collect());
    let rows: Vec<usize> =
        (0..alike.len()).filter(|r| of_response(r).is_some_and(|s| s < REVERSED)).collect();
    let columns = 0..alike.first().map_or(0, Vec::len);
    let of_reference = |e: &usize| typical(alike.iter().filter_map(|row| row[*e]).map(|m| m.sign).collect());
    let responses = rows.iter().map(|r| FrfFault::Reversed { of: FrfGroup::Response(*r) });
    let references = columns
        .filter(|e| rows.is_empty() && of_reference(e).is_some_and(|s| s < REVERSED))
        .map(|e| FrfFault::Reversed { of: FrfGroup::Reference(e) });
    responses.chain(references).collect()
}
