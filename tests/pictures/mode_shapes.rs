//! Mode shapes: one scale for shaft and bodies, bodies that move with their mode.

use rotordyn::plot::*;

use super::machines::{PEDESTALS, SPINDLE, groups, modes, paths, pictures_of};

/// Centre of all points of some paths.
fn centre(paths: &[Vec<[f64; 2]>]) -> [f64; 2] {
    let points: Vec<[f64; 2]> = paths.concat();
    let count = points.len() as f64;
    [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / count)
}

/// Largest distance of the points of a line from the chord of its ends.
fn bend(line: &[[f64; 2]]) -> f64 {
    let (a, b) = (line[0], line[line.len() - 1]);
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    line.iter().map(|p| ((p[0] - a[0]) * dy - (p[1] - a[1]) * dx).abs() / length).fold(0.0, f64::max)
}

fn filled(svg: &str) -> Vec<Vec<[f64; 2]>> {
    let lines: Vec<&str> = svg.lines().filter(|l| l.contains("fill=\"#eeebe2\"")).collect();
    paths(&lines.join("\n"))
}

#[test]
fn axial_mode_of_a_housing_moves_the_housing_and_not_the_shaft() {
    let (machine, results) = modes(PEDESTALS);
    let pictures = pictures_of(&machine, &results);
    let panels = groups(&pictures["modes_3000rpm"], "mode mode-");
    let modes = &results.modal[0].modes;
    assert_eq!(panels.len(), modes.len());
    let mut found = 0;
    for (panel, mode) in panels.iter().zip(modes) {
        let Some(body) = ["left", "right"].iter().position(|b| mode.label.contains(&format!("{b}, u_z")))
        else {
            continue;
        };
        found += 1;
        // √(k_z/m) of a housing alone: nothing else moves.
        let closed = [(1e6f64 / 9.0).sqrt(), (1.4e6f64 / 7.0).sqrt()][body];
        assert!((mode.natural_omega() / closed - 1.0).abs() < 1e-6);
        let shaft = paths(groups(panel, "shaft")[0]).remove(0);
        assert!(bend(&shaft) < 0.1, "{}: the shaft is drawn bent by {} px", mode.label, bend(&shaft));
        // Rest outlines of both housings are dashed, moved ones filled; axes of the view: z is (0.97, 0.17).
        let bodies = filled(groups(panel, "bodies")[0]);
        let rest =
            paths(&panel.lines().filter(|l| l.contains("dasharray=\"4 3\"")).collect::<Vec<_>>().join("\n"));
        assert_eq!(bodies.len(), 6);
        let [other, own] = [1 - body, body].map(|b| {
            let (moved, rest) = (centre(&bodies[3 * b..3 * b + 3]), centre(&rest[3 * b..3 * b + 3]));
            [moved[0] - rest[0], moved[1] - rest[1]]
        });
        assert!(own[0].abs() > 20.0 && (own[1] / own[0] - 0.17 / 0.97).abs() < 0.01, "{own:?}");
        assert!(other[0].hypot(other[1]) < 0.1, "{other:?}");
        let name = ["left", "right"][body];
        assert!(panel.contains(&format!("largest motion: housing {name}, axial; shaft")), "{panel}");
        assert!(panel.contains("below 0.1 %"), "{panel}");
    }
    assert_eq!(found, 2);
}

#[test]
fn foundation_is_drawn_and_moves_with_its_modes() {
    let (machine, results) = modes(SPINDLE);
    let pictures = pictures_of(&machine, &results);
    let panels = groups(&pictures["modes_3000rpm"], "mode mode-");
    let (mut moving, mut still) = (0, 0);
    for (panel, mode) in panels.iter().zip(&results.modal[0].modes) {
        let faces = filled(groups(panel, "bodies")[0]);
        assert!((1..=3).contains(&faces.len()), "{}: {} faces", mode.label, faces.len());
        let rest =
            paths(&panel.lines().filter(|l| l.contains("dasharray=\"4 3\"")).collect::<Vec<_>>().join("\n"));
        let corner = faces.len().min(3);
        let shift = {
            let (a, b) = (centre(&faces), centre(&rest[..3]));
            (a[0] - b[0]).hypot(a[1] - b[1])
        };
        if mode.label.contains("foundation, u_y") {
            moving += 1;
            assert!(shift > 10.0 && corner == 3, "{}: {shift}", mode.label);
        } else if mode.label.contains("torsional") {
            still += 1;
            assert!(shift < 0.2, "{}: {shift}", mode.label);
        }
    }
    assert!(moving >= 1 && still >= 1, "{moving} {still}");
}

