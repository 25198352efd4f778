//! Surface profile of races and balls (waviness, off-size, local defects): deviation at both contacts of
//! every ball.
//!
//! Ball j is at ψ_j = ψ + 2πj/Z. It touches the outer race at the race's angle ψ_j, the inner one at ψ_j − θ,
//! with its own surface turned by the spin χ: at the ball's angle χ on the outer race, χ + π on the inner
//! one. Rolling on the outer race requires χ̇ = ψ̇ (D_pw/D)(1 + γ), on the inner one
//! χ̇ = (θ̇ − ψ̇)(D_pw/D)(1 − γ), γ = (D/D_pw) cos α; their mean is used, χ = (D_pw/D)(γ (ψ − ψ₀) + ½ (1 − γ)
//! θ), which equals both at the rolling cage speed. At another cage ratio the slip is the same on both races.

use super::input::{BallSpin, Defect, DefectForm, DefectLaw, Imperfections, Surface};
use super::raceway::{Feature, Path, Raceway};
use super::spall::SpallPath;
use crate::lanes::Lanes;
use crate::{BallGeometry, Rotation};
use pulp::Simd;
use std::f64::consts::{PI, TAU};

/// Surface deviations of the races and balls of a row, prepared for evaluation.
#[derive(Clone, Debug)]
pub struct Profile {
    inner: Raceway,
    outer: Raceway,
    /// One per ball; empty when the balls are perfect.
    balls: Vec<Ball>,
    /// Angular position 2πj/Z of ball j with its cosine and sine.
    ball_positions: Vec<[f64; 3]>,
    law: Law,
    /// ∂χ/∂ψ, ∂χ/∂θ, and the cage angle ψ₀ at which χ = 0.
    spin: [f64; 2],
    initial_cage_angle: f64,
}

/// Size and surface of a ball.
#[derive(Clone, Debug, Default)]
struct Ball {
    /// Radius minus the nominal one \[m\].
    oversize: f64,
    /// Surface seen by the inner and the outer race: same waviness, different ball path over a spall.
    surface: [Raceway; 2],
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Law {
    Displacement,
    Undamped,
    /// K_d \[N/m^1.5\].
    Force(f64, bool),
}

/// Surface deviation at the contacts of one ball: inner race, outer race.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// Deviation of race and ball together, positive where the gap narrows \[m\].
    pub height: [f64; 2],
    /// Rate of the deviation that enters the contact damping \[m/s\].
    pub rate: [f64; 2],
    /// Rate of the deviation left out of the contact damping \[m/s\].
    pub undamped_rate: [f64; 2],
    /// Defect force by the published force law \[N\], positive where it increases the contact load.
    pub defect_force: f64,
}

impl Deviation {
    /// Sum over both contacts \[m\].
    pub fn total(&self) -> f64 {
        self.height[0] + self.height[1]
    }

    /// Rates of both contacts, damped and undamped together \[m/s\].
    pub fn full_rate(&self) -> [f64; 2] {
        [self.rate[0] + self.undamped_rate[0], self.rate[1] + self.undamped_rate[1]]
    }
}

/// A profile at one kinematic state of cage and shaft.
#[derive(Clone, Copy, Debug)]
pub struct ProfileState<'a> {
    profile: &'a Profile,
    inner: SurfaceAngle,
    outer: SurfaceAngle,
    ball: SurfaceAngle,
}

/// Angle of ball 0 on a surface, in [0, 2π), with cosine, sine and rate.
#[derive(Clone, Copy, Debug, Default)]
struct SurfaceAngle {
    angle: f64,
    cos: f64,
    sin: f64,
    rate: f64,
}

impl SurfaceAngle {
    fn new(angle: f64, rate: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { cos, sin, ..Self::angle_only(angle, rate) }
    }

