//! The shaft speed that a record shows, beside the stated one.

use rotordyn::results::SignalResult;
use rotordyn::signal::grading::SpeedFinding;

use super::super::terminal::number;

/// Line of the terminal: the record's own speed with its uncertainty.
pub fn line(result: &SignalResult) -> Option<String> {
    let SpeedFinding::Found(found) = result.record_speed? else { return None };
    let stated = result.shaft.as_ref()?.mean;
    Some(format!(
        "Speed of the record itself: {:.2} \u{b1} {:.2} rpm ({:+.2} % from the stated one, {} shaft harmonics); bearing lines \
         are multiples of it",
        60.0 * found.speed,
        60.0 * found.uncertainty,
        100.0 * (found.speed / stated - 1.0),
        found.harmonics
    ))
}

/// Warning if neither shaft harmonics nor the diagnosis confirm the stated speed.
pub fn warning(result: &SignalResult, range: f64) -> Option<String> {
    let stated = result.shaft.as_ref()?.mean;
    let missing = format!(
        "{}: no family of shaft harmonics within {} % of {} rpm",
        result.channel,
        number(100.0 * range, 3),
        number(60.0 * stated, 5)
    );
    match result.unconfirmed_speed()? {
        SpeedFinding::Found(_) => None,
        SpeedFinding::NotFound => {
            Some(format!("{missing}: speed and sampling rate are not confirmed by the record"))
        }
        SpeedFinding::Elsewhere { speed, ratio: 2.0 } => Some(format!(
            "{missing}: of its harmonics only even ones stand ({} of {} rpm, no 1x or 3x): the speed may be twice, or the \
             sampling rate half the one used",
            speed.harmonics,
            number(60.0 * speed.speed, 5)
        )),
        SpeedFinding::Elsewhere { speed, ratio } => Some(format!(
            "{missing}, but one of {} harmonics at {} rpm: if the speed is right the sampling rate is {} times the one used",
            speed.harmonics,
            number(60.0 * speed.speed, 5),
            number(1.0 / ratio, 3)
        )),
    }
}
