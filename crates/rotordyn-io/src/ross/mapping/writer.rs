//! The model file under construction, and what the parts of the mapping share.

use crate::ross::rotor::SavedRotor;
use crate::ross::text::{Names, Text};
use std::collections::BTreeMap;

/// What became of one kind of element.
#[derive(Clone, Debug, PartialEq)]
pub struct Carried {
    /// As the file calls it.
    pub what: String,
    pub count: usize,
    /// Tables of the model file.
    pub into: String,
}

/// Something of the file that the model does not have.
#[derive(Clone, Debug, PartialEq)]
pub struct NotCarried {
    /// Name in the file.
    pub item: String,
    pub why: String,
}

/// Where an element of ROSS acts.
#[derive(Clone, Copy, PartialEq)]
pub enum Place {
    Station(usize),
    Body(usize),
    Ground,
}

/// The model file under construction.
pub struct Writer<'a> {
    pub rotor: &'a SavedRotor,
    pub text: Text,
    /// Positions of the shaft's nodes \[m\].
    pub z: Vec<f64>,
    /// Name of the body of every node beyond the shaft.
    pub bodies: BTreeMap<usize, String>,
    pub bearings: Names,
    pub bushings: Names,
    pub sensors: Names,
    pub discs: Names,
    pub counts: BTreeMap<(&'static str, &'static str), usize>,
    pub not_carried: Vec<NotCarried>,
}

impl<'a> Writer<'a> {
    /// Nothing written yet; `bodies`: the name of the body of every node beyond the shaft.
    pub fn new(rotor: &'a SavedRotor, z: Vec<f64>, bodies: BTreeMap<usize, String>) -> Self {
        let unread = rotor.unread.iter();
        Self {
            rotor,
            text: Text::default(),
            z,
            bodies,
            bearings: Names::default(),
            bushings: Names::default(),
            sensors: Names::default(),
            discs: Names::default(),
            counts: BTreeMap::new(),
            not_carried: unread
                .map(|(item, why)| NotCarried { item: item.clone(), why: why.clone() })
                .collect(),
        }
    }

    /// Counts an element of a kind that went into tables of a kind.
    pub fn count(&mut self, what: &'static str, into: &'static str) {
        *self.counts.entry((what, into)).or_insert(0) += 1;
    }

    /// Remembers what the model does not have.
    pub fn leave_out(&mut self, item: &str, why: impl Into<String>) {
        self.not_carried.push(NotCarried { item: item.into(), why: why.into() });
    }

    /// Where a node is; without one, ground.
    pub fn place(&self, node: Option<usize>) -> Place {
        match node {
            None => Place::Ground,
            Some(node) if node < self.z.len() => Place::Station(node),
            Some(node) => Place::Body(node),
        }
    }

    /// A place as the model file names it.
    pub fn place_name(&self, place: Place) -> String {
        match place {
            Place::Ground => "ground".into(),
            Place::Station(node) => format!("station.n{node}"),
            Place::Body(node) => format!("body.{}", self.bodies.get(&node).map_or("", String::as_str)),
        }
    }

    /// All discs.
    pub fn discs(&mut self) {
        for disc in &self.rotor.discs {
            let done =
                self.disc(&disc.name, tag(&disc.name), disc.node, [disc.mass, disc.polar, disc.diametral]);
            if done {
                self.count("DiskElement", "[disc.x]");
            }
        }
    }

    /// A disc by mass, polar and diametral inertia; whether it was written.
    pub fn disc(&mut self, item: &str, tag: &str, node: usize, [mass, polar, diametral]: [f64; 3]) -> bool {
        if mass <= 0.0 || polar < 0.0 || diametral < 0.0 {
            if [mass, polar, diametral] != [0.0; 3] {
                let why =
                    format!("a disc of {mass} kg with inertias {polar} and {diametral} kg m^2 is no body");
                self.leave_out(item, why);
            }
            return false;
        }
        let least = 0.5 * polar;
        if diametral < least {
            let why = format!(
                "Id = {diametral} kg m^2 is less than half of Ip, which no body has: {least} kg m^2 is taken"
            );
            self.leave_out(item, why);
        }
        let name = self.discs.of(tag);
        self.text.table(&format!("[disc.{name}]"));
        self.text.comment(item);
        self.text.text("station", &format!("n{node}"));
        self.text.quantity("mass", mass, "kg");
        self.text.quantity("polar_inertia", polar, "kg m^2");
        self.text.quantity("diametral_inertia", diametral.max(least), "kg m^2");
        true
    }
}

/// "Bearing 0" of "BearingElement_Bearing 0".
pub fn tag(name: &str) -> &str {
    name.split_once('_').map_or(name, |(_, tag)| tag)
}
