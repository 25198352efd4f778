//! Set 58: function at a nodal DOF (time record, spectrum, FRF, coherence).

use super::block::{Block, CUT_OFF_HINT, DAMAGED_HINT};
use super::data_form::DataForm;
use super::ordinate::{AxisCharacteristics, ratio};
use super::{ParseError, UnitSystem, field};
use crate::budget::Budget;
use crate::error::snippet;
use crate::measured::axis_names::Role;
use crate::measured::{axis_units, unit_label};
use rotordyn_signal::Complex;
use rotordyn_signal::record::{Axis, AxisQuantity, Dof, Kind, MeasuredData, Points, Record, Values};

/// Kinds of functions by their number in record 6.
pub(super) const KINDS: [(i64, Kind); 9] = [
    (0, Kind::General),
    (1, Kind::Time),
    (2, Kind::AutoSpectrum),
    (3, Kind::CrossSpectrum),
    (4, Kind::Frf),
    (5, Kind::Transmissibility),
    (6, Kind::Coherence),
    (9, Kind::Psd),
    (12, Kind::Spectrum),
];

/// Lines of text before the values.
pub(super) const HEADER_LINES: usize = 11;
/// Records 6 and 7, counted from the first ID line.
const RECORD_6: usize = 5;

/// Record 6, DOF identification: function type, response and reference DOF.
struct DofIdentification {
    kind: Kind,
    response: Dof,
    reference: Dof,
    entity: String,
}

impl DofIdentification {
    /// Reads `(2(I5,I10),2(1X,10A1,I10,I4))`.
    fn of(block: &Block, notes: &mut Vec<String>) -> Result<Self, ParseError> {
        let line = block.record(RECORD_6)?;
        let [kind, _, _, _, _, entity, node, direction, _, _, reference, its_direction] =
            field::columns(line, [5, 10, 5, 10, 1, 10, 10, 4, 1, 10, 10, 4]);
        let number: i64 = kind.parse().map_err(|_| {
            block.error_at(RECORD_6, format!("`{kind}` is expected to be a function type"), DAMAGED_HINT)
        })?;
        let kind = KINDS.iter().find(|k| k.0 == number).map_or(Kind::General, |k| k.1);
        if kind == Kind::General && number != 0 {
            notes.push(format!("line {}: function type {number} is kept as a general function", block.line));
        }
        let whole = |text: &str| text.parse().unwrap_or(0);
        let way = |text: &str| whole(text).clamp(-6, 6) as i8;
        Ok(DofIdentification {
            kind,
            response: Dof::new(whole(&node), way(&direction)),
            reference: Dof::new(whole(&reference), way(&its_direction)),
            entity: if entity == "NONE" { String::new() } else { entity },
        })
    }

    /// Entity name; all of ID line 1 if the entity is its truncated beginning; else the DOFs; else ID line 1.
    fn name(&self, id: &str) -> String {
        let folded: String = field::ascii(id).chars().take(10).collect();
        if !self.entity.is_empty() {
            return if folded.trim() == self.entity { id.to_owned() } else { self.entity.clone() };
        }
        match (self.response, self.reference) {
            (Dof::NONE, _) if !id.is_empty() => id.to_owned(),
            (Dof::NONE, _) => "function".into(),
            (response, Dof::NONE) => response.to_string(),
            (response, reference) => format!("{response}/{reference}"),
        }
    }
}

