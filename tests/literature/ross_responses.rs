//! Unbalance responses and frequency response functions of ROSS 3.1.0's models.

use crate::agree;
use crate::ross::{self, number, numbers, read};
use rotordyn::analysis::frf;
use rotordyn::analysis::unbalance::{self, Orbit};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::element::Anchor;
use rotordyn::linalg::{Complex64, SparseRow};
use rotordyn::model::Quantity;
use serde_json::Value;
use std::f64::consts::TAU;

const CASES: [&str; 8] = [
    "friswell_5_9_1",
    "jeffcott",
    "nelson_mcvaugh_isotropic_rayleigh",
    "nelson_mcvaugh_isotropic_timoshenko",
    "nelson_mcvaugh_orthotropic_damped",
    "overhung_disc_300x20",
    "speed_table_proportional_damping",
    "uniform_pinned",
];

fn complex(value: &Value, name: &str) -> Vec<Complex64> {
    let part = |p: &str| numbers(&value[if name.is_empty() { p.into() } else { format!("{name}_{p}") }]);
    part("re").into_iter().zip(part("im")).map(|(re, im)| Complex64::new(re, im)).collect()
}

/// Largest deviation relative to the response itself, or to a millionth of its largest value (where the
/// response vanishes between resonances or by symmetry, both programs give round-off).
fn deviation(ours: &[Complex64], theirs: &[Complex64]) -> f64 {
    assert_eq!(ours.len(), theirs.len());
    let floor = 1e-6 * theirs.iter().fold(0.0, |m: f64, v| m.max(v.norm()));
    let worst = |m: f64, (a, b): (&Complex64, &Complex64)| m.max((a - b).norm() / b.norm().max(floor));
    if floor == 0.0 { 0.0 } else { ours.iter().zip(theirs).fold(0.0, worst) }
}

fn norms(values: &[Complex64]) -> Vec<f64> {
    values.iter().map(|value| value.norm()).collect()
}

#[test]
fn unbalance_responses_agree() {
    for name in CASES {
        let case = read(&format!("ross/{name}.json"));
        let model = ross::model(&case);
        let assembly = Assembly::new(&model).unwrap();
        let reference = &case["results"]["unbalance"];
        let tangents = |speed: f64| Ok(ross::tangents(&model, speed));
        let speeds = numbers(&reference["speeds"]);
        let motions = unbalance::response(&assembly, &speeds, &tangents, |motion| motion).unwrap();
        let along = |row: &SparseRow| -> Vec<Complex64> {
            motions.iter().map(|motion| motion.amplitude_of(row, Quantity::Displacement)).collect()
        };
        for (k, probe) in reference["probes"].as_array().unwrap().iter().enumerate() {
            let rows = assembly.anchor_rows(&Anchor::node(probe["node"].as_u64().unwrap() as usize));
            let (x, y) = (complex(probe, "x"), complex(probe, "y"));
            for (row, theirs) in [(&rows[0], &x), (&rows[1], &y)] {
                let worst = deviation(&along(row), theirs);
                println!("{name} node {}: {worst:.1e}", probe["node"]);
                agree::curve(
                    format_args!("{name} node {}: response over speed", probe["node"]),
                    worst,
                    1.0,
                    1e-6,
                );
            }
            if k == 0 {
                let over = agree::Over { name: "shaft speed", unit: "rad/s", values: &speeds };
                let what = format_args!("{name} node {}: amplitude in y", probe["node"]);
                agree::curves(what, "m", over, &norms(&along(&rows[1])), &norms(&y), 1e-6);
            }
            let orbits: Vec<Orbit> =
                along(&rows[0]).into_iter().zip(along(&rows[1])).map(|(x, y)| Orbit::new(x, y)).collect();
            for (orbit, major) in orbits.iter().zip(numbers(&probe["major"])) {
                agree::relative(format_args!("{name}: major semi-axis [m]"), orbit.major, major, 1e-6);
            }
        }
    }
}

#[test]
fn frequency_responses_agree() {
    for name in CASES {
        let case = read(&format!("ross/{name}.json"));
        let model = ross::model(&case);
        let assembly = Assembly::new(&model).unwrap();
        for reference in case["results"]["frf"].as_array().unwrap() {
            let speed = number(&reference["speed"]);
            let system = LinearSystem::new(&assembly, &ross::tangents(&model, speed), speed).unwrap();
            let hz: Vec<f64> = numbers(&reference["omega"]).iter().map(|w| w / TAU).collect();
            for (k, pair) in reference["pairs"].as_array().unwrap().iter().enumerate() {
                let row = |end: &str| -> SparseRow {
                    let node = Anchor::node(pair[end][0].as_u64().unwrap() as usize);
                    let axis = pair[end][1].as_str().unwrap();
                    let dof = ["x", "y", "z", "alpha", "beta", "theta"].iter().position(|n| *n == axis);
                    assembly.anchor_rows(&node)[dof.unwrap()].clone()
                };
                let (inputs, outputs) = ([row("input")], [row("output")]);
                let h = frf::frf(&assembly, &system, &hz, &inputs, &outputs, Quantity::Displacement).unwrap();
                let worst = deviation(&h.values[0][0], &complex(pair, ""));
                println!("{name} at {speed:.0} rad/s {} -> {}: {worst:.1e}", pair["input"], pair["output"]);
                let what =
                    format_args!("{name} at {speed:.0} rad/s: FRF {} to {}", pair["input"], pair["output"]);
                agree::curve(what, worst, 1.0, 1e-6);
                if k == 0 && speed > 0.0 {
                    let over = agree::Over { name: "frequency", unit: "Hz", values: &hz };
                    let what = format_args!("magnitude of the FRF of {name} at {speed:.0} rad/s");
                    agree::curves(
                        what,
                        "m/N",
                        over,
                        &norms(&h.values[0][0]),
                        &norms(&complex(pair, "")),
                        1e-6,
                    );
                }
            }
        }
    }
}
