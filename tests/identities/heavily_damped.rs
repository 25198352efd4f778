//! Machines with strongly damped modes, and tables with narrow parts: no crossing and no threshold is missed.

use rayon::prelude::*;
use rotordyn::linalg::Complex64;
use rotordyn::model::study::{CampbellStudy, CriticalStudy, ModalStudy};
use rotordyn::model::{Model, Options, load};
use rotordyn::study::{Machine, Results};
use std::f64::consts::TAU;

const RPM: f64 = TAU / 60.0;
const BETA: &str = include_str!("../data/damped/damping_beta.toml");
const INTERNAL: &str = include_str!("../data/damped/internal_damping.toml");
const UNSTABLE: &str = include_str!("../data/damped/unstable_between.toml");
const AT_LIMIT: &str = include_str!("../data/damped/damping_passes_limit.toml");
const AXIAL: &str = include_str!("../data/damped/uncoupled_axial.toml");
const JEFFCOTT: &str = include_str!("../../models/jeffcott.toml");

fn model(text: &str, set: &[(&str, &str)]) -> Model {
    let set = set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect();
    let loaded = load("damped.toml", text, &Options { set, ..Options::default() });
    loaded.unwrap_or_else(|errors| panic!("{errors:?}")).model
}

/// The Jeffcott rotor without its modal damping.
fn without_modal_damping() -> String {
    let (before, rest) = JEFFCOTT.split_once("[damping.modal]").unwrap();
    format!("{before}{}", &rest[rest.find("\n[").unwrap()..])
}

/// A rigid rotor whose supports are softer over a narrow range of speeds.
fn narrow_table(speeds: &str, stiffness: &str) -> Model {
    let bearing = |name: &str, more: &str| {
        format!(
            "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"linear\"\nspeed = \"{speeds} rpm\"\n\
             k_xx = \"{stiffness} N/m\"\nk_yy = \"8e5 N/m\"\n{more}\n"
        )
    };
    let rotor = "[model]\nname = \"narrow\"\ngravity = \"0 m/s^2\"\n[rotor]\ncentre = \"250 mm\"\nmass = \"10 kg\"\n\
                 polar_inertia = \"0.02 kg m^2\"\ndiametral_inertia = \"0.5 kg m^2\"\n[station]\nA = \"0 mm\"\n\
                 B = \"500 mm\"\n[damping]\nmass = \"1 1/s\"\n";
    model(&format!("{rotor}{}{}", bearing("A", "k_zz = \"1e6 N/m\""), bearing("B", "")), &[])
}

/// Number of modes below ω = n Ω at every speed, those with |λ| above `reach` times their damped frequency or below `least`
/// \[rad/s\] left out.
fn counts(machine: &Machine, speeds: &[f64], order: f64, [reach, least]: [f64; 2]) -> Vec<usize> {
    let below = |speed: &f64| {
        let modes = machine.modal(&ModalStudy { speeds: vec![*speed], modes: 60 }).unwrap().remove(0).modes;
        let values =
            modes.iter().map(|m| m.eigenvalue).filter(|v| reach * v.im > v.norm() && v.norm() > least);
        values.filter(|v| v.im < order * speed).count()
    };
    speeds.par_iter().map(below).collect()
}

/// Between two speeds of a fine grid as many crossings are listed as the number of modes below the line changes by, or
/// more by pairs.
fn assert_complete(name: &str, machine: &Machine, top: f64, order: f64, found: &[f64]) {
    let speeds: Vec<f64> = (0..=600).map(|k| top * f64::from(k) / 600.0).collect();
    let [counts, of_fewer] = [[3.0, 0.2], [2.0, 0.5]].map(|limits| counts(machine, &speeds, order, limits));
    let mut changes = 0;
    for (range, (count, fewer)) in speeds.windows(2).zip(counts.windows(2).zip(of_fewer.windows(2))) {
        let listed = found.iter().filter(|speed| (range[0]..range[1]).contains(*speed)).count();
        let change = count[0].abs_diff(count[1]);
        if change != fewer[0].abs_diff(fewer[1]) {
            // The damping of a mode or its frequency passes one of the limits.
            continue;
        }
        changes += change;
        let [from, to] = [range[0] / RPM, range[1] / RPM];
        assert!(
            listed >= change && (listed - change).is_multiple_of(2),
            "{name}, order {order}: {listed} crossings from {from} to {to} rpm, the modes below change by {change}"
        );
    }
    assert!(changes > 0, "{name}");
}

