//! Wardle 1988: orders of race waviness that excite vibration of a thrust-loaded ball bearing, and their
//! frequencies.
//!
//! Under axial load all Z balls are equally loaded, and ball j on a wave cos(n φ) displaces the ring along
//! its line of contact. The sum over equally spaced balls is non-zero for k = 1, 2, ... (orders 0 and 1 are
//! excluded):
//!
//! | race | order | motion | frequency |
//! |---|---|---|---|
//! | inner | kZ + 1 | radial, forward whirl | kZ(Ω − Ω_c) + Ω |
//! | inner | kZ − 1 | radial, backward whirl | kZ(Ω − Ω_c) − Ω |
//! | inner | kZ | axial | kZ(Ω − Ω_c) |
//! | outer | kZ + 1 | radial, backward whirl | kZ Ω_c |
//! | outer | kZ − 1 | radial, forward whirl | kZ Ω_c |
//! | outer | kZ | axial | kZ Ω_c |
//!
//! and the other orders cancel. Amplitudes of the ring, constrained against tilt: a cos α/(cos² α + ε sin² α)
//! radially, a sin α/(sin² α + ε cos² α) axially, with ε = (Q/|s|)/(dQ/dδ) = (2/3) δ/|s| the share of the
//! load that rotates with the line of contact; a/cos α and a/sin α when δ is small.

use crate::agree;
use crate::bearing::rig_6205;
use rotordyn::bearing::{BallElement, BallLoad, Cage, Rotation, Wave};
use std::f64::consts::TAU;

/// Revolutions of shaft and cage in a record; their ratio makes the record periodic.
const TURNS: i32 = 5;
const CAGE_TURNS: i32 = 2;
const SAMPLES: usize = 1024;
/// Amplitude of the waves \[m\], a thousandth of the contacts' approach.
const AMPLITUDE: f64 = 5e-9;

/// Position x, y, z of the ring of a slowly rotating bearing under axial load at every sample, and the
/// expected amplitudes of a radial and of an axial line over that of the wave.
fn motion(inner: bool, order: u32) -> (Vec<[f64; 3]>, [f64; 2]) {
    let mut bearing = rig_6205();
    bearing.geometry.contact_angle = 0.4;
    bearing.geometry.radial_clearance = 0.0;
    bearing.cage = Cage::Ratio(f64::from(CAGE_TURNS) / f64::from(TURNS));
    let wave = Wave { order, amplitude: AMPLITUDE, phase: 0.7 };
    if inner {
        bearing.imperfections.inner_waviness.push(wave);
    } else {
        bearing.imperfections.outer_waviness.push(wave);
    }
    let element = BallElement::new(&bearing);
    let load = [0.0, 0.0, 300.0];
    let mut d = [0.0, 0.0, 5e-6, 0.0, 0.0, 0.0];
    let at = |k: usize| {
        let turns = k as f64 / SAMPLES as f64;
        Rotation {
            shaft_angle: TAU * f64::from(TURNS) * turns,
            cage_angle: TAU * f64::from(CAGE_TURNS) * turns,
            ..Rotation::default()
        }
    };
    let mut place = Vec::new();
    for k in 0..SAMPLES {
        for _ in 0..30 {
            let here = element.reaction(&d, &[0.0; 6], &at(k));
            let left: [f64; 3] = std::array::from_fn(|a| here.force[a] + load[a]);
            let matrix = nalgebra::Matrix3::from_fn(|a, b| here.stiffness[a][b]);
            let step = matrix.lu().solve(&nalgebra::Vector3::from(left)).unwrap();
            (0..3).for_each(|a| d[a] += step[a]);
            if step.norm() < 1e-16 {
                break;
            }
        }
        place.push([d[0], d[1], d[2]]);
    }
    let loads = element.ball_loads(&d, &at(0));
    let mean = |of: fn(&BallLoad) -> f64| loads.iter().map(of).sum::<f64>() / loads.len() as f64;
    let (angle, approach) = (mean(|b| b.contact_angle), mean(|b| b.deflection));
    let g = &bearing.geometry;
    let distance = g.inner_groove_radius + g.outer_groove_radius - g.ball_diameter + approach;
    let (sin, cos) = angle.sin_cos();
    let turned = 2.0 / 3.0 * approach / distance;
    (place, [cos / (cos * cos + turned * sin * sin), sin / (sin * sin + turned * cos * cos)])
}

