//! Ratings and rating lives of a ball bearing under its load: ISO 281, ISO 76, ISO/TS 16281.

use crate::analysis::bearing_stiffness::{BearingEquilibrium, BearingSolver, Condition};
use crate::results::BearingLife;
use crate::warning::{Code, Warning};
use rotordyn_bearing::contact::{ContactLaw, Race};
use rotordyn_bearing::life::{
    basic_life, combined_life, life_modification, reference_life, reference_viscosity, reliability_factor,
};
use rotordyn_bearing::rating::{
    EquivalentLoad, LARGEST_RADIAL_ANGLE, LoadRating, RowLoad, equivalent_load, static_equivalent_load,
};
use rotordyn_bearing::{Arrangement, BallBearing, BallInertia, BallLoad, Imperfections, Preload, kinematics};

/// Axial force of the row of a pair with less of it, over that of the other, below which the external thrust outweighs what is
/// left of a preload, and what centrifugal force gives the balls of an unloaded row.
const LEAST_PRELOAD: f64 = 0.2;

/// Ratings of one bearing, and the solver for the load distribution of ISO/TS 16281.
pub(super) struct BearingRating<'a> {
    bearing: &'a BallBearing,
    arrangement: Option<Arrangement>,
    /// Ratings of all rows together.
    pub rating: LoadRating,
    /// The bearing of ISO/TS 16281: dry contacts, massless balls, no imperfections, moment arm D_pw/2.
    solver: BearingSolver,
    /// Tilt of the standard's bearing over that of the bearing: R_i/(D_pw/2).
    tilt: f64,
}

impl<'a> BearingRating<'a> {
    pub fn new(name: &str, bearing: &'a BallBearing) -> Self {
        let g = &bearing.geometry;
        let arrangement = bearing.duplex.map(|pair| pair.arrangement);
        let found = LoadRating::new(g, &bearing.ball_material, &bearing.ring_material, arrangement);
        let service = &bearing.service;
        let rating = LoadRating {
            dynamic: service.dynamic_rating.unwrap_or(found.dynamic),
            static_rating: service.static_rating.unwrap_or(found.static_rating),
            fatigue: service.fatigue_limit.unwrap_or(found.fatigue),
        };
        let arm = 0.5 * g.pitch_diameter;
        let mut standard = bearing.clone();
        standard.geometry.moment_arm = Some(arm);
        standard.contact = ContactLaw::Hertz;
        standard.inertia = BallInertia::None;
        standard.imperfections = Imperfections::default();
        // The axial load of a single row contains its preload; in a pair the preload is an internal load.
        if arrangement.is_none() {
            standard.preload = Preload::None;
        }
        Self {
            bearing,
            arrangement,
            rating,
            solver: BearingSolver::new(name, &standard),
            tilt: g.inner_centre_radius() / arm,
        }
    }

    /// F_r and F_a of every row \[N\]: of a pair those of the balls' loads, which hold its preload; of a single row those of
    /// the state, with the radial load that interference amounts to.
    pub fn row_forces(&self, state: &BearingEquilibrium, balls: &[BallLoad]) -> Vec<[f64; 2]> {
        if self.arrangement.is_some() {
            return RowLoad::of_rows(2, balls).iter().map(RowLoad::forces).collect();
        }
        let [x, y, z, ..] = state.load;
        let pressed = self.row_with_interference(state, balls).map_or(0.0, |row| row.equal_in_friction());
        vec![[x.hypot(y).max(pressed), z]]
    }

    /// A single row with interference between rings and balls.
    fn row_with_interference(&self, state: &BearingEquilibrium, balls: &[BallLoad]) -> Option<RowLoad> {
        let mounted = kinematics::mounted_geometry(self.bearing, state.condition.speed);
        if self.arrangement.is_some() || mounted.radial_clearance >= 0.0 {
            return None;
        }
        RowLoad::of_rows(1, balls).pop()
    }

    /// P and P_0 of ISO 281 and ISO 76 under the load of a state, at least those that preload and interference amount to.
    ///
    /// The equivalent loads of the standards hold external loads only. Rows of a pair: P_k of each under its own forces and
    /// C_k = C/2^0.7 give the load C/L^⅓ of the life L of both. P_0 is that of the most loaded ball, as the pressure.
    fn equivalent_loads(&self, state: &BearingEquilibrium, balls: &[BallLoad]) -> (EquivalentLoad, f64) {
        let g = &self.bearing.geometry;
        let [x, y, z, ..] = state.load;
        let radial = x.hypot(y);
        let mut equivalent = equivalent_load(g, self.arrangement, radial, z);
        let mut static_load = static_equivalent_load(g, self.arrangement, radial, z);
        if self.arrangement.is_some() {
            let rows = RowLoad::of_rows(2, balls);
            let full_circumference = rows.iter().all(RowLoad::is_preloaded);
            let largest = rows.iter().map(RowLoad::equal_in_largest_load).fold(0.0, f64::max);
            let rows: Vec<[f64; 2]> = rows.iter().map(RowLoad::forces).collect();
            let [least, most] = [f64::min, f64::max].map(|of| of(rows[0][1], rows[1][1]));
            if !full_circumference || least < LEAST_PRELOAD * most {
                return (equivalent, static_load);
            }
            let row_rating = self.rating.dynamic / 2f64.powf(0.7);
            let life =
                |&[radial, z]: &[f64; 2]| basic_life(row_rating, equivalent_load(g, None, radial, z).load);
            let both = combined_life(&rows.iter().map(life).collect::<Vec<_>>());
            equivalent.load = equivalent.load.max(self.rating.dynamic / both.cbrt());
            static_load = static_load.max(2.0 * largest);
        } else if let Some(row) = self.row_with_interference(state, balls) {
            equivalent.load = equivalent.load.max(row.equal_in_fatigue());
            static_load = static_load.max(row.equal_in_largest_load());
        }
        (equivalent, static_load)
    }

