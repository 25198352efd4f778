//! Balls, rings and cage as bodies of rapier: detection of collisions, and a second engine for the cage's speed.
//!
//! Which part does what for balls and cage as free bodies (`rotordyn_bearing::free_ball`):
//!
//! | part | does | decided by |
//! |---|---|---|
//! | closed forms | every distance and normal in the steps of a run | as exact as parry's, and faster (`benches/free_ball.rs`) |
//! | parry | grooves, pockets, lands as shapes; their distances as a check of the closed forms and of the start | first table |
//! | rapier | bodies; broad and narrow phase that find which balls, rings and cage come near ([`BodyCollisions`], [`overlaps`]) | finds pairs that the closed forms do not look for |
//! | free balls | stiff contact forces, traction, Runge-Kutta integration of all bodies | second table; rapier's contact solver has no Hertz law |
//!
//! Largest difference of parry's contact from the closed form, over random places within 0.2 mm of contact, rings and cage
//! tilted by 1 mrad (`tests/cross/parry_free_balls.rs`; a last bit of 20 mm is 3.5e-18 m):
//!
//! | surface | distance \[m\] | normal \[-\] |
//! |---|---|---|
//! | groove of the inner, outer race (torus part, own shape) | 1.2e-17, 1.4e-17 | 7e-13 |
//! | edge of a shoulder | 9e-18 | 3e-15 |
//! | pocket: cylindrical, spherical, closed (own shapes) | 1.8e-18 | 3e-14 |
//! | land of the inner, outer ring (own shapes) | 6e-18, 7e-18 | 2e-13 |
//! | ball and ball (parry's own) | 0 | 2e-16 |
//! | groove as a mesh of 276 thousand triangles (parry's own) | 1.8e-7: not used | |
//!
//! A deflection of 0.1 um carries some 0.1 N; the mesh would be wrong by more than all of it. Both neglect that an edge of
//! the cage, tilted by θ against its land, is an ellipse in its section: R θ²/2, 1e-8 m at 1 mrad.
//!
//! Free motion over 4 ms against closed forms (`tests/cross/rapier_integration.rs`), rapier with one solver iteration and its
//! gyroscopic term, the free balls by RK4:
//!
//! | motion | step \[us\] | rapier | free balls |
//! |---|---|---|---|
//! | fall of 78 um, error \[m\] | 8 | 1.6e-7 | 4e-19 |
//! | | 1 | 2.0e-8, order 1.000 | |
//! | tilting cage at 7900 rpm, error of its orientation \[rad\] | 8 | 2.8e-4 | 1.0e-11 |
//! | | 4 | 1.4e-4 | 6.6e-13 |
//! | | 2 | 7.0e-5, order 1.00 | 4.1e-14, order 4.01 |
//! | relative change of its angular momentum | 2 | 2.8e-6 | 0 |
//!
//! rapier's motion is symplectic Euler, of first order in translation and rotation, so it integrates no part of a study.

mod collisions;
mod simulation;

pub use collisions::{BodyCollisions, overlaps};
pub use simulation::{FreeBallBearing, FreeBallSettings};
