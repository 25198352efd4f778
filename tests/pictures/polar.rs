//! Polar plots: the drawn curve follows the response between the samples.

use rotordyn::linalg::Complex64;
use rotordyn::plot::*;

use super::machines::{groups, paths};

/// Synchronous response r²/(1 − r² + 2 j ζ r) of a rotor with two modes.
fn response(rpm: f64) -> Complex64 {
    let mode = |critical: f64, zeta: f64, size: f64| {
        let r = rpm / critical;
        Complex64::new(size * r * r, 0.0) / Complex64::new(1.0 - r * r, 2.0 * zeta * r)
    };
    mode(2400.0, 0.02, 1.0) + mode(5100.0, 0.015, -0.6)
}

fn figure(rpm: &[f64], response: impl Fn(f64) -> Complex64) -> String {
    let values: Vec<Complex64> = rpm.iter().map(|s| response(*s)).collect();
    let curve = PolarCurve {
        label: "disc".into(),
        rpm: rpm.to_vec(),
        amplitude: values.iter().map(|v| v.norm()).collect(),
        phase_deg: values.iter().map(|v| v.arg().to_degrees()).collect(),
    };
    Figure::Polar(Polar { unit: "µm".into(), curves: vec![curve], ..Polar::default() }).svg().unwrap()
}

/// The curve in units of the response, from the page: the outermost ring is the largest circle.
fn curve(svg: &str) -> Vec<[f64; 2]> {
    paths(groups(svg, "curves")[0]).concat()
}

/// px per unit and centre, from the page points of two values.
fn circle(svg: &str) -> ([f64; 2], f64) {
    let number = |line: &str, name: &str| -> f64 {
        line.split(&format!("{name}=\"")).nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    let ring = svg
        .lines()
        .filter(|l| l.starts_with("<circle"))
        .max_by(|a, b| number(a, " r").total_cmp(&number(b, " r")));
    let ring = ring.unwrap();
    ([number(ring, "cx"), number(ring, "cy")], number(ring, " r"))
}

/// Largest label of the rings: value of the outermost ring.
fn reach(svg: &str) -> f64 {
    let label =
        svg.split("</text>").filter_map(|t| t.rsplit('>').next()).find(|t| t.ends_with(" µm")).unwrap();
    label.trim_end_matches(" µm").parse().unwrap()
}

/// Distance of a point from the response \[px\], by a fine search over speed.
fn distance(p: [f64; 2], centre: [f64; 2], per_unit: f64, fine: &[Complex64]) -> f64 {
    let [x, y] = [(p[0] - centre[0]) / per_unit, -(p[1] - centre[1]) / per_unit];
    fine.iter().map(|v| (v.re - x).hypot(v.im - y)).fold(f64::INFINITY, f64::min) * per_unit
}

#[test]
fn curve_between_coarse_samples_is_the_response() {
    // 50 rpm over half-power widths of 96 and 153 rpm: about two samples in a resonance.
    let rpm: Vec<f64> = (10..130).map(|k| 50.0 * f64::from(k)).collect();
    let svg = figure(&rpm, response);
    let ((centre, radius), reach) = (circle(&svg), reach(&svg));
    let per_unit = radius / reach;
    let fine: Vec<Complex64> = (0..120_000).map(|k| response(500.0 + 0.05 * f64::from(k))).collect();
    let drawn = curve(&svg);
    assert!(drawn.len() > 150);
    let far = drawn.iter().map(|p| distance(*p, centre, per_unit, &fine)).fold(0.0, f64::max);
    assert!(far < 1.0, "the curve is {far} px beside the response");
    // Smooth: also the middle of every drawn piece lies on the response.
    let middles = drawn.windows(2).map(|p| [0.5 * (p[0][0] + p[1][0]), 0.5 * (p[0][1] + p[1][1])]);
    let far = middles.map(|p| distance(p, centre, per_unit, &fine)).fold(0.0, f64::max);
    assert!(far < 1.0, "a piece of the curve is {far} px beside the response");
    // No overshoot, and the peak between samples is drawn.
    let peak = fine.iter().map(|v| v.norm()).fold(0.0, f64::max);
    let largest =
        drawn.iter().map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]) / per_unit).fold(0.0, f64::max);
    assert!((largest / peak - 1.0).abs() < 0.01, "{largest} of {peak}");
}

#[test]
fn samples_that_are_no_response_are_joined_without_overshoot() {
    // Points of random angle and size: no circle through them is meant.
    let rpm: Vec<f64> = (0..60).map(|k| 100.0 * f64::from(k + 1)).collect();
    let noise = |k: f64| (k * 12.9898).sin() * 43758.5453 % 1.0;
    let svg = figure(&rpm, |s| Complex64::from_polar(1.0 + noise(s).abs(), 7.0 * noise(s + 0.5)));
    let ((centre, radius), reach) = (circle(&svg), reach(&svg));
    let largest = curve(&svg)
        .iter()
        .map(|p| (p[0] - centre[0]).hypot(p[1] - centre[1]) / radius * reach)
        .fold(0.0, f64::max);
    assert!(largest < 2.6, "{largest}");
}

#[test]
fn undamped_pole_is_a_gap() {
    let rpm: Vec<f64> = (10..60).map(|k| 50.0 * f64::from(k)).collect();
    let svg = figure(&rpm, |s| {
        let r = s / 1520.0;
        Complex64::new(r * r / (1.0 - r * r), 0.0)
    });
    assert_eq!(paths(groups(&svg, "curves")[0]).len(), 2);
}

#[test]
fn marked_speeds_are_the_peak_and_round_ones() {
    let rpm: Vec<f64> = (0..400).map(|k| 507.3 + 13.7 * f64::from(k)).collect();
    let svg = figure(&rpm, response);
    let texts: Vec<&str> = svg.split("</text>").filter_map(|t| t.rsplit('>').next()).collect();
    let speeds: Vec<f64> =
        texts.iter().filter_map(|t| t.parse().ok()).filter(|s: &f64| (507.0..6000.0).contains(s)).collect();
    let fine = (0..60_000).map(|k| 500.0 + 0.1 * f64::from(k));
    let peak = fine.max_by(|a, b| response(*a).norm().total_cmp(&response(*b).norm())).unwrap();
    assert!(speeds.iter().any(|s| (s - peak).abs() < 3.0), "{peak} is not in {speeds:?}");
    let round = speeds.iter().filter(|s| (*s % 10.0).abs() < 1e-9).count();
    assert!(speeds.len() >= 4 && round >= speeds.len() - 1, "{speeds:?}");
}
