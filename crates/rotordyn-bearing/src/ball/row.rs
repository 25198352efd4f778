//! One row of balls between two rings: ball positions and the sum of the ball forces.

use super::cage::CageKinematics;
use super::equilibrium::{BallContactLaws, BallEquilibrium, BallInertiaData, BallInertiaLoads};
use super::plane_motion::PlaneMotion;
use super::preload_mechanism::PreloadMechanism;
use super::ring_motion::RingMotion;
use super::row_kernel::{KernelParameters, RowForce, RowKernel};
use super::sum::{BallSum, PlaneForce, PlaneMoment};
use super::{defect_force, massless};
use crate::contact::{BallContacts, ContactDamping, HertzPair, Race, SpeedContacts};
use crate::{BallBearing, BallLoad, Profile, Rotation};

/// A row of balls prepared for evaluation: constants and per-ball data laid out as arrays.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub contacts: BallContacts,
    /// Distance of the groove centres with an unloaded ball, A = r_i + r_o − D_w \[m\].
    pub centre_distance: f64,
    /// Radius of the circle of inner groove centres R_i \[m\].
    pub arm: f64,
    /// Groove-centre offset of the centred bearing: radial A cos α₀ − P_d/2, axial A sin α₀ \[m\]; P_d as mounted,
    /// at rest.
    offset: [f64; 2],
    /// The bearing, if its clearance changes with speed (centrifugal ring growth).
    speed_dependent_bearing: Option<Box<BallBearing>>,
    pub damping: ContactDamping,
    /// Inertia of the balls; `None` for massless balls.
    pub inertia: Option<BallInertiaData>,
    pub cage: CageKinematics,
    /// ±1: direction of preload (thrust) on the inner ring.
    pub direction: f64,
    pub preload_mechanism: PreloadMechanism,
    /// Entrainment speed over shaft speed, D_pw/4 (1 − γ²) \[m\].
    entrainment: f64,
    /// cos and sin of 2πj/Z.
    spacing: Vec<[f64; 2]>,
    /// Deviations of races and balls; `None` when they are perfect.
    pub profile: Option<Box<Profile>>,
    /// The same in SIMD, for the simplest kind of row.
    kernel: Option<RowKernel>,
}

/// Operating conditions common to all balls of a row during one evaluation.
#[derive(Clone, Debug)]
pub(super) struct OperatingState<'a> {
    pub contacts: SpeedContacts<'a>,
    /// Groove-centre offset with clearance change and preload \[m\].
    pub offset: [f64; 2],
    /// Rigid preload contained in `offset`, in the direction of thrust \[m\].
    pub preload: f64,
    /// Centrifugal force and gyroscopic moment of the balls; `None` at rest and for massless balls.
    pub inertial_loads: Option<BallInertiaLoads>,
}

impl Row {
    /// Row `number` of a matched pair with its thrust direction.
    pub fn new(bearing: &BallBearing, number: usize, thrust_direction: f64) -> Self {
        let g = &bearing.geometry;
        let a = g.inner_groove_radius + g.outer_groove_radius - g.ball_diameter;
        let gamma = g.ball_diameter / g.pitch_diameter * g.contact_angle.cos();
        let spacing: Vec<_> = (0..g.balls)
            .map(|j| {
                let angle = std::f64::consts::TAU * j as f64 / g.balls as f64;
                [angle.cos(), angle.sin()]
            })
            .collect();
        let mut row = Self {
            contacts: BallContacts::new(bearing.hertz(), bearing.contact.clone()),
            centre_distance: a,
            arm: g.inner_centre_radius(),
            offset: [
                a * g.contact_angle.cos() - 0.5 * (g.radial_clearance + bearing.clearance_change(0.0)),
                a * g.contact_angle.sin() * thrust_direction,
            ],
            speed_dependent_bearing: bearing.fit.speed_growth.then(|| Box::new(bearing.clone())),
            damping: bearing.damping,
            inertia: BallInertiaData::new(g, &bearing.ball_material, bearing.inertia),
            cage: CageKinematics::new(bearing),
            direction: if thrust_direction < 0.0 { -1.0 } else { 1.0 },
            preload_mechanism: PreloadMechanism::Fixed(0.0),
            entrainment: 0.25 * g.pitch_diameter * (1.0 - gamma * gamma),
            kernel: None,
            spacing,
            profile: None,
        };
        let pair = bearing.hertz();
        let (imperfections, start) = (&bearing.imperfections, bearing.cage_angle);
        row.profile = Profile::new(g, imperfections, number, start, pair.stiffness).map(Box::new);
        row.preload_mechanism =
            PreloadMechanism::new(&bearing.preload, |offset| row.dry_axial(&pair, offset));
        row.kernel = row.new_kernel();
        row
    }

