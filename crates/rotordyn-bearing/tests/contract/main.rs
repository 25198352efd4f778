//! Invariants of every force element: consistent force and tangents, dissipation, no tensile contact.

#[path = "../common/bearing.rs"]
mod bearing;
#[path = "../common/ehl.rs"]
#[allow(dead_code)]
mod lubricated;

mod ball_bearing;
mod ball_combinations;
mod ball_inertia;
mod cage_in_statics;
mod contact_laws;
mod ehl_table;
mod force_only;
mod imperfections;
mod linear_bearing;
mod models;
mod preload;
mod radial_ball;
mod spaced_balls;
mod spring_preload;
