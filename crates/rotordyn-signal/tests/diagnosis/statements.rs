//! What is said of single records: the words, the rivals, the lines left unexplained.

use rotordyn_signal::bearing_lines::{BearingPart, DefectFrequencies, LineSettings};
use rotordyn_signal::diagnosis::{BandRule, ShaftRotation, diagnose};
use rotordyn_signal::grading::{Explanation, Finding, GradedDiagnosis, RivalKind, StrongLine};

use super::RATE;
use super::clock::Clock;
use super::path::{TransferPath, arrivals, scaled_to, sum, tones, white};
use super::random::Random;

/// A 6205 at 30 rev/s: FTF 11.95, BPFO 107.5, BPFI 162.5, 2 BSF 141.4 Hz.
const RATES: DefectFrequencies =
    DefectFrequencies { shaft: 30.0, cage: 11.949, outer: 107.54, inner: 162.46, ball: 70.71 };

/// Impacts at times with strengths, at a power over white noise \[dB\].
fn record(seed: u64, snr: f64, rate: f64, jitter: f64, strength: impl Fn(f64) -> f64) -> Vec<f64> {
    let random = &mut Random::of_record(seed, 0);
    let path = TransferPath::draw(random);
    let impacts: Vec<_> = arrivals(random, rate, jitter).into_iter().map(|t| (t, strength(t))).collect();
    let impacts = scaled_to(path.impacts(&impacts, &Clock::STEADY), 10f64.powf(0.1 * snr));
    sum(&white(random), &impacts, 1.0)
}

fn graded(record: &[f64], rates: &DefectFrequencies) -> GradedDiagnosis {
    let settings = LineSettings::default();
    diagnose(record, RATE, ShaftRotation::ConstantSpeed, rates, BandRule::Lines, &settings).unwrap().graded
}

#[test]
fn damaged_race_is_named_with_its_probability() {
    let found = graded(&record(11, 0.0, 1.01 * RATES.outer, 0.005, |_| 1.0), &RATES);
    assert_eq!(found.part(), Some(BearingPart::OuterRace), "{found:?}");
    assert!(found.probability > 0.9, "{}", found.probability);
    let words = found.statement("Hz");
    assert!(words.starts_with("outer race, ") && words.ends_with(" %"), "{words}");
    // A bin and a half of the first harmonic: of limited evidence all trials on a strong line are alike.
    assert!((found.frequency / (1.01 * RATES.outer) - 1.0).abs() < 3e-3, "{}", found.frequency);
    let own =
        found.strong_lines.iter().filter(|l| l.explanation == Explanation::Bearing(BearingPart::OuterRace));
    assert!(own.count() >= 3, "{:?}", found.strong_lines);
}

/// Shaft modulation gives lines h BPFO + n f_r. BPFO of 3.597 f_r is so near 18/5 f_r that all of them are near
/// multiples of f_r/5, which is no other source: such a one would have lines at every multiple.
#[test]
fn side_bands_near_a_fraction_of_the_shaft_speed() {
    let rates = DefectFrequencies { outer: 3.585 * 30.0, cage: 3.585 * 30.0 / 9.0, ..RATES };
    let turn = std::f64::consts::TAU * rates.shaft;
    let misaligned = move |t: f64| 1.0 + 0.5 * (turn * t).cos() + 0.3 * (2.0 * turn * t).sin();
    // As good as without noise, as simulated, and with noise.
    for (seed, snr) in [(61, 70.0), (62, 40.0), (63, 10.0)] {
        let record = record(seed, snr, 3.597 * rates.shaft, 0.0, misaligned);
        for rule in [BandRule::Lines, BandRule::Whole, BandRule::Given(500.0, 5500.0)] {
            let settings = LineSettings::default();
            let found =
                diagnose(&record, RATE, ShaftRotation::ConstantSpeed, &rates, rule, &settings).unwrap();
            let graded = found.graded;
            assert_eq!(graded.part(), Some(BearingPart::OuterRace), "{snr} dB, {rule:?}: {graded:?}");
        }
    }
}

