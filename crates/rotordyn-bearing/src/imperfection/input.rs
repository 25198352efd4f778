//! Bearing imperfections (input data): waviness, off-size balls, local defects.
//!
//! A deviation is measured along the contact normal, positive where it narrows the gap: a bump, an oversize
//! ball. Angles on the outer race are from +x towards +y, on the inner race the same in the ring's rotating
//! frame, on a ball from the point initially at the outer race, against the ball's spin.

use super::spall::SpallPath;
pub use super::surface::Surface;
use crate::BallGeometry;
use serde::{Deserialize, Serialize};

/// Deviations of races and balls from their ideal shape; none by default.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Imperfections {
    /// Waviness of the races; an eccentric race is a wave of order 1.
    pub inner_waviness: Vec<Wave>,
    pub outer_waviness: Vec<Wave>,
    pub ball_waviness: Vec<BallWave>,
    pub off_size: Vec<OffSize>,
    pub defects: Vec<Defect>,
    /// Law by which defects act; waviness and sizes always displace the surface.
    pub law: DefectLaw,
    pub spin: BallSpin,
}

/// One harmonic of waviness: deviation a cos(n φ + ϕ₀), positive towards the other body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Wave {
    /// Waves per circumference n.
    pub order: u32,
    /// Amplitude a \[m\].
    pub amplitude: f64,
    /// Phase ϕ₀ \[rad\].
    pub phase: f64,
}

impl Wave {
    /// Run-out of an inner race with eccentricity `by` \[m\] towards the angle φ₀ of its ring.
    pub fn eccentric_inner(by: f64, towards: f64, contact_angle: f64) -> Self {
        Self { order: 1, amplitude: by * contact_angle.cos(), phase: -towards }
    }

    /// Run-out of an outer race, which recedes from the balls on the side of its eccentricity.
    pub fn eccentric_outer(by: f64, towards: f64, contact_angle: f64) -> Self {
        Self { order: 1, amplitude: by * contact_angle.cos(), phase: std::f64::consts::PI - towards }
    }
}

/// A wave on one ball, or on all balls.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BallWave {
    pub ball: Option<usize>,
    pub wave: Wave,
}

/// An off-size ball: diameter difference to the others \[m\].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OffSize {
    pub ball: usize,
    pub diameter_difference: f64,
    /// Row of a matched pair; `None`: both rows.
    pub row: Option<usize>,
}

/// A local defect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Defect {
    pub surface: Surface,
    /// Row of a matched pair; `None`: both rows.
    pub row: Option<usize>,
    /// Angle at which it starts \[rad\].
    pub start: f64,
    /// Length along the race \[m\].
    pub width: f64,
    pub form: DefectForm,
}

/// Shape and size of a defect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum DefectForm {
    /// A dent of this depth \[m\]; `None`: the depth to which a ball sinks into its opening.
    Dent {
        depth: Option<f64>,
        shape: Shape,
    },
    Bump {
        height: f64,
        shape: Shape,
    },
    /// A pit of constant depth \[m\] between two edges of this radius \[m\]; its width is the opening in the
    /// surface.
    Spall {
        depth: f64,
        edge_radius: f64,
    },
}

/// The ball's path over a dent or bump.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Shape {
    /// H = h sin(π p/Δφ) (Atef 2022 eq. 1).
    #[default]
    HalfSine,
    /// Circular arc through both ends and the middle.
    Cap,
}

/// Law by which a defect acts on the balls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum DefectLaw {
    /// Displacement of the surface: deviation in the elastic approach, its rate in the approach rate.
    #[default]
    Displacement,
    /// The same, with the rate left out of the contact damping (Atef 2022 eq. 15).
    UndampedDisplacement,
    /// A force ±K_d |H|^{3/2} along the contact line, added to the undisturbed load (Atef 2022 eq. 11-12).
    Force {
        /// K_d \[N/m^1.5\]; `None`: of the ball's dry contacts in series.
        stiffness: Option<f64>,
        /// Only on loaded balls, with no negative load; else on every ball at all times, as published.
        loaded_only: bool,
    },
}

