//! Recorder of the motion of all parts in a run, for animations.

use super::Machine;
use crate::assembly::PhysicsError;
use crate::model::study::MotionSettings;
use crate::results::{BearingMotion, BodyMotion, Motion};
use crate::transient::reduction::Reduction;
use crate::transient::run::Sample;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rotordyn_bearing::BodyPose;
use serde::{Deserialize, Serialize};

/// Tolerance of the ends of the recorded time, in sampling intervals.
const TIME_SLACK: f64 = 1e-6;

/// Collects the frames of a run.
pub struct MotionRecorder<'a> {
    machine: &'a Machine,
    reduction: &'a Reduction,
    settings: MotionSettings,
    sample_rate: f64,
    /// Samples since the first frame.
    samples: usize,
    /// Free bodies of every interface at the last sample, with their orientations.
    last: Vec<Vec<(BodyPose, UnitQuaternion<f64>)>>,
    last_time: f64,
    pub motion: Motion,
}

/// A recorder after a sample: its frames, and what turns the bodies on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionSnapshot {
    samples: usize,
    /// Bodies of every interface with w, x, y, z of their orientations.
    last: Vec<Vec<(BodyPose, [f64; 4])>>,
    last_time: f64,
    motion: Motion,
}

impl<'a> MotionRecorder<'a> {
    /// The recorder as it is after a sample.
    pub fn snapshot(&self) -> MotionSnapshot {
        let parts = |(pose, q): &(BodyPose, UnitQuaternion<f64>)| (*pose, [q.w, q.i, q.j, q.k]);
        MotionSnapshot {
            samples: self.samples,
            last: self.last.iter().map(|bodies| bodies.iter().map(parts).collect()).collect(),
            last_time: self.last_time,
            motion: self.motion.clone(),
        }
    }

    /// Goes on from a snapshot of a recorder of the same run, in the same bits.
    ///
    /// # Errors
    /// A snapshot of another machine.
    pub fn resume(&mut self, snapshot: MotionSnapshot) -> Result<(), PhysicsError> {
        let names = |motion: &Motion| motion.bearings.iter().map(|b| b.name.clone()).collect::<Vec<_>>();
        let bearings = self.motion.bearings.len();
        let same = names(&snapshot.motion) == names(&self.motion);
        if !same || ![0, bearings].contains(&snapshot.last.len()) {
            return Err(PhysicsError::OtherSnapshot { time: snapshot.last_time });
        }
        // Not normalised again, which would change the last bit.
        let whole = |(pose, [w, x, y, z]): (BodyPose, [f64; 4])| {
            (pose, UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)))
        };
        let MotionSnapshot { samples, last, last_time, motion } = snapshot;
        self.last = last.into_iter().map(|bodies| bodies.into_iter().map(whole).collect()).collect();
        (self.samples, self.last_time, self.motion) = (samples, last_time, motion);
        Ok(())
    }

    /// Recorder of a run of `reduction` sampled at `sample_rate` \[Hz\].
    pub fn new(
        machine: &'a Machine,
        reduction: &'a Reduction,
        settings: MotionSettings,
        sample_rate: f64,
    ) -> Self {
        let bearings = reduction
            .system
            .interfaces
            .iter()
            .map(|interface| BearingMotion { name: interface.name.clone(), ..BearingMotion::default() });
        let motion = Motion { bearings: bearings.collect(), ..Motion::default() };
        Self {
            machine,
            reduction,
            settings,
            sample_rate,
            samples: 0,
            last: Vec::new(),
            last_time: 0.0,
            motion,
        }
    }

    /// Takes a sample: turns the balls, and records a frame if it is its time.
    pub fn observe(&mut self, sample: &Sample) {
        let (state, system) = (sample.state, sample.system);
        let slack = TIME_SLACK / self.sample_rate;
        if state.time < self.settings.from - slack || state.time > self.settings.to + slack {
            return;
        }
        let poses = (0..system.interfaces.len()).map(|k| system.body_poses(k, state));
        let poses: Vec<Vec<BodyPose>> = poses.collect();
        let step = state.time - self.last_time;
        let first = self.last.is_empty();
        self.last = poses
            .into_iter()
            .enumerate()
            .map(|(k, bodies)| {
                let turned = bodies.into_iter().enumerate().map(|(j, pose)| {
                    let turned = match pose.orientation {
                        Some([w, x, y, z]) => UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)),
                        None if first => UnitQuaternion::identity(),
                        None => {
                            let (before, from) = &self.last[k][j];
                            turned(from, [before.rotation, pose.rotation], step)
                        }
                    };
                    (pose, turned)
                });
                turned.collect()
            })
            .collect();
        self.last_time = state.time;
        if self.samples.is_multiple_of(self.settings.stride(self.sample_rate)) {
            self.record(sample);
        }
        self.samples += 1;
    }

    fn record(&mut self, sample: &Sample) {
        let (state, system) = (sample.state, sample.system);
        self.motion.time.push(state.time);
        self.motion.shaft_angle.push(state.spin.angle);
        let free = self.reduction.expand(&state.x);
        self.motion.displacement.push(self.machine.assembly.dofs.expand(free.as_slice()));
        for (k, bearing) in self.motion.bearings.iter_mut().enumerate() {
            bearing.cage_angle.push(state.rotations[k].cage_angle);
            let forces = system.ball_forces(k, state);
            let bodies = &self.last[k];
            bearing.balls = forces.len();
            bearing.bodies.resize_with(bodies.len(), BodyMotion::default);
            for (j, (body, (pose, turned))) in bearing.bodies.iter_mut().zip(bodies).enumerate() {
                body.position.push(pose.position);
                body.orientation.push([turned.w, turned.i, turned.j, turned.k]);
                body.rotation.push(pose.rotation);
                body.forces.push(forces.get(j).copied().unwrap_or_default());
            }
        }
    }
}

