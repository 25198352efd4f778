//! Wheels with teeth left out and with uneven marks.

use rotordyn_signal::tacho::PulseTrain;
use rotordyn_signal::tacho::marks::{MarkKind, marks_per_turn};
use rotordyn_signal::tacho_jitter::Jitter;

use crate::noise;

/// Times of the marks at `places` \[turns\] of a shaft from 10 rev/s on at 2 rev/s², with jitter of `jitter` turns.
fn marks(places: &[f64], turns: usize, jitter: f64) -> (Vec<f64>, Vec<f64>) {
    let rough = noise(11, turns * places.len());
    let angles: Vec<f64> =
        (0..turns).flat_map(|turn| places.iter().map(move |place| turn as f64 + place)).collect();
    let time = |turns: f64| 2.0 * turns / (10.0 + (100.0 + 4.0 * turns).sqrt());
    let times = angles.iter().zip(&rough).map(|(a, r)| time(a + jitter * r)).collect();
    (times, angles)
}

fn without(values: &[f64], left_out: &[usize]) -> Vec<f64> {
    (0..values.len()).filter(|k| !left_out.contains(k)).map(|k| values[k]).collect()
}

fn worst(train: &PulseTrain, angles: &[f64]) -> f64 {
    assert_eq!(train.times.len(), angles.len());
    let off = train.revolutions.iter().zip(angles).map(|(r, a)| (r - (a - angles[0])).abs());
    off.fold(0.0, f64::max)
}

/// 60-2, 36-1, 12-1, 4-1 and 36-2-2-2, by the number of pitches and by that of teeth, from any tooth on, with pulses lost and
/// false ones beside: every turn is counted, and the teeth left out are no missing pulses.
#[test]
fn teeth_left_out_are_no_missing_pulses() {
    let wheels: [(usize, &[usize]); 5] =
        [(60, &[58, 59]), (36, &[35]), (12, &[11]), (4, &[3]), (36, &[10, 11, 16, 17, 34, 35])];
    for (pitches, left_out) in wheels {
        let teeth: Vec<f64> = (0..pitches)
            .filter(|tooth| !left_out.contains(tooth))
            .map(|tooth| tooth as f64 / pitches as f64)
            .collect();
        let (times, angles) = marks(&teeth, 60, 0.02 / pitches as f64);
        let expected = MarkKind::TeethLeftOut { pitches, missing: left_out.len() };
        for stated in [pitches, teeth.len()] {
            for from in [0, teeth.len() / 2] {
                let train = PulseTrain::new(&times[from..], stated).unwrap();
                assert_eq!(
                    train.marks.as_ref().map(|marks| marks.kind),
                    Some(expected),
                    "{pitches} {stated}"
                );
                assert_eq!((train.missing, train.dropped), (0, 0), "{pitches} {stated}");
                assert!(worst(&train, &angles[from..]) < 1e-9, "{pitches} {stated}");
            }
            let lost: &[usize] = if pitches > 4 { &[200, 333, 334] } else { &[100] };
            let (some, of) = (without(&times, lost), without(&angles, lost));
            let train = PulseTrain::new(&some, stated).unwrap();
            assert_eq!((train.missing, train.dropped), (lost.len(), 0), "{pitches} {stated}");
            assert!(worst(&train, &of) < 1e-9, "{pitches} {stated}");
            let mut more = times.clone();
            more.insert(151, 0.6 * times[150] + 0.4 * times[151]);
            let train = PulseTrain::new(&more, stated).unwrap();
            assert_eq!((train.missing, train.dropped), (0, 1), "{pitches} {stated}");
            assert!(worst(&train, &angles) < 1e-9, "{pitches} {stated}");
        }
    }
}

