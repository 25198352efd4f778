//! Tacholess speed estimation: shaft speed and angle from the ridge of one order line, refined by its phase.

use std::f64::consts::TAU;

use rustfft::num_complex::Complex;

use super::SignalError;
use super::error::{check, check_rate, check_record, check_same_length};
use super::filter::{Band, butterworth};
use super::ridge::{Peak, interpolate_peak};
use super::segment::Level;
use super::statistics::median;
use super::stft::{Stft, StftSettings, interpolate_at};
use super::window::WindowKind;

/// Frames from one to the next without overlap.
const HOPS_PER_FRAME: usize = 8;
/// Height of a peak over the usual one below which a path has lost its line.
const JUMP_HEIGHT: f64 = 0.15;

/// Settings of tacholess speed estimation: the order line that is tracked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedLineSettings {
    /// Its order: cycles per shaft revolution.
    pub order: f64,
    /// Frequency range of the line \[Hz\]; it must be the strongest line in this range.
    pub low: f64,
    pub high: f64,
    /// Maximum rate of change of its frequency (sweep rate) \[Hz/s\].
    pub max_sweep_rate: f64,
    /// Samples of an STFT frame, a few tens of periods of the line.
    pub frame: usize,
}

/// Shaft speed and angle estimated from an order line.
#[derive(Clone, Debug, PartialEq)]
pub struct EstimatedSpeed {
    /// Shaft angle at each sample \[rad\], 0 at the first sample (no absolute phase reference).
    pub theta: Vec<f64>,
    /// Shaft speed at each sample \[rpm\].
    pub rpm: Vec<f64>,
    /// Amplitude of the line over the median of what lies around it up to twice its frequency range, median over the frames:
    /// the highest of noise has 2 to 3.
    pub over_background: f64,
    /// Ratio of frequencies of the largest jump from one line to another, through what is no line; 1 without a jump.
    pub jump: f64,
}

/// Ridge extraction: the path of largest Σ ln A through the rows of a spectrogram that moves at most
/// `most_bins` from row to row.
///
/// `axis` (bins) uniform, `amplitude` (frames × bins) row-major, `range` of the axis in which the path stays.
/// Dynamic programming (Viterbi), robust to gaps and to stronger crossing lines. Errors: NaN, sizes that do
/// not match, a range without bins.
pub fn extract_ridge(
    axis: &[f64],
    amplitude: &[f64],
    range: (f64, f64),
    max_bins_per_frame: usize,
) -> Result<Vec<Peak>, SignalError> {
    check_record("axis", axis)?;
    check_record("amplitude", amplitude)?;
    let bins = axis.len();
    check_same_length("amplitude", amplitude.len() % bins, "whole rows of the axis", 0)?;
    let first = axis.partition_point(|f| *f < range.0);
    let end = axis.partition_point(|f| *f <= range.1);
    check(first < end, "lower end of the range", "a range that contains a bin", range.0)?;
    let width = end - first;
    let floor = f64::MIN_POSITIVE;
    let mut predecessors: Vec<Vec<usize>> = Vec::new();
    let mut score = vec![0.0f64; width];
    for row in amplitude.chunks_exact(bins) {
        let mut from = vec![0; width];
        let mut next = vec![0.0f64; width];
        for k in 0..width {
            let reach = k.saturating_sub(max_bins_per_frame)..(k + max_bins_per_frame + 1).min(width);
            let near = |i: &usize| i.abs_diff(k);
            let best = reach
                .max_by(|a, b| score[*a].total_cmp(&score[*b]).then(near(b).cmp(&near(a))))
                .expect("the range contains the bin itself");
            from[k] = best;
            next[k] = score[best] + row[first + k].max(floor).ln();
        }
        score = next;
        predecessors.push(from);
    }
    let mut k = (0..width).max_by(|&a, &b| score[a].total_cmp(&score[b])).expect("the range contains a bin");
    let mut path = Vec::with_capacity(predecessors.len());
    for (row, from) in amplitude.chunks_exact(bins).zip(&predecessors).rev() {
        path.push(interpolate_peak(axis, row, first + k));
        k = from[k];
    }
    path.reverse();
    Ok(path)
}

