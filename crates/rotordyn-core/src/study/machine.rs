//! A machine assembled from its model, and its linear and transient studies.

use std::convert::Infallible;
use std::ops::ControlFlow;
use std::sync::Arc;

use super::speed_cache::SpeedCache;
use crate::analysis::ball_inertia::{InertiaUse, ball_inertia, is_undecided, with_decisions};
use crate::analysis::belt_pull::BeltPull;
use crate::analysis::equilibrium::{CageTreatment, Equilibrium, equilibrium, equilibrium_tangents};
use crate::analysis::equilibrium_path::EquilibriumPath;
use crate::analysis::preload::{MountedPreload, with_mounted_preload};
use crate::analysis::table_range::{check_tables, speed_range};
use crate::analysis::{campbell, critical_speed, modal, stability};
use crate::assembly::{Assembly, LinearSystem, PhysicsError, rigid_body_modes};
use crate::model::study::{CampbellStudy, CriticalStudy, EquilibriumStudy, ModalStudy, RunUpStudy};
use crate::model::{Drive, Model};
use crate::results::{CampbellResult, CriticalResult, ModalResult};
use crate::transient::reduction::{Reduction, reduce};
use crate::transient::run::{Report, RunSnapshot, Sample, Settings, resume, run};
use crate::warning::Warning;
use rotordyn_bearing::{BearingElement, SiteTangent};
use rotordyn_linalg::{SparseMatrix, StopRequest, krylov};

/// Speeds that a search for crossings evaluates, for each of its grid.
const EVALUATIONS_PER_SPEED: usize = 4;

/// An assembled model with the static equilibrium about which linear studies are linearised.
pub struct Machine {
    pub model: Model,
    pub assembly: Assembly,
    /// Equilibrium with cage-averaged bearings at standstill.
    pub(super) standstill_equilibrium: Equilibrium,
    bearings: Vec<Arc<dyn BearingElement>>,
    /// The machine with its ball inertia decided, by the highest speed.
    decided: SpeedCache<Arc<Self>>,
    /// Tangents about the equilibrium at a speed.
    tangents: SpeedCache<Vec<SiteTangent>>,
    /// Ball inertia by the highest speed.
    inertia: SpeedCache<Vec<InertiaUse>>,
    /// Motions that nothing constrains at a speed.
    rigid_body_motions: SpeedCache<Vec<String>>,
    /// Ends studies from another thread, before the next speed or frequency.
    pub stop: StopRequest,
}

impl Machine {
    /// Assembles a model and finds its equilibrium.
    ///
    /// # Errors
    /// A mass matrix that is not definite, or no equilibrium.
    pub fn new(model: Model) -> Result<Self, PhysicsError> {
        let mut assembly = Assembly::new(&model)?;
        let named = |error| name_rigid_body_mode(error, &model, &assembly);
        let model = with_mounted_preload(&model, &assembly).map_err(named)?.unwrap_or(model);
        let base = equilibrium(&model, &assembly, 0.0, CageTreatment::Averaged, None)
            .map_err(|error| name_rigid_body_mode(error, &model, &assembly))?;
        assembly.set_standstill(&base.tangents())?;
        let bearings = model.bearings.iter().map(|site| site.bearing.element()).collect();
        Ok(Self {
            model,
            assembly,
            standstill_equilibrium: base,
            bearings,
            decided: SpeedCache::new(),
            tangents: SpeedCache::new(),
            inertia: SpeedCache::new(),
            rigid_body_motions: SpeedCache::new(),
            stop: StopRequest::default(),
        })
    }

    /// Ball inertia of every ball bearing in a study of these speeds \[rad/s\], decided at the highest.
    pub fn ball_inertia(&self, speeds: &[f64]) -> Vec<InertiaUse> {
        let (top, start) = (highest(speeds), Some(&self.standstill_equilibrium.q[..]));
        let decide = || Ok::<_, Infallible>(ball_inertia(&self.model, &self.assembly, top, start));
        self.inertia.at(top, decide).unwrap_or_else(|never| match never {})
    }

    /// The machine with its automatic ball inertia decided at the highest of a study's speeds \[rad/s\]; `None` if it
    /// is decided.
    pub(super) fn decided(&self, speeds: &[f64]) -> Result<Option<Arc<Self>>, PhysicsError> {
        if !is_undecided(&self.model) {
            return Ok(None);
        }
        let decide = || {
            let mut machine = Self::new(with_decisions(&self.model, &self.ball_inertia(speeds)))?;
            machine.stop = self.stop.clone();
            Ok(Arc::new(machine))
        };
        self.decided.at(highest(speeds), decide).map(Some)
    }

