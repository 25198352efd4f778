//! Samples at a lower rate behind an anti-aliasing filter, while the record is still growing.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::kaiser::kaiser;
use super::resample::SAMPLES_PER_ORDER;
use rotordyn_linalg::dot::dot_in_sixteens;
use rotordyn_linalg::with_widest_vectors;

/// Kaiser window shape for −100 dB in the stop band.
const KAISER_BETA: f64 = 10.06;
/// Length of the filter on each side, in output intervals: its transition band is as wide as that between the highest
/// frequency passed unchanged and the lowest that folds onto it, Kaiser's Δf = (100 − 7.95)/(14.36 · 2L).
const HALF_LENGTH: f64 = (100.0 - 7.95) / (2.0 * 14.36 * (1.0 - 2.0 / SAMPLES_PER_ORDER));

/// Keeps every M-th frame of several channels, filtered without delay: y_i = Σ_k w_k x_{iM+k}, w a Kaiser-windowed sinc.
///
/// With the output rate f: frequencies up to f/2.56 pass within 1.5e-5 of their amplitude; those that would fold onto them, from
/// f (1 − 1/2.56) on, are suppressed by 94 dB or more. Beyond its ends the record is continued by point reflection,
/// x_{−k} = 2 x₀ − x_k, so that a constant and a straight line pass and the first and last output are the first and last
/// frame. An output comes 14.7 M frames late; a factor of 1 passes every frame at once. Kaiser (1974).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decimator {
    factor: usize,
    /// L.
    half: usize,
    /// w_{−L} to w_L.
    weights: Vec<f64>,
    /// Frames of every channel from the index `first` on.
    values: Vec<Vec<f64>>,
    first: usize,
    /// Frames so far, and index of the next output.
    frames: usize,
    next: usize,
    /// Number of the last frames that are zero.
    zeros: usize,
}

