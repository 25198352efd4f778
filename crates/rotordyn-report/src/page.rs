//! The page from its parts.

use super::arrays::Arrays;
use super::captions::caption;
use super::markup::escape;
use super::{bearings, history, machine_view, model_table, overview, stored, summary};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use rotordyn_core::study::Machine;
use rotordyn_io::atomic_file;
use rotordyn_io::error::Error;
use rotordyn_io::hdf5::{Attribute, Reader};
use rotordyn_model::{DefaultValue, GivenValue};
use serde_json::json;
use std::path::Path;

const TEMPLATE: &str = include_str!("../../../assets/report/page.html");
const STYLE: &str = include_str!("../../../assets/report/style.css");
/// Libraries, then the page's own scripts in the order of their use.
const SCRIPTS: [&str; 12] = [
    include_str!("../../../assets/report/vendor/plotly-cartesian.min.js"),
    include_str!("../../../assets/report/vendor/three.min.js"),
    include_str!("../../../assets/report/data.js"),
    include_str!("../../../assets/report/dom.js"),
    include_str!("../../../assets/report/charts.js"),
    include_str!("../../../assets/report/campbell.js"),
    include_str!("../../../assets/report/shapes.js"),
    include_str!("../../../assets/report/responses.js"),
    include_str!("../../../assets/report/run_up.js"),
    include_str!("../../../assets/report/bearings.js"),
    include_str!("../../../assets/report/bearing_charts.js"),
    include_str!("../../../assets/report/page.js"),
];

/// What a page is made of.
#[derive(Clone)]
pub struct Report<'a> {
    /// The results file.
    pub reader: &'a dyn Reader,
    /// The machine of the file's model; without it nothing is drawn of it.
    pub machine: Option<&'a Machine>,
    /// Values that the model file gives, and those taken by default.
    pub given: &'a [GivenValue],
    pub defaults: &'a [DefaultValue],
    /// Drawn figures: names and SVG documents.
    pub figures: &'a [(String, String)],
    /// What the reader should know of the page itself.
    pub notes: Vec<String>,
}

/// Why a page was not written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error(transparent)]
    File(#[from] Error),
    #[error("the data of the page cannot be compressed: {0}")]
    Data(#[from] std::io::Error),
}

/// Writes the page of a run.
///
/// # Errors
/// The results cannot be read or the page cannot be written.
pub fn write(path: &Path, report: &Report) -> Result<(), ReportError> {
    let page = html(report)?;
    let write = |out: &mut dyn std::io::Write| out.write_all(page.as_bytes());
    atomic_file::write_with(path, |out| write(out)).map_err(Error::of_file("write", path))?;
    Ok(())
}

/// The page of a run.
///
/// # Errors
/// The results cannot be read.
pub fn html(report: &Report) -> Result<String, ReportError> {
    let Report { reader, machine, given, defaults, figures, ref notes } = *report;
    let text = |name: &str| -> Result<String, Error> {
        Ok(match reader.attribute("/meta", name)? {
            Some(Attribute::Text(text)) => text,
            _ => String::new(),
        })
    };
    let mut arrays = Arrays::default();
    let tree = stored::read(reader, &mut arrays)?;
    let mut notes = notes.clone();
    if !tree.left_out.is_empty() {
        notes.push(format!("Too large for this page, see results.h5: {}", tree.left_out.join(", ")));
    }
    let drawn = figures
        .iter()
        .filter_map(|(name, svg)| Some(json!({ "name": name, "caption": caption(name)?, "svg": svg })));
    let head = json!({
        "results": tree.root,
        "machine": machine.map(|machine| machine_view::view(&machine.model, &mut arrays)),
        "bearings": bearings::read(reader, machine, &mut arrays)?,
        "history": history::read(reader, &mut arrays)?,
        "figures": drawn.collect::<Vec<_>>(),
    });
    let lines = match machine {
        Some(machine) => summary::lines(reader, &machine.model)?,
        None => Vec::new(),
    };
    let title = match text("title")? {
        title if title.is_empty() => "Results of rotordyn".into(),
        title => title,
    };
    let mut subtitle = vec![format!("rotordyn {}", text("version")?)];
    for (name, words) in [("variant", "variant"), ("settings", "with"), ("identity", "run")] {
        let value = text(name)?;
        if !value.is_empty() {
            subtitle.push(format!("{words} {}", value.replace('\n', ", ")));
        }
    }
    let parts = [
        ("{title}", escape(&title)),
        ("{subtitle}", escape(&subtitle.join(" · "))),
        ("{version}", escape(env!("CARGO_PKG_VERSION"))),
        ("{identity}", escape(&text("identity")?)),
        ("{style}", STYLE.into()),
        ("{overview}", overview::section(reader, machine, &lines, &notes)?),
        ("{model}", model_table::section(given, defaults, &text("model")?)),
        ("{data}", STANDARD.encode(arrays.packed(&head)?)),
        ("{scripts}", SCRIPTS.map(in_script).join("\n")),
    ];
    Ok(filled(TEMPLATE, &parts))
}

/// A script inside the page: nothing in it ends its element.
fn in_script(script: &str) -> String {
    script.replace("</script", "<\\/script").replace("<!--", "<\\!--")
}

/// The template with its parts; names in braces within the parts stay as they are.
fn filled(template: &str, parts: &[(&str, String)]) -> String {
    let size = template.len() + parts.iter().map(|(_, text)| text.len()).sum::<usize>();
    let mut out = String::with_capacity(size);
    let mut rest = template;
    let next =
        |rest: &str| parts.iter().filter_map(|(name, text)| Some((rest.find(name)?, *name, text))).min();
    while let Some((at, name, text)) = next(rest) {
        out.push_str(&rest[..at]);
        out.push_str(text);
        rest = &rest[at + name.len()..];
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_filled_in_once() {
        let parts = [("{a}", "{b}".to_string()), ("{b}", "2".to_string())];
        assert_eq!(filled("x {a} {b} {a}", &parts), "x {b} 2 {b}");
    }

    #[test]
    fn scripts_do_not_end_their_element() {
        for script in SCRIPTS.map(in_script) {
            assert!(!script.to_lowercase().contains("</script"));
        }
    }
}
