//! Accuracy of order cuts against computing time, of the points that `cargo bench --bench step_accuracy` leaves: a section of the
//! speed chapter.

use rotordyn_plot::{Curve, Figure, Lines};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The section, and its pictures by file name.
pub struct Section {
    pub text: String,
    pub pictures: Vec<(String, String)>,
}

/// A run with one integrator and step.
struct Point {
    variant: String,
    integrator: String,
    step_us: f64,
    seconds: f64,
    error_percent: f64,
}

/// Table and figure of each variant of the rig.
///
/// # Errors
/// A text that is not of the benchmark, or a figure that cannot be drawn.
pub fn section(points: &str) -> Result<Section, String> {
    let points = read(points)?;
    let mut variants: Vec<&str> = points.iter().map(|point| point.variant.as_str()).collect();
    variants.dedup();
    let mut text = String::from(
        "\n## Time steps\n\nThe run-up of the rig, 13 s, with each integrator and step: error of the worst of seven order cuts at \
         housing B (1x, 2x, BPFO, 7x, 2 BPFO, 8x, 9x; RMS over the run, against Newmark's method at 6.25 us), over the CPU time \
         of the run on one core, without output (`cargo bench --bench step_accuracy`). With fitted inertias the resonances \
         have their exact frequencies up to three steps a period, so that what is left is the error of the contacts; \
         the filter between steps and samples keeps what vibrates above the band of the record out of the cuts. The rig's model takes \
         125 us with them, with waviness 83 us; generalised-alpha stays the default of models that choose no integrator, since it damps what \
         a step does not resolve.\n\n",
    );
    let mut pictures = Vec::new();
    for variant in variants {
        let own: Vec<&Point> = points.iter().filter(|point| point.variant == variant).collect();
        let name = format!("step_accuracy_{variant}.svg");
        let _ = write!(
            text,
            "![Error of order cuts over CPU time, {variant} bearings](pictures/{name})\n\n*Rig with {variant} bearings.*\n\n\
             | integrator | step \\[us\\] | CPU \\[s\\] | worst error \\[%\\] |\n|---|---:|---:|---:|\n"
        );
        for point in &own {
            let Point { integrator, step_us, seconds, error_percent, .. } = point;
            let _ = writeln!(text, "| {integrator} | {step_us} | {seconds} | {error_percent:.3} |");
        }
        text.push('\n');
        pictures.push((name, picture(variant, &own)?));
    }
    Ok(Section { text, pictures })
}

fn read(text: &str) -> Result<Vec<Point>, String> {
    let file = "benches/step_accuracy.json";
    let value: Value = serde_json::from_str(text).map_err(|error| format!("{file}: {error}"))?;
    let point = |value: &Value| {
        let text = |name: &str| Some(value[name].as_str()?.to_string());
        Some(Point {
            variant: text("variant")?,
            integrator: text("integrator")?,
            step_us: value["step_us"].as_f64()?,
            seconds: value["cpu_s"].as_f64()?,
            error_percent: 100.0 * value["worst_error"].as_f64()?,
        })
    };
    let points = value.as_array().and_then(|points| points.iter().map(point).collect::<Option<Vec<_>>>());
    points.filter(|points| !points.is_empty()).ok_or_else(|| format!("{file} is not of the benchmark"))
}

fn picture(variant: &str, points: &[&Point]) -> Result<String, String> {
    let mut curves: BTreeMap<&str, Curve> = BTreeMap::new();
    for point in points {
        let label = point.integrator.clone();
        let curve = curves.entry(&point.integrator).or_insert_with(|| Curve {
            label,
            x: Vec::new(),
            y: Vec::new(),
            points: true,
        });
        curve.x.push(point.seconds);
        curve.y.push(point.error_percent);
    }
    let figure = Figure::Lines(Lines {
        title: "Error of order cuts over computing time".into(),
        note: format!("rig with {variant} bearings; steps grow from the right to the left"),
        x_name: "CPU time of the run".into(),
        x_unit: "s".into(),
        y_name: "worst error".into(),
        y_unit: "%".into(),
        curves: curves.into_values().collect(),
        log_x: true,
        log_y: true,
        ..Lines::default()
    });
    figure.svg().map_err(|error| format!("step_accuracy_{variant}: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_become_a_table_and_a_figure() {
        let point = |integrator: &str, step: f64| {
            format!(
                "{{\"variant\":\"wavy\",\"integrator\":\"{integrator}\",\"step_us\":{step},\"cpu_s\":{},\"worst_error\":0.0125}}",
                10.0 / step
            )
        };
        let found = section(&format!(
            "[{},{},{}]",
            point("newmark", 20.0),
            point("newmark", 40.0),
            point("rk4", 5.0)
        ))
        .unwrap();
        assert!(found.text.contains("| newmark | 20 | 0.5 | 1.250 |"), "{}", found.text);
        let [(name, svg)] = &found.pictures[..] else { panic!("one picture") };
        assert!(name == "step_accuracy_wavy.svg" && svg.contains("rk4"), "{name}");
        assert!(found.text.contains("pictures/step_accuracy_wavy.svg"));
        for wrong in ["", "[]", "{}", "[{\"variant\":\"a\"}]"] {
            assert!(section(wrong).is_err(), "{wrong}");
        }
    }
}
