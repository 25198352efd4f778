//! Figures of a bearing analysis: ball loads, contact angles, and sweeps over load, displacement, speed, cage
//! angle.

use super::display_unit::unit;
use super::{Named, TO_RPM};
use crate::{
    BallLoads, BallRow, BearingSection, Curve, Figure, FilmMap, Grid, GridPanel, GrooveSection, Lines,
};
use rotordyn_core::model::study::SweepVariable;
use rotordyn_core::results::{
    BallState, BearingPoint, BearingResult, BearingSweepResult, ContactState, EhlFilm,
};
use rotordyn_linalg::piecewise_within;

/// Cross-coupling stiffnesses below this fraction of √(k_ii k_jj) at all points are not drawn.
const MIN_COUPLING: f64 = 1e-6;
const AXES: [&str; 5] = ["x", "y", "z", "θx", "θy"];

/// All figures of a bearing; `title` is that of the model file.
pub fn figures(found: &BearingResult, title: &str) -> Vec<Named> {
    let name = |what: &str| format!("bearing_{}_{what}", found.name);
    let note = note(found, title);
    let mut figures = vec![
        (name("ball_loads"), Figure::BallLoads(ball_loads(found, &note))),
        (name("contact_angles"), Figure::Lines(contact_angles(found, &note))),
    ];
    figures.extend(section(found, &note).map(|section| (name("section"), Figure::BearingSection(section))));
    for sweep in found.sweeps.iter().filter(|sweep| sweep.points.len() > 1) {
        let over = sweep.of.name();
        for (what, grid) in [
            ("stiffness", stiffness(found, sweep)),
            ("displacement", displacement(found, sweep)),
            ("contacts", contacts(found, sweep)),
        ] {
            let grid = Grid { note: note.clone(), ..grid };
            figures.push((name(&format!("{what}_over_{over}")), Figure::Grid(grid)));
        }
        if sweep.of == SweepVariable::Load {
            figures.push((name("life_over_load"), Figure::Lines(life(found, sweep, &note))));
        }
    }
    figures.extend(
        found
            .films
            .iter()
            .map(|film| (name(&format!("film_{}", film.race)), Figure::FilmMap(film_map(found, film)))),
    );
    figures
}

/// Speed and load of the operating point, title of the model file.
pub(super) fn note(found: &BearingResult, title: &str) -> String {
    let state = &found.point.state;
    let [x, y, z, m_x, m_y] = state.load.map(|f| (10.0 * f).round() / 10.0 + 0.0);
    let moments =
        if m_x != 0.0 || m_y != 0.0 { format!(", moments {m_x}, {m_y} N·m") } else { String::new() };
    let rpm = state.condition.speed * TO_RPM;
    let estimated =
        if found.bearing.estimated_geometry.is_some() { ", estimated internal geometry" } else { "" };
    format!("{rpm:.0} rpm, load {x}, {y}, {z} N{moments}{estimated} ({title})")
}

fn film_map(found: &BearingResult, film: &EhlFilm) -> FilmMap {
    let fields = &film.solution;
    let scaled = |values: &[f64], factor: f64| values.iter().map(|v| factor * v).collect();
    FilmMap {
        title: format!("EHL film at the most loaded ball of bearing {}, {} race", found.name, film.race),
        note: format!(
            "{:.0} N, entrainment speed {:.2} m/s: central film {:.3} µm, minimum film {:.3} µm, {} iterations",
            film.load,
            film.speed,
            1e6 * fields.central_film,
            1e6 * fields.minimum_film,
            fields.iterations
        ),
        x: scaled(&fields.x, 1e3),
        y: scaled(&fields.y, 1e3),
        pressure: scaled(&fields.pressure, 1e-9),
        film: scaled(&fields.film, 1e6),
        central_film: 1e6 * fields.central_film,
    }
}

/// One race of one row.
struct RaceRow<'a> {
    name: String,
    balls: Vec<(&'a BallState, &'a ContactState)>,
}

