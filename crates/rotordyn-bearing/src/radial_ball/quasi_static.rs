//! Statics and small motions: every ball in static equilibrium between the races, its coordinate condensed.

use super::ball_state::{BallState, ContactState};
use super::tangent::BALL_COORDINATE;
use super::{LocalMotion, RadialElement, Rings};
use crate::{BallLoad, Reaction, Rotation, root_finding};

/// Displacement over pitch radius up to which statics use the exact geometry; beyond, linear extrapolation.
const EXACT_RANGE: f64 = 0.02;

impl RadialElement {
    /// Force on the shaft with condensed tangents, every ball in equilibrium of contact, centrifugal force
    /// and weight.
    ///
    /// Stiffness by static condensation, K_dd − K_dy K_yy⁻¹ K_yd; damping of slow motions, with the balls
    /// following quasi-statically, y = S d, S = −K_yy⁻¹ K_yd: C_dd + C_dy S + Sᵀ C_yd + Sᵀ C_yy S. The
    /// housing also carries the balls' weight and centrifugal force ([`Reaction::housing_force`]). A ball without
    /// contact does not contribute.
    ///
    /// `d`, `v`: displacement and velocity of the shaft relative to the housing; only x and y are used.
    /// The stiffness omits the geometric term −F/χ along the race, a relative 1e-5: it would make a ring
    /// balanced on one ball unstable, which is to be found as an equilibrium.
    ///
    /// Beyond a fiftieth of the pitch radius, reached only by iterates of an equilibrium search, the force is
    /// extrapolated linearly.
    pub fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        let (size, most) = (d[0].hypot(d[1]), EXACT_RANGE * self.outer_contact_radius);
        if size <= most {
            return self.exact_reaction(d, v, rotation);
        }
        let mut out = self.exact_reaction(&d.map(|d| d * most / size), v, rotation);
        let stiffness = 1.5 * self.stiffness[0] * most.sqrt();
        for (a, along) in d.iter().enumerate().take(2) {
            out.force[a] -= stiffness * (1.0 - most / size) * along;
            out.stiffness[a][a] += stiffness;
        }
        out.elastic_energy += 0.5 * stiffness * (size - most).powi(2);
        out
    }

    fn exact_reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        let rings = Rings { relative_displacement: [d[0], d[1]], ..Rings::default() };
        let mut out = Reaction { mean_cos: 1.0, ..Reaction::default() };
        self.for_each_equilibrium(&rings, rotation, |seen, _, acting| {
            let (c, s) = (seen.cos, seen.sin);
            let [dr, dt, hr, _] = acting.ring_forces(seen, self.mass);
            out.force[0] += dr * c - dt * s;
            out.force[1] += dr * s + dt * c;
            out.housing_force[0] += hr * c;
            out.housing_force[1] += hr * s;
            out.elastic_energy += acting.contacts[0].energy + acting.contacts[1].energy;
            // With zero force: no geometric softening −F/χ across the contact line.
            let [inner, outer] = acting.contacts;
            let unloaded = BallState { contacts: [ContactState { force: 0.0, ..inner }, outer], ..*acting };
            let tangent = unloaded.tangent(seen, self.mass);
            let (k, damping) = (&tangent.stiffness, &tangent.damping);
            let ball_tangent = |column: usize| {
                if k[BALL_COORDINATE][BALL_COORDINATE] > 0.0 {
                    -k[BALL_COORDINATE][column] / k[BALL_COORDINATE][BALL_COORDINATE]
                } else {
                    0.0
                }
            };
            let turn = [[c, -s], [s, c]];
            for a in 0..2 {
                for b in 0..2 {
                    let stiff = k[a][b] + k[a][BALL_COORDINATE] * ball_tangent(b);
                    let damp = damping[a][b]
                        + damping[a][BALL_COORDINATE] * ball_tangent(b)
                        + ball_tangent(a)
                            * (damping[BALL_COORDINATE][b]
                                + damping[BALL_COORDINATE][BALL_COORDINATE] * ball_tangent(b));
                    for row in 0..2 {
                        for column in 0..2 {
                            let both = turn[row][a] * turn[column][b];
                            out.stiffness[row][column] += both * stiff;
                            out.damping[row][column] += both * damp;
                        }
                    }
                }
            }
        });
        for row in 0..2 {
            for column in 0..2 {
                out.force[row] -= out.damping[row][column] * v[column];
                out.dissipated_power += v[row] * out.damping[row][column] * v[column];
            }
        }
        out
    }

    /// The same averaged over one ball pitch of cage angles (`angles` samples), without imperfections.
    pub fn cage_average(&self, d: &[f64; 6], rotation: &Rotation, angles: usize) -> Reaction {
        let pitch = std::f64::consts::TAU / self.balls() as f64;
        let perfect = Self { profile: None, ..self.clone() };
        let mut out = Reaction::default();
        for k in 0..angles {
            let cage_angle = rotation.cage_angle + pitch * k as f64 / angles as f64;
            out.add(
                &perfect.reaction(d, &[0.0; 6], &Rotation { cage_angle, ..*rotation }),
                1.0 / angles as f64,
            );
        }
        out
    }

    /// Loads of every ball in static equilibrium.
    pub fn ball_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BallLoad> {
        let rings = Rings { relative_displacement: [d[0], d[1]], ..Rings::default() };
        let mut out = Vec::with_capacity(self.balls());
        self.for_each_equilibrium(&rings, rotation, |seen, _, acting| {
            out.push(BallLoad {
                row: 0,
                position: seen.sin.atan2(seen.cos),
                load: acting.contacts[0].force,
                contact_angle: 0.0,
                deflection: acting.deformation[0] + acting.deformation[1],
                outer_load: acting.contacts[1].force,
                outer_contact_angle: 0.0,
                film: [0.0; 2],
            });
        });
        out
    }

    /// Static equilibrium positions y of the balls \[m\] for given ring displacements.
    pub fn equilibrium_positions(&self, rings: &Rings, rotation: &Rotation) -> Vec<f64> {
        let mut out = Vec::with_capacity(self.balls());
        self.for_each_equilibrium(rings, rotation, |_, place, _| out.push(place));
        out
    }

    /// Stiffness (3/2) K_o^{2/3} Q^{1/3} of a ball's outer contact under its centrifugal force and its weight \[N/m\].
    pub fn outer_contact_stiffness(&self, rotation: &Rotation) -> f64 {
        let cage_speed = self.cage_speed(rotation);
        let weight = self.gravity[0].hypot(self.gravity[1]);
        let load = self.mass * (cage_speed * cage_speed * self.outer_contact_radius + weight);
        1.5 * (self.stiffness[1] * self.stiffness[1] * load).cbrt()
    }

    /// Cage speed, in statics from the shaft speed and the cage ratio \[rad/s\].
    fn cage_speed(&self, rotation: &Rotation) -> f64 {
        rotation.cage_speed.unwrap_or(self.cage_ratio() * rotation.shaft_speed)
    }

    /// Calls `visit` for every ball in static equilibrium of contact forces, centrifugal force and weight.
    fn for_each_equilibrium(
        &self,
        rings: &Rings,
        rotation: &Rotation,
        mut visit: impl FnMut(&LocalMotion, f64, &BallState),
    ) {
        // No cage speed, so that contacts have no rates; the centrifugal force is added below.
        let rings_at_rest = Rings { relative_velocity: [0.0; 2], housing_velocity: [0.0; 2], ..*rings };
        let rotation_at_rest = Rotation { cage_speed: None, shaft_speed: 0.0, ..*rotation };
        let cage_speed = self.cage_speed(rotation);
        self.for_each_ball(&rings_at_rest, &rotation_at_rest, |_, seen| {
            let centrifugal_force =
                |lift: f64| self.mass * cage_speed * cage_speed * (self.outer_contact_radius + lift);
            let outward_force = centrifugal_force(0.0) + seen.weight;
            let guess = outward_force.signum() * (outward_force.abs() / self.stiffness[1]).cbrt().powi(2);
            let residual = |lift: f64| {
                let acting = self.ball_state(&seen, seen.housing_displacement[0] + lift, 0.0);
                let [inner, outer] = &acting.contacts;
                let slope = inner.by_deformation * acting.n[0] * acting.n[0] + outer.by_deformation;
                [-acting.force - centrifugal_force(lift), slope]
            };
            let place = seen.housing_displacement[0] + root_finding::increasing_root(residual, guess);
            visit(&seen, place, &self.ball_state(&seen, place, 0.0));
        });
    }
}
