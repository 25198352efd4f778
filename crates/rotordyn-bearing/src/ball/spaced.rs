//! Kinematic ball bearing whose balls are at given angles instead of evenly spaced.

use crate::bearing_contact::BearingContact;
use crate::model::BearingElement;
use crate::{BallBearing, BallElement, Preload, PreloadState, Reaction, Rotation};

/// A single row whose balls turn as recorded over the shaft angle, each by itself; forces as of [`BallElement`].
///
/// Statics have the balls evenly spaced.
#[derive(Clone, Debug)]
pub struct SpacedBalls {
    row: BallElement,
    balls: Vec<BallElement>,
    /// Shaft angles, increasing, and at each the angle of every ball \[rad\].
    shaft: Vec<f64>,
    angles: Vec<Vec<f64>>,
}

impl SpacedBalls {
    /// A bearing with a single row and the angles of all its balls over the shaft angle \[rad\].
    ///
    /// `None`: a matched pair, surfaces of balls, no ball or fewer than two angles of the shaft, or shaft angles that do not
    /// increase.
    pub fn new(bearing: &BallBearing, shaft: Vec<f64>, angles: Vec<Vec<f64>>) -> Option<Self> {
        let balls = bearing.geometry.balls;
        let fits = angles.len() == shaft.len() && angles.iter().all(|row| row.len() == balls);
        let increases = shaft.len() > 1 && shaft.is_sorted_by(|before, after| before < after);
        let plain = bearing.duplex.is_none() && bearing.imperfections.ball_waviness.is_empty();
        if !(fits && increases && plain && balls > 0) {
            return None;
        }
        let row = BallElement::new(bearing);
        let mut one = bearing.clone();
        one.geometry.balls = 1;
        // An axial force would act on each ball by itself.
        if bearing.preload != Preload::None {
            one.preload = Preload::Interference(row.preload_state(0.0).offset);
        }
        let single = |j: usize| {
            let mut one = one.clone();
            one.imperfections.off_size.retain(|size| size.ball == j);
            one.imperfections.off_size.iter_mut().for_each(|size| size.ball = 0);
            BallElement::new(&one)
        };
        Some(Self { row, balls: (0..balls).map(single).collect(), shaft, angles })
    }

    /// Interval of the shaft angles around one, and the place in it from 0 to 1; the ends hold beyond.
    fn place(&self, shaft_angle: f64) -> (usize, f64) {
        let k = self.shaft.partition_point(|angle| *angle <= shaft_angle).clamp(1, self.shaft.len() - 1);
        let width = self.shaft[k] - self.shaft[k - 1];
        (k, ((shaft_angle - self.shaft[k - 1]) / width).clamp(0.0, 1.0))
    }

    /// Rotation of every ball, each in a cage of its own.
    fn rotations(&self, rotation: &Rotation) -> impl Iterator<Item = Rotation> {
        let (k, part) = self.place(rotation.shaft_angle);
        let per_shaft = 1.0 / (self.shaft[k] - self.shaft[k - 1]);
        self.angles[k - 1].iter().zip(&self.angles[k]).map(move |(before, after)| {
            let turned = after - before;
            Rotation {
                cage_angle: before + part * turned,
                cage_speed: rotation.cage_speed.map(|_| per_shaft * turned * rotation.shaft_speed),
                ..*rotation
            }
        })
    }
}

impl BearingElement for SpacedBalls {
    fn relative_dofs(&self) -> usize {
        BearingElement::relative_dofs(&self.row)
    }

    /// Sum over the balls; ψ_j linear between the given angles.
    fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        let mut sum = Reaction::default();
        let (mut cosines, mut loads) = (0.0, 0.0);
        for (ball, own) in self.balls.iter().zip(self.rotations(rotation)) {
            let force = ball.reaction(d, v, &own);
            let load = force.force[..3].iter().map(|f| f * f).sum::<f64>().sqrt();
            cosines += load * force.mean_cos;
            loads += load;
            sum.add(&force, 1.0);
        }
        sum.mean_cos = if loads > 0.0 { cosines / loads } else { self.row.nominal_cos() };
        sum
    }

    fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        self.row.cage_average(d, rotation, angles)
    }

    fn contact_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BearingContact> {
        self.row.contact_loads(d, rotation)
    }

    fn depends_on_speed(&self) -> bool {
        self.row.depends_on_speed()
    }

    fn rolling_elements(&self) -> usize {
        self.balls.len()
    }

    fn has_defects(&self) -> bool {
        self.row.has_defects()
    }

    fn meets_defect(&self, from: &Rotation, to: &Rotation) -> bool {
        let moved = self.rotations(from).zip(self.rotations(to));
        self.balls.iter().zip(moved).any(|(ball, (from, to))| ball.meets_defect(&from, &to))
    }

    fn each_defect_edge(&self, from: &Rotation, to: &Rotation, visit: &mut dyn FnMut(f64)) {
        let moved = self.rotations(from).zip(self.rotations(to));
        for (ball, (from, to)) in self.balls.iter().zip(moved) {
            ball.each_defect_edge(&from, &to, &mut *visit);
        }
    }

    fn cage_ratio(&self, mean_cos: f64) -> f64 {
        self.row.cage_ratio(mean_cos)
    }

    fn nominal_cos(&self) -> f64 {
        self.row.nominal_cos()
    }

    fn preload_state(&self, speed: f64) -> PreloadState {
        self.row.preload_state(speed)
    }
}
