//! Common scale of measured FRFs: all of them are the computed ones times one factor, by a wrong unit, or times a power of the
//! circular frequency, by a wrong quantity.

use std::f64::consts::TAU;

use super::frf::{frf_indices, is_coupled, is_usable_line};
use super::target::TargetFrfs;
use rotordyn_core::document::number;
use rotordyn_identify::derivatives;
use rotordyn_linalg::Complex64;
use rotordyn_signal::Quantity;
use rotordyn_signal::statistics::median;

/// Difference of ln|H| from the common scale up to which a line has that scale: 2 dB.
const NEAR: f64 = 0.23;
/// Share of the lines that must have the common scale, and share of the FRFs whose median must.
const MIN_LINES: f64 = 0.5;
const MIN_FRFS: f64 = 0.9;
/// |ln| of a scale below which it may be an error of the model or of a calibration: a factor of 1.8.
const MIN_SCALE: f64 = 0.588;
/// Relative difference of a scale from the ratio of two units up to which the units are its likely cause.
const UNIT_TOLERANCE: f64 = 0.06;
/// The same for a scale from medians alone: no two causes are nearer than a factor of 2.
const ROUGH_UNIT_TOLERANCE: f64 = 0.22;

/// |ln| of a scale from which no model that resembles the machine explains it: a factor of 4.
const FAR: f64 = 1.386;
/// Difference of the median of an FRF from so large a scale, and median difference of all lines, up to which the FRFs have it:
/// 5 dB, and FRFs that it takes.
const NEAR_FAR: f64 = 0.58;
const MIN_FRFS_FAR: usize = 4;
/// Spread of the lines about a power of ω over that about a factor alone, below which the power is taken.
const CLEARER: f64 = 0.8;

/// Measured over computed |H| by units, the quantity for which alone they are usual, and what would cause it.
const UNITS: [(f64, Option<Quantity>, &str); 13] = [
    (1.0 / 9.806_65, Some(Quantity::Acceleration), "accelerations in g that are read as m/s^2"),
    (
        9.806_65,
        Some(Quantity::Acceleration),
        "accelerations in m/s^2 that are read as g, or forces in kgf that are read as N",
    ),
    (9.806_65, None, "forces in kgf that are read as N"),
    (4.448_222, None, "forces in lbf that are read as N"),
    (1.0 / 4.448_222, None, "forces in N that are read as lbf"),
    (
        4.448_222 / 9.806_65,
        Some(Quantity::Acceleration),
        "accelerations in g and forces in lbf that are read as m/s^2 and N",
    ),
    (39.370_08, None, "motion in inches that is read as metres"),
    (1.0 / 39.370_08, None, "motion in metres that is read as inches"),
    (175.126_8, None, "motion in inches and forces in lbf that are read as metres and N"),
    (1e3, None, "motion in mm that is read as m, or forces in kN that are read as N"),
    (1e-3, None, "motion in m that is read as mm, or forces in N that are read as kN"),
    (1e6, None, "motion in um that is read as m"),
    (1e-6, None, "motion in m that is read as um"),
];

/// Common scale of measured FRFs, |H_measured| = a ω^p |H_computed|.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrfScale {
    /// a, with ω in rad/s.
    pub ratio: f64,
    /// p: 0, or −2 to 2 if the FRFs are of another quantity.
    pub power: i32,
    /// Median of |ln| of the lines' deviations from it.
    pub spread: f64,
    /// Quantity as which the FRFs were read, of the first response.
    pub stated: Quantity,
    /// The quantity that they would be of, if it is another one.
    pub quantity: Option<Quantity>,
}