/// Ball spin speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum BallSpin {
    /// Rolling on both races.
    #[default]
    Rolling,
    /// Equal to the shaft speed (Upadhyay 2009).
    Shaft,
}

impl Imperfections {
    /// Whether no imperfection is given; one of zero size counts as given.
    pub fn is_empty(&self) -> bool {
        self.inner_waviness.is_empty()
            && self.outer_waviness.is_empty()
            && self.ball_waviness.is_empty()
            && self.off_size.is_empty()
            && self.defects.is_empty()
    }

    /// Text description of the bearing condition: "healthy, wavy races", "dent on outer race, spall on ball
    /// 3".
    pub fn condition(&self) -> String {
        let mut parts: Vec<String> = self.defects.iter().map(Defect::name).collect();
        if parts.is_empty() {
            parts.push("healthy".into());
        }
        let races = !self.inner_waviness.is_empty() || !self.outer_waviness.is_empty();
        for (given, what) in [
            (races, "wavy races"),
            (!self.ball_waviness.is_empty(), "wavy balls"),
            (!self.off_size.is_empty(), "off-size balls"),
        ] {
            if given {
                parts.push(what.into());
            }
        }
        parts.join(", ")
    }

    /// Ball numbers given for waviness, sizes and defects.
    pub fn ball_numbers(&self) -> impl Iterator<Item = usize> + '_ {
        let waves = self.ball_waviness.iter().filter_map(|w| w.ball);
        let sizes = self.off_size.iter().map(|s| s.ball);
        let defects = self.defects.iter().filter_map(|d| match d.surface {
            Surface::Ball(ball) => Some(ball),
            Surface::Inner | Surface::Outer => None,
        });
        waves.chain(sizes).chain(defects)
    }
}

impl Defect {
    /// Kind and location in words.
    pub fn name(&self) -> String {
        let kind = match self.form {
            DefectForm::Dent { .. } => "dent",
            DefectForm::Bump { .. } => "bump",
            DefectForm::Spall { .. } => "spall",
        };
        match self.surface {
            Surface::Inner => format!("{kind} on inner race"),
            Surface::Outer => format!("{kind} on outer race"),
            Surface::Ball(ball) => format!("{kind} on ball {ball}"),
        }
    }

    /// Angle Δφ = width / radius of the surface \[rad\].
    pub fn angle(&self, g: &BallGeometry) -> f64 {
        self.width / self.surface.radius(g)
    }

    /// Maximum depth to which a ball sinks into an opening of this width \[m\]: D/2 − √((D/2)² − (d/2)²),
    /// infinite when the ball falls through (Atef 2022 eq. 4); for a spall from its path over the edges.
    pub fn max_depth(&self, g: &BallGeometry) -> f64 {
        match self.form {
            DefectForm::Spall { edge_radius, .. } => {
                let paths = SpallPath::on(self.surface, g, self.width, f64::INFINITY, edge_radius);
                paths.iter().map(|path| path.at(0.5 * self.width)[0]).fold(0.0, f64::max)
            }
            DefectForm::Dent { .. } | DefectForm::Bump { .. } => {
                let radius = 0.5 * g.ball_diameter;
                let half = 0.5 * self.width;
                if half >= radius {
                    f64::INFINITY
                } else {
                    half * half / (radius + (radius * radius - half * half).sqrt())
                }
            }
        }
    }

    /// Deviation at its middle \[m\]: a bump's height, or minus the depth reached by a ball.
    pub fn height(&self, g: &BallGeometry) -> f64 {
        match self.form {
            DefectForm::Bump { height, .. } => height,
            DefectForm::Dent { depth, .. } => {
                -depth.map_or(self.max_depth(g), |depth| depth.min(self.max_depth(g)))
            }
            DefectForm::Spall { depth, .. } => -depth.min(self.max_depth(g)),
        }
    }
}
