//! Zhang, Xie, Lv & Sun 2016: displacements and 5x5 stiffness of a deep-groove bearing under the paper's
//! fitted laws.
//!
//! The paper's (x, y) is radial and z axial, moments M_x = +r sin ψ F_z and M_y = −r cos ψ F_z: these axes.
//! Reference figures in tests/data/zhang_2016.json come from an independent program for eq. 12-14.

use crate::agree;
use crate::ross::{number, numbers, read};
use rotordyn::bearing::{
    BallBearing, BallElement, BallGeometry, BallInertia, Cage, Fit, Preload, Reaction, Rotation,
};
use rotordyn::contact::{ContactDamping, ContactLaw, PowerLaw};
use rotordyn::element::Material;

const A0: f64 = 1.36e-3;
const ARM: f64 = 33.18e-3;
const CLEARANCE: f64 = 6e-6;
const BALLS: usize = 8;

/// Table 2: K, n, ΔQ.
const TABLE: [(&str, [f64; 3]); 4] = [
    ("dry10", [1.078e10, 1.5, -19.214]),
    ("dry30", [1.180e10, 1.51, -155.465]),
    ("ehl10", [8.562e9, 1.475, 30.207]),
    ("ehl30", [7.281e9, 1.457, -57.05]),
];

fn bearing([stiffness, exponent, offset]: [f64; 3]) -> BallElement {
    let steel =
        Material { name: "steel".into(), young: 207e9, shear: 207e9 / 2.6, poisson: 0.3, density: 7850.0 };
    BallElement::new(&BallBearing {
        geometry: BallGeometry {
            balls: BALLS,
            ball_diameter: 17e-3,
            pitch_diameter: 65e-3,
            inner_groove_radius: 9.18e-3,
            outer_groove_radius: 9.18e-3,
            // r_L is taken off the radius once.
            radial_clearance: 2.0 * CLEARANCE,
            contact_angle: 0.0,
            thrust_direction: 1.0,
            moment_arm: Some(ARM),
            bore: 40e-3,
            outside_diameter: 90e-3,
            width: 23e-3,
        },
        ball_material: steel.clone(),
        ring_material: steel,
        contact: ContactLaw::PowerLaw(PowerLaw { stiffness, exponent, offset, range: [600.0, 2000.0] }),
        contact_stiffness: Default::default(),
        damping: ContactDamping::Constant { coefficient: 0.0, ramp: 1e-6 },
        inertia: BallInertia::None,
        preload: Preload::None,
        duplex: None,
        fit: Fit::default(),
        cage: Cage::Rolling,
        cage_angle: 0.0,
        imperfections: Default::default(),
        cage_pocket_diameter: 17.2e-3,
        service: Default::default(),
        estimated_geometry: None,
    })
}

/// Displacement under a load on the inner ring, ball 0 at an angle, by Newton from a displacement near it.
fn solve_equilibrium(
    element: &BallElement,
    load: [f64; 5],
    angle: f64,
    start: [f64; 6],
) -> ([f64; 6], Reaction) {
    let rotation = Rotation { cage_angle: angle, ..Rotation::default() };
    let mut d = start;
    for _ in 0..50 {
        let r = element.reaction(&d, &[0.0; 6], &rotation);
        let k = nalgebra::SMatrix::<f64, 5, 5>::from_fn(|a, b| r.stiffness[a][b]);
        let residual = nalgebra::SVector::<f64, 5>::from_fn(|a, _| load[a] + r.force[a]);
        let step = k.lu().solve(&residual).expect("loaded");
        (0..5).for_each(|a| d[a] += step[a]);
    }
    (d, element.reaction(&d, &[0.0; 6], &rotation))
}

/// The Appendix, with A_j, δ*_r, δ*_z of eq. 13 and sums over loaded balls.
fn appendix([k, n, dq]: [f64; 3], d: &[f64; 6]) -> [[f64; 5]; 5] {
    let mut out = [[0.0; 5]; 5];
    for j in 0..BALLS {
        let psi = std::f64::consts::TAU * j as f64 / BALLS as f64;
        let (s, c) = psi.sin_cos();
        let r_star = A0 + d[0] * c + d[1] * s - CLEARANCE;
        let z_star = d[2] + ARM * (d[3] * s - d[4] * c);
        let a = r_star.hypot(z_star);
        if a <= A0 || k * (a - A0).powf(n) + dq <= 0.0 {
            continue;
        }
        let load = k * (a - A0).powf(n);
        let ratio = n * a / (a - A0);
        let along = |x: f64| (load * (ratio * x * x + a * a - x * x) + dq * (a * a - x * x)) / a.powi(3);
        let radial = along(r_star);
        let axial = along(z_star);
        let cross = (load * (ratio - 1.0) - dq) * r_star * z_star / a.powi(3);
        let upper = [
            (0, 0, radial * c * c),
            (0, 1, radial * s * c),
            (0, 2, cross * c),
            (0, 3, cross * ARM * s * c),
            (0, 4, -cross * ARM * c * c),
            (1, 1, radial * s * s),
            (1, 2, cross * s),
            (1, 3, cross * ARM * s * s),
            (1, 4, -cross * ARM * s * c),
            (2, 2, axial),
            (2, 3, axial * ARM * s),
            (2, 4, -axial * ARM * c),
            (3, 3, axial * ARM * ARM * s * s),
            (3, 4, -axial * ARM * ARM * s * c),
            (4, 4, axial * ARM * ARM * c * c),
        ];
        for (a, b, v) in upper {
            out[a][b] += v;
            if a != b {
                out[b][a] += v;
            }
        }
    }
    out
}

