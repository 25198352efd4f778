//! VTK for ParaView: mode shapes and snapshots as .vtu (XML, ASCII), series of them as .pvd.

use std::fmt::Write as _;
use std::path::Path;

use crate::atomic_file;
use crate::error::Error;

/// Points with lines and triangles between them; a point without either becomes a vertex cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grid {
    /// Positions \[m\].
    pub points: Vec<[f64; 3]>,
    pub lines: Vec<[usize; 2]>,
    pub triangles: Vec<[usize; 3]>,
    /// What every point moves with: the sum of its carriers, none for a point at rest. If the list is shorter
    /// than that of the points, point k beyond it moves with node k.
    pub carriers: Vec<Vec<Carrier>>,
    /// Kind of part of every point; may be empty.
    pub parts: Vec<Part>,
}

/// A node that a point moves with as on a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carrier {
    pub node: usize,
    /// Position from the node \[m\].
    pub arm: [f64; 3],
    /// Share of the motion.
    pub weight: f64,
}

/// Kind of part, by its number in the field `part`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Shaft = 0,
    Disc = 1,
    Body = 2,
    Ring = 3,
    Ball = 4,
    Cage = 5,
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
    /// Displacement and rotation of a point: Σ w (u + θ × r), Σ w θ.
    fn motion(&self, k: usize, q: &[f64]) -> [[f64; 3]; 2] {
        let own = [Carrier { node: k, arm: [0.0; 3], weight: 1.0 }];
        let carriers = self.carriers.get(k).map_or(&own[..], |list| list);
        let mut out = [[0.0; 3]; 2];
        for c in carriers {
            let Some(&[u, v, w, a, b, t]) = q.get(6 * c.node..).and_then(|q| q.first_chunk()) else {
                continue;
            };
            let [x, y, z] = c.arm;
            let moved = [u + b * z - t * y, v + t * x - a * z, w + a * y - b * x];
            for i in 0..3 {
                out[0][i] += c.weight * moved[i];
                out[1][i] += c.weight * [a, b, t][i];
            }
        }
        out
    }
}

/// Fields `displacement` \[m\], `rotation` \[rad\] and `ball_load` \[N\] on [`Grid::of_machine`].
///
/// `q`: six DOFs per node, shaft nodes then bodies; `ball_loads`: one per ball, in the grid's order, at the
/// balls' centres. Missing values are zero.
pub fn machine_fields(grid: &Grid, q: &[f64], ball_loads: &[f64]) -> Vec<Field> {
    let nodes = q.len() / 6;
    let motion: Vec<[[f64; 3]; 2]> = (0..grid.points.len()).map(|k| grid.motion(k, q)).collect();
    let load = |k: usize| k.checked_sub(nodes).and_then(|j| ball_loads.get(j)).copied().unwrap_or(0.0);
    let vectors = |name: &str, i: usize| Field {
        name: name.into(),
        values: Values::Vectors(motion.iter().map(|m| m[i]).collect()),
    };
    vec![
        vectors("displacement", 0),
        vectors("rotation", 1),
        Field {
            name: "ball_load".into(),
            values: Values::Scalars((0..grid.points.len()).map(load).collect()),
        },
    ]
}

/// Field `part`: the kind of part of every point.
pub fn part_field(grid: &Grid) -> Field {
    let part = |k: usize| grid.parts.get(k).map_or(0.0, |p| f64::from(*p as u8));
    Field { name: "part".into(), values: Values::Scalars((0..grid.points.len()).map(part).collect()) }
}

/// Cells of a grid: lines, triangles, then a vertex for every point without either.
struct Cells {
    corners: Vec<usize>,
    /// Number of corners up to the end of each cell.
    ends: Vec<usize>,
    /// VTK's number of the kind of each cell.
    kinds: Vec<usize>,
}

