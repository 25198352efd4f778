//! Background beside an order, and how certain the level of an order cut over it is.

use std::f64::consts::LN_2;

use super::order::OrderSpectrogram;
use super::segment::Level;
use super::statistics::median;

/// Bins by which a line may be off its order, beyond half the main lobe of the window.
const OFF_BINS: f64 = 0.5;
/// Bins beyond the band of a cut, on either side, in which the background is read.
const BACKGROUND_BINS: usize = 10;
/// Windows on either side whose median is taken: a line that passes a resonance rings beside its order for less.
const WINDOWS: usize = 8;
/// Chance that noise alone exceeds a level that counts as a line, in all windows of a run together.
const CHANCE: f64 = 0.01;

/// Background in the band of an order cut.
#[derive(Clone, Debug, PartialEq)]
pub struct CutBackground {
    /// RMS of the background in the band, for each window.
    pub rms: Vec<f64>,
    /// Number of independent parts of the band: its bins over the noise bandwidth.
    pub cells: f64,
    /// Relative standard deviation of the power in one window, that of a median of as many exponentials,
    /// 1/(ln 2 √bins).
    pub relative_deviation: f64,
}

impl<A> OrderSpectrogram<A> {
    /// Background in the band `order` ± `half_band`, from the bins beside it.
    ///
    /// N = n m²/(D ln 2), m² the median of A_rms² over up to ten bins on either side (noise power is exponentially
    /// distributed), n the bins of the band and D the divisor of its cut; of that the median over eight windows on either
    /// side. Bins that the window of another line reaches are left out: those of `lines` and of whole orders. `amplitude`
    /// of this spectrogram, row-major. `None` if no bin is left.
    pub fn cut_background(
        &self,
        amplitude: &[f64],
        order: f64,
        half_band: f64,
        lines: &[f64],
    ) -> Option<CutBackground> {
        let spacing = self.orders.get(1)?;
        let bins = self.orders.len();
        let reach = (self.window.main_lobe_half_width() + OFF_BINS) * spacing;
        let band = self.band(order, half_band);
        let (first, end) = (band.start, band.end);
        let is_free = |k: &usize| {
            let place = self.orders[*k];
            let whole = (place - place.round()).abs() > reach;
            let apart = |line: &f64| (place - line).abs() > reach;
            // Bin 0 is the mean.
            place > reach && apart(&order) && lines.iter().all(apart) && (whole || *spacing > 0.15)
        };
        let around =
            (first.saturating_sub(BACKGROUND_BINS)..first).chain(end..(end + BACKGROUND_BINS).min(bins));
        let free: Vec<usize> = around.filter(is_free).collect();
        if free.is_empty() {
            return None;
        }
        let cells = band.len().max(1) as f64 / self.noise_bandwidth_bins;
        // What noise adds to a cut of this band.
        let read = band.len().max(1) as f64 / self.line_share(band, order).max(f64::MIN_POSITIVE);
        let to_power = if self.level == Level::Peak { 0.5 } else { 1.0 };
        let medians = amplitude
            .chunks_exact(bins)
            .map(|row| median(free.iter().map(|k| row[*k] * row[*k]).collect()) * read * to_power / LN_2);
        let power: Vec<f64> = medians.collect();
        let about = |k: usize| power[k.saturating_sub(WINDOWS)..(k + WINDOWS + 1).min(power.len())].to_vec();
        let relative_deviation = 1.0 / (LN_2 * (free.len() as f64).sqrt());
        let rms = (0..power.len()).map(|k| median(about(k)).sqrt()).collect();
        Some(CutBackground { rms, cells, relative_deviation })
    }
}

impl CutBackground {
    /// Standard deviation of a level L by the background in its window.
    ///
    /// P = |s + n|² summed over ν cells of noise power N/ν each has the variance (2 S² N + N²)/ν, S² = L² − N, and
    /// σ_L = σ_P/2L. N is taken one standard deviation above the background read.
    pub fn deviation(&self, level: f64, window: usize) -> f64 {
        let noise = self.rms[window].powi(2) * (1.0 + self.relative_deviation);
        let line = (level * level - noise).max(0.0);
        let variance = (2.0 * line * noise + noise * noise) / self.cells;
        if level > 0.0 { 0.5 * variance.sqrt() / level } else { self.rms[window] }
    }

