//! FRFs in a part of the band, less the modes outside it, on few directions: cheap fits of what is there.

use nalgebra::DMatrix;

use super::data::Data;
use super::lsfd::Fit;
use super::plscf::Pole;
use rotordyn_linalg::Complex64;

/// Principal directions of the outputs that are fitted: more than the modes in a window.
const DIRECTIONS: usize = 6;

pub(super) struct Window {
    pub data: Data,
    /// Modes inside, and their places among all.
    pub near: Vec<Pole>,
    pub inside: Vec<usize>,
}

impl Window {
    /// The part of the band between two frequencies \[Hz\].
    pub fn new(data: &Data, poles: &[Pole], fit: &Fit, between: [f64; 2]) -> Self {
        let line =
            |hz: f64| ((hz - data.frequencies[0]) / data.step).round().clamp(0.0, (data.lines() - 1) as f64);
        let [first, last] = between.map(|hz| line(hz) as usize);
        let band = [data.frequencies[first], data.frequencies[last]];
        let (inside, far): (Vec<usize>, Vec<usize>) =
            (0..poles.len()).partition(|&k| poles[k].is_inside(band));
        let s = data.s();
        let others = |o: usize, i: usize, k: usize| -> Complex64 {
            let of = |&r: &usize| {
                let (value, residue) = (poles[r].value, fit.shapes[r][o] * poles[r].participation[i]);
                residue / (s[k] - value) + residue.conj() / (s[k] - value.conj())
            };
            far.iter().map(of).sum::<Complex64>() * s[k].powi(data.power)
        };
        let near = inside.iter().map(|&k| poles[k].clone()).collect();
        Self { data: projected(data.window(first..=last, others)), near, inside }
    }
}

/// FRFs on the principal directions of the outputs; lengths and angles of shapes are preserved.
fn projected(data: Data) -> Data {
    let outputs = data.outputs();
    if outputs <= DIRECTIONS {
        return data;
    }
    let (lines, inputs) = (data.lines(), data.inputs());
    let flat = DMatrix::from_fn(2 * inputs * lines, outputs, |row, o| {
        let h = data.values[o][row / (2 * lines)][row / 2 % lines];
        if row % 2 == 0 { h.re } else { h.im }
    });
    let eigen = flat.tr_mul(&flat).symmetric_eigen();
    let mut order: Vec<usize> = (0..outputs).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let along = |place: &usize| -> Vec<Vec<Complex64>> {
        let direction = eigen.eigenvectors.column(*place);
        let sum = |i: usize, k: usize| -> Complex64 {
            data.values.iter().zip(direction.iter()).map(|(row, weight)| row[i][k] * *weight).sum()
        };
        (0..inputs).map(|i| (0..lines).map(|k| sum(i, k)).collect()).collect()
    };
    let values = order.iter().take(DIRECTIONS).map(along).collect();
    Data { values, output_scale: vec![1.0; DIRECTIONS], ..data }
}
