//! Critical speeds.

use crate::analysis::critical_speed::{CriticalSpeed, CrossingList, UncertainRange};
use crate::assembly::DofMap;
use crate::document::{Document, Rows, in_json, named};
use serde::{Deserialize, Serialize};

/// Critical speeds up to a speed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CriticalResult {
    pub max_speed: f64,
    pub crossings: CrossingList,
}

impl CriticalResult {
    /// What is written to files.
    pub fn document(&self, dofs: &DofMap) -> Document<'_> {
        let shape = [dofs.full_len() / 6, 6];
        let speeds = CriticalSpeed::columns(Rows::of(&self.crossings.list)).complex_numbers(
            in_json("shape"),
            "m/sqrt(kg) m, rad/sqrt(kg) m",
            &shape,
            |c| &c.mode.full_shape,
        );
        Document::new()
            .quantity("max_speed", "rad/s", self.max_speed)
            .texts(in_json("nodes"), &dofs.node_names)
            .table(named("speeds", ""), speeds)
            .table(in_json("uncertain"), UncertainRange::columns(&self.crossings.uncertain))
    }
}
