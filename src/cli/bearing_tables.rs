//! Tables of a ball bearing analysis.

use super::ball_motion_tables::ball_number;
use rotordyn::bearing::life::hours;
use rotordyn::bearing::{BallInertia, LimitCheck, Preload};
use rotordyn::model::study::{DOF_NAMES, SweepVariable};
use rotordyn::results::{BearingPoint, BearingResult, BearingSweepResult};

use super::ball_motion_tables as ball_motion;
use super::equilibrium_loads::stated;
use super::terminal::{Terminal, number, rpm, table};

/// Rows printed of a sweep; results.h5 contains all points.
const MAX_SWEEP_ROWS: usize = 6;

pub fn bearing(terminal: &Terminal, found: &BearingResult) {
    let point = &found.point;
    let state = &point.state;
    let constrained: Vec<&str> =
        DOF_NAMES.iter().zip(found.prescribed).filter(|(_, held)| *held).map(|(name, _)| *name).collect();
    terminal.heading(&format!("Bearing {} at {:.0} rpm", found.name, rpm(state.condition.speed)));
    terminal.print(&format!("  load by the shaft: {}", found.load_source));
    if !constrained.is_empty() {
        terminal.print(&format!("  constrained DOFs: {}", constrained.join(", ")));
    }
    if let Some(how) = &found.bearing.estimated_geometry {
        terminal.print_wrapped(&format!("internal geometry {how}"));
    }
    let imperfections = &found.bearing.imperfections;
    if !imperfections.is_empty() {
        terminal.print(&format!("  imperfections of races and balls: {}", imperfections.condition()));
    }
    terminal.print(&format!("  {}", found.ball_inertia.sentence()));
    let inertia = found.ball_inertia.inertia;
    let reason = match inertia {
        BallInertia::Auto(Some(decision)) if decision.on => {
            "; the default, since at speed the centrifugal force gives the outer contact the larger load and friction"
        }
        _ => "",
    };
    terminal.print_wrapped(&format!("control hypothesis: {}{reason}", inertia.hypothesis()));
    let arm = 0.5 * found.bearing.geometry.pitch_diameter;
    let size = |a: usize| if a > 2 { arm } else { 1.0 };
    let largest = (0..5).map(|a| (state.load[a] / size(a)).abs()).fold(0.0, f64::max);
    let rows: Vec<Vec<String>> = (0..5)
        .map(|a| {
            let (unit, factor) = if a > 2 { ("mrad", 1e3) } else { ("um", 1e6) };
            let k = &state.stiffness;
            let mut row = vec![
                DOF_NAMES[a].to_string(),
                number(zero_roundoff(state.load[a], largest * size(a)), 4),
                if a > 2 { "N m" } else { "N" }.to_string(),
                fixed_decimals(factor * state.displacement[a], 3),
                unit.to_string(),
            ];
            row.extend((0..5).map(|b| number(zero_roundoff(k[a][b], (k[a][a] * k[b][b]).abs().sqrt()), 4)));
            row
        })
        .collect();
    let header = ["DOF", "load", "", "displacement", "", "K: x", "y", "z", "theta_x", "theta_y"];
    terminal.print(table(&header, &rows).trim_end());
    let [[radial, radial_constrained], [axial, axial_constrained]] =
        [point.radial_stiffness, point.axial_stiffness];
    for (way, [free, all]) in
        [("radial", [radial, radial_constrained]), ("axial", [axial, axial_constrained])]
    {
        terminal.print(&format!(
            "  {way} stiffness {} N/m with the unconstrained DOFs free, {} N/m with all other DOFs fixed",
            number(free, 4),
            number(all, 4)
        ));
    }
    if found.bearing.preload != Preload::None {
        terminal.print_wrapped(&format!(
            "preload {}: with centred rings at this speed {} N axial, ring offset {:.3} um from the nominal position",
            stated(&found.bearing.preload),
            number(found.preload.axial_force, 4),
            1e6 * found.preload.offset
        ));
    }
    if let Some(mounted) = &found.mounted_preload {
        let rows: Vec<String> = mounted.rows.iter().map(|force| number(*force, 4)).collect();
        let of = if rows.len() > 1 { " of every row" } else { "" };
        terminal.print(&format!("  axial force{of} in the machine at this speed: {} N", rows.join(", ")));
    }
    balls(terminal, point);
    ball_motion::print(terminal, found);
    frequencies(terminal, found);
    life(terminal, found);
    limits(terminal, found);
    let speed_dependent = found.bearing.depends_on_speed() || found.bearing.lubricant().is_some();
    if !speed_dependent && !found.sweeps.iter().any(|s| s.of == SweepVariable::Speed) {
        terminal
            .print("\n  No speed sweep: without film and ball inertia the bearing does not depend on speed.");
    }
    for sweep in &found.sweeps {
        sweep_table(terminal, found, sweep);
    }
}

