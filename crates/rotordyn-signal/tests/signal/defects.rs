//! Detection of race defects in simulated records, without prior knowledge of their places.
//!
//! Reference values A..: independent implementation of Atef et al. 2022 (same law, same parameters).

use rotordyn_signal::jerk::{impulses, jerk_jumps};
use rotordyn_signal::race_defects::{BallPassage, DefectKind, RaceDefect, race_defects};
use rotordyn_signal::statistics::statistics;

use crate::assert_close;
use crate::dented_bearing::{BALLS, Defect, Race, Records, SHAFT, STEP, simulate};

const RATE: f64 = 1.0 / STEP;

fn passage(race: Race, records: &Records) -> BallPassage {
    let race_speed = if race == Race::Inner { SHAFT } else { 0.0 };
    BallPassage { frequency: race.passing_frequency(), balls: BALLS, race_speed, datum: -records.start }
}

fn found(race: Race, records: &Records) -> Vec<RaceDefect> {
    let [x, y] = &records.ring;
    race_defects(x, Some(y), RATE, &passage(race, records)).unwrap()
}

#[track_caller]
fn assert_found(race: Race, found: &[RaceDefect], expected: &[Defect]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (got, defect) in found.iter().zip(expected) {
        assert_close("angle", got.angle.to_degrees(), defect.angle_deg, 0.05);
        // 6 us at the contact's speed of 1.76067 m/s.
        assert_close("width", got.width * race.radius(), defect.width, 0.011e-3);
        assert_eq!(got.kind == DefectKind::Bump, defect.height > 0.0, "{got:?}");
    }
}

/// A18: statistics of the simulated records equal the reference.
#[test]
fn simulated_rig_gives_the_reference_statistics() {
    let records =
        simulate(Race::Outer, &[Defect::dent(0.0, 0.17e-3), Defect::dent(15.0, 0.17e-3)], STEP, 1.0);
    let got = statistics(&records.resonator).unwrap();
    assert_close("rms", got.rms, 0.59765, 1e-4);
    assert_close("kurtosis", got.kurtosis.unwrap(), 6.06809, 1e-3);
    assert_close("peak", got.peak, 2.59477, 1e-3);
    assert_close("ring rms", statistics(&records.ring[0]).unwrap().rms, 0.192780, 1e-5);
}

/// A32: angle within 0.05 deg, width within one step, all 7 kinds correct.
#[test]
fn seven_random_defects() {
    let defects = [
        Defect::dent(2.0, 0.12e-3),
        Defect::bump(6.3, 0.2e-3, 0.25e-6),
        Defect::dent(9.1, 0.1e-3),
        Defect::bump(15.8, 0.3e-3, 0.4e-6),
        Defect::dent(21.4, 0.17e-3),
        Defect::bump(27.9, 0.22e-3, 0.15e-6),
        Defect::dent(33.6, 0.15e-3),
    ];
    let records = simulate(Race::Outer, &defects, STEP, 0.3);
    assert_found(Race::Outer, &found(Race::Outer, &records), &defects);
    // One channel along the load gives the same, up to the ball spacing.
    let one = race_defects(&records.ring[0], None, RATE, &passage(Race::Outer, &records)).unwrap();
    assert_found(Race::Outer, &one, &defects);
}

/// A31: N alternating bumps and dents 5 deg apart give 2N jumps per ball passage, also opposite the load.
#[test]
fn four_six_and_eight_defects() {
    for count in [4, 6, 8] {
        let defect = |k: usize| {
            let angle = 180.0 + 5.0 * k as f64;
            if k.is_multiple_of(2) {
                Defect::bump(angle, 0.17e-3, 0.1e-6)
            } else {
                Defect::dent(angle, 0.17e-3)
            }
        };
        let defects: Vec<Defect> = (0..count).map(defect).collect();
        let records = simulate(Race::Outer, &defects, STEP, 0.3);
        let got = found(Race::Outer, &records);
        assert_found(Race::Outer, &got, &defects);
        for d in &got {
            let sign = if d.kind == DefectKind::Bump { 1.0 } else { -1.0 };
            assert!(d.jumps.iter().all(|j| j * sign > 0.0), "{d:?}");
        }
    }
}

