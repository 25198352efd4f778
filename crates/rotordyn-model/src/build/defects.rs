//! Local defects (dents, bumps, spalls) of a ball bearing, `[[bearing.x.defect]]`.

use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative};
use rotordyn_bearing::{BallGeometry, Defect, DefectForm, Shape, Surface};
use rotordyn_units::{ANGLE, LENGTH};
use std::f64::consts::{PI, TAU};

/// Keywords of the key `kind`.
#[derive(Clone, Copy)]
enum KindKeyword {
    Dent,
    Bump,
    Spall,
}

/// Keywords of the key `on`.
#[derive(Clone, Copy)]
enum SurfaceKeyword {
    Inner,
    Outer,
    Ball,
}

/// All defects of a bearing; `pair`: whether it has two rows.
pub(super) fn read(r: &Reader, g: &BallGeometry, pair: bool) -> Vec<Defect> {
    let geometry_known = r.has_no_errors();
    let one = |d: Reader| {
        let out = defect(&d, g, pair);
        if geometry_known
            && d.has_no_errors()
            && let Some(defect) = &out
        {
            check_feasibility(&d, g, defect);
        }
        d.finish();
        out
    };
    r.tables("defect").into_iter().filter_map(one).collect()
}

/// Row index in a matched pair.
pub(super) fn row(r: &Reader, pair: bool) -> Option<usize> {
    if !r.has("row") {
        return None;
    }
    if !pair {
        let message = format!("{} does not apply to a bearing with one row", r.name("row"));
        let problem = Problem::new(Kind::Conflict, &r.span_of("row"), message);
        r.log.error(problem.hint("remove it, or define a pair with arrangement and row_spacing"));
    }
    Some(r.count("row", 0, 0..=1))
}

fn defect(d: &Reader, g: &BallGeometry, pair: bool) -> Option<Defect> {
    let kinds = [("dent", KindKeyword::Dent), ("bump", KindKeyword::Bump), ("spall", KindKeyword::Spall)];
    let places =
        [("outer", SurfaceKeyword::Outer), ("inner", SurfaceKeyword::Inner), ("ball", SurfaceKeyword::Ball)];
    for (key, example) in
        [("kind", "\"dent\", \"bump\" or \"spall\""), ("on", "\"outer\", \"inner\" or \"ball\"")]
    {
        if !d.has(key) {
            d.missing(key, example);
        }
    }
    let (kind, place) = (d.choice("kind", &kinds), d.choice("on", &places));
    let row = row(d, pair);
    let size = |key: &str, example: &str| {
        if !d.has(key) {
            d.missing(key, example);
        }
        d.or(key, not_negative(LENGTH), 1.0)
    };
    let width = size("width", "\"0.17 mm\"");
    let ball = d.has("ball").then(|| d.count("ball", 0, 0..=g.balls - 1));
    let on = match (place, ball) {
        (Some(SurfaceKeyword::Inner), None) => Surface::Inner,
        (Some(SurfaceKeyword::Outer), None) => Surface::Outer,
        (Some(SurfaceKeyword::Ball), Some(ball)) => Surface::Ball(ball),
        (Some(SurfaceKeyword::Ball), None) => {
            d.missing("ball", "0 (the first, at the cage angle)");
            Surface::Ball(0)
        }
        (Some(_), Some(_)) => {
            let message = format!("{} does not apply to a defect on a race", d.name("ball"));
            d.log.error(Problem::new(Kind::Conflict, &d.span_of("ball"), message).expected("on = \"ball\""));
            Surface::Outer
        }
        (None, _) => Surface::Outer,
    };
    let angle = d.one_of(&["angle", "centre"]);
    if angle.is_none() {
        d.missing("angle", "\"12 deg\" (where it starts), or centre");
    }
    let given = angle.and_then(|key| d.get(key, any(ANGLE))).unwrap_or(0.0);
    let Some(kind) = kind else {
        // the other valid keys depend on the kind
        d.entries();
        return None;
    };
    let shape =
        || d.choice("shape", &[("half_sine", Shape::HalfSine), ("cap", Shape::Cap)]).unwrap_or_default();
    let without = |keys: &[&str], expected: &str| {
        for key in keys.iter().copied().filter(|key| d.has(key)) {
            let message = format!("{} does not apply to {expected}", d.name(key));
            d.error(Kind::Conflict, key, message);
        }
    };
    let form = match kind {
        KindKeyword::Dent => {
            without(&["height", "edge_radius"], "a dent, which has a depth and a shape");
            DefectForm::Dent { depth: d.get("depth", not_negative(LENGTH)), shape: shape() }
        }
        KindKeyword::Bump => {
            without(&["depth", "edge_radius"], "a bump, which has a height and a shape");
            DefectForm::Bump { height: size("height", "\"0.25 um\""), shape: shape() }
        }
        KindKeyword::Spall => {
            without(&["height", "shape"], "a spall, which has a depth and an edge_radius");
            DefectForm::Spall {
                depth: size("depth", "\"20 um\""),
                edge_radius: d.or("edge_radius", not_negative(LENGTH), 0.0),
            }
        }
    };
    place?;
    let mut out = Defect { surface: on, row, start: given, width, form };
    if angle == Some("centre") {
        out.start -= 0.5 * out.angle(g);
    }
    Some(out)
}

