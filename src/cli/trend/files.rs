//! The records that files and folders name.

use std::io::Read;
use std::path::{Path, PathBuf};

use rotordyn::io::measured::Format;
use rotordyn::io::results_file::newest_results;

use super::super::failure::Failure;
use super::names::natural_order;

/// A record to read.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// A file, or the folder of a stored run.
    pub path: PathBuf,
    /// Name of the file, with its folder if another has the same.
    pub name: String,
}

/// Bytes of a file by which a table of numbers is told from other text.
const TABLE_HEAD: usize = 4096;

/// The records of files and folders in their order, folders in the natural order of their names; and the names of
/// what is in the folders but no record.
///
/// # Errors
/// A folder that cannot be read or has no record.
pub fn sources(given: &[PathBuf]) -> Result<(Vec<Source>, Vec<String>), Failure> {
    let (mut paths, mut others) = (Vec::new(), Vec::new());
    for path in given {
        if !path.is_dir() || is_run(path) {
            paths.push(path.clone());
            continue;
        }
        let failed = |error| Failure::environment("read folder", path, error);
        let mut names: Vec<String> = Vec::new();
        for entry in std::fs::read_dir(path).map_err(failed)? {
            let name = entry.map_err(failed)?.file_name();
            match name.into_string() {
                Ok(name) => names.push(name),
                Err(name) => others.push(name.to_string_lossy().into_owned()),
            }
        }
        names.sort_by(|a, b| natural_order(a, b));
        let before = paths.len();
        for name in names.into_iter().filter(|name| !name.starts_with('.')) {
            let file = path.join(&name);
            if is_run(&file) || (file.is_file() && is_record(&file)) {
                paths.push(file);
            } else {
                others.push(name);
            }
        }
        if paths.len() == before {
            let with = if others.is_empty() {
                "it is empty".into()
            } else {
                format!("it has {}", others.join(", "))
            };
            return Err(Failure::Input(format!(
                "{}: the folder contains no record ({with}); expected .mat, .csv, .txt, .lvm, .wav, .uff, .npz or .h5 files, or \
                 folders of stored runs",
                path.display()
            )));
        }
    }
    let base = |path: &Path| {
        path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned())
    };
    let bases: Vec<String> = paths.iter().map(|path| base(path)).collect();
    let mut sorted = bases.clone();
    sorted.sort();
    let twice =
        |name: &String| sorted.partition_point(|n| n <= name) - sorted.partition_point(|n| n < name) > 1;
    let named = paths.into_iter().zip(bases).map(|(path, base)| {
        let name = if twice(&base) { path.display().to_string() } else { base };
        Source { path, name }
    });
    Ok((named.collect(), others))
}

/// Whether a folder has the results of a stored run.
fn is_run(path: &Path) -> bool {
    path.is_dir() && newest_results(path).is_file()
}

/// Whether a file of a folder may be a record: its format is known by its content; text has lines of numbers.
///
/// A file that cannot be opened, and one with an extension of a record whatever is in it, is one: reading it says why not.
fn is_record(path: &Path) -> bool {
    let mut head = Vec::new();
    let opened =
        std::fs::File::open(path).and_then(|file| file.take(TABLE_HEAD as u64).read_to_end(&mut head));
    let by_name = Format::of_extension(path);
    if opened.is_err() {
        return by_name.is_some();
    }
    match Format::of_content(&head) {
        Some(Format::Table) if by_name.is_none() || is_text_file(path) => has_numbers(&head),
        Some(_) => true,
        None => by_name.is_some(),
    }
}

/// Whether the extension is also that of plain text.
fn is_text_file(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("txt"))
}

/// Whether the last whole line of a text begins with a number.
fn has_numbers(head: &[u8]) -> bool {
    let text = String::from_utf8_lossy(head).replace('\0', "");
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    // The last one may be cut off.
    let line = lines.iter().rev().nth(usize::from(head.len() == TABLE_HEAD && lines.len() > 1));
    line.is_some_and(|line| {
        let cell = line.trim().split([',', ';', '\t', ' ']).next().unwrap_or_default();
        cell.trim_matches('"').starts_with(|c: char| c.is_ascii_digit() || matches!(c, '-' | '+' | '.'))
    })
}
