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

/// Measured over computed |H| by units, the quantity for which alone they are usual, and what would cause it.
const UNITS: [(f64, Option<Quantity>, &str); 12] = [
    (1.0 / 9.806_65, Some(Quantity::Acceleration), "accelerations in g that are read as m/s^2"),
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
        let near = |of: f64| (self.ratio / of).ln().abs() < UNIT_TOLERANCE;
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
/// left out. It may be taken of a model whose resonances are a few per cent off: most lines are beside them.
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
    if measured.quantities.iter().any(|quantity| *quantity != stated) {
        return None;
    }
    [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration]
        .into_iter()
        .filter(|quantity| *quantity != stated)
        .filter_map(|quantity| {
            let found = scale_of_power(&differences, derivatives(quantity) - derivatives(stated), stated)?;
            Some(FrfScale { quantity: Some(quantity), ..found })
        })
        .min_by(|a, b| a.spread.total_cmp(&b.spread))
}

/// The scale of one power of ω, if the FRFs have it.
fn scale_of_power(differences: &[Vec<[f64; 2]>], power: i32, stated: Quantity) -> Option<FrfScale> {
    let without = |frf: &Vec<[f64; 2]>| -> Vec<f64> {
        frf.iter().map(|[level, omega]| level - f64::from(power) * omega).collect()
    };
    let levels: Vec<Vec<f64>> = differences.iter().map(without).collect();
    let medians: Vec<f64> = levels.iter().map(|frf| median(frf.clone())).collect();
    if medians.is_empty() {
        return None;
    }
    let common = median(medians.clone());
    let near = |level: &f64| (level - common).abs() < NEAR;
    let share = |of: &[f64]| of.iter().filter(|level| near(level)).count() as f64 / of.len() as f64;
    let all: Vec<f64> = levels.concat();
    if share(&all) < MIN_LINES || share(&medians) < MIN_FRFS {
        return None;
    }
    let spread = median(all.iter().map(|level| (level - common).abs()).collect());
    Some(FrfScale { ratio: common.exp(), power, spread, stated, quantity: None })
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
