//! Local defects (dents, bumps, spalls) of a ball bearing, `[[bearing.x.defect]]`.

use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Declared, Group, Quantity, Table, TableList, Words, any, count, keys, not_negative, quantity,
    table_list, words,
};
use crate::file::reader::Reader;
use rotordyn_bearing::{BallGeometry, Defect, DefectForm, Shape, Surface};
use rotordyn_core::warning::Code;
use rotordyn_units::{ANGLE, LENGTH};
use std::f64::consts::{PI, TAU};

/// Keywords of the key `kind`.
#[derive(Clone, Copy, Debug)]
enum KindKeyword {
    Dent,
    Bump,
    Spall,
}

/// Keywords of the key `on`.
#[derive(Clone, Copy, Debug)]
enum SurfaceKeyword {
    Inner,
    Outer,
    Ball,
}

keys! {
    /// `[[bearing.x.defect]]`.
    static DEFECT: DefectKeys {
        kind: Words<KindKeyword> = words(&[
            ("dent", KindKeyword::Dent), ("bump", KindKeyword::Bump), ("spall", KindKeyword::Spall),
        ], "Indentation, raised material, or removed material with edges.");
        on: Words<SurfaceKeyword> = words(&[
            ("outer", SurfaceKeyword::Outer), ("inner", SurfaceKeyword::Inner), ("ball", SurfaceKeyword::Ball),
        ], "The race or ball that it is on.");
        width: Quantity = quantity(not_negative(LENGTH), "Width along the circumference.").example("\"0.17 mm\"");
        angle: Quantity = quantity(any(ANGLE),
            "Where it starts: from +x towards +y at shaft angle zero; on a ball from its point at the outer race, against its spin.")
            .required("or centre");
        centre: Quantity = quantity(any(ANGLE), "Where its centre is, instead of angle.").required("or angle");
        depth: Quantity = quantity(not_negative(LENGTH), "Depth of a spall, or of a dent.")
            .required("with kind = \"spall\"; a dent is as deep as a ball reaches").with("kind = \"spall\"")
            .example("\"20 um\"");
        height: Quantity = quantity(not_negative(LENGTH), "Height of a bump.").required("with kind = \"bump\"")
            .with("kind = \"bump\"").example("\"0.25 um\"");
        shape: Words<Shape> = words(&[("half_sine", Shape::HalfSine), ("cap", Shape::Cap)],
            "Profile of a dent or bump: half a sine, or a spherical cap.").default("half_sine")
            .with("kind = \"dent\"");
        edge_radius: Quantity = quantity(not_negative(LENGTH), "Radius of the edges of a spall.").default("0 mm")
            .with("kind = \"spall\"").example("\"0.05 mm\"");
        ball: Count = count([0, 999], "The ball, counted from 0, which is at the cage angle.")
            .required("with on = \"ball\"").with("on = \"ball\"");
    }
}

keys! {
    /// Of every ball bearing.
    pub(super) static DEFECTS: DefectsKeys {
        defect: TableList = table_list(&DEFECT_TABLE);
    }
}

keys! {
    /// Row of an imperfection.
    pub(super) static ROW: RowKeys {
        row: Count = count([0, 1], "Row of a pair that has it.").computed("both rows");
    }
}

static DEFECT_TABLE: Table = Table {
    meaning: "A local defect of a race or a ball.",
    groups: &[Group::always(DefectKeys::LIST), Group::always(RowKeys::LIST)],
};

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
    r.tables(&DEFECTS.defect).into_iter().filter_map(one).collect()
}

/// Row index in a matched pair.
pub(super) fn row(r: &Reader, pair: bool) -> Option<usize> {
    if !r.has(&ROW.row) {
        return None;
    }
    if !pair {
        let message = format!("{} does not apply to a bearing with one row", r.name(&ROW.row));
        let problem = Problem::new(Kind::Conflict, &r.span_of(&ROW.row), message);
        r.log.error(problem.hint("remove it, or define a pair with arrangement and row_spacing"));
    }
    Some(r.count_or(&ROW.row, 0))
}