/// Reads a function, ASCII or binary; remarks go to the notes.
pub(super) fn read(
    block: &Block,
    system: Option<UnitSystem>,
    budget: &Budget,
    out: &mut MeasuredData,
) -> Result<(), ParseError> {
    let identity = DofIdentification::of(block, &mut out.notes)?;
    let layout = DataForm::of(block)?;
    let id_line = |k: usize| block.text(k).filter(|text| *text != "NONE").unwrap_or_default();
    let name = identity.name(id_line(0));
    let numbers = match &block.binary {
        Some(binary) => {
            let count = binary.data.len() / if layout.double { 8 } else { 4 };
            block.within(budget.take_values::<[f64; 3]>(|| format!("`{name}`"), count))?;
            binary.numbers(&layout)
        }
        None => {
            let mut numbers = Vec::new();
            for k in HEADER_LINES..block.lines.len() {
                let row = block.numbers(k)?;
                // The numbers as read, as values, and as axis.
                block.within(budget.take_values::<[f64; 3]>(|| format!("`{name}`"), row.len()))?;
                numbers.extend(row);
            }
            numbers
        }
    };
    let width = layout.width();
    let count = (numbers.len() / width).min(layout.count);
    if count < layout.count && !block.terminated || count == 0 {
        let problem = format!("`{name}` is cut off: {count} of {} values", layout.count);
        return Err(block.error_at(block.lines.len(), problem, CUT_OFF_HINT));
    }
    if numbers.len() != layout.count * width {
        let found = numbers.len() / width;
        out.notes.push(format!("`{name}` has {found} values, its header states {}", layout.count));
    }
    let last = width - 1 - usize::from(layout.complex);
    let rows = numbers.chunks_exact(width).take(count);
    let mut values = match layout.complex {
        true => Values::Complex(rows.clone().map(|row| Complex::new(row[last], row[last + 1])).collect()),
        false => Values::Real(rows.clone().map(|row| row[last]).collect()),
    };

    let [abscissa, ordinate, denominator, z] = [7, 8, 9, 10].map(|k| AxisCharacteristics::of(block, k));
    let (abscissa, over, under, z) = (abscissa?, ordinate?, denominator?, z?);
    let (quantity, (up, down)) = scale(&abscissa, identity.kind).map_err(|problem| {
        block.error_at(7, format!("{problem} of `{name}` is not understood"), AXIS_UNIT_HINT)
    })?;
    let axis = match layout.even {
        true => Axis::uniform(quantity, layout.start * up / down, layout.step * up / down),
        false => Axis::from_points(quantity, rows.map(|row| row[0] * up / down).collect()),
    };
    if axis_is_not_increasing(&axis) {
        let problem = format!("the abscissae of `{name}` do not increase");
        return Err(block.error_at(HEADER_LINES, problem, DAMAGED_HINT));
    }

    let stated = ratio(&over.unit_label, &under.unit_label);
    let top = over.si(identity.response.is_rotation(), system);
    let bottom = under.si(identity.reference.is_rotation(), system);
    let needs_bottom = under.data_type != 0 || !under.unit_label.is_empty();
    let plain = identity.kind == Kind::Coherence && top.is_none();
    if system.is_none() && over.unit_label.is_empty() && top.is_some() {
        let note = "neither unit labels nor a set 164 give the units: SI is assumed";
        if !out.notes.iter().any(|n| n == note) {
            out.notes.push(note.into());
        }
    }
    let unit = match (top, bottom) {
        (Some(top), Some(bottom)) if needs_bottom => {
            values.scale(top.numerator * bottom.divisor, top.divisor * bottom.numerator);
            let joined = ratio(&top.name, &bottom.name);
            unit_label::si(&joined).map_or(joined, |known| known.name)
        }
        (Some(top), _) if !needs_bottom => {
            values.scale(top.numerator, top.divisor);
            top.name
        }
        _ if plain => "1".into(),
        _ => String::new(),
    };
    let is_speed = z.data_type == 19 || unit_label::si(&z.unit_label).is_some_and(|u| u.name == "rpm");
    out.records.push(Record {
        name,
        kind: identity.kind,
        axis,
        values,
        file_unit: if stated.is_empty() { unit.clone() } else { stated },
        unit,
        response: identity.response,
        reference: identity.reference,
        speed_rpm: is_speed.then_some(layout.z_value),
        date: id_line(2).to_owned(),
    });
    Ok(())
}

const AXIS_UNIT_HINT: &str =
    "state the abscissa in Hz, kHz, rad/s, rpm or cpm, or in s, ms or us, and correct its unit label";

/// Quantity of the abscissa, and the factor and divisor to Hz, s or rpm: by its type, its unit, or the kind of function.
fn scale(abscissa: &AxisCharacteristics, kind: Kind) -> Result<(AxisQuantity, (f64, f64)), String> {
    let label = abscissa.unit_label.as_str();
    let unit = if label.is_empty() { abscissa.si(false, None) } else { axis_units::si(label) };
    let name = unit.as_ref().map(|unit| unit.name.as_str());
    let quantity = match (abscissa.data_type, name, kind) {
        (17, ..) => AxisQuantity::Time,
        (18, ..) => AxisQuantity::Frequency,
        (19, ..) => AxisQuantity::Speed,
        (20, ..) => AxisQuantity::Order,
        (_, Some("s"), _) => AxisQuantity::Time,
        (_, Some("Hz"), _) => AxisQuantity::Frequency,
        (_, Some("rpm" | "rad/s"), Kind::Frf | Kind::Coherence) => AxisQuantity::Frequency,
        (_, Some("rpm"), _) => AxisQuantity::Speed,
        (_, _, Kind::General) => AxisQuantity::Unknown,
        (_, _, Kind::Time) => AxisQuantity::Time,
        _ => AxisQuantity::Frequency,
    };
    let role = match quantity {
        AxisQuantity::Time => Role::Times,
        AxisQuantity::Frequency | AxisQuantity::Speed => Role::Frequencies,
        AxisQuantity::Order | AxisQuantity::Unknown => {
            return Ok((quantity, unit.map_or((1.0, 1.0), |unit| (unit.numerator, unit.divisor))));
        }
    };
    let Some(unit) = unit.filter(|unit| unit.name != "1") else {
        return match label {
            "" | "-" | "1" => Ok((quantity, (1.0, 1.0))),
            _ => Err(format!("the unit `{}` of the abscissa", snippet(label))),
        };
    };
    if quantity == AxisQuantity::Speed && unit.name == "rpm" {
        return Ok((quantity, (unit.numerator, unit.divisor)));
    }
    let (up, down) =
        role.factor(&unit).ok_or_else(|| format!("the unit `{}` of the abscissa", snippet(label)))?;
    Ok((quantity, if quantity == AxisQuantity::Speed { (up * 60.0, down) } else { (up, down) }))
}

fn axis_is_not_increasing(axis: &Axis) -> bool {
    match &axis.points {
        Points::NonUniform(points) => points
            .windows(2)
            .any(|pair| !matches!(pair[0].partial_cmp(&pair[1]), Some(std::cmp::Ordering::Less))),
        Points::Uniform { .. } | Points::Unknown => false,
    }
}
