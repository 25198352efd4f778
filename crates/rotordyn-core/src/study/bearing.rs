//! Single ball bearings: operating point, sweeps, contacts, film, rating life, characteristic frequencies.

mod inertia;
mod limits;
mod operating_point;

use super::ball_states::{ball_states, friction_torque};
use super::bearing_life::BearingRating;
use super::free_ball::add_free_balls;
use super::{Machine, ehl_film};
use crate::analysis::bearing_stiffness::{BearingEquilibrium, BearingSolver, Condition};
use crate::analysis::equilibrium::{CageTreatment, equilibrium};
use crate::assembly::PhysicsError;
use crate::document::TO_RPM;
use crate::model::study::{BearingStudy, DOF_NAMES, SweepDirection, SweepVariable};
use crate::results::{BallState, BearingPoint, BearingResult, BearingSweepResult};
use crate::warning::{Code, Warning};
use operating_point::{OperatingPoint, SingleBearingStudy, cage_treatment};
use rotordyn_bearing::contact::{BallContacts, ContactLaw};
use rotordyn_bearing::free_ball::FreeBallBearing;
use rotordyn_bearing::rating::LoadRating;
use rotordyn_bearing::rating::limit_checks::{GREASE_SPEED_PARAMETER, speed_limit, speed_parameter};
use rotordyn_bearing::{BallBearing, CharacteristicOrders, Preload, PreloadState, kinematics};
use std::ops::ControlFlow;

/// Points of a sweep over a default range.
const SWEEP_POINTS: usize = 41;
/// Default speed parameter n·d_m (speed times pitch diameter) \[mm/min\]: half the limit for grease.
const DEFAULT_NDM: f64 = 0.5 * GREASE_SPEED_PARAMETER;

impl Machine {
    /// Every requested ball bearing, under its load in the machine or the given load; one with free balls also settled under
    /// the force of its operating point, with aligned rings.
    ///
    /// # Errors
    /// No equilibrium of the machine, or of a bearing at its operating point. A bearing with free balls that does not settle
    /// has a warning.
    pub fn bearings(&self, study: &BearingStudy) -> Result<Vec<BearingResult>, PhysicsError> {
        let mut found = self.static_bearings(study)?;
        add_free_balls(&mut found, &self.free_balls(), study, &|_, _| ControlFlow::Continue(()));
        Ok(found)
    }

    /// Bearings with free balls by name.
    pub fn free_balls(&self) -> Vec<(String, FreeBallBearing)> {
        let sites = self.model.bearings.iter();
        sites.filter_map(|site| Some((site.name.clone(), site.bearing.free_balls()?.clone()))).collect()
    }

    /// [`bearings`](Self::bearings) without the runs of free balls.
    ///
    /// # Errors
    /// As of [`bearings`](Self::bearings).
    pub fn static_bearings(&self, study: &BearingStudy) -> Result<Vec<BearingResult>, PhysicsError> {
        let bearings = self.model.bearings.iter();
        let balls =
            bearings.filter_map(|site| Some((site.name.clone(), site.bearing.static_balls()?.clone())));
        let balls: Vec<_> = balls.collect();
        let speed = study.speed.unwrap_or(self.model.profile.top_speed());
        let mut study = BearingStudy { speed: Some(speed), ..study.clone() };
        if speed == 0.0 {
            study.speed = None;
        }
        if study.force.is_some() || study.moment.is_some() {
            return single_bearings(&balls, &study);
        }
        if let Some(machine) = self.decided(&inertia::speeds(&study, speed))? {
            return machine.static_bearings(&study);
        }
        let cage = cage_treatment(&study);
        let found =
            equilibrium(&self.model, &self.assembly, speed, cage, Some(&self.standstill_equilibrium.q))?;
        let one = |(name, ball): &(String, BallBearing)| {
            let state = found.bearings.iter().find(|b| b.name == *name);
            let load = state.map_or([0.0; 5], |b| std::array::from_fn(|k| -b.force[k]));
            let words = format!("static equilibrium of the machine at {:.0} rpm", speed * TO_RPM);
            // In the machine, axial position and tilt of the shaft are prescribed in all sweeps.
            let is_prescribed = study.constrained.unwrap_or([false, false, true, true, true]);
            let place = state.map_or([0.0; 6], |b| b.displacement);
            let held = std::array::from_fn(|k| is_prescribed[k].then_some(place[k]));
            let mounted_preload = found.preloads.iter().find(|preload| preload.bearing == *name).cloned();
            let operating = OperatingPoint { load, prescribed: held, load_source: words, mounted_preload };
            SingleBearingStudy::new(name, ball, &study).study(operating)
        };
        balls.iter().filter(|(name, _)| is_requested(&study, name)).map(one).collect()
    }
}

