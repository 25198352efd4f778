//! `check`: validates a model with all its variants and prints a summary.

use std::path::PathBuf;

use rayon::prelude::*;
use rotordyn::assembly::rigid_body_modes;
use rotordyn::io::json;
use rotordyn::linalg::dot;
use rotordyn::model::{Diagnostic, Loaded, Model};
use rotordyn::study::Machine;
use rotordyn::warning::Warning;
use serde_json::{Value, json};

use super::args::ModelArgs;
use super::bearing_list::{self, ListedBearing};
use super::failure::Failure;
use super::machine::ModelSource;
use super::studies::Study;
use super::terminal::{Terminal, counted, number, rpm};
use super::{check_bearings, defaults, equilibrium_loads, forecast};

/// Check result of one variant.
struct CheckedVariant {
    name: String,
    loaded: Loaded,
    machine: Machine,
    /// Total mass \[kg\].
    mass: f64,
    rigid_body_modes: Vec<String>,
    /// Warnings beside those of the file.
    warnings: Vec<Warning>,
    /// Files that the model reads, with their sizes in bytes.
    side_files: Vec<(PathBuf, u64)>,
}

pub fn run(args: &ModelArgs, terminal: &Terminal) -> Result<Value, Failure> {
    let origin = ModelSource::read(args)?;
    let names: Vec<String> = match &origin.options.variant {
        Some(variant) => vec![variant.clone()],
        None => std::iter::once("base".to_string()).chain(origin.variants()).collect(),
    };
    // The first one separately: its errors usually apply to all variants.
    if origin.has_bearings_only() {
        return check_bearings::run(&origin, &names, terminal);
    }
    let (first, others) = names.split_first().ok_or_else(|| Failure::Input("nothing to check".into()))?;
    let first = check(&origin, first)?;
    let others: Vec<Result<CheckedVariant, (String, Failure)>> =
        others.par_iter().map(|name| check(&origin, name).map_err(|e| (name.clone(), e))).collect();

    summary(terminal, &first);
    let mut checked = vec![first];
    for other in others {
        match other {
            Ok(found) => checked.push(found),
            Err((name, failure)) => {
                terminal.print("");
                terminal.error(&format!("in variant `{name}`:"));
                return Err(failure);
            }
        }
    }
    defaults::table(terminal, &checked[0].loaded.defaults);
    let rows: Vec<Vec<String>> = checked
        .iter()
        .map(|c| {
            let free =
                if c.rigid_body_modes.is_empty() { "none".into() } else { c.rigid_body_modes.join("; ") };
            let dofs = c.machine.assembly.dofs.len().to_string();
            vec![c.name.clone(), number(c.mass, 4), dofs, free]
        })
        .collect();
    if checked.len() > 1 {
        terminal.table("Variants, all valid", &["variant", "mass kg", "DOFs", "rigid-body modes"], &rows);
    }
    side_file_table(terminal, &checked);
    for c in &checked {
        c.warnings.iter().for_each(|warning| terminal.warn(&warning.clone().prefixed(&c.name)));
        super::print_model_warnings(terminal, &c.loaded);
    }
    Ok(json!({
        "command": "check",
        "model": checked[0].loaded.model.name,
        "title": checked[0].loaded.model.title,
        "variants": checked.iter().map(to_json).collect::<Vec<_>>(),
    }))
}

fn check(origin: &ModelSource, variant: &str) -> Result<CheckedVariant, Failure> {
    let origin = origin.with_variant(variant);
    let loaded = origin.load(&[])?;
    loaded.refuse_conflicts()?;
    let side_files = origin.side_file_sizes()?;
    let machine = Machine::new(loaded.model.clone())?;
    let free = rigid_body_modes::rigid_body_modes_of_machine(&machine.model, &machine.assembly)?;
    let full = &machine.assembly.full_mass;
    // Unit rigid-body translation u along x: uᵀ M u is the total mass.
    let along: Vec<f64> =
        (0..machine.assembly.dofs.full_len()).map(|i| f64::from(u8::from(i % 6 == 0))).collect();
    let mass = dot(&full.mul(&along), &along);
    let speeds = Study::ALL.iter().flat_map(|study| study.speeds(&machine.model));
    let speeds: Vec<f64> = speeds.chain([machine.model.profile.top_speed()]).collect();
    let warnings = machine.support_warnings(&speeds);
    let name = variant.to_string();
    Ok(CheckedVariant { name, loaded, machine, mass, rigid_body_modes: free, warnings, side_files })
}

/// The files that the variants read beside the model file.
fn side_file_table(terminal: &Terminal, checked: &[CheckedVariant]) {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for CheckedVariant { name, side_files, .. } in checked {
        for (path, bytes) in side_files {
            let path = path.display().to_string();
            match rows.iter_mut().find(|row| row[0] == path) {
                Some(row) => row[2] += &format!(", {name}"),
                None => rows.push(vec![path, bytes.to_string(), name.clone()]),
            }
        }
    }
    if !rows.is_empty() {
        terminal.table("Files that the model reads", &["file", "bytes", "variants"], &rows);
    }
}

