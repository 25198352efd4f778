//! Loads at static equilibrium: belt pull and bearing preload beside the stated ones, loads along the shaft.

use rotordyn::analysis::belt_pull::BeltPull;
use rotordyn::analysis::equilibrium::Equilibrium;
use rotordyn::analysis::preload::MountedPreload;
use rotordyn::analysis::shaft_loads::ShaftPoint;
use rotordyn::bearing::Preload;

use super::terminal::{Terminal, number, rpm};

/// Forces of supports smaller than this fraction of the largest are round-off.
const ROUND_OFF: f64 = 1e-9;

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

/// Where along the shaft deflection and section loads are largest, and the forces of its supports.
pub fn shaft(terminal: &Terminal, found: &Equilibrium) {
    if found.shaft.is_empty() {
        return;
    }
    let norm = |v: [f64; 2]| v[0].hypot(v[1]);
    let rows: Vec<Vec<String>> = [
        ("deflection um", ShaftPoint::largest(&found.shaft, |p| 1e6 * norm(p.displacement))),
        ("shear force N", ShaftPoint::largest(&found.shaft, |p| norm(p.shear))),
        ("bending moment N m", ShaftPoint::largest(&found.shaft, |p| norm(p.moment))),
        ("bending stress MPa", ShaftPoint::largest(&found.shaft, |p| 1e-6 * p.stress)),
    ]
    .into_iter()
    .filter_map(|(name, largest)| {
        let (point, value) = largest?;
        Some(vec![name.into(), number(value, 4), format!("{:.1}", 1e3 * point.z)])
    })
    .collect();
    let at = match found.speed {
        0.0 => "at rest".into(),
        speed => format!("under static loads at {:.0} rpm", rpm(speed)),
    };
    terminal.table(&format!("Shaft {at}: largest deflection and loads"), &["", "largest", "at z mm"], &rows);
    let all = found.support_forces.iter().flat_map(|r| r.force);
    let largest = all.fold(0.0, |most: f64, f| most.max(f.abs()));
    let rows: Vec<Vec<String>> = found
        .support_forces
        .iter()
        .map(|r| {
            let mut row = vec![r.name.clone(), format!("{:.1}", 1e3 * r.z)];
            // Differences of section loads have their round-off.
            let shown = |f: f64| if f.abs() < ROUND_OFF * largest { 0.0 } else { f };
            row.extend(r.force[..5].iter().map(|f| number(shown(*f), 4)));
            row
        })
        .collect();
    if !rows.is_empty() {
        let header = ["support", "z mm", "F_x N", "F_y N", "F_z N", "M_x N m", "M_y N m"];
        terminal.table(&format!("Forces of the supports on the shaft {at}"), &header, &rows);
    }
}
