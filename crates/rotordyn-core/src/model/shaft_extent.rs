//! Size of a shaft's mesh and the part that makes it so large, for messages.

use super::Model;
use crate::document::number;
use std::fmt;

/// The mesh of a shaft: its nodes, and its longest part of equal elements.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShaftExtent {
    pub nodes: usize,
    /// From the first node to the last \[m\].
    pub length: f64,
    /// `None` for a rigid rotor.
    pub part: Option<EqualElements>,
}

/// Consecutive elements of one length and diameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EqualElements {
    pub elements: usize,
    /// Length and mean outer diameter of an element \[m\].
    pub element_length: f64,
    pub diameter: f64,
    /// First and last position \[m\].
    pub z: [f64; 2],
}

/// Lengths that differ by less than this fraction are equal.
const EQUAL: f64 = 1e-6;

impl ShaftExtent {
    /// Of the model's shaft.
    pub fn of(model: &Model) -> Self {
        let ends = model.node_z.first().zip(model.node_z.last());
        let mut parts: Vec<EqualElements> = Vec::new();
        for (element, z) in model.shaft.iter().zip(model.node_z.windows(2)) {
            let diameter = 0.5 * (element.outer_diameter[0] + element.outer_diameter[1]);
            let same = |part: &&mut EqualElements| {
                let equal = |a: f64, b: f64| (a - b).abs() < EQUAL * b;
                equal(element.length, part.element_length) && equal(diameter, part.diameter)
            };
            match parts.last_mut().filter(same) {
                Some(part) => (part.elements, part.z[1]) = (part.elements + 1, z[1]),
                None => {
                    let element_length = element.length;
                    parts.push(EqualElements { elements: 1, element_length, diameter, z: [z[0], z[1]] });
                }
            }
        }
        Self {
            nodes: model.node_z.len(),
            length: ends.map_or(0.0, |(first, last)| last - first),
            part: parts.into_iter().max_by_key(|part| part.elements),
        }
    }

    /// Length of the longest part over its diameter.
    pub fn slenderness(&self) -> f64 {
        self.part.map_or(0.0, |part| (part.z[1] - part.z[0]) / part.diameter)
    }
}

impl fmt::Display for ShaftExtent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the shaft of {} m has {} nodes", number(self.length, 4), self.nodes)?;
        let Some(part) = self.part else { return Ok(()) };
        write!(
            f,
            ", {} elements of {} mm in the section from z = {} m to {} m, {} mm thick",
            part.elements,
            number(1e3 * part.element_length, 4),
            number(part.z[0], 4),
            number(part.z[1], 4),
            number(1e3 * part.diameter, 4)
        )
    }
}
