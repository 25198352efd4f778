//! The recipe of an exporter (CONTRIBUTING.md) followed outside the library.

use std::path::PathBuf;

use rotordyn::error::Error;
use rotordyn::io::machine_records::run_records;
use rotordyn::io::run_export::{Options, RunFormat};
use rotordyn::signal::record::{MeasuredData, Values};

use crate::rig_results::RIG;

const SUMMARY: RunFormat = RunFormat::new("summary", write);

/// Name, unit and RMS of every real channel, a line each.
fn write(run: &MeasuredData, options: &Options) -> Result<Vec<PathBuf>, Error> {
    let path = options.folder.join("channels.txt");
    let mut text = String::new();
    for record in &run.records {
        let Values::Real(values) = &record.values else { continue };
        let square = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
        text += &format!("{}\t{}\t{}\n", record.name, record.unit, square.sqrt());
    }
    std::fs::write(&path, text).map_err(Error::of_file("write", &path))?;
    Ok(vec![path])
}

#[test]
fn exporter_of_ones_own_writes_a_run() {
    let (machine, results) = &*RIG;
    let history = &results.run_up.as_ref().unwrap().history;
    let run = run_records(history, &machine.model).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let files = SUMMARY.write(&run, &Options { folder: folder.path(), number: 1 }).unwrap();
    assert_eq!(files, [folder.path().join("channels.txt")]);
    let text = std::fs::read_to_string(&files[0]).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split('\t').collect()).collect();
    assert!(rows.len() >= history.channels.len(), "{text}");
    let values = history.channel("B_ax").unwrap().values.in_memory().unwrap();
    let row = rows.iter().find(|row| row[0] == "B_ax").unwrap();
    let square = values.iter().map(|v| v * v).sum::<f64>() / values.len() as f64;
    assert_eq!((row[1], row[2].parse()), ("m/s^2", Ok(square.sqrt())));
    let missing = folder.path().join("missing");
    let error = SUMMARY.write(&run, &Options { folder: &missing, number: 1 }).unwrap_err();
    assert!(matches!(&error, Error::Environment { path, .. } if path.starts_with(&missing)), "{error}");
}
