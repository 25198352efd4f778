//! Undamped critical speeds over the radial stiffness of the bearings.

use super::campbell::Tangents;
use super::critical_speed::undamped_critical_speeds;
use super::mode_kind::{ModeKind, ordinal};
use crate::assembly::dense_limit::check_dense;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use rayon::prelude::*;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::BandLayout;
use serde::{Deserialize, Serialize};

/// Dense complex matrices in memory for a group of unknowns, as pairs of real ones.
const MATRICES: usize = 10;
/// Relative distance of the two whirl directions of a rotor without gyroscopic effect.
const EQUAL: f64 = 1e-7;
/// Relative change of the stiffness at which a crossing is found, and the most steps to it.
const TOLERANCE: f64 = 1e-10;
const MAX_STEPS: usize = 60;

/// Undamped critical speeds of one mode over the stiffness of the supports.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapCurve {
    /// Such as "1st forward"; without the direction if the machine has none.
    pub label: String,
    /// Ω at every stiffness \[rad/s\]; NaN above the highest speed.
    pub speeds: Vec<f64>,
}

/// Radial stiffness of one or more equal bearings over speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingCurve {
    /// Names of the bearings and direction, such as "A, B (x, y)".
    pub label: String,
    /// Index of one of them, and its direction.
    pub site: usize,
    pub axis: usize,
    /// Stiffness at every speed of the map \[N/m\].
    pub stiffness: Vec<f64>,
}

/// A critical speed with all supports as stiff as a bearing is at that speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapCrossing {
    pub mode: String,
    pub bearing: String,
    /// Ω \[rad/s\].
    pub speed: f64,
    /// k \[N/m\].
    pub stiffness: f64,
}

/// The machine whose supports are varied.
pub struct SupportedRotor<'a> {
    pub assembly: &'a Assembly,
    /// Tangents at standstill, of which the axial stiffness is kept.
    pub standstill: &'a [SiteTangent],
    pub max_speed: f64,
}

impl SupportedRotor<'_> {
    /// Undamped critical speeds of order 1 at a radial stiffness k \[N/m\] of every bearing, and whether all are forward.
    ///
    /// K_xx = K_yy = k and the axial stiffness of each bearing; no cross-coupling, tilting stiffness or damping. Housings and
    /// their springs, bushings, belts and joints keep their own stiffness. Backward, torsional and axial modes are left out.
    ///
    /// # Errors
    /// As [`undamped_critical_speeds`]; matrices too large.
    pub fn critical_speeds(&self, stiffness: f64) -> Result<(Vec<f64>, bool), PhysicsError> {
        let tangent = |own: &SiteTangent| {
            let mut tangent = SiteTangent { stiffness: [[0.0; 6]; 6], damping: [[0.0; 6]; 6] };
            (tangent.stiffness[0][0], tangent.stiffness[1][1]) = (stiffness, stiffness);
            tangent.stiffness[2][2] = own.stiffness[2][2];
            tangent
        };
        let tangents: Vec<SiteTangent> = self.standstill.iter().map(tangent).collect();
        let system = LinearSystem::new(self.assembly, &tangents, 0.0)?;
        let layout = BandLayout::new(&[&system.mass, &system.stiffness, &self.assembly.gyroscopic]);
        let largest = layout.groups().map(<[usize]>::len).max().unwrap_or(0);
        check_dense("the critical speed map", largest, MATRICES, &self.assembly.extent)?;
        let found = undamped_critical_speeds(self.assembly, &system, 1.0, self.max_speed)?;
        let left_out = [ModeKind::Backward, ModeKind::Torsional, ModeKind::Axial];
        let lateral: Vec<_> = found.iter().filter(|c| !left_out.contains(&c.mode.kind)).collect();
        let forward = lateral.iter().all(|c| c.mode.kind == ModeKind::Forward);
        let mut speeds: Vec<f64> = lateral.iter().map(|c| c.speed).collect();
        speeds.dedup_by(|b, a| (*b - *a) <= EQUAL * *b);
        Ok((speeds, forward))
    }

    /// A curve for every mode over stiffnesses \[N/m\], lowest first.
    ///
    /// # Errors
    /// As [`critical_speeds`](Self::critical_speeds).
    pub fn curves(&self, stiffness: &[f64]) -> Result<Vec<MapCurve>, PhysicsError> {
        let found: Vec<(Vec<f64>, bool)> =
            stiffness.par_iter().map(|&k| self.critical_speeds(k)).collect::<Result<_, _>>()?;
        let count = found.iter().map(|(speeds, _)| speeds.len()).max().unwrap_or(0);
        let direction = if found.iter().all(|(_, forward)| *forward) { " forward" } else { " lateral" };
        let curve = |i: usize| MapCurve {
            label: format!("{}{direction}", ordinal(i + 1)),
            speeds: found.iter().map(|(speeds, _)| speeds.get(i).copied().unwrap_or(f64::NAN)).collect(),
        };
        Ok((0..count).map(curve).collect())
    }

    /// Crossings of a curve with a bearing's stiffness over speed, by the sign of k_bearing(Ω(k)) − k.
    ///
    /// # Errors
    /// As [`critical_speeds`](Self::critical_speeds), and those of the tangents.
    pub fn crossings(
        &self,
        (number, curve): (usize, &MapCurve),
        stiffness: &[f64],
        bearing: &BearingCurve,
        tangents: &impl Tangents,
    ) -> Result<Vec<MapCrossing>, PhysicsError> {
        let own = |speed: f64| -> Result<f64, PhysicsError> {
            Ok(tangents(speed)?[bearing.site].stiffness[bearing.axis][bearing.axis])
        };
        let at = |k: f64| -> Result<Option<(f64, f64)>, PhysicsError> {
            let (speeds, _) = self.critical_speeds(k)?;
            let Some(&speed) = speeds.get(number) else { return Ok(None) };
            Ok(Some((speed, (own(speed)? / k).ln())))
        };
        let gaps: Vec<Option<f64>> = stiffness
            .iter()
            .zip(&curve.speeds)
            .map(|(k, speed)| match speed.is_finite() {
                true => own(*speed).map(|own| Some((own / k).ln())),
                false => Ok(None),
            })
            .collect::<Result<_, _>>()?;
        let mut found = Vec::new();
        for i in 1..stiffness.len() {
            let (Some(before), Some(after)) = (gaps[i - 1], gaps[i]) else { continue };
            if !(before.is_finite() && after.is_finite()) || (before > 0.0) == (after > 0.0) {
                continue;
            }
            let ([mut low, mut high], [mut a, mut b]) =
                ([stiffness[i - 1].ln(), stiffness[i].ln()], [before, after]);
            let mut best = None;
            for step in 0..MAX_STEPS {
                // Secant, safeguarded by bisection at every third step.
                let next = if step % 3 == 2 { 0.5 * (low + high) } else { (low * b - high * a) / (b - a) };
                let Some((speed, gap)) = at(next.exp())? else { break };
                best = Some((speed, next.exp()));
                if gap.abs() < TOLERANCE || high - low < TOLERANCE {
                    break;
                }
                if (gap > 0.0) == (a > 0.0) {
                    (low, a) = (next, gap);
                } else {
                    (high, b) = (next, gap);
                }
            }
            let (mode, bearing) = (curve.label.clone(), bearing.label.clone());
            found.extend(best.map(|(speed, stiffness)| MapCrossing { mode, bearing, speed, stiffness }));
        }
        Ok(found)
    }
}
