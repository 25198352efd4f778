//! Figures, JSON and viewer files (glTF, VTK) of the rig's results.

use rotordyn::figures::{LinearComparison, draw, draw_comparison};
use rotordyn::io::export_3d::{export_geometry, export_mode_motion, export_modes};
use rotordyn::io::json::to_json;
use rotordyn::study::{FrfCase, compare_frfs};
use serde_json::Value;

use crate::rig_results::RIG;

#[test]
fn all_figures_are_drawn_reproducibly() {
    let (machine, results) = &*RIG;
    let folder = tempfile::tempdir().unwrap();
    let files = draw(results, machine, &folder.path().join("a")).unwrap();
    let again = draw(results, machine, &folder.path().join("b")).unwrap();
    let names: Vec<&str> = files.iter().map(|f| f.file_stem().unwrap().to_str().unwrap()).collect();
    let expected = [
        "machine_layout",
        "static_deflection",
        "ball_loads",
        "static_shaft_loads",
        "modes_0rpm",
        "modes_1200rpm",
        "campbell",
        "stability",
        "frf_rim",
        "frf_rim_rotation",
        "frf_housing_B",
        "unbalance_bode_acceleration",
        "unbalance_polar_acceleration",
        "unbalance_bode_displacement",
        "unbalance_polar_displacement",
        "unbalance_orbits",
        "unbalance_shaft_loads_1805rpm",
        "unbalance_shaft_loads_1200rpm",
        "unbalance_bearing_forces",
        "run_up_A_ax",
        "run_up_A_ay",
        "run_up_B_ax",
        "run_up_B_ay",
        "run_up_disc_x",
        "run_up_disc_y",
        "run_up_disc_twist",
        "run_up_rim_y",
        "run_up_bearing_A",
        "run_up_bearing_B",
        "run_up_energy",
        "spectrogram_B_ax",
        "waterfall_B_ax",
        "orders_B_ax",
        "order_cuts_B_ax",
        "bearing_B_sheet",
        "bearing_B_ball_loads",
        "bearing_B_contact_angles",
        "bearing_B_section",
        "bearing_B_stiffness_over_load",
        "bearing_B_displacement_over_load",
        "bearing_B_contacts_over_load",
        "bearing_B_life_over_load",
        "bearing_B_stiffness_over_cage_angle",
        "bearing_B_displacement_over_cage_angle",
        "bearing_B_contacts_over_cage_angle",
    ];
    assert_eq!(names, expected);
    for (a, b) in files.iter().zip(&again) {
        for (a, b) in [(a, b), (&a.with_extension("png"), &b.with_extension("png"))] {
            assert!(std::fs::read(a).unwrap() == std::fs::read(b).unwrap(), "{} differs", a.display());
        }
    }
    let text = |name: &str| std::fs::read_to_string(folder.path().join("a").join(name)).unwrap();
    for (file, words) in [
        ("campbell.svg", &["1st torsional", "BPFO", "9x", "shaft speed [rpm]"][..]),
        ("spectrogram_B_ax.svg", &["1st torsional", "BPFO", "acceleration level [dB re 1 m/s²]"]),
        ("frf_rim.svg", &["accelerance [(m/s²)/N]", "disc_x", "0 rpm"]),
        ("ball_loads.svg", &["bearing A", "load [N]"]),
        ("machine_layout.svg", &["housing A", "bearing B", "250 N along x", "pulley"]),
    ] {
        let svg = text(file);
        words.iter().for_each(|w| assert!(svg.contains(w), "{file}: {w}"));
    }
    // Branches above the frequency axis are neither drawn nor listed in the log decrement panel.
    assert!(!text("campbell.svg").contains("housing A, u_z"));
}

#[test]
fn variant_comparison_figures() {
    let (machine, results) = &*RIG;
    let folder = tempfile::tempdir().unwrap();
    let frf = results.frf.as_ref().unwrap();
    let case = |name| FrfCase { name, machine, found: frf };
    let compared = compare_frfs(&[case("ball bearings"), case("spherical")], &[]).unwrap();
    let campbell = results.campbell.as_ref().unwrap();
    let drawn = |frfs, campbell| LinearComparison { note: "rig", frfs, unbalance: None, campbell };
    let both = [("ball bearings", campbell), ("spherical", campbell)];
    let files = draw_comparison(drawn(Some(&compared), &both), folder.path()).unwrap();
    // A hit on housing B does not excite the disc's torsion: no figure.
    assert_eq!(files.len(), 2 * 8 - 1 + 1);
    let svg = std::fs::read_to_string(folder.path().join("comparison_frf_rim_disc_x.svg")).unwrap();
    assert!(svg.contains("ball bearings") && svg.contains("spherical"));
    let alone = compare_frfs(&[case("ball bearings")], &[]).unwrap();
    assert!(draw_comparison(drawn(Some(&alone), &both[..1]), folder.path()).unwrap().is_empty());
}

/// Every number of a document, by path.
fn numbers(value: &Value, path: &str, out: &mut Vec<(String, Option<f64>)>) {
    match value {
        Value::Object(map) => map.iter().for_each(|(k, v)| numbers(v, &format!("{path}.{k}"), out)),
        Value::Array(list) => list.iter().for_each(|v| numbers(v, path, out)),
        Value::Number(_) | Value::Null => out.push((path.into(), value.as_f64())),
        _ => {}
    }
}