/// The value, or 0 if it is below round-off of `size`.
fn zero_roundoff(value: f64, size: f64) -> f64 {
    if value.abs() < 1e-9 * size { 0.0 } else { value }
}

/// Fixed number of decimals, without a negative zero.
fn fixed_decimals(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| matches!(b, b'0' | b'.')) => rest.into(),
        _ => text,
    }
}

fn balls(terminal: &Terminal, point: &BearingPoint) {
    let with_film = point.minimum_film() > 0.0;
    let rows: Vec<Vec<String>> = point
        .balls
        .iter()
        .enumerate()
        .filter(|(_, ball)| ball.outer.load > 0.0)
        .map(|(j, ball)| {
            let (i, o) = (&ball.inner, &ball.outer);
            let mut row = vec![ball_number(point, j), format!("{:.1}", ball.position.to_degrees())];
            row.extend([i, o].map(|c| number(c.load, 4)));
            row.extend([i, o].map(|c| format!("{:.2}", c.angle.to_degrees())));
            row.extend([i, o].map(|c| format!("{:.3}", 1e-9 * c.pressure)));
            row.extend([i, o].map(|c| format!("{:.0} x {:.0}", 1e6 * c.semi_major, 1e6 * c.semi_minor)));
            if with_film {
                row.extend([i, o].map(|c| format!("{:.3}", 1e6 * c.film)));
            }
            row
        })
        .collect();
    if rows.is_empty() {
        return;
    }
    let mut header = vec![
        "ball",
        "position deg",
        "Q_i N",
        "Q_o N",
        "a_i deg",
        "a_o deg",
        "p_i GPa",
        "p_o GPa",
        "ellipse_i um",
        "ellipse_o um",
    ];
    if with_film {
        header.extend(["h_i um", "h_o um"]);
    }
    let held = match point.held_by_centrifugal_force() {
        0 => String::new(),
        count => format!("; {count} more held on the outer race by centrifugal force"),
    };
    let (loaded, all) = (point.loaded(), point.balls.len());
    let title = format!("Loaded balls ({loaded} of {all}{held}), contact ellipse semi-axes");
    terminal.table(&title, &header, &rows);
    if with_film {
        terminal.print(&format!(
            "  minimum film thickness {:.3} um, film ratio lambda {:.2}",
            1e6 * point.minimum_film(),
            point.film_ratio
        ));
    }
}

fn frequencies(terminal: &Terminal, found: &BearingResult) {
    let turns = found.point.state.condition.speed / std::f64::consts::TAU;
    let (nominal, loaded) = (&found.nominal_orders, &found.point.orders);
    let rows: Vec<Vec<String>> = [
        ("FTF (cage)", nominal.ftf, loaded.ftf),
        ("BPFO (outer race)", nominal.bpfo, loaded.bpfo),
        ("BPFI (inner race)", nominal.bpfi, loaded.bpfi),
        ("BSF (ball spin)", nominal.bsf, loaded.bsf),
    ]
    .iter()
    .map(|(name, nominal, loaded)| {
        let mut row = vec![(*name).to_string()];
        row.extend([nominal, loaded].map(|order| format!("{order:.4}")));
        row.extend([nominal, loaded].map(|order| format!("{:.3}", order * turns)));
        row
    })
    .collect();
    let header = ["", "order, nominal", "order, loaded", "Hz, nominal", "Hz, loaded"];
    terminal.table("Bearing defect frequencies at the nominal and the loaded contact angle", &header, &rows);
}

