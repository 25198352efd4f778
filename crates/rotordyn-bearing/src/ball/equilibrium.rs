//! Quasi-static equilibrium of a ball with inertia: inner and outer contact angles, centrifugal force and
//! gyroscopic moment (Jones 1960, Harris ch. 9).
//!
//! In the plane (radial, axial) the ball's centre is at b from the outer groove centre and the inner groove centre
//! at s. With y = b, x = s − b, n = y/|y| or x/|x| at angle α, t = (−sin α, cos α), the approaches are
//! δ_o = |y| − (r_o − D/2) + w_o and δ_i = |x| − (r_i − D/2) + w_i, and the ball is in equilibrium when
//!
//! Q_i n_i + f_i t_i − Q_o n_o − f_o t_o + F_c e_r = 0, F_c = ½ m D_pw ω_c².
//!
//! f_i = 2 φ M/D and f_o = 2 (1 − φ) M/D are the friction forces that balance the gyroscopic moment
//! M = dL/dt = ω_c J ω_r, J = m D²/10, ω_r the radial part of the ball's rotation, outward for a positive contact
//! angle. Pure rolling without spin on the outer race gives ω_r = ω_c sin α_o / γ′, γ′ = D/D_pw, on the inner
//! race ω_r = (Ω − ω_c) sin α_i / γ′: the same as Harris' attitude (pitch) angles
//! tan β = sin α_o/(cos α_o + γ′) and sin α_i/(cos α_i − γ′). The share φ of the inner race is 0 for outer-race
//! control, 1 for inner-race control and Q_i/(Q_i + Q_o) when shared, with ω_r the mean by the same shares.
//! After Harris both races share the friction alike under inner-race control, f_i = f_o = M/D.
//! Inner-race control fades smoothly as Q_i falls below F_c, since an unloaded race has no friction.
//!
//! The signs follow from dL/dt, as for a ball rolling in a bowl: on the outer race alone, friction adds 2/5
//! to the centrifugal force along the race, F_c (7/5) sin α_o.

use super::plane_motion::PlaneMotion;
use crate::contact::{ContactLoad, Race};
use crate::material::Material;
use crate::{BallGeometry, BallInertia, Rotation, root_finding};

const MAX_ITERATIONS: usize = 40;
/// Full Newton steps before the line search demands a decrease; nearly all balls converge in two to six.
const FULL_STEP_ITERATIONS: usize = 8;

pub(super) type Matrix = [[f64; 2]; 2];

/// Geometry and inertia of a row's balls.
#[derive(Clone, Copy, Debug)]
pub(super) struct BallInertiaData {
    pub control: BallInertia,
    /// Centrifugal force, if it is given \[N\].
    given_force: Option<f64>,
    /// Share of the controlling race in the friction where it carries the ball's rolling.
    friction_share: f64,
    /// M/(D F_c sin α) of rolling on the outer race: 1/5, or 0 without gyroscopic moment.
    moment: f64,
    /// ½ m D_pw, the centrifugal force per ω_c² \[kg m\].
    centrifugal: f64,
    /// D/D_pw.
    pub gamma: f64,
    /// r − D/2 at the inner and outer race \[m\].
    pub lengths: [f64; 2],
    /// r_i, moment arm of friction about the inner groove centre \[m\].
    pub groove_radius: f64,
}

/// Inertial loads of the balls at one speed: centrifugal force and gyroscopic moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct BallInertiaLoads {
    pub balls: BallInertiaData,
    /// Centrifugal force F_c \[N\], and ∂F_c/∂ω_c.
    pub force: f64,
    pub force_by_orbit: f64,
    /// (Ω − ω_c)/ω_c, and its derivative by ω_c.
    relative_cage_ratio: f64,
    relative_by_orbit: f64,
    /// Approach of the outer contact under F_c alone \[m\].
    pub centrifugal_approach: f64,
}

/// A ball's contact with one race: unit vector and distance to its groove centre, approach and load.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct RaceContact {
    pub n: [f64; 2],
    pub length: f64,
    pub approach: f64,
    pub loaded: ContactLoad,
}

/// A ball in equilibrium.
#[derive(Clone, Copy, Debug)]
pub(super) struct BallEquilibrium {
    pub inner: RaceContact,
    pub outer: RaceContact,
}

/// A bearing's contact law: both contacts in series, each contact alone, and an estimated approach at a load.
pub(super) struct BallContactLaws<Series, Single, Guess> {
    pub series: Series,
    pub single: Single,
    pub guess: Guess,
    /// Dry stiffness of both contacts in series \[N/m^1.5\].
    pub stiffness: f64,
}

