//! Tables of the unbalance response: separation margins, bearing forces, loads along the shaft.

use rotordyn::analysis::shaft_loads::ShaftAmplitude;
use rotordyn::results::UnbalanceResult;

use super::terminal::{Terminal, number, rpm};

/// Critical speeds with amplification factor, log decrement and separation margins after API 617.
pub fn margins(terminal: &Terminal, found: &UnbalanceResult) {
    if found.margins.is_empty() {
        return;
    }
    let text = |value: Option<f64>, digits: usize| match value {
        None => "-".into(),
        Some(value) if value.is_infinite() => "infinite".into(),
        Some(value) => format!("{value:.digits$}"),
    };
    let percent = |value: Option<f64>| text(value.map(|v| 100.0 * v), 1);
    let rows: Vec<Vec<String>> = found
        .margins
        .iter()
        .map(|m| {
            vec![
                format!("{:.1}", rpm(m.speed)),
                m.label.clone(),
                format!("{:.4}", m.log_decrement),
                text(m.peak.map(rpm), 1),
                text(m.amplification, 2),
                percent(m.available),
                percent(m.required),
                m.assessment.name().into(),
            ]
        })
        .collect();
    let header =
        ["critical rpm", "mode", "log dec", "peak rpm", "AF", "margin %", "required %", "assessment"];
    terminal.table("Critical speeds: separation margins after API 617", &header, &rows);
    let operating = match found.operating_speeds.map(|speeds| speeds.map(rpm)) {
        Some([low, high]) if low == high => format!("margins from {high:.0} rpm"),
        Some([low, high]) => format!("margins from {low:.0} to {high:.0} rpm"),
        None => "no operating speed: give --speed-range or study.unbalance.operating_speeds".into(),
    };
    let largest = "AF: the largest of the responses; below 2.5 the mode is critically damped";
    terminal.print(&format!("  {operating}; {largest}"));
}

/// Largest dynamic force of every bearing; infinite at undamped modes.
pub fn bearing_forces(terminal: &Terminal, found: &UnbalanceResult) {
    let speeds = &found.speeds;
    let undamped: Vec<String> = found.undamped.iter().map(|peak| format!("{:.1}", rpm(peak.at))).collect();
    let infinite = undamped.join(", ");
    let rows: Vec<Vec<String>> = found
        .bearing_forces
        .iter()
        .filter_map(|bearing| {
            let k = bearing.largest()?;
            let [x, y] = bearing.components(k);
            let mut row = vec![bearing.name.clone()];
            if bearing.amplitude(k) > 0.0 && !infinite.is_empty() {
                row.push(infinite.clone());
                row.extend(["infinite"; 3].map(String::from));
            } else {
                row.push(format!("{:.1}", rpm(speeds[k])));
                row.extend([x, y, bearing.amplitude(k)].map(|force| number(force, 4)));
            }
            row.extend(bearing.at_rest.map(|force| number(force, 4)));
            Some(row)
        })
        .collect();
    let header = ["bearing", "at rpm", "|F_x| N", "|F_y| N", "largest N", "static F_x N", "static F_y N"];
    if !rows.is_empty() {
        terminal.table("Bearing forces under unbalance: the largest over speed", &header, &rows);
    }
}

/// Where along the shaft deflection, shear force and bending moment are largest, and where they are infinite.
pub fn shaft(terminal: &Terminal, found: &UnbalanceResult) {
    let at = |largest: Option<(&ShaftAmplitude, f64)>, factor: f64| {
        largest.map_or("-".into(), |(p, v)| format!("{} at {:.1}", number(factor * v, 4), 1e3 * p.z))
    };
    let infinite = found.undamped.iter().map(|peak| {
        let cells = [format!("{:.1}", rpm(peak.at)), format!("{}, undamped", peak.label)];
        cells.into_iter().chain(["infinite"; 3].map(String::from)).collect()
    });
    let shaft = found.shaft.iter().map(|shaft| {
        vec![
            format!("{:.1}", rpm(shaft.speed)),
            shaft.reason.clone(),
            at(ShaftAmplitude::largest(&shaft.points, |p| p.displacement), 1e6),
            at(ShaftAmplitude::largest(&shaft.points, |p| p.shear), 1.0),
            at(ShaftAmplitude::largest(&shaft.points, |p| p.moment), 1.0),
        ]
    });
    let rows: Vec<Vec<String>> = infinite.chain(shaft).collect();
    let header = ["rpm", "", "deflection um at z mm", "shear N at z mm", "bending moment N m at z mm"];
    if !found.shaft.is_empty() {
        terminal.table("Shaft under unbalance: largest amplitudes along it", &header, &rows);
    }
}
