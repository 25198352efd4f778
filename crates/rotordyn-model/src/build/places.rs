//! Named attachment points of elements: stations, discs, bodies, housings, ground.

use crate::Station;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{Key, Quantities, Text, Texts, any, keys, quantities, text, texts};
use crate::file::reader::{Reader, missing_table_problem};
use rotordyn_core::element::Anchor;
use rotordyn_units::LENGTH;
use rotordyn_units::names::nearest;
use std::collections::HashMap;
use std::ops::Range;

keys! {
    /// Where an element acts.
    pub(super) static ANCHOR: AnchorKeys {
        at: Text = text("name of a station, disc, body, housing or ground", "Where it acts.")
            .example("\"station.A\"");
        offset: Quantities = quantities(any(LENGTH), "three: x, y, z", "Distance from there; on ground the position.")
            .default("0, 0, 0 m").example("\"0, 60, 0 mm\"");
    }
}

keys! {
    /// What an element connects.
    pub(super) static BETWEEN: BetweenKeys {
        between: Texts = texts("names of two places", "The two places that it connects.")
            .example("[\"station.A\", \"ground\"]");
        point: Quantities = quantities(any(LENGTH), "three: x, y, z", "Position of the connection.")
            .computed("the first place that is not ground").example("\"0, 0, 270 mm\"");
    }
}

/// Attachment point with its full name: "station.B", "housing.A", "ground".
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub name: String,
    pub node: Option<usize>,
    /// Position \[m\] in the model's axes.
    pub position: [f64; 3],
}

impl Place {
    /// Anchor on this place at the given point.
    pub fn anchor_at(&self, point: [f64; 3]) -> Anchor {
        let mut offset = point;
        if self.node.is_some() {
            for (o, p) in offset.iter_mut().zip(self.position) {
                *o -= p;
            }
        }
        Anchor { node: self.node, offset }
    }
}

/// All places of a model.
pub(super) struct Places {
    list: Vec<Place>,
    /// Places in the list by full name, and by the name behind the kind.
    by_name: HashMap<String, Vec<usize>>,
    by_short_name: HashMap<String, Vec<usize>>,
    /// Elements between two places, with these: ("bearing.A", "station.A and housing.A").
    connections: HashMap<String, String>,
}

/// Tables of the file whose items are places.
const KINDS: [&str; 5] = ["station", "disc", "body", "housing", "sensor"];

/// The table in which a name of a place was expected, if it says so or only one comes into question.
fn missing_kind(text: &str, kinds: &[&str]) -> Option<&'static str> {
    let kind = text.split_once('.').map(|(kind, _)| kind).or(if kinds == ["station"] {
        Some("station")
    } else {
        None
    });
    KINDS.into_iter().find(|known| Some(*known) == kind)
}

/// "A" of "station.A"; "ground" is its own.
fn short(name: &str) -> &str {
    name.split_once('.').map_or(name, |(_, short)| short)
}

impl Places {
    pub fn new(stations: &[Station]) -> Self {
        let mut places = Self {
            list: Vec::new(),
            by_name: HashMap::new(),
            by_short_name: HashMap::new(),
            connections: HashMap::new(),
        };
        places.push(Place { name: "ground".into(), node: None, position: [0.0; 3] });
        for s in stations {
            places.add(format!("station.{}", s.name), s.node, [0.0, 0.0, s.z]);
        }
        places
    }

    /// Remembers an element that is no place itself but acts between two, for the hint to who names it as a place.
    pub fn add_connection(&mut self, element: String, ends: String) {
        self.connections.insert(element, ends);
    }

    pub fn add(&mut self, name: String, node: usize, position: [f64; 3]) {
        self.push(Place { name, node: Some(node), position });
    }

    fn push(&mut self, place: Place) {
        let at = self.list.len();
        self.by_name.entry(place.name.clone()).or_default().push(at);
        self.by_short_name.entry(short(&place.name).into()).or_default().push(at);
        self.list.push(place);
    }

