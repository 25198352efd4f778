//! Elements of ROSS to tables and keys of the model file, with what was carried over and what was not.
//!
//! | ROSS | model file |
//! |---|---|
//! | ShaftElement | `[[shaft.section]]`, one element each; further ones between the same nodes `[[shaft.layer]]` |
//! | node k of the shaft | `[station]` nk |
//! | DiskElement | `[disc.x]` by mass and inertia |
//! | BearingElement, SealElement and their kinds, on the shaft | `[bearing.x]`, `model = "linear"`; their masses `[sensor.x]` |
//! | the same between two nodes without the shaft, or within it | `[bushing.x]` |
//! | springs of 1e14 N/m and more to ground, for a rigid support | `[joint.x]` |
//! | PointMass on a node of its own | `[body.x]` whose rotations a `[joint.x]` fixes |
//! | PointMass on a shaft node | `[sensor.x]` |
//! | CouplingElement | a section with `gap`, a `[bushing.x]` without lever arms, a `[disc.x]` at each end |
//! | alpha, beta of the rotor | `[damping]` |
//!
//! Axes, signs and the order of degrees of freedom are the same in both programs.

mod shaft;
mod supports;
mod writer;

pub use writer::{Carried, NotCarried};

use super::rotor::SavedRotor;
use super::text::Names;
use std::collections::BTreeMap;
use writer::{Writer, tag};

/// A rotor as a model file.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// Version of ROSS that saved it, or nothing.
    pub version: String,
    /// Text of the model file.
    pub text: String,
    pub carried: Vec<Carried>,
    pub not_carried: Vec<NotCarried>,
}

/// Writes a rotor as the model file `name`; `file`: the file it comes from.
pub fn model_file(rotor: &SavedRotor, name: &str, file: &str) -> Imported {
    let mut names = Names::default();
    let last = rotor.shaft.iter().map(|part| part.node).chain(rotor.couplings.iter().map(|c| c.node)).max();
    let shaft_nodes = last.map_or(0, |last| last + 2);
    let mut bodies = BTreeMap::new();
    for mass in rotor.masses.iter().filter(|mass| mass.node >= shaft_nodes) {
        bodies.entry(mass.node).or_insert_with(|| names.of(tag(&mass.name)));
    }
    let mut writer = Writer::new(rotor, positions(rotor), bodies);
    writer.header(name, file);
    writer.damping();
    writer.shaft();
    writer.discs();
    writer.supports();
    for bearing in &rotor.bearings {
        writer.bearing(bearing);
    }
    let carried = writer.counts.iter().map(|((what, into), count)| Carried {
        what: (*what).into(),
        count: *count,
        into: (*into).into(),
    });
    Imported {
        version: rotor.version.clone(),
        carried: carried.collect(),
        not_carried: writer.not_carried,
        text: writer.text.finish(),
    }
}

fn positions(rotor: &SavedRotor) -> Vec<f64> {
    let own = rotor.shaft.iter().map(|part| (part.node, part.length));
    let lengths: BTreeMap<usize, f64> =
        own.chain(rotor.couplings.iter().map(|c| (c.node, c.length))).collect();
    let mut z = vec![0.0];
    for length in lengths.values() {
        z.push(z[z.len() - 1] + length);
    }
    z
}

impl Writer<'_> {
    fn header(&mut self, name: &str, file: &str) {
        let version = if self.rotor.version.is_empty() { "before 2.0" } else { &self.rotor.version };
        let from = format!("{file}, saved by ROSS {version}");
        self.text.comment(&format!(
            "Imported from {from}. Units are SI, as in that file; any other may be written."
        ));
        self.text.comment("z along the shaft, y up, x horizontal; the shaft turns from x to y. Node k of ROSS is the station nk.");
        self.text.table("[model]");
        self.text.text("name", name);
        self.text.text("title", &from);
    }

    fn damping(&mut self) {
        let [alpha, beta] = self.rotor.proportional;
        if alpha == 0.0 && beta == 0.0 {
            return;
        }
        self.text.table("[damping]");
        self.text.comment("C = mass M + stiffness K of shaft, discs and bodies");
        self.text.quantity("mass", alpha, "1/s");
        self.text.quantity("stiffness", beta, "s");
        self.count("alpha, beta of the rotor", "[damping]");
        let own = self.rotor.shaft.iter().filter(|part| part.proportional != [0.0; 2]).count();
        if own > 0 {
            let why = "ROSS ignores the damping of elements if the whole rotor has some";
            self.leave_out(&format!("alpha, beta of {own} shaft elements"), why);
        }
        if beta != 0.0 && !self.bodies.is_empty() {
            let why = "here the support springs are damped too, in ROSS the shaft alone";
            self.leave_out("parameters.beta, in part", why);
        }
    }
}
