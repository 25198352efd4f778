//! Which pulses of a tacho are kept, and how many pitches of the pulse wheel each interval holds.

use crate::statistics::median;

/// Most pitches that are tried for every interval, and most pulses dropped in a row.
pub(super) const MOST_PITCHES: usize = 6;
pub(super) const MOST_DROPPED: usize = 2;
/// Cost of n pitches in one interval over ln n, where the one before holds another number or has another speed: a gap within a run saves 2 ln n, a start from rest would save ln n.
pub(super) const MISSING_COST: f64 = 1.3;
/// |ln v/v'| of intervals of one speed.
pub(super) const SAME_SPEED: f64 = 0.1;
/// Cost of dropping a pulse: one in the middle of an interval saves 2 ln 2.
pub(super) const DROPPED_COST: f64 = 1.0;

/// Intervals on either side of a gap that give the speed there.
const AROUND_A_GAP: usize = 8;
/// Intervals next to it from which an interval may be a gap.
const LONG: f64 = 3.0;
/// Most pitches in a gap.
const LONGEST_GAP: f64 = 1e6;

/// How an interval ends at a pulse: how many pulses back it began, and how many pitches it holds.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Interval {
    back: usize,
    count: usize,
}

/// Speed of the last intervals before pulse `k` \[pitches/s\] (`forward`: of the first behind it) and its change \[1/s²\]; medians.
fn speed_at(times: &[f64], k: usize, forward: bool) -> Option<[f64; 2]> {
    let range = if forward {
        k..times.len().min(k + AROUND_A_GAP + 1)
    } else {
        k.saturating_sub(AROUND_A_GAP)..k + 1
    };
    let times = &times[range];
    if times.len() < 4 {
        return None;
    }
    let speeds: Vec<[f64; 2]> =
        times.windows(2).map(|w| [0.5 * (w[0] + w[1]), 1.0 / (w[1] - w[0])]).collect();
    let half = speeds.len() / 2;
    let slopes = speeds.iter().zip(&speeds[half..]).map(|(a, b)| (b[1] - a[1]) / (b[0] - a[0])).collect();
    Some([median(speeds.iter().map(|s| s[1]).collect()), median(slopes)])
}

/// Pitches of a long gap from pulse `a` to pulse `b` by the mean of the speeds on both sides; none where the shaft may have stood.
fn pitches_of_gap(times: &[f64], a: usize, b: usize) -> Option<usize> {
    let gap = times[b] - times[a];
    // Most intervals are no longer than those around them.
    let interval = |k: usize| times.get(k + 1).map(|next| next - times[k]);
    let around = [a.checked_sub(1).and_then(interval), interval(b)];
    if around.into_iter().flatten().all(|near| gap < LONG * near) {
        return None;
    }
    let sides: Vec<[f64; 2]> =
        [speed_at(times, a, false), speed_at(times, b, true)].into_iter().flatten().collect();
    let long = sides.iter().any(|[speed, _]| gap * speed > MOST_PITCHES as f64 - 0.5);
    let may_stand = sides.iter().any(|[speed, change]| change.abs() * gap > *speed);
    if sides.is_empty() || !long || may_stand {
        return None;
    }
    let mean = sides.iter().map(|[speed, _]| speed).sum::<f64>() / sides.len() as f64;
    let count = (gap * mean).round();
    (count > MOST_PITCHES as f64 && count < LONGEST_GAP).then_some(count as usize)
}

/// The intervals that may end at a pulse.
fn intervals(times: &[f64], pulse: usize) -> Vec<Interval> {
    let mut all = Vec::new();
    for back in (1..=MOST_DROPPED + 1).filter(|back| *back <= pulse) {
        let gap = pitches_of_gap(times, pulse - back, pulse);
        all.extend((1..=MOST_PITCHES).chain(gap).map(|count| Interval { back, count }));
    }
    all
}

/// Cost of the repairs of an interval behind another one, whose speed changes by `change` = |ln v/v'| to it.
fn repair(own: Interval, before: Option<Interval>, change: f64) -> f64 {
    let goes_on = change < SAME_SPEED && before.is_some_and(|before| before.count == own.count);
    let missing = if goes_on { 0.0 } else { MISSING_COST * (own.count as f64).ln() };
    missing + DROPPED_COST * (own.back - 1) as f64
}

/// The cheapest path to an interval, and the interval of the pulse before.
#[derive(Clone, Copy)]
struct Path {
    cost: f64,
    before: Option<usize>,
}

/// Pulses kept and the pitches between them: the cheapest path through intervals (Viterbi).
pub(super) fn best_counts(times: &[f64]) -> (Vec<usize>, Vec<usize>) {
    let speed = |pulse: usize, own: Interval| own.count as f64 / (times[pulse] - times[pulse - own.back]);
    let states: Vec<Vec<Interval>> = (0..times.len()).map(|pulse| intervals(times, pulse)).collect();
    let mut best: Vec<Vec<Path>> = Vec::with_capacity(times.len());
    for (pulse, row) in states.iter().enumerate() {
        let path = |own: &Interval| {
            let first = pulse - own.back;
            // A path may drop the first pulses.
            let start = repair(*own, None, 0.0) + DROPPED_COST * first as f64;
            let cost = if first <= MOST_DROPPED { start } else { f64::INFINITY };
            let mut path = Path { cost, before: None };
            let now = speed(pulse, *own);
            for (index, (previous, so_far)) in states[first].iter().zip(&best[first]).enumerate() {
                let change = (now / speed(first, *previous)).ln().abs();
                let cost = so_far.cost + change + repair(*own, Some(*previous), change);
                if cost < path.cost {
                    path = Path { cost, before: Some(index) };
                }
            }
            path
        };
        let row = row.iter().map(path).collect();
        best.push(row);
    }
    // The last pulses may be dropped too.
    let ends = (0..=MOST_DROPPED).filter_map(|dropped| {
        let pulse = times.len().checked_sub(1 + dropped)?;
        let (state, path) = best[pulse].iter().enumerate().min_by(|a, b| a.1.cost.total_cmp(&b.1.cost))?;
        Some((path.cost + DROPPED_COST * dropped as f64, pulse, state))
    });
    let (_, mut pulse, state) = ends
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .expect("there is a last pulse, with intervals that end there");
    let (mut kept, mut counts) = (vec![pulse], Vec::new());
    let mut next = Some(state);
    while let Some(state) = next {
        let own = states[pulse][state];
        next = best[pulse][state].before;
        pulse -= own.back;
        kept.push(pulse);
        counts.push(own.count);
    }
    kept.reverse();
    counts.reverse();
    (kept, counts)
}
