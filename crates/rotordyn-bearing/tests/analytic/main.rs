//! Closed forms of contacts and of the motion of balls.

#[path = "../../../../tests/common/agree.rs"]
mod agree;
#[path = "../common/bearing.rs"]
mod bearing;

mod ball_motion;
mod hertz;
mod hunt_crossley;
mod kinematics;
mod rolling_ball;
