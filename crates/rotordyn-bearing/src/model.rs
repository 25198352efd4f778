//! Interfaces of all bearing models: as given in the model file ([`BearingModel`]) and prepared for evaluation
//! ([`BearingElement`]). Methods with a default are answered by some models only.

use std::fmt::Debug;
use std::sync::Arc;

use crate::ball::{BallBearing, PreloadState};
use crate::bearing::Bearing;
use crate::bearing_contact::BearingContact;
use crate::bodies::FreeBodies;
use crate::free_ball::FreeBallBearing;
use crate::geometry::CharacteristicOrders;
use crate::internal::InternalCoordinates;
use crate::reaction::{Reaction, Rotation, SiteTangent};

/// Stiffness that stands for a contact where only the constrained directions matter \[N/m, N m/rad\].
const NOMINAL_STIFFNESS: [f64; 6] = [1e7, 1e7, 1e7, 1e3, 1e3, 1e3];

/// A bearing model as given: its data, without anything computed.
pub trait BearingModel: Debug {
    /// Keyword of the model, as in model files and results.
    fn keyword(&self) -> &'static str;

    /// The model in words, beside the geometry of its balls: "linear, 3 speeds".
    fn description(&self) -> String;

    /// Prepares the bearing for evaluation.
    fn element(&self) -> Arc<dyn BearingElement>;

    /// Directions u_x u_y u_z θ_x θ_y θ_z in which the bearing supports the shaft.
    fn supports(&self) -> [bool; 6];

    /// Whether the force at given displacement and velocity depends on shaft speed.
    fn depends_on_speed(&self) -> bool;

    /// Symbol in drawings of the machine.
    fn symbol(&self) -> BearingSymbol<'_>;

    /// Directions in which the bearing carries axial load of the shaft: along +z, along −z.
    fn thrust_directions(&self) -> [bool; 2] {
        [self.supports()[2]; 2]
    }

    /// Stiffness at standstill where only the constrained directions matter: with all contacts closed \[N/m, N, N m\].
    fn nominal_stiffness(&self) -> [[f64; 6]; 6] {
        let supports = self.supports();
        let entry = |i: usize, j: usize| if i == j && supports[i] { NOMINAL_STIFFNESS[i] } else { 0.0 };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    }

    /// Mass that the bearing adds to its housing, radially \[kg\].
    fn added_housing_mass(&self) -> f64 {
        0.0
    }

    /// Speeds of the bearing's table; `None` for a model that holds at every speed.
    fn speed_range(&self) -> Option<SpeedRange> {
        None
    }

    /// Speeds of the nodes of the bearing's table \[rad/s\]; none without one.
    fn table_speeds(&self) -> Vec<f64> {
        Vec::new()
    }

    /// The same bearing with a cage that rolls without slip; `None` unless its balls are free bodies.
    fn with_rolling_cage(&self) -> Option<Bearing> {
        None
    }

    /// The cage at the start; `None` for a bearing without cage.
    fn cage(&self) -> Option<CageStart> {
        None
    }

    /// Turns the cage at the start to an angle \[rad\]; nothing for a bearing without cage.
    fn set_cage_angle(&mut self, angle: f64);

    /// Geometry, materials, cage and races of a bearing with balls.
    fn ball(&self) -> Option<&BallBearing> {
        None
    }

    /// Characteristic orders at the nominal contact angle; `None` for a bearing without rolling elements.
    fn characteristic_orders(&self) -> Option<CharacteristicOrders> {
        self.ball().map(|ball| ball.geometry.characteristic_orders(ball.geometry.contact_angle))
    }

    /// The bearing as one with static balls and contact angles, to which preload, ball inertia, films and the study of a
    /// single bearing apply.
    fn static_balls(&self) -> Option<&BallBearing> {
        None
    }

    /// The bearing with its balls and cage as free bodies, to which the study of their steady motion applies.
    fn free_balls(&self) -> Option<&FreeBallBearing> {
        None
    }

    /// [`static_balls`](Self::static_balls), to set its preload, ball inertia or films.
    fn static_balls_mut(&mut self) -> Option<&mut BallBearing> {
        None
    }
}

impl dyn BearingModel {
    /// Initial cage angle \[rad\]; 0 for a bearing without cage.
    pub fn cage_angle(&self) -> f64 {
        self.cage().map_or(0.0, |cage| cage.angle)
    }
}

/// A cage at the start of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CageStart {
    /// Angle of the cage \[rad\].
    pub angle: f64,
    /// Angle by which the cage with its rolling elements looks the same again \[rad\].
    pub period: f64,
}

