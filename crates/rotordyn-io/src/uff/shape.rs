//! Sets 55 and 2414: values at nodes, such as mode shapes.

use super::block::{Block, CUT_OFF_HINT, DAMAGED_HINT};
use super::{ParseError, UnitSystem};
use crate::budget::Budget;
use rotordyn_signal::Complex;
use rotordyn_signal::record::{Analysis, MeasuredData, Shape};

/// Record 6 of set 55, record 9 of set 2414 `(6I10)`.
struct ShapeHeader {
    analysis: i64,
    /// 8 displacement, 11 velocity, 12 acceleration, 5 temperature.
    quantity: i64,
    complex: bool,
    components: usize,
}

impl ShapeHeader {
    fn of(block: &Block, k: usize) -> Result<Self, ParseError> {
        let [_, analysis, _, quantity, data, components] = block.integers(k)?[..] else {
            return Err(block.error_at(k, "six integers are expected".into(), DAMAGED_HINT));
        };
        if !(1..=9).contains(&components) {
            return Err(block.error_at(k, format!("{components} values per node"), DAMAGED_HINT));
        }
        Ok(ShapeHeader {
            analysis,
            quantity,
            complex: matches!(data, 5 | 6),
            components: components as usize,
        })
    }

    /// SI unit of the values and their divisor; temperatures are not converted.
    fn unit(&self, units: UnitSystem) -> (&'static str, f64) {
        match self.quantity {
            8 => ("m", units.length),
            9 => ("N", units.force),
            11 => ("m/s", units.length),
            12 => ("m/s^2", units.length),
            _ => ("", 1.0),
        }
    }
}

/// Reads set 55.
pub(super) fn read_55(
    block: &Block,
    units: UnitSystem,
    budget: &Budget,
    out: &mut MeasuredData,
) -> Result<(), ParseError> {
    let form = ShapeHeader::of(block, 5)?;
    let whole = block.integers(6)?;
    // The first two are the numbers of integer and of real parameters.
    let number = whole.get(3).copied().unwrap_or(0);
    let mut real = Vec::new();
    let count = whole.get(1).copied().unwrap_or(0).clamp(0, 60) as usize;
    let mut k = 7;
    while real.len() < count.max(1) {
        real.extend(block.numbers(k)?);
        k += 1;
    }
    let at = |i: usize| real.get(i).copied().unwrap_or(0.0);
    let pair = |i: usize| Complex::new(at(i), at(i + 1));
    let analysis = match form.analysis {
        1 => Analysis::Static,
        2 => Analysis::NormalMode {
            frequency_hz: at(0),
            modal_mass: at(1),
            damping_ratio: at(2),
            hysteretic: at(3),
        },
        3 | 7 => Analysis::ComplexMode { eigenvalue: pair(0), modal_a: pair(2), modal_b: pair(4) },
        4 => Analysis::Transient { time: at(0) },
        5 => Analysis::FrequencyResponse { frequency_hz: at(0) },
        _ => Analysis::Unknown,
    };
    let name = block.text(0).unwrap_or_default();
    read_nodes(block, k, form, (name, number, analysis), units, budget, out)
}

/// Reads set 2414, data at nodes.
pub(super) fn read_2414(
    block: &Block,
    units: UnitSystem,
    budget: &Budget,
    out: &mut MeasuredData,
) -> Result<(), ParseError> {
    let place = block.integers(2)?;
    if place.first() != Some(&1) {
        out.left_out.push(format!("line {}: results on elements (set 2414)", block.line));
        return Ok(());
    }
    let form = ShapeHeader::of(block, 8)?;
    let whole = block.integers(9)?;
    let real = [block.numbers(11)?, block.numbers(12)?].concat();
    let at = |i: usize| real.get(i).copied().unwrap_or(0.0);
    let pair = |i: usize| Complex::new(at(i), at(i + 1));
    let analysis = match form.analysis {
        1 | 9 => Analysis::Static,
        2 => Analysis::NormalMode {
            frequency_hz: at(1),
            modal_mass: at(3),
            damping_ratio: at(4),
            hysteretic: at(5),
        },
        3 | 7 => Analysis::ComplexMode { eigenvalue: pair(6), modal_a: pair(8), modal_b: pair(10) },
        4 => Analysis::Transient { time: at(0) },
        5 => Analysis::FrequencyResponse { frequency_hz: at(1) },
        _ => Analysis::Unknown,
    };
    // Mode number, or frequency number of a response.
    let field = if form.analysis == 5 { 7 } else { 5 };
    let number = whole.get(field).copied().unwrap_or(0);
    let name = block.text(1).unwrap_or_default();
    read_nodes(block, 13, form, (name, number, analysis), units, budget, out)
}

/// Reads `(I10)` node and `(6E13.5)` values from line `k` on.
fn read_nodes(
    block: &Block,
    mut k: usize,
    form: ShapeHeader,
    (name, number, analysis): (&str, i64, Analysis),
    units: UnitSystem,
    budget: &Budget,
    out: &mut MeasuredData,
) -> Result<(), ParseError> {
    let (unit, divisor) = form.unit(units);
    let width = form.components * (1 + usize::from(form.complex));
    let (mut nodes, mut values) = (Vec::new(), Vec::new());
    while k < block.lines.len() {
        let head = block.integers(k)?;
        k += 1;
        let Some(&node) = head.first() else { continue };
        let mut row = Vec::new();
        while row.len() < width {
            if k == block.lines.len() {
                let problem = format!("node {node} has {} of {width} values", row.len());
                return Err(block.error_at(k, problem, CUT_OFF_HINT));
            }
            row.extend(block.numbers(k)?);
            k += 1;
        }
        let bytes = size_of::<i64>() + form.components * size_of::<Complex<f64>>();
        block.within(budget.take(|| "the shapes".into(), 2 * bytes as u64))?;
        nodes.push(node);
        // Some programs pad every node to six values.
        row.truncate(width);
        row.iter_mut().for_each(|v| *v /= divisor);
        match form.complex {
            true => values.extend(row.chunks_exact(2).map(|v| Complex::new(v[0], v[1]))),
            false => values.extend(row.iter().map(|&v| Complex::from(v))),
        }
    }
    if !block.terminated {
        let problem = format!("the shape ends after node {}", nodes.last().copied().unwrap_or(0));
        return Err(block.error_at(k, problem, CUT_OFF_HINT));
    }
    let name = if name == "NONE" { String::new() } else { name.to_owned() };
    out.shapes.push(Shape {
        name: if name.is_empty() { format!("shape {}", out.shapes.len() + 1) } else { name },
        analysis,
        number,
        components: form.components,
        nodes,
        values,
        complex: form.complex,
        unit: unit.into(),
    });
    Ok(())
}