/// Every requested ball bearing, without a machine.
///
/// # Errors
/// No equilibrium of a bearing at its operating point.
pub fn single_bearings(
    bearings: &[(String, BallBearing)],
    study: &BearingStudy,
) -> Result<Vec<BearingResult>, PhysicsError> {
    let one = |(name, ball): &(String, BallBearing)| {
        let work = SingleBearingStudy::new(name, ball, study);
        let decided = work.decided();
        let work = SingleBearingStudy::new(name, &decided, study);
        let operating = work.operating();
        let mut found = work.study(operating)?;
        found.warnings.extend(work.too_fast());
        Ok(found)
    };
    bearings.iter().filter(|(name, _)| is_requested(study, name)).map(one).collect()
}

fn is_requested(study: &BearingStudy, name: &String) -> bool {
    study.bearings.is_empty() || study.bearings.contains(name)
}

impl<'a> SingleBearingStudy<'a> {
    fn new(name: &'a str, bearing: &'a BallBearing, study: &'a BearingStudy) -> Self {
        let mean = DEFAULT_NDM / (1e3 * bearing.geometry.pitch_diameter);
        Self {
            name,
            bearing,
            study,
            solver: BearingSolver::new(name, bearing),
            contacts: BallContacts::new(bearing.hertz(), film_law(bearing)),
            rating: BearingRating::new(name, bearing),
            speed: study.speed.unwrap_or(round_to_two_digits(mean) / TO_RPM),
        }
    }

    /// Load and prescribed displacements of a bearing without a machine.
    fn operating(&self) -> OperatingPoint {
        let g = &self.bearing.geometry;
        let one_way = self.bearing.takes_thrust_one_way();
        let preloaded = one_way && self.bearing.preload != Preload::None;
        let (force, words) = match self.study.force {
            Some(force) => (force, "as given".to_string()),
            None if self.study.moment.is_some() => ([0.0; 3], "as given".to_string()),
            None => {
                let radial = 0.1 * self.rating().dynamic;
                // Thrust that keeps half the balls of a row loaded.
                let thrust = if one_way && !preloaded { 1.25 * radial * g.contact_angle.tan() } else { 0.0 };
                let words = match (thrust > 0.0, self.bearing.duplex) {
                    (true, None) => {
                        "a tenth of the dynamic load rating along -y, with the thrust that a single row needs"
                    }
                    (true, Some(_)) => {
                        "a tenth of the dynamic load rating along -y, with the thrust that a tandem pair needs"
                    }
                    (false, _) => "a tenth of the dynamic load rating along -y",
                };
                ([0.0, -radial, g.thrust_direction * thrust], words.to_string())
            }
        };
        let tilts = self.study.moment.is_none();
        let default = [false, false, preloaded && force[2] == 0.0, tilts, tilts];
        let [m_x, m_y] = self.study.moment.unwrap_or_default();
        let [x, y, z] = force;
        let held = self.study.constrained.unwrap_or(default).map(|held| held.then_some(0.0));
        OperatingPoint {
            load: [x, y, z, m_x, m_y],
            prescribed: held,
            load_source: words,
            mounted_preload: None,
        }
    }

