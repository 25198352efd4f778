//! Loads of the reduced equations of motion: sums of fixed vectors with factors that change in time.

use nalgebra::{DMatrix, DVector};

use super::system::System;
use crate::model::Spin;

impl System {
    /// Load p(t) without bearing forces, and under a torque drive without what couples the rotation to the other
    /// coordinates ([`TorqueDrive::add_coupling`](super::torque::TorqueDrive::add_coupling)), written to `out`.
    pub fn load(&self, time: f64, spin: &Spin, out: &mut DVector<f64>) {
        out.fill(0.0);
        for (factor, vector) in self.load_terms(time, spin).filter(|(factor, _)| *factor != 0.0) {
            out.axpy(factor, vector, 1.0);
        }
    }

    /// Terms factor · vector of [`Self::load`]; the vectors are the same at all times, and zero for internal coordinates.
    fn load_terms(&self, time: f64, spin: &Spin) -> impl Iterator<Item = (f64, &DVector<f64>)> {
        self.given_terms(time).chain(self.rotating_terms(spin))
    }

    /// Constant loads and those over time.
    fn given_terms(&self, time: f64) -> impl Iterator<Item = (f64, &DVector<f64>)> {
        let varying = self.varying_loads.iter().map(move |load| (load.factor.at(time), &load.vector));
        [(1.0, &self.static_load)].into_iter().chain(varying)
    }

    /// Loads by the shaft's rotation: unbalance at a given speed, angular acceleration, torque of a drive.
    fn rotating_terms(&self, spin: &Spin) -> impl Iterator<Item = (f64, &DVector<f64>)> {
        let Spin { angle, speed, acceleration } = *spin;
        let given_speed = self.drive.is_none().then(|| {
            let (sin, cos) = angle.sin_cos();
            let square = speed * speed;
            let [along, across] = &self.unbalance;
            [
                (square * cos + acceleration * sin, along),
                (square * sin - acceleration * cos, across),
                (acceleration, &self.spin_inertia),
            ]
        });
        let drive = self
            .drive
            .as_ref()
            .map(|drive| [(acceleration, &self.spin_inertia), (drive.torque_at(speed), &drive.torque)]);
        given_speed.into_iter().flatten().chain(drive.into_iter().flatten())
    }

    /// The terms that do work on the coordinates: under a torque drive the given ones alone.
    pub fn working_terms(&self, time: f64, spin: &Spin) -> impl Iterator<Item = (f64, &DVector<f64>)> {
        let rotating = self.drive.is_none().then(|| self.rotating_terms(spin));
        self.given_terms(time).chain(rotating.into_iter().flatten())
    }

    /// The vectors of [`Self::load`] as columns over the structure's coordinates.
    pub fn load_matrix(&self) -> DMatrix<f64> {
        let at_rest = Spin::default();
        let vectors = self.load_terms(0.0, &at_rest);
        let columns: Vec<_> =
            vectors.map(|(_, vector)| vector.rows(0, self.structure()).into_owned()).collect();
        DMatrix::from_columns(&columns)
    }

    /// Adds the factors of these columns to `out`.
    pub fn extend_by_load_factors(&self, time: f64, spin: &Spin, out: &mut Vec<f64>) {
        out.extend(self.load_terms(time, spin).map(|(factor, _)| factor));
    }
}
