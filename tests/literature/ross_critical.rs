//! Critical speeds of ROSS 3.1.0's models: the direct undamped solution and crossings of tracked branches.

use crate::agree;
use crate::ross::{self, numbers, read};
use rotordyn::analysis::ModeKind;
use rotordyn::analysis::campbell::campbell;
use rotordyn::analysis::critical_speed::{crossings, undamped_critical_speeds};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::bearing::Bearing;

const CASES: [&str; 6] = [
    "friswell_5_9_1",
    "jeffcott",
    "nelson_mcvaugh_isotropic_rayleigh",
    "nelson_mcvaugh_isotropic_timoshenko",
    "overhung_disc_300x20",
    "uniform_pinned",
];

#[test]
fn undamped_critical_speeds_and_their_whirl_agree() {
    for name in CASES {
        let case = read(&format!("ross/{name}.json"));
        let model = ross::model(&case);
        let assembly = Assembly::new(&model).unwrap();
        let reference = &case["results"]["critical_speeds_exact_undamped"];
        let theirs = numbers(&reference["speed"]);
        let system = LinearSystem::new(&assembly, &ross::tangents(&model, 0.0), 0.0).unwrap();
        let ours =
            undamped_critical_speeds(&assembly, &system, 1.0, theirs.last().unwrap() * 1.000_001).unwrap();
        assert_eq!(ours.len(), theirs.len(), "{name}");
        for (k, (ours, theirs)) in ours.iter().zip(&theirs).enumerate() {
            // Round-off of the stiffest element (1e12 N/m pins) is the limit.
            agree::relative(
                format_args!("{name}: undamped critical speed {k} [rad/s]"),
                ours.speed,
                *theirs,
                1e-7,
            );
            let whirl = reference["whirl"][k].as_str().unwrap();
            let kind = match ours.mode.kind {
                ModeKind::Forward => "Forward",
                ModeKind::Backward => "Backward",
                ModeKind::Torsional => "Torsional",
                ModeKind::Axial => "Axial",
                other => panic!("{name} {k}: {other:?}"),
            };
            assert_eq!(kind, whirl, "{name} {k} at {theirs}");
        }
    }
}

#[test]
fn crossings_of_tracked_branches_agree() {
    for name in
        CASES.into_iter().chain(["nelson_mcvaugh_orthotropic_damped", "speed_table_proportional_damping"])
    {
        let case = read(&format!("ross/{name}.json"));
        let model = ross::model(&case);
        let assembly = Assembly::new(&model).unwrap();
        let theirs = numbers(&case["results"]["critical_speeds_ross"]["reference_wd"]);
        let top = theirs.last().unwrap() * 1.01;
        let speeds: Vec<f64> = (0..=20).map(|k| top * f64::from(k) / 20.0).collect();
        let tangents = |speed: f64| Ok(ross::tangents(&model, speed));
        let diagram = campbell(&assembly, &speeds, 12, &tangents).unwrap();
        let ours = crossings(&assembly, &diagram, &[1.0], &tangents, &[]).unwrap().list;
        // ROSS goes on linearly beyond a table of bearing coefficients, here the values of its end hold.
        let table_end = model.bearings.iter().map(|site| match &site.bearing {
            Bearing::Linear(linear) => linear.table_range().map_or(f64::INFINITY, |range| range[1]),
            _ => f64::INFINITY,
        });
        let table_end = table_end.fold(f64::INFINITY, f64::min);
        assert!(theirs[0] < table_end, "{name}: no reference within the table");
        for reference in theirs.iter().filter(|speed| **speed <= table_end) {
            let off = |speed: f64| (speed / reference - 1.0).abs();
            let nearest = ours.iter().map(|c| c.speed).min_by(|a, b| off(*a).total_cmp(&off(*b)));
            let nearest = nearest.unwrap_or_else(|| panic!("{name}: no crossings"));
            agree::relative(format_args!("{name}: critical speed [rad/s]"), nearest, *reference, 1e-6);
        }
        println!("{name}:");
        for c in &ours {
            println!("  {:10.2} rad/s  {}  {:?}", c.speed, c.mode.label, c.mode.kind);
        }
        let listed: Vec<f64> = ours.iter().map(|c| c.speed).collect();
        assert!(listed.windows(2).all(|w| w[1] > w[0]), "{name}: no crossing twice: {listed:?}");
    }
}
