//! JSON documents and tables of results: eigenvalues, shapes, times, energies.

use crate::{json_of, output_of, rotordyn};
use rotordyn::linalg::Complex64;
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use std::f64::consts::TAU;

fn complex(value: &serde_json::Value) -> Complex64 {
    Complex64::new(value["re"].as_f64().unwrap(), value["im"].as_f64().unwrap())
}

/// Shape of a mode of the document, over all DOFs.
fn shape(mode: &serde_json::Value) -> Vec<Complex64> {
    let part = |name: &str| -> Vec<f64> {
        let rows: Vec<[f64; 6]> = serde_json::from_value(mode["shape"][name].clone()).unwrap();
        rows.into_iter().flatten().collect()
    };
    part("re").into_iter().zip(part("im")).map(|(re, im)| Complex64::new(re, im)).collect()
}

/// φᴴ M φ = 1 with the mass matrix over all DOFs.
fn assert_mass_normalised(machine: &Machine, mode: &serde_json::Value) {
    let phi = shape(mode);
    let part = |of: fn(&Complex64) -> f64| phi.iter().map(of).collect::<Vec<f64>>();
    let mass = &machine.assembly.full_mass;
    let modal: f64 = [part(|v| v.re), part(|v| v.im)]
        .iter()
        .map(|v| mass.mul(v).iter().zip(v).map(|(a, b)| a * b).sum::<f64>())
        .sum();
    assert!((modal - 1.0).abs() < 1e-9, "{modal}");
}

#[test]
fn documents_contain_eigenvalues_and_shapes() {
    let folder = tempfile::tempdir().unwrap();
    for model in ["models/jeffcott.toml", "models/two_disc_pedestals.toml"] {
        let text = std::fs::read_to_string(model).unwrap();
        let machine = Machine::new(load(model, text, &Options::default()).unwrap().model).unwrap();
        let run = |command: &str, flags: &[&str]| {
            json_of(rotordyn().args([command, model, "--no-figures", "--out"]).arg(folder.path()).args(flags))
        };
        let modal = run("modal", &["--speed", "2000 rpm"]);
        let at = &modal["modal"][0];
        let nodes = at["nodes"].as_array().unwrap().len();
        assert_eq!(6 * nodes, machine.assembly.dofs.full_len());
        for mode in at["modes"].as_array().unwrap() {
            let value = complex(&mode["eigenvalue"]);
            assert!((value.im / TAU / mode["frequency_hz"].as_f64().unwrap() - 1.0).abs() < 1e-12);
            assert!((-value.re / value.norm() - mode["damping_ratio"].as_f64().unwrap()).abs() < 1e-12);
            assert_mass_normalised(&machine, mode);
        }
        let critical = run("critical", &["--max-speed", "4000 rpm"]);
        let speeds = critical["critical_speeds"]["speeds"].as_array().unwrap();
        assert!(!speeds.is_empty());
        for speed in speeds {
            // At a critical speed of order n the frequency is n times the speed.
            let order = speed["order"].as_f64().unwrap();
            let omega = order * speed["speed_rpm"].as_f64().unwrap() * TAU / 60.0;
            assert!((complex(&speed["eigenvalue"]).im / omega - 1.0).abs() < 1e-6, "{speed}");
            assert_mass_normalised(&machine, speed);
        }
        let campbell = run("campbell", &["--max-speed", "4000 rpm"]);
        let branch = &campbell["campbell"]["branches"][0];
        let frequencies = branch["frequency_hz"].as_array().unwrap();
        assert_eq!(branch["eigenvalue"]["re"].as_array().unwrap().len(), frequencies.len());
        for (im, hz) in branch["eigenvalue"]["im"].as_array().unwrap().iter().zip(frequencies) {
            assert!((im.as_f64().unwrap() / TAU / hz.as_f64().unwrap() - 1.0).abs() < 1e-12);
        }
        for name in ["wall_seconds", "cpu_seconds"] {
            assert!(campbell[name]["campbell"].as_f64().unwrap() > 0.0, "{}", campbell[name]);
        }
        assert_eq!(campbell["seconds"], campbell["wall_seconds"]);
    }
}