impl FrfScale {
    /// Units that would give the ratio, if known ones do.
    pub fn unit_cause(&self) -> Option<&'static str> {
        let tolerance = if self.spread < NEAR { UNIT_TOLERANCE } else { ROUGH_UNIT_TOLERANCE };
        let near = |of: f64| (self.ratio / of).ln().abs() < tolerance;
        let usual = |of: Option<Quantity>| of.is_none_or(|of| of == self.stated);
        UNITS.iter().find(|(of, quantity, _)| near(*of) && usual(*quantity)).map(|(_, _, cause)| *cause)
    }

    /// Whether the ratio is far from 1.
    fn is_large(&self) -> bool {
        self.ratio.ln().abs() >= MIN_SCALE
    }

    /// What was found.
    pub fn text(&self) -> String {
        let ratio = number(self.ratio, 3);
        let times = match self.power {
            0 => ratio,
            power if self.is_large() => format!("{ratio} omega^{power}"),
            power => format!("omega^{power}"),
        };
        format!(
            "all measured FRFs are {times} times the computed ones (half of the lines within {:.1} %)",
            100.0 * self.spread.exp_m1()
        )
    }

    /// What would explain it.
    pub fn advice(&self) -> String {
        let quantity = self.quantity.map(|quantity| match quantity {
            Quantity::Displacement => "displacement over force (receptances)",
            Quantity::Velocity => "velocity over force (mobilities)",
            Quantity::Acceleration => "acceleration over force (accelerances)",
        });
        match (quantity, self.unit_cause()) {
            (Some(quantity), _) => {
                format!("the FRFs may be {quantity}: give their unit, in the file or in a mapping")
            }
            (None, Some(cause)) => {
                format!("the cause may be {cause}: give the right unit, in the file or in a mapping")
            }
            (None, None) => {
                "check units, calibration and amplifier gains of force and response channels".into()
            }
        }
    }
}

/// The common scale of measured FRFs over the computed ones in a band \[Hz\], if it is far from 1; `computed` contains all lines.
///
/// Half of the lines of all FRFs and the medians of 90 % of the FRFs are within 2 dB of it. FRFs that are zero in the model are
/// left out. It may be taken of a model whose resonances are a few per cent off: most lines are beside them. Of a model farther off
/// only a factor of 4 or more is found, by the medians of four or more FRFs.
pub fn common_scale(
    measured: &TargetFrfs,
    computed: &[Vec<Vec<Complex64>>],
    [from, to]: [f64; 2],
) -> Option<FrfScale> {
    let in_band =
        |k: &usize| (from..=to).contains(&measured.frequencies[*k]) && measured.frequencies[*k] > 0.0;
    let lines: Vec<usize> = (0..measured.frequencies.len()).filter(in_band).collect();
    // ln|H_measured/H_computed| and ln ω of every FRF.
    let differences: Vec<Vec<[f64; 2]>> = frf_indices(measured)
        .filter(|&(r, e)| measured.is_nonzero(r, e) && is_coupled(computed, r, e))
        .map(|(r, e)| {
            let usable = lines.iter().filter(|&&k| is_usable_line(measured, r, e, k));
            let one = |&k: &usize| {
                let level = measured.values[r][e][k].norm().ln() - computed[r][e][k].norm().ln();
                [level, (TAU * measured.frequencies[k]).ln()]
            };
            usable.map(one).filter(|[level, _]| level.is_finite()).collect::<Vec<_>>()
        })
        .filter(|frf| !frf.is_empty())
        .collect();
    let stated = *measured.quantities.first()?;
    if let Some(found) = scale_of_power(&differences, 0, stated) {
        return found.is_large().then_some(found);
    }
    // One quantity for all, else a power has no meaning.
    let others: Vec<Quantity> = match measured.quantities.iter().all(|quantity| *quantity == stated) {
        true => [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration]
            .into_iter()
            .filter(|quantity| *quantity != stated)
            .collect(),
        false => Vec::new(),
    };
    let power_of = |quantity: Quantity| derivatives(quantity) - derivatives(stated);
    let by_lines = others.iter().filter_map(|&quantity| {
        let found = scale_of_power(&differences, power_of(quantity), stated)?;
        Some(FrfScale { quantity: Some(quantity), ..found })
    });
    by_lines.min_by(|a, b| a.spread.total_cmp(&b.spread)).or_else(|| {
        let factor = Levels::new(&differences, 0);
        if factor.common.abs() < FAR || differences.len() < MIN_FRFS_FAR {
            return None;
        }
        let mut best = (factor.spread(), factor, None);
        for quantity in others {
            let levels = Levels::new(&differences, power_of(quantity));
            let spread = levels.spread();
            if spread < CLEARER * best.0 {
                best = (spread, levels, Some(quantity));
            }
        }
        let (spread, levels, quantity) = best;
        let has_scale = spread < NEAR_FAR && levels.share_of_medians(NEAR_FAR) >= MIN_FRFS;
        has_scale.then(|| FrfScale { quantity, ..levels.scale(stated) })
    })
}

