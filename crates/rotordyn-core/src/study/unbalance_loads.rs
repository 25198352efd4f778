//! Forces in bearings and shaft under unbalance.

use super::Machine;
use crate::analysis::section_loads::ShaftSections;
use crate::analysis::shaft_loads::{ShaftAmplitudes, largest_moment, under_unbalance};
use crate::analysis::unbalance::{self, UnbalanceMotion};
use crate::assembly::{PhysicsError, Site};
use crate::results::{BearingForce, UndampedPeak};
use rotordyn_linalg::{Complex64, SparseRow};

/// What is kept of the motion under unbalance at one speed.
pub(super) struct UnbalanceSample {
    /// Amplitudes of the observed rows.
    pub observed: Vec<Complex64>,
    pub bearings: Vec<BearingSample>,
    /// Largest bending moment along the shaft \[N m\]; `None` for a rigid rotor.
    pub bending: Option<f64>,
}

/// A bearing under unbalance at one speed.
pub(super) struct BearingSample {
    /// F_x and F_y on the shaft \[N\].
    pub force: [Complex64; 2],
    /// u_x and u_y of the shaft relative to the housing \[m\].
    pub displacement: [Complex64; 2],
}

impl Machine {
    /// Lowest and highest operating speed \[rad/s\]: those stated, else the highest of the profile, also where a torque drives and the
    /// profile is what the machine is to reach.
    pub(super) fn operating_speeds(&self, stated: Option<[f64; 2]>) -> Option<[f64; 2]> {
        let top = self.model.profile.top_speed();
        stated.or((top > 0.0).then_some([top; 2]))
    }

    /// What is kept of the motion at one speed: the amplitudes of the rows `observed`, forces and moments.
    pub(super) fn observe(
        &self,
        motion: UnbalanceMotion,
        observed: &[&SparseRow],
        shaft: &ShaftSections,
    ) -> UnbalanceSample {
        let q = &motion.amplitude;
        let bearing = |(site, force): (&Site, &[Complex64; 6])| BearingSample {
            force: [force[0], force[1]],
            displacement: [0, 1].map(|axis| site.rows[axis].dot_complex(q)),
        };
        let sections = shaft.at_speed(&self.assembly.dofs.expand_complex(q), motion.speed);
        UnbalanceSample {
            observed: observed.iter().map(|row| row.dot_complex(q)).collect(),
            bearings: self.assembly.sites.iter().zip(&motion.bearing_forces).map(bearing).collect(),
            bending: sections.iter().map(largest_moment).max_by(f64::total_cmp),
        }
    }

    /// Force of every bearing over speed; infinite where the response is.
    pub(super) fn bearing_forces(
        &self,
        speeds: &[f64],
        samples: &[UnbalanceSample],
        undamped: &[UndampedPeak],
    ) -> Vec<BearingForce> {
        let force = |(k, site): (usize, &Site)| {
            let along = |axis: usize| -> Vec<[f64; 2]> {
                let value = |(speed, sample): (&f64, &UnbalanceSample)| {
                    let infinite = undamped.iter().any(|peak| peak.covers(*speed));
                    let force = sample.bearings[k].force[axis];
                    if infinite { [f64::INFINITY, 0.0] } else { [force.re, force.im] }
                };
                speeds.iter().zip(samples).map(value).collect()
            };
            let [x, y, ..] = self.standstill_equilibrium.bearings[k].force;
            BearingForce { name: site.name.clone(), x: along(0), y: along(1), at_rest: [x, y] }
        };
        self.assembly.sites.iter().enumerate().map(force).collect()
    }

    /// Amplitudes along the shaft where its bending moment is largest, and at the highest operating speed if that lies
    /// within the speeds of the response. With an undamped mode the moment has no largest value, but that of the grid.
    pub(super) fn shaft_amplitudes(
        &self,
        shaft: &ShaftSections,
        (speeds, samples): (&[f64], &[UnbalanceSample]),
        undamped: &[UndampedPeak],
        operating: Option<[f64; 2]>,
    ) -> Result<Vec<ShaftAmplitudes>, PhysicsError> {
        let finite = |speed: &f64| *speed > 0.0 && !undamped.iter().any(|peak| peak.covers(*speed));
        let moments = speeds.iter().zip(samples).filter(|(speed, _)| finite(speed));
        let moments = moments.filter_map(|(speed, sample)| Some((sample.bending?, *speed)));
        let Some((_, largest)) = moments.max_by(|a, b| a.0.total_cmp(&b.0)) else { return Ok(Vec::new()) };
        let largest = undamped.is_empty().then_some((largest, "largest bending moment"));
        let within = |speed: &f64| {
            let ends = speeds.first().zip(speeds.last());
            ends.is_some_and(|(first, last)| (first..=last).contains(&speed)) && finite(speed)
        };
        let highest = operating.map(|speeds| speeds[1]).filter(within);
        let mut wanted: Vec<(f64, &str)> = largest.into_iter().collect();
        wanted.extend(highest.map(|speed| (speed, "highest operating speed")));
        let at: Vec<f64> = wanted.iter().map(|(speed, _)| *speed).collect();
        let tangents = |speed| self.tangents(speed, true);
        let along = |motion: UnbalanceMotion| {
            let q = self.assembly.dofs.expand_complex(&motion.amplitude);
            under_unbalance(&self.model, shaft, &q, motion.speed)
        };
        let found = unbalance::response(&self.assembly, &at, &tangents, along)?;
        let amplitudes = |((speed, reason), points): ((f64, &str), _)| ShaftAmplitudes {
            speed,
            reason: reason.into(),
            points,
        };
        Ok(wanted.into_iter().zip(found).map(amplitudes).collect())
    }
}

/// Displacement of the shaft in every bearing over speed.
pub(super) fn bearing_displacements(samples: &[UnbalanceSample]) -> Vec<Vec<[Complex64; 2]>> {
    let bearings = samples.first().map_or(0, |sample| sample.bearings.len());
    (0..bearings).map(|k| samples.iter().map(|sample| sample.bearings[k].displacement).collect()).collect()
}