fn life(terminal: &Terminal, found: &BearingResult) {
    let (life, speed) = (&found.point.life, found.point.state.condition.speed);
    let service = &found.bearing.service;
    let modified = format!("modified L_nmr at {} % (a_ISO)", number(100.0 * service.reliability, 3));
    let rows: Vec<Vec<String>> = [
        ("basic L_10 (ISO 281)", life.basic),
        ("reference L_10r (load distribution of ISO/TS 16281)", life.reference),
        ("the same by the ball loads above", life.by_ball_loads),
        (modified.as_str(), life.modified),
    ]
    .iter()
    .filter(|(_, life)| life.is_finite())
    .map(|(name, life)| {
        let time = if speed == 0.0 { "-".into() } else { number(hours(*life, speed), 4) };
        vec![(*name).to_string(), number(*life, 4), time]
    })
    .collect();
    if !rows.is_empty() {
        terminal.table("Rating life", &["", "10^6 revolutions", "hours"], &rows);
    }
    let r = &found.rating;
    let given = [service.dynamic_rating, service.static_rating, service.fatigue_limit].map(|x| x.is_some());
    let source = |given: bool| if given { "as given" } else { "from the internal geometry" };
    let values = [r.dynamic, r.static_rating, r.fatigue].map(|f| number(f, 4));
    let ratings: Vec<String> = (0..3)
        .map(|k| {
            // A source is said once for ratings that share it with the next.
            let same = given.get(k + 1) == Some(&given[k]);
            let source = if same { String::new() } else { format!(" ({})", source(given[k])) };
            format!("{} {} N{source}", ["C", "C_0", "C_u"][k], values[k])
        })
        .collect();
    let pair = if found.bearing.duplex.is_some() { " of the pair" } else { "" };
    terminal.print(&format!("  ratings{pair}: {}", ratings.join(", ")));
    if life.equivalent_load.is_finite() {
        let [x, y, e] = life.factors;
        terminal.print(&format!(
            "  equivalent loads: P {} N (X {}, Y {}, e {}), static P_0 {} N{}",
            number(life.equivalent_load, 4),
            number(x, 3),
            number(y, 3),
            number(e, 3),
            number(life.static_load, 4),
            match life.static_safety.is_finite() {
                true => format!(", static safety s_0 = C_0/P_0 = {}", number(life.static_safety, 3)),
                false => String::new(),
            }
        ));
    }
    if life.viscosity_ratio.is_finite() {
        let mut line = format!(
            "  a_ISO {}: kappa {:.2} (nu_1 {} mm2/s), e_C {}",
            if life.modification.is_finite() { number(life.modification, 3) } else { "none".into() },
            life.viscosity_ratio,
            number(1e6 * life.reference_viscosity, 3),
            number(life.contamination, 2)
        );
        if life.reference_load.is_finite() {
            line += &format!(", C_u/P_ref {}", number(r.fatigue / life.reference_load, 3));
        }
        terminal.print(&line);
    }
}

/// The limits that apply, exceeded or not; what each says is in the results file and on the report page.
fn limits(terminal: &Terminal, found: &BearingResult) {
    let row = |check: &LimitCheck| {
        let (unit, factor) = match check.unit.as_str() {
            "Pa" => ("GPa", 1e-9),
            "m" => ("mm", 1e3),
            "rad" => ("deg", 1f64.to_degrees()),
            "1" => ("", 1.0),
            other => (other, 1.0),
        };
        let side = if check.is_least { ">=" } else { "<=" };
        vec![
            check.quantity.clone(),
            number(factor * check.value, 4),
            format!("{side} {}", number(factor * check.limit, 4)),
            unit.to_string(),
            check.state.name().to_string(),
        ]
    };
    let rows: Vec<Vec<String>> = found.limits.iter().map(row).collect();
    terminal.table("Limits", &["", "value", "limit", "unit", ""], &rows);
}

fn sweep_table(terminal: &Terminal, found: &BearingResult, sweep: &BearingSweepResult) {
    let n = sweep.points.len();
    if n == 0 {
        return;
    }
    let (name, unit, factor) = match (sweep.of, sweep.unit.as_str()) {
        (SweepVariable::Speed, _) => ("speed".to_string(), "rpm", 60.0 / std::f64::consts::TAU),
        (SweepVariable::CageAngle, _) => ("cage angle".to_string(), "deg", 1f64.to_degrees()),
        (_, "m") => (sweep.label.clone(), "um", 1e6),
        (_, "rad") => (sweep.label.clone(), "mrad", 1e3),
        (_, unit) => (sweep.label.clone(), unit, 1.0),
    };
    let shown = MAX_SWEEP_ROWS.min(n);
    let rows: Vec<Vec<String>> = (0..shown)
        .map(|k| if shown > 1 { k * (n - 1) / (shown - 1) } else { 0 })
        .map(|k| {
            let (value, p) = (sweep.values[k], &sweep.points[k]);
            let d = &p.state.displacement;
            let mut row = vec![number(factor * value, 4)];
            row.extend(d[..3].iter().map(|d| fixed_decimals(1e6 * d, 2)));
            row.push(number(p.radial_stiffness[0], 4));
            row.push(number(p.axial_stiffness[0], 4));
            row.extend((3..5).map(|a| number(p.state.stiffness[a][a], 4)));
            row.push(number(p.largest_load(), 4));
            row.push(format!("{:.3}", 1e-9 * p.largest_pressure()));
            row.push(p.loaded().to_string());
            row
        })
        .collect();
    let header = [
        unit,
        "u_x um",
        "u_y um",
        "u_z um",
        "k_radial",
        "k_axial",
        "k_tilt,x",
        "k_tilt,y",
        "Q_max N",
        "p_max GPa",
        "loaded balls",
    ];
    terminal.table(&format!("Sweep of bearing {} over {name}, {n} points", found.name), &header, &rows);
}
