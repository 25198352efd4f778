//! System matrices, with the names of the degrees of freedom.

use nalgebra::DMatrix;
use numpy::{PyArray2, PyArrayMethods, ToPyArray};
use pyo3::prelude::*;
use rotordyn::assembly::LinearSystem;
use rotordyn::linalg::SparseMatrix;
use rotordyn::study::Machine;
use rotordyn::units::{self, SPEED};

use crate::cli::failure::Failure;
use crate::failure::{Stop, detached};
use crate::source::Source;

const AXES: [&str; 6] = ["u_x", "u_y", "u_z", "theta_x", "theta_y", "theta_z"];

type Matrix<'py> = Bound<'py, PyArray2<f64>>;

/// Speed \[rad/s\], M, C, G, K of M q'' + (C + Ω G) q' + K q = f linearised at a speed, and the names of q.
///
/// C has the damping of bearings and of [damping], K the tangent stiffness of the bearings and Ω K_c of damping that
/// rotates with the shaft.
#[pyfunction]
#[allow(clippy::type_complexity)]
pub fn matrices<'py>(
    py: Python<'py>,
    source: &Source,
    speed: &str,
) -> PyResult<(f64, [Matrix<'py>; 4], Vec<String>)> {
    let (speed, found, labels) = detached(py, || {
        let speed = units::parse(speed, SPEED)
            .map_err(|error| Stop::from(Failure::Input(format!("speed: {error}"))))?;
        let machine = Machine::new(source.loaded.model.clone())?;
        machine.check_tables("modal", &[speed])?;
        let tangents = machine.tangents(speed, true)?;
        let assembly = &machine.assembly;
        // Without Ω the damping has no gyroscopic part.
        let damping = LinearSystem::new(assembly, &tangents, 0.0)?.full_damping();
        let system = LinearSystem::new(assembly, &tangents, speed)?;
        let dofs = &assembly.dofs;
        let name = |full: &usize| format!("{} {}", dofs.node_names[full / 6], AXES[full % 6]);
        let labels = dofs.free.iter().map(name).collect::<Vec<_>>();
        let dense = |m: &SparseMatrix| m.to_dense();
        let found = [&system.mass, &damping, &assembly.gyroscopic, &system.stiffness].map(dense);
        Ok((speed, found, labels))
    })?;
    Ok((speed, found.map(|m| rows(py, &m)), labels))
}

/// A matrix by rows.
fn rows<'py>(py: Python<'py>, matrix: &DMatrix<f64>) -> Matrix<'py> {
    let shape = [matrix.nrows(), matrix.ncols()];
    let by_rows: Vec<f64> = matrix.transpose().as_slice().to_vec();
    by_rows.to_pyarray(py).reshape(shape).expect("a matrix has as many numbers as rows times columns")
}
