//! Parameter of a bifurcation diagram: its paths and values.

use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Count, Key, Special, SubTable, Texts, count, keys, special, sub_table, texts};
use crate::file::reader::Reader;
use crate::file::renamed::{self, renamed_path};
use crate::file::tree::{Node, Value};
use crate::study::Parameter;
use rotordyn_units::leading_number;

keys! {
    /// Parameter of `[study.bifurcation]`.
    pub(super) static PARAMETER: ParameterKeys {
        parameter: Texts = texts("speed, or path of a value of the file", "Parameter; several paths vary together.")
            .example("\"speed\"");
        values: Special = special("a list of values of any unit", "Values of the parameter, increasing.").required("")
            .example("{ from = \"1000 rpm\", to = \"5000 rpm\", count = 200 }");
        range: SubTable = sub_table(ValueKeys::TABLE).named("values").required("");
    }
}

keys! {
    /// `values = { ... }`.
    static VALUES: ValueKeys = "Values spaced evenly." {
        from: Special = special("a value with its unit", "First value.").example("\"1000 rpm\"");
        to: Special = special("a value with its unit", "Last value.").example("\"5000 rpm\"");
        count: Count = count([2, 100_000], "Number of values; every integer between integers without unit.")
            .default("200");
        step: Special = special("a value with its unit", "Distance of the values, instead of count.").optional()
            .example("\"10 rpm\"");
    }
}

/// Paths and values: `parameter = "bearing.B.radial_clearance"`, `values = { from = "5 um", to = "40 um", count = 71 }`.
///
/// The unit is checked when a value is set; here it is kept as written.
pub(super) fn parameter(r: &Reader) -> Parameter {
    if !r.has(&PARAMETER.parameter) {
        r.missing_or(&PARAMETER.parameter, ", or \"bearing.B.radial_clearance\", or any other value's path");
    }
    let path = |(text, span): (&str, _)| match (text, renamed_path(text)) {
        ("speed", _) => format!("{}.speed", r.path),
        (_, Some(present)) => {
            r.log.hint(Problem::new(Kind::FormerName, &span, renamed::hint(text, &present)));
            present
        }
        _ => text.to_string(),
    };
    let paths = r.texts(&PARAMETER.parameter).unwrap_or_default().into_iter().map(path).collect();
    let Some(entry) = r.entry(&PARAMETER.values) else {
        r.missing(&PARAMETER.values);
        return Parameter::default();
    };
    let (unit, values) = match &entry.node.value {
        Value::Table(_) => r.table(&PARAMETER.range).and_then(|even| {
            let values = evenly_spaced_values(&even);
            even.finish();
            values
        }),
        Value::List(items) => list_values(r, items),
        _ => list_values(r, std::slice::from_ref(&entry.node)),
    }
    .unwrap_or_default();
    let text = |v: &f64| if unit.is_empty() { format!("{v}") } else { format!("{v} {unit}") };
    let texts = values.iter().map(text).collect();
    let mut sorted = values.clone();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    if sorted != values {
        let message = format!("{} must increase", r.name(&PARAMETER.values));
        r.error(Kind::OutOfRange, &PARAMETER.values, message);
    }
    Parameter { paths, unit, values, texts }
}

/// Number and unit of a value of any dimension.
fn number_and_unit(r: &Reader, node: &Node) -> Option<(f64, String)> {
    let split = match &node.value {
        #[allow(clippy::cast_precision_loss)] // integers in a model file are small
        Value::Integer(i) => Some((*i as f64, String::new())),
        Value::Float(f) => Some((*f, String::new())),
        Value::Text(text) => leading_number(text.trim())
            .map(|(value, length)| (value, text.trim()[length..].trim().to_string())),
        _ => None,
    };
    if split.as_ref().is_none_or(|(value, _)| !value.is_finite()) {
        let problem = Problem::new(Kind::WrongType, &node.span, "not a parameter value");
        r.log.error(problem.expected("such as \"5 um\", \"3000 rpm\" or 8"));
        return None;
    }
    split
}

fn list_values(r: &Reader, items: &[Node]) -> Option<(String, Vec<f64>)> {
    let found: Vec<(f64, String)> = items.iter().filter_map(|item| number_and_unit(r, item)).collect();
    let unit = found.first()?.1.clone();
    if let Some(k) = found.iter().position(|(_, other)| *other != unit) {
        report_mixed_units(r, &items[k], &found[k].1, &unit);
        return None;
    }
    Some((unit, found.into_iter().map(|(value, _)| value).collect()))
}

fn report_mixed_units(r: &Reader, node: &Node, found: &str, unit: &str) {
    let message = format!("different units in one list of values: `{found}` and `{unit}`");
    r.log.error(Problem::new(Kind::BadQuantity, &node.span, message).hint("use one unit for all values"));
}

fn evenly_spaced_values(r: &Reader) -> Option<(String, Vec<f64>)> {
    let end = |key: &Key<Special>| {
        if !r.has(key) {
            r.missing(key);
        }
        r.entry(key).and_then(|entry| number_and_unit(r, &entry.node).map(|found| (found, &entry.node)))
    };
    let (from, to) = (end(&VALUES.from), end(&VALUES.to));
    let given = r.one_of(&[&VALUES.count, &VALUES.step]);
    let whole = |value: f64| value.fract() == 0.0 && value.abs() < 1e5;
    let step = r
        .entry(&VALUES.step)
        .and_then(|entry| number_and_unit(r, &entry.node).map(|found| (found, &entry.node)));
    let count = r.count(&VALUES.count);
    let (((from, unit), _), ((to, other), node)) = (from?, to?);
    if other != unit {
        report_mixed_units(r, node, &other, &unit);
        return None;
    }
    if to <= from {
        let message = format!("{} must be above {}", r.name(&VALUES.to), r.name(&VALUES.from));
        r.error(Kind::OutOfRange, &VALUES.to, message);
        return None;
    }
    let by_step = given.is_some_and(|given| given.is(&VALUES.step));
    let steps = match (by_step, step) {
        (true, Some(((step, other), node))) => {
            if other != unit {
                report_mixed_units(r, node, &other, &unit);
                return None;
            }
            let steps = (to - from) / step;
            if !(0.999..1e5).contains(&steps) {
                let message = format!("{} divides the range into {steps:.1} steps", r.name(&VALUES.step));
                r.error(Kind::OutOfRange, &VALUES.step, message);
                return None;
            }
            return Some((unit, (0..=(steps + 1e-9) as usize).map(|k| from + k as f64 * step).collect()));
        }
        (true, None) => return None,
        // Integer parameter without unit: every integer of the range.
        _ if given.is_none() && unit.is_empty() && whole(from) && whole(to) => (to - from) as usize,
        _ => count - 1,
    };
    let value = |k: usize| if k == steps { to } else { from + (to - from) * k as f64 / steps as f64 };
    Some((unit, (0..=steps).map(value).collect()))
}
