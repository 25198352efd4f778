//! Which pulses of a wheel with marks that are not even are kept, and at which mark each comes.

use crate::statistics::median;

use super::counts::{DROPPED_COST, MISSING_COST, MOST_DROPPED, SAME_SPEED};
use super::marks::Marks;

/// Most marks from one pulse to the next that are tried for every interval: two missing in a row.
const MOST_MARKS: usize = 3;
/// Ways that are followed from pulse to pulse once the marks are told.
const WAYS: usize = 24;
/// Pulses of the beginning in which all are followed.
const ALL_WAYS: usize = 200;

/// How a way ends at a pulse: the pulses back and the marks of its last interval, the mark of the pulse.
#[derive(Clone, Copy)]
struct Way {
    mark: u32,
    marks: u32,
    back: u32,
    /// Place of the way before among those of its pulse.
    before: Option<u32>,
    /// ln of the speed of the last interval.
    speed: f64,
    cost: f64,
}

/// Pulses kept and the marks that each lies behind the first.
pub(super) struct MarkedPulses {
    pub kept: Vec<usize>,
    /// Mark of the first pulse kept.
    pub first_mark: usize,
    /// Marks from each to the next.
    pub counts: Vec<usize>,
}

/// Marks in an interval that is longer than `MOST_MARKS` of them by the revolutions before or behind it.
fn marks_of_gap(times: &[f64], from: usize, to: usize, marks: usize) -> Option<usize> {
    let gap = times[to] - times[from];
    let before = from.checked_sub(marks).map(|first| times[from] - times[first]);
    let behind = times.get(to + marks).map(|last| last - times[to]);
    let revolutions: Vec<f64> = before.into_iter().chain(behind).collect();
    let [least, most] = [f64::min, f64::max].map(|of| revolutions.iter().copied().reduce(of));
    // A shaft that stood between has revolutions of another length on either side, as one that starts.
    let count = (gap / median(revolutions) * marks as f64).round();
    (most? < 2.0 * least? && count > MOST_MARKS as f64 && count < 1e6).then_some(count as usize)
}

/// The cheapest way through the pulses, by the costs of [`super::counts::best_counts`]; `None` for fewer than two.
pub(super) fn marked_counts(times: &[f64], wheel: &Marks) -> Option<MarkedPulses> {
    let marks = wheel.pitches.len();
    let logarithms: Vec<Vec<f64>> = (1..=MOST_MARKS)
        .map(|count| (0..marks).map(|from| wheel.turns(from, count).ln()).collect())
        .collect();
    let mut ways: Vec<Vec<Way>> = Vec::with_capacity(times.len());
    for pulse in 0..times.len() {
        let mut row = Vec::new();
        for back in (1..=MOST_DROPPED + 1).filter(|back| *back <= pulse) {
            let from = pulse - back;
            let duration = (times[pulse] - times[from]).ln();
            let gap = marks_of_gap(times, from, pulse, marks);
            let near = gap.into_iter().flat_map(|count| (count - 1).max(MOST_MARKS + 1)..=count + 1);
            let dropped = DROPPED_COST * (back - 1) as f64;
            let mut starts: Vec<usize> = ways[from].iter().map(|way| way.mark as usize).collect();
            starts.dedup();
            // A way may begin here, with the first pulses dropped.
            let may_begin = from <= MOST_DROPPED;
            if may_begin {
                starts = (0..marks).collect();
            }
            for count in (1..=MOST_MARKS).chain(near) {
                let missing = MISSING_COST * (count as f64).ln();
                for &start in &starts {
                    let turns = logarithms
                        .get(count - 1)
                        .map_or_else(|| wheel.turns(start, count).ln(), |turns| turns[start]);
                    let speed = turns - duration;
                    let begun = missing + DROPPED_COST * from as f64;
                    let mut best = (if may_begin { begun } else { f64::INFINITY }, None);
                    let first = ways[from].partition_point(|way| (way.mark as usize) < start);
                    let same = ways[from][first..].iter().take_while(|way| way.mark as usize == start);
                    for (place, way) in same.enumerate() {
                        let change = (speed - way.speed).abs();
                        let goes_on = change < SAME_SPEED && way.marks as usize == count;
                        let cost = way.cost + change + if goes_on { 0.0 } else { missing };
                        if cost < best.0 {
                            best = (cost, Some((first + place) as u32));
                        }
                    }
                    let (cost, before) = best;
                    if cost.is_finite() {
                        row.push(Way {
                            mark: ((start + count) % marks) as u32,
                            marks: count as u32,
                            back: back as u32,
                            before,
                            speed,
                            cost: cost + dropped,
                        });
                    }
                }
            }
        }
        if pulse > ALL_WAYS.max(2 * marks) {
            row.sort_by(|a, b| a.cost.total_cmp(&b.cost));
            row.truncate(WAYS);
        }
        row.sort_by_key(|way| way.mark);
        ways.push(row);
    }
    let ends = (0..=MOST_DROPPED).filter_map(|dropped| {
        let pulse = times.len().checked_sub(1 + dropped)?;
        let (place, way) = ways[pulse].iter().enumerate().min_by(|a, b| a.1.cost.total_cmp(&b.1.cost))?;
        Some((way.cost + DROPPED_COST * dropped as f64, pulse, place))
    });
    let (_, mut pulse, place) = ends.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let mut found = MarkedPulses { kept: vec![pulse], first_mark: 0, counts: Vec::new() };
    let mut next = Some(place);
    while let Some(place) = next {
        let way = ways[pulse][place];
        let count = way.marks as usize;
        found.first_mark = (way.mark as usize + count * marks - count) % marks;
        next = way.before.map(|place| place as usize);
        pulse -= way.back as usize;
        found.kept.push(pulse);
        found.counts.push(count);
    }
    found.kept.reverse();
    found.counts.reverse();
    Some(found)
}