fn critical(machine: &Machine, max_speed: f64, order: f64) -> Vec<f64> {
    let found = machine.critical(&CriticalStudy { max_speed, orders: vec![order] }).unwrap();
    assert!(found.crossings.uncertain.is_empty(), "{:?}", found.crossings.uncertain);
    found.crossings.list.iter().map(|c| c.speed).collect()
}

#[test]
fn critical_speeds_of_strongly_damped_shafts_are_complete() {
    for (name, text, rpm) in [("beta", BETA, 8099.0), ("internal", INTERNAL, 23190.0)] {
        let machine = Machine::new(model(text, &[])).unwrap();
        for top in [rpm, 0.52 * rpm, 0.35 * rpm, 1000.0, 300.0].map(|rpm| rpm * RPM) {
            for order in [1.0, 2.0] {
                let found = critical(&machine, top, order);
                if name == "internal" || top > 7900.0 * RPM {
                    assert_complete(name, &machine, top, order, &found);
                }
            }
        }
    }
}

/// The lowest modes of a diagram are those of the lowest |λ|, among which strongly damped ones come and go.
#[test]
fn crossings_of_a_diagram_are_complete_however_many_modes_it_has() {
    let machine = Machine::new(model(BETA, &[])).unwrap();
    let speeds: Vec<f64> = (0..9).map(|k| 8099.0 * RPM * f64::from(k) / 8.0).collect();
    for modes in [6, 8, 10, 12, 13, 14, 16, 20] {
        let study = CampbellStudy {
            speeds: speeds.clone(),
            modes,
            orders: vec![1.0],
            speed_dependent_bearings: true,
        };
        let found = machine.campbell(&study).unwrap().crossings;
        let rpm: Vec<f64> = found.list.iter().map(|c| c.speed / RPM).collect();
        assert!(found.uncertain.is_empty() && found.omitted.is_empty(), "{modes} modes: {found:?}");
        // Of an independent model of the same machine.
        for expected in [7011.81, 7366.82, 7996.38] {
            assert!(rpm.iter().any(|rpm| (rpm - expected).abs() < 0.01), "{modes} modes: {rpm:?}");
        }
    }
}

/// With C = β K alone the eigenvalues are those of λ² + β ω² λ + ω² = 0, and there are no others.
#[test]
fn a_shaft_with_damping_by_stiffness_has_the_modes_of_the_closed_form() {
    // The shaft's damping does not include the bearings'.
    let bearings = ["bearing.A.c_xx", "bearing.A.c_yy", "bearing.A.c_zz", "bearing.B.c_xx", "bearing.B.c_yy"];
    let with = |beta: f64| -> Vec<(&str, String)> {
        let damping = format!("{} N s/m", beta * 2e7);
        let bearings = bearings.iter().map(|path| (*path, damping.clone()));
        bearings.chain([("damping.stiffness", format!("{beta} s"))]).collect()
    };
    let text = without_modal_damping();
    let at_rest = |beta: f64| {
        let set = with(beta);
        let set: Vec<(&str, &str)> = set.iter().map(|(path, value)| (*path, value.as_str())).collect();
        let machine = Machine::new(model(&text, &set)).unwrap();
        machine.modal(&ModalStudy { speeds: vec![0.0], modes: 60 }).unwrap().remove(0).modes
    };
    let undamped: Vec<f64> = at_rest(0.0).iter().map(|m| m.omega()).collect();
    for beta in [2e-5, 1e-4, 2e-4, 1e-3] {
        let modes = at_rest(beta);
        let expected: Vec<Complex64> = undamped
            .iter()
            .map(|w| (w, 0.5 * beta * w))
            .filter(|(_, zeta)| *zeta < 0.9999995)
            .map(|(w, zeta)| Complex64::new(-zeta * w, w * (1.0 - zeta * zeta).sqrt()))
            .collect();
        assert_eq!(modes.len(), expected.len(), "{beta}");
        for value in expected {
            let nearest = modes.iter().map(|m| (m.eigenvalue - value).norm()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-6 * value.norm(), "{beta}: {value}, off by {nearest}");
        }
    }
}

