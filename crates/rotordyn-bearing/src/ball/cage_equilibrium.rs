//! Statics of balls with inertia: the cage speed at which the balls roll under the contact angles that their
//! own centrifugal force sets.
//!
//! At a ring displacement d the cage speed solves ω_c = Ω C(ᾱ(d, ω_c)), with C the ratio of rolling cage to
//! shaft speed and ᾱ the load-weighted mean contact angle, as at the end of a steady run. The tangent follows
//! by implicit differentiation: df/dd = ∂f/∂d + ∂f/∂ω_c · dω_c/dd,
//! dω_c/dd = Ω C′ ∂cos ᾱ/∂d / (1 − Ω C′ ∂cos ᾱ/∂ω_c).

use super::cage::MeanCos;
use super::change::{BallChange, BallChanges};
use super::duplex::displacement_at_offset;
use super::equilibrium::solve_2x2;
use super::plane_motion::PlaneMotion;
use super::preload_mechanism::PreloadMechanism;
use super::ring_motion::RingMotion;
use super::row::{OperatingState, Row};
use crate::{BallElement, Reaction, Rotation, root_finding};
use std::f64::consts::TAU;

/// Limits of the search for the ratio of cage to shaft speed.
const RATIOS: [f64; 2] = [0.0, 1.0];

/// Load sums of the balls and what they depend on.
#[derive(Clone, Copy, Debug, Default)]
struct LoadSums {
    /// Σ Q_i and Σ Q_i cos α.
    load: f64,
    load_cos: f64,
    /// Σ F_c and its derivative by the cage speed.
    centrifugal: f64,
    centrifugal_by_orbit: f64,
    /// Derivatives of the loads by the ring displacement and by the cage speed.
    load_by: [f64; 6],
    load_cos_by: [f64; 6],
    load_by_orbit: f64,
    load_cos_by_orbit: f64,
    /// Derivative of the force on the inner ring by the cage speed.
    force_by_orbit: [f64; 6],
    /// ∂f/∂z, and the derivatives of the axial ball force Σ p_z by the displacement.
    force_by_axial: [f64; 6],
    axial_by: [f64; 6],
}

impl LoadSums {
    fn add(&mut self, cos: f64, sin: f64, arm: f64, ball: &BallChanges, with_moment: bool) {
        self.load += ball.load;
        self.load_cos += ball.load_cos;
        let [radial, axial, orbit] = &ball.by;
        let on_ring = |r: f64, z: f64| [r * cos, r * sin, z, arm * z * sin, -arm * z * cos, 0.0];
        let add = |sum: &mut [f64; 6], by: [f64; 6]| sum.iter_mut().zip(by).for_each(|(s, b)| *s += b);
        add(&mut self.load_by, on_ring(radial.load, axial.load));
        add(&mut self.load_cos_by, on_ring(radial.load_cos, axial.load_cos));
        add(&mut self.axial_by, on_ring(radial.force[1], axial.force[1]));
        let force = |change: &BallChange| {
            let mut f = on_ring(change.force[0], change.force[1]).map(|f| -f);
            if with_moment {
                f[3] -= change.moment * sin;
                f[4] += change.moment * cos;
            }
            f
        };
        add(&mut self.force_by_orbit, force(orbit));
        add(&mut self.force_by_axial, force(axial));
        self.load_by_orbit += orbit.load;
        self.load_cos_by_orbit += orbit.load_cos;
    }

    /// The derivatives with the outer ring following on its preload spring of stiffness k, by
    /// dz = −(∂N/∂d · dd + ∂N/∂ω_c dω_c)/(∂N/∂z + k).
    fn follow_spring(&mut self, stiffness: f64) {
        let whole = self.axial_by[2] + stiffness;
        if whole <= 0.0 {
            return;
        }
        let by_orbit = self.force_by_orbit[2] / whole;
        let [load, load_cos] = [self.load_by[2], self.load_cos_by[2]];
        for k in 0..6 {
            let follow = -self.axial_by[k] / whole;
            self.load_by[k] += load * follow;
            self.load_cos_by[k] += load_cos * follow;
            self.force_by_orbit[k] += self.force_by_axial[k] * by_orbit;
        }
        self.load_by_orbit += load * by_orbit;
        self.load_cos_by_orbit += load_cos * by_orbit;
    }

    /// Adds a row at an axial offset from the station, see `duplex::displacement_at_offset`.
    fn add_row(&mut self, row: &Self, place: f64) {
        self.load += row.load;
        self.load_cos += row.load_cos;
        self.centrifugal += row.centrifugal;
        self.centrifugal_by_orbit += row.centrifugal_by_orbit;
        self.load_by_orbit += row.load_by_orbit;
        self.load_cos_by_orbit += row.load_cos_by_orbit;
        for (sum, by) in [
            (&mut self.load_by, &row.load_by),
            (&mut self.load_cos_by, &row.load_cos_by),
            (&mut self.force_by_orbit, &row.force_by_orbit),
        ] {
            sum.iter_mut().zip(by).for_each(|(s, b)| *s += b);
            sum[4] += place * by[0];
            sum[3] -= place * by[1];
        }
    }

