//! FRF matrix of a test over responses, references and frequencies.

use super::{Dof, Kind, MeasuredData, Record, RecordError, Values};
use crate::Complex;

/// FRFs between every response and every reference, over one frequency axis.
#[derive(Clone, Debug, PartialEq)]
pub struct FrfMatrix {
    /// Frequencies \[Hz\].
    pub frequencies: Vec<f64>,
    /// In increasing order.
    pub responses: Vec<Dof>,
    /// In increasing order.
    pub references: Vec<Dof>,
    /// `values[response][reference][line]`, in `units`.
    pub values: Vec<Vec<Vec<Complex<f64>>>>,
    /// SI unit of each, `units[response][reference]`; empty if unknown.
    pub units: Vec<Vec<String>>,
    /// Coherence γ² with the same indices, if the file contains it for all FRFs.
    pub coherence: Option<Vec<Vec<Vec<f64>>>>,
}

impl MeasuredData {
    /// All FRFs of the file as one matrix, with coherence if present for all.
    ///
    /// # Errors
    /// No FRF, different frequency axes, a pair of response and reference missing or duplicated.
    pub fn frf_matrix(&self) -> Result<FrfMatrix, RecordError> {
        let frfs: Vec<&Record> = self.records.iter().filter(|r| r.kind == Kind::Frf).collect();
        let Some(first) = frfs.first() else {
            return Err(RecordError::NoFrf { found: self.kinds() });
        };
        let count = first.frf()?.len();
        let frequencies = first.axis.points(count);
        for (k, other) in frfs.iter().enumerate() {
            let place = |r: &Record| (r.response, r.reference);
            if let Some(before) = frfs[..k].iter().find(|before| place(before) == place(other)) {
                return Err(RecordError::DuplicateFrf {
                    first: before.name.clone(),
                    second: other.name.clone(),
                    between: format!("response {} to reference {}", other.response, other.reference),
                });
            }
            let same = other.frf()?.len() == count
                && match (&frequencies, other.axis.points(count)) {
                    (Some(a), Some(b)) => same_axis(a, &b),
                    _ => false,
                };
            if !same {
                return Err(RecordError::axes_differ(first, other));
            }
        }
        let responses = sorted(frfs.iter().map(|r| r.response));
        let references = sorted(frfs.iter().map(|r| r.reference));
        let (mut values, mut units) = (Vec::new(), Vec::new());
        for &response in &responses {
            let (mut row, mut row_units) = (Vec::new(), Vec::new());
            for &reference in &references {
                let here = frfs.iter().find(|r| (r.response, r.reference) == (response, reference));
                let record = here.ok_or_else(|| RecordError::MissingFrf {
                    response: response.to_string(),
                    reference: reference.to_string(),
                    few_references: references.len() < responses.len(),
                })?;
                row.push(record.frf()?.to_vec());
                row_units.push(record.unit.clone());
            }
            values.push(row);
            units.push(row_units);
        }
        let coherence = self.coherences(&responses, &references, count);
        let frequencies = frequencies.unwrap_or_default();
        Ok(FrfMatrix { frequencies, responses, references, values, units, coherence })
    }

    fn coherences(&self, responses: &[Dof], references: &[Dof], count: usize) -> Option<Vec<Vec<Vec<f64>>>> {
        let between = |response: Dof, reference: Dof| {
            self.records.iter().find_map(|r| match &r.values {
                Values::Real(values)
                    if r.kind == Kind::Coherence
                        && (r.response, r.reference) == (response, reference)
                        && values.len() == count =>
                {
                    Some(values.clone())
                }
                _ => None,
            })
        };
        let row =
            |&response: &Dof| references.iter().map(|&reference| between(response, reference)).collect();
        responses.iter().map(row).collect()
    }

    /// Number of records of each kind, "3 time, 1 PSD".
    fn kinds(&self) -> String {
        let count = |kind: Kind| self.records.iter().filter(|r| r.kind == kind).count();
        let found: Vec<String> = Kind::LABELS
            .iter()
            .filter(|(kind, _)| count(*kind) > 0)
            .map(|(kind, word)| format!("{} {word}", count(*kind)))
            .collect();
        if found.is_empty() { "none".into() } else { found.join(", ") }
    }
}

/// Whether two axes agree within a thousandth of their step (rounding of printed digits).
fn same_axis(a: &[f64], b: &[f64]) -> bool {
    let step = if a.len() > 1 { (a[a.len() - 1] - a[0]).abs() / (a.len() - 1) as f64 } else { 1.0 };
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-3 * step)
}

fn sorted(dofs: impl Iterator<Item = Dof>) -> Vec<Dof> {
    let mut list: Vec<Dof> = dofs.collect();
    list.sort();
    list.dedup();
    list
}
