//! Belt pull and bearing preload in the assembled machine beside the stated ones, with warnings.

use rotordyn::analysis::belt_pull::BeltPull;
use rotordyn::analysis::preload::MountedPreload;
use rotordyn::bearing::Preload;
use rotordyn::study::Machine;

use super::terminal::{Terminal, number};

/// Warnings of belts and preloads at standstill.
pub fn warnings(machine: &Machine) -> Vec<String> {
    let mut found = belt_warnings(machine.belt_pulls());
    found.extend(preload_warnings(machine.mounted_preloads()));
    found
}

/// Pull of the belts at equilibrium beside the stated one.
pub fn belts(terminal: &Terminal, found: &[BeltPull]) {
    let rows: Vec<Vec<String>> = found
        .iter()
        .map(|belt| {
            let share = belt.remaining_share().map_or("-".into(), |share| format!("{:.1}", 100.0 * share));
            let mut row = vec![belt.name.clone()];
            row.extend(belt.stated.iter().chain(&belt.remaining).map(|pull| number(*pull, 4)));
            row.push(share);
            row.extend(belt.displacement.iter().map(|d| format!("{:.2}", 1e6 * d)));
            row
        })
        .collect();
    if !rows.is_empty() {
        let header = ["belt", "stated x N", "y N", "remaining x N", "y N", "share %", "u_x um", "u_y um"];
        terminal.table("Belt pull on the shaft at equilibrium", &header, &rows);
    }
}

/// Share of the stated pull below which a warning is given.
const LOW_PULL: f64 = 0.8;

/// Warnings of belts that lose much of their pull, or go slack.
fn belt_warnings(found: &[BeltPull]) -> Vec<String> {
    let warning = |belt: &BeltPull| {
        let share = belt.remaining_share().filter(|share| *share < LOW_PULL)?;
        let size = |v: &[f64; 2]| number(v[0].hypot(v[1]), 4);
        let advice = "if the stated pull is that of the machine at rest, set constant_pull = true";
        Some(match share {
            share if share <= 0.0 => format!(
                "belt.{} is slack: the pulley yields by {} um along the pull of {} N, which then pushes with {} N; \
                 a belt cannot push, and the results hold only for a taut one; {advice}",
                belt.name,
                number(1e6 * belt.displacement[0].hypot(belt.displacement[1]), 4),
                size(&belt.stated),
                size(&belt.remaining)
            ),
            share => format!(
                "belt.{} keeps {:.0} % of its pull at equilibrium, {} of {} N, as shaft and supports yield by {} um; \
                 {advice}",
                belt.name,
                100.0 * share,
                size(&belt.remaining),
                size(&belt.stated),
                number(1e6 * belt.displacement[0].hypot(belt.displacement[1]), 4)
            ),
        })
    };
    found.iter().filter_map(warning).collect()
}

/// Share of the stated preload below which a warning is given.
const LOW_PRELOAD: f64 = 0.8;

/// Axial force of the preloaded bearings at equilibrium beside the stated one.
pub fn preloads(terminal: &Terminal, found: &[MountedPreload]) {
    let rows: Vec<Vec<String>> = found
        .iter()
        .map(|at| {
            let carried: Vec<String> = at.rows.iter().map(|force| number(*force, 4)).collect();
            let share = at.share().map_or("-".into(), |share| format!("{:.1}", 100.0 * share));
            vec![at.bearing.clone(), stated(&at.stated), carried.join(", "), share]
        })
        .collect();
    if !rows.is_empty() {
        let header = ["bearing", "stated", "axial force N", "share %"];
        terminal.table("Preload: axial force of every row in the machine", &header, &rows);
    }
}

/// A preload as stated, with its meaning.
pub fn stated(preload: &Preload) -> String {
    let newton = |force: f64| number(force, 4);
    let micrometres = |length: f64| number(1e6 * length, 4);
    match *preload {
        Preload::None => "none".into(),
        Preload::Interference(offset) => format!("interference {} um", micrometres(offset)),
        Preload::DryForce(force) => format!("dry_force {} N, centred at rest", newton(force)),
        Preload::Force(force) => format!("force {} N, centred at speed", newton(force)),
        Preload::Spring { stiffness, force } => {
            format!("spring {} N/m, {} N at nominal position", number(stiffness, 4), newton(force))
        }
        Preload::Mounted { force, interference } => {
            let by =
                interference.map_or(String::new(), |i| format!(" by interference {} um", micrometres(i)));
            format!("mounted_force {} N at standstill{by}", newton(force))
        }
    }
}

/// Warnings of bearings that carry less axial force in the machine than their preload states.
fn preload_warnings(found: &[MountedPreload]) -> Vec<String> {
    let warning = |at: &MountedPreload| {
        let share = at.share().filter(|share| *share < LOW_PRELOAD)?;
        let force = at.stated.force()?;
        let carried = number(share * force, 3);
        let why = match at.stated {
            Preload::Spring { .. } => {
                "it is the spring's force with the ring at its nominal position, and the spring relaxes as the ring \
                 moves to its contact: state a softer spring, or a larger force"
            }
            _ => {
                "it is the force with centred rings, and the shaft moves axially until its bearings balance: state \
                 it as mounted_force, or preload the opposite bearing too"
            }
        };
        Some(format!(
            "bearing.{} carries {carried} N axially in the machine at standstill, {:.0} % of its preload of {} N: {why}",
            at.bearing,
            100.0 * share,
            number(force, 4)
        ))
    };
    found.iter().filter_map(warning).collect()
}
