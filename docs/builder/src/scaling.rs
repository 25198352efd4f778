//! Computing time and memory over the size of the model, of the points that `benches/scaling.py` leaves: a section of the speed
//! chapter.

use super::step_accuracy::Section;
use rotordyn_plot::{Curve, Figure, Lines};
use serde_json::Value;
use std::fmt::Write;

const FILE: &str = "benches/scaling.json";

/// A figure's quantity of a point.
type Quantity = fn(&Point) -> f64;

/// A command at one size of what grows.
struct Point {
    grows: String,
    command: String,
    size: f64,
    seconds: f64,
    megabytes: f64,
}

/// For all that grows: a table of each command at its largest size, and figures of time and memory.
///
/// # Errors
/// A text that is not of the script, or a figure that cannot be drawn.
pub fn section(points: &str) -> Result<Section, String> {
    let points = read(points)?;
    let mut text = String::from(
        "\n## Size of the model\n\nCPU time and peak memory of whole commands on one thread, without figures, start included \
         (`python3 benches/scaling.py`): the rotor of 40 elements with finer meshes and more speeds, the rig with more balls and \
         longer run-ups. Of a growth as a power of the size, *p* is the exponent over the last four sizes: 1 is linear. Meshes from \
         about 1000 elements on take more than in proportion, since the condition of their stiffness makes every \
         solution need corrections by residuals in twice the working precision (`refinement.rs`).\n\n",
    );
    let mut pictures = Vec::new();
    for own in points.chunk_by(|a, b| a.grows == b.grows) {
        let grows = &own[0].grows;
        let name = grows.replace(' ', "_");
        let _ = writeln!(
            text,
            "![CPU time over {grows}](pictures/scaling_{name}_time.svg) \
             ![Memory over {grows}](pictures/scaling_{name}_memory.svg)\n\n\
             | command | {grows} | CPU \\[s\\] | *p* | memory \\[MB\\] | *p* |\n|---|---:|---:|---:|---:|---:|"
        );
        for command in own.chunk_by(|a, b| a.command == b.command) {
            let last = &command[command.len() - 1];
            let exponent = |of: Quantity| growth(command, of);
            let _ = writeln!(
                text,
                "| {} | {} | {:.2} | {:.1} | {:.0} | {:.1} |",
                last.command,
                last.size,
                last.seconds,
                exponent(|p| p.seconds),
                last.megabytes,
                exponent(|p| p.megabytes)
            );
        }
        text.push('\n');
        let quantities: [(&str, &str, &str, Quantity); 2] =
            [("time", "CPU time", "s", |p| p.seconds), ("memory", "peak memory", "MB", |p| p.megabytes)];
        for (file, quantity, unit, of) in quantities {
            let picture = format!("scaling_{name}_{file}.svg");
            let svg = picture_of(own, quantity, unit, of).map_err(|error| format!("{picture}: {error}"))?;
            pictures.push((picture, svg));
        }
    }
    Ok(Section { text, pictures })
}

/// Slope of the logarithm over that of the size, least squares over the last four sizes.
fn growth(points: &[Point], of: Quantity) -> f64 {
    let last = &points[points.len().saturating_sub(4)..];
    let pairs: Vec<[f64; 2]> = last.iter().map(|p| [p.size.ln(), of(p).ln()]).collect();
    let mean = |of: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(of).sum::<f64>() / pairs.len() as f64;
    let [x, y] = [mean(&|p| p[0]), mean(&|p| p[1])];
    mean(&|p| (p[0] - x) * (p[1] - y)) / mean(&|p| (p[0] - x).powi(2))
}

fn picture_of(points: &[Point], quantity: &str, unit: &str, of: Quantity) -> Result<String, String> {
    let curves = points.chunk_by(|a, b| a.command == b.command).map(|own| Curve {
        label: own[0].command.clone(),
        x: own.iter().map(|p| p.size).collect(),
        y: own.iter().map(of).collect(),
        points: true,
    });
    let figure = Figure::Lines(Lines {
        title: format!("Growth over {}", points[0].grows),
        x_name: points[0].grows.clone(),
        y_name: quantity.into(),
        y_unit: unit.into(),
        curves: curves.collect(),
        log_x: true,
        log_y: true,
        ..Lines::default()
    });
    figure.svg().map_err(|error| error.to_string())
}

fn read(text: &str) -> Result<Vec<Point>, String> {
    let value: Value = serde_json::from_str(text).map_err(|error| format!("{FILE}: {error}"))?;
    let point = |value: &Value| {
        let text = |name: &str| Some(value[name].as_str()?.to_string());
        let positive = |name: &str| value[name].as_f64().filter(|v| *v > 0.0);
        Some(Point {
            grows: text("grows")?,
            command: text("command")?,
            size: positive("size")?,
            seconds: positive("cpu_s")?,
            megabytes: positive("memory_mb")?,
        })
    };
    let points = value.as_array().and_then(|points| points.iter().map(point).collect::<Option<Vec<_>>>());
    points.filter(|points| !points.is_empty()).ok_or_else(|| format!("{FILE} is not of benches/scaling.py"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// CPU = 0.01 n², memory 20 √n: exponents 2 and 0.5.
    #[test]
    fn points_become_tables_and_figures() {
        let point = |command: &str, n: f64| {
            format!(
                "{{\"grows\":\"balls of all\",\"command\":\"{command}\",\"size\":{n},\"cpu_s\":{},\"memory_mb\":{}}}",
                0.01 * n * n,
                20.0 * n.sqrt()
            )
        };
        let of = |command: &str| [4.0, 8.0, 16.0, 32.0, 64.0].map(|n| point(command, n)).join(",");
        let found = section(&format!("[{},{}]", of("modal"), of("run-up"))).unwrap();
        assert!(found.text.contains("| run-up | 64 | 40.96 | 2.0 | 160 | 0.5 |"), "{}", found.text);
        let names: Vec<&str> = found.pictures.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["scaling_balls_of_all_time.svg", "scaling_balls_of_all_memory.svg"]);
        assert!(names.iter().all(|name| found.text.contains(&format!("pictures/{name}"))));
        assert!(found.pictures.iter().all(|(_, svg)| svg.contains("modal") && svg.contains("run-up")));
        for wrong in ["", "[]", "{}", "[{\"grows\":\"a\"}]"] {
            assert!(section(wrong).is_err(), "{wrong}");
        }
    }
}