/// Inner and outer race of every row.
fn race_rows(found: &BearingResult) -> Vec<RaceRow<'_>> {
    let balls = &found.point.balls;
    let rows = balls.iter().map(|b| b.row + 1).max().unwrap_or(0);
    let side = |row: usize, race: &str, pick: fn(&BallState) -> &ContactState| RaceRow {
        name: if rows > 1 { format!("row {}, {race} race", row + 1) } else { format!("{race} race") },
        balls: balls.iter().filter(|b| b.row == row).map(|b| (b, pick(b))).collect(),
    };
    (0..rows).flat_map(|row| [side(row, "inner", |b| &b.inner), side(row, "outer", |b| &b.outer)]).collect()
}

pub(super) fn ball_loads(found: &BearingResult, note: &str) -> BallLoads {
    let row = |side: RaceRow| {
        let most = side.balls.iter().map(|(_, c)| c.pressure).fold(0.0, f64::max);
        BallRow {
            note: format!("maximum contact pressure {:.2} GPa", 1e-9 * most),
            angle_deg: side.balls.iter().map(|(b, _)| b.position.to_degrees()).collect(),
            load: side.balls.iter().map(|(_, c)| c.load).collect(),
            radial_load: [found.point.state.load[0], found.point.state.load[1]],
            title: side.name,
        }
    };
    BallLoads {
        title: format!("Load distribution of bearing {}", found.name),
        note: note.into(),
        rows: race_rows(found).into_iter().map(row).collect(),
    }
}

/// Contact angles of the loaded balls over their position.
pub(super) fn contact_angles(found: &BearingResult, note: &str) -> Lines {
    let curve = |side: RaceRow| {
        let loaded = || side.balls.iter().filter(|(_, c)| c.load > 0.0);
        Curve {
            x: loaded().map(|(b, _)| b.position.to_degrees()).collect(),
            y: loaded().map(|(_, c)| c.angle.to_degrees()).collect(),
            points: true,
            label: side.name,
        }
    };
    let mut curves: Vec<Curve> = race_rows(found).into_iter().map(curve).collect();
    // Without ball inertia both contact angles of a ball are equal.
    if curves.chunks(2).all(|pair| pair[0].y == pair[pair.len() - 1].y) {
        curves = curves.into_iter().step_by(2).collect();
        curves.iter_mut().for_each(|c| c.label = c.label.replace("inner race", "both races"));
    }
    let angle = found.bearing.geometry.contact_angle;
    let nominal = match found.bearing.duplex {
        // Rows of a pair in opposite directions have their own signs.
        Some(_) => vec![angle, -angle],
        None => vec![angle * found.bearing.geometry.thrust_direction],
    };
    for (k, angle) in nominal.iter().enumerate().filter(|(k, angle)| *k == 0 || **angle != 0.0) {
        curves.push(Curve {
            x: vec![-180.0, 180.0],
            y: vec![angle.to_degrees(); 2],
            label: if k == 0 { "nominal contact angle".into() } else { "of the other direction".into() },
            ..Curve::default()
        });
    }
    Lines {
        title: format!("Contact angles of the loaded balls of bearing {}", found.name),
        note: note.into(),
        x_name: "ball position angle from x to y".into(),
        x_unit: "°".into(),
        y_name: "contact angle".into(),
        y_unit: "°".into(),
        curves,
        x_range: Some([-180.0, 180.0]),
        ..Lines::default()
    }
}