    /// A rigid preload of a ring that an axial load moves.
    fn preload_without_effect(&self, operating: &OperatingPoint) -> Option<Warning> {
        let rigid = !matches!(self.bearing.preload, Preload::None | Preload::Spring { .. });
        // Opposed rows hold their preload between them.
        let opposed = !self.bearing.takes_thrust_one_way();
        if !rigid || opposed || operating.prescribed[2].is_some() {
            return None;
        }
        let text = format!(
            "bearing {}: its inner ring is free axially under the load of {:.1} N along z, so that its rigid preload has no effect",
            self.name, operating.load[2]
        );
        Some(Warning::new(Code::PreloadWithoutEffect, format!("bearing.{}", self.name), text))
    }

    /// Speed parameter above that of its kind.
    fn too_fast(&self) -> Option<Warning> {
        let [found, limit] = [speed_parameter(self.bearing, self.speed), speed_limit(self.bearing)];
        let text = || {
            format!(
                "bearing {} turns at n d_m = {found:.3e} mm rpm ({:.0} rpm), above the {limit:.1e} mm rpm of its kind",
                self.name,
                self.speed * TO_RPM
            )
        };
        (found > limit).then(|| Warning::new(Code::BearingSpeed, format!("bearing.{}", self.name), text()))
    }

    /// Ratings of all rows together.
    fn rating(&self) -> LoadRating {
        self.rating.rating
    }

    fn study(&self, operating: OperatingPoint) -> Result<BearingResult, PhysicsError> {
        let condition = Condition {
            load: operating.load,
            prescribed: operating.prescribed,
            speed: self.speed,
            cage: cage_treatment(self.study),
            cage_angle: self.bearing.cage_angle,
        };
        let state = self.solver.solve(&condition, None)?;
        let point = self.point(state);
        let mut warnings = self.warnings(&point);
        warnings.extend(self.preload_without_effect(&operating));
        let limits = self.limit_checks(&point);
        let ball_inertia = self.inertia_use(&point);
        warnings.extend(ball_inertia.warning());
        let depends_on_speed = self.bearing.depends_on_speed() || self.bearing.lubricant().is_some();
        let speed = depends_on_speed.then_some(SweepVariable::Speed);
        let defaults =
            [Some(SweepVariable::Load), speed, Some(SweepVariable::CageAngle)].into_iter().flatten();
        let asked: Vec<(SweepVariable, &[f64])> = match self.study.sweeps.as_slice() {
            [] => defaults.map(|of| (of, &[][..])).collect(),
            sweeps => sweeps.iter().map(|sweep| (sweep.variable, sweep.values.as_slice())).collect(),
        };
        let mut sweeps = Vec::new();
        for (of, values) in asked {
            sweeps.extend(self.sweep(of, values, &point, &mut warnings));
        }
        let g = &self.bearing.geometry;
        let films = ehl_film::ehl_films(self.name, self.bearing, &point, &mut warnings);
        Ok(BearingResult {
            name: self.name.to_string(),
            bearing: self.bearing.clone(),
            load_source: operating.load_source,
            prescribed: operating.prescribed.map(|held| held.is_some()),
            preload: self.preload(self.speed),
            mounted_preload: operating.mounted_preload,
            ball_inertia,
            rating: self.rating(),
            nominal_orders: g.characteristic_orders(g.contact_angle),
            point,
            limits,
            sweeps,
            films,
            free_balls: None,
            skidding: None,
            warnings,
        })
    }

