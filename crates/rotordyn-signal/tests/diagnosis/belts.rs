//! Belts and other drives whose rate is near FTF, but farther off than the cage slips.

use rayon::prelude::*;
use rotordyn_signal::bearing_lines::{BearingPart, LineSettings};
use rotordyn_signal::grading::GradedDiagnosis;

use super::RATE;
use super::bearing_6309::{self, RATES, SHAFT};
use super::clock::Clock;
use super::path::{TransferPath, arrivals, scaled_to, sum, tones, white};
use super::random::Random;

/// Impacts at each passage of a belt, its first four harmonics as lines of an amplitude, the shaft's, and noise.
fn belt(number: usize, rate: f64, tone: f64) -> Vec<f64> {
    let random = &mut Random::of_record(401, number);
    let path = TransferPath::draw(random);
    let passages: Vec<_> =
        arrivals(random, rate, 0.002).into_iter().map(|time| (time, 1.0 + 0.2 * random.normal())).collect();
    let impacts = scaled_to(path.impacts(&passages, &Clock::STEADY), 0.1);
    let mut lines: Vec<_> = (1..=4).map(|n| (f64::from(n) * rate, tone, random.phase())).collect();
    lines.extend([(SHAFT, 1.0, 0.0), (2.0 * SHAFT, 0.4, 1.0), (3.0 * SHAFT, 0.2, 0.0)]);
    sum(&sum(&impacts, &tones(&lines), 1.0), &white(random), 0.3)
}

fn graded(record: &[f64], slip: f64) -> GradedDiagnosis {
    bearing_6309::graded(record, RATE, &LineSettings { slip, ..LineSettings::default() })
}

/// 2.6 to 4 % beside FTF, either way, which slip does not explain: of 24 none is named a cage, at most one a ball, whose 2 BSF
/// is 10.3 FTF.
#[test]
fn belts_beside_the_cage_are_no_cage() {
    let of = |number: usize| {
        let random = &mut Random::of_record(402, number);
        let rate = RATES.cage * (1.0 + random.sign() * random.range(0.026, 0.04));
        (rate / RATES.cage - 1.0, graded(&belt(number, rate, 0.3), 0.02))
    };
    let found: Vec<_> = (0..24usize).into_par_iter().map(of).collect();
    let named: Vec<_> =
        found.iter().filter_map(|(off, g)| Some((off, g.part()?, g.statement("Hz")))).collect();
    assert!(named.len() <= 1 && named.iter().all(|(_, part, _)| *part != BearingPart::Cage), "{named:?}");
}

/// What a cage may slip is what is given: 1.7 % off is a cage for a slip of 2 %, none for one of 0.5 %.
#[test]
fn slip_given_is_slip_allowed() {
    for number in 0..4 {
        let record = belt(100 + number, 0.983 * RATES.cage, 0.0);
        assert_eq!(graded(&record, 0.02).part(), Some(BearingPart::Cage), "{number}");
        let strict = graded(&record, 0.005);
        assert_eq!(strict.part(), None, "{number}: {strict:?}");
    }
}
