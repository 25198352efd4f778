//! Undamped critical speeds over the radial stiffness of the bearings.

use super::campbell::Tangents;
use super::critical_speed::{CriticalSpeed, undamped_critical_speeds};
use super::mode::{Mode, ModeKind, inner};
use super::mode_kind::ordinal;
use crate::assembly::dense_limit::check_dense;
use crate::assembly::{Assembly, LinearSystem, PhysicsError};
use rayon::prelude::*;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::{BandLayout, Complex64};
use serde::{Deserialize, Serialize};

/// Dense complex matrices in memory for a group of unknowns, as pairs of real ones.
const MATRICES: usize = 10;
/// Relative distance of the two whirl directions of a rotor without gyroscopic effect.
const EQUAL: f64 = 1e-7;
/// Round-off by which a critical speed may fall where the supports become stiffer.
const FALL: f64 = 1e-7;
/// Share of the orbits' areas by which a mode of circular orbits may deviate from circles.
const CIRCULAR: f64 = 1e-3;
/// Relative change of the stiffness at which a crossing is found, and the most steps to it.
const TOLERANCE: f64 = 1e-10;
const MAX_STEPS: usize = 60;

/// Undamped critical speeds of one mode over the stiffness of the supports.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapCurve {
    /// "1st forward" on supports that are alike along x and y, else "1st lateral".
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

/// An undamped critical speed at one stiffness of the supports.
#[derive(Clone, Debug)]
struct Critical {
    speed: f64,
    kind: ModeKind,
    /// Whether all orbits are circles.
    circular: bool,
    /// Whether another has the same speed, as the two whirl directions without gyroscopic effect: its orbits are any.
    double: bool,
    shape: Vec<Complex64>,
    /// M φ.
    momentum: Vec<Complex64>,
}

impl Critical {
    fn new(assembly: &Assembly, found: CriticalSpeed) -> Self {
        let (speed, mode) = (found.speed, found.mode);
        let momentum = assembly.mass.mul_complex(&mode.shape);
        Self {
            speed,
            kind: mode.kind,
            circular: is_circular(&mode),
            double: false,
            shape: mode.shape,
            momentum,
        }
    }

    fn is_lateral(&self) -> bool {
        !matches!(self.kind, ModeKind::Torsional | ModeKind::Axial)
    }

    /// |φ₁ᴴ M φ₂|².
    fn mac(&self, other: &Self) -> f64 {
        inner(&self.shape, &other.momentum).norm_sqr()
    }
}

fn is_circular(mode: &Mode) -> bool {
    let size = |node: &[Complex64]| node[0].norm_sqr() + node[1].norm_sqr();
    let nodes = || mode.full_shape.chunks(6).map(size).zip(&mode.whirl);
    let whole: f64 = nodes().map(|(size, _)| size).sum();
    nodes().map(|(size, whirl)| size * (1.0 - whirl.abs())).sum::<f64>() <= CIRCULAR * whole
}

/// A critical speed followed over the stiffness of the supports.
pub struct TrackedCurve {
    /// Its critical speed at every stiffness, until it is above the highest speed.
    points: Vec<Option<Critical>>,
    /// What is drawn and stored.
    pub curve: MapCurve,
}

impl TrackedCurve {
    fn new(points: Vec<Option<Critical>>) -> Self {
        let speeds = points.iter().map(|at| at.as_ref().map_or(f64::NAN, |at| at.speed)).collect();
        Self { points, curve: MapCurve { label: String::new(), speeds } }
    }

    fn known(&self) -> impl Iterator<Item = &Critical> {
        self.points.iter().flatten()
    }

    /// Whether most of its points are those of a lateral mode.
    fn is_lateral(&self) -> bool {
        2 * self.known().filter(|at| at.is_lateral()).count() > self.known().count()
    }

    /// Whether most of its points that have a whirl direction are backward.
    fn is_backward(&self) -> bool {
        let single = || self.known().filter(|at| !at.double);
        2 * single().filter(|at| at.kind == ModeKind::Backward).count() > single().count()
    }

    /// Whether it is the curve of the other whirl direction of a rotor without gyroscopic effect.
    fn equals(&self, other: &Self) -> bool {
        let near = |(a, b): (&f64, &f64)| (a.is_nan() && b.is_nan()) || (a - b).abs() <= EQUAL * b.abs();
        self.curve.speeds.iter().zip(&other.curve.speeds).all(near)
    }
}