    /// Highest speed of a run \[rad/s\]: of the speed profile, or of the torque table's last row.
    pub fn top_speed_of_run(&self) -> f64 {
        let top = self.model.profile.top_speed();
        match &self.model.drive {
            Drive::Torque { table, .. } => table.iter().fold(top, |top, row| top.max(row[0].abs())),
            _ => top,
        }
    }

    /// Static equilibrium with the settings of the study.
    ///
    /// # Errors
    /// No equilibrium.
    pub fn equilibrium(&self, study: &EquilibriumStudy) -> Result<Equilibrium, PhysicsError> {
        if let Some(machine) = self.decided(&[study.speed])? {
            return machine.equilibrium(study);
        }
        self.check_tables("static", &[study.speed])?;
        let cage = if study.cage_average { CageTreatment::Averaged } else { CageTreatment::FixedAngle };
        let start = Some(&self.standstill_equilibrium.q[..]);
        let found = equilibrium(&self.model, &self.assembly, study.speed, cage, start)?;
        Ok(found.with_shaft_loads(&self.model, &self.assembly))
    }

    /// Pulls of the belts in the equilibrium at standstill, about which linear studies are linearised.
    pub fn belt_pulls(&self) -> &[BeltPull] {
        &self.standstill_equilibrium.belts
    }

    /// Axial forces of the preloaded bearings in the equilibrium at standstill.
    pub fn mounted_preloads(&self) -> &[MountedPreload] {
        &self.standstill_equilibrium.preloads
    }

    /// Tangent stiffness and damping of the bearings at a speed: with `follow` (speed-dependent bearings)
    /// about the equilibrium at that speed, including film and ball inertia; else ball bearings as at
    /// standstill and linear bearings by their tables.
    ///
    /// Without speed dependence the equilibrium at standstill is used for all speeds.
    ///
    /// # Errors
    /// No equilibrium at that speed, or a request to stop.
    pub fn tangents(&self, speed: f64, speed_dependent: bool) -> Result<Vec<SiteTangent>, PhysicsError> {
        if self.stop.is_requested() {
            return Err(PhysicsError::Stopped);
        }
        if speed_dependent && let Some(machine) = self.decided(&[speed])? {
            return machine.tangents(speed, speed_dependent);
        }
        if speed_dependent && speed != 0.0 && self.bearings_depend_on_speed() {
            return self
                .tangents
                .at(speed, || self.equilibrium_tangents(speed, &self.standstill_equilibrium.q));
        }
        let at_standstill = self.bearings.iter().zip(self.standstill_equilibrium.tangents());
        Ok(at_standstill.map(|(element, tangent)| element.tangent_at(speed, tangent)).collect())
    }

    /// As [`Self::tangents`] of speed-dependent bearings, for studies of many speeds: `path` from
    /// [`Self::equilibrium_path`]. They are not cached: the next study may start from elsewhere, and differ by some 1e-9.
    ///
    /// # Errors
    /// As [`Self::tangents`].
    pub(super) fn tangents_on(
        &self,
        path: Option<&EquilibriumPath>,
        speed: f64,
    ) -> Result<Vec<SiteTangent>, PhysicsError> {
        match path {
            Some(_) if self.stop.is_requested() => Err(PhysicsError::Stopped),
            Some(path) if speed != 0.0 => match path.tangents(speed) {
                Some(tangents) => Ok(tangents),
                None => self.equilibrium_tangents(speed, &path.at(speed)),
            },
            _ => self.tangents(speed, true),
        }
    }

    /// The equilibria over the speeds of a study \[rad/s\], of which it evaluates some `count`; `None` where they are few or all
    /// the same.
    pub(super) fn equilibrium_path(&self, speeds: &[f64], count: usize) -> Option<EquilibriumPath> {
        let range = speed_range(speeds).filter(|[low, high]| low < high)?;
        if count < EquilibriumPath::LEAST_SPEEDS || !self.bearings_depend_on_speed() {
            return None;
        }
        let (averaged, start) = (CageTreatment::Averaged, &self.standstill_equilibrium.q);
        // Without an equilibrium somewhere the speeds of the study are solved one by one, and the error names one of them.
        EquilibriumPath::new(&self.model, &self.assembly, range, averaged, start, count, &self.stop).ok()
    }