/// Scale of a matrix entry: √(K_aa K_bb).
fn size(k: &[[f64; 6]; 6], a: usize, b: usize) -> f64 {
    (k[a][a] * k[b][b]).sqrt()
}

#[test]
fn appendix_equals_the_tangent() {
    for (name, law) in TABLE {
        let element = bearing(law);
        for d in [
            [28e-6, 3e-6, 250e-6, 0.5e-3, 3.9e-3, 0.0],
            [23e-6, -2e-6, 268e-6, -0.2e-3, 2.5e-3, 0.0],
            [38e-6, 0.0, 0.0, 0.0, 0.0, 0.0],
        ] {
            // Our law has a smoothed onset; the Appendix, which is discontinuous there, is valid above 155 N.
            let balls = element.ball_loads(&d, &Rotation::default());
            assert!(balls.iter().all(|b| b.load == 0.0 || b.load > 160.0), "{name} {balls:?}");
            let k = element.reaction(&d, &[0.0; 6], &Rotation::default()).stiffness;
            let expected = appendix(law, &d);
            for a in 0..5 {
                for b in 0..5 {
                    let off = k[a][b] - expected[a][b];
                    agree::curve(
                        format_args!("{name} K[{a}][{b}]: deviation over size"),
                        off.abs(),
                        size(&k, a, b),
                        1e-12,
                    );
                }
            }
        }
    }
}

#[test]
fn printed_rows_of_section_5() {
    let data = &read("zhang_2016.json")["bearing_section5_table2"];
    let mut rows = 0;
    for (name, law) in TABLE {
        let element = bearing(law);
        for (moment, sign) in [(4.0, "+"), (-4.0, "-")] {
            let reference = &data["sec52"][format!("{name}|My={sign}4")];
            let q = numbers(&reference["q"]);
            let start = [q[0] * 1.02, 0.0, q[2] * 0.99, 0.0, q[4] * 1.01, 0.0];
            let (d, r) = solve_equilibrium(&element, [2000.0, 0.0, 1500.0, 0.0, moment], 0.0, start);
            for a in 0..5 {
                let scale = [q[0], q[0], q[2], q[4], q[4]][a];
                agree::absolute(format_args!("{name} {sign}: displacement {a}"), d[a], q[a], 1e-9 * scale);
                for (b, k) in numbers(&reference["K"][a]).into_iter().enumerate() {
                    let off = r.stiffness[a][b] - k;
                    agree::curve(
                        format_args!("{name} {sign} K[{a}][{b}]: deviation over size"),
                        off.abs(),
                        size(&r.stiffness, a, b),
                        1e-9,
                    );
                }
            }
            rows += 1;
        }
        for load in ["2000", "3000", "4000"] {
            let reference = &data["sec51"][name][load];
            let delta = number(&reference["delta_bx"]);
            let start = [delta * 1.001, 0.0, 0.0, 0.0, 0.0, 0.0];
            let force = load.parse().unwrap();
            let (d, r) = solve_equilibrium(&element, [force, 0.0, 0.0, 0.0, 0.0], 0.0, start);
            agree::relative(format_args!("{name} {load} N: displacement [m]"), d[0], delta, 1e-9);
            for a in 0..2 {
                let k = number(&reference["K"][a][a]);
                agree::relative(format_args!("{name} {load} N: K[{a}][{a}]"), r.stiffness[a][a], k, 1e-9);
            }
            rows += 1;
        }
    }
    assert_eq!(rows, 20);
}

#[test]
fn percentages_of_section_5_1() {
    // Dry minus lubricated displacement in percent of the dry one, compared with the paper's percentages.
    let displacement = |k: usize, force: f64, start: f64| {
        solve_equilibrium(
            &bearing(TABLE[k].1),
            [force, 0.0, 0.0, 0.0, 0.0],
            0.0,
            [start, 0.0, 0.0, 0.0, 0.0, 0.0],
        )
        .0[0]
    };
    for (force, start, percent) in [(2000.0, 30e-6, [5.0, 9.6]), (4000.0, 42e-6, [3.3, 6.7])] {
        for (speed, percent) in percent.into_iter().enumerate() {
            let (dry, wet) = (displacement(speed, force, start), displacement(speed + 2, force, start));
            let found = 100.0 * (dry - wet) / dry;
            agree::absolute(
                format_args!("{force} N: less displacement by the film, speed {speed} [%]"),
                found,
                percent,
                0.15,
            );
        }
    }
}

#[test]
fn stiffness_over_the_cage_angle() {
    let data = &read("zhang_2016.json")["bearing_section5_table2"]["sec52_orbital_scan"];
    for (name, law) in TABLE {
        let element = bearing(law);
        let rows = data["rows"][name].as_array().expect("rows");
        assert_eq!(rows.len(), 11);
        for row in rows {
            let row = numbers(row);
            let start = [row[1] * 1.01, row[2], row[3] * 0.99, row[4], row[5] * 1.01, 0.0];
            let angle = row[0] * std::f64::consts::TAU / BALLS as f64;
            let (_, r) = solve_equilibrium(&element, [2000.0, 0.0, 1500.0, 0.0, 4.0], angle, start);
            let k = &r.stiffness;
            let found = [k[0][0], k[1][1], k[2][2], k[3][3], k[4][4], k[0][2], k[0][4], k[1][3], k[2][4]];
            for (found, expected) in found.into_iter().zip(&row[6..]) {
                agree::relative(format_args!("{name} at {}", row[0]), found, *expected, 1e-8);
            }
        }
    }
}
