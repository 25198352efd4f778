//! Steady-state unbalance response (synchronous, 1x) over speed.

use super::campbell::Tangents;
use super::frf::derivative_factor;
use super::harmonic::HarmonicSystem;
use super::mode_kind::whirl_index;
use super::synchronous::SynchronousLanes;
use crate::assembly::rigid_body_modes::unconstrained_motion;
use crate::assembly::{Assembly, LinearSystem, PhysicsError, Site};
use crate::model::Quantity;
use rayon::prelude::*;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::complex_lanes::{ComplexLanes, LANES};
use rotordyn_linalg::workspaces::{Workspace, Workspaces};
use rotordyn_linalg::{Complex64, SparseRow};

/// Complex amplitudes q(t) = Re(Q e^{jΩt}) at one speed.
#[derive(Clone, Debug, PartialEq)]
pub struct UnbalanceMotion {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// Q over the free DOFs.
    pub amplitude: Vec<Complex64>,
    /// Forces and moments of every bearing on the shaft, F_x F_y F_z M_x M_y M_z \[N, N m\].
    pub bearing_forces: Vec<[Complex64; 6]>,
}

/// Elliptic orbit x = Re(X e^{jΩt}), y = Re(Y e^{jΩt}).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Semi-major axis \[m\].
    pub major: f64,
    /// Semi-minor axis \[m\], positive for forward whirl, negative for backward whirl.
    pub minor: f64,
    /// Angle of the major axis from +x towards +y \[rad\].
    pub inclination: f64,
    /// Whirl index from −1 (backward circle) to 1 (forward circle).
    pub whirl: f64,
}

impl Orbit {
    /// Orbit of two complex amplitudes.
    pub fn new(x: Complex64, y: Complex64) -> Self {
        // x + j y = F e^{jΩt} + B* e^{−jΩt}.
        let turn = Complex64::new(0.0, 1.0);
        let (forward, backward) = (0.5 * (x + turn * y), (0.5 * (x - turn * y)).conj());
        Self {
            major: forward.norm() + backward.norm(),
            minor: forward.norm() - backward.norm(),
            inclination: 0.5 * (forward * backward).arg(),
            whirl: whirl_index(x, y),
        }
    }
}

impl UnbalanceMotion {
    /// Complex amplitude of a row (a probe's direction).
    pub fn amplitude_of(&self, row: &SparseRow, quantity: Quantity) -> Complex64 {
        derivative_factor(quantity, self.speed) * row.dot_complex(&self.amplitude)
    }
}

/// Q = (S − Ω² M + jΩ D)⁻¹ F with F_x = U Ω² e^{jϕ}, F_y = −j F_x at every speed \[rad/s\]; of each motion only what
/// `observe` takes from it is kept.
///
/// # Errors
/// A speed at which the dynamic stiffness is singular, or errors of the tangents.
pub fn response<T: Send>(
    assembly: &Assembly,
    speeds: &[f64],
    tangents: &impl Tangents,
    observe: impl Fn(UnbalanceMotion) -> T + Sync,
) -> Result<Vec<T>, PhysicsError> {
    UnbalanceSolver::new(assembly, tangents).response(speeds, observe)
}

/// The machine of [`response`], for speeds that are not known at once.
pub struct UnbalanceSolver<'a, B> {
    assembly: &'a Assembly,
    tangents: &'a B,
    memory: Workspaces<Option<SynchronousLanes>>,
}

impl<'a, B: Tangents> UnbalanceSolver<'a, B> {
    /// A machine and the tangents of its bearings.
    pub fn new(assembly: &'a Assembly, tangents: &'a B) -> Self {
        Self { assembly, tangents, memory: Workspaces::default() }
    }

    /// What `observe` takes from the motion at every speed \[rad/s\].
    ///
    /// # Errors
    /// As [`response`].
    pub fn response<T: Send>(
        &self,
        speeds: &[f64],
        observe: impl Fn(UnbalanceMotion) -> T + Sync,
    ) -> Result<Vec<T>, PhysicsError> {
        // Groups of speeds do not depend on the number of threads, nor does the result.
        let motions = |memory: &mut Workspace<Option<SynchronousLanes>>, speeds: &[f64]| {
            let at = |&speed: &f64| (self.tangents)(speed);
            let tangents: Vec<_> = speeds.iter().map(at).collect::<Result<_, _>>()?;
            let amplitudes = amplitudes(self.assembly, speeds, &tangents, memory)?;
            let motion = |((q, &speed), tangents): ((Vec<Complex64>, &f64), &Vec<SiteTangent>)| {
                observe(motion(self.assembly, speed, tangents, q))
            };
            Ok(amplitudes.into_iter().zip(speeds).zip(&tangents).map(motion).collect())
        };
        let found: Vec<Vec<T>> = speeds
            .par_chunks(LANES)
            .map_init(|| self.memory.take(|| None), motions)
            .collect::<Result<_, PhysicsError>>()?;
        Ok(found.into_iter().flatten().collect())
    }
}

