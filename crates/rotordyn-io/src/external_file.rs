//! External data files referenced by a model file, read as columns of numbers.

use std::path::Path;

use super::measured;
use crate::budget::Limits;
use rotordyn_core::model::{ExternalColumn, ExternalFile};
use rotordyn_signal::record::{AxisQuantity, Values};

/// Reads a file with a path relative to `folder`; the result contains the error if it could not be read.
///
/// The time axis of the columns becomes a column `time`.
pub fn read_external_file(folder: &Path, path: &str, limits: &Limits) -> ExternalFile {
    let content =
        measured::read_within(&folder.join(path), limits).map_err(|error| error.to_string()).map(|found| {
            let mut columns: Vec<ExternalColumn> = Vec::new();
            for record in found.records {
                let Values::Real(values) = record.values else { continue };
                let listed =
                    record.axis.points(values.len()).filter(|_| record.axis.quantity == AxisQuantity::Time);
                if let Some(points) = listed
                    && !columns.iter().any(|c| c.name == "time")
                {
                    columns
                        .insert(0, ExternalColumn { name: "time".into(), unit: "s".into(), values: points });
                }
                columns.push(ExternalColumn { name: record.name, unit: record.unit, values });
            }
            columns
        });
    ExternalFile { path: path.into(), content }
}