/// Start of the Newton iteration: ball centre and approaches.
pub(super) struct InitialGuess {
    pub centre: [f64; 2],
    pub approaches: [f64; 2],
}

/// Race forces on a ball, R = Q n + f t at each contact, with derivatives by x and y.
pub(super) struct RaceForces {
    pub inner: [f64; 2],
    outer: [f64; 2],
    /// By x and by y.
    pub inner_by: [Matrix; 2],
    pub outer_by: [Matrix; 2],
    /// f_i with its derivatives, f_o.
    pub friction: [f64; 2],
    pub friction_by: [[f64; 2]; 2],
    /// Inner race's share φ.
    pub share: f64,
}

impl BallInertiaData {
    /// `None` for massless balls.
    pub fn new(geometry: &BallGeometry, material: &Material, control: BallInertia) -> Option<Self> {
        let control = control.in_effect();
        let given_force = match control {
            BallInertia::None => return None,
            BallInertia::CentrifugalForce(force) => Some(force),
            _ => None,
        };
        let d = geometry.ball_diameter;
        let mass = material.density * std::f64::consts::PI / 6.0 * d.powi(3);
        Some(Self {
            control,
            given_force,
            friction_share: control.friction_share(),
            moment: if control.has_moment() { 0.2 } else { 0.0 },
            centrifugal: 0.5 * mass * geometry.pitch_diameter,
            gamma: d / geometry.pitch_diameter,
            lengths: [geometry.inner_groove_radius - 0.5 * d, geometry.outer_groove_radius - 0.5 * d],
            groove_radius: geometry.inner_groove_radius,
        })
    }

    /// F_c at a cage speed \[rad/s\], and its derivative.
    #[inline]
    pub fn centrifugal_force(&self, cage_speed: f64) -> [f64; 2] {
        match self.given_force {
            Some(force) => [force, 0.0],
            None => [self.centrifugal * cage_speed * cage_speed, 2.0 * self.centrifugal * cage_speed],
        }
    }

    /// Inertial loads (centrifugal, gyroscopic) at a cage speed `orbit` \[rad/s\]; `None` at rest.
    pub fn inertial_loads(
        &self,
        cage_speed: f64,
        rotation: &Rotation,
        outer_at: impl Fn(f64) -> ContactLoad,
        guess: impl Fn(f64) -> f64,
    ) -> Option<BallInertiaLoads> {
        let [force, force_by_orbit] = self.centrifugal_force(cage_speed);
        let relative = if self.moment > 0.0 { rotation.shaft_speed / cage_speed } else { 1.0 };
        (force > 0.0).then(|| BallInertiaLoads {
            balls: *self,
            force,
            force_by_orbit,
            relative_cage_ratio: relative - 1.0,
            relative_by_orbit: if self.moment > 0.0 { -relative / cage_speed } else { 0.0 },
            centrifugal_approach: root_finding::increasing_root(
                |x| {
                    let at = outer_at(x);
                    [at.load - force, at.slope]
                },
                guess(force),
            ),
        })
    }
}

impl RaceContact {
    /// Contact with the vector `to` from ball centre to groove centre (at the outer race from groove to ball
    /// centre).
    #[inline(always)]
    pub fn from_vector(to: [f64; 2], free_length: f64, wave: f64) -> Self {
        let length = (to[0] * to[0] + to[1] * to[1]).sqrt();
        let inverse = 1.0 / length;
        Self {
            n: [to[0] * inverse, to[1] * inverse],
            length,
            approach: length - free_length + wave,
            loaded: ContactLoad::default(),
        }
    }

    pub fn t(&self) -> [f64; 2] {
        [-self.n[1], self.n[0]]
    }

    /// ∂(Q n + f t)/∂(vector) without the change of f: Q′ n nᵀ + (Q/l) t tᵀ − (f/l) n tᵀ.
    #[inline(always)]
    pub fn tangent(&self, friction: f64) -> Matrix {
        let [nr, nz] = self.n;
        let bend = self.loaded.load / self.length;
        let drag = friction / self.length;
        let (k, cross) = (self.loaded.slope, (self.loaded.slope - bend) * nr * nz);
        [
            [k * nr * nr + bend * nz * nz + drag * nr * nz, cross - drag * nr * nr],
            [cross + drag * nz * nz, k * nz * nz + bend * nr * nr - drag * nr * nz],
        ]
    }
}

