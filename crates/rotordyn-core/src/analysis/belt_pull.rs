//! Pull of the belts at static equilibrium.

use crate::assembly::Assembly;
use crate::document::{Document, in_json, quantity};
use crate::element::Anchor;
use crate::model::Model;
use serde::{Deserialize, Serialize};

/// Pull of a belt at static equilibrium beside the stated one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeltPull {
    pub name: String,
    /// Pull stated in the model file, along x and y \[N\].
    pub stated: [f64; 2],
    /// Displacement of the pulley along x and y \[m\].
    pub displacement: [f64; 2],
    /// Pull on the shaft that remains, along x and y \[N\]: the stated one less stiffness times displacement, or the
    /// stated one if it is constant.
    pub remaining: [f64; 2],
}

impl BeltPull {
    /// Remaining pull along the stated pull as a share of it; `None` without a stated pull.
    ///
    /// Zero or less: the belt is slack, and the linear model, in which it pushes, is invalid.
    pub fn remaining_share(&self) -> Option<f64> {
        let size = self.stated[0].powi(2) + self.stated[1].powi(2);
        let along = self.stated[0] * self.remaining[0] + self.stated[1] * self.remaining[1];
        (size > 0.0).then(|| along / size)
    }

    /// What is written to files, without the name.
    pub fn document(&self) -> Document<'_> {
        Document::new()
            .numbers(quantity("stated_pull", "N"), "N", &self.stated)
            .numbers(quantity("pull", "N"), "N", &self.remaining)
            .optional(in_json("remaining_share"), "1", self.remaining_share())
            .numbers(quantity("displacement", "m"), "m", &self.displacement)
    }
}

/// Pulls of all belts at the equilibrium displacements `q` of the free DOFs, f − k u with fixed centres.
pub fn belt_pulls(model: &Model, assembly: &Assembly, q: &[f64]) -> Vec<BeltPull> {
    let pull = |belt: &crate::element::Belt| {
        let displacement = [0, 1].map(|axis| {
            let mut direction = [0.0; 6];
            direction[axis] = 1.0;
            assembly.direction_row(&Anchor::node(belt.node), &direction).dot(q)
        });
        let remaining = [0, 1].map(|axis| match belt.constant_pull {
            true => belt.pull[axis],
            false => belt.pull[axis] - belt.stiffness[axis] * displacement[axis],
        });
        BeltPull { name: belt.name.clone(), stated: belt.pull, displacement, remaining }
    };
    model.belts.iter().map(pull).collect()
}
