//! DOF map: six DOFs per node; constraints of joints and drive eliminated exactly (multi-point constraints).

use crate::element::Anchor;
use crate::model::{Drive, Model};
use rotordyn_linalg::{Complex64, SparseRow};

/// Names of a node's six DOFs.
pub const DOF_NAMES: [&str; 6] = ["u_x", "u_y", "u_z", "θ_x", "θ_y", "θ_z"];

/// From all DOFs (six per node) to the free ones: q_full = T q.
#[derive(Clone, Debug)]
pub struct DofMap {
    /// Row i of T: full DOF i as a combination of free DOFs.
    pub basis: Vec<SparseRow>,
    /// Full DOF of free DOF k.
    pub free: Vec<usize>,
    /// Number of shaft nodes; bodies follow.
    pub shaft_nodes: usize,
    /// Whether the rotor is rigid.
    pub rigid: bool,
    /// Name of every node.
    pub node_names: Vec<String>,
}

impl DofMap {
    /// Eliminates the joints, the nodes of a rigid rotor except its centre and, with a prescribed drive, the
    /// rotation of the driven node.
    ///
    /// Every locked relative motion is a row r · q_full = 0. Gauss-Jordan elimination with the largest
    /// coefficient as pivot solves the rows for as many DOFs; redundant rows vanish.
    pub fn new(model: &Model) -> Self {
        let full = 6 * model.node_count();
        let mut rows: Vec<SparseRow> = Vec::new();
        for joint in &model.joints {
            let (a, b) = (joint.a.rows(), joint.b.rows());
            for i in (0..6).filter(|&i| joint.locked[i]) {
                let mut row = a[i].clone();
                row.add_scaled(-1.0, &b[i]);
                rows.push(row);
            }
        }
        if let Drive::Prescribed { node: Some(node) } = model.drive {
            rows.push(SparseRow::unit(6 * node + 5));
        }
        let solved = eliminate(rigid_rows(model), rows);

        let mut is_free = vec![true; full];
        for (pivot, _) in &solved {
            is_free[*pivot] = false;
        }
        let free: Vec<usize> = (0..full).filter(|&i| is_free[i]).collect();
        let mut basis = vec![SparseRow::default(); full];
        for (k, &i) in free.iter().enumerate() {
            basis[i] = SparseRow::unit(k);
        }
        for (pivot, row) in solved {
            let mut combination = SparseRow::default();
            for &(i, v) in row.0.iter().filter(|&&(i, _)| i != pivot) {
                combination.add_scaled(-v, &basis[i]);
            }
            basis[pivot] = combination;
        }
        let (shaft_nodes, rigid) = (model.node_z.len(), model.rigid_rotor.is_some());
        Self { basis, free, shaft_nodes, rigid, node_names: node_names(model) }
    }

    /// Number of free DOFs.
    pub fn len(&self) -> usize {
        self.free.len()
    }

    /// Whether there are no free DOFs.
    pub fn is_empty(&self) -> bool {
        self.free.is_empty()
    }

    /// Number of DOFs before elimination.
    pub fn full_len(&self) -> usize {
        self.basis.len()
    }

    /// Free DOF `k` in words, such as "u_x of disc".
    pub fn name(&self, k: usize) -> String {
        let i = self.free[k];
        format!("{} of {}", DOF_NAMES[i % 6], self.node_names[i / 6])
    }

    /// All DOFs from the free ones: q_full = T q.
    pub fn expand(&self, q: &[f64]) -> Vec<f64> {
        self.basis.iter().map(|row| row.dot(q)).collect()
    }

    /// All DOFs from the free ones, complex.
    pub fn expand_complex(&self, q: &[Complex64]) -> Vec<Complex64> {
        self.basis.iter().map(|row| row.dot_complex(q)).collect()
    }

    /// Generalised force on the free DOFs from forces on all DOFs: Tᵀ f.
    pub fn reduce(&self, full: &[f64]) -> Vec<f64> {
        let mut f = vec![0.0; self.len()];
        for (row, &value) in self.basis.iter().zip(full) {
            row.add_to(value, &mut f);
        }
        f
    }

    /// Displacement (u_x u_y u_z θ_x θ_y θ_z) of an anchor's point as rows over the free DOFs; no entries
    /// for ground.
    pub fn anchor_rows(&self, anchor: &Anchor) -> [SparseRow; 6] {
        anchor.rows().map(|row| {
            let mut out = SparseRow::default();
            for &(i, v) in &row.0 {
                out.add_scaled(v, &self.basis[i]);
            }
            out
        })
    }

    /// Displacement of point `a` relative to point `b` as rows over the free DOFs.
    pub fn relative_rows(&self, a: &Anchor, b: &Anchor) -> [SparseRow; 6] {
        let (mut rows, other) = (self.anchor_rows(a), self.anchor_rows(b));
        for (row, b) in rows.iter_mut().zip(&other) {
            row.add_scaled(-1.0, b);
        }
        rows
    }
}

/// Rigid-body constraint rows of every node of a rigid rotor to its centre node, solved for the former.
fn rigid_rows(model: &Model) -> Vec<(usize, SparseRow)> {
    let Some(rotor) = &model.rigid_rotor else { return Vec::new() };
    let mut solved = Vec::new();
    for (node, z) in model.node_z.iter().enumerate().filter(|(node, _)| *node != rotor.node) {
        let offset = [0.0, 0.0, z - model.node_z[rotor.node]];
        let centre = Anchor { node: Some(rotor.node), offset };
        for (i, constrained) in centre.rows().into_iter().enumerate() {
            let mut row = SparseRow::unit(6 * node + i);
            row.add_scaled(-1.0, &constrained);
            solved.push((6 * node + i, row));
        }
    }
    solved
}

/// Gauss-Jordan elimination: rows each solved for one DOF (coefficient 1) that appears in no other row;
/// `solved` rows already are.
fn eliminate(mut solved: Vec<(usize, SparseRow)>, rows: Vec<SparseRow>) -> Vec<(usize, SparseRow)> {
    for mut row in rows {
        for (pivot, other) in &solved {
            let factor = row.0.iter().find(|(i, _)| i == pivot).map_or(0.0, |&(_, v)| v);
            row.add_scaled(-factor, other);
        }
        // The remainder of a redundant row is round-off of coefficients of order one.
        row.0.retain(|(_, v)| v.abs() > 1e-12);
        let Some(&(pivot, value)) =
            row.0.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()).then(a.0.cmp(&b.0)))
        else {
            continue;
        };
        for (_, v) in &mut row.0 {
            *v /= value;
        }
        for (_, other) in &mut solved {
            let factor = other.0.iter().find(|(i, _)| *i == pivot).map_or(0.0, |&(_, v)| v);
            other.add_scaled(-factor, &row);
            other.0.retain(|(i, _)| *i != pivot);
        }
        solved.push((pivot, row));
    }
    solved
}

/// Node names: stations and bodies by name, other shaft nodes by number and position.
fn node_names(model: &Model) -> Vec<String> {
    let mut names: Vec<String> =
        model.node_z.iter().enumerate().map(|(k, z)| format!("shaft node {k} (z = {z:.4} m)")).collect();
    if let Some(rotor) = &model.rigid_rotor {
        names[rotor.node].clone_from(&rotor.name);
    }
    for station in &model.stations {
        if let Some(name) = names.get_mut(station.node) {
            name.clone_from(&station.name);
        }
    }
    names.extend(model.bodies.iter().map(|b| b.name.clone()));
    names
}