/// Section through the most heavily loaded ball; none without load.
pub(super) fn section(found: &BearingResult, note: &str) -> Option<BearingSection> {
    let g = &found.bearing.geometry;
    let load = |b: &BallState| b.inner.load.max(b.outer.load);
    let ball =
        found.point.balls.iter().max_by(|a, b| load(a).total_cmp(&load(b))).filter(|b| load(b) > 0.0)?;
    let groove = |contact: &ContactState, radius: f64, diameter: f64| GrooveSection {
        radius: 1e3 * radius,
        contact_angle: contact.angle,
        half_ellipse: contact.semi_major / radius,
        shoulder_angle: contact.shoulder.shoulder_angle,
        load: contact.load,
        ring_edge: 0.5e3 * (diameter - g.pitch_diameter),
    };
    let line = |race: &str, c: &ContactState| {
        let beyond = match c.shoulder.fraction_beyond > 0.0 {
            true => format!(", {:.0} % of it beyond the shoulder", 100.0 * c.shoulder.fraction_beyond),
            false => String::new(),
        };
        format!(
            "{race} race: {:.0} N at {:.2}°, ellipse to {:.1}°, shoulder at {:.1}°, distance {:.3} mm{beyond}",
            c.load,
            c.angle.to_degrees(),
            c.shoulder.ellipse_angle.to_degrees(),
            c.shoulder.shoulder_angle.to_degrees(),
            1e3 * c.shoulder.arc
        )
    };
    let free = found.point.mounted.free_contact_angle.to_degrees();
    Some(BearingSection {
        title: format!("Most heavily loaded ball of bearing {} in its grooves", found.name),
        note: note.into(),
        lines: vec![
            line("inner", &ball.inner),
            line("outer", &ball.outer),
            format!(
                "nominal contact angle {:.2}°, free contact angle as mounted {free:.2}°, ball at {:.1}° from x to y",
                g.contact_angle.to_degrees(),
                ball.position.to_degrees()
            ),
        ],
        ball_diameter: 1e3 * g.ball_diameter,
        width: 1e3 * g.width,
        nominal_angle: g.contact_angle.copysign(ball.outer.angle),
        inner: groove(&ball.inner, g.inner_groove_radius, g.bore),
        outer: groove(&ball.outer, g.outer_groove_radius, g.outside_diameter),
    })
}

/// A grid over a sweep, without panels.
pub(super) fn over(found: &BearingResult, sweep: &BearingSweepResult, title: &str) -> Grid {
    let at = &found.point.state;
    let (name, unit, factor) = abscissa(sweep);
    let operating = match sweep.of {
        SweepVariable::Speed => Some(at.condition.speed),
        SweepVariable::CageAngle => Some(at.condition.cage_angle),
        // The load sweep starts at zero: mark the operating load.
        SweepVariable::Load => crossing(sweep, found.point.largest_load()),
        SweepVariable::Displacement => None,
    };
    Grid {
        title: format!("{title} of bearing {} over {}", found.name, name),
        x_name: name,
        x_unit: unit.into(),
        columns: 3,
        mark: operating.map(|value| factor * value),
        ..Grid::default()
    }
}

/// Sweep value at which the maximum ball load equals that of the operating point.
fn crossing(sweep: &BearingSweepResult, load: f64) -> Option<f64> {
    let loads: Vec<f64> = sweep.points.iter().map(BearingPoint::largest_load).collect();
    let k = loads.windows(2).position(|w| w[0] < load && load <= w[1])?;
    let row = |k: usize| [loads[k], sweep.values[k]];
    piecewise_within(&[row(k), row(k + 1)], load).map(|[_, value]| value)
}

/// Name, unit and factor from SI of the swept quantity.
fn abscissa(sweep: &BearingSweepResult) -> (String, &'static str, f64) {
    match (sweep.of, sweep.unit.as_str()) {
        (SweepVariable::Speed, _) => ("shaft speed".into(), "rpm", TO_RPM),
        (SweepVariable::CageAngle, _) => ("cage angle".into(), "°", 1f64.to_degrees()),
        (_, "N m") => (sweep.label.clone(), "N·m", 1.0),
        (_, si) => (sweep.label.clone(), unit(si).name, unit(si).factor),
    }
}

pub(super) fn curve(sweep: &BearingSweepResult, value: impl Fn(&BearingPoint) -> f64) -> Curve {
    let factor = abscissa(sweep).2;
    Curve {
        x: sweep.values.iter().map(|v| factor * v).collect(),
        y: sweep.points.iter().map(value).collect(),
        ..Curve::default()
    }
}

