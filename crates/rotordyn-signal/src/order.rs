//! Order tracking by angular resampling: order spectrogram, averaged order spectrum, order cuts.

pub mod smear;

use serde::{Deserialize, Serialize};
use std::f64::consts::{SQRT_2, TAU};
use std::ops::Range;

use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::check;
use super::resample::{AngleResampler, SAMPLES_PER_ORDER, Skipped, speed_rpm};
use super::segment::{Level, SegmentTransform};
use super::stft::interpolate_at;
use super::window::WindowKind;
use rotordyn_linalg::fft_length;
use smear::{Smear, is_passed, loss_by_window, taken_by_window};

/// Settings of order tracking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrderSettings {
    /// Spacing of the order bins; a window spans 1/resolution revolutions.
    pub resolution: f64,
    /// Highest order kept.
    pub max_order: f64,
    /// Overlap of neighbouring windows, a fraction 0..1.
    pub overlap: f64,
    pub window: WindowKind,
    pub level: Level,
    /// Speed \[rev/s\] below which the shaft counts as at standstill.
    pub min_speed: f64,
}

impl OrderSettings {
    /// Hann windows with 75 % overlap, peak amplitudes, standstill below 0.05 rev/s.
    pub fn new(resolution: f64, max_order: f64) -> Self {
        OrderSettings {
            resolution,
            max_order,
            overlap: 0.75,
            window: WindowKind::Hann,
            level: Level::Peak,
            min_speed: 0.05,
        }
    }
}

/// Order spectrogram: amplitudes over speed and order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderSpectrogram<A = Vec<f64>> {
    /// Time at each window's centre in angle \[s\].
    pub times: Vec<f64>,
    /// Speed there \[rpm\], averaged over the revolution around it.
    pub rpm: Vec<f64>,
    /// Order bins, 0 to the highest kept.
    pub orders: Vec<f64>,
    /// Amplitudes, row-major: a row for each window, a column for each order.
    pub amplitude: A,
    /// Equivalent noise bandwidth in bins.
    pub noise_bandwidth_bins: f64,
    pub level: Level,
    #[serde(default)]
    pub window: WindowKind,
    /// Cuts whose maximum the window lowers by more than 10 %, of those looked at.
    #[serde(default)]
    pub smeared: Vec<Smear>,
}

/// Order cut: the RMS level of one order against speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderCut {
    pub order: f64,
    pub times: Vec<f64>,
    pub rpm: Vec<f64>,
    /// RMS of everything in the band.
    pub rms: Vec<f64>,
}

/// One order's complex peak amplitude (order vector) against speed; phase relative to cos(order · θ).
#[derive(Clone, Debug, PartialEq)]
pub struct OrderVector {
    pub order: f64,
    pub times: Vec<f64>,
    pub rpm: Vec<f64>,
    pub amplitude: Vec<Complex<f64>>,
}

/// Order tracking planned once for a shaft angle and used for all channels.
pub struct OrderTracker {
    settings: OrderSettings,
    resampler: AngleResampler,
    transform: SegmentTransform,
    hop: usize,
    /// Windows: index of the part, first sample in it.
    windows: Vec<(usize, usize)>,
    times: Vec<f64>,
    rpm: Vec<f64>,
}