fn motion(
    assembly: &Assembly,
    speed: f64,
    tangents: &[SiteTangent],
    amplitude: Vec<Complex64>,
) -> UnbalanceMotion {
    let sites = assembly.sites.iter().zip(tangents);
    let bearing_forces = sites.map(|(site, t)| bearing_force(site, t, &amplitude, speed)).collect();
    UnbalanceMotion { speed, amplitude, bearing_forces }
}

/// Amplitudes Q at up to [`LANES`] speeds, all at once where their matrices allow it.
fn amplitudes(
    assembly: &Assembly,
    speeds: &[f64],
    tangents: &[Vec<SiteTangent>],
    memory: &mut Option<SynchronousLanes>,
) -> Result<Vec<Vec<Complex64>>, PhysicsError> {
    let loads: Vec<Vec<Complex64>> =
        speeds.iter().map(|&speed| assembly.unbalance_amplitude(speed)).collect();
    if let Some(found) = amplitudes_at_once(assembly, speeds, tangents, &loads, memory) {
        return Ok(found);
    }
    let one = |((&speed, tangents), mut amplitude): ((&f64, &Vec<SiteTangent>), Vec<Complex64>)| {
        let system = LinearSystem::new(assembly, tangents, speed)?;
        let harmonic = HarmonicSystem::new(&system, Some(&reached(&amplitude)));
        let mut solver = harmonic.solver();
        solver.factor(speed).map_err(|pivot| PhysicsError::Singular {
            motion: unconstrained_motion(assembly, &system, pivot.unknown),
        })?;
        solver.solve(&mut amplitude);
        Ok(amplitude)
    };
    speeds.iter().zip(tangents).zip(loads).map(one).collect()
}

/// The same in one factorisation; `None` where the speeds are to be taken one by one.
fn amplitudes_at_once(
    assembly: &Assembly,
    speeds: &[f64],
    tangents: &[Vec<SiteTangent>],
    loads: &[Vec<Complex64>],
    memory: &mut Option<SynchronousLanes>,
) -> Option<Vec<Vec<Complex64>>> {
    let ((first, others), bearings) = (loads.split_first()?, tangents.first()?);
    let (rows, alone) = (reached(first), others.is_empty());
    // At standstill nothing is reached.
    if alone || rows.is_empty() || others.iter().any(|load| reached(load) != rows) {
        return None;
    }
    if memory.as_ref().is_none_or(|lanes| !lanes.suits(bearings, &rows)) {
        *memory = SynchronousLanes::new(assembly, bearings, &rows);
    }
    let lanes = memory.as_mut()?;
    let whole =
        tangents.iter().all(|tangents| lanes.suits(tangents, &rows)) && lanes.factor(speeds, tangents);
    whole.then(|| {
        let mut q = vec![ComplexLanes::default(); first.len()];
        for (lane, load) in loads.iter().enumerate() {
            q.iter_mut().zip(load).for_each(|(q, &f)| q.set_lane(lane, f));
        }
        lanes.solve(&mut q);
        (0..loads.len()).map(|lane| q.iter().map(|q| q.lane(lane)).collect()).collect()
    })
}

/// Unknowns that a load acts on.
fn reached(load: &[Complex64]) -> Vec<usize> {
    (0..load.len()).filter(|&i| load[i] != Complex64::default()).collect()
}

/// Force of a bearing on the shaft, F = −(K + jΩ C) d with its relative displacement d.
fn bearing_force(site: &Site, tangent: &SiteTangent, q: &[Complex64], speed: f64) -> [Complex64; 6] {
    let d: [Complex64; 6] = std::array::from_fn(|i| site.rows[i].dot_complex(q));
    std::array::from_fn(|i| {
        let (k, c) = (&tangent.stiffness[i], &tangent.damping[i]);
        -(0..6).map(|j| Complex64::new(k[j], speed * c[j]) * d[j]).sum::<Complex64>()
    })
}
