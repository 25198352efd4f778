//! The place of a bearing among the rows and internal coordinates of the reduced system.

use std::ops::Range;
use std::sync::Arc;

use rotordyn_bearing::internal::Motion;
use rotordyn_bearing::{BearingElement, Reaction, Rotation};

/// A nonlinear bearing of the reduced system and the rows of W that give its relative displacement.
#[derive(Clone, Debug)]
pub struct Interface {
    pub name: String,
    pub element: Arc<dyn BearingElement>,
    /// First row of W and number of rows: the relative degrees of freedom of the bearing and, if it has internal
    /// coordinates that need them, the displacements of a housing that moves.
    pub first_row: usize,
    pub rows: usize,
    /// Index of the first internal coordinate and their number.
    pub first_internal: usize,
    pub internal: usize,
    /// Index of the first entry of its blocks rows × rows and internal coordinates × rows among those of all interfaces.
    pub first_stiffness: usize,
    pub first_tangent: usize,
    /// Index of the first state of free bodies and their number.
    pub first_body_state: usize,
    pub body_states: usize,
    /// Cage angle at the start \[rad\].
    pub cage_angle: f64,
    /// Cage angle over shaft angle \[rad\], increasing, instead of a cage that rolls without slip.
    pub cage_angles: Option<Vec<[f64; 2]>>,
    /// Whether θ_z, the twist, leaves out a rotation with an inertia of its own (torque drive): its rate is then the
    /// speed of the shaft plus that of the twist.
    pub free_rotation: bool,
}

impl Interface {
    /// Its rows of W.
    pub fn row_range(&self) -> Range<usize> {
        self.first_row..self.first_row + self.rows
    }

    /// Its internal coordinates among those of all interfaces.
    pub fn internal_range(&self) -> Range<usize> {
        self.first_internal..self.first_internal + self.internal
    }

    /// Its effective stiffness, rows × rows, among those of the interfaces with internal coordinates.
    pub fn stiffness_range(&self) -> Range<usize> {
        self.first_stiffness..self.first_stiffness + if self.internal > 0 { self.rows * self.rows } else { 0 }
    }

    /// Tangent of the forces on its internal coordinates, coordinates × rows, among those of all interfaces.
    pub fn tangent_range(&self) -> Range<usize> {
        self.first_tangent..self.first_tangent + self.internal * self.rows
    }

    /// States of its free bodies among those of all interfaces.
    pub fn body_range(&self) -> Range<usize> {
        self.first_body_state..self.first_body_state + self.body_states
    }

    /// Whether its energy follows from the displacements of its rows alone.
    pub fn has_no_inertia(&self) -> bool {
        self.internal == 0 && self.body_states == 0
    }

    /// Whether rolling elements in a kinematic cage turn with the shaft.
    pub fn has_cage(&self) -> bool {
        self.element.rolling_elements() > 0 && self.body_states == 0
    }

    /// Reaction at displacements and velocities of all interfaces.
    pub(super) fn reaction(&self, d: &[f64], d_rate: &[f64], rotation: &Rotation) -> Reaction {
        let [at, rate] = self.motion(d, d_rate, rotation);
        self.element.reaction(&at, &rate, rotation)
    }

    /// Motion of its rows, and of the shaft where free bodies take it: with a torque drive the whole rotation of the shaft
    /// about z is that of the rows, so that its work is.
    pub(super) fn ring_motion(&self, d: &[f64], d_rate: &[f64], rotation: &Rotation) -> RowMotion {
        let mut out = RowMotion { rows: self.rows, rotation: *rotation, ..RowMotion::default() };
        out.position[..self.rows].copy_from_slice(&d[self.row_range()]);
        out.velocity[..self.rows].copy_from_slice(&d_rate[self.row_range()]);
        if self.free_rotation {
            out.position[5] += rotation.shaft_angle;
            out.velocity[5] += rotation.shaft_speed;
            (out.rotation.shaft_angle, out.rotation.shaft_speed) = (0.0, 0.0);
        }
        out
    }

    /// Its relative displacement and velocity among those of all interfaces; for a bearing without internal coordinates,
    /// which has at most six rows.
    pub fn motion(&self, d: &[f64], d_rate: &[f64], rotation: &Rotation) -> [[f64; 6]; 2] {
        let [at, mut rate] = [d, d_rate].map(|all| {
            let mut own = [0.0; 6];
            let rows = self.rows.min(6);
            own[..rows].copy_from_slice(&all[self.first_row..self.first_row + rows]);
            own
        });
        if self.free_rotation && self.rows == 6 {
            rate[5] += rotation.shaft_speed;
        }
        [at, rate]
    }
}

/// Motion of the rows of a bearing with free bodies, at most those of two bodies in space, and of its shaft.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RowMotion {
    rows: usize,
    position: [f64; 12],
    velocity: [f64; 12],
    pub rotation: Rotation,
}

impl RowMotion {
    pub fn rows(&self) -> Motion<'_> {
        Motion { position: &self.position[..self.rows], velocity: &self.velocity[..self.rows] }
    }
}

/// Tangents of the bearings with internal coordinates in an implicit step, block by block.
#[derive(Clone, Debug, Default)]
pub struct StepTangents {
    /// Effective stiffness, rows × rows, with the internal coordinates condensed.
    pub stiffness: Vec<f64>,
    /// −∂(force on internal coordinates)/∂(rows).
    pub internal_force: Vec<f64>,
}

impl StepTangents {
    pub fn new(interfaces: &[Interface]) -> Self {
        let end = interfaces.last();
        Self {
            stiffness: vec![0.0; end.map_or(0, |i| i.stiffness_range().end)],
            internal_force: vec![0.0; end.map_or(0, |i| i.tangent_range().end)],
        }
    }
}