    fn equilibrium_tangents(&self, speed: f64, start: &[f64]) -> Result<Vec<SiteTangent>, PhysicsError> {
        equilibrium_tangents(&self.model, &self.assembly, speed, CageTreatment::Averaged, Some(start))
    }

    /// Whether the tangents of nonlinear bearings depend on speed: directly, or because a speed-dependent linear
    /// bearing redistributes the load.
    fn bearings_depend_on_speed(&self) -> bool {
        self.bearings.iter().any(|element| !element.is_linear())
            && self.model.bearings.iter().any(|site| site.bearing.depends_on_speed())
    }

    /// The equations of motion linearised about the equilibrium at a speed.
    ///
    /// # Errors
    /// As [`LinearSystem::new`].
    pub fn linear_system(&self, speed: f64) -> Result<LinearSystem, PhysicsError> {
        LinearSystem::new(&self.assembly, &self.tangents(speed, true)?, speed)
    }

    /// The equations of motion at a speed for motions of one frequency \[rad/s\]; `None` if no bearing depends on it.
    ///
    /// # Errors
    /// As [`LinearSystem::new`].
    pub fn linear_system_at_whirl(
        &self,
        speed: f64,
        whirl: f64,
    ) -> Result<Option<LinearSystem>, PhysicsError> {
        if !self.has_whirl_tables() {
            return Ok(None);
        }
        self.linear_system_with_whirl(&self.tangents(speed, true)?, speed, whirl).map(Some)
    }

    /// Whether a bearing has coefficients over whirl frequency.
    pub(super) fn has_whirl_tables(&self) -> bool {
        self.bearings.iter().any(|element| element.tangent_at_whirl(0.0, 0.0).is_some())
    }

    /// The equations of motion at a speed for motions of one frequency \[rad/s\]: only bearings with coefficients over it are
    /// evaluated, the others have the tangents at that speed.
    ///
    /// # Errors
    /// As [`LinearSystem::new`].
    pub(super) fn linear_system_with_whirl(
        &self,
        tangents: &[SiteTangent],
        speed: f64,
        whirl: f64,
    ) -> Result<LinearSystem, PhysicsError> {
        let own = |(element, tangent): (&Arc<dyn BearingElement>, &SiteTangent)| {
            element.tangent_at_whirl(speed, whirl).unwrap_or(*tangent)
        };
        let tangents: Vec<_> = self.bearings.iter().zip(tangents).map(own).collect();
        LinearSystem::new(&self.assembly, &tangents, speed)
    }

    /// Motions that nothing constrains at a speed, in words: rigid-body modes at 0 Hz.
    ///
    /// # Errors
    /// As [`LinearSystem::new`].
    pub(super) fn rigid_body_motions(&self, speed: f64) -> Result<Vec<String>, PhysicsError> {
        self.rigid_body_motions.at(speed, || self.unconstrained_motions(&self.linear_system(speed)?))
    }

    /// Motions that nothing constrains in a linear system, in words: rigid-body modes at 0 Hz.
    pub(super) fn unconstrained_motions(&self, system: &LinearSystem) -> Result<Vec<String>, PhysicsError> {
        let mut motions = rigid_body_modes::rigid_body_modes_of(&self.assembly, system)?;
        rigid_body_modes::leave_out_spin(&self.model, &mut motions);
        Ok(motions)
    }

    /// Warnings of bearings whose tables cover less than these speeds \[rad/s\] of a study.
    ///
    /// # Errors
    /// A bearing that refuses speeds beyond its table.
    pub fn check_tables(&self, study: &str, speeds: &[f64]) -> Result<Vec<Warning>, PhysicsError> {
        speed_range(speeds).map_or(Ok(Vec::new()), |range| check_tables(&self.model, study, range))
    }

    /// Speeds of the bearings' tables \[rad/s\], in order: between them the coefficients run without a turn.
    pub(super) fn table_speeds(&self) -> Vec<f64> {
        let mut speeds: Vec<f64> =
            self.model.bearings.iter().flat_map(|site| site.bearing.table_speeds()).collect();
        speeds.sort_by(f64::total_cmp);
        speeds.dedup();
        speeds
    }