/// Geometric feasibility check of a defect, with warnings about parts that the balls do not reach.
fn check_feasibility(d: &Reader, g: &BallGeometry, defect: &Defect) {
    let problem = |kind, key: &str, message: String| Problem::new(kind, &d.span_of(key), message);
    let (radius, angle) = (defect.surface.radius(g), defect.angle(g));
    let mm = |x: f64| x * 1e3;
    let um = |x: f64| x * 1e6;
    if angle >= TAU {
        let message = format!("{} covers the whole circumference", d.name("width"));
        let room = format!("less than the circumference of {:.3} mm", mm(TAU * radius));
        d.log.error(problem(Kind::Geometry, "width", message).expected(room));
        return;
    }
    match defect.form {
        DefectForm::Spall { edge_radius, .. } if edge_radius > 0.5 * defect.width => {
            let message = format!("{} leaves no pit between the edges", d.name("edge_radius"));
            let most = format!("at most half the width, {:.4} mm", mm(0.5 * defect.width));
            d.log.error(problem(Kind::Geometry, "edge_radius", message).expected(most));
            return;
        }
        DefectForm::Bump { height, shape: Shape::Cap } if height > 0.0 && height >= 0.5 * defect.width => {
            let message = format!("{} is not possible for a spherical cap", d.name("height"));
            let most = format!("below half the width, {:.4} mm", mm(0.5 * defect.width));
            d.log.error(problem(Kind::Geometry, "height", message).expected(most));
            return;
        }
        DefectForm::Dent { depth: None, .. } if defect.width >= g.ball_diameter => {
            let message = format!(
                "{} is not smaller than the ball diameter of {:.3} mm",
                d.name("width"),
                mm(g.ball_diameter)
            );
            d.log.error(
                problem(Kind::Geometry, "width", message)
                    .expected("a depth as well, since no ball spans this width"),
            );
            return;
        }
        DefectForm::Dent { shape: Shape::Cap, .. }
            if -defect.height(g) >= 0.5 * defect.width && defect.width > 0.0 =>
        {
            let message = format!("{} is not possible for a spherical cap", d.name("depth"));
            let most = format!("below half the width, {:.4} mm", mm(0.5 * defect.width));
            d.log.error(problem(Kind::Geometry, "depth", message).expected(most));
            return;
        }
        _ => {}
    }
    let (room, what) = match defect.surface {
        Surface::Ball(_) => (PI, "both races at once"),
        Surface::Inner | Surface::Outer => (TAU / g.balls as f64, "two balls at once"),
    };
    if angle > room {
        let message = format!("{} extends under {what}", d.name("width"));
        let spacing = format!("below {:.3} mm, one contact at a time", mm(room * radius));
        d.log.warn(
            problem(Kind::Geometry, "width", message)
                .expected(spacing)
                .hint("the analysis continues; each contact follows its own path"),
        );
    }
    if let DefectForm::Dent { depth: Some(depth), .. } | DefectForm::Spall { depth, .. } = defect.form
        && defect.width > 0.0
        && depth > defect.max_depth(g)
    {
        let message = format!("{} is deeper than a ball can reach", d.name("depth"));
        let reach = format!("{:.4} um at most in an opening of this width", um(defect.max_depth(g)));
        d.log.warn(
            problem(Kind::Geometry, "depth", message)
                .expected(reach)
                .hint("the analysis continues: the ball rests on the edges and does not touch the bottom"),
        );
    }
}