    /// Rating lives and static safety under a load; the load is stationary, the inner ring rotates.
    ///
    /// `balls`: ball loads of the bearing in equilibrium.
    pub fn life(&self, state: &BearingEquilibrium, balls: &[BallLoad]) -> BearingLife {
        let g = &self.bearing.geometry;
        let rating = &self.rating;
        let (equivalent, static_load) = self.equivalent_loads(state, balls);
        let reference = self.standard_loads(state).map_or(f64::NAN, |loads| self.reference(&loads));
        let reference_load = rating.dynamic / reference.cbrt();
        let speed = state.condition.speed.abs();
        let service = &self.bearing.service;
        let oil = self.bearing.lubricant().filter(|_| speed > 0.0);
        let required = oil.map_or(f64::NAN, |_| reference_viscosity(g.pitch_diameter, speed));
        let viscosity_ratio = oil.map_or(f64::NAN, |oil| oil.viscosity / oil.density / required);
        let modification =
            life_modification(viscosity_ratio, service.contamination, rating.fatigue, reference_load)
                .unwrap_or(f64::NAN);
        let EquivalentLoad { load, x, y, e } = equivalent;
        BearingLife {
            equivalent_load: load,
            factors: [x, y, e],
            basic: basic_life(rating.dynamic, load),
            static_load,
            static_safety: rating.static_rating / static_load,
            reference,
            reference_load,
            by_ball_loads: self.reference(balls),
            reference_viscosity: required,
            viscosity_ratio,
            contamination: service.contamination,
            modification,
            modified: reliability_factor(service.reliability) * modification * reference,
        }
    }

    /// Ball loads after ISO/TS 16281 under the load of a state; `None` if they are not found.
    ///
    /// Forces are those of the state. A prescribed tilt keeps the approach that it causes at the balls.
    fn standard_loads(&self, state: &BearingEquilibrium) -> Option<Vec<BallLoad>> {
        let held = |k: usize| {
            (k > 2 && state.condition.prescribed[k].is_some()).then_some(self.tilt * state.displacement[k])
        };
        let condition =
            Condition { load: state.load, prescribed: std::array::from_fn(held), ..state.condition };
        let found = self.solver.solve(&condition, Some(&state.displacement)).ok()?;
        Some(self.solver.ball_loads(&found))
    }

    /// Basic reference rating life of all rows from ball loads.
    fn reference(&self, balls: &[BallLoad]) -> f64 {
        let rows = if self.arrangement.is_some() { 2 } else { 1 };
        // C of i rows is i^0.7 times that of one (ISO 281).
        let row_rating = self.rating.dynamic / f64::from(rows).powf(0.7);
        let of_row = |row: usize| {
            let loads = |pick: fn(&BallLoad) -> f64| -> Vec<f64> {
                balls.iter().filter(|ball| ball.row == row).map(pick).collect()
            };
            let (inner, outer) = (loads(|ball| ball.load), loads(|ball| ball.outer_load));
            reference_life(&self.bearing.geometry, row_rating, &inner, &outer, Race::Inner).life
        };
        combined_life(&(0..rows as usize).map(of_row).collect::<Vec<_>>())
    }

    /// Limits of the rating methods that a state exceeds.
    pub fn warnings(&self, name: &str, life: &BearingLife) -> Vec<Warning> {
        let angle = self.bearing.geometry.contact_angle.abs();
        let mut out = Vec::new();
        let mut warn = |text: String| out.push(Warning::new(Code::Rating, format!("bearing.{name}"), text));
        if angle > LARGEST_RADIAL_ANGLE {
            warn(format!(
                "bearing {name}: contact angle {:.1} deg above the 45 deg of radial bearings in ISO 281 and ISO 76: \
                 no equivalent loads; C and C_0 are extrapolated",
                angle.to_degrees()
            ));
        }
        if life.reference.is_nan() {
            warn(format!(
                "bearing {name}: no equilibrium with the massless balls and the moment arm of ISO/TS 16281 under this \
                 load, so no reference life"
            ));
        }
        if life.viscosity_ratio < 0.1 {
            warn(format!(
                "bearing {name}: viscosity ratio kappa {:.3} below 0.1, where ISO 281 gives no a_ISO",
                life.viscosity_ratio
            ));
        }
        out
    }
}