#[test]
fn foreign_impacts_are_no_line_of_the_bearing() {
    for (seed, rate) in [(21, 12.42), (22, 37.3), (23, 49.7)] {
        let found = graded(&record(seed, 5.0, rate, 0.0, |_| 1.0), &RATES);
        let Finding::Periodic(at) = found.finding else { panic!("{rate}: {found:?}") };
        // A tenth of a bin at the tenth harmonic.
        assert!((at / rate - 1.0).abs() < 2e-3, "{rate}: {at}");
        assert!(found.statement("Hz").ends_with(" Hz, no line of this bearing"));
        assert!(found.rivals.iter().any(|r| r.kind == RivalKind::Periodic && r.lines >= 3));
        let explained =
            found.strong_lines.iter().filter(|l| matches!(l.explanation, Explanation::Periodic(_)));
        assert!(2 * explained.count() > found.strong_lines.len(), "{:?}", found.strong_lines);
    }
}

/// Impacts every second and every third turn: lines at 5.5 and 16/3 times the shaft speed are in the window of BPFI (5.415), with
/// all that are side bands of an inner race. A damaged inner race at that very order has few lines far from its own.
#[test]
fn impacts_every_few_turns_are_no_inner_race() {
    for (seed, turns, jitter) in [(71, 2.0, 0.0), (72, 2.0, 0.0), (73, 2.0, 0.003), (74, 3.0, 0.0)] {
        let found = graded(&record(seed, 5.0, RATES.shaft / turns, jitter, |_| 1.0), &RATES);
        let Finding::Periodic(at) = found.finding else { panic!("{turns}: {found:?}") };
        assert!((at * turns / RATES.shaft - 1.0).abs() < 3e-3, "{turns}: {at}");
    }
    let turn = std::f64::consts::TAU * RATES.shaft;
    let in_load_zone = move |t: f64| (0.3 + 0.7 * (turn * t).cos()).max(0.0);
    for (seed, snr) in [(75, 0.0), (76, 10.0), (77, 40.0)] {
        let found = graded(&record(seed, snr, 5.5 * RATES.shaft, 0.0, in_load_zone), &RATES);
        assert_eq!(found.part(), Some(BearingPart::InnerRace), "{snr}: {found:?}");
    }
}

/// Twice 53.1 Hz lies in the search window of BPFO: the outer race is mentioned at most, not named.
#[test]
fn foreign_impacts_near_a_line_are_not_named() {
    let found = graded(&record(23, 5.0, 53.1, 0.0, |_| 1.0), &RATES);
    assert_eq!(found.part(), None, "{found:?}");
}

#[test]
fn noise_has_no_fault() {
    for seed in 0..4 {
        let found = graded(&white(&mut Random::of_record(31, seed)), &RATES);
        assert_eq!(found.statement("Hz"), "no bearing fault", "{found:?}");
    }
}

/// BPFO of this bearing is 3.0 orders: its impacts are those of a coupling with three jaws.
#[test]
fn line_on_a_shaft_order_cannot_be_told() {
    let rates = DefectFrequencies { outer: 90.3, inner: 149.7, cage: 11.287, ..RATES };
    let found = graded(&record(41, 3.0, 90.0, 0.0, |_| 1.0), &rates);
    let Finding::Unresolved { part, rival, .. } = found.finding else { panic!("{found:?}") };
    assert_eq!((part, rival.kind), (BearingPart::OuterRace, RivalKind::Shaft));
    assert!(found.probability < 0.5);
    assert_eq!(
        found.statement("Hz"),
        "cannot tell: the record does not resolve BPFO (90.00 Hz) from 3 x shaft speed (30.00 Hz)"
    );
}

/// BPFI of 6.996 orders with the load's modulation by the shaft: 5x to 9x and 13x to 15x.
#[test]
fn inner_race_on_a_shaft_order_cannot_be_told() {
    let rates = DefectFrequencies { outer: 4.004 * 30.0, inner: 6.996 * 30.0, cage: 0.364 * 30.0, ..RATES };
    let turn = std::f64::consts::TAU * rates.shaft;
    let zone = move |t: f64| (turn * t).cos().max(0.02);
    for seed in 43..47 {
        let found = graded(&record(seed, 5.0, 7.0 * rates.shaft, 0.0, zone), &rates);
        let words = found.statement("Hz");
        assert_eq!(
            words, "cannot tell: the record does not resolve BPFI (210.0 Hz) from 7 x shaft speed (30.00 Hz)",
            "{found:?}"
        );
    }
}