    /// Find a place by full name, or by unambiguous short name; `kinds` limits the search ("station",
    /// "housing").
    pub fn find(&self, r: &Reader, text: &str, span: &Range<usize>, kinds: &[&str]) -> Option<&Place> {
        let allowed = |place: &&Place| {
            kinds.is_empty() || kinds.contains(&place.name.split('.').next().unwrap_or_default())
        };
        let named = |names: &HashMap<String, Vec<usize>>| -> Vec<&Place> {
            let places = names.get(text).into_iter().flatten();
            places.map(|at| &self.list[*at]).filter(allowed).collect()
        };
        if let Some(exact) = named(&self.by_name).first() {
            return Some(*exact);
        }
        let matches = named(&self.by_short_name);
        match matches[..] {
            [one] => Some(one),
            [] => {
                let what = if kinds == ["station"] { "station" } else { "place" };
                let problem = Problem::new(Kind::UnknownName, span, format!("unknown {what} `{text}`"));
                let kind = missing_kind(text, kinds);
                let problem = match kind {
                    Some(kind) => problem.follows(kind),
                    None => problem,
                };
                let is_station = kind == Some("station") || !text.contains('.');
                if is_station && !self.list.iter().any(|place| place.name.starts_with("station.")) {
                    let problem = missing_table_problem("station").follows("station");
                    let example = format!("{} = \"100 mm\"", short(text));
                    let hint = format!("add [station] with the positions along the shaft: {example}");
                    r.log.error_once(problem.hint(hint));
                    return None;
                }
                if let Some(ends) = self.connections.get(text) {
                    r.log.error(problem.hint(format!("{text} acts between {ends}: write one of them")));
                    return None;
                }
                // suggest full or short names, as written by the user
                let known: Vec<&str> =
                    self.list.iter().filter(allowed).map(|place| place.name.as_str()).collect();
                let shorts = || known.iter().map(|name| short(name));
                let is_full = text.contains('.');
                let is_near = !is_full && r.log.suggests() && nearest(text, shorts()).is_some();
                r.log.error(match is_full || kinds.is_empty() && !is_near {
                    true => problem.suggest(r.log, text, known.iter().copied()),
                    false => problem.suggest(r.log, text, shorts()),
                });
                None
            }
            _ => {
                let names = matches.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(" or ");
                let message = format!("`{text}` is ambiguous");
                r.log.error(Problem::new(Kind::UnknownName, span, message).hint(format!("write {names}")));
                None
            }
        }
    }

    /// Shaft node and position of the station named by a key; node 0 as placeholder after an error.
    pub fn station(&self, r: &Reader, key: &Key<Text>) -> (usize, f64) {
        let Some(name) = r.need_text(key) else { return (0, 0.0) };
        let place = self.find(r, name, &r.span_of(key), &["station"]);
        place.map_or((0, 0.0), |p| (p.node.unwrap_or(0), p.position[2]))
    }

    /// Anchor of the key `at` with the key `offset` (on ground: position).
    pub fn anchor(&self, r: &Reader) -> Anchor {
        let name = r.need_text(&ANCHOR.at);
        let offset = r.vector(&ANCHOR.offset).unwrap_or_default();
        let place = name.and_then(|n| self.find(r, n, &r.span_of(&ANCHOR.at), &[]));
        Anchor { node: place.and_then(|p| p.node), offset }
    }

    /// The two anchors of the key `between`, both at the key `point` or, by default, at the first place not
    /// on ground.
    pub fn between(&self, r: &Reader) -> [Anchor; 2] {
        let nowhere = [Anchor::GROUND; 2];
        if !r.has(&BETWEEN.between) {
            r.missing(&BETWEEN.between);
        }
        let point = r.vector(&BETWEEN.point);
        let Some(names) = r.texts(&BETWEEN.between) else { return nowhere };
        let [(first, first_span), (second, second_span)] = &names[..] else {
            let message = format!("{} must name two places", r.name(&BETWEEN.between));
            r.error(Kind::WrongType, &BETWEEN.between, message);
            return nowhere;
        };
        let a = self.find(r, first, first_span, &[]);
        let b = self.find(r, second, second_span, &[]);
        let (Some(a), Some(b)) = (a, b) else { return nowhere };
        if a.node == b.node {
            let message = format!("{} connects a place to itself", r.path);
            r.error(Kind::Conflict, &BETWEEN.between, message);
        }
        let own = if a.node.is_some() { a.position } else { b.position };
        let point = point.unwrap_or(own);
        [a.anchor_at(point), b.anchor_at(point)]
    }
}
