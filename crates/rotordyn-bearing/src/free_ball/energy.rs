//! Energy and momentum of balls and cage.

use super::cage::CageFrame;
use super::forces::Parts;
use super::ring::V;
use super::state::{ball_at, cage_at};

/// Stored energy \[J\] of balls and cage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StoredEnergy {
    /// Kinetic energy of the balls and of the cage.
    pub balls: f64,
    pub cage: f64,
    /// Elastic energy of the contacts.
    pub elastic: f64,
    /// Potential energy in gravity, 0 at the bearing's centre.
    pub gravity: f64,
}

impl StoredEnergy {
    /// Sum of all parts \[J\].
    pub fn total(&self) -> f64 {
        self.balls + self.cage + self.elastic + self.gravity
    }
}

/// Momentum of balls and cage together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Momentum {
    /// \[kg m/s\].
    pub linear: V,
    /// About the bearing's centre \[kg m²/s\].
    pub angular: V,
}

impl Parts {
    /// Kinetic and potential energy; the elastic part is left to the contacts.
    pub fn energy(&self, values: &[f64]) -> StoredEnergy {
        let mut out = StoredEnergy::default();
        for (j, &[_, mass, inertia]) in self.balls.iter().enumerate() {
            let ball = ball_at(values, j);
            out.balls +=
                0.5 * mass * ball.velocity.norm_squared() + 0.5 * inertia * ball.rotation.norm_squared();
            out.gravity -= mass * self.gravity.dot(&ball.position);
        }
        if let Some(contacts) = &self.cage {
            let frame = CageFrame::new(cage_at(values, self.balls.len()), &contacts.cage);
            let mass = contacts.cage.mass;
            out.cage = 0.5 * mass * frame.body.velocity.norm_squared()
                + 0.5 * frame.body.momentum.dot(&frame.rotation);
            out.gravity -= mass * self.gravity.dot(&frame.body.position);
        }
        out
    }

    /// Power of gravity on all bodies \[W\].
    pub fn gravity_power(&self, values: &[f64]) -> f64 {
        let balls = self.balls.iter().enumerate();
        let mut momentum: V = balls.map(|(j, &[_, mass, _])| mass * ball_at(values, j).velocity).sum();
        if let Some(contacts) = &self.cage {
            momentum += contacts.cage.mass * cage_at(values, self.balls.len()).velocity;
        }
        self.gravity.dot(&momentum)
    }

    /// Momentum of all bodies.
    pub fn momentum(&self, values: &[f64]) -> Momentum {
        self.momentum_of(values, values)
    }

    /// Momentum with the positions of `values` and the velocities of `motion`: with the rates of a state in place of its
    /// velocities the rate of the momentum, since velocity and momentum of a body are parallel.
    pub fn momentum_of(&self, values: &[f64], motion: &[f64]) -> Momentum {
        let mut out = Momentum::default();
        for (j, &[_, mass, inertia]) in self.balls.iter().enumerate() {
            let (place, ball) = (ball_at(values, j).position, ball_at(motion, j));
            out.linear += mass * ball.velocity;
            out.angular += mass * place.cross(&ball.velocity) + inertia * ball.rotation;
        }
        if let Some(contacts) = &self.cage {
            let (place, cage) =
                (cage_at(values, self.balls.len()).position, cage_at(motion, self.balls.len()));
            out.linear += contacts.cage.mass * cage.velocity;
            out.angular += contacts.cage.mass * place.cross(&cage.velocity) + cage.momentum;
        }
        out
    }
}
