//! Documents of results as Python values: for every field its names, its unit and its value, numbers as NumPy arrays.
//!
//! A field is a tuple (name in JSON, name in HDF5, kind, unit, factor, value); the factor takes the value to the number
//! of the JSON name, which may be in rpm. The classes of `rotordyn/tree.py` read it.

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, ToPyArray};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use rotordyn::document::{Array, Count, Data, Document, Field, Section, Table, Value};

type Any<'py> = Bound<'py, PyAny>;

/// Sections by their name in JSON, those of a listed name in a list.
pub fn sections<'py>(py: Python<'py>, found: &[Section]) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    for section in found {
        let content = document(py, &section.content)?;
        if !section.listed {
            out.set_item(section.json, content)?;
            continue;
        }
        match out.get_item(section.json)? {
            Some(list) => list.cast::<PyList>()?.append(content)?,
            None => out.set_item(section.json, PyList::new(py, [content])?)?,
        }
    }
    Ok(out)
}

/// A list of the fields of a document.
pub fn document<'py>(py: Python<'py>, found: &Document) -> PyResult<Bound<'py, PyList>> {
    let fields: Vec<_> = found.fields.iter().map(|field| self::field(py, field)).collect::<PyResult<_>>()?;
    PyList::new(py, fields)
}

fn field<'py>(py: Python<'py>, Field { names, value }: &Field) -> PyResult<Bound<'py, PyTuple>> {
    let factor = |unit: &str| names.json_factor(unit).unwrap_or(1.0);
    let (kind, unit, factor, value): (&str, &str, f64, Any) = match value {
        Value::Text(text) => ("value", "", 1.0, text.into_bound_py_any(py)?),
        Value::Number(number, unit) => ("number", unit, factor(unit), number.into_bound_py_any(py)?),
        Value::Integer(number) => ("value", "", 1.0, number.into_bound_py_any(py)?),
        Value::Flag(flag) => ("value", "", 1.0, flag.into_bound_py_any(py)?),
        Value::Texts(texts) => ("value", "", 1.0, texts.into_bound_py_any(py)?),
        Value::Missing => ("value", "", 1.0, py.None().into_bound(py)),
        Value::Array(array) => ("array", &array.unit, factor(&array.unit), self::array(py, array)?),
        Value::Group(members) => ("group", "", 1.0, document(py, members)?.into_any()),
        Value::Groups { groups, .. } => {
            let found: Vec<_> = groups
                .iter()
                .map(|(name, members)| (name, document(py, members)?).into_bound_py_any(py))
                .collect::<PyResult<_>>()?;
            ("groups", "", 1.0, PyList::new(py, found)?.into_any())
        }
        Value::Table(table) => ("table", "", 1.0, self::table(py, table)?),
        Value::Stored(array) => {
            let values = array.values.all().map_err(|error| {
                pyo3::exceptions::PyOSError::new_err(format!("results cannot be read: {error}"))
            })?;
            ("array", &array.unit, 1.0, values.to_pyarray(py).reshape(array.shape.clone())?.into_any())
        }
    };
    (&names.json, &names.hdf5, kind, unit, factor, value).into_pyobject(py)
}

/// Number of rows, -1 for a single record, or a list of the rows within each outer row; axis column; columns.
fn table<'py>(py: Python<'py>, table: &Table) -> PyResult<Any<'py>> {
    let rows = match &table.rows {
        Count::One => (-1).into_bound_py_any(py)?,
        Count::Many(count) => count.into_bound_py_any(py)?,
        Count::Within(counts) => counts.into_bound_py_any(py)?,
    };
    (rows, &table.axis, document(py, &table.columns)?).into_bound_py_any(py)
}

fn array<'py>(py: Python<'py>, array: &Array) -> PyResult<Any<'py>> {
    let shape = array.shape.clone();
    let numbers = match &array.data {
        Data::Real(values) => values.to_pyarray(py).reshape(shape)?.into_any(),
        Data::Complex(values) => values.to_pyarray(py).reshape(shape)?.into_any(),
        Data::Flags(values) => values.to_pyarray(py).reshape(shape)?.into_any(),
        Data::Integers(values) => match values.iter().copied().collect::<Option<Vec<i64>>>() {
            Some(known) => known.to_pyarray(py).reshape(shape)?.into_any(),
            None => objects(py, values.iter().map(|value| value.into_py_any(py)).collect(), shape)?,
        },
        Data::Texts(values) => {
            objects(py, values.iter().map(|value| value.as_deref().into_py_any(py)).collect(), shape)?
        }
    };
    Ok((numbers, &array.axes).into_pyobject(py)?.into_any())
}

/// An array of Python objects, of which some may be None.
fn objects<'py>(py: Python<'py>, items: PyResult<Vec<Py<PyAny>>>, shape: Vec<usize>) -> PyResult<Any<'py>> {
    let shaped: Bound<'py, PyArrayDyn<Py<PyAny>>> = PyArray1::from_vec(py, items?).reshape(shape)?;
    Ok(shaped.into_any())
}
