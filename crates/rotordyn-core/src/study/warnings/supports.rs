//! Supports: bearings at their operating point, belts, preloads.

use crate::analysis::ball_inertia::InertiaUse;
use crate::analysis::belt_pull::BeltPull;
use crate::analysis::equilibrium::Equilibrium;
use crate::analysis::preload::MountedPreload;
use crate::assembly::PhysicsError;
use crate::assembly::rigid_body_modes::{AXIAL, rigid_body_modes_of_machine};
use crate::document::{TO_RPM, number};
use crate::study::{Machine, Results};
use crate::warning::{Code, Warning};
use rotordyn_bearing::Preload;
use rotordyn_bearing::limits::minimum_load;
use std::collections::BTreeSet;

/// Share of the stated pull below which a belt has a warning.
const LOW_PULL: f64 = 0.8;
/// Share of the stated preload below which a bearing has a warning.
const LOW_PRELOAD: f64 = 0.8;

impl Machine {
    /// Warnings of bearings, belts and preloads in static equilibrium at standstill and at the highest of the speeds
    /// \[rad/s\].
    pub fn support_warnings(&self, speeds: &[f64]) -> Vec<Warning> {
        let checked = self.free_motion_warnings(speeds).and_then(|mut found| {
            found.extend(self.bearing_warnings(speeds)?);
            Ok(found)
        });
        let mut found = checked.unwrap_or_else(|error| {
            let text = format!("the supports are not checked: {error}");
            vec![Warning::new(Code::NotChecked, "", text)]
        });
        found.extend(self.divergence_warning(speeds));
        found.extend(self.belt_pulls().iter().filter_map(belt));
        found.extend(self.mounted_preloads().iter().filter_map(preload));
        found
    }
}

impl Machine {
    /// Motions that nothing constrains at standstill or at the highest of the speeds \[rad/s\].
    fn free_motion_warnings(&self, speeds: &[f64]) -> Result<Vec<Warning>, PhysicsError> {
        if let Some(machine) = self.decided(speeds)? {
            return machine.free_motion_warnings(speeds);
        }
        let mut found: Vec<(String, Vec<f64>)> = Vec::new();
        let compared = standstill_and_top(speeds);
        for &speed in &compared {
            for motion in self.rigid_body_motions(speed)? {
                match found.iter_mut().find(|(name, _)| *name == motion) {
                    Some((_, at)) => at.push(speed),
                    None => found.push((motion, vec![speed])),
                }
            }
        }
        if found.is_empty() {
            return Ok(Vec::new());
        }
        let held_with_closed_contacts = rigid_body_modes_of_machine(&self.model, &self.assembly)?;
        let warning = |(motion, at): &(String, Vec<f64>)| {
            let speeds = match at.as_slice() {
                // Nothing that holds it depends on the speed.
                all if all.len() == compared.len() => String::new(),
                [0.0] => ", at standstill".into(),
                some => format!(", at {:.0} rpm", some[0] * TO_RPM),
            };
            let code = if motion == AXIAL { Code::FreeAxialMotion } else { Code::FreeMotion };
            let warning = Warning::new(code, "", format!("unconstrained rigid-body mode: {motion}{speeds}"));
            warning.advise(match held_with_closed_contacts.contains(motion) {
                false => {
                    "the bearings that would hold it carry nothing: preload them, reduce their clearance, or state \
                     their load"
                }
                true => "add a bearing, joint or bushing that holds it",
            })
        };
        Ok(found.iter().map(warning).collect())
    }

