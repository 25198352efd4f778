//! Critical speeds of the unbalance response with their separation margins, as API 684 tabulates them.

use super::mode_kind::ModeKind;
use super::peaks::{CRITICALLY_DAMPED, Peak, required_separation, separation};
use super::poles::Pole;
use crate::document::{Rows, TO_RPM, named};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Distance of a peak from its critical speed: in half-widths of the mode, and as a fraction of the speed where that is
/// more (peaks of well damped modes are shifted by their neighbours).
const REACH: [f64; 2] = [3.0, 0.03];

/// A lateral critical speed, assessed as in API 617.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeparationMargin {
    /// Critical speed of the damped mode \[rad/s\].
    pub speed: f64,
    /// Label of the mode.
    pub label: String,
    /// Log decrement δ of the mode there.
    pub log_decrement: f64,
    /// The response whose peak is the sharpest, and the speed of that peak \[rad/s\].
    pub response: Option<String>,
    pub peak: Option<f64>,
    /// Amplification factor AF = N_c/(N_2 − N_1) of that peak; infinite for an undamped mode.
    pub amplification: Option<f64>,
    /// Margins from the operating speeds, as fractions of the nearer one; `None` without operating speeds.
    pub available: Option<f64>,
    pub required: Option<f64>,
    pub assessment: Assessment,
}

/// What the margins of a critical speed amount to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Assessment {
    /// The available margin is at least the required one.
    Sufficient,
    Insufficient,
    /// AF < 2.5: no margin is required.
    CriticallyDamped,
    /// The unbalance does not excite the mode.
    NotExcited,
    /// No peak with both half-power points belongs to the mode: AF is not known.
    NotResolved,
    /// No operating speeds are known.
    NoOperatingSpeed,
}

impl Assessment {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sufficient => "sufficient",
            Self::Insufficient => "insufficient",
            Self::CriticallyDamped => "critically damped",
            Self::NotExcited => "not excited",
            Self::NotResolved => "peak not resolved",
            Self::NoOperatingSpeed => "no operating speed",
        }
    }
}

/// The margins of every pole of an unbalance response, by speed; without torsional and axial modes that it does not excite.
///
/// A peak belongs to the pole that is nearest in place and width; of several peaks of a pole the one with the largest AF counts, which requires the
/// largest margin. `excited` says whether the unbalance excites a pole.
pub fn separation_margins(
    poles: &[Pole],
    peaks: &[(String, Peak)],
    excited: impl Fn(&Pole) -> bool,
    operating: Option<[f64; 2]>,
) -> Vec<SeparationMargin> {
    let excited: Vec<&Pole> = poles.iter().filter(|pole| excited(pole)).collect();
    let distance = |pole: &Pole, peak: &Peak| {
        (peak.at - pole.at).abs() / (REACH[0] * pole.half_width).max(REACH[1] * pole.at)
    };
    // How much wider or narrower the peak is than the mode makes it, as a logarithm: a sharp peak on the flank of a well damped
    // mode is not that mode's.
    let misfit = |pole: &Pole, peak: &Peak| match peak.half_power {
        Some([low, high]) if high > low && pole.half_width > 0.0 => {
            (2.0 * pole.half_width / (high - low)).ln().abs()
        }
        _ => 0.0,
    };
    let owner = |peak: &Peak| {
        let near = excited.iter().filter(|pole| distance(pole, peak) <= 1.0);
        let cost = |pole: &Pole| distance(pole, peak).hypot(misfit(pole, peak));
        near.min_by(|a, b| cost(a).total_cmp(&cost(b))).map(|pole| pole.at)
    };
    let not_lateral = [ModeKind::Torsional, ModeKind::Axial];
    let mut found: Vec<SeparationMargin> = poles
        .iter()
        .map(|pole| (pole, excited.iter().any(|other| std::ptr::eq(*other, pole))))
        .filter(|(pole, is_excited)| {
            *is_excited || !pole.kind.is_some_and(|kind| not_lateral.contains(&kind))
        })
        .map(|(pole, is_excited)| {
            let own = peaks.iter().filter(|(_, peak)| is_excited && owner(peak) == Some(pole.at));
            let sharpest = own
                .filter_map(|(name, peak)| Some((name, peak.at, peak.amplification()?)))
                .max_by(|a, b| a.2.total_cmp(&b.2));
            // An undamped response is infinite: it has no peak that could be measured.
            let undamped = is_excited && pole.is_undamped();
            let amplification =
                if undamped { Some(f64::INFINITY) } else { sharpest.map(|(_, _, factor)| factor) };
            let at = sharpest.map_or(pole.at, |(_, at, _)| at);
            let available = operating.filter(|_| is_excited).map(|speeds| separation(at, speeds));
            let required =
                operating.zip(amplification).map(|(speeds, factor)| required_separation(at, factor, speeds));
            // Modes too damped for a peak are known by their own half-width.
            let flat = 0.5 * pole.at / pole.half_width < CRITICALLY_DAMPED;
            // Coupling that moves a torsional or axial mode next to nothing gives it no peak.
            let is_lateral = !pole.kind.is_some_and(|kind| not_lateral.contains(&kind));
            let assessment = match (amplification, available.zip(required)) {
                _ if !is_excited || amplification.is_none() && !is_lateral => Assessment::NotExcited,
                (Some(factor), _) if factor < CRITICALLY_DAMPED => Assessment::CriticallyDamped,
                (None, _) if flat => Assessment::CriticallyDamped,
                (None, _) => Assessment::NotResolved,
                (_, None) => Assessment::NoOperatingSpeed,
                (_, Some((available, required))) if available >= required => Assessment::Sufficient,
                _ => Assessment::Insufficient,
            };
            let zeta = pole.damping_ratio;
            SeparationMargin {
                speed: pole.at,
                label: pole.label.clone(),
                log_decrement: TAU * zeta / (1.0 - zeta * zeta).sqrt(),
                response: sharpest.map(|(name, ..)| name.clone()),
                peak: sharpest.map(|(_, at, _)| at),
                amplification,
                available,
                required,
                assessment,
            }
        })
        .collect();
    found.sort_by(|a, b| a.speed.total_cmp(&b.speed));
    found
}