/// Speeds over which a bearing is tabulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpeedRange {
    /// First and last speed of the table \[rad/s\].
    pub speeds: [f64; 2],
    pub beyond: BeyondTable,
}

/// Treatment of studies at speeds beyond a bearing's table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum BeyondTable {
    /// The values of the table's end hold, with a warning.
    #[default]
    Hold,
    /// An error.
    Refuse,
    /// The curves go on along their last slopes, without a warning.
    Extrapolate,
}

/// How drawings show a bearing.
#[derive(Clone, Debug, PartialEq)]
pub enum BearingSymbol<'a> {
    /// A rolling element between two rings.
    RollingElement,
    /// Springs and dampers with these matrices K and C.
    Springs(Vec<[&'a [[f64; 6]; 6]; 2]>),
}

/// A bearing prepared for evaluation.
pub trait BearingElement: Debug + Send + Sync {
    /// Number of relative degrees of freedom the bearing acts on, in the order u_x u_y u_z θ_x θ_y θ_z: 2 for a plane
    /// bearing, 5 with free rotation of the shaft, else 6.
    fn relative_dofs(&self) -> usize;

    /// Force on the shaft and both tangents at displacement `d` and velocity `v` of the shaft relative to the housing
    /// (order u_x u_y u_z θ_x θ_y θ_z \[m, rad; m/s, rad/s\]); internal coordinates are in static equilibrium.
    fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction;

    /// The force of [`BearingElement::reaction`] with its energy, powers and mean contact angle, written to `out`; the
    /// tangents of `out` are unspecified. For time integration.
    fn force(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation, out: &mut Reaction) {
        *out = self.reaction(d, v, rotation);
    }

    /// Whether [`BearingElement::force`] takes half the time of [`BearingElement::reaction`] or less, or both take next to none.
    fn has_cheap_force(&self) -> bool {
        false
    }

    /// Static reaction averaged over one pitch of cage angles (`angles` samples), without imperfections.
    fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction;

    /// Load, contact angles, approach and film of every contact; empty for a bearing without contacts.
    fn contact_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BearingContact>;

    /// Whether the force at given displacement and velocity depends on shaft speed.
    fn depends_on_speed(&self) -> bool;

    /// Whether the force is linear in displacement and velocity, so that its tangents need no equilibrium.
    fn is_linear(&self) -> bool {
        false
    }

    /// Tangents at a speed \[rad/s\] given those at standstill; other than these only if they are tabulated over speed.
    fn tangent_at(&self, _speed: f64, standstill: SiteTangent) -> SiteTangent {
        standstill
    }

    /// Tangents of a linear bearing at a speed for motions of one frequency \[rad/s\]; `None` if they do not depend on it.
    fn tangent_at_whirl(&self, _speed: f64, _whirl: f64) -> Option<SiteTangent> {
        None
    }

    /// Axial preload of the centred bearing at a speed Ω \[rad/s\].
    fn preload_state(&self, _speed: f64) -> PreloadState {
        PreloadState::default()
    }

    /// Number of rolling elements of a row, in a cage that turns with the shaft; 0 for a bearing without cage.
    fn rolling_elements(&self) -> usize {
        0
    }

    /// Whether a rolling element in a cage that turns with the shaft can come on a local defect.
    fn has_defects(&self) -> bool {
        false
    }

    /// Whether one is on a local defect at some time of a rotation from one state to another.
    fn meets_defect(&self, _from: &Rotation, _to: &Rotation) -> bool {
        false
    }

    /// Calls `visit` with the part of such a rotation at every passage over the start or the end of a local defect, where the
    /// slope of the surface jumps.
    fn each_defect_edge(&self, _from: &Rotation, _to: &Rotation, _visit: &mut dyn FnMut(f64)) {}

    /// Cage speed over shaft speed at a mean contact angle; 0 for a bearing without cage.
    fn cage_ratio(&self, _mean_cos: f64) -> f64 {
        0.0
    }

    /// Cosine of the nominal contact angle.
    fn nominal_cos(&self) -> f64 {
        1.0
    }

    /// The bearing's own coordinates in a transient; `None` if its force follows from displacement and velocity.
    fn internal(&self) -> Option<&dyn InternalCoordinates> {
        None
    }

    /// Bodies with states of their own in a transient; statics and linear studies have them in equilibrium. A bearing has
    /// internal coordinates or bodies, not both.
    fn bodies(&self) -> Option<&dyn FreeBodies> {
        None
    }
}
