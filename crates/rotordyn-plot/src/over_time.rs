//! Maps over speed that are drawn over time: of runs at constant speed, and of runs up and down, whose columns would cover each
//! other.

use super::scale::extremes;

/// Span of the speeds over the highest one below which it counts as constant.
const CONSTANT: f64 = 0.02;
/// Change of the speed over the highest one that is a run up or down.
const RUN: f64 = 0.2;

/// Why maps of some runs are drawn over time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OverTime {
    /// The speed \[rpm\] is constant in all runs.
    Constant(f64),
    /// The speed rises and falls within a run.
    UpAndDown,
}

impl OverTime {
    /// Whether runs, given by speeds \[rpm\] and times of their columns, are drawn over time; `None` over speed.
    pub fn of<'a>(runs: impl Iterator<Item = [&'a [f64]; 2]> + Clone) -> Option<Self> {
        let have_times = runs.clone().all(|[rpm, time]| !time.is_empty() && time.len() == rpm.len());
        let speeds = runs.clone().flat_map(|[rpm, _]| rpm.iter().copied());
        let (low, high) = extremes(speeds).filter(|_| have_times)?;
        let highest = low.abs().max(high.abs());
        if highest > 0.0 && high - low <= CONSTANT * highest {
            return Some(Self::Constant(0.5 * (low + high)));
        }
        let goes_both_ways =
            |rpm: &[f64]| largest_rise(rpm.iter()).min(largest_rise(rpm.iter().rev())) > RUN * highest;
        runs.clone().any(|[rpm, _]| goes_both_ways(rpm)).then_some(Self::UpAndDown)
    }

    /// A figure's note with the speed that no axis shows.
    pub fn note(why: Option<Self>, note: &str) -> String {
        match why {
            Some(Self::Constant(rpm)) if note.is_empty() => format!("at {rpm:.1} rpm"),
            Some(Self::Constant(rpm)) => format!("{note}; at {rpm:.1} rpm"),
            _ => note.into(),
        }
    }
}

/// Largest difference of a later and an earlier speed.
fn largest_rise<'a>(rpm: impl Iterator<Item = &'a f64>) -> f64 {
    let mut lowest = f64::INFINITY;
    rpm.fold(0.0, |rise: f64, speed| {
        lowest = lowest.min(*speed);
        rise.max(speed - lowest)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_at_one_speed_and_up_and_down_are_drawn_over_time() {
        let times = [0.0, 1.0, 2.0];
        let [steady, up, up_and_down] =
            [[3000.0, 3001.0, 3000.0], [2700.0, 2850.0, 3000.0], [0.0, 3000.0, 1500.0]];
        // a record that reaches its speed and falls a little
        let settling = [0.0, 3000.0, 2900.0];
        let of = |runs: &[[&[f64]; 2]]| OverTime::of(runs.iter().copied());
        assert_eq!(of(&[[&steady, &times]]), Some(OverTime::Constant(3000.5)));
        assert_eq!(of(&[[&up, &times]]), None);
        assert_eq!(of(&[[&settling, &times]]), None);
        assert_eq!(of(&[[&steady, &times], [&up, &times]]), None);
        assert_eq!(of(&[[&up_and_down, &times]]), Some(OverTime::UpAndDown));
        assert_eq!(of(&[[&up, &times], [&up_and_down, &times]]), Some(OverTime::UpAndDown));
        assert_eq!(of(&[[&up_and_down, &[]]]), None);
        assert_eq!(of(&[[&steady, &[]]]), None);
        assert_eq!(of(&[[&[0.0; 3], &times]]), None);
        assert_eq!(of(&[]), None);
    }
}