#[test]
fn any_damping_by_stiffness_is_solved_at_any_speed() {
    let text = without_modal_damping();
    for (key, beta) in [
        ("shaft.stiffness_damping", "5e-5 s"),
        ("shaft.stiffness_damping", "1e-4 s"),
        ("shaft.stiffness_damping", "1e-3 s"),
        ("shaft.internal_damping", "1e-4 s"),
        ("damping.stiffness", "2e-4 s"),
    ] {
        let machine = Machine::new(model(&text, &[(key, beta)])).unwrap();
        for modes in [8, 12, 20] {
            let speeds: Vec<f64> = (0..13).map(|k| 500.0 * RPM * f64::from(k)).collect();
            let study = CampbellStudy { speeds, modes, orders: vec![1.0], speed_dependent_bearings: true };
            let found = machine.campbell(&study).unwrap_or_else(|error| panic!("{key} {beta}: {error}"));
            assert!(!found.crossings.list.is_empty(), "{key} {beta}");
        }
        critical(&machine, 6000.0 * RPM, 1.0);
    }
}

#[test]
fn crossings_within_a_narrow_part_of_a_table_are_found() {
    for (name, speeds, stiffness) in [
        ("equal ends", "0, 1380, 1395, 1410, 1425, 6000", "5e5, 5e5, 5e4, 5e4, 5e5, 5e5"),
        ("other end", "0, 1380, 1395, 1410, 1425, 6000", "5e5, 5e5, 5e4, 5e4, 5e5, 5.00001e5"),
    ] {
        let machine = Machine::new(narrow_table(speeds, stiffness)).unwrap();
        let top = 6000.0 * RPM;
        let found = critical(&machine, top, 1.0);
        let narrow: Vec<f64> = (0..400).map(|k| (1375.0 + 0.15 * f64::from(k)) * RPM).collect();
        let counts = counts(&machine, &narrow, 1.0, [3.0, 0.2]);
        let changes: usize = counts.windows(2).map(|pair| pair[0].abs_diff(pair[1])).sum();
        let listed = found.iter().filter(|speed| (narrow[0]..narrow[399]).contains(*speed)).count();
        assert!(changes >= 4 && listed == changes, "{name}: {listed} of {changes}: {found:?}");
        let study = CampbellStudy {
            speeds: (0..5).map(|k| 1500.0 * RPM * f64::from(k)).collect(),
            modes: 8,
            orders: vec![1.0],
            speed_dependent_bearings: true,
        };
        let of_diagram = machine.campbell(&study).unwrap().crossings.list;
        assert_eq!(of_diagram.len(), found.len(), "{name}");
    }
}

/// A mode that is unstable between two speeds of the diagram only.
#[test]
fn a_mode_that_is_unstable_between_the_speeds_of_a_diagram_is_named() {
    let machine = Machine::new(model(UNSTABLE, &[])).unwrap();
    let study = machine.model.studies.campbell.clone().unwrap();
    let found = machine.campbell(&study).unwrap();
    let rpm: Vec<(f64, bool)> = found.thresholds.iter().map(|t| (t.speed / RPM, t.unstable_above)).collect();
    // Of an independent model of the same machine.
    assert!(rpm.iter().any(|(rpm, above)| (rpm - 482.94).abs() < 0.01 && !above), "{rpm:?}");
    let results = Results { campbell: Some(found), ..Results::default() };
    let named = |warnings: Vec<rotordyn::warning::Warning>| {
        warnings.iter().any(|w| w.code == rotordyn::warning::Code::UnstableMode)
    };
    assert!(named(machine.warnings(&results, &study.speeds)));
    let critical = machine.critical(&machine.model.studies.critical.clone().unwrap()).unwrap();
    let results = Results { critical: Some(critical), ..Results::default() };
    assert!(named(machine.warnings(&results, &study.speeds)));
}

