//! A measured file of any format, read and examined as `signal`, `identify`, `validate` and the side files of models do.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::OnceLock;

use rotordyn::io::measured::{self, run_up};
use rotordyn::model::{self, Model};
use rotordyn::signal::record::{MeasuredData, Values};
use rotordyn::update::target::{modes_of, sensors};

use crate::folders;
use crate::hdf5_reader::reading_limits;
use crate::outcome::Outcome;

/// Most records whose samples are examined one by one.
const MAX_RECORDS: usize = 50;

/// Most FRFs that are put into a matrix.
const MAX_FRFS: usize = 400;

pub fn run(bytes: &[u8], path: &Path) -> Outcome {
    if let Err(error) = write_anew(path, bytes) {
        return Outcome::refused(error);
    }
    match measured::read_within(path, &reading_limits()) {
        Err(error) => Outcome::refused(error),
        Ok(measured) => {
            let mut outcome = Outcome::accepted("measured");
            examine(&measured, &mut outcome);
            outcome
        }
    }
}

/// Writes a file that is not the one that was there: the HDF5 library may still have that open after an error.
pub fn write_anew(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let _ = std::fs::remove_file(path);
    std::fs::write(path, bytes)
}

/// Uses what was read as the commands do.
pub fn examine(measured: &MeasuredData, outcome: &mut Outcome) {
    let kinds: BTreeSet<&str> = measured.records.iter().map(|r| r.kind.label()).collect();
    outcome.messages.push(format!(
        "{kinds:?}, shapes: {}, nodes: {}, scalars: {}",
        !measured.shapes.is_empty(),
        !measured.geometry.nodes.is_empty(),
        !measured.scalars.is_empty(),
    ));
    outcome.messages.extend(measured.notes.iter().cloned());
    let mut names = BTreeSet::new();
    for record in &measured.records {
        assert!(names.insert(&record.name), "two records are named {:?}", record.name);
    }
    for record in measured.records.iter().take(MAX_RECORDS) {
        let count = record.values.len();
        outcome.after("samples", record.time_samples());
        outcome.after("rate", record.sample_rate());
        outcome.after("unit", record.si_unit());
        outcome.after("FRF", record.frf());
        outcome.messages.push(record.axis.describe(count));
        if let (Some(points), Values::Real(_)) = (record.axis.points(count), &record.values) {
            assert!(points.len() <= count, "{} points of {count} values", points.len());
        }
    }
    if measured.records.len() <= MAX_FRFS {
        outcome.after("FRFs", measured.frf_matrix());
    }
    for shape in &measured.shapes {
        assert_eq!(
            shape.values.len(),
            shape.nodes.len() * shape.components,
            "values of shape {}",
            shape.name
        );
        shape.analysis.frequency_hz();
        shape.analysis.damping_ratio();
    }
    let Some(model) = machine() else { return };
    for rpm in [None, Some(3000.0)] {
        if let Some((dofs, _, _)) = modes_of(measured, rpm) {
            outcome.after("modes", sensors(&dofs, &measured.geometry, model));
        }
    }
    let channels = outcome.after("run-up", run_up::channels(measured, model));
    outcome.messages.extend(channels.into_iter().flat_map(|(_, warnings)| warnings));
}

/// A machine whose points the records are compared with.
fn machine() -> Option<&'static Model> {
    static MODEL: OnceLock<Option<Model>> = OnceLock::new();
    let read = || {
        let text = std::fs::read(folders::top().join("models/two_disc_pedestals.toml")).ok()?;
        Some(model::load("model", text, &model::Options::default()).ok()?.model)
    };
    MODEL.get_or_init(read).as_ref()
}
