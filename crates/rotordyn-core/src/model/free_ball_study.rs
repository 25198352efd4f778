//! Settings of the study of one bearing with free balls.

/// One bearing with free balls under a load at a speed, run until its cage speed settles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeBallStudy {
    /// Load of the shaft on the bearing F_x F_y F_z \[N\].
    pub force: [f64; 3],
    /// Speed of the inner ring \[rad/s\]; the outer ring is at rest.
    pub speed: f64,
    /// Longest time step \[s\]; `None`: 0.4 of the step at which the contacts are stable at the start, at most 0.8 of that of
    /// friction.
    pub step: Option<f64>,
    /// Longest time in which the cage speed may settle, in turns of the kinematic cage.
    pub settling_turns: usize,
    /// Largest change of the mean cage speed, relative, from one quarter of the run to the next at which it is settled.
    pub drift: f64,
    /// Length of the record after settling, in turns of the kinematic cage.
    pub recorded_turns: usize,
    /// Length of the record T \[s\] in which the defect frequencies are to be told apart from kinematics.
    pub measured_duration: f64,
}

impl FreeBallStudy {
    /// Default settings at a load \[N\] and speed \[rad/s\].
    pub fn new(force: [f64; 3], speed: f64) -> Self {
        Self {
            force,
            speed,
            step: None,
            settling_turns: 200,
            drift: 5e-4,
            recorded_turns: 4,
            measured_duration: 1.0,
        }
    }
}

/// Cage slip over load and speed.
#[derive(Clone, Debug, PartialEq)]
pub struct SkiddingMapStudy {
    /// Settings of every point; its force is scaled to each load, its speed replaced.
    pub point: FreeBallStudy,
    /// Magnitudes of the load \[N\] and speeds \[rad/s\].
    pub loads: Vec<f64>,
    pub speeds: Vec<f64>,
}
