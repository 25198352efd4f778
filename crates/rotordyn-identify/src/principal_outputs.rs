//! FRFs on the principal directions of the outputs: few curves instead of one for each output.

use nalgebra::DMatrix;

use super::IdentifyError;
use super::data::Data;
use rotordyn_linalg::{Complex64, eigen};

/// FRFs projected on at most `directions` principal directions of the outputs (PCA), the largest first; lengths and angles of
/// shapes are preserved. As they are if there are no more outputs.
pub(super) fn project_outputs(
    data: &Data,
    directions: usize,
) -> Result<Vec<Vec<Vec<Complex64>>>, IdentifyError> {
    let outputs = data.outputs();
    if outputs <= directions {
        return Ok(data.values.clone());
    }
    let flat = DMatrix::from_fn(outputs, 2 * data.inputs() * data.lines(), |o, c| {
        let (part, rest) = (c % 2, c / 2);
        let h = data.values[o][rest / data.lines()][rest % data.lines()];
        if part == 0 { h.re } else { h.im }
    });
    let (_, vectors) = eigen::symmetric(&(&flat * flat.transpose()))?;
    let along = |d: usize| {
        let direction = vectors.column(outputs - 1 - d);
        (0..data.inputs())
            .map(|i| {
                let mut sum = vec![Complex64::default(); data.lines()];
                for (row, weight) in data.values.iter().zip(direction.iter()) {
                    sum.iter_mut().zip(&row[i]).for_each(|(s, h)| *s += h * *weight);
                }
                sum
            })
            .collect()
    };
    Ok((0..directions).map(along).collect())
}