/// Rotor of 2 kg on springs k = 2 · 50 kN/m without damping, released undeformed under gravity: after half a period
/// it is at rest 2 m g/k lower. Stored 2 (m g)²/k, all of it strain of the bearings, the work of gravity.
#[test]
fn stored_energy_of_a_dropped_rotor() {
    let (mass, stiffness, gravity) = (2.0_f64, 1e5_f64, 9.80665);
    let half_period = 0.5 * TAU * (mass / stiffness).sqrt();
    let text = format!(
        r#"[model]
name = "dropped"
[rotor]
centre = "0 m"
mass = "2 kg"
polar_inertia = "1e-3 kg m^2"
diametral_inertia = "1e-3 kg m^2"
[station]
A = "-0.1 m"
B = "0.1 m"
[bearing.A]
model = "linear"
station = "A"
k_xx = "5e4 N/m"
k_yy = "5e4 N/m"
k_zz = "5e4 N/m"
[bearing.B]
model = "linear"
station = "B"
k_xx = "5e4 N/m"
k_yy = "5e4 N/m"
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "constant"
speed = "0 rpm"
duration = "{half_period} s"
[probe.y]
at = "rotor"
direction = "y"
[study.run_up]
integrator = "newmark"
step = "2 us"
sample_rate = "{} Hz"
from_equilibrium = false
"#,
        100.0 / half_period
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dropped.toml");
    std::fs::write(&path, text).unwrap();
    let run = || {
        let mut run = rotordyn();
        run.arg("run-up").arg(&path).args(["--no-figures", "--out"]).arg(folder.path().join("out"));
        run
    };
    let energy = json_of(&mut run())["run_up"]["energy_j"].clone();
    let of = |key: &str| energy[key].as_f64().unwrap_or_else(|| panic!("{key}: {energy}"));
    let expected = 2.0 * (mass * gravity).powi(2) / stiffness;
    // Newmark's period error (ωh)²/24 of 1e-8.
    assert_eq!(of("stored_start"), 0.0);
    assert!((of("stored_end") / expected - 1.0).abs() < 1e-6, "{energy}, {expected}");
    assert!((of("stored_change") / of("work") - 1.0).abs() < 1e-6, "{energy}");
    assert!(
        (of("strain_end") + of("contact_end")) / expected > 1.0 - 1e-6 && of("kinetic_end") < 1e-6 * expected
    );
    let text = output_of(&mut run());
    let row = |name: &str| {
        let line = text
            .lines()
            .find(|l| l.trim_start().starts_with(name))
            .unwrap_or_else(|| panic!("{name}:\n{text}"));
        line.split_whitespace().last().unwrap().parse::<f64>().unwrap()
    };
    assert!((row("stored at the end") / expected - 1.0).abs() < 1e-5, "{text}");
    assert!((row("change of the stored energy") / expected - 1.0).abs() < 1e-5, "{text}");
}

/// The Jeffcott rotor has displacements of round-off size along x at rest.
#[test]
fn tables_have_no_negative_zero() {
    let folder = tempfile::tempdir().unwrap();
    for model in ["models/jeffcott.toml", "models/two_disc_pedestals.toml", "models/nelson_mcvaugh.toml"] {
        for command in ["static", "modal"] {
            let text =
                output_of(rotordyn().args([command, model, "--no-figures", "--out"]).arg(folder.path()));
            for word in text.split_whitespace().filter(|word| word.starts_with('-')) {
                assert!(word.parse::<f64>() != Ok(0.0), "{model} {command}: {word} in\n{text}");
            }
        }
    }
}

/// The cells of a column of a CSV file as numbers.
pub fn column(path: &std::path::Path, title: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines().map(cells);
    let at = lines.next().unwrap().iter().position(|cell| *cell == title).unwrap();
    lines.map(|cells| cells[at].parse().unwrap()).collect()
}

/// Cells of a line, in which quoted ones can have commas.
fn cells(line: &str) -> Vec<String> {
    let mut out = vec![String::new()];
    let mut quoted = false;
    for letter in line.chars() {
        match letter {
            '"' => quoted = !quoted,
            ',' if !quoted => out.push(String::new()),
            letter => out.last_mut().unwrap().push(letter),
        }
    }
    out
}

#[test]
fn csv_tables_have_the_values_of_the_document() {
    let folder = tempfile::tempdir().unwrap();
    let run = |command: &str| {
        let args = [command, "models/jeffcott.toml", "--no-figures", "--csv", "--out"];
        json_of(rotordyn().args(args).arg(folder.path()))
    };
    let numbers = |list: &serde_json::Value, key: &str| -> Vec<f64> {
        list.as_array().unwrap().iter().map(|row| row[key].as_f64().unwrap()).collect()
    };
    let csv = |name: &str| folder.path().join("csv").join(name);
    let modal = run("modal");
    let modes: Vec<f64> = modal["modal"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|at| numbers(&at["modes"], "frequency_hz"))
        .collect();
    assert!(!modes.is_empty());
    assert_eq!(column(&csv("modal_modes.csv"), "frequency_hz [Hz]"), modes);
    let speeds = &run("critical")["critical_speeds"]["speeds"];
    assert_eq!(column(&csv("critical_speeds_speeds.csv"), "speed_rpm [rpm]"), numbers(speeds, "speed_rpm"));
    let variants = ["--variants", "base,stiff_pedestals", "--no-figures", "--csv", "--modes", "4", "--out"];
    let mut command = rotordyn();
    let found = json_of(
        command.args(["compare", "models/two_disc_pedestals.toml"]).args(variants).arg(folder.path()),
    );
    let rows = found["speeds"].as_array().unwrap().iter().flat_map(|at| at["modes"].as_array().unwrap());
    let frequencies = rows.flat_map(|row| row["frequency_hz"].as_array().unwrap());
    let frequencies: Vec<f64> = frequencies.map(|frequency| frequency.as_f64().unwrap()).collect();
    assert!(frequencies.len() >= 8 && frequencies.len().is_multiple_of(2));
    assert_eq!(column(&csv("comparison_speeds_modes_over_variants.csv"), "frequency_hz [Hz]"), frequencies);
}