/// Spectral lines of x + i y above a fraction of the wave's amplitude, as (frequency in shaft turns,
/// amplitude over the wave's); positive frequencies whirl forward.
fn lines(values: &[[f64; 2]], floor: f64) -> Vec<(f64, f64)> {
    let n = values.len() as f64;
    let mean = [0, 1].map(|a| values.iter().map(|v| v[a]).sum::<f64>() / n);
    let mut out = Vec::new();
    for bin in -220..=220_i32 {
        let (mut re, mut im) = (0.0, 0.0);
        for (k, [x, y]) in values.iter().enumerate() {
            let (s, c) = (TAU * f64::from(bin) * k as f64 / n).sin_cos();
            let (x, y) = (x - mean[0], y - mean[1]);
            re += x * c + y * s;
            im += y * c - x * s;
        }
        let amplitude = re.hypot(im) / n / AMPLITUDE;
        if amplitude > floor {
            out.push((f64::from(bin) / f64::from(TURNS), amplitude));
        }
    }
    out
}

#[test]
fn waviness_orders_that_excite_radial_and_axial_vibration() {
    let balls = 9;
    let ratio = f64::from(CAGE_TURNS) / f64::from(TURNS);
    let (mut radial, mut axial) = (0, 0);
    for inner in [true, false] {
        for order in 2..=20_u32 {
            let (motion, amplitudes) = motion(inner, order);
            // Second-order lines, (3/4 to 1/8) a/δ for waves of a thousandth of the approach, are below 2e-3.
            let whirl = lines(&motion.iter().map(|m| [m[0], m[1]]).collect::<Vec<_>>(), 2e-3);
            let thrust = lines(&motion.iter().map(|m| [m[2], 0.0]).collect::<Vec<_>>(), 2e-3);
            let (near, off) =
                ((order + 1) / balls * balls, i64::from(order) - i64::from((order + 1) / balls * balls));
            let passing = f64::from(near) * if inner { 1.0 - ratio } else { ratio };
            let name = if inner { "inner" } else { "outer" };
            let line = match (near > 0, off) {
                (true, 1) => Some(if inner { passing + 1.0 } else { -passing }),
                (true, -1) => Some(if inner { -(passing - 1.0) } else { passing }),
                _ => None,
            };
            match (line, &whirl[..]) {
                (Some(expected), [(frequency, amplitude)]) => {
                    agree::absolute(
                        format_args!("{name} waviness {order}: frequency"),
                        *frequency,
                        expected,
                        1e-9,
                    );
                    // Waves of a thousandth of the approach.
                    agree::relative(
                        format_args!("{name} waviness {order}: amplitude"),
                        *amplitude,
                        amplitudes[0],
                        1e-3,
                    );
                    radial += 1;
                }
                (None, []) => {}
                _ => panic!("{name} {order}: radial lines {whirl:?}"),
            }
            match (near > 0 && off == 0, &thrust[..]) {
                // A real signal has its line at both signs of frequency, half the amplitude each.
                (true, [(low, _), (frequency, amplitude)]) => {
                    agree::absolute(
                        format_args!("{name} waviness {order}: frequency of the thrust"),
                        *frequency,
                        passing,
                        1e-9,
                    );
                    assert!(*low == -frequency, "{name} {order}: {thrust:?}");
                    agree::relative(
                        format_args!("{name} waviness {order}: thrust amplitude"),
                        2.0 * amplitude,
                        amplitudes[1],
                        1e-3,
                    );
                    axial += 1;
                }
                (false, []) => {}
                _ => panic!("{name} {order}: axial lines {thrust:?}"),
            }
        }
    }
    // Of both races: 8, 10, 17, 19 and 9, 18.
    assert_eq!((radial, axial), (8, 4));
}
