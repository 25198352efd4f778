//! Harmonic responses: FRFs and the unbalance response, on grids refined around resonances.

use super::Machine;
use super::unbalance_loads::{UnbalanceSample, bearing_displacements};
use super::unbalance_peaks::response_peaks;
use crate::analysis::frf::{Frf, FrfSolver, derivative_factor};
use crate::analysis::poles::{Pole, frf_poles, synchronous_poles};
use crate::analysis::refine::{RefinedGrid, refine};
use crate::analysis::section_loads::ShaftSections;
use crate::analysis::separation::separation_margins;
use crate::analysis::unbalance::{UnbalanceMotion, UnbalanceSolver};
use crate::assembly::PhysicsError;
use crate::element::Anchor;
use crate::model::study::{Excitation, FrfStudy, UnbalanceStudy};
use crate::model::{Probe, Quantity};
use crate::results::{
    DiscOrbit, FrfResult, LeastDampedMode, UnbalanceChannel, UnbalanceResult, UndampedPeak, is_rotation,
    unit_of,
};
use rayon::prelude::*;
use rotordyn_linalg::{Complex64, SparseRow};
use std::f64::consts::TAU;

/// Names of an excitation that say nothing of its place.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Width of the range searched for poles around a single frequency or speed, relative to it.
const SINGLE_POINT_RANGE: f64 = 1e-3;

impl Machine {
    /// An excitation of the FRF study as it is shown: one that is named like an axis with the item on which it acts,
    /// "x at disc.pulley".
    pub fn excitation_label(&self, name: &str) -> String {
        let study = self.model.studies.frf.as_ref();
        let found = study.and_then(|study| study.excitations.iter().find(|of| of.name == name));
        let node = found.filter(|_| AXES.contains(&name)).and_then(|excitation| excitation.at.node);
        let at = |of: usize| node == Some(of);
        let model = &self.model;
        let item = if let Some(disc) = model.discs.iter().find(|disc| at(disc.node)) {
            format!("disc.{}", disc.name)
        } else if model.rigid_rotor.as_ref().is_some_and(|rotor| at(rotor.node)) {
            "rotor".to_string()
        } else if let Some(station) = model.stations.iter().find(|station| at(station.node)) {
            format!("station.{}", station.name)
        } else {
            return name.into();
        };
        format!("{name} at {item}")
    }