/// Orientation after a step of the mean of two angular velocities: q₁ = exp(½ h (ω₀ + ω₁)/2) q₀, second order in h.
pub(super) fn turned(
    from: &UnitQuaternion<f64>,
    [start, end]: [[f64; 3]; 2],
    step: f64,
) -> UnitQuaternion<f64> {
    let angle = Vector3::from_fn(|k, _| 0.5 * step * (start[k] + end[k]));
    UnitQuaternion::from_scaled_axis(angle) * from
}

#[cfg(test)]
mod tests {
    use super::turned;
    use nalgebra::{UnitQuaternion, Vector3};

    /// A body that spins about an axis which itself turns about z: R(t) = exp(Ω t ẑ) exp(s t x̂), so that
    /// ω = Ω ẑ + exp(Ω t ẑ) s x̂; the error at 1 s falls with the square of the step.
    #[test]
    fn orientation_follows_the_angular_velocity() {
        let (orbit, spin) = (7.0, 16.0);
        let about = |axis: Vector3<f64>, angle: f64| UnitQuaternion::from_scaled_axis(axis * angle);
        let rotation = |t: f64| {
            let turned = about(Vector3::z(), orbit * t) * (Vector3::x() * spin) + Vector3::z() * orbit;
            <[f64; 3]>::from(turned)
        };
        let error = |steps: usize| {
            let h = 1.0 / steps as f64;
            let found = (0..steps).fold(UnitQuaternion::identity(), |q, k| {
                turned(&q, [rotation(k as f64 * h), rotation((k + 1) as f64 * h)], h)
            });
            found.angle_to(&(about(Vector3::z(), orbit) * about(Vector3::x(), spin)))
        };
        let (coarse, fine) = (error(400), error(800));
        println!("error {coarse:.2e} rad with 400 steps, {fine:.2e} with 800");
        assert!(fine < 3e-4 && (coarse / fine - 4.0).abs() < 0.1, "{coarse} {fine}");
    }
}