    /// Mean cos α and its derivatives by the displacement and by the cage speed.
    fn mean_cos(&self, nominal: f64) -> (f64, [f64; 6], f64) {
        let mean = MeanCos::new(self.load, self.load_cos, self.centrifugal, nominal);
        let of = |load: f64, load_cos: f64| mean.by_load * load + mean.by_load_cos * load_cos;
        let by = std::array::from_fn(|k| of(self.load_by[k], self.load_cos_by[k]));
        let by_orbit =
            of(self.load_by_orbit, self.load_cos_by_orbit) + mean.by_centrifugal * self.centrifugal_by_orbit;
        (mean.value, by, by_orbit)
    }
}

/// Cage speed of a static state, with the derivatives that complete its tangent.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CageEquilibrium {
    /// ω_c \[rad/s\].
    pub orbit: f64,
    /// ∂f/∂ω_c and dω_c/dd; zero where the cage speed does not depend on the displacement.
    force_by: [f64; 6],
    orbit_by: [f64; 6],
}

impl CageEquilibrium {
    /// Adds the part of the tangent through the cage speed.
    pub fn complete_stiffness(&self, reaction: &mut Reaction) {
        for (row, force) in reaction.stiffness.iter_mut().zip(self.force_by) {
            for (entry, by) in row.iter_mut().zip(self.orbit_by) {
                *entry -= force * by;
            }
        }
    }
}

impl Row {
    /// Load sums of the row at a displacement of the ring at rest.
    fn load_sums(&self, ring: &RingMotion) -> LoadSums {
        let mut sums = LoadSums::default();
        let operating = self.operating(ring);
        let Some(loads) = operating.inertial_loads else { return sums };
        let balls = self.balls() as f64;
        (sums.centrifugal, sums.centrifugal_by_orbit) = (balls * loads.force, balls * loads.force_by_orbit);
        let d = self.with_ring_displacement(ring);
        self.for_each_ball(&ring.stopped_at(&d), &operating, |[cos, sin], motion, _| {
            let ball = loads.changes(&self.solve_equilibrium(&loads, &operating, &motion));
            sums.add(cos, sin, self.arm, &ball, loads.inner_race_has_friction());
        });
        if let PreloadMechanism::Spring { stiffness, .. } = self.preload_mechanism {
            sums.follow_spring(stiffness);
        }
        sums
    }

    /// Rigid preload at which the centred row carries an axial force at its speed, all balls alike.
    ///
    /// The offset is a property of the centred bearing: its balls have the inertial loads of the cage speed at
    /// which the centred bearing rolls, whatever the load in operation. `guess`: dry offset \[m\].
    pub fn offset_at_force(
        &self,
        force: f64,
        guess: f64,
        rotation: &Rotation,
        operating: &OperatingState,
    ) -> f64 {
        let s = |offset: f64| [operating.offset[0], operating.offset[1] + self.direction * offset];
        let at_orbit = |orbit: f64| {
            let loads = self.inertial_loads(orbit, rotation, &operating.contacts);
            let axial = |offset: f64| {
                let (n, slope) = self.centred_axial(s(offset), operating, loads.as_ref());
                [self.direction * n - force, slope]
            };
            root_finding::increasing_root(axial, guess)
        };
        let nominal = self.cage.nominal_ratio() * rotation.shaft_speed;
        if !self.cage_speed_is_solved(rotation) {
            return at_orbit(nominal);
        }
        let nominal_cos = self.cage.nominal_cos;
        let centred = |offset: f64, orbit: f64| {
            let loads = self.inertial_loads(orbit, rotation, &operating.contacts)?;
            let motion = PlaneMotion { s: s(offset), ..PlaneMotion::default() };
            let ball = loads.changes(&self.solve_equilibrium(&loads, operating, &motion));
            let mean = MeanCos::new(ball.load, ball.load_cos, loads.force, nominal_cos);
            (ball.load > 0.0).then_some((ball, mean, loads.force_by_orbit))
        };
        // Newton's method in offset and cage speed together.
        let (balls, turn) = (self.balls() as f64, rotation.shaft_speed * self.cage.ratio_by_cos());
        let (mut offset, mut orbit) = (guess, nominal);
        for _ in 0..30 {
            let Some((ball, mean, force_by_orbit)) = centred(offset, orbit) else { break };
            let mean_by = |by: &BallChange| mean.by_load * by.load + mean.by_load_cos * by.load_cos;
            let [_, by_axial, by_orbit] = &ball.by;
            let jacobian = [
                [balls * by_axial.force[1], balls * self.direction * by_orbit.force[1]],
                [
                    -turn * self.direction * mean_by(by_axial),
                    1.0 - turn * (mean_by(by_orbit) + mean.by_centrifugal * force_by_orbit),
                ],
            ];
            let residual = [
                force - balls * self.direction * ball.force[1],
                rotation.shaft_speed * self.cage.ratio(mean.value) - orbit,
            ];
            let step = solve_2x2(&jacobian, residual);
            offset += step[0];
            orbit += step[1];
            if !offset.is_finite() || !(RATIOS[0]..RATIOS[1]).contains(&(orbit / rotation.shaft_speed)) {
                break;
            }
            if step[0].abs() <= 1e-9 * offset.abs() + 1e-18 && step[1].abs() <= 1e-9 * orbit.abs() {
                return offset;
            }
        }
        // Robust fallback: bisection in the ratio of cage to shaft speed.
        let [mut low, mut high] = RATIOS;
        for _ in 0..60 {
            let ratio = 0.5 * (low + high);
            let orbit = ratio * rotation.shaft_speed;
            let rolling = centred(at_orbit(orbit), orbit).map(|(_, mean, _)| self.cage.ratio(mean.value));
            if ratio > rolling.unwrap_or(self.cage.nominal_ratio()) {
                high = ratio;
            } else {
                low = ratio;
            }
        }
        at_orbit(0.5 * (low + high) * rotation.shaft_speed)
    }

