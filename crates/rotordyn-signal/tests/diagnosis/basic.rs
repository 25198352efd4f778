//! Faults at −10 dB under plain conditions: 5 s, nothing beside a fault but noise and shaft lines.

use rayon::prelude::*;
use rotordyn_signal::bearing_lines::BearingPart;
use rotordyn_signal::diagnosis::BandRule;

use super::baseline::THRESHOLD;
use super::calibration::Outcome;
use super::generator::Generated;

/// Seed and number of the faults.
const SEED: u64 = 4711;
const FAULTS: usize = 1600;
/// Power of the fault over all else \[dB\].
const SNR: f64 = -10.0;

/// Shares of the documented table less two standard deviations of 400 records: named, and at 95 %, in percent.
#[test]
#[ignore = "hundreds of records: minutes in a development build"]
fn faults_at_minus_ten_decibel() {
    let of = |n: usize| Outcome::of(&Generated::basic(SEED, 2 * n, SNR), BandRule::Lines);
    let faults: Vec<Outcome> = (0..FAULTS).into_par_iter().map(of).collect();
    if let Some(path) = std::env::var_os("ROTORDYN_FEATURES") {
        std::fs::write(path, faults.iter().map(|o| format!("basic,{}", o.csv_line())).collect::<String>())
            .unwrap();
    }
    for (part, least_named, least_sure) in [
        (BearingPart::OuterRace, 94.0, 83.0),
        (BearingPart::InnerRace, 92.5, 86.0),
        (BearingPart::Ball, 88.0, 83.0),
        (BearingPart::Cage, 97.0, 80.5),
    ] {
        let own = faults.iter().filter(|o| o.part == Some(part));
        let share = |found: &dyn Fn(&Outcome) -> bool| {
            100.0 * own.clone().filter(|o| found(o)).count() as f64 / own.clone().count() as f64
        };
        let named = share(&|o| o.is_right() && o.probability >= 0.5);
        let sure = share(&|o| o.is_right() && o.probability >= 0.95);
        let plain = share(&|o| Some(o.plain.0) == o.part && o.plain.1 > THRESHOLD);
        println!("{}: {named:.1} % named, {sure:.1} % at 95 %, plain {plain:.1} %", part.name());
        assert!(named >= least_named && sure >= least_sure, "{}: {named} {sure}", part.name());
    }
}
