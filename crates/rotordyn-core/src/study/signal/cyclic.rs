//! Cyclic spectral coherence over the modulation (cyclic) frequencies of a bearing.

use super::Job;
use crate::results::{CyclicLine, CyclicResult};
use rotordyn_signal::SignalError;
use rotordyn_signal::bearing_lines::BearingPart;
use rotordyn_signal::cyclic::cyclic_coherence;
use rotordyn_signal::spectrum::{Spectrum, Welch};
use rotordyn_signal::statistics::median;

/// Samples of a segment: the carrier resolution is the sampling rate divided by it.
const SEGMENT: usize = 256;
/// Largest number of modulation frequencies; a longer record is truncated to match.
const MAX_RATES: usize = 1500;
/// Highest modulation frequency without bearing data, relative to the sampling rate.
const DEFAULT_HIGHEST_RATE: f64 = 1.0 / 32.0;

impl Job<'_> {
    /// Coherence up to twice the highest characteristic frequency, at the resolution of the record.
    pub(super) fn cyclic(&self) -> Result<CyclicResult, SignalError> {
        let rates = match self.bearing {
            Some(_) => {
                self.steady_speed("cyclic coherence at a bearing's rates")?;
                self.rates().map(|(rates, _)| rates)
            }
            None => None,
        };
        let highest = rates
            .map(|r| BearingPart::ALL.map(|part| part.defect_frequency(&r)).into_iter().fold(0.0, f64::max));
        let top = highest.map_or(DEFAULT_HIGHEST_RATE * self.rate, |h| 2.1 * h).min(0.5 * self.rate);
        let most = ((MAX_RATES as f64 / top) * self.rate) as usize;
        let x = &self.x[..self.x.len().min(most)];
        let step = self.rate / x.len() as f64;
        let alphas: Vec<f64> = (0..=(top / step) as usize).map(|k| k as f64 * step).collect();
        let welch = Welch { overlap: SEGMENT - SEGMENT / 4, ..Welch::hann(SEGMENT) };
        let coherence = cyclic_coherence(x, self.rate, &alphas, &welch)?;
        let enhanced = coherence.enhanced_envelope_spectrum((0.0, 0.5 * self.rate))?;
        let lines = rates.map_or_else(Vec::new, |rates| {
            let places = BearingPart::ALL.into_iter().flat_map(|part| [(part, 1), (part, 2)]);
            places
                .filter_map(|(part, n)| {
                    self.cyclic_line(&enhanced, part, n, n as f64 * part.defect_frequency(&rates))
                })
                .collect()
        });
        Ok(CyclicResult { coherence, enhanced, lines, duration: x.len() as f64 / self.rate })
    }

    /// The highest coherence within the slip tolerance about a rate, and its prominence over the background.
    fn cyclic_line(
        &self,
        over: &Spectrum,
        part: BearingPart,
        harmonic: usize,
        rate: f64,
    ) -> Option<CyclicLine> {
        let reach = (self.settings.lines.slip * rate).max(2.0 * over.frequencies[1]);
        let within = |half: f64| {
            let first = over.frequencies.partition_point(|a| *a < rate - half).max(1);
            first..over.frequencies.partition_point(|a| *a <= rate + half)
        };
        let best = within(reach).max_by(|&a, &b| over.values[a].total_cmp(&over.values[b]))?;
        let about = over.values[within(5.0 * reach + 40.0 * over.frequencies[1])].to_vec();
        let middle = median(about.clone());
        let spread = 1.4826 * median(about.iter().map(|v| (v - middle).abs()).collect());
        Some(CyclicLine {
            part,
            harmonic,
            expected: rate,
            rate: over.frequencies[best],
            coherence: over.values[best],
            background: middle,
            deviations: if spread > 0.0 { (over.values[best] - middle) / spread } else { 0.0 },
        })
    }
}
