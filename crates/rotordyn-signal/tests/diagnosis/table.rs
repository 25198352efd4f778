//! The table of the diagnoses.

use rotordyn_signal::bearing_lines::BearingPart;

use super::baseline::THRESHOLD;
use super::calibration::Outcome;
use super::others::Other;

fn percent(part: usize, of: usize) -> String {
    if of == 0 { "-".into() } else { format!("{:.1} % of {of}", 100.0 * part as f64 / of as f64) }
}

/// Operating points at which grade and plain level name as many healthy records of the calibration half.
pub struct EqualFalse {
    /// Probability at which as many are named as the plain way names at its threshold.
    probability: f64,
    /// Level at which the plain way names as many as are graded 95 % or above.
    level: f64,
}

impl EqualFalse {
    pub fn of(calibration: &[&Outcome]) -> Self {
        let healthy: Vec<_> = calibration.iter().filter(|o| o.part.is_none() && !o.varying).collect();
        let exceeded = |mut values: Vec<f64>, count: usize| {
            values.sort_by(|a, b| b.total_cmp(a));
            values[count.min(values.len() - 1)]
        };
        let by_plain = healthy.iter().filter(|o| o.plain.1 > THRESHOLD).count();
        let by_grade = healthy.iter().filter(|o| o.probability >= 0.95).count();
        EqualFalse {
            probability: exceeded(healthy.iter().map(|o| o.probability).collect(), by_plain),
            level: exceeded(healthy.iter().map(|o| o.plain.1).collect(), by_grade),
        }
    }
}

/// What a row of the table counts.
type Condition = fn(&Outcome) -> bool;

/// Found by SNR and part, false by kind, calibration by grade.
pub fn print_table(of: &[&Outcome], equal: &EqualFalse) {
    let EqualFalse { probability, level } = *equal;
    println!("Equal false alarms: probability {probability:.3}, plain level {level:.1}");
    println!(
        "| SNR | part | named right | at 95 % and above | at the plain way's false alarms | plain | plain at ours |"
    );
    println!("|---|---|---|---|---|---|---|");
    let found = |name: &str, own: &[&Outcome]| {
        let right = |p: f64| own.iter().filter(|o| o.probability >= p && o.is_right()).count();
        let plain =
            |level: f64| own.iter().filter(|o| Some(o.plain.0) == o.part && o.plain.1 > level).count();
        let all = own.len();
        let of_grade = [right(0.5), right(0.95), right(probability)].map(|n| percent(n, all));
        let of_plain = [plain(THRESHOLD), plain(level)].map(|n| percent(n, all));
        if all > 0 {
            println!("| {name} | {} | {} |", of_grade.join(" | "), of_plain.join(" | "));
        }
    };
    let backgrounds: [(&str, Condition); 3] = [
        ("noise and shaft lines", |o| o.other.is_none() && !o.varying),
        ("another source", |o| o.other.is_some() && !o.varying),
        ("varying speed", |o| o.varying),
    ];
    for (low, high) in [(-20.0, -12.0), (-12.0, -8.0), (-8.0, 10.0), (10.0, 100.0)] {
        for part in BearingPart::ALL {
            let own = |inside: Condition| -> Vec<&Outcome> {
                let is_own = |o: &&Outcome| o.part == Some(part) && (low..high).contains(&o.snr) && inside(o);
                of.iter().copied().filter(is_own).collect()
            };
            found(&format!("{low} to {high} dB | {}", part.name()), &own(|o| !o.varying));
            for (name, inside) in backgrounds {
                found(&format!("{low} to {high} dB | {}, {name}", part.name()), &own(inside));
            }
        }
    }
    println!(
        "\n| without a fault | named | at 95 % and above | rival in a window: at 95 % | elsewhere | plain |"
    );
    println!("|---|---|---|---|---|---|");
    let row = |name: &str, own: &[&Outcome]| {
        let named = |own: &[&Outcome], p: f64| own.iter().filter(|o| o.probability >= p).count();
        let (near, far): (Vec<&Outcome>, Vec<&Outcome>) =
            own.iter().copied().partition(|o| o.rival_in_a_window);
        println!(
            "| {name} | {} | {} | {} | {} | {} |",
            percent(named(own, 0.5), own.len()),
            percent(named(own, 0.95), own.len()),
            percent(named(&near, 0.95), near.len()),
            percent(named(&far, 0.95), far.len()),
            percent(own.iter().filter(|o| o.plain.1 > THRESHOLD).count(), own.len())
        );
    };
    for kind in Other::ALL {
        let is_own = |o: &&Outcome| o.part.is_none() && o.other == Some(kind);
        row(&format!("{kind:?}"), &of.iter().copied().filter(is_own).collect::<Vec<_>>());
    }
    row("all", &of.iter().copied().filter(|o| o.part.is_none()).collect::<Vec<_>>());
    print_calibration(of);
    let wrong = of.iter().filter(|o| o.part.is_some() && !o.is_right());
    for o in wrong.filter(|o| o.probability > 0.95) {
        println!(
            "wrong part: {:?} called {:?} {:.3} at {:.1} dB beside {:?}",
            o.part, o.candidate, o.probability, o.snr, o.other
        );
    }
}

/// How many of each grade are right.
pub fn print_calibration(of: &[&Outcome]) {
    println!("\n| grade | right |\n|---|---|");
    for (low, high) in
        [(0.0, 0.05), (0.05, 0.5), (0.5, 0.7), (0.7, 0.85), (0.85, 0.95), (0.95, 0.99), (0.99, 1.1)]
    {
        let own: Vec<_> = of.iter().filter(|o| (low..high).contains(&o.probability)).collect();
        let right = own.iter().filter(|o| o.is_right()).count();
        println!("| {low} to {high} | {} |", percent(right, own.len()));
    }
}
