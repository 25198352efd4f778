//! What every force element owes: force and tangents that agree, dissipation, no pull.

#[path = "../common/bearing.rs"]
mod bearing;

mod ball_bearing;
mod ball_combinations;
mod contact_laws;
mod linear_bearing;