    /// The SIMD kernel; `None` unless every ball is a dry Hertzian spring with constant damping and rigid preload.
    fn new_kernel(&self) -> Option<RowKernel> {
        let ContactDamping::Constant { coefficient, ramp } = self.damping else { return None };
        let SpeedContacts::Hertz(pair) = self.contacts.at_speed(1.0) else { return None };
        if !matches!(self.preload_mechanism, PreloadMechanism::Fixed(_))
            || self.inertia.is_some()
            || self.has_ring_growth()
            || ramp <= 0.0
        {
            return None;
        }
        let parameters = KernelParameters {
            offset: self.operating(&RingMotion::at_rest(&[0.0; 6], &Rotation::default(), 0.0, false)).offset,
            arm: self.arm,
            centre_distance: self.centre_distance,
            stiffness: pair.stiffness,
            damping: [coefficient, ramp],
        };
        RowKernel::new(parameters, &self.spacing)
    }

    /// The kernel for a motion, and the surface profile there; `None` where defects act by the force law.
    fn kernel_at(&self, ring: &RingMotion) -> Option<(&RowKernel, Option<&Profile>)> {
        let kernel = self.kernel.as_ref().filter(|_| self.force_law(ring).is_none())?;
        Some((kernel, self.profile_at(ring)))
    }

    /// Whether there is one at every motion.
    pub fn has_kernel(&self) -> bool {
        self.kernel.is_some() && self.profile.as_ref().is_none_or(|profile| profile.force_law().is_none())
    }

    /// The force without tangents; `None` if the row has no [`RowKernel`] or its defects act by the force law.
    pub fn force(&self, ring: &RingMotion) -> Option<RowForce> {
        let (kernel, profile) = self.kernel_at(ring)?;
        Some(kernel.force(ring, profile))
    }

    /// Sum over all balls at a motion of the inner ring, while the contacts move in SIMD where the row has a [`RowKernel`].
    pub fn sum_at(&self, ring: &RingMotion) -> BallSum {
        match self.kernel_at(ring) {
            Some((kernel, profile)) if ring.cage_speed.is_some() => kernel.sum(ring, profile),
            _ => self.sum(ring, &self.operating(ring)),
        }
    }

    /// Axial force and stiffness of the dry centred row with massless balls, in the direction of thrust.
    fn dry_axial(&self, pair: &HertzPair, offset: f64) -> [f64; 2] {
        let motion = PlaneMotion {
            s: [self.offset[0], self.offset[1] + self.direction * offset],
            ..Default::default()
        };
        let contacts = SpeedContacts::Hertz(pair);
        let ball = massless::ball_force(
            |approach| pair.series(approach),
            &contacts,
            &self.damping,
            self.centre_distance,
            &motion,
        );
        let (ball, z) = (ball.unwrap_or_default(), self.balls() as f64);
        [z * self.direction * ball.force[1], z * ball.by_motion[3]]
    }

    /// Whether the clearance changes with speed (centrifugal growth of the inner ring).
    pub fn has_ring_growth(&self) -> bool {
        self.speed_dependent_bearing.is_some()
    }

    pub fn balls(&self) -> usize {
        self.spacing.len()
    }

