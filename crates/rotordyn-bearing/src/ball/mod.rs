//! Ball bearing with a kinematic cage and static balls, in solving order.
//!
//! | module | what |
//! |---|---|
//! | `input`, `lubrication`, `inertia`, `fit` | the bearing as given, and its clearance when mounted |
//! | `cage` | cage speed over shaft speed |
//! | `ring_motion`, `plane_motion` | motion of the inner ring, and of a ball's groove centres in its plane |
//! | `massless`; `equilibrium`, `derivatives`, `inertial_ball` | force of a ball: massless, or with inertia |
//! | `defect_force` | published force law of local defects |
//! | `sum`, `row` | sum over the balls of a row; `row_kernel`: the same in SIMD, for the simplest kind of row |
//! | `preload_mechanism`, `preload`; `ring_equilibrium`, `spring_preload` | preload: rigid, or by a spring |
//! | `duplex` | two rows |
//! | `element` | the bearing; `change`, `cage_equilibrium`: its statics with ball inertia |
//! | `spaced` | a row whose balls are each at a given angle |
//! | `load`; `model` | load of one ball; implementation of `BearingModel` and `BearingElement` |

mod cage;
mod cage_equilibrium;
mod change;
mod defect_force;
mod derivatives;
mod duplex;
mod element;
mod equilibrium;
pub mod fit;
pub mod inertia;
mod inertial_ball;
mod input;
#[cfg(test)]
mod kernel_tests;
mod load;
pub mod lubrication;
mod massless;
mod model;
mod plane_motion;
mod preload;
mod preload_mechanism;
mod ring_equilibrium;
mod ring_motion;
mod row;
mod row_kernel;
mod spaced;
mod spring_preload;
mod sum;

pub use element::BallElement;
pub use fit::{Fit, FitMaterials};
pub use inertia::{BallInertia, InertiaDecision};
pub use input::{Arrangement, BallBearing, CONTAMINATION, Cage, Duplex, Preload, RELIABILITY, Service};
pub use load::BallLoad;
pub use lubrication::Lubrication;
pub use preload::PreloadState;
pub use spaced::SpacedBalls;
