//! Forces in bearings and shaft under unbalance.

use super::Machine;
use crate::analysis::section_loads::ShaftSections;
use crate::analysis::shaft_loads::{ShaftAmplitude, ShaftAmplitudes, under_unbalance};
use crate::analysis::unbalance::{self, UnbalanceResponse};
use crate::assembly::PhysicsError;
use crate::model::Drive;
use crate::model::study::UnbalanceStudy;
use crate::results::{BearingForce, UndampedPeak};
use rotordyn_linalg::Complex64;

impl Machine {
    /// Lowest and highest operating speed \[rad/s\]: those of the study, else the highest of a prescribed profile.
    pub(super) fn operating_speeds(&self, study: &UnbalanceStudy) -> Option<[f64; 2]> {
        let top = self.model.profile.top_speed();
        let prescribed = matches!(self.model.drive, Drive::Prescribed { .. });
        study.operating_speeds.or((top > 0.0 && prescribed).then_some([top; 2]))
    }

    /// Force of every bearing over speed; infinite where the response is.
    pub(super) fn bearing_forces(
        &self,
        response: &UnbalanceResponse,
        undamped: &[UndampedPeak],
    ) -> Vec<BearingForce> {
        let force = |(k, site): (usize, &crate::assembly::Site)| {
            let along = |axis: usize| -> Vec<[f64; 2]> {
                let value = |(speed, forces): (&f64, &Vec<[Complex64; 6]>)| {
                    let infinite = undamped.iter().any(|peak| peak.covers(*speed));
                    if infinite { [f64::INFINITY, 0.0] } else { [forces[k][axis].re, forces[k][axis].im] }
                };
                response.speeds.iter().zip(&response.bearing_forces).map(value).collect()
            };
            let [x, y, ..] = self.standstill_equilibrium.bearings[k].force;
            BearingForce { name: site.name.clone(), x: along(0), y: along(1), at_rest: [x, y] }
        };
        self.assembly.sites.iter().enumerate().map(force).collect()
    }

    /// Amplitudes along the shaft where its bending moment is largest, and at the highest operating speed if that lies
    /// within the speeds of the response.
    pub(super) fn shaft_amplitudes(
        &self,
        response: &UnbalanceResponse,
        undamped: &[UndampedPeak],
        operating: Option<[f64; 2]>,
    ) -> Result<Vec<ShaftAmplitudes>, PhysicsError> {
        let shaft = ShaftSections::new(&self.model);
        let along = |q: &[Complex64], speed: f64| {
            under_unbalance(&self.model, &shaft, &self.assembly.dofs.expand_complex(q), speed)
        };
        let bending = |points: &[ShaftAmplitude]| ShaftAmplitude::largest(points, |p| p.moment).map(|l| l.1);
        let finite = |speed: &f64| *speed > 0.0 && !undamped.iter().any(|peak| peak.covers(*speed));
        let all = response.speeds.iter().zip(&response.amplitudes).filter(|(speed, _)| finite(speed));
        let moments = all.filter_map(|(speed, q)| {
            let points = along(q, *speed);
            Some((bending(&points)?, *speed, points))
        });
        let mut out = Vec::new();
        if let Some((_, speed, points)) = moments.max_by(|a, b| a.0.total_cmp(&b.0)) {
            out.push(ShaftAmplitudes { speed, reason: "largest bending moment".into(), points });
        }
        let within = |speed: &f64| {
            let ends = response.speeds.first().zip(response.speeds.last());
            ends.is_some_and(|(first, last)| (first..=last).contains(&speed)) && finite(speed)
        };
        if let (Some(speed), false) = (operating.map(|speeds| speeds[1]).filter(within), out.is_empty()) {
            let tangents = |speed| self.tangents(speed, true);
            let found = unbalance::response(&self.assembly, &[speed], &tangents)?;
            let points = along(&found.amplitudes[0], speed);
            out.push(ShaftAmplitudes { speed, reason: "highest operating speed".into(), points });
        }
        Ok(out)
    }
}
