//! Atef et al. 2022: angles, depths, delays and residence times of balls passing dents, by the ids of
//! tests/data/atef_2022.json (an independent program of the same equations).
//!
//! Axes: x and y are the paper's; angles from +x, where the load points and a defect starts.

use crate::agree;
use crate::bearing::rig_6205;
use crate::ross::{number, numbers, read};
use rotordyn::bearing::{BallBearing, Defect, DefectForm, Profile, Rotation, Shape, Surface};
use std::f64::consts::TAU;

const WIDTH: f64 = 0.17e-3;

fn row(id: &str) -> serde_json::Value {
    let rows = &read("atef_2022.json");
    rows["tight"]
        .as_array()
        .unwrap()
        .iter()
        .find(|row| row["id"] == id)
        .unwrap_or_else(|| panic!("{id}"))
        .clone()
}

fn dent(on: Surface, degrees: f64, width: f64) -> Defect {
    let form = DefectForm::Dent { depth: None, shape: Shape::HalfSine };
    Defect { surface: on, row: None, start: degrees.to_radians(), width, form }
}

/// The paper's bearing with dents of 0.17 mm at these angles \[deg\].
fn bearing(on: Surface, angles: &[f64]) -> BallBearing {
    let mut bearing = rig_6205();
    let parameters = &read("atef_2022.json")["params_REF_A"];
    bearing.geometry.pitch_diameter = number(&parameters["Dp"]);
    bearing.geometry.ball_diameter = number(&parameters["db"]);
    bearing.imperfections.defects = angles.iter().map(|at| dent(on, *at, WIDTH)).collect();
    bearing
}

/// Times at which any ball enters a dent, and those at which it leaves \[s\], to 1e-12 s.
fn passages(bearing: &BallBearing, duration: f64) -> [Vec<f64>; 2] {
    let profile = Profile::new(&bearing.geometry, &bearing.imperfections, 0, 0.0, 0.0).unwrap();
    let speed = TAU * 1797.0 / 60.0;
    let ratio = bearing.geometry.characteristic_orders(0.0).ftf;
    let deep = |ball: usize, t: f64| {
        // Ball 0 starts a little before the first dent.
        let cage_angle = ratio * speed * t - 0.01;
        let rotation = Rotation { shaft_angle: speed * t, cage_angle, ..Rotation::default() };
        profile.at_rotation(&rotation).ball(ball).total() < 0.0
    };
    let mut out = [Vec::new(), Vec::new()];
    let step = 2e-6;
    for ball in 0..bearing.geometry.balls {
        for k in 0..(duration / step) as u32 {
            let (mut before, mut after) = (f64::from(k) * step, f64::from(k + 1) * step);
            let was = deep(ball, before);
            if was == deep(ball, after) {
                continue;
            }
            while after - before > 1e-12 {
                let middle = 0.5 * (before + after);
                if deep(ball, middle) == was {
                    before = middle;
                } else {
                    after = middle;
                }
            }
            out[usize::from(was)].push(after);
        }
    }
    out.iter_mut().for_each(|times| times.sort_by(f64::total_cmp));
    out
}

/// A03: 1 to 2 and 2 to 3 of two dents 15 deg apart on the outer race. A04: on the inner race the later of
/// the pair is passed first, so that the long delay comes before the short one.
#[test]
fn delays_between_impulses() {
    for (on, id, inner) in [(Surface::Outer, "A03", false), (Surface::Inner, "A04", true)] {
        let [entries, _] = passages(&bearing(on, &[0.0, 15.0]), 0.05);
        let mut delays: Vec<f64> = entries.windows(2).take(4).map(|w| (w[1] - w[0]) * 1e3).collect();
        // Which of the two a record begins with depends on where the balls start.
        if delays[0] > delays[1] {
            delays.remove(0);
        }
        let reference = row(id);
        for (delay, expected) in delays.iter().zip(numbers(&reference["value"])) {
            let off = (delay - expected).abs();
            // Stated to five digits; the printed tolerance is two of the paper's steps.
            agree::curve(format_args!("delay between impulses, {id} [ms]"), off, expected, 1e-5);
            let printed = number(&reference["abs_tol"]);
            agree::absolute(
                format_args!("delay between impulses, {id}, printed [ms]"),
                *delay,
                expected,
                printed,
            );
        }
        let impulses = if inner { 162.186 } else { 107.364 } * 2.0 * 0.05;
        agree::absolute(format_args!("{id}: impulses in 0.05 s"), entries.len() as f64, impulses, 1.0);
    }
}

/// A05: residence time of 96.55 us over the dent, the same on both races.
#[test]
fn residence_time() {
    let expected = number(&row("A05")["value"]) * 1e-6;
    for on in [Surface::Outer, Surface::Inner] {
        let [entries, exits] = passages(&bearing(on, &[5.0]), 0.03);
        assert!(exits.len() >= 3);
        for (entry, exit) in entries.iter().zip(&exits) {
            let time = exit - entry;
            agree::relative(format_args!("residence time, {on:?} race [s]"), time, expected, 1e-4);
        }
    }
}

/// A06 and A07: the dent's angle on the outer race, and the depth of balls in openings of three widths.
#[test]
fn dent_angle_and_ball_depth() {
    let bearing = bearing(Surface::Outer, &[0.0]);
    let g = &bearing.geometry;
    let angle = bearing.imperfections.defects[0].angle(g).to_degrees();
    agree::relative("angle of a dent [deg]", angle, number(&row("A06")["value"]), 1e-5);
    for (width, expected) in [0.17e-3, 0.34e-3, 2.5e-3].into_iter().zip(numbers(&row("A07")["value"])) {
        let mut wide = bearing.clone();
        wide.imperfections.defects = vec![dent(Surface::Outer, 0.0, width)];
        let middle = 0.5 * wide.imperfections.defects[0].angle(g);
        let profile = Profile::new(g, &wide.imperfections, 0, 0.0, 0.0).unwrap();
        let depth =
            -profile.at_rotation(&Rotation { cage_angle: middle, ..Rotation::default() }).ball(0).total();
        agree::relative(
            format_args!("depth of a ball in an opening of {width} m [um]"),
            depth * 1e6,
            expected,
            1e-5,
        );
    }
}
