//! What is said of the marks of a tacho wheel.

use rotordyn::signal::tacho::PulseTrain;
use rotordyn::signal::tacho::marks::{MarkKind, marks_per_turn};

use super::super::terminal::number;

/// Most places of marks that are printed.
const MOST_PLACES: usize = 8;

/// The marks of a wheel in the source of the shaft angle.
pub fn described(train: &PulseTrain, per_revolution: usize) -> String {
    match train.marks.as_ref().map(|marks| marks.kind) {
        Some(MarkKind::TeethLeftOut { pitches, missing }) => {
            let teeth = if missing == 1 { "one tooth".into() } else { format!("{missing} teeth") };
            format!("a wheel of {pitches} pitches with {teeth} missing, {} per revolution", pitches - missing)
        }
        Some(MarkKind::Uneven { .. }) => format!("{per_revolution} uneven marks per revolution"),
        None => format!("{per_revolution} per revolution"),
    }
}

/// A warning for marks that are not where they are stated to be.
pub fn warning(times: &[f64], train: &PulseTrain, per_revolution: usize) -> Option<String> {
    if let Some(marks) = &train.marks {
        let MarkKind::Uneven { deviation } = marks.kind else { return None };
        let count = marks.pitches.len();
        let places: Vec<String> =
            (0..count).take(MOST_PLACES).map(|mark| number(360.0 * marks.turns(0, mark), 4)).collect();
        let more = if count > MOST_PLACES { ", ..." } else { "" };
        return Some(format!(
            "tacho: its {count} marks are up to {} deg off even places, at {}{more} deg; the shaft angle is corrected for it. A \
             shaft whose speed swings in the same way in every turn would look the same",
            number(360.0 * deviation, 3),
            places.join(", ")
        ));
    }
    let marks = marks_per_turn(times).filter(|_| per_revolution == 1)?;
    Some(format!(
        "tacho: the intervals of its pulses repeat after {marks} pulses: there is more than one mark per turn, and the speed is \
         {marks} times too high; give --pulses-per-rev {marks}"
    ))
}
