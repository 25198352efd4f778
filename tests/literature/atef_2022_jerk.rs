//! Atef et al. 2022: impulses, and jumps of the jerk as balls enter and leave defects, on the machine of
//! models/atef_2022.toml by the ids of tests/data/atef_2022.json.

use crate::agree;
use crate::atef_2022::{assert_within, reference};
use crate::atef_2022_records::{BPFI, BPFO, Records, TWO_DENTS, simulate};
use crate::ross::{number, numbers, read};
use rayon::prelude::*;
use rotordyn::signal::jerk::{impulses, jerk, jerk_jumps};
use rotordyn::signal::race_defects::{BallPassage, DefectKind, RaceDefect, fold_jerk, race_defects};

const SHAFT: f64 = 1797.0 / 60.0;
/// Radius of the outer raceway \[mm\].
const OUTER: f64 = 0.5 * (39.0398 + 7.94004);

fn passage(rate: f64, records: &Records) -> BallPassage {
    let race_speed = if rate == BPFI { SHAFT } else { 0.0 };
    BallPassage { frequency: rate, balls: 9, race_speed, datum: -records.start }
}

/// Defects detected on the outer race, given only the number of balls and the ball-pass frequency.
fn detected_defects(records: &Records) -> Vec<RaceDefect> {
    let [x, y] = &records.ring;
    race_defects(x, Some(y), records.rate, &passage(BPFO, records)).unwrap()
}

fn settings(angles: &[(f64, &str)]) -> String {
    let one = |(angle, rest): &(f64, &str)| {
        format!("{{ on = \"outer\", angle = \"{angle} deg\", width = \"0.17 mm\", {rest} }}")
    };
    format!("[{}]", angles.iter().map(one).collect::<Vec<_>>().join(", "))
}

const BUMP: &str = "kind = \"bump\", height = \"0.1 um\"";
const DENT: &str = "kind = \"dent\"";

/// A03, A04, A08, A09: impulses in any 0.1 s, and the delays between those of a pair.
#[test]
fn impulses_of_two_dents() {
    let inner = simulate("two_inner_dents", &[], 0.25, 1.0);
    for (records, count, delays) in [(&*TWO_DENTS, "A08", "A03"), (&inner, "A09", "A04")] {
        let [x, y] = &records.ring;
        let times = impulses(&[x, y], records.rate, 30e-6, 1.2e-3, 0.25).unwrap();
        // 100 windows, as many at one end of the record as at the other.
        let window = |k: usize| {
            let from = 0.9 * k as f64 / 99.0;
            times.iter().filter(|t| (from..from + 0.1).contains(*t)).count()
        };
        let counts: Vec<usize> = (0..100).map(window).collect();
        let mean = counts.iter().sum::<usize>() as f64 / 100.0;
        let expected = number(&reference(count));
        agree::absolute(format_args!("{count}: impulses in 0.1 s, mean"), mean, expected, 0.1);
        let whole = expected.floor() as usize;
        assert!(counts.iter().all(|n| *n == whole || *n == whole + 1), "{count}: {counts:?}");
        let gaps: Vec<f64> = times.windows(2).map(|w| 1e3 * (w[1] - w[0])).collect();
        for expected in numbers(&reference(delays)) {
            let near: Vec<f64> = gaps.iter().copied().filter(|g| (g - expected).abs() < 0.5).collect();
            let mean = near.iter().sum::<f64>() / near.len() as f64;
            assert!(near.len() + 2 >= times.len() / 2, "{delays}: {} of {}", near.len(), times.len());
            agree::absolute(format_args!("{delays}: delay, mean [ms]"), mean, expected, 0.012);
        }
    }
}

/// Residence time of a ball in a dent \[us\], at every passage.
fn residence_times(records: &Records) -> Vec<f64> {
    let jumps = jerk_jumps(&records.ring[0], records.rate, 8.0).unwrap();
    assert!(jumps.iter().all(|j| j.size < 0.0), "the jerk jumps of a dent are negative");
    jumps.windows(2).map(|w| (w[1].time - w[0].time) * 1e6).filter(|gap| *gap < 200.0).collect()
}

/// A10: 97 us between the two jumps of a dent, each time within 2.4 us at steps of 6 us.
#[test]
fn residence_over_a_dent() {
    let fine = [("study.run_up.step", "1 us"), ("study.run_up.sample_rate", "1000 kHz")];
    let fine = simulate("two_dents", &fine, 0.05, 0.05);
    let expected = numbers(&reference("A10"));
    for (records, expected, mean_within, each_within) in
        [(&*TWO_DENTS, expected[0], 2.0, 2.4), (&fine, expected[1], 0.6, 2.4)]
    {
        let got = residence_times(records);
        let seconds = records.ring[0].len() as f64 / records.rate;
        assert!(got.len() as f64 >= 1.8 * seconds * BPFO, "{} passages", got.len());
        let mean = got.iter().sum::<f64>() / got.len() as f64;
        agree::absolute("residence over a dent, mean [us]", mean, expected, mean_within);
        for one in &got {
            agree::absolute("residence over a dent, each passage [us]", *one, 97.0, each_within);
        }
    }
}

