//! The validation chapter, from the rows that tests write where `ROTORDYN_VALIDATION` names a folder.
//!
//! `tests/common/agree.rs` writes them: one line of JSON for each comparison with a reference, one file for each file of
//! tests, and one for its curves.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use crate::curves::Compared;
use crate::reference::plain;

/// More comparisons by one statement of a test than these are shown as one row: the worst.
const SHOWN: usize = 6;

/// Least number of rows of a complete chapter.
pub const LEAST_ROWS: usize = 150;

/// A comparison with a reference.
#[derive(Clone, Debug)]
struct Row {
    line: usize,
    quantity: String,
    reference: f64,
    /// None: a curve, of which only the largest deviation is known.
    ours: Option<f64>,
    error: f64,
    tolerance: f64,
    relative: bool,
}

/// The chapter.
#[derive(Debug)]
pub struct Validation {
    pub text: String,
    /// Rows of its tables.
    pub rows: usize,
    /// Comparisons that the tests made.
    pub comparisons: usize,
    /// Figures of curves: name in the folder of pictures, SVG document.
    pub pictures: Vec<(String, String)>,
}

/// Folders of tests with their headings, in the order of the chapter.
const PARTS: [(&str, &str, &str); 6] = [
    (
        "literature",
        "Published values",
        "Books, papers, standards, manufacturers' data, and results of other programs (ROSS, independent programs \
         written from the papers).",
    ),
    ("cross", "Independent implementations", "The same quantity by other libraries."),
    ("analytic", "Closed forms", "Exact solutions."),
    ("identities", "Theorems", "What must hold for any machine."),
    ("convergence", "Orders of convergence", "Errors over step and element length."),
    ("", "Other references", "Comparisons of other tests."),
];

/// Chapter of all rows in a folder.
///
/// # Errors
/// A row or a file of tests that cannot be read.
pub fn chapter(rows_folder: &Path, root: &Path) -> Result<Validation, String> {
    let (files, curves) = read(rows_folder)?;
    let mut out = Validation { text: String::new(), rows: 0, comparisons: 0, pictures: Vec::new() };
    let mut body = String::new();
    for (folder, title, about) in PARTS {
        let here: Vec<(&String, &Vec<Row>)> = files.iter().filter(|(file, _)| part(file) == folder).collect();
        if here.is_empty() {
            continue;
        }
        let _ = write!(body, "\n## {title}\n\n{about}\n");
        for (file, rows) in here {
            let source = Source::read(root, file)?;
            let _ = write!(body, "\n### {}\n\n{}\n\n", plain(&name(file)), plain(&source.about));
            let _ = write!(body, "Test: `{file}`.\n\n");
            body +=
                "| case | quantity | reference | ours | error | tolerance |\n|---|---|---:|---:|---:|---:|\n";
            for (line, rows) in by_line(rows) {
                out.comparisons += rows.len();
                let shown = shown(&rows);
                out.rows += shown.len();
                for (quantity, row) in shown {
                    body += &table_row(&source.test(line), &quantity, row);
                }
            }
            for (k, curve) in curves.get(&key(file)).into_iter().flatten().enumerate() {
                let picture = format!("{}.{k}.svg", key(file));
                let caption = format!("{}: {}", source.test(curve.line), curve.quantity);
                let _ = write!(body, "\n![{}](pictures/{picture})\n", plain(&caption));
                out.pictures.push((picture, curve.svg()?));
            }
        }
    }
    out.text = format!(
        "# Validation\n\nWritten by the tests themselves: each comparison with a reference asserts and leaves a row here. \
         An error is relative to the reference unless *abs.* stands behind it, and has one digit; where one statement \
         compares many values, the row shows the worst of them. Below the tables curves lie over their references.\n\n\
         {} rows for {} comparisons.\n{body}",
        out.rows, out.comparisons
    );
    if files.is_empty() {
        out.text = "# Validation\n\nThis copy of the book was built without the rows of the tests: run the tests with \
                    `ROTORDYN_VALIDATION` naming an empty folder, then build the book.\n"
            .into();
    }
    Ok(out)
}

/// Folder of tests that a file belongs to, as in [`PARTS`].
fn part(file: &str) -> &'static str {
    PARTS
        .iter()
        .map(|(folder, ..)| *folder)
        .find(|folder| file.contains(&format!("tests/{folder}/")))
        .unwrap_or("")
}

/// Name of a file of tests as a heading.
fn name(file: &str) -> String {
    let stem = Path::new(file).file_stem().map_or(file.into(), |stem| stem.to_string_lossy());
    let mut words = stem.replace('_', " ");
    if let Some(first) = words.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    words
}

