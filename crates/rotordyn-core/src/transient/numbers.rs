//! Vectors and matrices as plain numbers in snapshots, bit for bit.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A vector as the list of its entries.
pub(super) mod vector {
    use super::*;
    use nalgebra::DVector;

    pub fn serialize<S: Serializer>(vector: &DVector<f64>, out: S) -> Result<S::Ok, S::Error> {
        vector.as_slice().serialize(out)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<DVector<f64>, D::Error> {
        Ok(DVector::from_vec(Vec::deserialize(from)?))
    }
}

/// A matrix as its number of rows and the list of its entries, column by column.
pub(super) mod matrix {
    use super::*;
    use nalgebra::DMatrix;
    use serde::de::Error;

    pub fn serialize<S: Serializer>(matrix: &DMatrix<f64>, out: S) -> Result<S::Ok, S::Error> {
        (matrix.nrows(), matrix.as_slice()).serialize(out)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<DMatrix<f64>, D::Error> {
        let (rows, entries) = <(usize, Vec<f64>)>::deserialize(from)?;
        if rows == 0 || !entries.len().is_multiple_of(rows) {
            return match entries.is_empty() {
                true => Ok(DMatrix::zeros(rows, 0)),
                false => Err(D::Error::custom(format!("{} entries in {rows} rows", entries.len()))),
            };
        }
        Ok(DMatrix::from_vec(rows, entries.len() / rows, entries))
    }
}