/// A mode comes to have a damping ratio above 0.94 in the step in which another crosses the line: their number stays.
#[test]
fn a_crossing_beside_a_mode_that_ceases_to_take_part_is_found() {
    let machine = Machine::new(model(AT_LIMIT, &[])).unwrap();
    let found = critical(&machine, machine.model.studies.critical.clone().unwrap().max_speed, 1.0);
    let axial =
        machine.modal(&ModalStudy { speeds: vec![6037.15 * RPM], modes: 20 }).unwrap().remove(0).modes;
    assert!(axial.iter().any(|mode| (mode.omega() / (6037.15 * RPM) - 1.0).abs() < 1e-6));
    assert!(found.iter().any(|speed| (speed / RPM - 6037.15).abs() < 0.01), "{found:?}");
}

/// A crossing of a mode that no branch follows belongs to none.
#[test]
fn an_uncoupled_mode_gives_no_threshold_to_others() {
    let machine = Machine::new(model(AXIAL, &[])).unwrap();
    let study = machine.model.studies.campbell.clone().unwrap();
    let found = machine.campbell(&study).unwrap();
    let rpm: Vec<f64> = found.thresholds.iter().map(|t| t.speed / RPM).collect();
    // Without the speeds of the diagram, 5364 and 10729 rpm.
    assert!(rpm.len() == 2 && (rpm[0] - 718.3).abs() < 0.1 && (rpm[1] - 11967.3).abs() < 0.1, "{rpm:?}");
}

/// A rotor that a negative stiffness pushes away, turned a little by cross coupling: it grows almost without turning.
#[test]
fn a_mode_that_grows_is_kept_however_slowly_it_turns() {
    let mut model = narrow_table("0, 6000", "5e5, 5e5");
    model.damping = Default::default();
    for (site, stiffness) in model.bearings.iter_mut().zip([-1e6, 3e6]) {
        let rotordyn::bearing::Bearing::Linear(bearing) = &mut site.bearing else { panic!("a linear one") };
        for row in &mut bearing.table {
            (row.stiffness[0][0], row.stiffness[1][1]) = (stiffness, stiffness);
            (row.stiffness[0][1], row.stiffness[1][0]) = (1e3, -1e3);
        }
    }
    let machine = Machine::new(model).unwrap();
    let modes = machine.modal(&ModalStudy { speeds: vec![3000.0 * RPM], modes: 6 }).unwrap().remove(0).modes;
    assert!(
        modes.iter().any(|mode| mode.zeta() < -0.99),
        "{:?}",
        modes.iter().map(|m| m.eigenvalue).collect::<Vec<_>>()
    );
}

/// Undamped along y at rest, damped as soon as it turns: not unstable below any speed.
#[test]
fn an_undamped_mode_at_rest_is_no_threshold() {
    let mut machine = narrow_table("0, 6000", "5e5, 5e5");
    for site in &mut machine.bearings {
        let rotordyn::bearing::Bearing::Linear(bearing) = &mut site.bearing else { panic!("a linear one") };
        for row in &mut bearing.table {
            row.damping[0][0] = 2214.0;
        }
    }
    machine.damping = Default::default();
    let machine = Machine::new(machine).unwrap();
    let study = CampbellStudy {
        speeds: (0..25).map(|k| 250.0 * RPM * f64::from(k)).collect(),
        modes: 8,
        orders: vec![1.0],
        speed_dependent_bearings: true,
    };
    let found = machine.campbell(&study).unwrap();
    assert!(found.thresholds.is_empty(), "{:?}", found.thresholds);
}
