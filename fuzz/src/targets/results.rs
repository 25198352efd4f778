//! A results file of this program, changed or damaged, as `spectrogram`, `orders`, `export` and `validate` read it.

use std::path::Path;

use rotordyn::io::budget::Limits;
use rotordyn::io::hdf5::{self, Attribute, Reader};
use rotordyn::io::measured::test_data::{self, ReadSettings};
use rotordyn::io::{export_3d, machine_records, measured, results_file};
use rotordyn::model::study::{OrderStudy, SpectrogramStudy, WindowKind};
use rotordyn::model::{self, Model, Options};
use rotordyn::study::Machine;

use crate::hdf5_reader::reading_limits;
use crate::outcome::Outcome;

/// One run of this number is exported as an animation and analysed, which takes ten times as long as reading it.
const ANALYSED_SHARE: u32 = 16;

/// Largest stored machine that is assembled.
const MAX_NODES: usize = 20;

pub fn run(bytes: &[u8], folder: &Path) -> Outcome {
    let path = folder.join("results.h5");
    if let Err(error) = super::measured::write_anew(&path, bytes) {
        return Outcome::refused(error);
    }
    let mut outcome = Outcome { accepted: true, messages: Vec::new() };
    let limits = reading_limits();
    match measured::read_within(&path, &limits) {
        Ok(measured) => super::measured::examine(&measured, &mut outcome),
        Err(error) => outcome = Outcome::refused(error),
    }
    match hdf5::open_reader(&path, &limits) {
        Ok(store) => {
            let analysed = crc32fast::hash(bytes).is_multiple_of(ANALYSED_SHARE);
            read_run(&*store, analysed.then_some(folder), &limits, &mut outcome);
        }
        Err(error) => outcome = outcome.and(Outcome::refused(error)),
    }
    outcome
}

/// The stored run and its model; with a folder for an animation, also what is made of them.
fn read_run(store: &dyn Reader, folder: Option<&Path>, limits: &Limits, outcome: &mut Outcome) {
    outcome.after("schema", results_file::schema(store));
    let history = outcome.after("run", results_file::read_history(store.path(), limits));
    let motion = outcome.after("motion", results_file::read_motion(store)).flatten();
    let files = outcome.after("side files", results_file::read_external_files(store)).unwrap_or_default();
    let text = |name: &str| match store.attribute("/meta", name) {
        Ok(Some(Attribute::Text(text))) => Some(text),
        _ => None,
    };
    let setting = |line: &str| line.split_once(" = ").map(|(path, value)| (path.into(), value.into()));
    let Some(stored) = text("model") else { return };
    let options = Options {
        variant: text("variant").filter(|name| !name.is_empty()),
        set: text("settings").unwrap_or_default().lines().filter_map(setting).collect(),
    };
    let loaded = model::load_with("stored model", stored, &options, &files);
    let Some(loaded) = outcome.after("model", loaded) else { return };
    let Some(folder) = folder else { return };
    let reading = ReadSettings { limits: Some(limits), ..ReadSettings::default() };
    outcome.after("test data", test_data::read(store.path(), &reading, &loaded.model));
    if let Some(motion) = motion {
        outcome.after("motion", export_3d::export_motion(&motion, &loaded.model, 1.0, folder));
    }
    let Some(history) = history else { return };
    let records = outcome.after("records", machine_records::run_records(&history, &loaded.model));
    let Some(run) = records else { return };
    super::measured::examine(&run, outcome);
    if !is_small(&loaded.model) {
        return;
    }
    let Some(machine) = outcome.after("machine", Machine::new(loaded.model)) else { return };
    let spectrogram = SpectrogramStudy {
        channels: Vec::new(),
        window: WindowKind::Hann,
        length: 0.05,
        overlap: 0.5,
        max_frequency: 500.0,
        dynamic_range_db: 60.0,
        orders: vec![1.0],
    };
    outcome.after("spectrogram", machine.spectrograms(&spectrogram, &history));
    let orders = OrderStudy {
        channels: Vec::new(),
        resolution: 0.5,
        max_order: 4.0,
        max_order_is_default: false,
        overlap: 0.5,
        window: WindowKind::Hann,
        cuts: vec![1.0],
        bandwidth: None,
    };
    outcome.after("orders", machine.orders(&orders, &history));
}

fn is_small(model: &Model) -> bool {
    model.node_count() <= MAX_NODES && model.bearings.iter().all(|site| site.bearing.ball().is_none())
}