    /// Damped modes at every requested speed.
    ///
    /// # Errors
    /// An eigenvalue computation that fails.
    pub fn modal(&self, study: &ModalStudy) -> Result<Vec<ModalResult>, PhysicsError> {
        if let Some(machine) = self.decided(&study.speeds)? {
            return machine.modal(study);
        }
        self.check_tables("modal", &study.speeds)?;
        let at = |&speed: &f64| {
            let system = self.linear_system(speed)?;
            let modes = modal::modes(&self.assembly, &system, study.modes)?;
            Ok(ModalResult { speed, modes, rigid_body_modes: self.rigid_body_motions(speed)? })
        };
        study.speeds.iter().map(at).collect()
    }

    /// Campbell diagram, the crossings of its order lines, and stability thresholds.
    ///
    /// # Errors
    /// As [`campbell::campbell`].
    pub fn campbell(&self, study: &CampbellStudy) -> Result<CampbellResult, PhysicsError> {
        if let Some(machine) = self.decided(&study.speeds)? {
            return machine.campbell(study);
        }
        self.check_tables("campbell", &study.speeds)?;
        let follows = study.speed_dependent_bearings;
        let path = || self.equilibrium_path(&study.speeds, EVALUATIONS_PER_SPEED * study.speeds.len());
        let path = follows.then(path).flatten();
        let tangents = |speed| match &path {
            Some(path) => self.tangents_on(Some(path), speed),
            None => self.tangents(speed, follows),
        };
        let diagram = campbell::campbell(&self.assembly, &study.speeds, study.modes, &tangents)?;
        let nodes = if follows { self.table_speeds() } else { Vec::new() };
        let crossings =
            critical_speed::crossings(&self.assembly, &diagram, &study.orders, &tangents, &nodes)?;
        let thresholds = stability::thresholds(&self.assembly, &diagram, &crossings.list, &tangents, &nodes)?;
        Ok(CampbellResult { diagram, orders: self.order_lines(&study.orders), crossings, thresholds })
    }

    /// All critical speeds up to a speed.
    ///
    /// # Errors
    /// As [`critical_speed::critical_speeds`].
    pub fn critical(&self, study: &CriticalStudy) -> Result<CriticalResult, PhysicsError> {
        if let Some(machine) = self.decided(&[study.max_speed])? {
            return machine.critical(study);
        }
        self.check_tables("critical", &[0.0, study.max_speed])?;
        let (assembly, max_speed) = (&self.assembly, study.max_speed);
        let path = self.equilibrium_path(&[0.0, max_speed], EVALUATIONS_PER_SPEED * critical_speed::SPEEDS);
        let (tangents, nodes) = (|speed| self.tangents_on(path.as_ref(), speed), self.table_speeds());
        let crossings =
            critical_speed::critical_speeds(assembly, [0.0, max_speed], &study.orders, &tangents, &nodes)?;
        Ok(CriticalResult { max_speed, crossings })
    }

    /// The reduced model of a run-up, about the equilibrium at the cage angles of the model.
    ///
    /// # Errors
    /// No equilibrium, or no modes.
    pub fn reduce(&self, study: &RunUpStudy) -> Result<Reduction, PhysicsError> {
        if let Some(machine) = self.decided(&[self.top_speed_of_run()])? {
            return machine.reduce(study);
        }
        if matches!(self.model.drive, Drive::Prescribed { .. }) {
            self.check_tables("run-up", &self.model.profile.speed_range())?;
        }
        let start = equilibrium(
            &self.model,
            &self.assembly,
            self.model.profile.curve().at(0.0).speed,
            CageTreatment::FixedAngle,
            Some(&self.standstill_equilibrium.q),
        )?;
        reduce(&self.model, &self.assembly, &start, study.cutoff)
    }