    /// Without cosine and sine, for a surface without waviness.
    fn angle_only(angle: f64, rate: f64) -> Self {
        // rem_euclid of a tiny negative angle is 2π itself.
        let angle = angle.rem_euclid(TAU);
        Self { angle: if angle < TAU { angle } else { 0.0 }, rate, ..Self::default() }
    }

    /// Advanced by an angle in [0, 2π).
    #[inline]
    fn advanced_by(&self, [angle, cos, sin]: [f64; 3]) -> Self {
        let sum = self.angle + angle;
        Self {
            angle: if sum < TAU { sum } else { sum - TAU },
            cos: self.cos * cos - self.sin * sin,
            sin: self.sin * cos + self.cos * sin,
            rate: self.rate,
        }
    }
}

impl Profile {
    /// Profile of a row (0 in a single-row bearing) with initial cage angle ψ₀ \[rad\]; `None` for perfect
    /// surfaces.
    ///
    /// `stiffness`: of a ball's contacts in series \[N/m^1.5\], default of the force law.
    pub fn new(
        geometry: &BallGeometry,
        imperfections: &Imperfections,
        row: usize,
        cage_angle: f64,
        stiffness: f64,
    ) -> Option<Self> {
        let g = geometry;
        let in_row = |given: Option<usize>| given.is_none_or(|given| given == row);
        let features = |on: Surface, contact: usize| -> Vec<Feature> {
            let defects = imperfections.defects.iter().filter(|d| d.surface == on && in_row(d.row));
            defects.filter_map(|defect| feature(defect, g, contact)).collect()
        };
        let ball = |j: usize| {
            let waves: Vec<_> = imperfections
                .ball_waviness
                .iter()
                .filter(|w| w.ball.is_none_or(|ball| ball == j))
                .map(|w| w.wave)
                .collect();
            let sizes = imperfections.off_size.iter().filter(|s| s.ball == j && in_row(s.row));
            Ball {
                oversize: 0.5 * sizes.map(|s| s.diameter_difference).sum::<f64>(),
                surface: [0, 1].map(|contact| Raceway::new(&waves, features(Surface::Ball(j), contact))),
            }
        };
        let mut balls: Vec<Ball> = (0..g.balls).map(ball).collect();
        if balls.iter().all(|b| b.oversize == 0.0 && b.surface.iter().all(Raceway::is_perfect)) {
            balls.clear();
        }
        let place = |j: usize| {
            let angle = TAU * j as f64 / g.balls as f64;
            [angle, angle.cos(), angle.sin()]
        };
        let out = Self {
            inner: Raceway::new(&imperfections.inner_waviness, features(Surface::Inner, 0)),
            outer: Raceway::new(&imperfections.outer_waviness, features(Surface::Outer, 1)),
            balls,
            ball_positions: (0..g.balls).map(place).collect(),
            law: match imperfections.law {
                DefectLaw::Displacement => Law::Displacement,
                DefectLaw::UndampedDisplacement => Law::Undamped,
                DefectLaw::Force { stiffness: given, loaded_only: on_loaded } => {
                    Law::Force(given.unwrap_or(stiffness), on_loaded)
                }
            },
            spin: match imperfections.spin {
                BallSpin::Rolling => {
                    let cos = g.contact_angle.cos();
                    let ratio = g.pitch_diameter / g.ball_diameter;
                    [cos, 0.5 * (ratio - cos)]
                }
                BallSpin::Shaft => [0.0, 1.0],
            },
            initial_cage_angle: cage_angle,
        };
        let perfect = out.inner.is_perfect() && out.outer.is_perfect() && out.balls.is_empty();
        (!perfect).then_some(out)
    }

    /// `Some` if defects act by the published force law: whether on loaded balls only.
    pub fn force_law(&self) -> Option<bool> {
        match self.law {
            Law::Force(_, on_loaded) => Some(on_loaded),
            Law::Displacement | Law::Undamped => None,
        }
    }