    fn depends_on_orbit(&self) -> bool {
        self.inertia.is_some_and(|balls| balls.control.depends_on_speed())
    }

    /// Whether the static cage speed follows from an equilibrium: a rolling cage of turning balls with inertia.
    pub fn cage_speed_is_solved(&self, rotation: &Rotation) -> bool {
        self.depends_on_orbit() && self.cage.is_rolling() && rotation.shaft_speed != 0.0
    }
}

impl BallElement {
    /// Cage speed of a static state: that of rolling at the loaded contact angles.
    ///
    /// Newton's method on the ratio, bracketed and with bisection where it fails; a bearing without load has
    /// the nominal contact angle, see [`MeanCos`]. `guess`: ratio of cage to shaft speed to start from.
    pub(super) fn cage_equilibrium(
        &self,
        d: &[f64; 6],
        rotation: &Rotation,
        with_defects: bool,
        guess: Option<f64>,
    ) -> CageEquilibrium {
        let speed = rotation.shaft_speed;
        let nominal = self.cage.nominal_ratio();
        if !self.rows().iter().any(|(_, row)| row.cage_speed_is_solved(rotation)) {
            return CageEquilibrium { orbit: nominal * speed, ..CageEquilibrium::default() };
        }
        let sums = |orbit: f64| {
            let mut sums = LoadSums::default();
            for (place, row) in self.rows() {
                let d = displacement_at_offset(*place, d);
                sums.add_row(&row.load_sums(&RingMotion::at_rest(&d, rotation, orbit, with_defects)), *place);
            }
            sums
        };
        let [mut low, mut high] = RATIOS;
        let mut ratio = guess.unwrap_or(nominal);
        for _ in 0..100 {
            let at = sums(ratio * speed);
            let (mean, by, by_orbit) = at.mean_cos(self.cage.nominal_cos);
            let turn = speed * self.cage.ratio_by_cos();
            let (value, slope) = (ratio - self.cage.ratio(mean), 1.0 - turn * by_orbit);
            let newton = ratio - value / slope;
            let done = (newton - ratio).abs() <= 1e-9 && slope > 0.0;
            if done || high - low <= 1e-15 {
                let orbit_by = if done { by.map(|by| turn * by / slope) } else { [0.0; 6] };
                let ratio = if done { newton } else { ratio };
                return CageEquilibrium { orbit: ratio * speed, force_by: at.force_by_orbit, orbit_by };
            }
            if value > 0.0 {
                high = ratio;
            } else {
                low = ratio;
            }
            ratio = if slope > 0.0 && newton > low && newton < high { newton } else { 0.5 * (low + high) };
        }
        CageEquilibrium { orbit: ratio * speed, ..CageEquilibrium::default() }
    }

    /// Static reaction at a displacement, with the cage speed of rolling; `v` adds contact damping.
    pub(super) fn static_reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        let cage = self.cage_equilibrium(d, rotation, true, None);
        let mut out =
            self.reaction_with(&RingMotion { v, ..RingMotion::at_rest(d, rotation, cage.orbit, true) });
        cage.complete_stiffness(&mut out);
        out
    }

    /// Elastic force and stiffness averaged over one ball pitch of cage angles at fixed ring displacement.
    ///
    /// f̄(d) = (1/N) Σ_k f(d, ψ₀ + (2π/Z) k/N), each at its own cage speed, as a slow cage passes them; the
    /// average of massless balls is a potential force, so its tangent is symmetric. Waviness, defects and
    /// off-size balls are left out (average over many revolutions, neglecting the small mean of a dent);
    /// [`BallElement::reaction`] includes them.
    pub fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        let pitch = TAU / self.balls() as f64;
        let mut out = Reaction::default();
        let mut guess = None;
        for k in 0..angles {
            let at =
                Rotation { cage_angle: rotation.cage_angle + pitch * k as f64 / angles as f64, ..*rotation };
            let cage = self.cage_equilibrium(d, &at, false, guess);
            guess = (at.shaft_speed != 0.0).then_some(cage.orbit / at.shaft_speed);
            let mut part = self.reaction_with(&RingMotion::at_rest(d, &at, cage.orbit, false));
            cage.complete_stiffness(&mut part);
            out.add(&part, 1.0 / angles as f64);
        }
        out
    }
}
