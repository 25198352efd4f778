//! The recipe of a study (CONTRIBUTING.md) followed outside the library: JSON, HDF5, CSV and a figure from one document.

use std::f64::consts::TAU;

use rotordyn::assembly::PhysicsError;
use rotordyn::document::{Document, Rows, Section};
use rotordyn::io::hdf5::Store;
use rotordyn::io::{document_tables, json, results_file};
use rotordyn::model::study::EquilibriumStudy;
use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use rotordyn::{figures, results};
use serde::{Deserialize, Serialize};

/// Largest static deflection at every speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Deflection {
    points: Vec<Point>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Point {
    /// Ω \[rad/s\].
    speed: f64,
    node: String,
    /// √(u_x² + u_y²) \[m\].
    deflection: f64,
}

fn largest_deflection(machine: &Machine, speeds: &[f64]) -> Result<Deflection, PhysicsError> {
    let at = |&speed: &f64| {
        let found = machine.equilibrium(&EquilibriumStudy { speed, cage_average: true })?;
        let dofs = &machine.assembly.dofs;
        let q = dofs.expand(&found.q);
        let nodes = dofs.node_names.iter().zip(q.chunks(6).map(|u| u[0].hypot(u[1])));
        let (node, deflection) = nodes.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        Ok(Point { speed, node: node.clone(), deflection })
    };
    Ok(Deflection { points: speeds.iter().map(at).collect::<Result<_, _>>()? })
}

impl Deflection {
    fn section(&self) -> Section<'_> {
        let points = Rows::of(&self.points)
            .heading("Largest static deflection")
            .over("speed")
            .quantity("speed", "rad/s", |p| p.speed)
            .text("node", |p| &p.node)
            .quantity("deflection", "m", |p| p.deflection)
            .drawn();
        Section::new("deflection", "deflection", Document::new().table("", points))
    }
}

#[test]
fn study_of_ones_own_is_written_and_drawn() {
    let model = load("jeffcott.toml", include_str!("../../models/jeffcott.toml"), &Options::default());
    let machine = Machine::new(model.unwrap().model).unwrap();
    let found = largest_deflection(&machine, &[0.0, TAU * 10.0, TAU * 20.0]).unwrap();
    let deflections: Vec<f64> = found.points.iter().map(|p| p.deflection).collect();
    // The disc in the middle sags most; nothing of this machine depends on speed.
    assert!(found.points.iter().all(|p| p.node == "disc" && p.deflection == deflections[0]), "{found:?}");
    assert!((1e-6..1e-3).contains(&deflections[0]), "{found:?}");

    let section = found.section();
    let mut document = serde_json::Map::new();
    json::add_sections(&mut document, std::slice::from_ref(&section));
    let rows = document["deflection"].as_array().unwrap();
    assert_eq!(rows.len(), 3);
    assert_eq!(rows[2]["deflection_m"].as_f64(), Some(deflections[2]));
    assert!((rows[2]["speed_rpm"].as_f64().unwrap() - 1200.0).abs() < 1e-9, "{rows:?}");

    let folder = tempfile::tempdir().unwrap();
    let store = Store::create(folder.path().join("own.h5")).unwrap();
    results_file::write_section(&store, "", &section).unwrap();
    assert_eq!(store.read("/deflection/deflection").unwrap().data, deflections);
    assert_eq!(store.read_texts("/deflection/node").unwrap(), ["disc"; 3]);

    let tables = document_tables::tables(std::slice::from_ref(&section));
    assert_eq!(tables.len(), 1);
    assert_eq!(tables[0].header, ["speed_rpm [rpm]", "node", "deflection_m [m]"]);
    let drawn = figures::draw_marked(&[section], "Jeffcott rotor", folder.path()).unwrap();
    assert_eq!(drawn, [folder.path().join("deflection_deflection.svg")]);
    let svg = std::fs::read_to_string(&drawn[0]).unwrap();
    assert!(svg.contains("Deflection over speed") && svg.contains("rpm"), "{svg}");

    let saved = folder.path().join("own.rotordyn");
    results::save(&saved, &found).unwrap();
    assert_eq!(results::load::<Deflection>(&saved).unwrap(), found);
}