    /// Frequency response functions at a speed.
    ///
    /// # Errors
    /// A singular dynamic stiffness.
    pub fn frf(&self, study: &FrfStudy) -> Result<FrfResult, PhysicsError> {
        if let Some(machine) = self.decided(&[study.speed])? {
            return machine.frf(study);
        }
        self.check_tables("frf", &[study.speed])?;
        let system = self.linear_system(study.speed)?;
        let row = |at: &Anchor, direction| self.assembly.direction_row(at, direction);
        let excitations: Vec<_> = study.excitations.iter().map(|e| row(&e.at, &e.direction)).collect();
        let responses: Vec<_> = study.responses.iter().map(|p| row(&p.at, &p.direction)).collect();
        let (f, q) = (&study.frequencies, study.quantity);
        let highest = f.iter().copied().fold(0.0, f64::max);
        let poles = if highest > 0.0 { frf_poles(&self.assembly, &system, highest)? } else { Vec::new() };
        let least = poles.iter().min_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio));
        let least_damped = least.map(|p| LeastDampedMode {
            label: p.label.clone(),
            // A growth within round-off is none.
            damping_ratio: if p.is_unstable() { p.damping_ratio } else { p.damping_ratio.max(0.0) },
        });
        let solver = FrfSolver::new(&self.assembly, &system, &excitations, &responses, q);
        let evaluate = |hz: &[f64]| match self.has_whirl_tables() {
            true => self.frf_at_whirl(study.speed, hz, [&excitations, &responses], q),
            false => solver.at(hz),
        };
        let RefinedGrid { points, samples, requested } =
            refined(f, &poles, study.refine, evaluate, |h| h.clone())?;
        let force = |e: &SparseRow| dense(e, self.assembly.dofs.len());
        let name = |r: usize, e: usize| format!("{}/{}", study.responses[r].name, study.excitations[e].name);
        let appears_in = |pole: &Pole| -> Vec<String> {
            let pairs = (0..responses.len()).flat_map(|r| (0..excitations.len()).map(move |e| (r, e)));
            pairs
                .filter(|&(r, e)| {
                    appears(pole, &[&responses[r]]) && pole.is_excited_by(&force(&excitations[e]))
                })
                .map(|(r, e)| name(r, e))
                .collect()
        };
        let undamped = undamped_peaks(&poles, &points, appears_in);
        let value = |r: usize, e: usize| -> Vec<Complex64> {
            let (at, name) = (e * responses.len() + r, name(r, e));
            let values = samples.iter().map(|sample| sample[at]).collect();
            with_infinite(&points, values, &undamped, &name)
        };
        let values =
            (0..responses.len()).map(|r| (0..excitations.len()).map(|e| value(r, e)).collect()).collect();
        let unit = |response: &Probe, excitation: &Excitation| {
            let moved = unit_of(q, is_rotation(&response.direction));
            let moved = if moved.contains('/') { format!("({moved})") } else { moved.into() };
            format!("{moved}/{}", if is_rotation(&excitation.direction) { "(N m)" } else { "N" })
        };
        Ok(FrfResult {
            speed: study.speed,
            units: study
                .responses
                .iter()
                .map(|r| study.excitations.iter().map(|e| unit(r, e)).collect())
                .collect(),
            excitations: study.excitations.iter().map(|e| e.name.clone()).collect(),
            responses: study.responses.iter().map(|p| p.name.clone()).collect(),
            frf: Frf { frequencies: points, quantity: q, values },
            requested,
            undamped,
            least_damped,
        })
    }

    /// As [`FrfSolver::at`], with the bearings at the whirl frequency.
    fn frf_at_whirl(
        &self,
        speed: f64,
        frequencies: &[f64],
        [excitations, responses]: [&[SparseRow]; 2],
        quantity: Quantity,
    ) -> Result<Vec<Vec<Complex64>>, PhysicsError> {
        let tangents = self.tangents(speed, true)?;
        let at = |&hz: &f64| {
            let system = self.linear_system_with_whirl(&tangents, speed, hz * TAU)?;
            FrfSolver::new(&self.assembly, &system, excitations, responses, quantity).at(&[hz])
        };
        let found: Vec<_> = frequencies.par_iter().map(at).collect::<Result<_, PhysicsError>>()?;
        Ok(found.into_iter().flatten().collect())
    }

    /// Steady unbalance response over speed.
    ///
    /// # Errors
    /// A singular dynamic stiffness.
    pub fn unbalance(&self, study: &UnbalanceStudy) -> Result<UnbalanceResult, PhysicsError> {
        if let Some(machine) = self.decided(&study.speeds)? {
            return machine.unbalance(study);
        }
        self.check_tables("unbalance", &study.speeds)?;
        let tangents = |speed| self.tangents(speed, true);
        let probe_rows: Vec<SparseRow> =
            study.responses.iter().map(|p| self.assembly.direction_row(&p.at, &p.direction)).collect();
        let discs: Vec<(&str, [SparseRow; 2])> = self
            .model
            .rotating_inertias()
            .map(|disc| {
                let [x, y, ..] = self.assembly.anchor_rows(&Anchor::node(disc.node));
                (disc.name.as_str(), [x, y])
            })
            .collect();
        let observed: Vec<&SparseRow> =
            probe_rows.iter().chain(discs.iter().flat_map(|(_, rows)| rows)).collect();
        let lowest = study.speeds.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = study.speeds.iter().copied().fold(0.0, f64::max);
        let range = match highest > lowest {
            true => [lowest, highest],
            false => [highest * (1.0 - SINGLE_POINT_RANGE), highest * (1.0 + SINGLE_POINT_RANGE)],
        };
        let (poles, unstable) = synchronous_poles(&self.assembly, range, &tangents, &self.table_speeds())?;
        let shaft = ShaftSections::new(&self.model);
        let observe = |motion: UnbalanceMotion| self.observe(motion, &observed, &shaft);
        let path = self.equilibrium_path(&study.speeds, study.speeds.len());
        let tangents = |speed| self.tangents_on(path.as_ref(), speed);
        let solver = UnbalanceSolver::new(&self.assembly, &tangents);
        let evaluate = |speeds: &[f64]| solver.response(speeds, observe);
        let RefinedGrid { points: speeds, samples, requested } =
            refined(&study.speeds, &poles, study.refine, evaluate, |sample| sample.observed.clone())?;
        let along = |row: usize, quantity| -> Vec<Complex64> {
            let value = |(speed, sample): (&f64, &UnbalanceSample)| {
                derivative_factor(quantity, *speed) * sample.observed[row]
            };
            speeds.iter().zip(&samples).map(value).collect()
        };

        let orbit_name = |name: &str| format!("orbit of disc.{name}");
        let orbit_names: Vec<String> = discs.iter().map(|(name, _)| orbit_name(name)).collect();
        let mut rows: Vec<(&str, Vec<&SparseRow>)> =
            study.responses.iter().zip(&probe_rows).map(|(p, row)| (p.name.as_str(), vec![row])).collect();
        rows.extend(
            orbit_names.iter().zip(&discs).map(|(name, (_, rows))| (name.as_str(), rows.iter().collect())),
        );
        let appears_in = |pole: &Pole| -> Vec<String> {
            let excited = pole.is_excited_by(&self.assembly.unbalance_amplitude(pole.at));
            let shown = rows.iter().filter(|(_, rows)| excited && appears(pole, rows));
            shown.map(|(name, _)| (*name).to_string()).collect()
        };
        let undamped = undamped_peaks(&poles, &speeds, appears_in);
        let plain = |name: &str, values: Vec<Complex64>| -> Vec<[f64; 2]> {
            let values = with_infinite(&speeds, values, &undamped, name);
            values.iter().map(|v| [v.re, v.im]).collect()
        };
        let channels_of = |quantity: Option<Quantity>| -> Vec<UnbalanceChannel> {
            let channel = |(row, probe): (usize, &Probe)| {
                let probe = Probe { quantity: quantity.unwrap_or(probe.quantity), ..probe.clone() };
                let amplitude = plain(&probe.name, along(row, probe.quantity));
                UnbalanceChannel { probe, amplitude }
            };
            study.responses.iter().enumerate().map(channel).collect()
        };
        let channels = channels_of(None);
        let orbits: Vec<DiscOrbit> = discs
            .iter()
            .enumerate()
            .map(|(disc, (name, _))| {
                let row = probe_rows.len() + 2 * disc;
                let along = |row| plain(&orbit_name(name), along(row, Quantity::Displacement));
                DiscOrbit { name: (*name).to_string(), x: along(row), y: along(row + 1) }
            })
            .collect();
        let peaks = response_peaks(&speeds, &channels, &orbits, &undamped);
        let operating_speeds = self.operating_speeds(study.operating_speeds);
        let excited = |pole: &Pole| pole.is_excited_by(&self.assembly.unbalance_amplitude(pole.at));
        // Margins are those of displacements: a derivative's factor of speed widens its peaks to one side.
        let displacements = channels_of(Some(Quantity::Displacement));
        let named: Vec<_> = response_peaks(&speeds, &displacements, &orbits, &undamped)
            .into_iter()
            .map(|peak| (peak.response, peak.peak))
            .collect();
        let within: Vec<Pole> =
            poles.into_iter().filter(|pole| (range[0]..=range[1]).contains(&pole.at)).collect();
        Ok(UnbalanceResult {
            margins: separation_margins(&within, &named, excited, operating_speeds),
            bearing_forces: self.bearing_forces(&speeds, &samples, &undamped),
            shaft: self.shaft_amplitudes(&shaft, (&speeds, &samples), &undamped, operating_speeds)?,
            bearing_displacements: bearing_displacements(&samples),
            peaks,
            operating_speeds,
            speeds,
            requested,
            channels,
            orbits,
            undamped,
            unstable: unstable.into_iter().next(),
        })
    }
}