impl OrderTracker {
    /// Plans the tracking from a shaft angle sampled like the records.
    ///
    /// `theta` (N) \[rad\], `sample_rate` \[Hz\]. Standstill is skipped ([`Self::skipped`]).
    /// Errors: NaN, settings out of range, no segment of 1/resolution revolutions, a sampling rate below 2.56
    /// times the highest order at the highest speed.
    pub fn new(theta: &[f64], sample_rate: f64, settings: OrderSettings) -> Result<Self, SignalError> {
        let OrderSettings { resolution, max_order, overlap, .. } = settings;
        check(
            resolution > 0.0 && resolution <= 1.0,
            "order resolution",
            "more than 0, at most 1",
            resolution,
        )?;
        check(
            max_order >= resolution && max_order <= 1e4,
            "highest order",
            "resolution to 10000",
            max_order,
        )?;
        check((0.0..1.0).contains(&overlap), "overlap", "a fraction from 0 to below 1", overlap)?;
        let per_revolution = fft_length(((SAMPLES_PER_ORDER * max_order).ceil() as usize).max(4), 2);
        let resampler = AngleResampler::new(theta, sample_rate, per_revolution, settings.min_speed)?;
        let length = (per_revolution as f64 / resolution).round() as usize;
        let hop = ((length as f64 * (1.0 - overlap)).round() as usize).max(1);
        let (mut windows, mut times, mut rpm) = (Vec::new(), Vec::new(), Vec::new());
        let mut longest = 0;
        let mut fastest = f64::INFINITY;
        for (index, part) in resampler.parts().iter().enumerate() {
            longest = longest.max(part.times.len());
            for pair in part.times.windows(2) {
                fastest = fastest.min(pair[1] - pair[0]);
            }
            let mut first = 0;
            while first + length <= part.times.len() {
                let centre = first as f64 + length as f64 / 2.0;
                windows.push((index, first));
                times.push(interpolate_at(&part.times, centre));
                rpm.push(speed_rpm(part, centre, per_revolution));
                first += hop;
            }
        }
        let needed = SAMPLES_PER_ORDER * max_order / (per_revolution as f64 * fastest);
        if needed > sample_rate {
            let purpose = "the highest order at the highest speed";
            return Err(SignalError::RateTooLow { given: sample_rate, needed, purpose });
        }
        if windows.is_empty() {
            return Err(SignalError::TooFewRevolutions {
                needed: 1.0 / resolution,
                given: longest as f64 / per_revolution as f64,
                purpose: "one window of this order resolution",
            });
        }
        let transform = SegmentTransform::new(settings.window, length, length);
        Ok(OrderTracker { settings, resampler, transform, hop, windows, times, rpm })
    }

    /// Segments of the record that were skipped because of standstill.
    pub fn skipped(&self) -> &[Skipped] {
        self.resampler.skipped()
    }

    /// Hop: revolutions from one window to the next.
    pub fn hop_revolutions(&self) -> f64 {
        self.hop as f64 / self.resampler.samples_per_revolution() as f64
    }

    /// The channels in the angle domain, input of [`Self::spectrogram`] and [`Self::vector`].
    ///
    /// Errors: NaN, a channel and the angle of different length.
    pub fn resample(&self, channels: &[&[f64]]) -> Result<Vec<AngleRecord>, SignalError> {
        let mut records = vec![AngleRecord { parts: Vec::new() }; channels.len()];
        for part in self.resampler.resample(channels)? {
            for (record, samples) in records.iter_mut().zip(part) {
                record.parts.push(samples);
            }
        }
        Ok(records)
    }

    /// Amplitude over speed and order; `record` comes from [`Self::resample`] of this tracker.
    pub fn spectrogram(&mut self, record: &AngleRecord) -> OrderSpectrogram {
        let length = self.transform.length();
        let spacing = self.resampler.samples_per_revolution() as f64 / length as f64;
        let bins = ((self.settings.max_order / spacing).round() as usize + 1).min(self.transform.bins());
        let mut amplitude = vec![0.0; self.windows.len() * bins];
        for ((part, first), row) in self.windows.iter().zip(amplitude.chunks_exact_mut(bins)) {
            let segment = &record.parts[*part][*first..first + length];
            self.transform.amplitudes(segment, self.settings.level, row);
        }
        OrderSpectrogram {
            times: self.times.clone(),
            rpm: self.rpm.clone(),
            orders: (0..bins).map(|k| k as f64 * spacing).collect(),
            amplitude,
            noise_bandwidth_bins: self.transform.noise_bandwidth_bins(),
            level: self.settings.level,
            window: self.settings.window,
            smeared: Vec::new(),
        }
    }

    /// Complex amplitude of one order, X = 2 Σ w_k x_k e^{−jνθ_k} / Σw, at any ν, not only at a bin.
    ///
    /// x = |X| cos(νθ + arg X). `record` comes from [`Self::resample`]. Errors: order not in 0..highest.
    pub fn vector(&self, record: &AngleRecord, order: f64) -> Result<OrderVector, SignalError> {
        let turned = self.turned(record, order)?;
        let at = |&(part, first): &(usize, usize)| self.mean_of_window(&turned[part], first);
        Ok(OrderVector {
            order,
            times: self.times.clone(),
            rpm: self.rpm.clone(),
            amplitude: self.windows.iter().map(at).collect(),
        })
    }