impl Cells {
    /// Errors: a message that names a corner that does not exist.
    fn of(grid: &Grid) -> Result<Self, String> {
        let count = grid.points.len();
        let mut joined = vec![false; count];
        for &k in grid.lines.iter().flatten() {
            *joined.get_mut(k).ok_or(format!("a line ends at point {k} of {count}"))? = true;
        }
        for &k in grid.triangles.iter().flatten() {
            *joined.get_mut(k).ok_or(format!("a triangle has its corner at point {k} of {count}"))? = true;
        }
        let single: Vec<usize> = (0..count).filter(|&k| !joined[k]).collect();
        const VERTEX: usize = 1;
        const LINE: usize = 3;
        const TRIANGLE: usize = 5;
        let kinds =
            [(LINE, 2, grid.lines.len()), (TRIANGLE, 3, grid.triangles.len()), (VERTEX, 1, single.len())];
        let corners = grid.lines.iter().flatten().chain(grid.triangles.iter().flatten()).chain(&single);
        let sizes = kinds.iter().flat_map(|&(_, size, number)| std::iter::repeat_n(size, number));
        let ends = sizes.scan(0, |end, size| {
            *end += size;
            Some(*end)
        });
        Ok(Self {
            corners: corners.copied().collect(),
            ends: ends.collect(),
            kinds: kinds.iter().flat_map(|&(kind, _, number)| std::iter::repeat_n(kind, number)).collect(),
        })
    }
}

/// The bytes of a .vtu file with binary data: points in double precision, fields in single precision.
///
/// # Errors
/// As [`to_vtu`].
pub fn to_binary_vtu(grid: &Grid, fields: &[Field]) -> Result<Vec<u8>, String> {
    let count = grid.points.len();
    let Cells { corners, ends, kinds } = Cells::of(grid)?;
    let mut data = Vec::new();
    // A declaration of an array and its data, each behind its number of bytes.
    let mut block = |kind: &str, name: &str, components: usize, bytes: Vec<u8>| {
        let offset = data.len();
        data.extend((bytes.len() as u64).to_le_bytes());
        data.extend(bytes);
        format!(
            "<DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{components}\" format=\"appended\" \
             offset=\"{offset}\"/>\n",
            escaped(name)
        )
    };
    let mut out = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{}\">\n\
         <PointData>\n",
        kinds.len()
    );
    let singles =
        |numbers: &[f64]| numbers.iter().flat_map(|x| (*x as f32).to_le_bytes()).collect::<Vec<u8>>();
    for Field { name, values } in fields {
        let (components, numbers) = match values {
            Values::Scalars(values) => (1, &values[..]),
            Values::Vectors(values) => (3, values.as_flattened()),
        };
        if numbers.len() != components * count {
            return Err(format!("field {name} does not have one value for each of {count} points"));
        }
        if numbers.iter().any(|x| !x.is_finite()) {
            return Err(format!("{name} contains a number that is not finite"));
        }
        out.push_str(&block("Float32", name, components, singles(numbers)));
    }
    let points: Vec<u8> = grid.points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    let integers =
        |values: &[usize]| values.iter().flat_map(|k| (*k as i64).to_le_bytes()).collect::<Vec<u8>>();
    out.push_str("</PointData>\n<Points>\n");
    out.push_str(&block("Float64", "points", 3, points));
    out.push_str("</Points>\n<Cells>\n");
    out.push_str(&block("Int64", "connectivity", 1, integers(&corners)));
    out.push_str(&block("Int64", "offsets", 1, integers(&ends)));
    out.push_str(&block("UInt8", "types", 1, kinds.iter().map(|kind| *kind as u8).collect()));
    out.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
    let mut bytes = out.into_bytes();
    bytes.extend(data);
    bytes.extend(b"\n</AppendedData>\n</VTKFile>\n");
    Ok(bytes)
}

/// The text of a .vtu file.
///
/// # Errors
/// A message naming a field without one value per point, or with a number that is not finite, which VTK
/// readers take for the end of the file.
pub fn to_vtu(grid: &Grid, fields: &[Field]) -> Result<String, String> {
    let count = grid.points.len();
    let Cells { corners, ends, kinds } = Cells::of(grid)?;
    let cells = kinds.len();
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
    integers(&mut out, "connectivity", "Int64", corners.into_iter());
    integers(&mut out, "offsets", "Int64", ends.into_iter());
    integers(&mut out, "types", "UInt8", kinds.into_iter());
    out.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    Ok(out)
}

/// Writes one .vtu file.
///
/// # Errors
/// [`Error::Environment`] when [`to_vtu`] rejects the data or the file cannot be written.
pub fn write_vtu(path: &Path, grid: &Grid, fields: &[Field]) -> Result<(), Error> {
    let text = to_vtu(grid, fields).map_err(Error::of_file("write", path))?;
    atomic_file::write_derived(path, text.as_bytes()).map_err(Error::of_file("write", path))
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
    atomic_file::write_derived(path, out.as_bytes()).map_err(Error::of_file("write", path))
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
