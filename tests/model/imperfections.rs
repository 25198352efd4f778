//! Every key of a bearing's races and balls is read into the model, in SI units.

use rotordyn::bearing::{
    BallBearing, BallSpin, Defect, DefectForm, DefectLaw, Imperfections, OffSize, Shape, Surface, Wave,
};
use rotordyn::model::{self, Options};
use std::f64::consts::{FRAC_PI_2, PI};

fn bearing(lines: &str) -> BallBearing {
    let text =
        format!("[model]\nname = \"b\"\n[bearing.b]\nmodel = \"ball\"\ndesignation = \"6205\"\n{lines}\n");
    let file = model::load_bearings("b.toml", text, &Options::default()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(file.warnings, []);
    file.bearings[0].1.clone()
}

fn imperfections(lines: &str) -> Imperfections {
    bearing(lines).imperfections
}

#[track_caller]
fn near(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-14 * b.abs(), "{a} {b}");
}

#[test]
fn bearings_have_no_imperfections_by_default() {
    assert!(imperfections("").is_empty());
    assert_eq!(imperfections(""), Imperfections::default());
}

#[test]
fn defects() {
    let found = bearing(
        r#"
[[bearing.b.defect]]
kind = "dent"
on = "outer"
angle = "15 deg"
width = "0.17 mm"
[[bearing.b.defect]]
kind = "bump"
on = "inner"
centre = "270 deg"
width = "0.2 mm"
height = "0.25 um"
shape = "cap"
[[bearing.b.defect]]
kind = "spall"
on = "ball"
ball = 3
angle = "0 deg"
width = "1 mm"
depth = "20 um"
edge_radius = "0.1 mm"
"#,
    );
    let g = &found.geometry;
    let [dent, bump, spall] = found.imperfections.defects[..] else { panic!() };
    let form = DefectForm::Dent { depth: None, shape: Shape::HalfSine };
    assert_eq!(
        dent,
        Defect { surface: Surface::Outer, row: None, start: 15.0 * PI / 180.0, width: 0.17e-3, form }
    );
    assert_eq!((bump.surface, bump.width), (Surface::Inner, 0.2e-3));
    assert_eq!(bump.form, DefectForm::Bump { height: 0.25e-6, shape: Shape::Cap });
    let race = 0.5 * (g.pitch_diameter - g.ball_diameter);
    near(bump.start, 1.5 * PI - 0.1e-3 / race);
    assert_eq!((spall.surface, spall.start), (Surface::Ball(3), 0.0));
    assert_eq!(spall.form, DefectForm::Spall { depth: 20e-6, edge_radius: 0.1e-3 });
    assert_eq!(found.imperfections.condition(), "dent on outer race, bump on inner race, spall on ball 3");
}

#[test]
fn defect_height_is_the_lesser_of_depth_and_ball_reach() {
    let dent = |depth: &str| {
        let text = format!("kind = \"dent\", on = \"outer\", angle = \"0 deg\", width = \"0.34 mm\"{depth}");
        bearing(&format!("defect = [{{ {text} }}]"))
    };
    let free = dent("");
    let g = &free.geometry;
    let reach = 0.5 * g.ball_diameter - (0.25 * g.ball_diameter.powi(2) - 0.17e-3_f64.powi(2)).sqrt();
    let height = |b: &BallBearing| b.imperfections.defects[0].height(&b.geometry);
    assert!((height(&free) + reach).abs() < 1e-17);
    assert_eq!(height(&dent(", depth = \"1 um\"")), -1e-6);
}

#[test]
fn defect_laws() {
    let law = |line: &str| imperfections(line).law;
    assert_eq!(law(""), DefectLaw::Displacement);
    assert_eq!(law("defect_law = \"undamped_displacement\""), DefectLaw::UndampedDisplacement);
    assert_eq!(law("defect_law = \"force\""), DefectLaw::Force { stiffness: None, loaded_only: false });
    let given = "defect_law = \"force_on_loaded\"\ndefect_stiffness = \"1.58e10 N/m^1.5\"";
    assert_eq!(law(given), DefectLaw::Force { stiffness: Some(1.58e10), loaded_only: true });
}