/// Shaft speed and angle from the line of one order (tacholess order tracking).
///
/// The ridge of a spectrogram (Hann, 7/8 overlap) gives the line's frequency to a fraction of a bin and,
/// integrated, a phase φ₀; the record demodulated by e^{−jφ₀} and low-passed below 2 f_s/frame has the slowly
/// varying remaining phase, φ = φ₀ + arg. The low-pass is a zero-phase Butterworth of order 2. The frequency
/// is extrapolated as constant over half a frame at either end of the record.
/// `record` (N), `sample_rate` \[Hz\]. Errors: NaN, record shorter than a frame, settings out of range.
/// Source: Bonnardot et al., Mech. Syst. Signal Process. 19 (2005); Leclère, André and Antoni, ibid. 81
/// (2016).
pub fn speed_from_line(
    record: &[f64],
    sample_rate: f64,
    settings: &SpeedLineSettings,
) -> Result<EstimatedSpeed, SignalError> {
    check_record("record", record)?;
    check_rate(sample_rate)?;
    let SpeedLineSettings { order, low, high, max_sweep_rate: most_change, frame } = *settings;
    check(order > 0.0 && order.is_finite(), "order", "a positive number", order)?;
    check(
        low > 0.0 && low < 0.5 * sample_rate,
        "lower end of the line [Hz]",
        "0 to half the sampling rate",
        low,
    )?;
    check(
        high > low && high <= 0.5 * sample_rate,
        "upper end of the line [Hz]",
        "above the lower, up to half the sampling rate",
        high,
    )?;
    check(most_change > 0.0, "maximum rate of change of the line [Hz/s]", "a positive number", most_change)?;
    check(frame >= 16, "samples of a frame", "16 or more", frame as f64)?;
    let hop = frame.div_ceil(HOPS_PER_FRAME);
    let stft = StftSettings {
        window: WindowKind::Hann,
        length: frame,
        hop,
        fft_length: 2 * frame,
        level: Level::Peak,
    };
    let map = Stft::new(stft, sample_rate)?.spectrogram(record)?;
    let per_bin = map.frequencies[1];
    let most_bins = (most_change * hop as f64 / sample_rate / per_bin).ceil() as usize;
    let path = extract_ridge(&map.frequencies, &map.amplitude, (low, high), most_bins.max(1))?;
    let heights = over_background(&map.frequencies, &map.amplitude, &path, (low, high));
    let over_background = median(heights.clone());
    let jump = largest_jump(&path, &heights, over_background);
    let places: Vec<f64> = path.iter().map(|p| p.position).collect();
    // Frame k is centred at sample k hop + frame/2.
    let at = |n: usize| interpolate_at(&places, (n as f64 - 0.5 * frame as f64) / hop as f64);
    let mut phase = Vec::with_capacity(record.len());
    let mut total = 0.0;
    for n in 0..record.len() {
        phase.push(total);
        total += 0.5 * TAU * (at(n) + at(n + 1)) / sample_rate;
    }
    let mean = record.iter().sum::<f64>() / record.len() as f64;
    let turned = |part: fn(f64) -> f64| -> Vec<f64> {
        record.iter().zip(&phase).map(|(x, phi)| (x - mean) * part(*phi)).collect()
    };
    let corner = (2.0 * sample_rate / frame as f64).min(0.4 * low);
    let low_pass = butterworth(2, Band::LowPass(corner), sample_rate)?;
    let re = low_pass.filter_zero_phase(&turned(f64::cos))?;
    let im = low_pass.filter_zero_phase(&turned(|phi| -phi.sin()))?;
    let rest: Vec<Complex<f64>> = re.into_iter().zip(im).map(|(re, im)| Complex::new(re, im)).collect();
    let start = rest[0].arg();
    let mut before = rest[0];
    let mut left = start;
    for (phi, z) in phase.iter_mut().zip(&rest) {
        // The phase step between samples is far below π: no unwrapping is needed.
        let step = (z * before.conj()).arg();
        left += step;
        before = *z;
        *phi += left - start;
    }
    let theta: Vec<f64> = phase.iter().map(|phi| phi / order).collect();
    let last = theta.len() - 1;
    let speed = |n: usize| {
        let (a, b) = (n.saturating_sub(1), (n + 1).min(last));
        (theta[b] - theta[a]) * sample_rate / (b - a).max(1) as f64 * 60.0 / TAU
    };
    Ok(EstimatedSpeed { rpm: (0..=last).map(speed).collect(), theta, over_background, jump })
}

/// For every row a peak's amplitude over the median of the bins outside its main lobe, from half the lower to twice the upper
/// end of a range.
fn over_background(axis: &[f64], amplitude: &[f64], path: &[Peak], (low, high): (f64, f64)) -> Vec<f64> {
    // Frames are padded to twice their length.
    let lobe = 2 * WindowKind::Hann.main_lobe_half_width() as usize;
    let first = axis.partition_point(|f| *f < 0.5 * low).max(lobe);
    let end = axis.partition_point(|f| *f <= 2.0 * high);
    let ratio = |(row, peak): (&[f64], &Peak)| {
        let apart = (first..end).filter(|k| k.abs_diff(peak.bin) > lobe).map(|k| row[k]).collect();
        peak.amplitude / median(apart).max(f64::MIN_POSITIVE)
    };
    amplitude.chunks_exact(axis.len()).zip(path).map(ratio).collect()
}

/// Largest ratio of the frequencies before and behind places where the path loses its line: heights below a seventh of the
/// usual one. Two frames lie between.
fn largest_jump(path: &[Peak], heights: &[f64], usual: f64) -> f64 {
    let (mut largest, mut k) = (1.0f64, 0);
    while k < path.len() {
        let lost = heights[k..].iter().take_while(|height| **height < JUMP_HEIGHT * usual).count();
        if lost > 0 {
            let before = path[k.saturating_sub(HOPS_PER_FRAME)].position;
            let behind = path[(k + lost - 1 + HOPS_PER_FRAME).min(path.len() - 1)].position;
            // A line that fades may move on meanwhile.
            if lost <= 2 * HOPS_PER_FRAME {
                largest = largest.max((behind / before).max(before / behind));
            }
        }
        k += lost.max(1);
    }
    largest
}
