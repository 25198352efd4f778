//! Torsional modes with their interference diagram.

use super::Machine;
use crate::analysis::peaks::separation;
use crate::analysis::torsional::torsional_modes;
use crate::assembly::PhysicsError;
use crate::model::study::TorsionalStudy;
use crate::results::{Interference, TorsionalResult};
use std::f64::consts::TAU;

impl Machine {
    /// Undamped torsional modes of the shaft with its discs, and the speeds at which orders of excitation meet them.
    ///
    /// The rotation of a driven station is fixed, as in the other studies.
    ///
    /// # Errors
    /// An eigenvalue computation that fails.
    pub fn torsional(&self, study: &TorsionalStudy) -> Result<TorsionalResult, PhysicsError> {
        if let Some(machine) = self.decided(&[0.0])? {
            return machine.torsional(study);
        }
        let found = torsional_modes(&self.assembly, &self.linear_system(0.0)?, study.modes)?;
        let operating_speeds = self.operating_speeds(study.operating_speeds);
        let orders = self.order_lines(&study.orders);
        let mut interferences = Vec::new();
        for (k, mode) in found.modes.iter().enumerate() {
            for line in orders.iter().filter(|line| line.order > 0.0) {
                let speed = TAU * mode.frequency_hz / line.order;
                if speed <= study.max_speed {
                    interferences.push(Interference {
                        speed,
                        mode: k + 1,
                        frequency_hz: mode.frequency_hz,
                        order: line.label.clone(),
                        separation: operating_speeds.map(|speeds| separation(speed, speeds)),
                    });
                }
            }
        }
        interferences.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        let (max_speed, z) = (study.max_speed, self.model.node_z.clone());
        Ok(TorsionalResult { max_speed, found, z, orders, operating_speeds, interferences })
    }
}