/// 2 BSF with side bands at FTF is a ball, though FTF be the highest line; FTF with many harmonics is a cage,
/// though the ninth be BPFO.
#[test]
fn ball_and_cage_are_told_apart() {
    let tau = std::f64::consts::TAU;
    let zone = move |t: f64| (1.0 + (tau * RATES.cage * t).cos()).powi(2);
    let found = graded(&record(51, 5.0, 2.0 * RATES.ball, 0.002, zone), &RATES);
    assert_eq!(found.part(), Some(BearingPart::Ball), "{found:?}");
    let found = graded(&record(52, 5.0, RATES.cage, 0.001, |_| 1.0), &RATES);
    assert_eq!(found.part(), Some(BearingPart::Cage), "{found:?}");
}

/// Damaged outer and inner race: the weaker is named as a further candidate and its lines are the bearing's. Of a single
/// fault nothing more is said.
#[test]
fn two_damaged_races_are_both_named() {
    let turn = std::f64::consts::TAU * RATES.shaft;
    let in_load_zone = move |t: f64| (0.3 + 0.7 * (turn * t).cos()).max(0.0);
    for seed in 81..85 {
        let outer = record(seed, 5.0, RATES.outer, 0.001, |_| 1.0);
        let inner = record(seed, 5.0, RATES.inner, 0.001, in_load_zone);
        let found = graded(&sum(&outer, &inner, 0.8), &RATES);
        let words = found.statement("Hz");
        let further: Vec<BearingPart> = found.part().into_iter().chain(found.further.clone()).collect();
        assert!(further.len() == 2 && words.contains("; further candidate: "), "{seed}: {words}");
        assert!(further.contains(&BearingPart::OuterRace) && further.contains(&BearingPart::InnerRace));
        let is_of_race = |l: &&StrongLine| {
            let inner =
                (1..=3).flat_map(|h| (-2..=2).map(move |m| f64::from(h) * RATES.inner + f64::from(m) * 30.0));
            inner
                .chain((1..=3).map(|h| f64::from(h) * RATES.outer))
                .any(|place| (l.frequency - place).abs() < 0.4)
        };
        let foreign =
            |l: &&StrongLine| matches!(l.explanation, Explanation::Periodic(_) | Explanation::Unexplained);
        let listed: Vec<_> = found.strong_lines.iter().filter(foreign).filter(is_of_race).collect();
        assert!(listed.is_empty(), "{seed}: {listed:?}");
        for single in [outer, inner] {
            let found = graded(&single, &RATES);
            assert!(found.part().is_some() && found.further.is_empty(), "{seed}: {}", found.statement("Hz"));
        }
    }
}

/// A smooth vibration at the ball passage, 40 dB over what repeats at it in any band: variable compliance may be its cause.
/// Not so where impacts are as strong as it.
#[test]
fn smooth_ball_passage_has_a_caveat() {
    for (seed, level, caveat) in [(91, 0.01, true), (92, 0.01, true), (93, 3.0, false), (94, 3.0, false)] {
        let random = &mut Random::of_record(seed, 0);
        let lines: Vec<_> = [(1, 0.3), (3, 0.5), (7, 1.0)]
            .map(|(n, amplitude)| (f64::from(n) * RATES.outer, amplitude, random.phase()))
            .into();
        let impacts = record(seed, 40.0, RATES.outer, 0.0, |_| 1.0);
        let impacts = scaled_to(impacts, level * level);
        let found = graded(&sum(&tones(&lines), &impacts, 1.0), &RATES);
        assert_eq!(found.part(), Some(BearingPart::OuterRace), "{seed}: {found:?}");
        assert_eq!(found.statement("Hz").contains("variable compliance"), caveat, "{seed}: {found:?}");
    }
}