pub(super) fn panel(name: &str, unit: &str, from_zero: bool, curves: Vec<Curve>) -> GridPanel {
    GridPanel { name: name.into(), unit: unit.into(), curves, from_zero, log_y: false }
}

/// The five diagonal stiffnesses and the non-zero cross-coupling stiffnesses.
fn stiffness(found: &BearingResult, sweep: &BearingSweepResult) -> Grid {
    // Unit and factor from SI.
    let shown = |a: usize, b: usize| match usize::from(a > 2) + usize::from(b > 2) {
        0 => ("kN/mm", 1e-6),
        1 => ("kN", 1e-3),
        _ => ("N·m", 1.0),
    };
    let share = |p: &BearingPoint, a: usize, b: usize| {
        let k = &p.state.stiffness;
        let size = (k[a][a] * k[b][b]).abs().sqrt();
        if size > 0.0 { k[a][b].abs() / size } else { 0.0 }
    };
    let mut cells: Vec<(usize, usize)> = (0..5).map(|a| (a, a)).collect();
    let pairs = (0..5).flat_map(|a| (a + 1..5).map(move |b| (a, b)));
    cells.extend(pairs.filter(|&(a, b)| sweep.points.iter().any(|p| share(p, a, b) > MIN_COUPLING)));
    let from_zero = matches!(sweep.of, SweepVariable::Load | SweepVariable::Displacement);
    let panels = cells.into_iter().map(|(a, b)| {
        let (unit, factor) = shown(a, b);
        let entry = curve(sweep, move |p| factor * p.state.stiffness[a][b]);
        panel(&format!("k {} {}", AXES[a], AXES[b]), unit, from_zero, vec![entry])
    });
    Grid { panels: panels.collect(), ..over(found, sweep, "Stiffness") }
}

fn displacement(found: &BearingResult, sweep: &BearingSweepResult) -> Grid {
    let motion = |k: usize| {
        let (name, unit, factor) = if k > 2 { ("tilt", "mrad", 1e3) } else { ("u", "µm", 1e6) };
        let along = curve(sweep, move |p| factor * p.state.displacement[k]);
        panel(&format!("{name} {}", AXES[k]), unit, false, vec![along])
    };
    let load = |k: usize| {
        let along = curve(sweep, move |p| p.state.load[k]);
        let name = ["F x", "F y", "F z", "M x", "M y"][k];
        panel(name, if k > 2 { "N·m" } else { "N" }, false, vec![along])
    };
    let constrained = |k: usize| sweep.points.iter().any(|p| p.state.condition.prescribed[k].is_some());
    let arm = 0.5 * found.bearing.geometry.pitch_diameter;
    let max_abs = |value: &dyn Fn(&BearingPoint) -> f64| {
        sweep.points.iter().map(|p| value(p).abs()).fold(0.0, f64::max)
    };
    // Quantities that are zero by symmetry, except for round-off, get no panel.
    let moves = |k: usize| max_abs(&|p| p.state.displacement[k]) * if k > 2 { arm } else { 1.0 } > 1e-13;
    let scaled_load = |k: usize| max_abs(&|p| p.state.load[k]) / if k > 2 { arm } else { 1.0 };
    let largest = (0..5).map(scaled_load).fold(0.0, f64::max);
    let mut panels: Vec<GridPanel> = (0..5).filter(|k| !constrained(*k) && moves(*k)).map(motion).collect();
    panels.extend((0..5).filter(|k| constrained(*k) && scaled_load(*k) > 1e-9 * largest).map(load));
    let stiffness = |what: usize| {
        let of = move |p: &BearingPoint| {
            1e-6 * if what == 0 { p.radial_stiffness[0] } else { p.axial_stiffness[0] }
        };
        panel(["radial stiffness", "axial stiffness"][what], "kN/mm", true, vec![curve(sweep, of)])
    };
    panels.push(stiffness(0));
    panels.push(stiffness(1));
    Grid { panels, ..over(found, sweep, "Displacement") }
}