#[test]
fn dent_and_bump_of_the_rotating_inner_race() {
    let defects = [Defect::dent(270.0, 0.17e-3), Defect::bump(285.0, 0.2e-3, 0.3e-6)];
    let records = simulate(Race::Inner, &defects, STEP, 0.5);
    assert_found(Race::Inner, &found(Race::Inner, &records), &defects);
}

/// A12: entry-to-entry angle of eq. 22 within 0.03 deg, from close defects to nearly a ball spacing.
#[test]
fn angle_between_two_defects() {
    for beta in [1.0, 2.6, 5.0, 10.0, 20.0, 30.0, 38.2] {
        let defects = [Defect::bump(0.0, 0.17e-3, 0.1e-6), Defect::dent(beta, 0.17e-3)];
        let records = simulate(Race::Outer, &defects, STEP, 0.2);
        let got = found(Race::Outer, &records);
        // A start angle of 0 may be estimated just below 360 deg.
        assert_eq!(got.len(), 2, "{beta}: {got:?}");
        let dent = got.iter().find(|d| d.kind == DefectKind::Dent).unwrap();
        let bump = got.iter().find(|d| d.kind == DefectKind::Bump).unwrap();
        let between = (dent.angle - bump.angle).to_degrees().rem_euclid(360.0);
        assert_close("angle between", between, beta, 0.03);
    }
}

/// A10: jumps 97.1 ± 2 us apart at steps of 6 us, 96.57 ± 0.6 us at 1 us; the true residence time is 96.554 us.
#[test]
fn residence_time_over_a_dent() {
    let dents = [Defect::dent(0.0, 0.17e-3), Defect::dent(15.0, 0.17e-3)];
    for (step, seconds, expected, tolerance) in [(STEP, 0.2, 97.1, 2.0), (1e-6, 0.05, 96.57, 0.6)] {
        let records = simulate(Race::Outer, &dents, step, seconds);
        let jumps = jerk_jumps(&records.ring[0], 1.0 / step, 8.0).unwrap();
        let gaps: Vec<f64> =
            jumps.windows(2).map(|w| (w[1].time - w[0].time) * 1e6).filter(|gap| *gap < 200.0).collect();
        let mean = gaps.iter().sum::<f64>() / gaps.len() as f64;
        assert!(gaps.len() as f64 >= 1.8 * seconds * Race::Outer.passing_frequency(), "{}", gaps.len());
        assert_close("mean gap", mean, expected, tolerance);
        assert!(jumps.iter().all(|j| j.size < 0.0), "jerk jumps of a dent are negative");
    }
}

/// Mean number of impulses in windows of 0.1 s.
fn per_window(times: &[f64], seconds: f64) -> f64 {
    times.len() as f64 * 0.1 / seconds
}

/// A08, A09, A03, A04: impulses in 0.1 s and the delays between those of a pair.
#[test]
fn impulse_counts_and_delays() {
    for (race, angles, count, short, long) in [
        (Race::Outer, [0.0, 15.0], 21.473, 3.49279e-3, 5.82132e-3),
        (Race::Inner, [270.0, 285.0], 32.437, 2.31216e-3, 3.8536e-3),
    ] {
        let defects = angles.map(|a| Defect::dent(a, 0.17e-3));
        let records = simulate(race, &defects, STEP, 1.0);
        let [x, y] = &records.ring;
        let times = impulses(&[x, y], RATE, 30e-6, 1.2e-3, 0.25).unwrap();
        assert_close("impulses in 0.1 s", per_window(&times, 1.0), count, 0.1);
        let gaps: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
        for (name, expected) in [("short", short), ("long", long)] {
            let near: Vec<&f64> = gaps.iter().filter(|g| (**g - expected).abs() < 0.5e-3).collect();
            let mean = near.iter().copied().sum::<f64>() / near.len() as f64;
            assert!(near.len() + 2 >= times.len() / 2, "{name}: {} of {}", near.len(), times.len());
            assert_close(name, mean, expected, 0.012e-3);
        }
    }
}

#[test]
fn healthy_bearing_has_no_defects() {
    let records = simulate(Race::Outer, &[], STEP, 0.3);
    let got = found(Race::Outer, &records);
    assert!(got.is_empty(), "{got:?}");
}