impl SupportedRotor<'_> {
    /// Undamped critical speeds of order 1 at a radial stiffness k \[N/m\] of every bearing.
    ///
    /// K_xx = K_yy = k and the axial stiffness of each bearing; no cross-coupling, tilting stiffness or damping. Housings and
    /// their springs, bushings, belts and joints keep their own stiffness.
    fn critical_speeds(&self, stiffness: f64) -> Result<Vec<Critical>, PhysicsError> {
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
        let mut found: Vec<Critical> =
            found.into_iter().map(|found| Critical::new(self.assembly, found)).collect();
        for k in 1..found.len() {
            if found[k].speed - found[k - 1].speed <= EQUAL * found[k].speed {
                (found[k - 1].double, found[k].double) = (true, true);
            }
        }
        Ok(found)
    }

    /// A curve for every lateral mode over increasing stiffnesses \[N/m\], lowest first; torsional and axial modes are left out.
    ///
    /// With supports alike along x and y unbalance excites forward modes only, and backward ones are left out; with others it
    /// excites all.
    ///
    /// # Errors
    /// As [`undamped_critical_speeds`]; matrices too large.
    pub fn curves(&self, stiffness: &[f64]) -> Result<Vec<TrackedCurve>, PhysicsError> {
        let found: Vec<Vec<Critical>> =
            stiffness.par_iter().map(|&k| self.critical_speeds(k)).collect::<Result<_, _>>()?;
        let mut curves: Vec<TrackedCurve> = Vec::new();
        for tracked in track(found).into_iter().map(TrackedCurve::new) {
            if tracked.is_lateral() && !curves.iter().any(|curve| curve.equals(&tracked)) {
                curves.push(tracked);
            }
        }
        let single = || curves.iter().flat_map(|curve| curve.known().filter(|at| !at.double));
        let (circular, whirling) = (single().all(|at| at.circular), single().next().is_some());
        if circular {
            curves.retain(|curve| !curve.is_backward());
        }
        let direction = if circular && whirling { "forward" } else { "lateral" };
        for (number, tracked) in curves.iter_mut().enumerate() {
            tracked.curve.label = format!("{} {direction}", ordinal(number + 1));
        }
        Ok(curves)
    }

    /// Crossings of a curve with a bearing's stiffness over speed, by the sign of k_bearing(Ω(k)) − k.
    ///
    /// # Errors
    /// As [`curves`](Self::curves), and those of the tangents.
    pub fn crossings(
        &self,
        tracked: &TrackedCurve,
        stiffness: &[f64],
        bearing: &BearingCurve,
        tangents: &impl Tangents,
    ) -> Result<Vec<MapCrossing>, PhysicsError> {
        let own = |speed: f64| -> Result<f64, PhysicsError> {
            Ok(tangents(speed)?[bearing.site].stiffness[bearing.axis][bearing.axis])
        };
        let curve = &tracked.curve;
        // The critical speed of this curve between two of its points.
        let at = |k: f64, [before, after]: [&Critical; 2]| -> Result<Option<(f64, f64)>, PhysicsError> {
            let range = before.speed * (1.0 - FALL)..=after.speed * (1.0 + FALL);
            let between = self.critical_speeds(k)?.into_iter().filter(|found| range.contains(&found.speed));
            let mac = |found: &Critical| found.mac(before).max(found.mac(after));
            let Some(Critical { speed, .. }) = between.max_by(|a, b| mac(a).total_cmp(&mac(b))) else {
                return Ok(None);
            };
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
            let [Some(first), Some(last)] = [&tracked.points[i - 1], &tracked.points[i]] else { continue };
            if !(before.is_finite() && after.is_finite()) || (before > 0.0) == (after > 0.0) {
                continue;
            }
            let ([mut low, mut high], [mut a, mut b]) =
                ([stiffness[i - 1].ln(), stiffness[i].ln()], [before, after]);
            let mut best = None;
            for step in 0..MAX_STEPS {
                // Secant, safeguarded by bisection at every third step.
                let next = if step % 3 == 2 { 0.5 * (low + high) } else { (low * b - high * a) / (b - a) };
                let Some((speed, gap)) = at(next.exp(), [first, last])? else {
                    break;
                };
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

/// Critical speeds at increasing stiffness followed by the MAC of their shapes, the lowest at the first stiffness first.
///
/// K q = Ω² (M − j G) q is Hermitian and K grows: no critical speed falls, so that a speed is followed by none below it.
fn track(found: Vec<Vec<Critical>>) -> Vec<Vec<Option<Critical>>> {
    let steps = found.len();
    let mut curves: Vec<Vec<Option<Critical>>> = Vec::new();
    for (step, set) in found.into_iter().enumerate() {
        let last = |curve: &[Option<Critical>]| curve.last().cloned().flatten();
        let ends: Vec<Option<Critical>> = curves.iter().map(|curve| last(curve)).collect();
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (i, end) in ends.iter().enumerate().filter_map(|(i, end)| Some((i, end.as_ref()?))) {
            let follows = |next: &Critical| next.speed >= end.speed * (1.0 - FALL);
            let next = set.iter().enumerate().filter(|(_, next)| follows(next));
            pairs.extend(next.map(|(j, next)| (end.mac(next), i, j)));
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut curve_of: Vec<Option<usize>> = vec![None; set.len()];
        let mut continued = vec![false; curves.len()];
        for (_, i, j) in pairs {
            if !continued[i] && curve_of[j].is_none() {
                (continued[i], curve_of[j]) = (true, Some(i));
            }
        }
        curves.iter_mut().for_each(|curve| curve.push(None));
        for (critical, of) in set.into_iter().zip(curve_of) {
            let at = of.unwrap_or(curves.len());
            if at == curves.len() {
                let mut new = Vec::with_capacity(steps);
                new.resize_with(step + 1, || None);
                curves.push(new);
            }
            curves[at][step] = Some(critical);
        }
    }
    curves
}
