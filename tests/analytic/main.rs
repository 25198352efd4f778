//! Closed forms.

#[path = "../common/bearing.rs"]
mod bearing;
#[path = "../common/machine.rs"]
mod machine;

mod ball_motion;
mod belt;
mod cage;
mod effective_mass;
mod fits;
mod hertz;
mod hunt_crossley;
mod jones_thrust;
mod kinematics;
mod precession;
mod responses;
mod rigid_rotor;
mod rolling_ball;
mod shaft_limits;
mod unbalance_phase;