    /// Bearings and rows of which no contact carries load, at a speed \[rad/s\].
    pub(in crate::study) fn unloaded_bearings(&self, state: &Equilibrium) -> Vec<Warning> {
        let at = match state.speed {
            0.0 => "at standstill".into(),
            speed => format!("at {:.0} rpm", speed * TO_RPM),
        };
        let mut found = Vec::new();
        for (site, bearing) in self.model.bearings.iter().zip(&state.bearings) {
            let rows: BTreeSet<usize> = bearing.balls.iter().map(|contact| contact.row).collect();
            // Averaged over the cage angles a bearing may carry although it does not at one angle.
            let idle = |row: &usize| {
                let of_row = || bearing.balls.iter().filter(|contact| contact.row == *row);
                (rows.len() > 1 || bearing.largest_ball_load <= 0.0)
                    && of_row().all(|contact| contact.load <= 0.0 && contact.outer_load <= 0.0)
            };
            let unloaded: Vec<usize> = rows.iter().copied().filter(idle).collect();
            let (name, item) = (&site.name, format!("bearing.{}", site.name));
            let text = match (unloaded.as_slice(), rows.len()) {
                ([], _) => continue,
                (all, count) if all.len() == count => {
                    format!("bearing {name} {at}: no ball carries load, and the bearing has no stiffness")
                }
                (rows, _) => {
                    let row = if rows == [0] { "towards -z" } else { "towards +z" };
                    format!("bearing {name} {at}: the row {row} carries nothing, and has no stiffness")
                }
            };
            let gap = bearing.balls.iter().filter(|c| unloaded.contains(&c.row)).map(|c| -c.deflection);
            let gap = gap.fold(f64::INFINITY, f64::min).max(0.0);
            let mut advice = format!(
                "its smallest gap is {} um: an axial preload, a load that holds the ring, or a clearance smaller by {} um \
                 closes it",
                number(1e6 * gap, 3),
                number(2e6 * gap, 3)
            );
            if let Some(ball) = site.bearing.ball().filter(|_| state.speed != 0.0) {
                let minimum = minimum_load(ball.geometry.pitch_diameter, state.speed, None);
                advice += &format!("; against skidding it needs about {} N", number(minimum, 2));
            }
            found.push(Warning::new(Code::BearingUnloaded, item, text).advise(advice));
        }
        found
    }
}

/// Standstill, and the highest of the speeds.
pub(in crate::study) fn standstill_and_top(speeds: &[f64]) -> Vec<f64> {
    let top = speeds.iter().fold(0.0, |top: f64, speed| top.max(speed.abs()));
    if top > 0.0 { vec![top, 0.0] } else { vec![0.0] }
}

/// Massless balls whose inertia matters, once for each bearing at its highest ratio.
pub(super) fn ball_inertia(results: &Results) -> Vec<Warning> {
    let used: Vec<&InertiaUse> = results.ball_inertia.iter().flat_map(|(_, used)| used).collect();
    let is_highest = |k: usize, bearing: &InertiaUse| {
        let alike = used.iter().enumerate().filter(|(_, other)| other.bearing == bearing.bearing);
        let largest = alike.rev().max_by(|a, b| a.1.compared.ratio().total_cmp(&b.1.compared.ratio()));
        bearing.compared.ratio() > 0.0 && largest.is_some_and(|(at, _)| at == k)
    };
    let highest = used.iter().enumerate().filter(|(k, bearing)| is_highest(*k, bearing));
    highest.filter_map(|(_, bearing)| bearing.warning()).collect()
}

/// A belt that loses much of its pull, or goes slack.
fn belt(belt: &BeltPull) -> Option<Warning> {
    let share = belt.remaining_share().filter(|share| *share < LOW_PULL)?;
    let size = |v: &[f64; 2]| v[0].hypot(v[1]);
    let name = &belt.name;
    let [stated, remaining] = [&belt.stated, &belt.remaining].map(|pull| number(size(pull), 4));
    let yielded = number(1e6 * size(&belt.displacement), 4);
    let text = match share {
        share if share <= 0.0 => format!(
            "belt.{name} is slack: the pulley yields by {yielded} um along the pull of {stated} N, which then pushes \
             with {remaining} N; a belt cannot push, and the results hold only for a taut one"
        ),
        share => format!(
            "belt.{name} keeps {:.0} % of its pull at equilibrium, {remaining} of {stated} N, as shaft and supports \
             yield by {yielded} um",
            100.0 * share
        ),
    };
    let advice = "if the stated pull is that of the machine at rest, set constant_pull = true";
    Some(Warning::new(Code::BeltPull, format!("belt.{name}"), text).advise(advice))
}

/// A bearing that carries less axial force in the machine than its preload states.
fn preload(at: &MountedPreload) -> Option<Warning> {
    let share = at.mean_share().filter(|share| *share < LOW_PRELOAD)?;
    let force = at.stated.force()?;
    let (why, advice) = match at.stated {
        Preload::Spring { .. } => (
            "it is the spring's force with the ring at its nominal position, and the spring relaxes as the ring moves to \
             its contact",
            "state a softer spring, or a larger force",
        ),
        _ => (
            "it is the force with centred rings, and the shaft moves axially until its bearings balance",
            "state it as mounted_force, or preload the opposite bearing too",
        ),
    };
    let text = format!(
        "bearing.{} carries {} N axially in the machine at standstill, {:.0} % of its preload of {} N: {why}",
        at.bearing,
        number(share * force, 3),
        100.0 * share,
        number(force, 4)
    );
    Some(Warning::new(Code::Preload, format!("bearing.{}", at.bearing), text).advise(advice))
}
