//! Tables of ball motion, friction, mounted geometry and shoulder distances of a ball bearing.

use rotordyn::contact::Race;
use rotordyn::results::{BearingPoint, BearingResult, PickContact};

use super::terminal::{Terminal, number, rpm};

pub fn print(terminal: &Terminal, found: &BearingResult) {
    geometry(terminal, found);
    let point = &found.point;
    if point.loaded() == 0 {
        return;
    }
    shoulders(terminal, found);
    if point.state.condition.speed == 0.0 {
        return;
    }
    let rows: Vec<Vec<String>> = point
        .balls
        .iter()
        .enumerate()
        .filter_map(|(j, ball)| {
            let motion = &ball.motion;
            let control = motion.control?;
            let (i, o) = (&ball.inner, &ball.outer);
            let mut row = vec![
                ball_number(point, j),
                format!("{:.1}", ball.position.to_degrees()),
                format!("{:.0}", rpm(motion.orbital_speed)),
                format!("{:.0}", rpm(motion.ball_speed)),
                format!("{:.2}", motion.pitch_angle.to_degrees()),
                if control == Race::Outer { "outer" } else { "inner" }.to_string(),
                number(motion.control_ratio, 3),
            ];
            row.extend([i, o].map(|c| format!("{:.4}", c.spin_to_roll)));
            row.extend([i, o].map(|c| number(1e-6 * c.pressure_velocity, 3)));
            row.push(format!("{:.3}", ball.advance.to_degrees()));
            Some(row)
        })
        .collect();
    if !rows.is_empty() {
        let header = [
            "ball",
            "at deg",
            "orbit rpm",
            "ball rpm",
            "beta deg",
            "control",
            "ratio",
            "spin/roll i",
            "o",
            "pv i MW/m2",
            "o",
            "advance deg",
        ];
        let title = "Motion of the loaded balls; controlling race, and the ratio above 1 at which the outer race controls";
        terminal.table(title, &header, &rows);
    }
    let friction = &point.friction;
    let viscous = match found.bearing.lubricant() {
        Some(_) => format!(
            ", viscous part {} N m (f_0 {}, {})",
            number(friction.viscous, 3),
            number(friction.viscous_factor, 3),
            found.bearing.service.lubrication
        ),
        None => ", no viscous part without a lubricant".to_string(),
    };
    let sliding = number(friction.sliding_friction, 3);
    terminal.print_wrapped(&format!(
        "friction torque (Palmgren) {} N m, heat {} W: load part {} N m (f_1 {}){viscous}, spinning of the balls {} N m \
         (sliding friction {sliding})",
        number(friction.total(), 3),
        number(friction.heat, 3),
        number(friction.load, 3),
        number(friction.load_factor, 3),
        number(friction.spin, 3),
    ));
}

fn geometry(terminal: &Terminal, found: &BearingResult) {
    let mounted = &found.point.mounted;
    let mut line = format!(
        "  as mounted at this speed: radial clearance {:.1} um, free contact angle {:.2} deg",
        1e6 * mounted.radial_clearance,
        mounted.free_contact_angle.to_degrees()
    );
    if mounted.axial_clearance > 0.0 {
        line += &format!(", axial clearance {:.1} um", 1e6 * mounted.axial_clearance);
    }
    terminal.print(&line);
}

/// The contact of each race that is nearest to its shoulder.
fn shoulders(terminal: &Terminal, found: &BearingResult) {
    let given = found.bearing.service.shoulder_diameters;
    let races: [(&str, PickContact, bool); 2] =
        [("inner", |b| &b.inner, given[0].is_some()), ("outer", |b| &b.outer, given[1].is_some())];
    for (race, pick, is_given) in races {
        let loaded = found.point.balls.iter().map(pick).filter(|c| c.load > 0.0);
        let Some(nearest) = loaded.min_by(|a, b| a.shoulder.arc.total_cmp(&b.shoulder.arc)) else { continue };
        let margin = &nearest.shoulder;
        let mut line = format!(
            "  {race} shoulder at {:.1} deg ({}), contact ellipse up to {:.1} deg, {:.3} mm from it",
            margin.shoulder_angle.to_degrees(),
            if is_given { "as given" } else { "by rule" },
            margin.ellipse_angle.to_degrees(),
            1e3 * margin.arc
        );
        if margin.fraction_beyond > 0.0 {
            line += &format!(": {:.0} % beyond it", 100.0 * margin.fraction_beyond);
        }
        terminal.print(&line);
    }
}

/// Number of ball `j` from 1; in a pair with the number of its row.
pub fn ball_number(point: &BearingPoint, j: usize) -> String {
    let per_row = point.balls.iter().filter(|other| other.row == 0).count().max(1);
    match point.balls.iter().any(|other| other.row > 0) {
        true => format!("{}.{}", point.balls[j].row + 1, j % per_row + 1),
        false => (j + 1).to_string(),
    }
}