    /// Largest relative eigenvalue difference of reduced and full model up to half the cutoff, at a speed.
    ///
    /// # Errors
    /// An eigenvalue computation that fails.
    pub fn reduction_error(
        &self,
        reduction: &Reduction,
        cutoff: f64,
        speed: f64,
    ) -> Result<f64, PhysicsError> {
        if let Some(machine) = self.decided(&[speed])? {
            return machine.reduction_error(reduction, cutoff, speed);
        }
        const MODES: usize = 24;
        let full = modal::modes(&self.assembly, &self.linear_system(speed)?, MODES)?;
        let basis = &reduction.basis;
        let system = self.linear_system(speed)?;
        let project =
            |m: &SparseMatrix| SparseMatrix::from_dense(&(basis.transpose() * m.to_dense() * basis));
        let (m, c, k) = (project(&system.mass), project(&system.full_damping()), project(&system.stiffness));
        let count = MODES.min(basis.ncols());
        let reduced = krylov::lowest_eigenpairs(&m, &c, &k, count, modal::SHIFT)
            .map_err(|e| PhysicsError::Eigen { speed_rpm: 0.0, reason: e.to_string() })?;
        let limit = std::f64::consts::PI * cutoff;
        Ok(full
            .iter()
            .filter(|mode| mode.omega() < limit)
            .map(|mode| {
                let nearest =
                    reduced.iter().map(|r| (r.value - mode.eigenvalue).norm()).fold(f64::INFINITY, f64::min);
                nearest / mode.natural_omega()
            })
            .fold(0.0, f64::max))
    }

    /// Runs the reduced model through the speed profile; `observe` is called with every sample.
    pub fn run_up(
        &self,
        study: &RunUpStudy,
        reduction: &Reduction,
        observe: impl FnMut(&Sample) -> ControlFlow<()>,
    ) -> Report {
        let settings = self.run_settings(study);
        let start = if study.from_equilibrium { 1.0 } else { 0.0 };
        let x = &reduction.equilibrium * start;
        let v = &reduction.equilibrium * 0.0;
        let state = match reduction.system.initial_state(x, v) {
            Ok(state) => state,
            Err(error) => return Report::not_started(error),
        };
        #[cfg(feature = "shapes")]
        if let Err(error) = reduction.system.check_placement(&state, super::free_ball::overlap_at_start) {
            return Report::not_started(error);
        }
        run(&reduction.system, state, &settings, observe)
    }

    /// Goes on with a run-up after the sample of a snapshot, in the same bits as the run that was never stopped.
    pub fn resume_run_up(
        &self,
        study: &RunUpStudy,
        reduction: &Reduction,
        snapshot: RunSnapshot,
        observe: impl FnMut(&Sample) -> ControlFlow<()>,
    ) -> Report {
        resume(&reduction.system, snapshot, &self.run_settings(study), observe)
    }

    fn run_settings(&self, study: &RunUpStudy) -> Settings {
        Settings {
            integrator: study.integrator,
            step: study.step,
            defect_step: study.defect_step,
            sample_rate: study.sample_rate,
            duration: self.model.profile.duration(),
            energy_balance: true,
        }
    }
}

/// The highest of some speeds.
fn highest(speeds: &[f64]) -> f64 {
    speeds.iter().fold(0.0, |top: f64, speed| top.max(speed.abs()))
}

/// Length over thickness of a shaft that no machine has: a unit is wrong rather than a support missing.
const SLENDER: f64 = 1000.0;

/// Replaces a failed equilibrium by the rigid-body mode that causes it, if there is one.
fn name_rigid_body_mode(error: PhysicsError, model: &Model, assembly: &Assembly) -> PhysicsError {
    let free = rigid_body_modes::rigid_body_modes_of_machine(model, assembly).unwrap_or_default();
    let slenderness = assembly.extent.slenderness();
    match free.into_iter().next() {
        Some(motion) if slenderness > SLENDER => {
            PhysicsError::TooSlender { motion, slenderness, shaft: assembly.extent.to_string() }
        }
        Some(motion) => {
            let held = rigid_body_modes::held_motions_of_machine(model, assembly).unwrap_or_default();
            let own = held.into_iter().find(|(name, _)| *name == motion);
            match own.zip(heaviest_item(model)) {
                Some(((motion, frequency), (item, mass))) => {
                    PhysicsError::AlmostFree { motion, frequency, item, mass }
                }
                None => PhysicsError::Singular { motion },
            }
        }
        None => error,
    }
}

/// The disc, rotor or body with the largest mass \[kg\].
fn heaviest_item(model: &Model) -> Option<(String, f64)> {
    let discs = model.discs.iter().map(|disc| (format!("disc.{}", disc.name), disc.mass));
    let rotor = model.rigid_rotor.iter().map(|rotor| ("rotor".to_string(), rotor.mass));
    let bodies = model
        .bodies
        .iter()
        .map(|body| (format!("body `{}`", body.name), body.mass.iter().copied().fold(0.0, f64::max)));
    discs.chain(rotor).chain(bodies).max_by(|a, b| a.1.total_cmp(&b.1))
}
