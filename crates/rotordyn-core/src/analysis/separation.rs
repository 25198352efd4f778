//! Critical speeds of the unbalance response with their separation margins, as API 684 tabulates them.

use super::mode_kind::ModeKind;
use super::peaks::{CRITICALLY_DAMPED, Peak, required_separation, separation};
use super::poles::Pole;
use crate::document::{Rows, TO_RPM, named};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Largest distance of a peak from the critical speed of its mode, as a fraction of it; 3 half-widths of the mode where that is
/// between the two (neighbours shift the peaks of well damped modes).
const REACH: [f64; 2] = [0.03, 0.3];
const HALF_WIDTHS: f64 = 3.0;
/// A peak is sharper than its mode alone, AF = 1/(2ζ), at most by this factor.
const SHARPER: f64 = 2.0;
/// A peak is broader than its mode alone at most by this factor: a neighbour may fill one flank.
const BROADER: f64 = 10.0;

/// A lateral critical speed, assessed as in API 617.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeparationMargin {
    /// Critical speed of the damped mode \[rad/s\].
    pub speed: f64,
    /// Label of the mode.
    pub label: String,
    /// Log decrement δ of the mode there.
    pub log_decrement: f64,
    /// The response whose peak is the sharpest, and the speed of that peak \[rad/s\]; of an undamped mode no single response, and
    /// the critical speed itself.
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
/// A peak belongs to the nearest of the excited poles that can have it (`can_have`); of several peaks of a pole the one with the
/// largest AF counts, which requires the largest margin. `excited` says whether the unbalance excites a pole.
pub fn separation_margins(
    poles: &[Pole],
    peaks: &[(String, Peak)],
    excited: impl Fn(&Pole) -> bool,
    operating: Option<[f64; 2]>,
) -> Vec<SeparationMargin> {
    let excited: Vec<&Pole> = poles.iter().filter(|pole| excited(pole)).collect();
    let owner = |peak: &Peak| {
        let distance = |pole: &Pole| (peak.at / pole.at - 1.0).abs();
        let able = excited.iter().filter(|pole| can_have(pole, peak));
        able.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|pole| pole.at)
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
            // An undamped response is infinite at the critical speed itself, whatever a grid of speeds shows beside it.
            let undamped = is_excited && pole.is_undamped();
            let sharpest = sharpest.filter(|_| !undamped);
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
                peak: sharpest.map(|(_, at, _)| at).or(undamped.then_some(pole.at)),
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

/// Whether a peak with both half-power points can be that of a damped mode: near its critical speed, and as wide as 1/(2ζ) of the
/// mode allows. On the flank of a well damped mode a sharp peak is that of another mode, however near it is.
fn can_have(pole: &Pole, peak: &Peak) -> bool {
    let Some(factor) = peak.amplification() else { return false };
    let reach = (HALF_WIDTHS * pole.half_width / pole.at).clamp(REACH[0], REACH[1]);
    let own = 0.5 * pole.at / pole.half_width;
    (peak.at / pole.at - 1.0).abs() <= reach && factor <= SHARPER * own && own <= BROADER * factor
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
    fn a_broad_peak_beside_a_sharp_mode_is_the_sharp_mode_s() {
        // One flank of the response at 5146.5 rpm is that of the broad mode at 5629 rpm, whose own peaks lie 3 % above it.
        let poles = [Pole::new(5119.3, 55.0), Pole::new(5628.8, 202.0)];
        let peaks = [peak(5119.7, 46.8), peak(5146.5, 9.73), peak(5776.3, 3.83), peak(5793.7, 3.99)];
        let found = separation_margins(&poles, &peaks, |_| true, Some([4000.0, 4600.0]));
        assert_eq!([found[0].peak, found[1].peak], [Some(5119.7), Some(5793.7)]);
        assert_eq!(
            [found[0].assessment, found[1].assessment],
            [Assessment::Insufficient, Assessment::Sufficient]
        );
        assert!((found[1].available.unwrap() - (5793.7 / 4600.0 - 1.0)).abs() < 1e-12);
    }

    /// Peaks of the response to a rotating force of Σ 1/(ω² − Ω² + 2jζωΩ) of modes (ω, ζ, weight).
    fn peaks_of(modes: &[(f64, f64, f64)]) -> Vec<(String, Peak)> {
        use rotordyn_linalg::Complex64;
        let speeds: Vec<f64> = (1..40_000).map(|k| 0.01 * f64::from(k)).collect();
        let size = |speed: &f64| {
            let part = |(w, zeta, weight): &(f64, f64, f64)| {
                weight * speed * speed / Complex64::new(w * w - speed * speed, 2.0 * zeta * w * speed)
            };
            modes.iter().map(part).sum::<Complex64>().norm()
        };
        let sizes: Vec<f64> = speeds.iter().map(size).collect();
        super::super::peaks::peaks(&speeds, &sizes).into_iter().map(|peak| ("probe".into(), peak)).collect()
    }

    #[test]
    fn peaks_of_superposed_modes_go_to_their_modes() {
        for (zeta, weight) in [(0.02, 1.0), (0.05, 1.0), (0.05, -1.0), (0.08, -0.5)] {
            // The sharp mode at 100, a broader one at 130, one beyond critical damping at 103.
            let modes = [(100.0, 0.01, 1.0), (130.0, zeta, weight), (103.0, 0.856, 1.0)];
            let poles: Vec<Pole> = modes.iter().map(|(w, zeta, _)| Pole::new(*w, zeta * w)).collect();
            let found = separation_margins(&poles, &peaks_of(&modes), |_| true, Some([50.0; 2]));
            // By speed: 100, 103, 130.
            let at = found[0].peak.unwrap();
            assert!((at / 100.0 - 1.0).abs() < 0.01, "{zeta} {weight}: {at}");
            assert!((found[0].amplification.unwrap() / 50.0 - 1.0).abs() < 0.25, "{zeta} {weight}");
            assert_eq!((found[1].peak, found[1].assessment), (None, Assessment::CriticallyDamped));
            assert!(found[2].peak.is_none_or(|at| (at / 130.0 - 1.0).abs() < 3.0 * zeta), "{found:?}");
        }
    }

    #[test]
    fn a_mode_beyond_critical_damping_has_no_sharp_peak() {
        // The mode of the peak, at 1432.9 rpm, is not excited by the unbalance.
        let poles = [Pole::new(1432.9, 124.8), Pole::new(1564.5, 1339.0), Pole::new(5673.9, 1426.0)];
        let found =
            separation_margins(&poles, &[peak(1446.9, 5.87)], |p| p.at > 1500.0, Some([1540.0, 1560.0]));
        let assessed: Vec<_> = found.iter().map(|m| (m.assessment, m.amplification)).collect();
        let damped = (Assessment::CriticallyDamped, None);
        assert_eq!(assessed, [(Assessment::NotExcited, None), damped, damped]);
    }

    #[test]
    fn the_margin_of_an_undamped_mode_is_that_of_its_critical_speed() {
        // The highest point of a grid, at 1083.6 rpm, is 26.3 % away.
        let poles = [Pole::new(1076.2, 0.0)];
        let found = separation_margins(&poles, &[peak(1083.6, 37.9)], |_| true, Some([850.0, 858.0]));
        assert_eq!((found[0].peak, &found[0].response), (Some(1076.2), &None));
        assert!((found[0].available.unwrap() - (1076.2 / 858.0 - 1.0)).abs() < 1e-12);
        assert_eq!(found[0].assessment, Assessment::Insufficient);
    }

    #[test]
    fn an_undamped_mode_needs_the_largest_margin() {
        let found = separation_margins(&[Pole::new(120.0, 0.0)], &[], |_| true, Some([90.0, 100.0]));
        assert_eq!((found[0].amplification, found[0].required), (Some(f64::INFINITY), Some(0.26)));
        assert_eq!(found[0].assessment, Assessment::Insufficient);
    }
}
