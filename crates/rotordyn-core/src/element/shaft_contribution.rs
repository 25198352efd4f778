//! Part of a shaft element in the matrices of the machine.

use super::contribution::{Element, ElementMatrices};
use super::shaft::ShaftElement;
use super::shaft_matrices::Matrix12;
use rotordyn_linalg::Triplets;

impl Element for ShaftElement {
    fn add_matrices(&self, node: usize, to: &mut ElementMatrices) {
        let mass = self.mass_matrix(to.cone_rule);
        let elastic = self.elastic_stiffness(to.cone_rule);
        let geometric = self.geometric_stiffness();
        add12(&mut to.mass, node, &mass, 1.0);
        add12(&mut to.stiffness, node, &elastic, 1.0);
        add12(&mut to.stiffness, node, &geometric, 1.0);
        add12(&mut to.damping, node, &mass, self.proportional_damping[0]);
        add12(&mut to.damping, node, &elastic, self.proportional_damping[1] + self.internal_viscous);
        add12(&mut to.damping, node, &geometric, self.proportional_damping[1]);
        add12(&mut to.gyroscopic, node, &self.gyroscopic_matrix(), 1.0);
        if self.internal_viscous != 0.0 {
            add12(&mut to.circulatory, node, &self.circulatory_stiffness(), 1.0);
        }
        self.layers.iter().for_each(|layer| layer.add_matrices(node, to));
    }
}

/// Adds factor × the matrix of the shaft element between nodes `node` and `node` + 1.
pub fn add12(to: &mut Triplets, node: usize, matrix: &Matrix12, factor: f64) {
    if factor == 0.0 {
        return;
    }
    for (i, row) in matrix.iter().enumerate() {
        for (j, &v) in row.iter().enumerate() {
            if v != 0.0 {
                to.add(6 * node + i, 6 * node + j, factor * v);
            }
        }
    }
}