/// A wheel of 60 pitches sampled so coarsely that its pulses are four or five samples apart, on a run-up.
#[test]
fn teeth_left_out_of_coarsely_sampled_pulses() {
    let teeth: Vec<f64> = (0..58).map(|tooth| f64::from(tooth) / 60.0).collect();
    let (times, angles) = marks(&teeth, 500, 0.0);
    let rate = 60.0 * 4.3 * 46.0;
    let rounded: Vec<f64> = times.iter().map(|t| (t * rate).ceil() / rate).collect();
    for stated in [58, 60] {
        let train = PulseTrain::new(&rounded, stated).unwrap();
        assert_eq!((train.missing, train.dropped), (0, 0), "{stated}");
        assert!(worst(&train, &angles) < 1e-9, "{stated}");
    }
}

/// Uneven marks are put where they are: what is left is the jitter. The jitter is not taken for more by them.
#[test]
fn uneven_marks_are_corrected() {
    for places in [&[0.0, 0.26, 0.49, 0.755][..], &[0.0, 0.45], &[0.0, 0.2], &[0.0, 0.35, 0.7]] {
        let (times, angles) = marks(places, 80, 0.001);
        let count = places.len();
        let train = PulseTrain::new(&times, count).unwrap();
        let kind = train.marks.as_ref().map(|marks| marks.kind);
        assert!(matches!(kind, Some(MarkKind::Uneven { .. })), "{places:?}: {kind:?}");
        assert_eq!((train.missing, train.dropped), (0, 0), "{places:?}");
        assert!(worst(&train, &angles) < 0.0015, "{places:?}: {}", worst(&train, &angles));
        let (even, _) = marks(&(0..count).map(|k| k as f64 / count as f64).collect::<Vec<_>>(), 80, 0.001);
        let jitter = |train: &PulseTrain| Jitter::of_pulses(train).unwrap().angle;
        let [found, alone] = [&train, &PulseTrain::new(&even, count).unwrap()].map(jitter);
        assert!(found < 1.3 * alone && found > 0.7 * alone, "{places:?}: {found} {alone}");
        // A pulse lost turns the marks behind it by one.
        let lost = [61];
        let train = PulseTrain::new(&without(&times, &lost), count).unwrap();
        assert_eq!((train.missing, train.dropped), (1, 0), "{places:?}");
        assert!(worst(&train, &without(&angles, &lost)) < 0.0015, "{places:?}");
    }
}

/// Even marks with jitter, a start from rest, a wheel on a shaft that swings within its turns: nothing is corrected.
#[test]
fn even_marks_stay() {
    for seed in 1..=20 {
        let rough = noise(seed, 400);
        for (count, spread) in [(2, 0.02), (2, 0.1), (4, 0.1), (20, 0.1), (60, 0.2)] {
            let times: Vec<f64> =
                (0..400).map(|k| (k as f64 + spread * rough[k]) / (20 * count) as f64).collect();
            let train = PulseTrain::new(&times, count).unwrap();
            assert_eq!(train.marks, None, "{count} {spread} {seed}");
            assert_eq!(marks_per_turn(&times), None);
        }
    }
    for count in [1, 2, 4, 16] {
        let rest: Vec<f64> = (1..600).map(|k| (k as f64 / count as f64).sqrt()).collect();
        assert_eq!(PulseTrain::new(&rest, count).unwrap().marks, None, "{count}");
        assert_eq!(marks_per_turn(&rest), None);
    }
    // 2x swings by 2 deg, as of a joint.
    let swing = |k: usize| {
        let turns = k as f64 / 32.0;
        (turns + 2.0 / 360.0 * (2.0 * std::f64::consts::TAU * turns).sin()) / 25.0
    };
    let times: Vec<f64> = (0..3200).map(swing).collect();
    assert_eq!(PulseTrain::new(&times, 32).unwrap().marks, None);
}

/// Two and three marks a turn where one is stated.
#[test]
fn more_than_one_mark_a_turn_is_told() {
    for (places, count) in [(&[0.0, 0.45][..], 2), (&[0.0, 0.15], 2), (&[0.0, 0.3, 0.7], 3)] {
        let (times, _) = marks(places, 60, 0.003);
        assert_eq!(marks_per_turn(&times), Some(count));
    }
    let (times, _) = marks(&[0.0], 120, 0.02);
    assert_eq!(marks_per_turn(&times), None);
}