#[test]
fn json_contains_finite_numbers_and_units() {
    let (machine, results) = &*RIG;
    let document = to_json(results, machine);
    let keys: Vec<&String> = document.as_object().unwrap().keys().collect();
    let mut expected = [
        "schema",
        "program",
        "version",
        "model",
        "title",
        "units",
        "equilibrium",
        "modal",
        "campbell",
        "critical_speeds",
        "frf",
        "unbalance",
        "run_up",
        "spectrograms",
        "orders",
        "bearings",
        "warnings",
    ];
    expected.sort_unstable();
    assert_eq!(keys, expected);
    assert_eq!(document["schema"], "rotordyn-results-3");
    assert_eq!(document["modal"][1]["speed_rpm"].as_f64().map(|rpm| (rpm - 1200.0).abs() < 1e-9), Some(true));
    let mut all = Vec::new();
    numbers(&document, "", &mut all);
    let missing = all.iter().filter(|(path, v)| v.is_none() && !path.contains("branches"));
    // No rerun of a stretch: this run-up was not made by the command.
    let missing: Vec<_> = missing.filter(|(path, _)| path != ".run_up.step_error").collect();
    assert!(all.len() > 10_000 && missing.is_empty(), "{missing:?}");

    // Non-finite numbers become null instead of invalid JSON.
    let mut broken = results.clone();
    broken.equilibrium.as_mut().unwrap().residual = f64::NAN;
    broken.orders[0].cuts[0].1.rms[0] = f64::INFINITY;
    let document: Value = serde_json::from_str(&to_json(&broken, machine).to_string()).unwrap();
    assert!(document["equilibrium"]["residual_n"].is_null());
    assert!(document["orders"][0]["cuts"][0]["rms"][0].is_null());
    let empty = to_json(&rotordyn::results::Results::default(), machine);
    assert_eq!(empty.as_object().unwrap().len(), 7);
}

#[test]
fn geometry_and_mode_shapes_are_exported() {
    let (machine, results) = &*RIG;
    let folder = tempfile::tempdir().unwrap();
    let shapes = export_geometry(machine, folder.path()).unwrap();
    assert_eq!(shapes.len(), 3);
    assert!(shapes.iter().all(|f| std::fs::read(f).unwrap().starts_with(b"glTF")));
    let series = export_modes(results, machine, folder.path()).unwrap();
    assert_eq!(series.len(), 2);
    let text = std::fs::read_to_string(&series[1]).unwrap();
    assert_eq!(text.matches("<DataSet").count(), 12);
    assert!(text.contains("timestep=\"1e0\" part=\"0\" file=\"modes_1200rpm_01.vtu\""), "{text}");
    // The first mode is a bending mode: the largest motion of any point is a tenth of the shaft's 625 mm.
    let vtu = std::fs::read_to_string(folder.path().join("modes_1200rpm_01.vtu")).unwrap();
    let vectors = |name: &str| -> Vec<[f64; 3]> {
        let body = vtu.split(&format!("Name=\"{name}\"")).nth(1).unwrap();
        let body = body.split_once('>').unwrap().1.split('<').next().unwrap();
        let list: Vec<f64> = body.split_whitespace().map(|n| n.parse().unwrap()).collect();
        list.chunks(3).map(|v| [v[0], v[1], v[2]]).collect()
    };
    let square = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
    let (now, later) = (vectors("displacement"), vectors("displacement_quarter"));
    let largest = now.iter().zip(&later).map(|(a, b)| (square(a) + square(b)).sqrt()).fold(0.0, f64::max);
    // The written coordinates of the surfaces are rounded.
    assert!((largest - 0.0625).abs() < 1e-8, "{largest}");
    // In motion: the frames of a cycle, of which the first is the shape and the second, of four, a quarter later.
    let moving = export_mode_motion(results, machine, 4, folder.path()).unwrap();
    assert_eq!(moving.len(), 24);
    let text = std::fs::read_to_string(folder.path().join("modes_1200rpm_01.pvd")).unwrap();
    assert!(text.contains("timestep=\"2.5e-1\" part=\"0\" file=\"modes_1200rpm/mode_01_001.vtu\""), "{text}");
    let points = |frame: usize| -> Vec<[f64; 3]> {
        let file = folder.path().join(format!("modes_1200rpm/mode_01_{frame:03}.vtu"));
        let bytes = std::fs::read(file).unwrap();
        let marker = b"<AppendedData encoding=\"raw\">\n_";
        let start = bytes.windows(marker.len()).position(|w| w == marker).unwrap() + marker.len();
        let header = String::from_utf8_lossy(&bytes[..start]).into_owned();
        let declared = header.split("Name=\"points\"").nth(1).unwrap();
        let offset: usize =
            declared.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
        let at = start + offset;
        let size = u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
        let numbers: Vec<f64> = bytes[at + 8..at + 8 + size]
            .chunks(8)
            .map(|b| f64::from_le_bytes(b.try_into().unwrap()))
            .collect();
        numbers.chunks(3).map(|p| [p[0], p[1], p[2]]).collect()
    };
    let (first, second, third) = (points(0), points(1), points(2));
    for k in 0..now.len() {
        for i in 0..3 {
            let rest = 0.5 * (first[k][i] + third[k][i]);
            assert!((first[k][i] - rest - now[k][i]).abs() < 1e-12);
            assert!((second[k][i] - rest - later[k][i]).abs() < 1e-12);
        }
    }
}