/// ln|H_measured/H_computed| − p ln ω of every line of every FRF.
struct Levels {
    power: i32,
    lines: Vec<f64>,
    /// Median of every FRF, and their median.
    medians: Vec<f64>,
    common: f64,
}

impl Levels {
    /// `differences`: ln|H_measured/H_computed| and ln ω of the lines of one FRF or more.
    fn new(differences: &[Vec<[f64; 2]>], power: i32) -> Self {
        let without = |frf: &Vec<[f64; 2]>| -> Vec<f64> {
            frf.iter().map(|[level, omega]| level - f64::from(power) * omega).collect()
        };
        let levels: Vec<Vec<f64>> = differences.iter().map(without).collect();
        let medians: Vec<f64> = levels.iter().map(|frf| median(frf.clone())).collect();
        let common = if medians.is_empty() { 0.0 } else { median(medians.clone()) };
        Self { power, lines: levels.concat(), medians, common }
    }

    fn share(&self, of: &[f64], within: f64) -> f64 {
        of.iter().filter(|level| (*level - self.common).abs() < within).count() as f64
            / of.len().max(1) as f64
    }

    fn share_of_lines(&self, within: f64) -> f64 {
        self.share(&self.lines, within)
    }

    fn share_of_medians(&self, within: f64) -> f64 {
        self.share(&self.medians, within)
    }

    /// Median distance of the lines from the common level.
    fn spread(&self) -> f64 {
        median(self.lines.iter().map(|level| (level - self.common).abs()).collect())
    }

    fn scale(&self, stated: Quantity) -> FrfScale {
        let (ratio, spread) = (self.common.exp(), self.spread());
        FrfScale { ratio, power: self.power, spread, stated, quantity: None }
    }
}

