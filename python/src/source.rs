//! A model file with its variant and the changes of the user; a change makes another object, so that a run in another
//! thread keeps the model with which it began.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rotordyn::error::Error;
use rotordyn::io::budget;
use rotordyn::model::parameter_paths::resolve_parameter_path;
use rotordyn::model::{self, Diagnostic, Loaded, Options};
use rotordyn::warning::Warning;

use crate::cli::failure::Failure;
use crate::cli::limits::limits;
use crate::cli::machine::ModelSource;
use crate::failure::{Stop, detached, to_python};
use crate::reading::use_default_limits;

/// A model file with variant and changes, validated.
#[pyclass(frozen, module = "rotordyn._native")]
pub struct Source {
    pub file: ModelSource,
    pub loaded: Arc<Loaded>,
}

/// A warning as Python takes it: code, severity, item, text, what to do.
pub type WarningTexts = (String, String, String, String, String);

pub fn warning_texts(warning: &Warning) -> WarningTexts {
    let severity = warning.code.severity().name().to_string();
    let code = warning.code.name().to_string();
    (code, severity, warning.item.clone(), warning.text.clone(), warning.what_to_do().to_string())
}

impl Source {
    fn validated(file: ModelSource) -> Result<Self, Stop> {
        let loaded = Arc::new(file.load(&[])?);
        Ok(Self { file, loaded })
    }
}

#[pymethods]
impl Source {
    /// Reads a model file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf, variant: Option<String>) -> PyResult<Self> {
        use_default_limits();
        detached(py, || {
            let (text, _) = budget::read_file(&path, limits()).map_err(|error| match error {
                Error::Environment { path, source, .. } => {
                    Error::Environment { operation: "read the model file", path, source }
                }
                other => other,
            })?;
            let folder = path.parent().map(PathBuf::from).unwrap_or_default();
            let name = path.display().to_string();
            let options = Options { variant, set: Vec::new() };
            Self::validated(ModelSource { name, text, options, folder, files: None })
        })
    }

    /// The model of a text; `folder`: where the files that it names are.
    #[staticmethod]
    fn of_text(
        py: Python<'_>,
        text: Vec<u8>,
        name: String,
        folder: PathBuf,
        variant: Option<String>,
        changes: Vec<(String, String)>,
    ) -> PyResult<Self> {
        use_default_limits();
        detached(py, || {
            let options = Options { variant, set: changes };
            Self::validated(ModelSource { name, text, options, folder, files: None })
        })
    }

    /// The model with other changes, each a path and a value in TOML.
    fn with_changes(&self, py: Python<'_>, changes: Vec<(String, String)>) -> PyResult<Self> {
        detached(py, || {
            let mut file = self.file.clone();
            file.options.set = changes;
            Self::validated(file)
        })
    }

    /// The model with another variant of its file.
    fn with_variant(&self, py: Python<'_>, variant: &str) -> PyResult<Self> {
        detached(py, || Self::validated(self.file.with_variant(variant)))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.loaded.model.name
    }

    #[getter]
    fn title(&self) -> &str {
        &self.loaded.model.title
    }

    /// Names of the variants of the file.
    #[getter]
    fn variants(&self) -> Vec<String> {
        self.file.variants()
    }

    /// Names of the bearings.
    #[getter]
    fn bearings(&self) -> Vec<String> {
        self.loaded.model.bearings.iter().map(|site| site.name.clone()).collect()
    }

    /// What `of_text` makes the same model of: text, file name, folder, variant, changes.
    #[getter]
    #[allow(clippy::type_complexity)]
    fn parts(&self) -> (Vec<u8>, String, PathBuf, Option<String>, Vec<(String, String)>) {
        let ModelSource { text, name, folder, options, .. } = &self.file;
        (text.clone(), name.clone(), folder.clone(), options.variant.clone(), options.set.clone())
    }

    /// Warnings of the model file.
    #[getter]
    fn warnings(&self) -> Vec<WarningTexts> {
        self.loaded.warnings.iter().filter_map(Diagnostic::to_warning).map(|w| warning_texts(&w)).collect()
    }

    /// The text of the file, or with variant or changes the text of the model as it stands.
    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        detached(py, || {
            if self.file.options == Options::default() {
                return Ok(self.loaded.text.clone());
            }
            Ok(model::written_out(&self.file.text, &self.file.options)?)
        })
    }

    /// All values of the model as it stands: nested dictionaries.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_value(py, &toml::Value::Table(self.table(py)?))
    }

    /// The value at a path, or the default that the model takes there.
    fn value<'py>(&self, py: Python<'py>, path: &str) -> PyResult<Bound<'py, PyAny>> {
        let present = model::renamed_path(path);
        let written = present.as_deref().unwrap_or(path);
        let root = toml::Value::Table(self.table(py)?);
        let found = written.split('.').try_fold(&root, |at, part| match at {
            toml::Value::Table(table) => table.get(part),
            toml::Value::Array(items) => part.parse::<usize>().ok().and_then(|k| items.get(k)),
            _ => None,
        });
        if let Some(found) = found {
            return to_value(py, found);
        }
        if let Some(default) = self.loaded.defaults.iter().find(|default| default.path == written) {
            return default.value.as_str().into_bound_py_any(py);
        }
        let reason = resolve_parameter_path(&self.file.text, &self.file.options, path).err();
        let reason = reason.unwrap_or_else(|| format!("{path}: there is no such value"));
        Err(to_python(py, Stop::Failure(Failure::Input(reason))))
    }
}

impl Source {
    fn table(&self, py: Python<'_>) -> PyResult<toml::Table> {
        detached(py, || {
            let text = model::written_out(&self.file.text, &self.file.options)?;
            Ok(text.parse::<toml::Table>().map_err(|error| Failure::Input(error.to_string()))?)
        })
    }
}

fn to_value<'py>(py: Python<'py>, value: &toml::Value) -> PyResult<Bound<'py, PyAny>> {
    match value {
        toml::Value::String(text) => text.into_bound_py_any(py),
        toml::Value::Integer(number) => number.into_bound_py_any(py),
        toml::Value::Float(number) => number.into_bound_py_any(py),
        toml::Value::Boolean(flag) => flag.into_bound_py_any(py),
        toml::Value::Datetime(date) => date.to_string().into_bound_py_any(py),
        toml::Value::Array(items) => {
            let items: Vec<_> = items.iter().map(|item| to_value(py, item)).collect::<PyResult<_>>()?;
            Ok(PyList::new(py, items)?.into_any())
        }
        toml::Value::Table(table) => {
            let found = PyDict::new(py);
            for (key, value) in table {
                found.set_item(key, to_value(py, value)?)?;
            }
            Ok(found.into_any())
        }
    }
}
