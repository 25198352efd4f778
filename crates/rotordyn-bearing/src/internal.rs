//! Internal coordinates of a bearing: rolling elements, or other parts, that move with masses of their own.
//!
//! A bearing with internal coordinates y acts on interface rows r: its relative degrees of freedom d, then the
//! displacements of the housing h that it needs. Forces F(r, ṙ, y, ẏ) act on the rows and Q(r, ṙ, y, ẏ) on the
//! coordinates, m_k ÿ_k = Q_k. Statics and linear studies have y in equilibrium ([`BearingElement::reaction`]);
//! explicit steps take the coordinates as given, implicit steps solve them inside the step.
//!
//! [`BearingElement::reaction`]: crate::BearingElement::reaction

use crate::reaction::{Reaction, Rotation};

/// Newmark coefficients of a step: positions x̂ + `position` a and velocities v̂ + `velocity` a with accelerations a at its
/// end; an internal coordinate has a = Q/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewmarkGain {
    /// g β h² \[s²\] and g γ h \[s\], g the share of a in the integrator's acceleration.
    pub position: f64,
    pub velocity: f64,
}

/// Positions and velocities.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a> {
    /// \[m, rad\].
    pub position: &'a [f64],
    /// \[m/s, rad/s\].
    pub velocity: &'a [f64],
}

/// Internal coordinates during an implicit step.
#[derive(Debug)]
pub struct InternalStep<'a> {
    /// In: positions \[m\] and velocities \[m/s\] without the force at the step's end; out: with it.
    pub position: &'a mut [f64],
    pub velocity: &'a mut [f64],
    /// Force on each coordinate at the step's end \[N\]. In: a guess; out: the solution.
    pub force: &'a mut [f64],
    /// −∂(force on each coordinate)/∂(rows), coordinates × rows, at velocity increments γ/(β h) times those of position.
    pub force_tangent: &'a mut [f64],
    /// Effective stiffness of the rows, rows × rows, with the coordinates condensed and damping included.
    pub stiffness: &'a mut [f64],
}

/// Tangents of the forces over rows and internal coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InternalTangent {
    /// −∂(F, Q)/∂(r, y) and −∂(F, Q)/∂(ṙ, ẏ).
    pub stiffness: Vec<Vec<f64>>,
    pub damping: Vec<Vec<f64>>,
}

/// Coordinates of a bearing's own, with a mass each.
pub trait InternalCoordinates {
    /// Mass of each coordinate \[kg\].
    fn masses(&self) -> &[f64];

    /// Name of a coordinate in messages: "ball 3".
    fn name(&self, coordinate: usize) -> String;

    /// Number of displacements of the housing u_x u_y u_z θ_x θ_y θ_z that follow the relative ones in the rows; a fixed
    /// housing has none.
    fn housing_dofs(&self) -> usize;

    /// Coordinates \[m\] in static equilibrium at displacements of the rows.
    fn equilibrium(&self, rows: &[f64], rotation: &Rotation) -> Vec<f64>;

    /// Stiffness of a coordinate at fixed rows under its own inertial load \[N/m\].
    fn stiffness(&self, coordinate: usize, rotation: &Rotation) -> f64;

    /// Forces on the rows and on the coordinates at given motions, with energy and powers; no tangents.
    ///
    /// The first six of the forces on the rows are also those of the reaction.
    fn forces(
        &self,
        rows: Motion,
        coordinates: Motion,
        rotation: &Rotation,
        on_rows: &mut [f64],
        on_coordinates: &mut [f64],
    ) -> Reaction;

    /// Both tangents of [`InternalCoordinates::forces`].
    fn tangent(&self, rows: Motion, coordinates: Motion, rotation: &Rotation) -> InternalTangent;

    /// Solves the coordinates of an implicit step at fixed motion of the rows, and returns the forces on these.
    fn step(
        &self,
        rows: Motion,
        coordinates: InternalStep,
        rotation: &Rotation,
        gain: &NewmarkGain,
        on_rows: &mut [f64],
    ) -> Reaction;
}