impl BallInertiaLoads {
    /// Whether the inner race may carry part of the friction, and so transmit a friction moment.
    pub fn inner_race_has_friction(&self) -> bool {
        self.balls.moment > 0.0 && self.balls.control != BallInertia::OuterRaceControl
    }

    /// Share φ of the inner race in the friction, and its derivatives by Q_i and Q_o.
    pub fn share(&self, inner: f64, outer: f64) -> (f64, f64, f64) {
        match self.balls.control {
            BallInertia::InnerRaceControl | BallInertia::HarrisInnerRaceControl => {
                let x = (inner / self.force).min(1.0);
                (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x) / self.force, 0.0)
            }
            BallInertia::Shared => {
                let sum = inner + outer;
                if sum <= 0.0 {
                    return (0.0, 0.0, 0.0);
                }
                (inner / sum, outer / (sum * sum), -inner / (sum * sum))
            }
            _ => (0.0, 0.0, 0.0),
        }
    }

    /// M/D over sin α for rolling on the inner and on the outer race alone: J ω_c²/(γ′ D) = F_c/5; 0 without
    /// gyroscopic moment.
    #[inline(always)]
    fn unit_moments(&self) -> [f64; 2] {
        [self.balls.moment * self.force * self.relative_cage_ratio, self.balls.moment * self.force]
    }

    /// Derivatives of friction forces (inner, outer) and share by ω_c at a fixed ball.
    pub fn friction_by_orbit(&self, inner: &RaceContact, outer: &RaceContact) -> ([f64; 2], f64) {
        let (share, ..) = self.share(inner.loaded.load, outer.loaded.load);
        let by_orbit = self.force_by_orbit;
        let share_by = match self.balls.control {
            BallInertia::InnerRaceControl | BallInertia::HarrisInnerRaceControl => {
                let x = (inner.loaded.load / self.force).min(1.0);
                -6.0 * x * x * (1.0 - x) * by_orbit / self.force
            }
            _ => 0.0,
        };
        let [ui, uo] = self.unit_moments();
        let relative = by_orbit * self.relative_cage_ratio + self.force * self.relative_by_orbit;
        let [mi, mo] = [ui * inner.n[1], uo * outer.n[1]];
        let moment = share * mi + (1.0 - share) * mo;
        let moment_by = share_by * (mi - mo)
            + self.balls.moment * (share * relative * inner.n[1] + (1.0 - share) * by_orbit * outer.n[1]);
        let part = self.balls.friction_share;
        let friction = [
            2.0 * part * (share_by * moment + share * moment_by),
            2.0 * ((1.0 - part * share) * moment_by - part * share_by * moment),
        ];
        (friction, share_by)
    }

    #[inline(always)]
    pub fn forces(&self, inner: &RaceContact, outer: &RaceContact) -> RaceForces {
        let (share, by_inner, by_outer) = self.share(inner.loaded.load, outer.loaded.load);
        let unit = self.unit_moments();
        let moments = [unit[0] * inner.n[1], unit[1] * outer.n[1]];
        let moment = share * moments[0] + (1.0 - share) * moments[1];
        let part = self.balls.friction_share;
        let friction = [2.0 * part * share * moment, 2.0 * (1.0 - part * share) * moment];
        let (ti, to) = (inner.t(), outer.t());
        let mut out = RaceForces {
            inner: [0, 1].map(|k| inner.loaded.load * inner.n[k] + friction[0] * ti[k]),
            outer: [0, 1].map(|k| outer.loaded.load * outer.n[k] + friction[1] * to[k]),
            inner_by: [inner.tangent(friction[0]), Matrix::default()],
            outer_by: [Matrix::default(), outer.tangent(friction[1])],
            friction,
            friction_by: [[0.0; 2]; 2],
            share,
        };
        // Derivatives by x through α_i and Q_i, by y through α_o and Q_o.
        let angle = [
            share * unit[0] * inner.n[0] / inner.length,
            (1.0 - share) * unit[1] * outer.n[0] / outer.length,
        ];
        let load = [by_inner * inner.loaded.slope, by_outer * outer.loaded.slope];
        let spread = moments[0] - moments[1];
        for (v, (t, n)) in [(ti, inner.n), (to, outer.n)].into_iter().enumerate() {
            for k in 0..2 {
                let moment_by = angle[v] * t[k] + load[v] * spread * n[k];
                let share_by = load[v] * n[k];
                let fi = 2.0 * part * (share_by * moment + share * moment_by);
                let fo = 2.0 * ((1.0 - part * share) * moment_by - part * share_by * moment);
                out.friction_by[v][k] = fi;
                for r in 0..2 {
                    out.inner_by[v][r][k] += ti[r] * fi;
                    out.outer_by[v][r][k] += to[r] * fo;
                }
            }
        }
        out
    }

    /// Resultant of contact and centrifugal forces on the ball (equilibrium residual).
    pub fn resultant(&self, forces: &RaceForces) -> [f64; 2] {
        [forces.inner[0] - forces.outer[0] + self.force, forces.inner[1] - forces.outer[1]]
    }

    /// Initial estimate of the ball position: offset h from the line of groove centres at which the restoring
    /// force Q_i h/a, a = l_i l_o/(l_i + l_o), balances the transverse force T = (7/5) F_c |sin α|; h adds
    /// h²/(2a) to the approach.
    pub fn initial_guess(
        &self,
        laws: &BallContactLaws<
            impl Fn(f64) -> ContactLoad,
            impl Fn(Race, f64) -> ContactLoad,
            impl Fn(Race, f64) -> f64,
        >,
        s: [f64; 2],
        waves: f64,
    ) -> InitialGuess {
        let [li, lo] = self.balls.lengths;
        let distance = (s[0] * s[0] + s[1] * s[1]).sqrt();
        let n = [s[0] / distance, s[1] / distance];
        let approach = distance - li - lo + waves;
        let aside = 1.4 * self.force * n[1].abs();
        let a = li * lo / (li + lo);
        // h at δ = 0: K (h²/2a)^{3/2} h/a = T.
        let free = (aside * (2.0 * a).powi(2) * (0.5 * a).sqrt() / laws.stiffness).sqrt();
        let massless = (laws.series)(approach).load;
        let square = if massless > 0.0 {
            free.min((aside * a / massless).powi(2))
        } else {
            free - 2.0 * a * approach.min(0.0)
        };
        let h = square.sqrt().min(0.9 * lo);
        let load = if h > 0.0 { aside * a / h } else { massless }.max(1e-3 * self.force);
        let along = 0.5 * (distance * distance + lo * lo - li * li) / distance;
        let side = if n[1] < 0.0 { -h } else { h };
        InitialGuess {
            centre: [along * n[0] + side * n[1], along * n[1] - side * n[0]],
            approaches: [
                (laws.guess)(Race::Inner, load),
                (laws.guess)(Race::Outer, load + self.force * n[0].max(0.0)),
            ],
        }
    }

    /// Equilibrium of the ball with the inner groove centre at s (Newton-Raphson iteration).
    ///
    /// If the centrifugal force holds the ball on the outer race without inner contact, that position is the
    /// exact solution. Otherwise both races are loaded: Newton in b with the approaches as separate unknowns
    /// e, tied to the geometry only in the linear step. This avoids small steps for a stiff contact on a
    /// curved path; at convergence e equals the geometric approach.
    #[inline(always)]
    pub fn solve_equilibrium(
        &self,
        laws: &BallContactLaws<
            impl Fn(f64) -> ContactLoad,
            impl Fn(Race, f64) -> ContactLoad,
            impl Fn(Race, f64) -> f64,
        >,
        motion: &PlaneMotion,
    ) -> BallEquilibrium {
        let single = &laws.single;
        let (s, [wi, wo]) = (motion.s, motion.deviation.height);
        let [li, lo] = self.balls.lengths;
        let sides = |b: [f64; 2]| {
            (
                RaceContact::from_vector([s[0] - b[0], s[1] - b[1]], li, wi),
                RaceContact::from_vector(b, lo, wo),
            )
        };
        let mut b = [lo + self.centrifugal_approach - wo, 0.0];
        let (mut inner, mut outer) = sides(b);
        inner.loaded = single(Race::Inner, inner.approach);
        if inner.loaded.load <= 0.0 {
            outer.loaded = single(Race::Outer, outer.approach);
            return BallEquilibrium { inner, outer };
        }
        let first = self.initial_guess(laws, s, wi + wo);
        b = first.centre;
        let mut e = first.approaches;
        let mut loads = [single(Race::Inner, e[0]), single(Race::Outer, e[1])];
        for iteration in 0..MAX_ITERATIONS {
            (inner, outer) = sides(b);
            (inner.loaded, outer.loaded) = (loads[0], loads[1]);
            let slopes = loads.map(|l| l.slope);
            let gap = [inner.approach - e[0], outer.approach - e[1]];
            let forces = self.forces(&inner, &outer);
            let force = self.resultant(&forces);
            let load_error = [slopes[0] * gap[0], slopes[1] * gap[1]];
            // Round-off of the loads due to round-off in |x| and |y|.
            let round_off = 4e-16 * (slopes[0] * inner.length + slopes[1] * outer.length);
            let residual_norm =
                force[0].abs().max(force[1].abs()).max(load_error[0].abs()).max(load_error[1].abs());
            if residual_norm <= round_off {
                (inner, outer) = sides(b);
                (inner.loaded, outer.loaded) =
                    (single(Race::Inner, inner.approach), single(Race::Outer, outer.approach));
                return BallEquilibrium { inner, outer };
            }
            let residual =
                [0, 1].map(|k| -force[k] - load_error[0] * inner.n[k] + load_error[1] * outer.n[k]);
            let by_x = difference(&forces.inner_by[0], &forces.outer_by[0]);
            let by_y = difference(&forces.inner_by[1], &forces.outer_by[1]);
            let step = solve_2x2(&difference(&by_y, &by_x), residual);
            let along = |n: [f64; 2]| n[0] * step[0] + n[1] * step[1];
            let de = [gap[0] - along(inner.n), gap[1] + along(outer.n)];
            // Line search: halve the step while a contact would open; after FREE_ITERATIONS, also without
            // decrease.
            let merit = |force: [f64; 2], gap: [f64; 2]| {
                let lag = [slopes[0] * gap[0], slopes[1] * gap[1]];
                force[0] * force[0] + force[1] * force[1] + lag[0] * lag[0] + lag[1] * lag[1]
            };
            let before = merit(force, gap);
            let mut length = 1.0;
            for _ in 0..50 {
                let trial = [e[0] + length * de[0], e[1] + length * de[1]];
                let at = [single(Race::Inner, trial[0]), single(Race::Outer, trial[1])];
                let mut accept = at[0].load > 0.0 && at[1].load > 0.0;
                let centre = [b[0] + length * step[0], b[1] + length * step[1]];
                if accept && iteration >= FULL_STEP_ITERATIONS {
                    let (mut i, mut o) = sides(centre);
                    (i.loaded, o.loaded) = (at[0], at[1]);
                    let force = self.resultant(&self.forces(&i, &o));
                    let gap = [i.approach - trial[0], o.approach - trial[1]];
                    accept = merit(force, gap) <= (1.0 - 1e-3 * length) * before;
                }
                if accept {
                    (b, e, loads) = (centre, trial, at);
                    break;
                }
                length *= 0.5;
            }
        }
        self.solve_between_bounds(single, s, &sides)
    }

    /// The same equilibrium between bounds, in polar coordinates about the outer groove centre: the force
    /// balance along the outer contact line gives its length, the balance across it the angle. Slow robust
    /// fallback.
    #[cold]
    fn solve_between_bounds(
        &self,
        single: &impl Fn(Race, f64) -> ContactLoad,
        s: [f64; 2],
        sides: &impl Fn([f64; 2]) -> (RaceContact, RaceContact),
    ) -> BallEquilibrium {
        let at = |angle: f64, length: f64| {
            let (mut inner, mut outer) = sides([length * angle.cos(), length * angle.sin()]);
            inner.loaded = single(Race::Inner, inner.approach);
            outer.loaded = single(Race::Outer, outer.approach);
            let force = self.resultant(&self.forces(&inner, &outer));
            let (n, t) = (outer.n, outer.t());
            (inner, outer, force[0] * n[0] + force[1] * n[1], force[0] * t[0] + force[1] * t[1])
        };
        let reach = self.balls.lengths[0] + self.balls.lengths[1];
        let length = |angle: f64| {
            root_finding::bracketed_root(
                |l| -at(angle, l).2,
                [1e-3 * self.balls.lengths[1], self.balls.lengths[1] + reach],
            )
        };
        // From the direction of the centrifugal force (angle 0) towards the inner groove centre.
        let line = s[1].atan2(s[0]);
        let sign = if line < 0.0 { 1.0 } else { -1.0 };
        let share = root_finding::bracketed_root(|x| sign * at(x * line, length(x * line)).3, [0.0, 1.0]);
        let (inner, outer, ..) = at(share * line, length(share * line));
        BallEquilibrium { inner, outer }
    }
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(super) fn difference(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1].map(|r| [0, 1].map(|c| a[r][c] - b[r][c]))
}

/// Solution x of the 2×2 system A x = r.
pub(super) fn solve_2x2(a: &Matrix, r: [f64; 2]) -> [f64; 2] {
    let determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    [(a[1][1] * r[0] - a[0][1] * r[1]) / determinant, (a[0][0] * r[1] - a[1][0] * r[0]) / determinant]
}