    /// One sweep about an operating point; `None` if there is nothing to vary.
    fn sweep(
        &self,
        of: SweepVariable,
        values: &[f64],
        point: &BearingPoint,
        warnings: &mut Vec<Warning>,
    ) -> Option<BearingSweepResult> {
        let base = point.state.condition;
        let load = base.load;
        let size = free_force(point);
        let values = match values {
            [] => self.range(of, point),
            given => given.to_vec(),
        };
        let largest = (0..3).max_by(|&a, &b| load[a].abs().total_cmp(&load[b].abs()).then(b.cmp(&a)))?;
        let (label, unit) = match (of, self.study.sweep_direction) {
            (SweepVariable::Load, SweepDirection::Load) => ("load along the operating load".into(), "N"),
            (SweepVariable::Load, SweepDirection::Axis(k @ (3 | 4))) => {
                (format!("moment about {}", &DOF_NAMES[k][6..]), "N m")
            }
            (SweepVariable::Load, SweepDirection::Axis(k)) => (format!("load along {}", DOF_NAMES[k]), "N"),
            (SweepVariable::Displacement, SweepDirection::Axis(k @ (3 | 4))) => {
                (format!("tilt about {}", &DOF_NAMES[k][6..]), "rad")
            }
            (SweepVariable::Displacement, SweepDirection::Axis(k)) => {
                (format!("displacement along {}", DOF_NAMES[k]), "m")
            }
            (SweepVariable::Displacement, SweepDirection::Load) => {
                (format!("displacement along {}", DOF_NAMES[largest]), "m")
            }
            (SweepVariable::Speed, _) => ("shaft speed".into(), "rad/s"),
            (SweepVariable::CageAngle, _) => ("cage angle".into(), "rad"),
        };
        let at = |value: f64| {
            let mut condition = base;
            match (of, self.study.sweep_direction) {
                (SweepVariable::Load, SweepDirection::Load) if size > 0.0 => {
                    condition.load = load.map(|f| f * value / size)
                }
                (SweepVariable::Load, SweepDirection::Load) => condition.load[1] = -value,
                (SweepVariable::Load, SweepDirection::Axis(k)) => {
                    condition.load[k] = value;
                    condition.prescribed[k] = None;
                }
                (SweepVariable::Displacement, SweepDirection::Load) => {
                    condition.prescribed[largest] = Some(value)
                }
                (SweepVariable::Displacement, SweepDirection::Axis(k)) => {
                    condition.prescribed[k] = Some(value)
                }
                (SweepVariable::Speed, _) => condition.speed = value,
                (SweepVariable::CageAngle, _) => {
                    condition.cage_angle = value;
                    condition.cage = CageTreatment::FixedAngle;
                }
            }
            condition
        };
        let conditions: Vec<Condition> = values.iter().map(|value| at(*value)).collect();
        let (found, failure) = self.solver.sweep(&conditions);
        if let Some(error) = failure {
            let text = format!(
                "the sweep of {label} of bearing {} ends at {} of {} points: {error}",
                self.name,
                found.len(),
                values.len()
            );
            warnings.push(Warning::new(Code::SweepIncomplete, format!("bearing.{}", self.name), text));
        }
        let values = values[..found.len()].to_vec();
        let points = found.into_iter().map(|state| self.point(state)).collect();
        Some(BearingSweepResult { of, label, unit: unit.into(), values, points })
    }

