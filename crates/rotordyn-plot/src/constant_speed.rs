//! Maps over speed of runs at constant speed, which are drawn over time.

use super::scale::extremes;

/// Span of the speeds over the highest one below which it counts as constant.
const CONSTANT: f64 = 0.02;

/// The speed \[rpm\] if it is constant in all runs and their times are known: speeds and times of the columns of each.
pub fn constant_speed<'a>(runs: impl Iterator<Item = [&'a [f64]; 2]> + Clone) -> Option<f64> {
    let have_times = runs.clone().all(|[rpm, time]| !time.is_empty() && time.len() == rpm.len());
    let (low, high) = extremes(runs.flat_map(|[rpm, _]| rpm.iter().copied())).filter(|_| have_times)?;
    let is_constant = high != 0.0 && high - low <= CONSTANT * low.abs().max(high.abs());
    is_constant.then_some(0.5 * (low + high))
}

/// A figure's note with the speed that no axis shows.
pub fn note_with_speed(note: &str, constant: Option<f64>) -> String {
    match constant {
        Some(rpm) if note.is_empty() => format!("at {rpm:.1} rpm"),
        Some(rpm) => format!("{note}; at {rpm:.1} rpm"),
        None => note.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_runs_at_one_speed_with_times_are_drawn_over_time() {
        let (times, steady, ramp) = (vec![0.0, 1.0], vec![3000.0, 3001.0], vec![2900.0, 3000.0]);
        let of = |runs: &[[&[f64]; 2]]| constant_speed(runs.iter().copied());
        assert_eq!(of(&[[&steady, &times]]), Some(3000.5));
        assert_eq!(of(&[[&ramp, &times]]), None);
        assert_eq!(of(&[[&steady, &times], [&ramp, &times]]), None);
        assert_eq!(of(&[[&steady, &[]]]), None);
        assert_eq!(of(&[[&[0.0, 0.0], &times]]), None);
        assert_eq!(of(&[]), None);
    }
}