    /// A cut of this record whose maximum the window lowers by more than 10 %, as a fast passage through a resonance.
    ///
    /// The loss is a lower bound. Not told within a quarter of a window of the ends of a part, nor with fewer than five
    /// windows, nor for the mean.
    pub fn smear(&self, record: &AngleRecord, cut: &OrderCut) -> Option<Smear> {
        let turned = self.turned(record, cut.order).ok()?;
        let length = self.transform.length();
        let quarter = length / 4;
        let around = |&(part, first): &(usize, usize)| {
            let samples = &turned[part];
            let inside = first >= quarter && first + length + quarter <= samples.len();
            inside.then(|| {
                [first - quarter, first, first + quarter].map(|first| self.mean_of_window(samples, first))
            })
        };
        let found: Vec<_> = self.windows.iter().map(around).collect();
        let highest = (0..cut.rms.len()).max_by(|&a, &b| cut.rms[a].total_cmp(&cut.rms[b]));
        let (highest, neighbours) = highest.and_then(|k| Some((k, found[k]?)))?;
        let all: Vec<f64> = found.iter().flatten().map(|values| taken_by_window(*values)).collect();
        let loss = loss_by_window(neighbours[1].norm(), taken_by_window(neighbours), &all);
        loss.filter(|_| is_passed(cut.rpm[highest], &cut.rpm)).map(|loss| Smear {
            order: cut.order,
            rpm: cut.rpm[highest],
            loss,
        })
    }

    /// The cuts of 1x whose maximum the window lowers; other orders rise and fall by nature, as contacts and cages modulate
    /// them.
    pub fn smeared<'a>(&self, record: &AngleRecord, cuts: impl Iterator<Item = &'a OrderCut>) -> Vec<Smear> {
        cuts.filter(|cut| cut.order == 1.0).filter_map(|cut| self.smear(record, cut)).collect()
    }

    /// x e^{−jνθ} of every part.
    fn turned(&self, record: &AngleRecord, order: f64) -> Result<Vec<Vec<Complex<f64>>>, SignalError> {
        let inside = order > 0.0 && order <= self.settings.max_order;
        check(inside, "order", "more than 0, at most the highest order", order)?;
        let per_revolution = self.resampler.samples_per_revolution() as f64;
        let parts = self.resampler.parts().iter().zip(&record.parts);
        let turned = parts.map(|(part, samples)| {
            let at = |(k, x): (usize, &f64)| {
                Complex::from_polar(*x, -order * TAU * (part.first + k as i64) as f64 / per_revolution)
            };
            samples.iter().enumerate().map(at).collect()
        });
        Ok(turned.collect())
    }

    /// 2 Σ w_k z_k/Σw over the window from sample `first` on.
    fn mean_of_window(&self, turned: &[Complex<f64>], first: usize) -> Complex<f64> {
        let weights = self.transform.window();
        let sum: Complex<f64> =
            turned[first..first + weights.len()].iter().zip(weights).map(|(z, w)| z * w).sum();
        sum * (2.0 / weights.iter().sum::<f64>())
    }
}

/// A channel resampled uniformly in shaft angle, a part for each segment in which the shaft rotates.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleRecord {
    pub parts: Vec<Vec<f64>>,
}

impl<A> OrderSpectrogram<A> {
    /// The same with amplitudes in another form, such as stored ones.
    ///
    /// # Errors
    /// That of `form`.
    pub fn try_map_amplitude<B, E>(
        self,
        form: impl FnOnce(A) -> Result<B, E>,
    ) -> Result<OrderSpectrogram<B>, E> {
        let Self { times, rpm, orders, amplitude, noise_bandwidth_bins, level, window, smeared } = self;
        let amplitude = form(amplitude)?;
        Ok(OrderSpectrogram { times, rpm, orders, amplitude, noise_bandwidth_bins, level, window, smeared })
    }

