//! A mapping file, applied to measured records and shapes, as `identify`, `validate` and `update` do.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use rotordyn::io::{machine_records, measured, measured::mapping};
use rotordyn::model::{self, Model};
use rotordyn::signal::record::MeasuredData;

use crate::folders;
use crate::outcome::Outcome;

/// Measured files with points, shapes and channels, and the model that they are mapped on.
struct Fixture {
    measured: Vec<MeasuredData>,
    model: Model,
}

/// Where they are; the program that fuzzes is built from the repository and reads them there.
fn fixture() -> &'static Result<Fixture, String> {
    static FIXTURE: OnceLock<Result<Fixture, String>> = OnceLock::new();
    FIXTURE.get_or_init(|| {
        let top = folders::top();
        let files: [PathBuf; 3] = [
            top.join("tests/data/uff/ascii_classic.uff"),
            top.join("tests/data/uff/pyuff_ascii.uff"),
            top.join("fuzz/corpus/csv/units.csv"),
        ];
        let read = |path: &PathBuf| measured::read(path).map_err(|error| error.to_string());
        let measured = files.iter().map(read).collect::<Result<_, _>>()?;
        let path = top.join("models/two_disc_pedestals.toml");
        let text = std::fs::read(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let loaded = model::load("model", text, &model::Options::default()).map_err(|e| e.to_string())?;
        Ok(Fixture { measured, model: loaded.model })
    })
}

pub fn run(bytes: &[u8], folder: &Path) -> Outcome {
    let fixture = match fixture() {
        Ok(fixture) => fixture,
        Err(error) => panic!("the fixture cannot be read: {error}"),
    };
    let path = folder.join("mapping.toml");
    if let Err(error) = std::fs::write(&path, bytes) {
        return Outcome::refused(error);
    }
    let mapping = match mapping::read(&path) {
        Ok(mapping) => mapping,
        Err(error) => return Outcome::refused(error),
    };
    let place = |name: &str| machine_records::point_number(&fixture.model, name);
    let mut outcome = Outcome::accepted(format!("rate {}", mapping.rate().is_some()));
    for measured in &fixture.measured {
        let mut measured = measured.clone();
        if !measured.records.is_empty() {
            let applied = mapping.apply(&mut measured, &place, &path);
            let warnings = outcome.after("records", applied);
            outcome.messages.extend(warnings.into_iter().flatten());
        }
        if !measured.shapes.is_empty() {
            let applied = mapping.apply_to_shapes(&mut measured, &place, &path);
            outcome.after("shapes", applied);
        }
        super::measured::examine(&measured, &mut outcome);
    }
    outcome
}