    /// Whether there are local defects.
    pub fn has_defects(&self) -> bool {
        let on_balls = self.balls.iter().flat_map(|ball| &ball.surface);
        [&self.inner, &self.outer].into_iter().chain(on_balls).any(Raceway::has_defects)
    }

    /// Whether a contact of a ball is on a local defect at some time of a rotation from one state to another.
    pub fn meets_defect(&self, from: &Rotation, to: &Rotation) -> bool {
        self.passing(from, to).any(|(surface, angles, spacing)| surface.meets_defect(angles, spacing))
    }

    /// Calls `visit` with the part of the rotation at every passage of a contact over the start or the end of a local defect.
    pub fn each_edge(&self, from: &Rotation, to: &Rotation, mut visit: impl FnMut(f64)) {
        for (surface, angles, spacing) in self.passing(from, to) {
            surface.each_edge(angles, spacing, &mut visit);
        }
    }

    /// Every surface with the angles of its first contact at two states, and the spacing of its contacts.
    fn passing(&self, from: &Rotation, to: &Rotation) -> impl Iterator<Item = (&Raceway, [f64; 2], f64)> {
        let spacing = TAU / self.ball_positions.len() as f64;
        let inner = [from, to].map(|at| at.cage_angle - at.shaft_angle);
        let turned = [from, to].map(|at| self.ball_angle(at));
        let on_balls = self.balls.iter().flat_map(move |ball| {
            [(&ball.surface[0], turned.map(|angle| angle + PI), TAU), (&ball.surface[1], turned, TAU)]
        });
        let races =
            [(&self.inner, inner, spacing), (&self.outer, [from, to].map(|at| at.cage_angle), spacing)];
        races.into_iter().chain(on_balls).filter(|(surface, ..)| surface.has_defects())
    }

    /// Angle χ by which the balls have turned \[rad\].
    fn ball_angle(&self, rotation: &Rotation) -> f64 {
        let [by_cage, by_shaft] = self.spin;
        by_cage * (rotation.cage_angle - self.initial_cage_angle) + by_shaft * rotation.shaft_angle
    }

    /// The profile at the given cage and shaft angles, with rates from their speeds.
    pub fn at_rotation(&self, rotation: &Rotation) -> ProfileState<'_> {
        let Rotation { cage_angle, cage_speed, shaft_angle, shaft_speed } = *rotation;
        let cage_speed = cage_speed.unwrap_or(0.0);
        let [by_cage, by_shaft] = self.spin;
        let race = |race: &Raceway, angle, rate| match race.has_waves() {
            true => SurfaceAngle::new(angle, rate),
            false => SurfaceAngle::angle_only(angle, rate),
        };
        ProfileState {
            profile: self,
            inner: race(&self.inner, cage_angle - shaft_angle, cage_speed - shaft_speed),
            outer: race(&self.outer, cage_angle, cage_speed),
            ball: if self.balls.is_empty() {
                SurfaceAngle::default()
            } else {
                SurfaceAngle::new(self.ball_angle(rotation), by_cage * cage_speed + by_shaft * shaft_speed)
            },
        }
    }
}