impl Decimator {
    /// A filter for some channels with a factor M ≥ 1.
    pub fn new(channels: usize, factor: usize) -> Self {
        let factor = factor.max(1);
        let half = if factor == 1 { 0 } else { (HALF_LENGTH * factor as f64).ceil() as usize };
        let weight = |k: usize| {
            let from_middle = k as f64 - half as f64;
            let v = PI * from_middle / factor as f64;
            let sinc = if k == half { 1.0 } else { v.sin() / v };
            sinc * kaiser(KAISER_BETA, from_middle / (half as f64 + 1.0))
        };
        let mut weights: Vec<f64> = (0..=2 * half).map(weight).collect();
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|w| *w /= sum);
        Self {
            factor,
            half,
            weights,
            values: vec![Vec::new(); channels],
            first: 0,
            frames: 0,
            next: 0,
            zeros: 0,
        }
    }

    /// Takes the next frame, one value per channel.
    pub fn push(&mut self, frame: &[f64]) {
        for (values, value) in self.values.iter_mut().zip(frame) {
            values.push(*value);
        }
        self.frames += 1;
        self.zeros = 0;
    }

    /// Takes some frames of zeros; outputs of zeros alone cost nothing.
    pub fn push_zeros(&mut self, count: usize) {
        for values in &mut self.values {
            values.resize(values.len() + count, 0.0);
        }
        self.frames += count;
        self.zeros += count;
    }

    /// Whether the frames that the next output needs are there; `at_end`: no more frames come.
    pub fn has_next(&self, at_end: bool) -> bool {
        let centre = self.next * self.factor;
        let last_needed = if at_end { centre } else { centre + self.half };
        last_needed < self.frames
    }

    /// Appends the next output to `out`, if the frames it needs are there; whether it was. `at_end`: no more frames come.
    pub fn pop(&mut self, at_end: bool, out: &mut Vec<f64>) -> bool {
        if !self.has_next(at_end) {
            return false;
        }
        let centre = self.next * self.factor;
        let Self { half, weights, values, first, frames, zeros, .. } = &*self;
        let inside = centre >= *half && centre + half < *frames;
        let is_zero = inside && centre - half >= frames - zeros;
        if inside && !is_zero {
            let begin = centre - half - first;
            with_widest_vectors(
                #[inline(always)]
                || {
                    out.extend(values.iter().map(
                        #[inline(always)]
                        |values| dot_in_sixteens(weights, &values[begin..begin + weights.len()]),
                    ))
                },
            );
        } else if is_zero {
            out.extend(values.iter().map(|_| 0.0));
        } else {
            out.extend(values.iter().map(|values| -> f64 {
                let last = *frames as isize - 1;
                let at = |index: isize| values[index.clamp(*first as isize, last) as usize - first];
                let reflected = |index: isize| match index {
                    before if before < 0 => 2.0 * at(0) - at(-before),
                    after if after > last => 2.0 * at(last) - at(2 * last - after),
                    inside => at(inside),
                };
                let from = centre as isize - *half as isize;
                weights.iter().zip(from..).map(|(w, index)| w * reflected(index)).sum()
            }));
        }
        self.next += 1;
        self.drop_frames();
        true
    }

    /// Forgets frames that no output needs any more, many at a time.
    fn drop_frames(&mut self) {
        let needed = (self.next * self.factor).saturating_sub(self.half).min(self.frames);
        let unneeded = needed - self.first;
        // Outputs within half a filter of the start need the first frames.
        if self.next * self.factor >= self.half && unneeded >= 3 * self.weights.len() {
            self.values.iter_mut().for_each(|values| drop(values.drain(..unneeded)));
            self.first = needed;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Every output of a record.
    fn decimated(record: &[f64], factor: usize) -> Vec<f64> {
        let mut filter = Decimator::new(1, factor);
        let mut out = Vec::new();
        for value in record {
            filter.push(&[*value]);
            while filter.pop(false, &mut out) {}
        }
        while filter.pop(true, &mut out) {}
        out
    }

    #[test]
    fn passes_low_frequencies_and_suppresses_those_that_fold_onto_them() {
        for factor in [2, 3, 4, 7, 10] {
            let count = 400 * factor + 1;
            let wave = |per_output: f64| -> Vec<f64> {
                (0..count).map(|k| (TAU * per_output * k as f64 / factor as f64 + 0.3).cos()).collect()
            };
            for passed in [0.01, 0.2, 0.39] {
                let out = decimated(&wave(passed), factor);
                assert_eq!(out.len(), 401);
                for (i, y) in out.iter().enumerate().take(380).skip(20) {
                    let exact = (TAU * passed * i as f64 + 0.3).cos();
                    assert!((y - exact).abs() < 1.5e-5, "{factor}, {passed}: {y} for {exact}");
                }
            }
            for folded in [0.61, 0.99, 0.3 * factor as f64 + 0.4] {
                let out = decimated(&wave(folded), factor);
                let largest = out[20..380].iter().fold(0.0, |most: f64, y| most.max(y.abs()));
                assert!(largest < 2e-5, "{factor}, {folded}: {largest}");
            }
        }
    }

    #[test]
    fn straight_lines_and_the_ends_pass() {
        let line: Vec<f64> = (0..500).map(|k| 3.0 - 0.25 * f64::from(k)).collect();
        for (i, y) in decimated(&line, 4).iter().enumerate() {
            assert!((y - line[4 * i]).abs() < 1e-11, "{i}: {y}");
        }
        let noise: Vec<f64> = (0..201).map(|k| (f64::from(k * k) * 1.7).sin()).collect();
        let out = decimated(&noise, 4);
        assert!((out[0] - noise[0]).abs() < 1e-13 && (out[50] - noise[200]).abs() < 1e-13);
        assert_eq!(decimated(&noise, 1), noise);
        assert!((decimated(&[5.0], 3)[0] - 5.0).abs() < 1e-14);
    }

    #[test]
    fn zeros_at_once_are_zeros_one_by_one() {
        let burst = |k: usize| if k % 700 < 40 { (k as f64 * 0.9).sin() } else { 0.0 };
        let record: Vec<f64> = (0..3001).map(burst).collect();
        let exact = decimated(&record, 6);
        let (mut filter, mut out) = (Decimator::new(1, 6), Vec::new());
        for block in record.chunks(10) {
            if block.iter().all(|value| *value == 0.0) {
                filter.push_zeros(block.len());
            } else {
                block.iter().for_each(|value| filter.push(&[*value]));
            }
            while filter.pop(false, &mut out) {}
        }
        while filter.pop(true, &mut out) {}
        assert_eq!(out, exact);
        assert!(out.iter().any(|value| *value != 0.0));
    }

    #[test]
    fn goes_on_from_a_copy_of_its_state() {
        let noise: Vec<f64> = (0..3000).map(|k| (f64::from(k * k % 977) * 0.37).sin()).collect();
        let whole = decimated(&noise, 5);
        let (mut filter, mut out) = (Decimator::new(1, 5), Vec::new());
        for (k, value) in noise.iter().enumerate() {
            if k % 611 == 0 {
                let stored = serde_json::to_string(&filter).unwrap();
                filter = serde_json::from_str(&stored).unwrap();
            }
            filter.push(&[*value]);
            while filter.pop(false, &mut out) {}
        }
        while filter.pop(true, &mut out) {}
        assert_eq!(out, whole);
    }
}
