//! What every force element owes: force and tangents that agree, dissipation, no pull.

#[path = "../common/bearing.rs"]
mod bearing;

mod ball_bearing;
mod ball_combinations;
mod ball_inertia;
mod contact_laws;
mod linear_bearing;
mod preload;