fn summary(terminal: &Terminal, found: &CheckedVariant) {
    let model = &found.loaded.model;
    let dofs = &found.machine.assembly.dofs;
    let discs: f64 = model.discs.iter().map(|d| d.mass).sum();
    // of a mass that differs by axis the one against gravity, as in the total
    let bodies = model.bodies.iter().map(|b| b.mass).chain(model.masses.iter().map(|m| m.mass));
    let bodies: f64 = bodies.map(|mass| mass[1]).sum();
    terminal.heading(&format!("{}: {}", model.name, model.title));
    let length = match (model.node_z.first(), model.node_z.last()) {
        (Some(a), Some(b)) => b - a,
        _ => 0.0,
    };
    let shaft = match &model.rigid_rotor {
        Some(rotor) => format!("rigid rotor, {} kg", number(rotor.mass, 4)),
        None => format!(
            "shaft {} mm in {}, {} kg",
            number(1e3 * length, 4),
            counted(model.shaft.len(), "element", "elements"),
            number(found.mass - discs - bodies, 4)
        ),
    };
    terminal.print(&format!(
        "  {shaft}; {}, {} kg; {}, {} kg;\n  total {} kg",
        counted(model.discs.len(), "disc", "discs"),
        number(discs, 4),
        counted(model.bodies.len() + model.masses.len(), "body or sensor", "bodies and sensors"),
        number(bodies, 4),
        number(found.mass, 4),
    ));
    terminal.print(&format!(
        "  {}, {} more eliminated by joints and drive; {}, {}, {}",
        counted(dofs.len(), "degree of freedom", "degrees of freedom"),
        dofs.full_len() - dofs.len(),
        counted(model.bushings.len(), "bushing", "bushings"),
        counted(model.joints.len(), "joint", "joints"),
        counted(model.belts.len(), "belt", "belts")
    ));
    let (top, duration) = (rpm(model.profile.top_speed()), model.profile.duration());
    if top > 0.0 {
        terminal.print(&format!("  speed profile of {} s up to {} rpm", number(duration, 4), number(top, 5)));
    }
    let requested: Vec<&str> =
        Study::ALL.iter().filter(|s| s.is_requested(&model.studies)).map(|s| s.name()).collect();
    terminal.print(&format!(
        "  studies: {}",
        if requested.is_empty() { "none".into() } else { requested.join(", ") }
    ));

    forecast::table(&found.machine, terminal);
    equilibrium_loads::belts(terminal, found.machine.belt_pulls());
    equilibrium_loads::preloads(terminal, found.machine.mounted_preloads());
    let rows: Vec<Vec<String>> = model
        .stations
        .iter()
        .map(|s| {
            vec![s.name.clone(), number(1e3 * s.z, 5), (s.node + 1).to_string(), components_at(model, s.node)]
        })
        .collect();
    terminal.table("Stations", &["station", "z mm", "node", "components"], &rows);

    bearing_list::print(terminal, &listed_bearings(model));
}

fn listed_bearings(model: &Model) -> Vec<ListedBearing<'_>> {
    let sites = model.bearings.iter();
    sites
        .map(|site| ListedBearing {
            name: &site.name,
            keyword: site.bearing.keyword(),
            description: site.bearing.description(),
            balls: site.bearing.ball(),
        })
        .collect()
}

/// Names of the components at a shaft node.
fn components_at(model: &Model, node: usize) -> String {
    let discs = model.discs.iter().filter(|d| d.node == node).map(|d| format!("disc.{}", d.name));
    let bearings = model.bearings.iter().filter(|b| b.node == node).map(|b| format!("bearing.{}", b.name));
    let unbalances =
        model.unbalances.iter().filter(|u| u.node == node).map(|u| format!("unbalance.{}", u.name));
    let rotor = model.rigid_rotor.iter().filter(|r| r.node == node).map(|r| r.name.clone());
    rotor.chain(discs).chain(bearings).chain(unbalances).collect::<Vec<_>>().join(", ")
}

/// Warnings of the file, then of the machine.
fn all_warnings(found: &CheckedVariant) -> Vec<Warning> {
    let of_file = found.loaded.warnings.iter().filter_map(Diagnostic::to_warning);
    of_file.chain(found.warnings.iter().cloned()).collect()
}

fn to_json(found: &CheckedVariant) -> Value {
    let side_files = found.side_files.iter().map(|(path, bytes)| json!({ "path": path, "bytes": bytes }));
    let side_files: Vec<Value> = side_files.collect();
    let belts: Vec<_> = found.machine.belt_pulls().iter().map(|b| (b.name.clone(), b.document())).collect();
    let preloads = found.machine.mounted_preloads().iter();
    let preloads: Vec<_> = preloads.map(|p| (p.bearing.clone(), p.document())).collect();
    json!({
        "name": found.name,
        "title": found.loaded.model.title,
        "mass": found.mass,
        "dofs": found.machine.assembly.dofs.len(),
        "shaft_elements": found.loaded.model.shaft.len(),
        "rigid_body_modes": found.rigid_body_modes,
        "side_files": side_files,
        "bearings": bearing_list::to_json(&listed_bearings(&found.loaded.model)),
        "belts": json::groups("name", &belts),
        "preloads": json::groups("bearing", &preloads),
        "forecast": forecast::to_json(&found.machine),
        "warnings": json::warnings(&all_warnings(found)),
        "defaults": defaults::to_json(&found.loaded.defaults),
    })
}
