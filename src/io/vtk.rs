//! VTK for ParaView: mode shapes and snapshots as .vtu (XML, ASCII), series of them as .pvd.

use std::fmt::Write as _;
use std::path::Path;

use crate::error::Error;
use crate::geometry::parry::BearingShapes;
use crate::model::Model;

/// Points and lines between them; a point without a line becomes a vertex cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Positions \[m\].
    pub points: Vec<[f64; 3]>,
    pub lines: Vec<[usize; 2]>,
}

/// A field on the points.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    pub name: String,
    pub values: Values,
}

/// One number or one vector per point.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    Scalars(Vec<f64>),
    Vectors(Vec<[f64; 3]>),
}

impl Grid {
    /// The machine: shaft nodes joined by lines, then bodies, then the balls of every ball bearing in order.
    pub fn of_machine(model: &Model) -> Self {
        let mut points: Vec<[f64; 3]> = model.node_z.iter().map(|&z| [0.0, 0.0, z]).collect();
        let lines = (1..points.len()).map(|k| [k - 1, k]).collect();
        points.extend(model.bodies.iter().map(|b| b.position));
        for site in &model.bearings {
            if let Some(ball) = site.bearing.ball() {
                let shapes = BearingShapes::new(&ball.geometry, ball.cage_pocket_diameter);
                let z = model.node_z[site.node];
                points.extend(shapes.centred(ball.cage_angle).balls.iter().map(|c| [c.x, c.y, z + c.z]));
            }
        }
        Self { points, lines }
    }
}

/// Fields `displacement` \[m\], `rotation` \[rad\] and `ball_load` \[N\] on [`Grid::of_machine`].
///
/// `q`: six DOFs per node, shaft nodes then bodies; `ball_loads`: one per ball, in the grid's order. Balls
/// get no displacement, nodes no load; missing values are zero.
pub fn machine_fields(grid: &Grid, q: &[f64], ball_loads: &[f64]) -> Vec<Field> {
    let nodes = q.len() / 6;
    let at = |k: usize, first: usize| match q.get(6 * k + first..6 * k + first + 3) {
        Some(v) => [v[0], v[1], v[2]],
        None => [0.0; 3],
    };
    let count = grid.points.len();
    let load = |k: usize| k.checked_sub(nodes).and_then(|j| ball_loads.get(j)).copied().unwrap_or(0.0);
    vec![
        Field {
            name: "displacement".into(),
            values: Values::Vectors((0..count).map(|k| at(k, 0)).collect()),
        },
        Field { name: "rotation".into(), values: Values::Vectors((0..count).map(|k| at(k, 3)).collect()) },
        Field { name: "ball_load".into(), values: Values::Scalars((0..count).map(load).collect()) },
    ]
}

/// The text of a .vtu file.
///
/// # Errors
/// A message naming a field without one value per point, or with a number that is not finite, which VTK
/// readers take for the end of the file.
pub fn to_vtu(grid: &Grid, fields: &[Field]) -> Result<String, String> {
    let count = grid.points.len();
    let mut joined = vec![false; count];
    for &k in grid.lines.iter().flatten() {
        *joined.get_mut(k).ok_or(format!("a line ends at point {k} of {count}"))? = true;
    }
    let single: Vec<usize> = (0..count).filter(|&k| !joined[k]).collect();
    let cells = grid.lines.len() + single.len();
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{cells}\">\n<PointData>\n"
    );
    for field in fields {
        let (components, numbers): (usize, Vec<f64>) = match &field.values {
            Values::Scalars(v) => (1, v.clone()),
            Values::Vectors(v) => (3, v.iter().flatten().copied().collect()),
        };
        if numbers.len() != components * count {
            return Err(format!("field {} does not have one value for each of {count} points", field.name));
        }
        array(&mut out, &field.name, components, &numbers)?;
    }
    out.push_str("</PointData>\n<Points>\n");
    let coordinates: Vec<f64> = grid.points.iter().flatten().copied().collect();
    array(&mut out, "points", 3, &coordinates)?;
    out.push_str("</Points>\n<Cells>\n");
    integers(&mut out, "connectivity", "Int64", grid.lines.iter().flatten().chain(&single).copied());
    let ends = (1..=grid.lines.len()).map(|k| 2 * k);
    integers(&mut out, "offsets", "Int64", ends.chain((1..=single.len()).map(|k| 2 * grid.lines.len() + k)));
    const VERTEX: usize = 1;
    const LINE: usize = 3;
    integers(
        &mut out,
        "types",
        "UInt8",
        (0..cells).map(|k| if k < grid.lines.len() { LINE } else { VERTEX }),
    );
    out.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    Ok(out)
}

/// Writes one .vtu file.
///
/// # Errors
/// [`Error::Environment`] when [`to_vtu`] rejects the data or the file cannot be written.
pub fn write_vtu(path: &Path, grid: &Grid, fields: &[Field]) -> Result<(), Error> {
    let text = to_vtu(grid, fields).map_err(Error::of_file("write", path))?;
    std::fs::write(path, text).map_err(Error::of_file("write", path))
}

/// Writes a .pvd collection of .vtu files in the same folder over time \[s\] (or phase, or mode number).
///
/// # Errors
/// [`Error::Environment`] when the file cannot be written.
pub fn write_pvd(path: &Path, frames: &[(f64, String)]) -> Result<(), Error> {
    let mut out = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for (time, file) in frames {
        let file = escaped(file);
        // Writing to a String cannot fail, here and below.
        let _ = writeln!(out, "<DataSet timestep=\"{time:e}\" part=\"0\" file=\"{file}\"/>");
    }
    out.push_str("</Collection>\n</VTKFile>\n");
    std::fs::write(path, out).map_err(Error::of_file("write", path))
}

fn array(out: &mut String, name: &str, components: usize, numbers: &[f64]) -> Result<(), String> {
    let escaped = escaped(name);
    let _ = writeln!(
        out,
        "<DataArray type=\"Float64\" Name=\"{escaped}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
    );
    for row in numbers.chunks(components) {
        for (k, x) in row.iter().enumerate() {
            if !x.is_finite() {
                return Err(format!("{name} contains a number that is not finite"));
            }
            let _ = write!(out, "{}{x:e}", if k > 0 { " " } else { "" });
        }
        out.push('\n');
    }
    out.push_str("</DataArray>\n");
    Ok(())
}

fn integers(out: &mut String, name: &str, kind: &str, numbers: impl Iterator<Item = usize>) {
    let text = numbers.map(|k| k.to_string()).collect::<Vec<_>>().join(" ");
    let _ =
        writeln!(out, "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">\n{text}\n</DataArray>");
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