/// A11: extrema of the jerk under the force law H^1.5, which are not 97 us apart.
#[test]
fn extrema_of_the_jerk_under_the_force_law() {
    let fine = [("study.run_up.step", "1 us"), ("study.run_up.sample_rate", "1000 kHz")];
    let records = simulate("force", &fine, 0.2, 0.05);
    let jerk = jerk(&records.ring[0], records.rate).unwrap();
    // Entry and exit times of the balls are known, so that the extrema are searched over one dent alone.
    let cage = BPFO / 9.0;
    let width = 0.17 / OUTER / std::f64::consts::TAU;
    let mut spacings = Vec::new();
    for dent in [0.0, 15.0 / 360.0] {
        for pass in 0..9 * 20 {
            let entry = (pass as f64 / 9.0 + dent) / cage - records.start;
            let (from, to) = ((entry * records.rate).ceil(), ((entry + width / cage) * records.rate).floor());
            if from < 1.0 || to as usize + 1 >= jerk.len() {
                continue;
            }
            let over = &jerk[from as usize..=to as usize];
            let place = |best: fn(f64, f64) -> bool| {
                (0..over.len()).reduce(|a, b| if best(over[b], over[a]) { b } else { a }).unwrap() as f64
            };
            spacings.push((place(|a, b| a > b) - place(|a, b| a < b)).abs() / records.rate * 1e6);
        }
    }
    assert!(spacings.len() >= 9, "{}", spacings.len());
    let mean = spacings.iter().sum::<f64>() / spacings.len() as f64;
    let expected = number(&reference("A11"));
    agree::absolute("spacing of the extrema of jerk, mean [us]", mean, expected, 1.5);
}

/// A12: eq. 22 from entry to entry, from neighbours to nearly a ball spacing.
#[test]
fn angle_between_two_defects() {
    [0.9, 2.6, 3.139, 5.0, 10.0, 20.0, 30.0, 34.8, 38.2].into_par_iter().for_each(|beta| {
        let defects = settings(&[(0.0, BUMP), (beta, DENT)]);
        let records = simulate("bump_and_dent", &[("bearing.B.defect", &defects)], 0.15, 0.2);
        let got = detected_defects(&records);
        // A start at 0 may be detected slightly below it, near 360 deg.
        assert_eq!(got.len(), 2, "{beta}: {got:?}");
        let of = |kind| got.iter().find(|d| d.kind == kind).unwrap().angle;
        let between = (of(DefectKind::Dent) - of(DefectKind::Bump)).to_degrees().rem_euclid(360.0);
        agree::absolute("angle between two defects [deg]", between, beta, 0.03);
    });
}

/// A31: N alternating bumps and dents give 2N jerk jumps per passage, positive at a bump and negative at a
/// dent.
#[test]
fn four_six_and_eight_defects() {
    [("four_defects", 4), ("six_defects", 6), ("eight_defects", 8)].into_par_iter().for_each(
        |(variant, count)| {
            let records = simulate(variant, &[], 0.25, 0.3);
            let [x, y] = &records.ring;
            let fold = fold_jerk(x, Some(y), records.rate, &passage(BPFO, &records)).unwrap();
            assert_eq!(fold.jumps.len(), 2 * count, "{variant}");
            let got = detected_defects(&records);
            assert_eq!(got.len(), count, "{variant}: {got:?}");
            for (k, defect) in got.iter().enumerate() {
                let (kind, sign) =
                    if k % 2 == 0 { (DefectKind::Bump, 1.0) } else { (DefectKind::Dent, -1.0) };
                assert!(defect.kind == kind && defect.jumps.iter().all(|j| j * sign > 0.0), "{defect:?}");
                let at = 180.0 + 5.0 * k as f64;
                let what = format_args!("{variant}: angle of defect {k} [deg]");
                agree::absolute(what, defect.angle.to_degrees(), at, 0.05);
            }
        },
    );
}

/// A32: angle within 0.05 deg, width within one step of 6 us at the contact's 1.76067 m/s, all seven kinds.
#[test]
fn seven_random_defects() {
    let records = simulate("random_defects", &[], 0.25, 0.3);
    let got = detected_defects(&records);
    let rows = read("atef_2022.json")["random_defects"]["rows"].clone();
    let rows = rows.as_array().unwrap();
    assert_eq!(got.len(), rows.len(), "{got:?}");
    for (got, row) in got.iter().zip(rows) {
        let (angle, width) = (number(&row[0]), number(&row[1]));
        agree::absolute("angle of a random defect [deg]", got.angle.to_degrees(), angle, 0.05);
        agree::absolute("width of a random defect [mm]", got.width * OUTER, width, 0.011);
        assert_eq!(got.kind == DefectKind::Bump, row[2] == "bump", "{row}: {got:?}");
    }
}

#[test]
fn no_defects_detected_without_defects() {
    let got = detected_defects(&simulate("", &[], 0.25, 0.3));
    assert!(got.is_empty(), "{got:?}");
}

/// The contact point passes over both races at 1.76067 m/s.
#[test]
fn residence_is_the_same_on_both_races() {
    let speed = std::f64::consts::TAU * OUTER * 1e-3 * BPFO / 9.0;
    assert_within("residence", 0.17e-3 / speed * 1e6, number(&reference("A05")), 1e-4);
}