    /// Whether the force at given displacement and velocity depends on shaft speed.
    pub fn depends_on_speed(&self) -> bool {
        !self.contacts.at_speed(1.0).is_dry()
            || self.speed_dependent_bearing.is_some()
            || self.inertia.is_some_and(|balls| balls.control.depends_on_speed())
    }

    /// Operating conditions of all balls at a motion of the ring.
    pub fn operating(&self, ring: &RingMotion) -> OperatingState<'_> {
        let rotation = ring.rotation;
        let speed = self.entrainment * rotation.shaft_speed.abs();
        let contacts = self.contacts.at_speed(speed);
        let loads = self.inertial_loads(ring.orbit, rotation, &contacts);
        let mut offset = self.offset;
        if let Some(bearing) = &self.speed_dependent_bearing {
            let change = bearing.clearance_change(rotation.shaft_speed) - bearing.clearance_change(0.0);
            offset[0] -= 0.5 * change;
        }
        let mut out = OperatingState { contacts, offset, preload: 0.0, inertial_loads: loads };
        out.preload = match self.preload_mechanism {
            PreloadMechanism::Fixed(offset) => offset,
            PreloadMechanism::Spring { .. } => 0.0,
            PreloadMechanism::Force { force, dry } => self.offset_at_force(force, dry, rotation, &out),
        };
        out.offset[1] += self.direction * out.preload;
        out
    }

    /// Σ F_c of the row at a cage speed \[N\].
    pub fn centrifugal_sum(&self, orbit: f64) -> f64 {
        self.inertia.map_or(0.0, |balls| self.balls() as f64 * balls.centrifugal_force(orbit)[0])
    }

    /// Inertial loads of the balls at a cage speed `orbit` \[rad/s\]; `None` at rest and for massless balls.
    pub fn inertial_loads(
        &self,
        orbit: f64,
        rotation: &Rotation,
        contacts: &SpeedContacts,
    ) -> Option<BallInertiaLoads> {
        let guess = |load| dry_approach(&self.contacts.hertz, Race::Outer, load);
        self.inertia?.inertial_loads(orbit, rotation, |x| contacts.single(Race::Outer, x), guess)
    }

    /// Axial force and stiffness of a centred row, where all balls carry the same load.
    pub fn centred_axial(
        &self,
        s: [f64; 2],
        operating: &OperatingState,
        loads: Option<&BallInertiaLoads>,
    ) -> (f64, f64) {
        let motion = PlaneMotion { s, ..PlaneMotion::default() };
        let ball = match loads {
            None => self.massless_force(&operating.contacts, &motion).unwrap_or_default(),
            Some(loads) => self.inertial_ball_reaction(loads, operating, &motion).0,
        };
        let z = self.balls() as f64;
        (z * ball.force[1], z * ball.by_motion[3])
    }

    /// Sum over all balls at a motion of the inner ring relative to the outer one.
    pub fn sum(&self, ring: &RingMotion, operating: &OperatingState) -> BallSum {
        if let Some(loads) = &operating.inertial_loads {
            return self.sum_with_inertia(ring, operating, loads);
        }
        let a = self.centre_distance;
        // One loop per contact law (monomorphised), to avoid dispatch per ball.
        match (&operating.contacts, self.force_law(ring)) {
            (law, Some(on_loaded)) => self.sum_balls(ring, operating, |motion| {
                defect_force::with_defect_force(self.massless_force(law, motion), on_loaded, motion)
            }),
            (dry @ SpeedContacts::Hertz(pair), None) => self.sum_balls(ring, operating, |motion| {
                massless::ball_force(|approach| pair.series(approach), dry, &self.damping, a, motion)
            }),
            (law, None) => self.sum_balls(ring, operating, |motion| self.massless_force(law, motion)),
        }
    }

    /// `Some` if defects act by the force law: whether on loaded balls only.
    fn force_law(&self, ring: &RingMotion) -> Option<bool> {
        self.profile_at(ring)?.force_law()
    }

    #[inline(always)]
    fn sum_balls(
        &self,
        ring: &RingMotion,
        operating: &OperatingState,
        react: impl Fn(&PlaneMotion) -> Option<PlaneForce>,
    ) -> BallSum {
        let mut sum = BallSum::default();
        self.for_each_ball(ring, operating, |[cos, sin], motion, turn| {
            if let Some(mut ball) = react(&motion) {
                // Cage rotation moves the ball past the ring: input power at a fixed ring.
                ball.power += ball.force[0] * turn[0] + ball.force[1] * turn[1];
                sum.add(cos, sin, &ball);
            }
        });
        sum
    }

    /// Sum over balls with inertial loads (centrifugal force, gyroscopic moment).
    fn sum_with_inertia(
        &self,
        ring: &RingMotion,
        operating: &OperatingState,
        loads: &BallInertiaLoads,
    ) -> BallSum {
        let mut sum = BallSum::default();
        self.for_each_ball(ring, operating, |[cos, sin], motion, turn| {
            let (mut ball, moment) = self.inertial_ball_reaction(loads, operating, &motion);
            ball.power += ball.force[0] * turn[0] + ball.force[1] * turn[1];
            ball.power -= moment.moment * (ring.v[3] * sin - ring.v[4] * cos);
            sum.add(cos, sin, &ball);
            if loads.inner_race_has_friction() {
                sum.add_moment(cos, sin, &moment);
            }
        });
        sum
    }

    /// Equilibrium of a ball with inertia, and its reaction on the inner ring.
    fn inertial_ball_reaction(
        &self,
        loads: &BallInertiaLoads,
        operating: &OperatingState,
        motion: &PlaneMotion,
    ) -> (PlaneForce, PlaneMoment) {
        let equilibrium = self.solve_equilibrium(loads, operating, motion);
        self.reaction_in_equilibrium(loads, operating, &equilibrium, motion)
    }

    /// Reaction of a ball in equilibrium on the inner ring.
    pub fn reaction_in_equilibrium(
        &self,
        loads: &BallInertiaLoads,
        operating: &OperatingState,
        equilibrium: &BallEquilibrium,
        motion: &PlaneMotion,
    ) -> (PlaneForce, PlaneMoment) {
        let stiffness = self.contacts.hertz.stiffness;
        loads.inner_ring_reaction(equilibrium, &operating.contacts, &self.damping, stiffness, motion)
    }

    /// Force of a massless ball under any contact law.
    pub fn massless_force(&self, contacts: &SpeedContacts, motion: &PlaneMotion) -> Option<PlaneForce> {
        massless::ball_force(|x| contacts.series(x), contacts, &self.damping, self.centre_distance, motion)
    }

    pub fn solve_equilibrium(
        &self,
        loads: &BallInertiaLoads,
        operating: &OperatingState,
        motion: &PlaneMotion,
    ) -> BallEquilibrium {
        let hertz = &self.contacts.hertz;
        match &operating.contacts {
            SpeedContacts::Hertz(pair) => loads.solve_equilibrium(
                &BallContactLaws {
                    series: |x| pair.series(x),
                    single: |race, x| pair.single(race, x),
                    guess: |race, load| dry_approach(hertz, race, load),
                    stiffness: hertz.stiffness,
                },
                motion,
            ),
            law => loads.solve_equilibrium(
                &BallContactLaws {
                    series: |x| law.series(x),
                    single: |race, x| law.single(race, x),
                    guess: |race, load| self.approach_at(law, race, load),
                    stiffness: hertz.stiffness,
                },
                motion,
            ),
        }
    }

    /// Estimated approach of a contact under a load Q ≥ 0 \[m\].
    pub fn approach_at(&self, law: &SpeedContacts, race: Race, load: f64) -> f64 {
        dry_approach(&self.contacts.hertz, race, load) - law.film(race, load)
    }

    /// Calls `visit` with (cos ψ_j, sin ψ_j), the ball's motion and the part of its rate due to cage
    /// rotation.
    #[inline(always)]
    pub fn for_each_ball(
        &self,
        ring: &RingMotion,
        operating: &OperatingState,
        mut visit: impl FnMut([f64; 2], PlaneMotion, [f64; 2]),
    ) {
        let RingMotion { d, v, rotation, .. } = *ring;
        let (r, cage_speed) = (self.arm, ring.cage_speed.unwrap_or(0.0));
        let (cage_sin, cage_cos) = rotation.cage_angle.sin_cos();
        // Zero rates in statics.
        let passing = self.profile_at(ring).map(|profile| profile.at_rotation(&ring.passing()));
        for (j, [cj, sj]) in self.spacing.iter().enumerate() {
            let cos = cage_cos * cj - cage_sin * sj;
            let sin = cage_sin * cj + cage_cos * sj;
            let turn = [cage_speed * (d[1] * cos - d[0] * sin), cage_speed * r * (d[3] * cos + d[4] * sin)];
            let mut motion = PlaneMotion {
                s: [
                    operating.offset[0] + d[0] * cos + d[1] * sin,
                    operating.offset[1] + d[2] + r * (d[3] * sin - d[4] * cos),
                ],
                rate: [v[0] * cos + v[1] * sin + turn[0], v[2] + r * (v[3] * sin - v[4] * cos) + turn[1]],
                ..PlaneMotion::default()
            };
            if let Some(passing) = &passing {
                motion.deviation = passing.ball(j);
            }
            visit([cos, sin], motion, turn);
        }
    }

    /// Surface profile, unless the motion leaves it out.
    fn profile_at(&self, ring: &RingMotion) -> Option<&Profile> {
        self.profile.as_deref().filter(|_| ring.with_defects)
    }

    /// Load of every ball under elastic forces alone; `row`: row number in a matched pair.
    pub fn ball_loads(&self, at_rest: &RingMotion, row: usize, out: &mut Vec<BallLoad>) {
        let operating = self.operating(at_rest);
        let d = self.with_ring_displacement(at_rest);
        let ring = RingMotion { d: &d, ..*at_rest };
        self.for_each_ball(&ring, &operating, |[cos, sin], motion, _| {
            let equilibrium =
                operating.inertial_loads.map(|loads| self.solve_equilibrium(&loads, &operating, &motion));
            let angle = |n: [f64; 2]| n[1].atan2(n[0]);
            let (loads, angles, deflection) = match equilibrium {
                Some(ball) => {
                    let (inner, outer) = (ball.inner, ball.outer);
                    let loads = [inner.loaded.load, outer.loaded.load];
                    (loads, [angle(inner.n), angle(outer.n)], inner.approach + outer.approach)
                }
                None => {
                    let distance = motion.s[0].hypot(motion.s[1]);
                    let deflection = distance - self.centre_distance + motion.deviation.total();
                    let elastic = operating.contacts.series(deflection).load;
                    let load = match self.force_law(&ring) {
                        Some(true) if elastic > 0.0 => (elastic + motion.deviation.defect_force).max(0.0),
                        Some(false) => elastic + motion.deviation.defect_force,
                        _ => elastic,
                    };
                    ([load; 2], [angle(motion.s); 2], deflection)
                }
            };
            out.push(BallLoad {
                row,
                position: sin.atan2(cos),
                load: loads[0],
                contact_angle: angles[0],
                deflection,
                outer_load: loads[1],
                outer_contact_angle: angles[1],
                film: [(Race::Inner, loads[0]), (Race::Outer, loads[1])]
                    .map(|(race, load)| if load > 0.0 { operating.contacts.film(race, load) } else { 0.0 }),
            });
        });
    }
}

/// Approach of a dry contact under a load Q ≥ 0: (Q/K)^{2/3}.
fn dry_approach(pair: &HertzPair, race: Race, load: f64) -> f64 {
    let stiffness = match race {
        Race::Inner => pair.inner.stiffness,
        Race::Outer => pair.outer.stiffness,
    };
    (load / stiffness).cbrt().powi(2)
}
