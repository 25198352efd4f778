//! Duplex (matched) pair: two rows on one shaft and in one housing.

use crate::{Arrangement, BallBearing, Duplex, Reaction};

impl Duplex {
    /// Axial position of each row relative to the bearing's station \[m\] and its thrust direction.
    ///
    /// The load lines of a row of direction +1 meet the axis on its −z side: back-to-back puts +1 at −z.
    pub(super) fn rows(&self, thrust_direction: f64) -> [(f64, f64); 2] {
        let half = 0.5 * self.spacing;
        match self.arrangement {
            Arrangement::BackToBack => [(-half, 1.0), (half, -1.0)],
            Arrangement::FaceToFace => [(-half, -1.0), (half, 1.0)],
            Arrangement::Tandem => [(-half, thrust_direction), (half, thrust_direction)],
        }
    }
}

impl BallBearing {
    /// Axial position of each row relative to the bearing's station \[m\] and its thrust direction.
    pub fn rows(&self) -> Vec<(f64, f64)> {
        let thrust = self.geometry.thrust_direction;
        self.duplex.map_or(vec![(0.0, thrust)], |pair| pair.rows(thrust).to_vec())
    }

    /// Whether all its rows have the same direction of thrust: a single row, or a tandem pair.
    pub fn takes_thrust_one_way(&self) -> bool {
        self.duplex.is_none_or(|pair| pair.arrangement == Arrangement::Tandem)
    }
}

/// Displacement of the ring at an axial offset h from the station: u_x + h θ_y, u_y − h θ_x.
pub(super) fn displacement_at_offset(place: f64, d: &[f64; 6]) -> [f64; 6] {
    let mut out = *d;
    out[0] += place * d[4];
    out[1] -= place * d[3];
    out
}

/// Transforms the reaction of a row at h to the station: Tᵀ f, Tᵀ K T, Tᵀ C T with T of [`displacement_at_offset`].
pub(super) fn transform_to_station(place: f64, row: &mut Reaction) {
    if place == 0.0 {
        return;
    }
    row.force[4] += place * row.force[0];
    row.force[3] -= place * row.force[1];
    for matrix in [&mut row.stiffness, &mut row.damping] {
        for row in matrix.iter_mut() {
            row[4] += place * row[0];
            row[3] -= place * row[1];
        }
        let [x, y, ..] = *matrix;
        for (row, by, from) in [(4, place, x), (3, -place, y)] {
            for (entry, v) in matrix[row].iter_mut().zip(from) {
                *entry += by * v;
            }
        }
    }
}
