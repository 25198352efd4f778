//! Comparisons with references: each asserts, and leaves a row of the book's validation chapter.
//!
//! Where the environment variable `ROTORDYN_VALIDATION` names a folder, every file of tests has a file of rows there;
//! the book's builder makes tables of them. The rows of a file are replaced by the next run of its test binary.
#![allow(dead_code)]

use std::collections::BTreeMap;
use std::fmt::{Display, Write as _};
use std::fs::{self, File};
use std::io::Write as _;
use std::panic::Location;
use std::path::PathBuf;
use std::sync::Mutex;

/// |ours/reference − 1| ≤ tolerance, with the quantity in words.
#[track_caller]
pub fn relative(quantity: impl Display, ours: f64, reference: f64, tolerance: f64) {
    let row = Row {
        quantity: quantity.to_string(),
        ours: Some(ours),
        reference,
        error: (ours / reference - 1.0).abs(),
        tolerance,
        relative: true,
    };
    row.finish(Location::caller());
}

/// |ours − reference| ≤ tolerance, in the unit of the quantity.
#[track_caller]
pub fn absolute(quantity: impl Display, ours: f64, reference: f64, tolerance: f64) {
    let row = Row {
        quantity: quantity.to_string(),
        ours: Some(ours),
        reference,
        error: (ours - reference).abs(),
        tolerance,
        relative: false,
    };
    row.finish(Location::caller());
}

/// Largest deviation of a curve from its reference ≤ tolerance times the scale, the reference's largest value.
#[track_caller]
pub fn curve(quantity: impl Display, deviation: f64, scale: f64, tolerance: f64) {
    let row = Row {
        quantity: quantity.to_string(),
        ours: None,
        reference: scale,
        error: (deviation / scale).abs(),
        tolerance,
        relative: true,
    };
    row.finish(Location::caller());
}

struct Row {
    quantity: String,
    /// None of a curve.
    ours: Option<f64>,
    reference: f64,
    error: f64,
    tolerance: f64,
    relative: bool,
}

impl Row {
    fn finish(&self, place: &Location) {
        // A NaN is no error below the tolerance.
        let holds = self.error <= self.tolerance;
        if holds && let Some(folder) = std::env::var_os("ROTORDYN_VALIDATION") {
            self.write(PathBuf::from(folder), place);
        }
        let Self { quantity, ours, reference, error, tolerance, relative } = self;
        let ours = ours.map_or("a curve off".into(), |ours| ours.to_string());
        let kind = if *relative { "relative" } else { "absolute" };
        assert!(
            holds,
            "{}:{}: {quantity}: {ours} instead of {reference}, {kind} error {error:.1e} > {tolerance:.1e}",
            place.file(),
            place.line()
        );
    }

    /// Appends the row to the file of its place; the first one of a process replaces the rows of an earlier run.
    fn write(&self, folder: PathBuf, place: &Location) {
        static BEGUN: Mutex<BTreeMap<String, File>> = Mutex::new(BTreeMap::new());
        let file = plain_path(place.file());
        let path = folder.join(format!("{}.jsonl", file.trim_end_matches(".rs").replace('/', ".")));
        let mut line = String::new();
        write!(
            line,
            "{{\"file\":{file:?},\"line\":{},\"quantity\":{:?},\"reference\":{:?},\"ours\":{},\"error\":{:?},\
             \"tolerance\":{:?},\"relative\":{}}}",
            place.line(),
            self.quantity,
            self.reference,
            self.ours.map_or("null".into(), |ours| format!("{ours:?}")),
            self.error,
            self.tolerance,
            self.relative,
        )
        .expect("a String takes every text");
        let mut begun = BEGUN.lock().expect("nothing panics while it is held, but a full disk");
        let rows = begun.entry(file).or_insert_with(|| {
            fs::create_dir_all(&folder).expect("the folder of ROTORDYN_VALIDATION");
            File::create(&path).expect("a file in the folder of ROTORDYN_VALIDATION")
        });
        writeln!(rows, "{line}").expect("room for a row");
    }
}

/// A path of the sources without `..`, as `#[path]` leaves it.
fn plain_path(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            ".." => {
                parts.pop();
            }
            "." => {}
            part => parts.push(part),
        }
    }
    parts.join("/")
}
