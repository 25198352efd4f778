//! What a reader needs first: state of the results, warnings, the machine's drawing, the summary.

use super::markup::escape;
use super::summary::Line;
use rotordyn_core::study::Machine;
use rotordyn_io::error::Error;
use rotordyn_io::hdf5::{COMPLETE, Reader};
use rotordyn_io::results_file::results_state;
use rotordyn_plot::figures;
use std::fmt::Write as _;

/// State, warnings, drawing and summary.
pub(crate) fn section(
    reader: &dyn Reader,
    machine: Option<&Machine>,
    lines: &[Line],
    notes: &[String],
) -> Result<String, Error> {
    let mut out = String::from("<ul class=\"warnings\">\n");
    let state = results_state(reader)?;
    let mut any = false;
    if state != COMPLETE {
        any = true;
        let _ = writeln!(out, "<li class=\"error\"><code>incomplete</code> {}</li>", escape(&state));
    }
    for warning in stored_warnings(reader)? {
        any = true;
        let [code, severity, item, text, advice] = warning.map(|words| escape(&words));
        let class = if severity == "error" { " class=\"error\"" } else { "" };
        let item = if item.is_empty() || text.contains(&item) { String::new() } else { format!("{item}: ") };
        // Writing to a text cannot fail.
        let _ = writeln!(
            out,
            "<li{class}><code>{code}</code> {item}{text}<span class=\"advice\">{advice}</span></li>"
        );
    }
    for note in notes {
        any = true;
        let _ = writeln!(out, "<li>{}</li>", escape(note));
    }
    out += "</ul>\n";
    if !any {
        out = "<p class=\"none\">No warnings.</p>\n".into();
    }
    if !lines.is_empty() {
        out += "<table class=\"summary\"><tbody>\n";
        for Line { what, value, detail } in lines {
            let [what, value, detail] = [what, value, detail].map(|words| escape(words));
            let _ =
                writeln!(out, "<tr><td>{what}</td><td><strong>{value}</strong></td><td>{detail}</td></tr>");
        }
        out += "</tbody></table>\n";
    }
    if let Some(svg) = machine.and_then(|machine| figures::layout(machine).1.svg().ok()) {
        let drawing = svg.find("<svg").map_or("", |start| &svg[start..]);
        let _ = writeln!(
            out,
            "<figure class=\"drawing\">{drawing}<figcaption>The machine to scale, side view.</figcaption></figure>"
        );
    }
    Ok(out)
}

/// Code, severity, item, text and advice of every warning in the file.
fn stored_warnings(reader: &dyn Reader) -> Result<Vec<[String; 5]>, Error> {
    if !reader.contains("/warnings/text")? {
        return Ok(Vec::new());
    }
    let columns = ["code", "severity", "item", "text", "advice"];
    let read = |name: &str| match reader.contains(&format!("/warnings/{name}"))? {
        true => reader.read_texts(&format!("/warnings/{name}")),
        false => Ok(Vec::new()),
    };
    let columns = columns.iter().map(|name| read(name)).collect::<Result<Vec<_>, Error>>()?;
    let cell = |column: usize, row: usize| columns[column].get(row).cloned().unwrap_or_default();
    Ok((0..columns[3].len()).map(|row| std::array::from_fn(|column| cell(column, row))).collect())
}