/// A response with infinity at the points that lie on its undamped poles.
fn with_infinite(
    points: &[f64],
    values: Vec<Complex64>,
    undamped: &[UndampedPeak],
    response: &str,
) -> Vec<Complex64> {
    let infinite = |x: f64| undamped.iter().any(|p| p.covers(x) && p.responses.iter().any(|r| r == response));
    let value = |(x, v): (&f64, Complex64)| if infinite(*x) { f64::INFINITY.into() } else { v };
    points.iter().zip(values).map(value).collect()
}

/// The grid with or without refinement; one that does not increase is left as it is.
fn refined<T>(
    grid: &[f64],
    poles: &[Pole],
    wanted: bool,
    evaluate: impl Fn(&[f64]) -> Result<Vec<T>, PhysicsError>,
    curves: impl Fn(&T) -> Vec<Complex64>,
) -> Result<RefinedGrid<T>, PhysicsError> {
    if wanted && grid.windows(2).all(|pair| pair[0] < pair[1]) {
        return refine(grid, poles, evaluate, curves);
    }
    Ok(RefinedGrid { points: grid.to_vec(), samples: evaluate(grid)?, requested: (0..grid.len()).collect() })
}

/// Force of unit size along a row, over all free DOFs.
fn dense(row: &SparseRow, size: usize) -> Vec<Complex64> {
    let mut force = vec![Complex64::default(); size];
    row.0.iter().for_each(|&(i, v)| force[i] += v);
    force
}

/// Whether a mode moves any of some rows.
fn appears(pole: &Pole, rows: &[&SparseRow]) -> bool {
    let size = pole.shape.iter().map(|v| v.norm()).fold(0.0, f64::max);
    rows.iter().any(|row| row.dot_complex(&pole.shape).norm() > 1e-6 * size)
}

/// Undamped poles within the grid that appear in any response.
fn undamped_peaks(
    poles: &[Pole],
    points: &[f64],
    appears_in: impl Fn(&Pole) -> Vec<String>,
) -> Vec<UndampedPeak> {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return Vec::new() };
    let range = first * (1.0 - UndampedPeak::WIDTH)..=last * (1.0 + UndampedPeak::WIDTH);
    poles
        .iter()
        .filter(|pole| pole.is_undamped() && range.contains(&pole.at))
        .map(|pole| UndampedPeak { at: pole.at, label: pole.label.clone(), responses: appears_in(pole) })
        .filter(|peak| !peak.responses.is_empty())
        .collect()
}
