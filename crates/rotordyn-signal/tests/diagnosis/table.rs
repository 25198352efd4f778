//! The table of the diagnoses.

use rotordyn_signal::bearing_lines::BearingPart;

use super::calibration::Outcome;
use super::others::Other;

fn percent(part: usize, of: usize) -> String {
    if of == 0 { "-".into() } else { format!("{:.1} % of {of}", 100.0 * part as f64 / of as f64) }
}

/// Found by SNR and part, false by kind, calibration by grade.
pub fn print_table(of: &[Outcome]) {
    println!("| SNR | part | named right | at 95 % and above | plain |");
    println!("|---|---|---|---|---|");
    for low in [-20.0, -15.0, -12.0, -8.0, 0.0, 10.0] {
        let high = match low {
            -20.0 => -15.0,
            -15.0 => -12.0,
            -12.0 => -8.0,
            -8.0 => 0.0,
            0.0 => 10.0,
            _ => 100.0,
        };
        for part in BearingPart::ALL {
            let own: Vec<_> =
                of.iter().filter(|o| o.part == Some(part) && (low..high).contains(&o.snr)).collect();
            let right = |p: f64| own.iter().filter(|o| o.probability >= p && o.is_right()).count();
            let plain = own.iter().filter(|o| o.plain == o.part).count();
            println!(
                "| {low} to {high} dB | {} | {} | {} | {} |",
                part.name(),
                percent(right(0.5), own.len()),
                percent(right(0.95), own.len()),
                percent(plain, own.len())
            );
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
            percent(own.iter().filter(|o| o.plain.is_some()).count(), own.len())
        );
    };
    for kind in Other::ALL {
        let own: Vec<_> = of.iter().filter(|o| o.part.is_none() && o.other == Some(kind)).collect();
        row(&format!("{kind:?}"), &own);
    }
    row("all", &of.iter().filter(|o| o.part.is_none()).collect::<Vec<_>>());
    println!("\n| grade | right |");
    println!("|---|---|");
    for (low, high) in
        [(0.0, 0.05), (0.05, 0.5), (0.5, 0.7), (0.7, 0.85), (0.85, 0.95), (0.95, 0.99), (0.99, 1.1)]
    {
        let own: Vec<_> = of.iter().filter(|o| (low..high).contains(&o.probability)).collect();
        let right = own.iter().filter(|o| o.is_right()).count();
        println!("| {low} to {high} | {} |", percent(right, own.len()));
    }
    let wrong = of.iter().filter(|o| o.part.is_some() && !o.is_right());
    for o in wrong.filter(|o| o.probability > 0.95) {
        println!(
            "wrong part: {:?} called {:?} {:.3} at {:.1} dB beside {:?}",
            o.part, o.candidate, o.probability, o.snr, o.other
        );
    }
}
