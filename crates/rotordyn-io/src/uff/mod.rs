//! Universal files (UFF, UNV): functions (58, 58b), header (151), units (164), nodes (15, 2411), lines and
//! elements (82, 2412), shapes (55, 2414).
//!
//! Blocks between lines of `-1` are read with tolerance for deviations of other programs: short and padded
//! blocks, numbers without separating blanks, wrong byte counts, line ends after binary data, Latin-1 text.
//! Remarks go to [`MeasuredData::notes`]. Values are converted to SI by the unit label, else by the unit factors
//! of set 164.
//!
//! Formats: Universal File Datasets, Structural Dynamics Research Laboratory, University of Cincinnati.

mod binary;
mod binary_data;
mod block;
mod blocks;
mod data_form;
mod field;
mod function;
mod geometry;
mod ordinate;
mod shape;
mod unit_system;
mod write;

use unit_system::{ParseError, SI, UnitSystem};
pub use write::{GeometrySets, Options, to_bytes, write};

use std::collections::BTreeSet;
use std::path::Path;

use crate::budget::{self, Budget, Limits};
use crate::error::Error;
use block::Block;
use blocks::Blocks;
use rotordyn_signal::record::MeasuredData;

/// Reads a universal file.
///
/// # Errors
/// The file cannot be read, a block is cut off or does not have the format of its data set number, or the contents
/// exceed the budget.
pub fn read(path: &Path, limits: &Limits) -> Result<(MeasuredData, Budget), Error> {
    let (bytes, budget) = budget::read_file(path, limits)?;
    match parse(&bytes, &budget) {
        Ok(measured) => Ok((measured, budget)),
        Err(fault) => Err(Error::Content {
            path: path.into(),
            problem: format!("line {}: {}", fault.line, fault.problem),
            advice: fault.advice,
        }),
    }
}

/// Most remarks on the blocks of a file; further ones are counted.
const MAX_NOTES: usize = 50;

fn parse(bytes: &[u8], budget: &Budget) -> Result<MeasuredData, ParseError> {
    let mut measured = MeasuredData::default();
    let mut system: Option<UnitSystem> = None;
    let mut skipped: BTreeSet<u32> = BTreeSet::new();
    let mut more_notes = 0;
    let mut blocks = Blocks::new(bytes, budget);
    while let Some(block) = blocks.next()? {
        let units = system.unwrap_or(SI);
        block.within(budget.objects("data sets", 1))?;
        match block.set {
            15 | 2411 => geometry::nodes(&block, units, budget, &mut measured.geometry)?,
            82 => geometry::lines(&block, budget, &mut measured.geometry)?,
            2412 => geometry::elements(&block, budget, &mut measured.geometry)?,
            55 => shape::read_55(&block, units, budget, &mut measured)?,
            2414 => shape::read_2414(&block, units, budget, &mut measured)?,
            58 => function::read(&block, system, budget, &mut measured)?,
            151 => measured.title = title(&block),
            164 => system = Some(unit_system(&block, &mut measured.notes)?),
            other => _ = skipped.insert(other),
        }
        more_notes += measured.notes.len().saturating_sub(MAX_NOTES);
        measured.notes.truncate(MAX_NOTES);
        budget.give_back(block.memory());
    }
    if more_notes > 0 {
        measured.notes.push(format!("and {more_notes} more remarks"));
    }
    let local = measured.geometry.nodes.iter().filter(|n| n.local_system != 0).count();
    if local > 0 {
        measured.notes.push(format!(
            "directions at {local} nodes are in local coordinate systems, which are not applied"
        ));
    }
    if !skipped.is_empty() {
        let list: Vec<String> = skipped.iter().take(MAX_NOTES).map(u32::to_string).collect();
        let more = if skipped.len() > MAX_NOTES { ", ..." } else { "" };
        measured.left_out.push(format!("data sets {}{more}", list.join(", ")));
    }
    Ok(measured)
}

/// Model name of set 151.
fn title(block: &Block) -> String {
    block.text(0).filter(|name| *name != "NONE").unwrap_or_default().to_owned()
}

fn unit_system(block: &Block, notes: &mut Vec<String>) -> Result<UnitSystem, ParseError> {
    let mut factors = Vec::new();
    for k in 1..block.lines.len() {
        factors.extend(block.numbers(k)?);
    }
    match factors[..] {
        [length, force, ..] if [length, force].iter().all(|f| *f > 0.0 && f.is_finite()) => {
            if length != 1.0 || force != 1.0 {
                notes.push(format!(
                    "converted to SI by set 164: lengths divided by {length}, forces by {force}"
                ));
            }
            Ok(UnitSystem { length, force })
        }
        _ => Err(block.error_at(
            1,
            "the unit factors for length and force of set 164 are not positive numbers".into(),
            EXPORT_HINT,
        )),
    }
}

const EXPORT_HINT: &str = "export the file again, in SI units";