#[test]
fn waves_by_law_and_list() {
    let waves = |line: &str| imperfections(line).inner_waviness;
    let rough = waves(
        "inner_waviness = { amplitude = \"2 um\", roughness_exponent = 1.5, from = 3, to = 30, seed = 7 }",
    );
    assert_eq!((rough.len(), rough[0].order, rough[27].order), (28, 3, 30));
    near(rough[1].amplitude, 2e-6 / 8.0);
    // Phases do not depend on the law; an exponent of 1 is 1/n.
    let plain = waves("inner_waviness = { amplitude = \"2 um\", from = 3, to = 30, seed = 7 }");
    let one = waves(
        "inner_waviness = { amplitude = \"2 um\", roughness_exponent = 1, from = 3, to = 30, seed = 7 }",
    );
    assert_eq!(plain, one);
    assert!(plain.iter().zip(&rough).all(|(a, b)| a.phase == b.phase));
    let other = waves("inner_waviness = { amplitude = \"2 um\", from = 3, to = 30, seed = 8 }");
    assert!(plain.iter().zip(&other).all(|(a, b)| a.phase != b.phase));

    let balls = |line: &str| imperfections(line).ball_waviness;
    let own = balls("ball_waviness = { amplitude = \"0.1 um\", from = 2, to = 4 }");
    assert_eq!(own.len(), 9 * 3);
    assert_ne!(own[0].wave.phase, own[3].wave.phase);
    assert_eq!((own[3].ball, own[3].wave.order), (Some(1), 2));
    let same = balls("ball_waviness = { amplitude = \"0.1 um\", from = 2, to = 4, same_phase = true }");
    assert_eq!((same.len(), same[0].ball), (3, None));
    let listed = balls(
        "ball_waviness = [{ order = 2, amplitude = \"1 nm\" }, { ball = 8, order = 4, amplitude = \"2 nm\", phase = \"90 deg\" }]",
    );
    assert_eq!((listed[0].ball, listed[1].ball), (None, Some(8)));
    assert_eq!(listed[1].wave, Wave { order: 4, amplitude: 2e-9, phase: FRAC_PI_2 });
}

#[test]
fn sizes_eccentric_races_and_spin() {
    let found = imperfections(
        "off_size = [{ ball = 0, diameter_difference = \"0.2 um\" }, { ball = 4, diameter_difference = \"-0.1 um\" }]\nball_spin = \"shaft\"\n\
         inner_eccentricity = { amount = \"2 um\", angle = \"30 deg\" }\nouter_eccentricity = { amount = \"1 um\" }",
    );
    // Micrometres are converted by division by 10⁶.
    let size = |ball, by| OffSize { ball, diameter_difference: by, row: None };
    assert_eq!(found.off_size, [size(0, 0.2 / 1e6), size(4, -0.1 / 1e6)]);
    assert_eq!(found.spin, BallSpin::Shaft);
    assert_eq!(found.inner_waviness, [Wave { order: 1, amplitude: 2e-6, phase: -PI / 6.0 }]);
    assert_eq!(found.outer_waviness, [Wave { order: 1, amplitude: 1e-6, phase: PI }]);
    assert_eq!(found.condition(), "healthy, wavy races, off-size balls");
}

#[test]
fn rows_of_a_pair() {
    let pair = "designation = \"7205B\"\narrangement = \"back_to_back\"\nrow_spacing = \"15 mm\"\n\
        off_size = [{ ball = 0, diameter_difference = \"0.2 um\", row = 1 }]\n\
        defect = [{ kind = \"dent\", on = \"outer\", row = 0, angle = \"0 deg\", width = \"0.1 mm\" }]";
    let text = format!("[model]\nname = \"b\"\n[bearing.b]\nmodel = \"ball\"\n{pair}\n");
    let file = model::load_bearings("b.toml", text, &Options::default()).unwrap_or_else(|e| panic!("{e}"));
    let found = &file.bearings[0].1.imperfections;
    assert_eq!((found.off_size[0].row, found.defects[0].row), (Some(1), Some(0)));
}
