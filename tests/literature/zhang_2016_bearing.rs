//! Zhang 2016, section 5: a deep-groove bearing on fitted contact laws: displacements, full stiffness,
//! percentages.
//!
//! Axes: the paper's x, y are radial and its z axial, as ours; M_x = Σ r Q sin α sin ψ, M_y = −Σ r Q sin α
//! cos ψ, as ours. Geometry: A₀ = 1.36 mm, moment arm 33.18 mm, radial clearance 6 µm taken once from the
//! radial distance of the groove centres (P_d = 12 µm), eight balls, the first on the x axis.

use crate::agree;
use crate::bearing::rig_6205;
use rotordyn::analysis::bearing_stiffness::{BearingEquilibrium, BearingSolver, Condition};
use rotordyn::analysis::equilibrium::CageTreatment;
use rotordyn::bearing::{BallBearing, BallGeometry};
use rotordyn::contact::{ContactLaw, PowerLaw};
use serde_json::Value;

const ROWS: [&str; 4] = ["dry10", "dry30", "ehl10", "ehl30"];

fn file() -> Value {
    serde_json::from_str(include_str!("../data/zhang_2016.json")).unwrap()
}

/// Section 5 by an independent prototype on the printed rows.
fn reference() -> Value {
    file()["bearing_section5_table2"].clone()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// The bearing on a printed row of Table 2.
fn solver(row: &str) -> BearingSolver {
    let law = numbers(&file()["table2"][row]);
    let bearing = BallBearing {
        geometry: BallGeometry {
            balls: 8,
            ball_diameter: 17e-3,
            pitch_diameter: 65e-3,
            inner_groove_radius: 9.18e-3,
            outer_groove_radius: 9.18e-3,
            radial_clearance: 12e-6,
            moment_arm: Some(33.18e-3),
            ..rig_6205().geometry
        },
        contact: ContactLaw::PowerLaw(PowerLaw {
            stiffness: law[0],
            exponent: law[1],
            offset: law[2],
            range: [600.0, 2000.0],
        }),
        ..rig_6205()
    };
    BearingSolver::new(row, &bearing)
}

fn loaded(row: &str, load: [f64; 5], cage_angle: f64) -> (BearingSolver, BearingEquilibrium) {
    let solver = solver(row);
    let condition =
        Condition { load, prescribed: [None; 5], speed: 0.0, cage: CageTreatment::FixedAngle, cage_angle };
    let found = solver.solve(&condition, None).unwrap();
    (solver, found)
}

/// Compares entries with the reference, relative to the size of their row and column.
#[track_caller]
fn same_matrix(found: &[[f64; 5]; 5], expected: &Value, tolerance: f64, what: &str) {
    let expected: Vec<Vec<f64>> = expected.as_array().unwrap().iter().map(numbers).collect();
    for a in 0..5 {
        for b in 0..5 {
            let size = (expected[a][a] * expected[b][b]).sqrt();
            let off = found[a][b] - expected[a][b];
            agree::curve(format_args!("{what} N: K[{a}][{b}] over its size"), off, size, tolerance);
        }
    }
}

#[test]
fn radial_load_of_section_5_1() {
    let file = reference();
    for row in ROWS {
        for (force, case) in file["sec51"][row].as_object().unwrap() {
            let (solver, found) = loaded(row, [force.parse().unwrap(), 0.0, 0.0, 0.0, 0.0], 0.0);
            let expected = case["delta_bx"].as_f64().unwrap();
            agree::relative(
                format_args!("{row} {force} N: displacement [m]"),
                found.displacement[0],
                expected,
                1e-9,
            );
            for d in &found.displacement[1..] {
                agree::absolute(
                    format_args!("{row} {force} N: displacement across the load"),
                    *d,
                    0.0,
                    1e-15,
                );
            }
            same_matrix(&found.stiffness, &case["K"], 1e-9, &format!("{row} {force}"));
            for (ball, load) in solver.ball_loads(&found).iter().zip(numbers(&case["Q"])) {
                agree::absolute(format_args!("{row} {force} N: ball load [N]"), ball.load, load, 1e-6);
            }
        }
    }
}

#[test]
fn combined_load_of_section_5_2() {
    let file = reference();
    for row in ROWS {
        for moment in [4.0, -4.0] {
            let case = &file["sec52"][format!("{row}|My={}4", if moment > 0.0 { "+" } else { "-" })];
            let (solver, found) = loaded(row, [2000.0, 0.0, 1500.0, 0.0, moment], 0.0);
            for (d, expected) in found.displacement.iter().zip(numbers(&case["q"])) {
                agree::absolute(
                    format_args!("{row} {moment} N m: displacement"),
                    *d,
                    expected,
                    1e-9 * expected.abs() + 1e-15,
                );
            }
            same_matrix(&found.stiffness, &case["K"], 1e-9, &format!("{row} {moment}"));
            for (ball, angle) in solver.ball_loads(&found).iter().zip(numbers(&case["alpha_deg"])) {
                agree::absolute("contact angle [deg]", ball.contact_angle.to_degrees(), angle, 1e-7);
            }
        }
    }
}

/// One ball pitch of cage angles: displacements and the paper's nine stiffnesses.
#[test]
fn orbital_scan_of_section_5_2() {
    let scan = &reference()["sec52_orbital_scan"];
    const ENTRIES: [[usize; 2]; 9] = [[0, 0], [1, 1], [2, 2], [3, 3], [4, 4], [0, 2], [0, 4], [1, 3], [2, 4]];
    for row in ROWS {
        let [mut pitch, mut ours, mut theirs] = [const { Vec::new() }; 3];
        for line in scan["rows"][row].as_array().unwrap() {
            let line = numbers(line);
            let (_, found) =
                loaded(row, [2000.0, 0.0, 1500.0, 0.0, 4.0], line[0] * std::f64::consts::TAU / 8.0);
            for (d, expected) in found.displacement.iter().zip(&line[1..6]) {
                // dy and βx pass through zero
                agree::absolute(
                    format_args!("{row} {}: displacement", line[0]),
                    *d,
                    *expected,
                    1e-9 * expected.abs() + 1e-14,
                );
            }
            for ([a, b], expected) in ENTRIES.into_iter().zip(&line[6..]) {
                let k = &found.stiffness;
                let size = (k[a][a] * k[b][b]).sqrt();
                agree::absolute(
                    format_args!("{row} {}: K[{a}][{b}]", line[0]),
                    k[a][b],
                    *expected,
                    1e-9 * size,
                );
            }
            pitch.push(line[0]);
            ours.push(found.stiffness[0][0]);
            theirs.push(line[6]);
        }
        let over = agree::Over { name: "cage angle", unit: "ball pitches", values: &pitch };
        agree::curves(
            format_args!("{row}: radial stiffness over the cage angle"),
            "N/m",
            over,
            &ours,
            &theirs,
            1e-9,
        );
    }
}

/// The paper's text: reduction of displacement relative to dry 5.0 and 9.6 % at 2000 N, 3.3 and 6.7 %
/// at 4000 N, radial stiffness within 1 %.
#[test]
fn percentages_of_section_5_1() {
    for (force, speed, paper) in
        [(2000.0, "10", 5.0), (2000.0, "30", 9.6), (4000.0, "10", 3.3), (4000.0, "30", 6.7)]
    {
        let radial = [force, 0.0, 0.0, 0.0, 0.0];
        let (_, dry) = loaded(&format!("dry{speed}"), radial, 0.0);
        let (_, ehl) = loaded(&format!("ehl{speed}"), radial, 0.0);
        let less = 100.0 * (1.0 - ehl.displacement[0] / dry.displacement[0]);
        agree::absolute(
            format_args!("{force} N, {speed} m/s: less displacement by the film [%]"),
            less,
            paper,
            0.15,
        );
        for k in 0..2 {
            let what = format_args!("{force} N, {speed} m/s: stiffness {k} without the film [N/m]");
            agree::relative(what, dry.stiffness[k][k], ehl.stiffness[k][k], 0.01);
        }
    }
}