    /// Bins of the band `order` ± `half_band`, laid about the bin nearest to the order; empty beyond the axis.
    ///
    /// So an order between two bins has as many bins as one at a bin, and a line that slips by half a bin stays among them.
    pub(super) fn band(&self, order: f64, half_band: f64) -> Range<usize> {
        let bins = self.orders.len();
        let spacing = self.orders.get(1).copied().unwrap_or(1.0);
        let centre = (order / spacing).round();
        // Up to rounding a band edge on a bin includes that bin.
        let reach = (half_band / spacing + 1e-9 * bins as f64).floor();
        if !order.is_finite() || centre < 0.0 || reach < 0.0 || centre - reach >= bins as f64 {
            return 0..0;
        }
        (centre - reach).max(0.0) as usize..((centre + reach) as usize + 1).min(bins)
    }

    /// D = Σ |W(k − ν)|²/|W(0)|² over these bins: the power in them of a line at the order, over that of the line.
    ///
    /// A band as wide as the main lobe has all of it, the noise bandwidth in bins. A line by the bin of the mean is joined by
    /// its image at −ν, with which it shares no phase on average.
    pub(super) fn line_share(&self, bins: Range<usize>, order: f64) -> f64 {
        let place = order / self.orders.get(1).copied().unwrap_or(1.0);
        let power = |k: f64| self.window.line_shape(k - place).powi(2);
        bins.map(|k| power(k as f64) + if k > 0 { power(-(k as f64)) } else { 0.0 }).sum()
    }
}

impl OrderSpectrogram {
    /// Amplitudes of one window over the orders.
    pub fn row(&self, window: usize) -> &[f64] {
        let bins = self.orders.len();
        &self.amplitude[window * bins..(window + 1) * bins]
    }

    /// RMS of the line of an order against speed, √(Σ A_rms²/D) over the bins of the band `order` ± `half_band`.
    ///
    /// D is the power of the line in these bins (`line_share`): a line at the order has its level whatever the
    /// window, the band and the place of the order between the bins. With Hann and three bins a line half a bin from the
    /// order reads up to 1 % low or high, one a bin from it 8 % low; white noise reads as √(bins/D) times that of one bin.
    /// Errors: no bin in the band.
    pub fn cut(&self, order: f64, half_band: f64) -> Result<OrderCut, SignalError> {
        self.cut_along(order, &vec![order; self.times.len()], half_band)
    }

    /// As [`Self::cut`] of a line whose order changes along the run: `orders` of the windows, `order` their mean.
    ///
    /// Errors: no bin in a band.
    pub fn cut_along(&self, order: f64, orders: &[f64], half_band: f64) -> Result<OrderCut, SignalError> {
        let to_rms = |k: usize| match self.level {
            Level::Peak if k > 0 => 1.0 / SQRT_2,
            _ => 1.0,
        };
        let mut known: Option<(f64, std::ops::Range<usize>, f64)> = None;
        let mut rms = Vec::with_capacity(orders.len());
        for (window, &order) in orders.iter().enumerate() {
            let (_, band, share) = match known.take().filter(|(of, ..)| *of == order) {
                Some(same) => same,
                None => {
                    let band = self.band(order, half_band);
                    check(!band.is_empty(), "order band", "a band that contains an order bin", order)?;
                    let share = self.line_share(band.clone(), order);
                    (order, band, share)
                }
            };
            let row = self.row(window);
            let power: f64 = band.clone().map(|k| (row[k] * to_rms(k)).powi(2)).sum();
            rms.push((power / share).sqrt());
            known = Some((order, band, share));
        }
        Ok(OrderCut { order, times: self.times.clone(), rpm: self.rpm.clone(), rms })
    }

    /// Order spectrum averaged in power over all windows between two speeds \[rpm\].
    ///
    /// Errors: no window in that range.
    pub fn average(&self, from_rpm: f64, to_rpm: f64) -> Result<Vec<f64>, SignalError> {
        let mut power = vec![0.0; self.orders.len()];
        let mut windows = 0;
        for (window, rpm) in self.rpm.iter().enumerate() {
            if (from_rpm..=to_rpm).contains(rpm) {
                windows += 1;
                power.iter_mut().zip(self.row(window)).for_each(|(p, a)| *p += a * a);
            }
        }
        check(windows > 0, "speed range from", "a range that the run passes through", from_rpm)?;
        Ok(power.iter().map(|p| (p / windows as f64).sqrt()).collect())
    }
}
