//! The page of every ball bearing for its designer: as stored, else computed from the machine for the page.

use super::arrays::Arrays;
use super::{items, tree};
use rotordyn_core::model::Model;
use rotordyn_core::model::study::{BearingStudy, BearingSweep, SweepVariable};
use rotordyn_core::study::Machine;
use rotordyn_io::error::Error;
use rotordyn_io::hdf5::{Attribute, Reader};
use rotordyn_model::catalogue::{CLEARANCE_CLASSES, clearance};
use rotordyn_plot::figures;
use serde_json::{Value, json};

/// Most bearings that are computed for the page.
const MOST_COMPUTED: usize = 12;
/// Groups of a stored bearing with what older files do not have.
const PARTS: [(&str, &str); 2] =
    [("geometry", "the internal geometry"), ("limits/state", "the limits with their figures")];

/// An entry for each ball bearing: its name, whether it is stored, else its tree and drawing or why there is none, what an
/// older file does not have of it, and its clearance classes.
pub(crate) fn read(
    reader: &dyn Reader,
    machine: Option<&Machine>,
    arrays: &mut Arrays,
) -> Result<Vec<Value>, Error> {
    let is_bearing =
        |path: &str| Ok(matches!(reader.attribute(path, "load_source")?, Some(Attribute::Text(_))));
    let stored = items::groups(reader, "/bearings", &is_bearing)?;
    let mut out = Vec::new();
    for name in &stored {
        let at = format!("/bearings/{name}");
        let missing = |part: &&(&str, &str)| !reader.contains(&format!("{at}/{}", part.0)).unwrap_or(false);
        let absent: Vec<&str> = PARTS.iter().filter(missing).map(|(_, words)| *words).collect();
        let bore = match reader.attribute(&format!("{at}/geometry"), "bore") {
            Ok(Some(Attribute::Number(bore))) => Some(bore),
            _ => None,
        };
        let classes = bore.map_or(Value::Null, classes);
        out.push(json!({ "name": name, "stored": true, "absent": absent, "classes": classes }));
    }
    if let Some(machine) = machine {
        for name in names(&machine.model).into_iter().filter(|name| !stored.contains(name)) {
            let entry = match out.len() < MOST_COMPUTED + stored.len() {
                true => computed(machine, &name, arrays)?,
                false => {
                    failed(&name, "it is not computed for the page, since the machine has many bearings")
                }
            };
            out.push(entry);
        }
    }
    Ok(out)
}

/// Names of the bearings with balls in statics.
fn names(model: &Model) -> Vec<String> {
    let balls = model.bearings.iter().filter(|site| site.bearing.static_balls().is_some());
    balls.map(|site| site.name.clone()).collect()
}

fn failed(name: &str, why: &str) -> Value {
    json!({ "name": name, "stored": false, "failed": why })
}

/// The bearing under its load in the machine at the highest speed, with sweeps over load and speed.
fn computed(machine: &Machine, name: &str, arrays: &mut Arrays) -> Result<Value, Error> {
    let model = &machine.model;
    let site = model.bearings.iter().find(|site| site.name == name);
    let Some(ball) = site.and_then(|site| site.bearing.static_balls()) else {
        return Ok(failed(name, "it has no balls in statics"));
    };
    // A film without a formula is solved, contact by contact.
    if !ball.contact.is_dry() && !ball.contact.has_film_formula() {
        return Ok(failed(name, "its EHL films take too long for the page"));
    }
    let depends_on_speed = ball.depends_on_speed() || ball.lubricant().is_some();
    let swept = [SweepVariable::Load].into_iter().chain(depends_on_speed.then_some(SweepVariable::Speed));
    let study = BearingStudy {
        bearings: vec![name.into()],
        sweeps: swept.map(|variable| BearingSweep { variable, values: Vec::new() }).collect(),
        ..BearingStudy::default()
    };
    let found = match machine.static_bearings(&study) {
        Ok(found) => found,
        Err(problem) => return Ok(failed(name, &problem.to_string())),
    };
    let Some(found) = found.first() else { return Ok(failed(name, "it is not analysed alone")) };
    let section = found.section();
    let figure = figures::bearing_sheet(found, &model.title).svg().ok();
    let warnings: Vec<&str> = found.warnings.iter().map(|warning| warning.text.as_str()).collect();
    Ok(json!({
        "name": name,
        "stored": false,
        "tree": tree::of_document(&section.content, arrays)?,
        "classes": classes(found.bearing.geometry.bore),
        "sheet": figure,
        "warnings": warnings,
    }))
}

/// Clearance classes of ISO 5753-1 at a bore: name, least and greatest radial internal clearance \[m\].
fn classes(bore: f64) -> Value {
    let rows = CLEARANCE_CLASSES.iter().filter_map(|class| Some((class, clearance(class, bore)?)));
    rows.map(|(class, [least, most])| json!({ "name": class, "least": least, "most": most })).collect()
}
