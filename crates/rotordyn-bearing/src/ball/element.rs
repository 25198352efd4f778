//! Ball bearing element: one force element per ball, clearance, loss of contact, kinematic cage.
//!
//! Force law of Cakmak & Sanliturk 2010 §2.1 and §3.1 with massless balls: the groove centres of ball j are
//! A + δ_j apart, A = r_i + r_o − D_w, and the ball carries Q(δ_j) along the line joining them.

use super::cage::{CageKinematics, MeanCos};
use super::duplex::{displacement_at_offset, transform_to_station};
pub use super::load::BallLoad;
use super::preload::RowReaction;
use super::ring_motion::RingMotion;
use super::row::Row;
use super::row_kernel::RowForce;
use crate::contact::HertzPair;
use crate::{Arrangement, BallBearing, PreloadState, Profile, Reaction, Rotation};

/// A ball bearing prepared for evaluation: one row, or the two of a matched pair.
#[derive(Clone, Debug)]
pub struct BallElement {
    /// Dry contacts at the nominal contact angle.
    pub contacts: HertzPair,
    /// Rows with their axial offsets from the bearing's station \[m\].
    rows: Vec<(f64, Row)>,
    pub(super) cage: CageKinematics,
}

impl BallElement {
    /// Prepares a bearing for evaluation.
    pub fn new(bearing: &BallBearing) -> Self {
        let g = &bearing.geometry;
        let mut out =
            Self { contacts: bearing.hertz(), rows: Vec::new(), cage: CageKinematics::new(bearing) };
        out.rows = match &bearing.duplex {
            None => vec![(0.0, Row::new(bearing, 0, g.thrust_direction))],
            Some(pair) => {
                let rows = pair.rows(g.thrust_direction).into_iter().enumerate();
                // Rows in tandem share the preload, opposed ones press on each other with the whole.
                let of_row = match pair.arrangement {
                    Arrangement::Tandem => {
                        &BallBearing { preload: bearing.preload.shared_by(2), ..bearing.clone() }
                    }
                    Arrangement::BackToBack | Arrangement::FaceToFace => bearing,
                };
                rows.map(|(k, (place, direction))| (place, Row::new(of_row, k, direction))).collect()
            }
        };
        out
    }

    /// Number of balls Z of a row.
    pub fn balls(&self) -> usize {
        self.rows.first().map_or(0, |(_, row)| row.balls())
    }

    /// Cage speed over shaft speed at a mean contact angle: ½ (1 − D_w cos α / D_pw), or the given ratio.
    ///
    /// Source: Cakmak & Sanliturk 2010 eq. 20 with the outer ring at rest.
    pub fn cage_ratio(&self, mean_cos: f64) -> f64 {
        self.cage.ratio(mean_cos)
    }

    /// Cosine of the nominal contact angle.
    pub fn nominal_cos(&self) -> f64 {
        self.cage.nominal_cos
    }

    /// Whether the force at given displacement and velocity depends on speed: film, ball inertia, ring
    /// growth.
    pub fn depends_on_speed(&self) -> bool {
        self.rows.iter().any(|(_, row)| row.depends_on_speed())
    }

    /// Preload of the centred bearing at a speed Ω \[rad/s\]: offset and resulting axial force, of a tandem pair that of both rows.
    pub fn preload_state(&self, speed: f64) -> PreloadState {
        let rotation = Rotation { shaft_speed: speed, ..Rotation::default() };
        let orbit = self.cage_equilibrium(&[0.0; 6], &rotation, false, None).orbit;
        let Some((_, first)) = self.rows.first() else { return PreloadState::default() };
        let alike = self.rows.iter().filter(|(_, row)| row.direction == first.direction).count();
        let of_row = first.preload_state(&rotation, orbit);
        PreloadState { axial_force: alike as f64 * of_row.axial_force, ..of_row }
    }

