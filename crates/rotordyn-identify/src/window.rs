//! FRFs in a part of the band, less the modes outside it, on few directions: cheap fits of what is there.

use super::data::Data;
use super::lsfd::Fit;
use super::plscf::Pole;
use super::principal_outputs::project_outputs;
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
    /// The part of the band between two frequencies \[Hz\]; `None` if the principal directions cannot be found.
    pub fn new(data: &Data, poles: &[Pole], fit: &Fit, between: [f64; 2]) -> Option<Self> {
        let mut here = Self::of_all_outputs(data, poles, fit, between);
        here.data.values = project_outputs(&here.data, DIRECTIONS).ok()?;
        if here.data.output_scale.len() > DIRECTIONS {
            // A direction is no output: it has no scale of its own.
            here.data.output_scale = vec![1.0; DIRECTIONS];
        }
        Some(here)
    }

    /// The same with the outputs as they are.
    pub fn of_all_outputs(data: &Data, poles: &[Pole], fit: &Fit, between: [f64; 2]) -> Self {
        let line =
            |hz: f64| ((hz - data.frequencies[0]) / data.step).round().clamp(0.0, (data.lines() - 1) as f64);
        let [first, last] = between.map(|hz| line(hz) as usize);
        let band = [data.frequencies[first], data.frequencies[last]];
        let (inside, far): (Vec<usize>, Vec<usize>) =
            (0..poles.len()).partition(|&k| poles[k].is_inside(band));
        let (s, factor) = (data.s(), data.factor());
        let others = |o: usize, i: usize, k: usize| -> Complex64 {
            let of = |&r: &usize| {
                let (value, residue) = (poles[r].value, fit.shapes[r][o] * poles[r].participation[i]);
                residue / (s[k] - value) + residue.conj() / (s[k] - value.conj())
            };
            far.iter().map(of).sum::<Complex64>() * factor[k]
        };
        let near = inside.iter().map(|&k| poles[k].clone()).collect();
        Self { data: data.window(first..=last, others), near, inside }
    }
}