fn rotor() -> Rotor {
    Rotor {
        z: vec![0.0, 0.5, 1.0],
        bodies: vec![BodyBox {
            name: "block".into(),
            centre: [0.0, 0.0, 0.5],
            half_edges: [[0.06, 0.0, 0.0], [0.0, 0.06, 0.0], [0.0, 0.0, 0.06]],
            to_ground: (false, false),
        }],
        ..Rotor::default()
    }
}

fn shape(shaft: f64, u: [f64; 3], theta: [f64; 3]) -> ModeShape {
    ModeShape {
        title: "mode".into(),
        whirl: Whirl::Mixed,
        u_x: vec![[0.0; 2]; 3],
        u_y: vec![[shaft, 0.0]; 3],
        u_z: vec![],
        theta_x: vec![],
        theta_y: vec![],
        theta_z: vec![],
        bodies: vec![BodyMotion { u: u.map(|u| [u, 0.0]), theta: theta.map(|t| [t, 0.0]) }],
    }
}

fn drawn(mode: ModeShape) -> String {
    Figure::ModeShapes(ModeShapes { rotor: rotor(), modes: vec![mode], ..ModeShapes::default() })
        .svg()
        .unwrap()
}

/// Shift of the shaft line and of the block, from the same picture without motion.
fn shifts(svg: &str) -> [[f64; 2]; 2] {
    let line = |svg: &str, dash: bool| {
        let lines =
            svg.lines().filter(|l| l.contains("dasharray=\"8 3\"") == dash).collect::<Vec<_>>().join("\n");
        paths(if dash { &lines } else { groups(svg, "shaft")[0] }).remove(0)
    };
    let shaft = {
        let (a, b) = (line(svg, false)[0], line(svg, true)[0]);
        [a[0] - b[0], a[1] - b[1]]
    };
    let rest = paths(&svg.lines().filter(|l| l.contains("dasharray=\"4 3\"")).collect::<Vec<_>>().join("\n"));
    let (a, b) = (centre(&filled(svg)), centre(&rest[..3]));
    [shaft, [a[0] - b[0], a[1] - b[1]]]
}

#[test]
fn shaft_and_body_have_one_scale_in_every_direction() {
    let [shaft, body] = shifts(&drawn(shape(0.25, [0.0, 1.0, 0.0], [0.0; 3])));
    assert!((shaft[1] / body[1] - 0.25).abs() < 0.01 && body[1] < -20.0, "{shaft:?} {body:?}");
    // A body that moves along the shaft only: round-off of the shaft is not magnified.
    let [shaft, body] = shifts(&drawn(shape(1e-12, [0.0, 0.0, 1.0], [0.0; 3])));
    assert!(shaft[0].hypot(shaft[1]) < 0.02 && body[0] > 20.0, "{shaft:?} {body:?}");
    let [shaft, body] = shifts(&drawn(shape(0.5, [1.0, 0.0, 0.0], [0.0; 3])));
    assert!((shaft[1] / 0.906 / (body[0] / 0.5) + 0.5).abs() < 0.01, "{shaft:?} {body:?}");
}

#[test]
fn turning_body_is_drawn_turned() {
    let svg = drawn(shape(0.0, [0.0; 3], [0.0, 0.0, 1.0]));
    assert!(svg.contains("largest motion: block, rotation about z; shaft"), "{svg}");
    let rest = drawn(shape(1.0, [0.0; 3], [0.0; 3]));
    // Edges that were parallel to the axes x and y are not any more.
    let slopes = |svg: &str| {
        let faces = filled(svg);
        let mut slopes: Vec<f64> = faces
            .iter()
            .flat_map(|f| {
                f.windows(2)
                    .map(|p| (p[1][1] - p[0][1]).atan2(p[1][0] - p[0][0]).rem_euclid(std::f64::consts::PI))
                    .collect::<Vec<_>>()
            })
            .collect();
        slopes.sort_by(f64::total_cmp);
        slopes.dedup_by(|a, b| (*a - *b).abs() < 0.02);
        slopes
    };
    let (turned, rest) = (slopes(&svg), slopes(&rest));
    let new = turned.iter().filter(|s| !rest.iter().any(|r| (*s - r).abs() < 0.1)).count();
    assert!(new >= 2, "{turned:?} {rest:?}");
}