/// Name of the files of rows and pictures.
fn key(file: &str) -> String {
    file.trim_end_matches(".rs").replace('/', ".")
}

/// Rows of every file by its path, curves of every file by its key, both in an order that does not depend on that of the
/// tests.
type Read = (BTreeMap<String, Vec<Row>>, BTreeMap<String, Vec<Compared>>);

fn read(folder: &Path) -> Result<Read, String> {
    let (mut rows, mut curves): Read = Default::default();
    if !folder.is_dir() {
        return Ok((rows, curves));
    }
    let told = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut paths: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(folder).map_err(told)? {
        paths.push(entry.map_err(told)?.path());
    }
    paths.sort();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let text = || fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()));
        let wrong = |line: &str| format!("{}: not of a test: {line}", path.display());
        if let Some(key) = name.strip_suffix(".curves") {
            let found: Option<Vec<Compared>> = text()?.lines().map(Compared::read).collect();
            curves.insert(key.into(), found.ok_or_else(|| wrong("a curve"))?);
        } else if name.ends_with(".jsonl") {
            for line in text()?.lines() {
                let (file, row) = row(line).ok_or_else(|| wrong(line))?;
                rows.entry(file).or_default().push(row);
            }
        }
    }
    for rows in rows.values_mut() {
        // Tests run in any order, and some compare in parallel.
        rows.sort_by(|a, b| {
            let order = a.line.cmp(&b.line).then_with(|| a.quantity.cmp(&b.quantity));
            order.then_with(|| a.reference.total_cmp(&b.reference)).then_with(|| a.error.total_cmp(&b.error))
        });
    }
    for curves in curves.values_mut() {
        curves.sort_by(|a, b| a.line.cmp(&b.line).then_with(|| a.quantity.cmp(&b.quantity)));
    }
    Ok((rows, curves))
}

fn row(line: &str) -> Option<(String, Row)> {
    let value: Value = serde_json::from_str(line).ok()?;
    let number = |name: &str| value[name].as_f64();
    let row = Row {
        line: value["line"].as_u64()? as usize,
        quantity: value["quantity"].as_str()?.into(),
        reference: number("reference")?,
        ours: number("ours"),
        error: number("error")?,
        tolerance: number("tolerance")?,
        relative: value["relative"].as_bool()?,
    };
    Some((value["file"].as_str()?.into(), row))
}

fn by_line(rows: &[Row]) -> BTreeMap<usize, Vec<&Row>> {
    let mut out: BTreeMap<usize, Vec<&Row>> = BTreeMap::new();
    for row in rows {
        out.entry(row.line).or_default().push(row);
    }
    out
}

/// The rows of one statement, or the worst of many.
fn shown<'r>(rows: &[&'r Row]) -> Vec<(String, &'r Row)> {
    if rows.len() <= SHOWN {
        return rows.iter().map(|row| (row.quantity.clone(), *row)).collect();
    }
    let share = |row: &Row| row.error / row.tolerance;
    let worst = rows.iter().copied().max_by(|a, b| share(a).total_cmp(&share(b)));
    worst.into_iter().map(|row| (format!("{} (worst of {})", row.quantity, rows.len()), row)).collect()
}

fn table_row(case: &str, quantity: &str, row: &Row) -> String {
    let kind = if row.relative { "" } else { " abs." };
    let ours = row.ours.map_or("curve".into(), six_digits);
    format!(
        "| {} | {} | {} | {ours} | {}{kind} | {}{kind} |\n",
        plain(case),
        plain(quantity),
        six_digits(row.reference),
        error(row),
        one_digit(row.tolerance),
    )
}

/// A value with six digits.
fn six_digits(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let exponent = value.abs().log10().floor();
    if !(-4.0..7.0).contains(&exponent) {
        let text = format!("{value:.5e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{power}", shortened(digits));
    }
    let decimals = (5.0 - exponent).max(0.0) as usize;
    shortened(&format!("{value:.decimals$}"))
}

/// Without zeros at the end of decimals.
fn shortened(digits: &str) -> String {
    match digits.contains('.') {
        true => digits.trim_end_matches('0').trim_end_matches('.').into(),
        false => digits.into(),
    }
}

/// The error with one digit; round-off, which the order of sums decides, is not told apart.
fn error(row: &Row) -> String {
    let scale = if row.relative { 1.0 } else { row.reference.abs().max(row.tolerance) };
    match row.error {
        0.0 => "0".into(),
        e if e < 1e-12 * scale => format!("< {}", one_digit(1e-12 * scale)),
        e => one_digit(e),
    }
}

