//! The speed chapter, from the times that `benches/times.py` collects of `cargo bench` and that are kept with the sources.

use serde_json::Value;
use std::fmt::Write;

/// Table of all benchmarks, with the machine and the date; `None` without kept times.
///
/// # Errors
/// A text that is not of `benches/times.py`.
pub fn chapter(times: Option<&str>) -> Result<String, String> {
    let mut out = String::from(
        "# Speed\n\nTimes of the benchmarks in `benches/`, as criterion measured them (`cargo bench`, then \
         `python3 benches/times.py`). They say what a change costs; another machine has other times.\n\n",
    );
    let Some(times) = times else {
        out += "No times are kept with this copy of the sources.\n";
        return Ok(out);
    };
    let value: Value = serde_json::from_str(times).map_err(|error| format!("benches/times.json: {error}"))?;
    let told = |what: &str| format!("benches/times.json has no {what}");
    let text = |name: &str| value[name].as_str().ok_or_else(|| told(name));
    let _ = write!(
        out,
        "Measured on {} at commit `{}`, {}.\n\n",
        text("date")?,
        text("commit")?,
        crate::reference::plain(text("machine")?)
    );
    out += "| benchmark | mean | ± (95 %) |\n|---|---:|---:|\n";
    let rows = value["times"].as_array().filter(|rows| !rows.is_empty()).ok_or_else(|| told("times"))?;
    for row in rows {
        let number = |name: &str| row[name].as_f64().ok_or_else(|| told(name));
        let name = row["name"].as_str().ok_or_else(|| told("name"))?;
        let name = crate::reference::plain(name);
        let _ = writeln!(out, "| {name} | {} | {} |", seconds(number("mean_s")?), seconds(number("half_s")?));
    }
    Ok(out)
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
    fn times_become_rows() {
        let times = |rows: &str| {
            format!(
                "{{\"date\":\"2026-01-02\",\"commit\":\"abc\",\"machine\":\"2 cores\",\"times\":[{rows}]}}"
            )
        };
        let row = "{\"name\":\"run_up/rig\",\"mean_s\":0.015,\"half_s\":0.001}";
        let got = chapter(Some(&times(row))).unwrap();
        assert!(got.contains("Measured on 2026-01-02 at commit `abc`, 2 cores."), "{got}");
        assert!(got.contains("| run\\_up/rig | 15.0 ms | 1.00 ms |"), "{got}");
        assert!(chapter(Some(&times(""))).unwrap_err().contains("times"));
        assert!(chapter(Some(&times("{\"name\":\"a\"}"))).unwrap_err().contains("mean_s"));
        assert!(chapter(Some("{}")).is_err());
        assert!(chapter(None).unwrap().contains("No times"));
    }
}
