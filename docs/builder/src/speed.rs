//! The speed chapter, from the estimates that `cargo bench` leaves.

use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// A measured time: name of the benchmark, mean and half of the 95 % interval \[s\].
type Row = (String, f64, f64);

/// Table of all benchmarks; words on how to get one without them.
///
/// # Errors
/// An estimate that cannot be read.
pub fn chapter(criterion: &Path) -> Result<String, String> {
    let mut rows = Vec::new();
    if criterion.is_dir() {
        collect(criterion, criterion, &mut rows)?;
    }
    rows.sort_by(|a, b| a.0.cmp(&b.0));
    let mut out = String::from(
        "# Speed\n\nTimes of the benchmarks in `benches/` on the machine that built this book, as criterion measured them \
         (`cargo bench`, then build the book). They say what a change costs; another machine has other times.\n\n",
    );
    if rows.is_empty() {
        out += "This copy of the book was built without measured times.\n";
        return Ok(out);
    }
    out += "| benchmark | mean | ± (95 %) |\n|---|---:|---:|\n";
    for (name, mean, half) in rows {
        let _ =
            writeln!(out, "| {} | {} | {} |", crate::reference::plain(&name), seconds(mean), seconds(half));
    }
    Ok(out)
}

fn collect(root: &Path, folder: &Path, rows: &mut Vec<Row>) -> Result<(), String> {
    let told = |error: std::io::Error| format!("{}: {error}", folder.display());
    for entry in fs::read_dir(folder).map_err(told)? {
        let path = entry.map_err(told)?.path();
        if !path.is_dir() {
            continue;
        }
        let estimates = path.join("estimates.json");
        if path.file_name().is_some_and(|name| name == "new") && estimates.is_file() {
            rows.push(row(root, folder, &estimates)?);
        } else {
            collect(root, &path, rows)?;
        }
    }
    Ok(())
}

fn row(root: &Path, folder: &Path, estimates: &Path) -> Result<Row, String> {
    let told = |error: &dyn std::fmt::Display| format!("{}: {error}", estimates.display());
    let text = fs::read_to_string(estimates).map_err(|error| told(&error))?;
    let value: Value = serde_json::from_str(&text).map_err(|error| told(&error))?;
    let number = |of: &Value| of.as_f64().ok_or_else(|| told(&"no mean with its interval"));
    let mean = &value["mean"];
    let interval = &mean["confidence_interval"];
    let half = 0.5 * (number(&interval["upper_bound"])? - number(&interval["lower_bound"])?);
    let name = folder.strip_prefix(root).unwrap_or(folder).display().to_string();
    Ok((name, 1e-9 * number(&mean["point_estimate"])?, 1e-9 * half))
}

/// A time with three digits.
fn seconds(time: f64) -> String {
    let (factor, unit) = match time {
        t if t >= 1.0 => (1.0, "s"),
        t if t >= 1e-3 => (1e3, "ms"),
        t if t >= 1e-6 => (1e6, "µs"),
        _ => (1e9, "ns"),
    };
    let value = time * factor;
    let digits = if value >= 100.0 {
        0
    } else if value >= 10.0 {
        1
    } else {
        2
    };
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimates_become_rows() {
        let folder = tempfile::tempdir().unwrap();
        assert!(chapter(folder.path()).unwrap().contains("without measured times"));
        let new = folder.path().join("run_up/rig/new");
        fs::create_dir_all(&new).unwrap();
        let text = r#"{"mean":{"confidence_interval":{"lower_bound":1.4e7,"upper_bound":1.6e7},"point_estimate":1.5e7}}"#;
        fs::write(new.join("estimates.json"), text).unwrap();
        let got = chapter(folder.path()).unwrap();
        assert!(got.contains("| run\\_up/rig | 15.0 ms | 1.00 ms |"), "{got}");
        fs::write(new.join("estimates.json"), "{}").unwrap();
        assert!(chapter(folder.path()).unwrap_err().contains("no mean"));
    }
}