    /// Default range of values about the operating point.
    fn range(&self, of: SweepVariable, point: &BearingPoint) -> Vec<f64> {
        let state = &point.state;
        let load = &state.load;
        let up_to = |top: f64| -> Vec<f64> {
            (1..SWEEP_POINTS).map(|k| top * k as f64 / (SWEEP_POINTS - 1) as f64).collect()
        };
        let about = |value: f64, least: f64| up_to(2.0 * if value.abs() > 0.0 { value } else { least });
        // Increasing for either sign of the operating point.
        let rising = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            values
        };
        match (of, self.study.sweep_direction) {
            (SweepVariable::Load, SweepDirection::Load) => {
                up_to((2.0 * free_force(point)).max(0.1 * self.rating().dynamic))
            }
            (SweepVariable::Load, SweepDirection::Axis(k @ (3 | 4))) => {
                rising(about(load[k], 0.005 * self.rating().dynamic * self.solver.radius))
            }
            (SweepVariable::Load, SweepDirection::Axis(k)) => {
                rising(about(load[k], 0.05 * self.rating().dynamic))
            }
            (SweepVariable::Displacement, SweepDirection::Axis(k @ (3 | 4))) => {
                rising(about(state.displacement[k], 1e-3))
            }
            (SweepVariable::Displacement, along) => {
                let largest = (0..3).max_by(|&a, &b| load[a].abs().total_cmp(&load[b].abs()).then(b.cmp(&a)));
                let k = if let SweepDirection::Axis(k) = along { k } else { largest.unwrap_or(0) };
                rising(about(state.displacement[k], 10e-6))
            }
            (SweepVariable::Speed, _) => {
                let top = if self.study.speed.is_some() { self.speed } else { 2.0 * self.speed };
                let top = if top > 0.0 {
                    top
                } else {
                    round_to_two_digits(2.0 * DEFAULT_NDM / (2e3 * self.solver.radius)) / TO_RPM
                };
                (0..SWEEP_POINTS).map(|k| top * k as f64 / (SWEEP_POINTS - 1) as f64).collect()
            }
            (SweepVariable::CageAngle, _) => {
                let pitch = std::f64::consts::TAU / self.bearing.geometry.balls as f64;
                let start = self.bearing.cage_angle;
                (0..SWEEP_POINTS).map(|k| start + pitch * k as f64 / (SWEEP_POINTS - 1) as f64).collect()
            }
        }
    }

    fn preload(&self, speed: f64) -> PreloadState {
        self.solver.element.preload_state(speed)
    }

    /// Orders under load; that of a ball with inertia is its own speed, load-weighted: where the contact angles of the races
    /// differ it turns about an axis that follows from neither of them.
    fn loaded_orders(&self, state: &BearingEquilibrium, balls: &[BallState]) -> CharacteristicOrders {
        let orders = self.bearing.loaded_orders(state.mean_cos);
        let speed = state.condition.speed;
        let load: f64 = balls.iter().map(|ball| ball.outer.load).sum();
        if !self.bearing.inertia.is_on() || speed == 0.0 || load <= 0.0 {
            return orders;
        }
        let turned: f64 = balls.iter().map(|ball| ball.outer.load * ball.motion.ball_speed.abs()).sum();
        CharacteristicOrders { bsf: turned / (load * speed.abs()), ..orders }
    }

    /// Contacts, stiffness, orders and life at an equilibrium.
    fn point(&self, state: BearingEquilibrium) -> BearingPoint {
        let speed = state.condition.speed;
        let loads = self.solver.ball_loads(&state);
        let balls = ball_states(self.bearing, &self.contacts, &loads, speed);
        let [x, y, ..] = state.load;
        let radial = x.hypot(y);
        let rows = self.rating.row_forces(&state, &loads);
        let row_rating = self.rating().static_rating / rows.len() as f64;
        let friction = friction_torque(self.bearing, row_rating, &rows, speed, &balls);
        let along =
            if radial > 0.0 { [x / radial, y / radial, 0.0, 0.0, 0.0] } else { [1.0, 0.0, 0.0, 0.0, 0.0] };
        let axis = [0.0, 0.0, 1.0, 0.0, 0.0];
        let both = |n| [state.condensed_stiffness(n, self.solver.radius), state.constrained_stiffness(n)];
        let mut point = BearingPoint {
            radial_stiffness: both(&along),
            axial_stiffness: both(&axis),
            orders: self.loaded_orders(&state, &balls),
            preload_force: self.preload(state.condition.speed).axial_force,
            life: self.rating.life(&state, &loads),
            film_ratio: 0.0,
            friction,
            mounted: kinematics::mounted_geometry(self.bearing, speed),
            balls,
            state,
        };
        point.film_ratio = match point.loaded() {
            0 => f64::INFINITY,
            _ => point.minimum_film() / self.study.roughness,
        };
        point
    }
}

/// Magnitude of the force \[N\] along the free motions.
fn free_force(point: &BearingPoint) -> f64 {
    let Condition { load, prescribed: held, .. } = &point.state.condition;
    (0..3).filter(|k| held[*k].is_none()).map(|k| load[k].powi(2)).sum::<f64>().sqrt()
}

/// Contact law for the film thickness: the bearing's own, or with the film of its lubricant.
fn film_law(bearing: &BallBearing) -> ContactLaw {
    match bearing.lubricant() {
        Some(oil) if bearing.contact.is_dry() => {
            ContactLaw::Film { lubricant: oil.clone(), speed_factor: 1.0 }
        }
        _ => bearing.contact.clone(),
    }
}

/// Rounded to two significant digits.
fn round_to_two_digits(value: f64) -> f64 {
    let step = 10f64.powf(value.abs().max(f64::MIN_POSITIVE).log10().floor() - 1.0);
    (value / step).round() * step
}
