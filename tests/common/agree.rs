//! Comparisons with references: each asserts, and leaves a row of the book's validation chapter.
//!
//! Where the environment variable `ROTORDYN_VALIDATION` names a folder, every file of tests has a file of rows there,
//! and one of curves; the book's builder makes tables and figures of them. The rows of a file are replaced by the next run
//! of its test binary.
#![allow(dead_code)]

use std::collections::BTreeMap;
use std::fmt::Display;
use std::fs::{self, File};
use std::io::Write as _;
use std::panic::Location;
use std::path::{Path, PathBuf};
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

/// Values over which a curve is drawn.
#[derive(Clone, Copy)]
pub struct Over<'a> {
    pub name: &'a str,
    pub unit: &'a str,
    pub values: &'a [f64],
}

/// As [`curve`] with all its points: max |ours − reference| ≤ tolerance · max |reference|. The chapter lays both over each
/// other.
#[track_caller]
pub fn curves(
    quantity: impl Display,
    unit: &str,
    over: Over,
    ours: &[f64],
    reference: &[f64],
    tolerance: f64,
) {
    assert!(ours.len() == reference.len() && ours.len() == over.values.len(), "{quantity}: lengths differ");
    // A NaN is kept.
    let larger = |m: f64, v: f64| if v <= m || m.is_nan() { m } else { v };
    let scale = reference.iter().map(|v| v.abs()).fold(0.0, larger);
    let deviation = ours.iter().zip(reference).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
    let row = Row {
        quantity: quantity.to_string(),
        ours: None,
        reference: scale,
        error: deviation / scale,
        tolerance,
        relative: true,
    };
    let place = Location::caller();
    if let Some(folder) = folder() {
        append(&folder, "curves", place, &drawing(&row.quantity, unit, over, ours, reference, place));
    }
    row.finish(place);
}

/// Most points of a curve in a figure.
const DRAWN_POINTS: usize = 600;

/// A line of the file of curves.
fn drawing(
    quantity: &str,
    unit: &str,
    over: Over,
    ours: &[f64],
    reference: &[f64],
    place: &Location,
) -> String {
    let stride = ours.len().div_ceil(DRAWN_POINTS).max(1);
    let list = |values: &[f64]| {
        let each: Vec<String> = values.iter().step_by(stride).map(|v| format!("{v:e}")).collect();
        format!("[{}]", each.join(","))
    };
    format!(
        "{{\"line\":{},\"quantity\":{quantity:?},\"unit\":{unit:?},\"over\":{:?},\"over_unit\":{:?},\"x\":{},\"ours\":{},\
         \"reference\":{}}}",
        place.line(),
        over.name,
        over.unit,
        list(over.values),
        list(ours),
        list(reference)
    )
}

fn folder() -> Option<PathBuf> {
    std::env::var_os("ROTORDYN_VALIDATION").map(PathBuf::from)
}

/// Appends a line to the file of its place; the first one of a process replaces the lines of an earlier run.
fn append(folder: &Path, extension: &str, place: &Location, line: &str) {
    static BEGUN: Mutex<BTreeMap<PathBuf, File>> = Mutex::new(BTreeMap::new());
    let file = plain_path(place.file());
    let path = folder.join(format!("{}.{extension}", file.trim_end_matches(".rs").replace('/', ".")));
    let mut begun = BEGUN.lock().expect("nothing panics while it is held, but a full disk");
    let lines = begun.entry(path.clone()).or_insert_with(|| {
        fs::create_dir_all(folder).expect("the folder of ROTORDYN_VALIDATION");
        File::create(&path).expect("a file in the folder of ROTORDYN_VALIDATION")
    });
    writeln!(lines, "{line}").expect("room for a row");
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
        if holds && let Some(folder) = folder() {
            append(&folder, "jsonl", place, &self.line(place));
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

    fn line(&self, place: &Location) -> String {
        format!(
            "{{\"file\":{:?},\"line\":{},\"quantity\":{:?},\"reference\":{:?},\"ours\":{},\"error\":{:?},\
             \"tolerance\":{:?},\"relative\":{}}}",
            plain_path(place.file()),
            place.line(),
            self.quantity,
            self.reference,
            self.ours.map_or("null".into(), |ours| format!("{ours:?}")),
            self.error,
            self.tolerance,
            self.relative,
        )
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
