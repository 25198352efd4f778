//! Machine layout: rows of a pair with their contact angles, symbols of linear bearings, bushings and joints.

use rotordyn::results::Results;

use super::machines::{PEDESTALS, SPINDLE, groups, layout, machine, paths, pictures_of};

/// Axial positions \[px\] where the upper load lines of the rows meet the shaft axis, and of the rows.
fn load_lines(arrangement: &str) -> ([f64; 2], [f64; 2]) {
    let text = SPINDLE.replace("back_to_back", arrangement);
    let text = if arrangement == "tandem" {
        text.replace("arrangement = \"tandem\"", "arrangement = \"tandem\"\nthrust = \"+z\"")
            .replace("preload = { force = \"150 N\" }", "")
    } else {
        text
    };
    let svg = layout(&text);
    let bearings = groups(&svg, "ball-bearing");
    assert_eq!(bearings.len(), 1, "one ball bearing, other supports have other symbols");
    let circles = bearings[0].matches("<circle").count();
    assert_eq!(circles, 4, "two rows above and below the shaft");
    let lines: Vec<Vec<[f64; 2]>> = groups(bearings[0], "contact-line").into_iter().flat_map(paths).collect();
    assert_eq!(lines.len(), 4);
    let centre = |attribute: &str| -> Vec<f64> {
        bearings[0].split(attribute).skip(1).map(|p| p.split('"').next().unwrap().parse().unwrap()).collect()
    };
    let (cx, cy) = (centre("cx=\""), centre("cy=\""));
    let axis = 0.5 * (cy[0] + cy[1]);
    // Order of drawing: row 1 above, below, row 2 above, below.
    let meet = [0, 2].map(|k| {
        let [a, b] = [lines[k][0], lines[k][1]];
        // The line passes through the ball.
        let through = a[0] + (cy[k] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
        assert!((through - cx[k]).abs() < 0.1, "{through} {}", cx[k]);
        a[0] + (axis - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
    });
    (meet, [cx[0], cx[2]])
}

#[test]
fn rows_of_a_pair_are_drawn_with_their_contact_angles() {
    // tan 40° × pitch radius over half the spacing: the arms of a back-to-back pair exceed the spacing.
    let (meet, rows) = load_lines("back_to_back");
    assert!(rows[0] < rows[1] && meet[0] < rows[0] - 5.0 && meet[1] > rows[1] + 5.0, "{meet:?} {rows:?}");
    let outside = (meet[1] - meet[0]) / (rows[1] - rows[0]);
    let (meet, rows) = load_lines("face_to_face");
    assert!(meet[0] > rows[0] + 5.0 && meet[1] < rows[1] - 5.0, "{meet:?} {rows:?}");
    // The arms of both arrangements are equal: 1 + a and 1 − a spacings.
    let inside = (meet[1] - meet[0]) / (rows[1] - rows[0]);
    assert!((outside - 1.0 + inside - 1.0).abs() < 0.02, "{outside} {inside}");
    let (meet, rows) = load_lines("tandem");
    assert!(((meet[1] - meet[0]) / (rows[1] - rows[0]) - 1.0).abs() < 0.02 && meet[0] < rows[0], "{meet:?}");
}

#[test]
fn linear_bearings_bushings_and_joints_have_their_own_symbols() {
    let svg = &layout(SPINDLE);
    // Linear bearing with spring and damper; bushing on the disc with a damper only.
    let symbols = groups(svg, "spring-damper");
    assert_eq!(symbols.len(), 2);
    let zigzags = |svg: &str| paths(svg).iter().filter(|p| p.len() == 11).count();
    // The cup of a damper is an open line of four points.
    let cups = |svg: &str| paths(svg).iter().filter(|p| p.len() == 4).count();
    assert_eq!((zigzags(symbols[0]), cups(symbols[0])), (1, 1));
    assert_eq!((zigzags(symbols[1]), cups(symbols[1])), (0, 1));
    let joints = groups(svg, "joint");
    assert_eq!(joints.len(), 1);
    assert_eq!(joints[0].matches("<circle").count(), 1, "a pin");
    // The foundation's springs, without a damper.
    let springs = groups(svg, "spring\"");
    assert_eq!(springs.iter().map(|s| (zigzags(s), cups(s))).collect::<Vec<_>>(), [(1, 0)]);

    let svg = &layout(PEDESTALS);
    assert_eq!(groups(svg, "ball-bearing").len(), 0);
    // Two bearings in housings with springs only, and an axial bushing whose spring lies along the shaft.
    let symbols = groups(svg, "spring-damper");
    assert_eq!(symbols.len(), 3);
    for symbol in &symbols[..2] {
        assert_eq!((zigzags(symbol), cups(symbol)), (1, 0));
    }
    let axial = paths(symbols[2]).into_iter().find(|p| p.len() == 11).unwrap();
    assert!((axial[10][0] - axial[0][0]).abs() > 3.0 * (axial[10][1] - axial[0][1]).abs(), "{axial:?}");
}

#[test]
fn loads_of_a_pair_are_drawn_in_a_panel_for_each_row() {
    let machine = machine(SPINDLE);
    let study = machine.model.studies.equilibrium.as_ref().unwrap();
    let found = machine.equilibrium(study).unwrap();
    let balls = found.bearings[0].balls.len();
    let results = Results { equilibrium: Some(found), ..Results::default() };
    let svg = &pictures_of(&machine, &results)["ball_loads"];
    assert!(
        svg.contains("bearing front, row 1 (towards −z)")
            && svg.contains("bearing front, row 2 (towards +z)")
    );
    // Four circles of the rings in every panel, and one per ball.
    assert_eq!(svg.matches("<circle").count(), 2 * 4 + balls);
    let centre = |name: &str| -> Vec<f64> {
        svg.split(name).skip(1).map(|p| p.split('"').next().unwrap().parse().unwrap()).collect()
    };
    let (x, y) = (centre("cx=\""), centre("cy=\""));
    let same = |i: usize, j: usize| (x[i] - x[j]).hypot(y[i] - y[j]) < 1.0;
    let on_top: usize = (4..4 + balls / 2).filter(|i| (4..x.len()).any(|j| j != *i && same(*i, j))).count();
    assert_eq!(on_top, 0, "balls of both rows are drawn over each other");
}
