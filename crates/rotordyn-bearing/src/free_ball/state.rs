//! State of balls and cage as one vector of numbers.
//!
//! Each ball has position, velocity and angular velocity (9 numbers), then the cage its position, velocity, orientation
//! (unit quaternion, scalar first) and angular momentum (13 numbers), all in the axes of the bearing. The angular momentum
//! of a cage without moment is so conserved exactly.

use super::ring::V;

/// Numbers of a ball and of the cage.
pub(super) const BALL: usize = 9;
pub(super) const CAGE: usize = 13;

/// State of the balls and the cage of a bearing at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FreeBallState {
    /// Time \[s\].
    pub time: f64,
    /// Position \[m\], velocity \[m/s\] and angular velocity \[rad/s\] of each ball, then the cage.
    pub values: Vec<f64>,
    /// Number of balls.
    pub balls: usize,
}

/// Motion of a ball.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BallBody {
    /// \[m\], \[m/s\], \[rad/s\].
    pub position: V,
    pub velocity: V,
    pub rotation: V,
}

/// Motion of the cage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CageBody {
    /// Centre \[m\] and its velocity \[m/s\].
    pub position: V,
    pub velocity: V,
    /// Orientation as unit quaternion, scalar first.
    pub orientation: [f64; 4],
    /// Angular momentum \[kg m²/s\].
    pub momentum: V,
}

impl FreeBallState {
    /// State from the motions of balls and cage at t = 0.
    pub fn new(balls: &[BallBody], cage: Option<&CageBody>) -> Self {
        let mut values = Vec::with_capacity(BALL * balls.len() + CAGE);
        for ball in balls {
            for part in [&ball.position, &ball.velocity, &ball.rotation] {
                values.extend_from_slice(part.as_slice());
            }
        }
        if let Some(cage) = cage {
            values.extend_from_slice(cage.position.as_slice());
            values.extend_from_slice(cage.velocity.as_slice());
            values.extend_from_slice(&cage.orientation);
            values.extend_from_slice(cage.momentum.as_slice());
        }
        Self { time: 0.0, values, balls: balls.len() }
    }

    /// Motion of a ball.
    pub fn ball(&self, ball: usize) -> BallBody {
        ball_at(&self.values, ball)
    }

    /// Motion of the cage; `None` without cage.
    pub fn cage(&self) -> Option<CageBody> {
        (self.values.len() > BALL * self.balls).then(|| cage_at(&self.values, self.balls))
    }
}

#[inline(always)]
pub(super) fn vector(values: &[f64], at: usize) -> V {
    V::new(values[at], values[at + 1], values[at + 2])
}

#[inline(always)]
pub(super) fn ball_at(values: &[f64], ball: usize) -> BallBody {
    let at = BALL * ball;
    BallBody {
        position: vector(values, at),
        velocity: vector(values, at + 3),
        rotation: vector(values, at + 6),
    }
}

#[inline(always)]
pub(super) fn cage_at(values: &[f64], balls: usize) -> CageBody {
    let at = BALL * balls;
    CageBody {
        position: vector(values, at),
        velocity: vector(values, at + 3),
        orientation: [values[at + 6], values[at + 7], values[at + 8], values[at + 9]],
        momentum: vector(values, at + 10),
    }
}

/// Scales the cage's quaternion to length 1, from which integration departs by its error.
pub(super) fn normalise_orientation(values: &mut [f64], balls: usize) {
    if values.len() >= BALL * balls + CAGE {
        let quaternion = &mut values[BALL * balls + 6..BALL * balls + 10];
        let length = quaternion.iter().map(|q| q * q).sum::<f64>().sqrt();
        quaternion.iter_mut().for_each(|q| *q /= length);
    }
}

impl CageBody {
    /// Cage at a centre, turned by an angle \[rad\] about z, rotating about z at a speed \[rad/s\] with a polar moment of
    /// inertia \[kg m²\].
    pub fn rotating(position: V, velocity: V, angle: f64, speed: f64, polar_inertia: f64) -> Self {
        let (sin, cos) = (0.5 * angle).sin_cos();
        let momentum = V::new(0.0, 0.0, polar_inertia * speed);
        Self { position, velocity, orientation: [cos, 0.0, 0.0, sin], momentum }
    }

    /// Axes of the cage in the bearing: directions of its x, y and z axis.
    #[inline(always)]
    pub fn axes(&self) -> [V; 3] {
        let [w, x, y, z] = self.orientation;
        [
            V::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
            V::new(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
            V::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)),
        ]
    }

    /// Angular velocity ω = L/I_t + (1/I_p − 1/I_t) (L·a) a \[rad/s\] about the cage's axis a.
    #[inline(always)]
    pub fn rotation(&self, axis: &V, polar_inertia: f64, transverse_inertia: f64) -> V {
        self.momentum / transverse_inertia
            + (1.0 / polar_inertia - 1.0 / transverse_inertia) * self.momentum.dot(axis) * axis
    }

    /// Rate of the quaternion, ½ ω q.
    #[inline(always)]
    pub fn orientation_rate(&self, rotation: &V) -> [f64; 4] {
        let (w, v) = (self.orientation[0], V::from_column_slice(&self.orientation[1..]));
        let vector = 0.5 * (w * rotation + rotation.cross(&v));
        [-0.5 * rotation.dot(&v), vector.x, vector.y, vector.z]
    }
}