    /// Force on the shaft and both tangents at a displacement of the inner ring relative to the outer one.
    ///
    /// Ball j's inner groove centre is at s_j = (A cos α₀ − P_d/2 + x cos ψ_j + y sin ψ_j,
    /// A sin α₀ + δ₀ + z + R_i (θ_x sin ψ_j − θ_y cos ψ_j)) from the outer one, δ₀ the preload. A massless ball
    /// carries Q_j = max(0, Q(δ) + damping), δ_j = |s_j| − A + w_i + w_o; f = −Σ Q_j ∂δ_j/∂d. For a ball with
    /// inertia the ball equilibrium is solved first. δ̇ is the full approach rate: motion of rings and cage,
    /// passing waves and defects (defects unless their law excludes them from damping).
    ///
    /// In statics (no cage speed given) the cage speed is solved with the balls, and the stiffness contains the
    /// part through it; ∂f/∂ω_c of the damping force is neglected there, which vanishes at rest.
    ///
    /// `d`, `v`: displacement \[m, rad\] and velocity of the shaft relative to the housing (θ_z is ignored).
    /// Limits: all balls unloaded gives zero force and zero tangents; no ball transmits tension.
    pub fn reaction(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation) -> Reaction {
        match rotation.cage_speed {
            None => self.static_reaction(d, v, rotation),
            Some(orbit) => self.reaction_with(&RingMotion {
                d,
                v,
                rotation,
                cage_speed: Some(orbit),
                orbit,
                with_defects: true,
            }),
        }
    }

    /// The force of [`BallElement::reaction`] with its energy, powers and mean contact angle, to `out`.
    ///
    /// The tangents of `out` are unspecified; the force agrees up to round-off.
    pub fn force(&self, d: &[f64; 6], v: &[f64; 6], rotation: &Rotation, out: &mut Reaction) {
        let station = RingMotion {
            d,
            v,
            rotation,
            cage_speed: rotation.cage_speed,
            orbit: rotation.cage_speed.unwrap_or(0.0),
            with_defects: true,
        };
        let mut sum = RowForce::default();
        for (place, row) in &self.rows {
            let ring = RingMotion {
                d: &displacement_at_offset(*place, d),
                v: &displacement_at_offset(*place, v),
                ..station
            };
            match row.force(&ring) {
                Some(part) => sum.add(&part, *place),
                None => {
                    *out = self.reaction(d, v, rotation);
                    return;
                }
            }
        }
        out.force = sum.force;
        out.elastic_energy = sum.energy;
        out.parametric_power = sum.power;
        out.dissipated_power = sum.dissipated;
        out.mean_cos = if sum.load > 0.0 { sum.load_cos / sum.load } else { self.cage.nominal_cos };
    }

    /// Whether [`BallElement::force`] is evaluated in SIMD, without tangents.
    pub fn has_cheap_force(&self) -> bool {
        self.rows.iter().all(|(_, row)| row.has_kernel())
    }

    /// Surface profiles of the rows that are not perfect.
    pub(super) fn profiles(&self) -> impl Iterator<Item = &Profile> {
        self.rows.iter().filter_map(|(_, row)| row.profile.as_deref())
    }

    pub(super) fn rows(&self) -> &[(f64, Row)] {
        &self.rows
    }

    pub(super) fn reaction_with(&self, ring: &RingMotion) -> Reaction {
        let at_station = |(place, row): &(f64, Row)| {
            let [d, v] = [ring.d, ring.v].map(|motion| displacement_at_offset(*place, motion));
            let mut out = row.row_reaction(&RingMotion { d: &d, v: &v, ..*ring });
            transform_to_station(*place, &mut out.reaction);
            out
        };
        let RowReaction { reaction: mut out, load, load_cos } = match self.rows.as_slice() {
            [row] => at_station(row),
            rows => rows.iter().fold(RowReaction::default(), |mut sum, row| {
                let RowReaction { reaction, load, load_cos } = at_station(row);
                sum.reaction.add(&reaction, 1.0);
                sum.load += load;
                sum.load_cos += load_cos;
                sum
            }),
        };
        let centrifugal = self.rows.iter().map(|(_, row)| row.centrifugal_sum(ring.orbit)).sum();
        out.mean_cos = MeanCos::new(load, load_cos, centrifugal, self.cage.nominal_cos).value;
        out
    }

    /// Loads, contact angles, approach and film of every ball of every row under elastic forces alone.
    pub fn ball_loads(&self, d: &[f64; 6], rotation: &Rotation) -> Vec<BallLoad> {
        let mut out = Vec::with_capacity(self.balls() * self.rows.len());
        let orbit =
            rotation.cage_speed.unwrap_or_else(|| self.cage_equilibrium(d, rotation, true, None).orbit);
        for (k, (place, row)) in self.rows.iter().enumerate() {
            let d = displacement_at_offset(*place, d);
            row.ball_loads(&RingMotion::at_rest(&d, rotation, orbit, true), k, &mut out);
        }
        out
    }
}