impl SeparationMargin {
    /// What is written to files, one row a critical speed.
    pub fn columns(found: &[Self]) -> Rows<'static, '_, Self> {
        Rows::of(found)
            .number(named("speed_rpm", "rpm"), "rpm", |m| m.speed * TO_RPM)
            .text("label", |m| &m.label)
            .number(named("log_decrement", "log_dec"), "1", |m| m.log_decrement)
            .optional_text("response", |m| m.response.as_ref())
            .optional(named("peak_rpm", "peak_rpm"), "rpm", |m| m.peak.map(|at| at * TO_RPM))
            .optional("amplification_factor", "1", |m| m.amplification)
            .optional("separation_margin", "1", |m| m.available)
            .optional("required_separation_margin", "1", |m| m.required)
            .text("assessment", |m| m.assessment.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn peak(at: f64, factor: f64) -> (String, Peak) {
        let half = 0.5 * at / factor;
        ("probe".into(), Peak { at, amplitude: 1.0, half_power: Some([at - half, at + half]) })
    }

    #[test]
    fn every_assessment_has_its_cause() {
        // AF of 10 requires 17 % (1 − 1/8.5) = 15 % below the operating speed, 25 % above it.
        let poles = [80.0, 90.0, 120.0, 130.0, 200.0, 300.0, 400.0];
        let poles: Vec<Pole> = poles.iter().map(|at| Pole::new(*at, 0.05 * at)).collect();
        let flat = Pole::new(500.0, 150.0);
        let poles: Vec<Pole> = poles.into_iter().chain([flat]).collect();
        let unresolved = ("probe".into(), Peak { at: 300.0, amplitude: 1.0, half_power: None });
        let peaks = [
            peak(80.0, 10.0),
            peak(90.0, 10.0),
            peak(120.0, 10.0),
            peak(130.0, 10.0),
            peak(200.0, 2.4),
            unresolved,
        ];
        let found = separation_margins(&poles, &peaks, |pole| pole.at != 400.0, Some([100.0, 100.0]));
        let expected = [
            Assessment::Sufficient,
            Assessment::Insufficient,
            Assessment::Insufficient,
            Assessment::Sufficient,
            Assessment::CriticallyDamped,
            Assessment::NotResolved,
            Assessment::NotExcited,
            Assessment::CriticallyDamped,
        ];
        assert_eq!(found.iter().map(|m| m.assessment).collect::<Vec<_>>(), expected);
        let without = separation_margins(&poles[..1], &peaks, |_| true, None);
        assert_eq!(without[0].assessment, Assessment::NoOperatingSpeed);
    }

    #[test]
    fn an_axial_mode_without_a_peak_is_not_excited() {
        let pole = |kind| Pole { kind: Some(kind), ..Pole::new(100.0, 1.0) };
        let poles = [pole(ModeKind::Axial), pole(ModeKind::Torsional), pole(ModeKind::Forward)];
        let assessed =
            |pole: &Pole| separation_margins(std::slice::from_ref(pole), &[], |_| true, None)[0].assessment;
        let expected = [Assessment::NotExcited, Assessment::NotExcited, Assessment::NotResolved];
        assert_eq!(poles.each_ref().map(assessed), expected);
    }

    #[test]
    fn peaks_belong_to_the_nearest_pole_and_the_sharpest_counts() {
        let poles = [Pole::new(100.0, 1.0), Pole::new(104.0, 1.0)];
        let peaks = [peak(100.5, 20.0), peak(100.2, 40.0), peak(103.8, 30.0), peak(150.0, 90.0)];
        let found = separation_margins(&poles, &peaks, |_| true, None);
        let factors: Vec<_> = found.iter().map(|m| m.amplification.map(f64::round)).collect();
        assert_eq!(factors, [Some(40.0), Some(30.0)]);
        assert_eq!(found[0].peak, Some(100.2));
    }

    #[test]
    fn a_sharp_peak_on_the_flank_of_a_broad_mode_is_not_its_peak() {
        // In speed the peak is nearer to the broad mode, measured by half-widths.
        let poles = [Pole::new(100.0, 5.0), Pole::new(101.0, 80.0)];
        for at in [100.3, 101.0] {
            let found = separation_margins(&poles, &[peak(at, 10.0)], |_| true, None);
            assert_eq!(found[0].amplification.map(f64::round), Some(10.0), "{at}");
            assert_eq!(found[1].amplification, None, "{at}");
            assert_eq!(found[1].assessment, Assessment::CriticallyDamped, "{at}");
        }
        // And the broad peak of a broad mode is not that of the sharp one.
        let found = separation_margins(&poles, &[peak(101.5, 0.7)], |_| true, None);
        assert_eq!((found[0].amplification, found[1].amplification.is_some()), (None, true));
    }

    #[test]
    fn an_undamped_mode_needs_the_largest_margin() {
        let found = separation_margins(&[Pole::new(120.0, 0.0)], &[], |_| true, Some([90.0, 100.0]));
        assert_eq!((found[0].amplification, found[0].required), (Some(f64::INFINITY), Some(0.26)));
        assert_eq!(found[0].assessment, Assessment::Insufficient);
    }
}