fn defect(d: &Reader, g: &BallGeometry, pair: bool) -> Option<Defect> {
    for (key, example) in [
        (&DEFECT.kind as &dyn Declared, "\"dent\", \"bump\" or \"spall\""),
        (&DEFECT.on, "\"outer\", \"inner\" or \"ball\""),
    ] {
        if !d.has(key) {
            d.missing_as(key, example);
        }
    }
    let (kind, place) = (d.choice(&DEFECT.kind), d.choice(&DEFECT.on));
    let row = row(d, pair);
    let width = d.value(&DEFECT.width);
    let ball = d.has(&DEFECT.ball).then(|| d.count_up_to(&DEFECT.ball, g.balls - 1).unwrap_or(0));
    let on = match (place, ball) {
        (Some(SurfaceKeyword::Inner), None) => Surface::Inner,
        (Some(SurfaceKeyword::Outer), None) => Surface::Outer,
        (Some(SurfaceKeyword::Ball), Some(ball)) => Surface::Ball(ball),
        (Some(SurfaceKeyword::Ball), None) => {
            d.missing_or(&DEFECT.ball, " (the first, at the cage angle)");
            Surface::Ball(0)
        }
        (Some(_), Some(_)) => {
            let message = format!("{} does not apply to a defect on a race", d.name(&DEFECT.ball));
            d.log.error(
                Problem::new(Kind::Conflict, &d.span_of(&DEFECT.ball), message).expected("on = \"ball\""),
            );
            Surface::Outer
        }
        (None, _) => Surface::Outer,
    };
    let angle = d.one_of(&[&DEFECT.angle, &DEFECT.centre]);
    if angle.is_none() {
        d.missing_or(&DEFECT.angle, " (where it starts), or centre");
    }
    let centred = angle.is_some_and(|given| given.is(&DEFECT.centre));
    let given = d.get(if centred { &DEFECT.centre } else { &DEFECT.angle }).unwrap_or(0.0);
    let Some(kind) = kind else {
        // the other valid keys depend on the kind
        d.entries();
        return None;
    };
    let without = |keys: &[&dyn Declared], expected: &str| {
        for key in keys.iter().copied().filter(|key| d.has(*key)) {
            let message = format!("{} does not apply to {expected}", d.name(key));
            d.error(Kind::Conflict, key, message);
        }
    };
    let form = match kind {
        KindKeyword::Dent => {
            without(&[&DEFECT.height, &DEFECT.edge_radius], "a dent, which has a depth and a shape");
            DefectForm::Dent { depth: d.get(&DEFECT.depth), shape: d.word(&DEFECT.shape) }
        }
        KindKeyword::Bump => {
            without(&[&DEFECT.depth, &DEFECT.edge_radius], "a bump, which has a height and a shape");
            DefectForm::Bump { height: d.value(&DEFECT.height), shape: d.word(&DEFECT.shape) }
        }
        KindKeyword::Spall => {
            without(&[&DEFECT.height, &DEFECT.shape], "a spall, which has a depth and an edge_radius");
            DefectForm::Spall { depth: d.value(&DEFECT.depth), edge_radius: d.value(&DEFECT.edge_radius) }
        }
    };
    place?;
    let mut out = Defect { surface: on, row, start: given, width, form };
    if centred {
        out.start -= 0.5 * out.angle(g);
    }
    Some(out)
}

/// Width of a defect over the ball's diameter below which the contact of a loaded ball bridges it.
const SMALLEST_WIDTH: f64 = 2e-3;