/// The scale of one power of ω, if the FRFs have it.
fn scale_of_power(differences: &[Vec<[f64; 2]>], power: i32, stated: Quantity) -> Option<FrfScale> {
    let levels = Levels::new(differences, power);
    let has_scale = levels.share_of_lines(NEAR) >= MIN_LINES && levels.share_of_medians(NEAR) >= MIN_FRFS;
    has_scale.then(|| levels.scale(stated))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::target::Sensor;
    use rotordyn_core::element::Anchor;
    use rotordyn_signal::record::Dof;

    /// Accelerances of two resonances at two points and one force; the third point is not coupled.
    fn frfs(of: impl Fn(usize, f64) -> f64, shift: f64) -> (TargetFrfs, Vec<Vec<Vec<Complex64>>>) {
        let frequencies: Vec<f64> = (1..400).map(|k| 0.5 * f64::from(k)).collect();
        let h = |r: usize, f: f64| {
            let mode = |hz: f64| (Complex64::new(hz * hz - f * f, 0.02 * hz * f)).inv();
            -f * f * (mode(40.0) + mode(130.0) * [1.0, -0.7, 0.0][r]) * if r == 2 { 0.0 } else { 1.0 }
        };
        let point = |node| Sensor {
            dof: Dof::new(node, 1),
            anchor: Anchor::node(0),
            direction: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        };
        let row = |r: usize, value: &dyn Fn(f64) -> Complex64| {
            let noise = if r == 2 { Complex64::new(1e-3, 0.0) } else { 0.0.into() };
            vec![frequencies.iter().map(|f| value(*f) + noise).collect::<Vec<_>>()]
        };
        let values = (0..3).map(|r| row(r, &|f| h(r, f * shift) * of(r, f))).collect();
        let computed =
            (0..3).map(|r| vec![frequencies.iter().map(|f| h(r, *f)).collect::<Vec<_>>()]).collect();
        let measured = TargetFrfs {
            frequencies: frequencies.clone(),
            responses: (1..4).map(point).collect(),
            references: vec![point(1)],
            quantities: vec![Quantity::Acceleration; 3],
            values,
            coherence: None,
        };
        (measured, computed)
    }

    fn found(of: impl Fn(usize, f64) -> f64, shift: f64) -> Option<FrfScale> {
        let (measured, computed) = frfs(of, shift);
        common_scale(&measured, &computed, [5.0, 180.0])
    }

    #[test]
    fn unit_of_all_frfs_is_named() {
        // With resonances 2 % off, too.
        for shift in [1.0, 1.02] {
            let scale = found(|_, _| 1.0 / 9.806_65, shift).unwrap();
            assert!((scale.ratio * 9.806_65 - 1.0).abs() < 0.06 && scale.power == 0, "{scale:?}");
            assert!(scale.advice().contains("in g that are read as m/s^2"), "{}", scale.advice());
        }
        let scale = found(|_, _| 1000.0, 1.0).unwrap();
        assert!(scale.text().contains("are 1000 times"), "{}", scale.text());
        assert!(scale.advice().contains("motion in mm"), "{}", scale.advice());
        let scale = found(|_, _| 3.1, 1.0).unwrap();
        assert!(scale.text().contains("3.10 times") && scale.unit_cause().is_none(), "{}", scale.text());
    }

    /// A model whose resonances are 6 % off, and whose levels differ by up to 3 dB from response to response.
    #[test]
    fn a_large_factor_is_named_with_a_model_far_off() {
        let found = |of: &dyn Fn(f64) -> f64| {
            let (mut measured, mut computed) = frfs(|_, f| of(f), 1.06);
            for (k, level) in [1.3, 0.75, 0.8].into_iter().enumerate() {
                let scaled = measured.values[k % 2][0].iter().map(|h| level * h).collect();
                measured.values.push(vec![scaled]);
                computed.push(computed[k % 2].clone());
                measured.responses.push(measured.responses[k % 2].clone());
            }
            measured.quantities = vec![Quantity::Acceleration; measured.responses.len()];
            common_scale(&measured, &computed, [5.0, 180.0])
        };
        let scale = found(&|_| 9.806_65).unwrap();
        assert!((scale.ratio / 9.806_65).ln().abs() < 0.2, "{scale:?}");
        assert!(scale.advice().contains("m/s^2 that are read as g"), "{scale:?}: {}", scale.advice());
        let scale = found(&|f| (TAU * f).powi(-2)).unwrap();
        assert_eq!(scale.quantity, Some(Quantity::Displacement), "{scale:?}");
        assert_eq!(found(&|_| 1.7), None);
    }

    #[test]
    fn other_quantity_is_named() {
        let scale = found(|_, f| (TAU * f).powi(-2), 1.0).unwrap();
        assert_eq!((scale.power, scale.quantity), (-2, Some(Quantity::Displacement)));
        assert!(
            (scale.ratio - 1.0).abs() < 1e-9 && scale.text().contains("omega^-2 times"),
            "{}",
            scale.text()
        );
        let scale = found(|_, f| (TAU * f).recip(), 1.0).unwrap();
        assert!(scale.advice().contains("mobilities"), "{}", scale.advice());
    }

    #[test]
    fn no_scale_of_frfs_that_fit_or_differ() {
        assert_eq!(found(|_, _| 1.0, 1.0), None);
        assert_eq!(found(|_, _| 1.3, 1.0), None);
        // One sensor of two.
        assert_eq!(found(|r, _| if r == 0 { 9.8 } else { 1.0 }, 1.0), None);
        // Resonances elsewhere.
        assert_eq!(found(|_, _| 1.0, 1.5), None);
    }
}