/// Rating lives (ISO 281, ISO/TS 16281) in 10⁶ revolutions.
fn life(found: &BearingResult, sweep: &BearingSweepResult, note: &str) -> Lines {
    let of =
        |label: &str, value: fn(&BearingPoint) -> f64| Curve { label: label.into(), ..curve(sweep, value) };
    let mut curves = vec![
        of("basic L₁₀ (ISO 281)", |p| p.life.basic),
        of("reference L₁₀ᵣ (ISO/TS 16281)", |p| p.life.reference),
        of("modified Lₙₘᵣ", |p| p.life.modified),
    ];
    // Shown where ball inertia, film or the moment arm matter.
    let differs = |p: &BearingPoint| (p.life.by_ball_loads / p.life.reference - 1.0).abs() > 0.01;
    if sweep.points.iter().any(differs) {
        curves.insert(2, of("the same by the ball loads", |p| p.life.by_ball_loads));
    }
    curves.retain(|c| c.y.iter().any(|v| v.is_finite()));
    let (x_name, x_unit, _) = abscissa(sweep);
    Lines {
        title: format!("Rating life of bearing {}", found.name),
        note: note.into(),
        x_name,
        x_unit: x_unit.into(),
        y_name: "rating life".into(),
        y_unit: "10⁶ revolutions".into(),
        curves,
        log_y: true,
        ..Lines::default()
    }
}

/// Value at inner and outer race of the most loaded ball.
pub(super) fn of_most_loaded_ball(sweep: &BearingSweepResult, value: fn(&ContactState) -> f64) -> Vec<Curve> {
    type Pick = fn(&BallState) -> &ContactState;
    let races: [Pick; 2] = [|b| &b.inner, |b| &b.outer];
    let of = |pick: Pick| {
        curve(sweep, move |p| {
            let heaviest = p.balls.iter().max_by(|a, b| a.outer.load.total_cmp(&b.outer.load));
            heaviest.filter(|b| pick(b).load > 0.0).map_or(f64::NAN, |b| value(pick(b)))
        })
    };
    races.map(of).into()
}

fn contacts(found: &BearingResult, sweep: &BearingSweepResult) -> Grid {
    let of_most_loaded_ball = |value: fn(&ContactState) -> f64| of_most_loaded_ball(sweep, value);
    let mut panels = vec![
        panel("max ball load", "N", true, of_most_loaded_ball(|c| c.load)),
        panel("contact angle", "°", false, of_most_loaded_ball(|c| c.angle.to_degrees())),
        panel("contact pressure", "GPa", true, of_most_loaded_ball(|c| 1e-9 * c.pressure)),
        panel("loaded balls", "–", true, vec![curve(sweep, |p| p.loaded() as f64)]),
    ];
    if sweep.points.iter().any(|p| p.state.condition.speed != 0.0) {
        panels.push(panel("spin-to-roll ratio", "–", true, of_most_loaded_ball(|c| c.spin_to_roll)));
        panels.push(panel(
            "p v by sliding",
            "MW/m²",
            true,
            of_most_loaded_ball(|c| 1e-6 * c.pressure_velocity),
        ));
        panels.push(panel("friction torque", "N·m", true, vec![curve(sweep, |p| p.friction.total())]));
    }
    if sweep.points.iter().any(|p| p.minimum_film() > 0.0) {
        panels.push(panel("central film", "µm", true, of_most_loaded_ball(|c| 1e6 * c.film)));
        panels.push(panel("minimum film", "µm", true, of_most_loaded_ball(|c| 1e6 * c.minimum_film)));
        panels.push(panel("film ratio λ", "–", true, vec![curve(sweep, |p| p.film_ratio)]));
    }
    let legend = vec!["inner race".to_string(), "outer race".to_string()];
    Grid { panels, legend, ..over(found, sweep, "Contacts of the most loaded ball") }
}