    /// Least level in a window that noise does not explain.
    ///
    /// The mean of ν exponentials exceeds q times its expectation with a chance below e^(−ν (q − 1 − ln q)) (Chernoff);
    /// that of all windows together is 1 %. The expectation is taken two standard deviations above the background read.
    pub fn limit(&self, window: usize) -> f64 {
        let needed = (self.rms.len().max(1) as f64 / CHANCE).ln() / self.cells;
        // q = 1 + needed + ln q, a contraction for q > 1.
        let mut ratio = 2.0 + needed;
        for _ in 0..60 {
            ratio = 1.0 + needed + ratio.ln();
        }
        self.rms[window] * (ratio * (1.0 + 2.0 * self.relative_deviation)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::super::order::{OrderSettings, OrderTracker};
    use super::*;
    use std::f64::consts::TAU;

    const RATE: f64 = 2000.0;

    /// 1x of RMS `level` in white noise of standard deviation 1, at 20 rev/s: cut of 1x and its background.
    fn cut(level: f64, seed: u64) -> (Vec<f64>, CutBackground) {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut uniform = move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut normal = || (-2.0 * uniform().max(1e-12).ln()).sqrt() * (TAU * uniform()).cos();
        let angle: Vec<f64> = (0..40_000).map(|k| TAU * 20.0 * k as f64 / RATE).collect();
        let record: Vec<f64> =
            angle.iter().map(|a| level * std::f64::consts::SQRT_2 * a.cos() + normal()).collect();
        let settings = OrderSettings::new(0.05, 10.0);
        let mut tracker = OrderTracker::new(&angle, RATE, settings).unwrap();
        let over_angle = tracker.resample(&[&record]).unwrap().swap_remove(0);
        let found = tracker.spectrogram(&over_angle);
        let background = found.cut_background(&found.amplitude, 1.0, 0.05, &[1.0, 1.3]).unwrap();
        (found.cut(1.0, 0.05).unwrap().rms, background)
    }

    /// White noise of variance 1 up to 1 kHz has 1e-3 V²/Hz: in a band of two noise bandwidths of 1.5 bins of 1 Hz.
    #[test]
    fn background_of_white_noise_is_that_of_its_bandwidth() {
        let mut power = 0.0;
        for seed in 1..=20 {
            let (_, background) = cut(3.0, seed);
            assert!((background.cells - 2.0).abs() < 1e-9);
            power += background.rms.iter().map(|v| v * v).sum::<f64>() / background.rms.len() as f64;
        }
        let expected = 2.0 * 1.5 * 1e-3;
        assert!((power / 20.0 / expected - 1.0).abs() < 0.15, "{} {expected}", power / 20.0);
    }

    /// The scatter of the level over seeds is the standard deviation stated or up to 1.6 times smaller, from strong lines
    /// to none.
    #[test]
    fn deviation_is_the_scatter_of_the_level() {
        for level in [1.0, 0.1, 0.05] {
            let (mut values, mut stated) = (Vec::new(), 0.0);
            for seed in 1..=60 {
                let (rms, background) = cut(level, seed);
                // Windows that do not overlap.
                for window in (0..rms.len()).step_by(4) {
                    stated += background.deviation(rms[window], window).powi(2);
                    values.push(rms[window]);
                }
            }
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let scatter = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
            let ratio = (stated / values.len() as f64 / scatter).sqrt();
            assert!((0.9..1.6).contains(&ratio), "{level}: {ratio}");
        }
    }

    /// Of forty runs of noise one at most has a level above the limit; a line of RMS 0.3 over noise of 0.055 always has.
    #[test]
    fn noise_stays_below_the_limit() {
        let above = |level: f64| {
            let exceeds = |seed: &u64| {
                let (rms, background) = cut(level, *seed);
                (0..rms.len()).any(|w| rms[w] > background.limit(w))
            };
            (1..=40u64).filter(exceeds).count()
        };
        let [noise, line] = [0.0, 0.3].map(above);
        assert!(noise <= 1 && line == 40, "{noise} {line}");
    }
}