fn one_digit(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    format!("{value:.0e}")
}

/// A file of tests: what its head says, and where its tests begin.
struct Source {
    about: String,
    tests: Vec<(usize, String)>,
}

impl Source {
    fn read(root: &Path, file: &str) -> Result<Self, String> {
        let path = root.join(file);
        let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let head = text.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim);
        let about: Vec<&str> = head.take_while(|line| !line.is_empty()).collect();
        let function = |line: &str| {
            let line = line.trim_start_matches("pub ");
            let name = line.strip_prefix("fn ")?;
            name.split(['(', '<']).next().map(String::from)
        };
        let tests = text.lines().enumerate().filter_map(|(k, line)| Some((k + 1, function(line)?))).collect();
        Ok(Self { about: about.join(" ").replace("\\[", "[").replace("\\]", "]"), tests })
    }

    /// The test that a line stands in, in words.
    fn test(&self, line: usize) -> String {
        let before = self.tests.iter().rev().find(|(first, _)| *first <= line);
        before.map_or(String::new(), |(_, name)| name.replace('_', " "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_become_a_chapter_with_the_words_of_the_tests() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        fs::create_dir_all(root.join("tests/literature")).unwrap();
        let source = "//! A book of 1970: values.\n//!\n//! More.\n\n#[test]\nfn first_frequency() {\n    compare();\n}\n";
        fs::write(root.join("tests/literature/book_1970.rs"), source).unwrap();
        let row = |line: usize, what: &str, error: f64| {
            format!(
                "{{\"file\":\"tests/literature/book_1970.rs\",\"line\":{line},\"quantity\":\"{what}\",\"reference\":10.0,\
                 \"ours\":10.001,\"error\":{error},\"tolerance\":0.001,\"relative\":true}}\n"
            )
        };
        let many: String = (0..9).map(|k| row(7, &format!("K[{k}]"), 1e-5 * f64::from(k))).collect();
        let rows = root.join("rows");
        fs::create_dir(&rows).unwrap();
        fs::write(rows.join("tests.literature.book_1970.jsonl"), row(6, "f|1", 1e-4) + &many).unwrap();
        let got = chapter(&rows, root).unwrap();
        assert_eq!((got.rows, got.comparisons), (2, 10));
        assert!(got.text.contains("### Book 1970\n\nA book of 1970: values."), "{}", got.text);
        assert!(got.text.contains("| first frequency | f\\|1 | 10 | 10.001 | 1e-4 | 1e-3 |"), "{}", got.text);
        assert!(got.text.contains("K\\[8\\] (worst of 9)"), "{}", got.text);
        // The order in which tests run changes nothing, nor does the last digit of round-off.
        let lines = format!("{}{}", row(6, "f|1", 1e-4), many);
        let turned: String = lines.lines().rev().map(|line| format!("{line}\n")).collect();
        let shifted = turned.replace("\"error\":0.0001,", "\"error\":0.00010000000000003,");
        assert!(shifted != turned);
        fs::write(rows.join("tests.literature.book_1970.jsonl"), shifted).unwrap();
        assert_eq!(chapter(&rows, root).unwrap().text, got.text);
        let curve = |of: &str| {
            format!(
                "{{\"line\":6,\"quantity\":\"{of}\",\"unit\":\"m\",\"over\":\"t\",\"over_unit\":\"s\",\"x\":[0,1],\"ours\":[1,2],\
                 \"reference\":[1,2]}}\n"
            )
        };
        fs::write(rows.join("tests.literature.book_1970.curves"), curve("b") + &curve("a")).unwrap();
        let drawn = chapter(&rows, root).unwrap();
        assert_eq!(drawn.pictures.len(), 2);
        let picture = "![first frequency: a](pictures/tests.literature.book_1970.0.svg)";
        assert!(drawn.text.contains(picture), "{}", drawn.text);
        fs::write(rows.join("broken.jsonl"), "{}\n").unwrap();
        assert!(chapter(&rows, root).unwrap_err().contains("broken.jsonl"));
    }

    #[test]
    fn digits() {
        assert_eq!(six_digits(51.599_96), "51.6");
        assert_eq!(six_digits(1.234_567_89e9), "1.23457e9");
        assert_eq!(six_digits(-2.5e-7), "-2.5e-7");
        assert_eq!(six_digits(1_234_567.0), "1234567");
        assert_eq!(one_digit(0.000_34), "3e-4");
    }
}
