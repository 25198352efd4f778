//! Sets 15 and 2411 (nodes), 82 (lines), 2412 (elements).

use super::block::{Block, CUT_OFF_HINT, DAMAGED_HINT};
use super::{ParseError, UnitSystem};
use crate::budget::Budget;
use rotordyn_signal::record::{Element, Geometry, Node, Polyline};

/// Descriptors of beam elements, whose record has an additional line for orientation and sections.
pub(super) const BEAM_DESCRIPTORS: [i64; 5] = [11, 21, 22, 23, 24];

/// Reads nodes: set 15 `(4I10,1P3E13.5)`, set 2411 `(4I10)` and `(1P3D25.16)`.
pub(super) fn nodes(
    block: &Block,
    units: UnitSystem,
    budget: &Budget,
    out: &mut Geometry,
) -> Result<(), ParseError> {
    let mut k = 0;
    while k < block.lines.len() {
        let mut row = block.numbers(k)?;
        k += 1;
        if row.is_empty() {
            continue;
        }
        if row.len() == 4 && k < block.lines.len() {
            row.extend(block.numbers(k)?);
            k += 1;
        }
        let [number, _, local, _, x, y, z] = row[..] else {
            let problem = format!("a node has {} numbers instead of 7", row.len());
            return Err(block.error_at(
                k - 1,
                problem,
                if block.terminated { DAMAGED_HINT } else { CUT_OFF_HINT },
            ));
        };
        block.within(budget.take_values::<[Node; 2]>(|| "the nodes".into(), 1))?;
        out.nodes.push(Node {
            number: number as i64,
            position: [x, y, z].map(|v| v / units.length),
            local_system: local as i64,
        });
    }
    Ok(())
}

/// Reads lines through nodes, set 82; a node 0 ends a polyline (pen up).
pub(super) fn lines(block: &Block, budget: &Budget, out: &mut Geometry) -> Result<(), ParseError> {
    let head = block.integers(0)?;
    let name = block.text(1).filter(|name| *name != "NONE").unwrap_or_default().to_owned();
    let mut nodes = Vec::new();
    for k in 2..block.lines.len() {
        let row = block.integers(k)?;
        // A number, and at worst a stroke of its own.
        let each = size_of::<i64>() * 6 + size_of::<Vec<i64>>();
        block.within(budget.take(|| "the lines".into(), (row.len() * each) as u64))?;
        nodes.extend(row);
    }
    // Lines of eight are padded with zeros.
    if let Some(count) = head.get(1).and_then(|count| usize::try_from(*count).ok()) {
        nodes.truncate(count);
    }
    let strokes = nodes.split(|&n| n == 0).filter(|s| !s.is_empty()).map(<[i64]>::to_vec).collect();
    out.lines.push(Polyline { name, strokes });
    Ok(())
}

/// Reads elements, set 2412: `(6I10)`, for beams a line `(3I10)`, nodes `(8I10)`.
pub(super) fn elements(block: &Block, budget: &Budget, out: &mut Geometry) -> Result<(), ParseError> {
    let mut k = 0;
    while k < block.lines.len() {
        let head = block.integers(k)?;
        k += 1;
        if head.is_empty() {
            continue;
        }
        let [number, descriptor, _, _, _, count] = head[..] else {
            let problem = format!("an element has {} numbers instead of 6", head.len());
            return Err(block.error_at(k - 1, problem, DAMAGED_HINT));
        };
        k += usize::from(BEAM_DESCRIPTORS.contains(&descriptor));
        let mut nodes = Vec::new();
        while (nodes.len() as i64) < count {
            nodes.extend(block.integers(k)?);
            k += 1;
        }
        let bytes = 2 * size_of::<Element>() + nodes.len() * size_of::<i64>() * 2;
        block.within(budget.take(|| "the elements".into(), bytes as u64))?;
        out.elements.push(Element { number, descriptor, nodes });
    }
    Ok(())
}
