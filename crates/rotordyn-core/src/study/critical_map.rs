//! Undamped critical speed map.

use super::Machine;
use crate::analysis::critical_map::{BearingCurve, SupportedRotor};
use crate::assembly::PhysicsError;
use crate::model::study::CriticalMapStudy;
use crate::results::CriticalMap;

/// Speeds at which the bearings' own stiffness is computed.
const SPEEDS: usize = 25;
/// Range of stiffness without any of the bearings' own \[N/m\].
const DEFAULT_RANGE: [f64; 2] = [1e5, 1e10];
/// Stiffnesses closer than this fraction are those of equal bearings.
const EQUAL: f64 = 1e-6;

impl Machine {
    /// Undamped critical speeds over the stiffness of the bearings, and the crossings with their own.
    ///
    /// # Errors
    /// No equilibrium at a speed, an eigenvalue computation that fails, or a machine too large for dense matrices.
    pub fn critical_map(&self, study: &CriticalMapStudy) -> Result<CriticalMap, PhysicsError> {
        if let Some(machine) = self.decided(&[study.max_speed])? {
            return machine.critical_map(study);
        }
        self.check_tables("critical-map", &[0.0, study.max_speed])?;
        let speeds: Vec<f64> =
            (0..SPEEDS).map(|k| study.max_speed * k as f64 / (SPEEDS - 1) as f64).collect();
        let tangents = |speed| self.tangents(speed, true);
        let found: Vec<_> = speeds.iter().map(|&speed| tangents(speed)).collect::<Result<_, _>>()?;
        let mut bearings: Vec<(Vec<String>, BearingCurve)> = Vec::new();
        for (site, of) in self.assembly.sites.iter().enumerate() {
            for (axis, name) in ["x", "y"].into_iter().enumerate() {
                let stiffness: Vec<f64> = found.iter().map(|t| t[site].stiffness[axis][axis]).collect();
                let label = format!("{} {name}", of.name);
                let near = |a: &f64, b: &f64| (a - b).abs() <= EQUAL * a.abs().max(b.abs());
                let same = |other: &&mut (Vec<String>, BearingCurve)| {
                    other.1.stiffness.iter().zip(&stiffness).all(|(a, b)| near(a, b))
                };
                match bearings.iter_mut().find(same) {
                    Some((names, _)) => names.push(label),
                    None => {
                        let curve = BearingCurve { label: String::new(), site, axis, stiffness };
                        bearings.push((vec![label], curve));
                    }
                }
            }
        }
        let bearings: Vec<BearingCurve> = bearings
            .into_iter()
            .map(|(names, curve)| BearingCurve { label: names.join(", "), ..curve })
            .collect();
        let own = || bearings.iter().flat_map(|b| b.stiffness.iter().copied()).filter(|k| *k > 0.0);
        let ends = [own().fold(f64::INFINITY, f64::min), own().fold(0.0, f64::max)];
        // A decade and more on both sides of the bearings' own.
        let around = match ends[0].is_finite() {
            true => [ends[0].log10().floor() - 1.0, ends[1].log10().ceil() + 1.0].map(|e| 10_f64.powf(e)),
            false => DEFAULT_RANGE,
        };
        let [low, high] =
            [study.lowest_stiffness.unwrap_or(around[0]), study.highest_stiffness.unwrap_or(around[1])];
        let step = (high / low).ln() / (study.points.max(2) - 1) as f64;
        let stiffness: Vec<f64> = (0..study.points.max(2)).map(|k| low * (step * k as f64).exp()).collect();
        let standstill = self.standstill_equilibrium.tangents();
        let rotor =
            SupportedRotor { assembly: &self.assembly, standstill: &standstill, max_speed: study.max_speed };
        let tracked = rotor.curves(&stiffness)?;
        let mut crossings = Vec::new();
        for curve in &tracked {
            for bearing in &bearings {
                crossings.extend(rotor.crossings(curve, &stiffness, bearing, &tangents)?);
            }
        }
        let curves = tracked.into_iter().map(|tracked| tracked.curve).collect();
        crossings.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        Ok(CriticalMap { max_speed: study.max_speed, stiffness, curves, speeds, bearings, crossings })
    }
}
