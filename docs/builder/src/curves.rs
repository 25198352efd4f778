//! Curves of the tests laid over their references, as figures of the validation chapter.

use rotordyn_plot::{Curve, Figure, Lines};
use serde_json::Value;

/// Most points of a reference that are marked.
const MARKED: usize = 40;
/// Ratio of largest and smallest value from which an axis of positive values is logarithmic.
const DECADES: f64 = 1e3;

/// A curve of a test and its reference over the same values.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Line of the test's source.
    pub line: usize,
    pub quantity: String,
    unit: String,
    over: [String; 2],
    x: Vec<f64>,
    ours: Vec<f64>,
    reference: Vec<f64>,
}

impl Compared {
    /// From the line that `tests/common/agree.rs` writes; `None` if it is none.
    pub fn read(line: &str) -> Option<Self> {
        let value: Value = serde_json::from_str(line).ok()?;
        let text = |name: &str| value[name].as_str().map(String::from);
        let list =
            |name: &str| value[name].as_array()?.iter().map(Value::as_f64).collect::<Option<Vec<f64>>>();
        let found = Self {
            line: value["line"].as_u64()? as usize,
            quantity: text("quantity")?,
            unit: text("unit")?,
            over: [text("over")?, text("over_unit")?],
            x: list("x")?,
            ours: list("ours")?,
            reference: list("reference")?,
        };
        let count = found.x.len();
        (count > 0 && found.ours.len() == count && found.reference.len() == count).then_some(found)
    }

    /// The figure as an SVG document: ours as a line, the reference as points over it.
    ///
    /// # Errors
    /// The figure cannot be drawn.
    pub fn svg(&self) -> Result<String, String> {
        let step = self.x.len().div_ceil(MARKED);
        let every = |values: &[f64]| values.iter().copied().step_by(step).collect::<Vec<f64>>();
        let spans = |values: &[f64]| {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let most = values.iter().copied().fold(0.0, f64::max);
            least > 0.0 && most > DECADES * least
        };
        let label = match step {
            1 => "reference".to_string(),
            _ => format!("reference, one point of {step}"),
        };
        let unit = |unit: &str| if unit == "1" { "–".to_string() } else { unit.to_string() };
        let figure = Figure::Lines(Lines {
            title: self.quantity.clone(),
            x_name: self.over[0].clone(),
            x_unit: unit(&self.over[1]),
            y_name: "value".into(),
            y_unit: unit(&self.unit),
            curves: vec![
                Curve { label: "ours".into(), x: self.x.clone(), y: self.ours.clone(), points: false },
                Curve { label, x: every(&self.x), y: every(&self.reference), points: true },
            ],
            log_x: spans(&self.x),
            log_y: spans(&self.reference) && spans(&self.ours),
            ..Lines::default()
        });
        figure.svg().map_err(|error| format!("{}: {error}", self.quantity))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_becomes_a_figure_with_both_curves() {
        let line = |x: &str| {
            format!(
                "{{\"line\":7,\"quantity\":\"sag\",\"unit\":\"m\",\"over\":\"z\",\"over_unit\":\"m\",\"x\":{x},\"ours\":[1,2,3e0],\
                 \"reference\":[1,2,3.1]}}"
            )
        };
        let found = Compared::read(&line("[0,1,2]")).unwrap();
        let svg = found.svg().unwrap();
        assert_eq!(svg, found.svg().unwrap());
        for word in ["sag", "ours", "reference", "z [m]", "value [m]"] {
            assert!(svg.contains(word), "{word}: {svg}");
        }
        assert!(Compared::read(&line("[0,1]")).is_none());
        assert!(Compared::read("{}").is_none());
    }
}