impl ProfileState<'_> {
    /// Calls `visit` with every ball that may have a deviation apart from waves of the races, possibly more than once: with
    /// local defects on the races alone, only the balls at a defect.
    #[inline]
    pub fn each_deviating(&self, mut visit: impl FnMut(usize)) {
        let profile = self.profile;
        let balls = profile.ball_positions.len();
        if !profile.balls.is_empty() {
            (0..balls).for_each(visit);
            return;
        }
        let spacing = TAU / balls as f64;
        for (race, turn) in [(&profile.inner, &self.inner), (&profile.outer, &self.outer)] {
            race.each_on_defect(turn.angle, spacing, |k| visit(k % balls));
        }
    }

    /// Deviation at the contacts of ball j, positive where it narrows the gap.
    #[inline]
    pub fn ball(&self, j: usize) -> Deviation {
        let mut out = self.without_race_waves(j);
        for (contact, (race, turn)) in self.races().into_iter().enumerate() {
            add_waves(&mut out, contact, race, &turn.advanced_by(self.profile.ball_positions[j]));
        }
        out
    }

    /// The same without the waves of the races.
    #[inline]
    pub fn without_race_waves(&self, j: usize) -> Deviation {
        const HALF_TURN: [f64; 3] = [PI, -1.0, 0.0];
        let profile = self.profile;
        let mut out = Deviation::default();
        for (contact, (race, turn)) in self.races().into_iter().enumerate() {
            self.add_defects(&mut out, contact, race, &turn.advanced_by(profile.ball_positions[j]));
        }
        if let Some(ball) = profile.balls.get(j) {
            let turns = [self.ball.advanced_by(HALF_TURN), self.ball];
            for (contact, (surface, turn)) in ball.surface.iter().zip(&turns).enumerate() {
                add_waves(&mut out, contact, surface, turn);
                self.add_defects(&mut out, contact, surface, turn);
            }
            out.height.iter_mut().for_each(|height| *height += ball.oversize);
        }
        out
    }

    /// What the waves of both races make of height and rate, at balls with these cosines and sines of 2πj/Z.
    #[inline(always)]
    pub(crate) fn race_waves<S: Simd>(&self, simd: S, [ball_cos, ball_sin]: [Lanes<S>; 2]) -> [Lanes<S>; 2] {
        let [mut height, mut rate] = [Lanes::splat(simd, 0.0); 2];
        for (race, turn) in self.races() {
            if race.has_waves() {
                let cos = ball_cos * turn.cos - ball_sin * turn.sin;
                let sin = ball_cos * turn.sin + ball_sin * turn.cos;
                let [value, slope] = race.waves_in_lanes(simd, cos, sin);
                height += value;
                rate += slope * turn.rate;
            }
        }
        [height, rate]
    }

    /// Inner and outer race with the angle of ball 0 on them.
    #[inline(always)]
    fn races(&self) -> [(&Raceway, &SurfaceAngle); 2] {
        [(&self.profile.inner, &self.inner), (&self.profile.outer, &self.outer)]
    }

    #[inline]
    fn add_defects(&self, out: &mut Deviation, contact: usize, surface: &Raceway, turn: &SurfaceAngle) {
        if !surface.has_defects() {
            return;
        }
        match self.profile.law {
            Law::Force(stiffness, _) => out.defect_force += stiffness * surface.signed_power_sum(turn.angle),
            law => {
                let [height, slope] = surface.defects(turn.angle);
                out.height[contact] += height;
                let rate = if law == Law::Undamped { &mut out.undamped_rate } else { &mut out.rate };
                rate[contact] += slope * turn.rate;
            }
        }
    }
}

#[inline]
fn add_waves(out: &mut Deviation, contact: usize, surface: &Raceway, turn: &SurfaceAngle) {
    if surface.has_waves() {
        let [height, slope] = surface.waves(turn.cos, turn.sin);
        out.height[contact] += height;
        out.rate[contact] += slope * turn.rate;
    }
}

/// A defect as seen at one contact; `None` when it has no size.
fn feature(defect: &Defect, g: &BallGeometry, contact: usize) -> Option<Feature> {
    let height = defect.height(g);
    if height == 0.0 || defect.width == 0.0 {
        return None;
    }
    let path = match defect.form {
        DefectForm::Dent { shape, .. } | DefectForm::Bump { shape, .. } => {
            Path::smooth(shape, height, defect.width)
        }
        DefectForm::Spall { depth, edge_radius } => Path::Spall {
            path: SpallPath::on(defect.surface, g, defect.width, depth, edge_radius)[contact],
            width: defect.width,
        },
    };
    let start = SurfaceAngle::new(defect.start, 0.0).angle;
    Some(Feature { start, angle: defect.angle(g), path })
}