/// Geometric feasibility check of a defect, with warnings about parts that the balls do not reach.
fn check_feasibility(d: &Reader, g: &BallGeometry, defect: &Defect) {
    let problem = |kind, key: &dyn Declared, message: String| Problem::new(kind, &d.span_of(key), message);
    let (radius, angle) = (defect.surface.radius(g), defect.angle(g));
    let mm = |x: f64| x * 1e3;
    let um = |x: f64| x * 1e6;
    if angle >= TAU {
        let message = format!("{} covers the whole circumference", d.name(&DEFECT.width));
        let room = format!("less than the circumference of {:.3} mm", mm(TAU * radius));
        d.log.error(problem(Kind::Geometry, &DEFECT.width, message).expected(room));
        return;
    }
    match defect.form {
        DefectForm::Spall { edge_radius, .. } if edge_radius > 0.5 * defect.width => {
            let message = format!("{} leaves no pit between the edges", d.name(&DEFECT.edge_radius));
            let most = format!("at most half the width, {:.4} mm", mm(0.5 * defect.width));
            d.log.error(problem(Kind::Geometry, &DEFECT.edge_radius, message).expected(most));
            return;
        }
        DefectForm::Bump { height, shape: Shape::Cap } if height > 0.0 && height >= 0.5 * defect.width => {
            let message = format!("{} is not possible for a spherical cap", d.name(&DEFECT.height));
            let most = format!("below half the width, {:.4} mm", mm(0.5 * defect.width));
            d.log.error(problem(Kind::Geometry, &DEFECT.height, message).expected(most));
            return;
        }
        DefectForm::Dent { depth: None, .. } if defect.width >= g.ball_diameter => {
            let message = format!(
                "{} is not smaller than the ball diameter of {:.3} mm",
                d.name(&DEFECT.width),
                mm(g.ball_diameter)
            );
            d.log.error(
                problem(Kind::Geometry, &DEFECT.width, message)
                    .expected("a depth as well, since no ball spans this width"),
            );
            return;
        }
        DefectForm::Dent { shape: Shape::Cap, .. }
            if -defect.height(g) >= 0.5 * defect.width && defect.width > 0.0 =>
        {
            let message = format!("{} is not possible for a spherical cap", d.name(&DEFECT.depth));
            let most = format!("below half the width, {:.4} mm", mm(0.5 * defect.width));
            d.log.error(problem(Kind::Geometry, &DEFECT.depth, message).expected(most));
            return;
        }
        _ => {}
    }
    if defect.width > 0.0 && defect.width < SMALLEST_WIDTH * g.ball_diameter {
        let message = format!("{} is much narrower than a loaded contact", d.name(&DEFECT.width));
        let least = format!("{:.3} mm or more", mm(SMALLEST_WIDTH * g.ball_diameter));
        d.log.warn(
            Code::DefectGeometry,
            d.path.clone(),
            problem(Kind::Geometry, &DEFECT.width, message)
                .expected(least)
                .hint("check its unit; steps of a run become as short as the passage over it"),
        );
    }
    let (room, what) = match defect.surface {
        Surface::Ball(_) => (PI, "both races at once"),
        Surface::Inner | Surface::Outer => (TAU / g.balls as f64, "two balls at once"),
    };
    if angle > room {
        let message = format!("{} extends under {what}", d.name(&DEFECT.width));
        let spacing = format!("below {:.3} mm, one contact at a time", mm(room * radius));
        d.log.warn(
            Code::DefectGeometry,
            d.path.clone(),
            problem(Kind::Geometry, &DEFECT.width, message)
                .expected(spacing)
                .hint("the analysis continues; each contact follows its own path"),
        );
    }
    if let DefectForm::Dent { depth: Some(depth), .. } | DefectForm::Spall { depth, .. } = defect.form
        && defect.width > 0.0
        && depth > defect.max_depth(g)
    {
        let message = format!("{} is deeper than a ball can reach", d.name(&DEFECT.depth));
        let reach = format!("{:.4} um at most in an opening of this width", um(defect.max_depth(g)));
        d.log.warn(
            Code::DefectGeometry,
            d.path.clone(),
            problem(Kind::Geometry, &DEFECT.depth, message)
                .expected(reach)
                .hint("the analysis continues: the ball rests on the edges and does not touch the bottom"),
        );
    }
}
