//! Comparison of the modes of machine variants.

use super::Machine;
use crate::analysis::Mode;
use crate::results::{ModalResult, PairedMode, PairedModes, UnpairedVariant, VariantComparison, VariantMode};
use rotordyn_linalg::Complex64;

/// A variant of a machine with its modes at the compared speeds.
pub struct Variant<'a> {
    pub name: &'a str,
    pub machine: &'a Machine,
    pub modal: &'a [ModalResult],
}

/// Pairs the modes of the variants at the speeds of the first; `min_mac`: smallest MAC of a pair, 0 to 1.
pub fn compare_variants(variants: &[Variant], min_mac: f64) -> VariantComparison {
    let speeds = variants.first().map_or(&[][..], |first| first.modal);
    let at_speed = |(k, at): (usize, &ModalResult)| {
        let modes: Vec<&[Mode]> =
            variants.iter().map(|v| v.modal.get(k).map_or(&[][..], |at| &at.modes)).collect();
        let rows = pair(variants, &modes, min_mac);
        PairedModes { speed: at.speed, modes: rows.iter().map(|row| row.result(variants, &modes)).collect() }
    };
    VariantComparison {
        variants: variants.iter().map(|v| v.name.to_string()).collect(),
        min_mac,
        speeds: speeds.iter().enumerate().map(at_speed).collect(),
    }
}

/// One mode in the variants so far.
struct Row<'a> {
    modes: Vec<Option<&'a Mode>>,
    /// Smallest MAC with the first mode.
    mac: Option<f64>,
}

impl<'a> Row<'a> {
    /// The first mode of the row and its variant.
    fn reference(&self) -> Option<(usize, &'a Mode)> {
        self.modes.iter().enumerate().find_map(|(v, mode)| Some((v, (*mode)?)))
    }

    fn lowest_frequency(&self) -> f64 {
        self.modes.iter().flatten().map(|m| m.frequency_hz()).fold(f64::INFINITY, f64::min)
    }

    fn result(&self, variants: &[Variant], modes: &[&[Mode]]) -> PairedMode {
        let unpaired = self.reference().map(|(of, reference)| {
            let missing = (0..modes.len()).filter(|&v| self.modes[v].is_none());
            let nearest = |v: usize| {
                let with_mac = modes[v].iter().map(|m| (m, mac(variants[of].machine, reference, m)));
                let best = with_mac.max_by(|a, b| a.1.total_cmp(&b.1));
                let nearest = best.map(|(mode, mac)| (plain(mode), mac));
                UnpairedVariant { variant: variants[v].name.into(), nearest }
            };
            missing.map(nearest).collect()
        });
        PairedMode {
            modes: self.modes.iter().map(|mode| mode.map(plain)).collect(),
            mac: self.mac,
            unpaired: unpaired.unwrap_or_default(),
        }
    }
}

fn plain(mode: &Mode) -> VariantMode {
    VariantMode { label: mode.label.clone(), frequency_hz: mode.frequency_hz(), zeta: mode.zeta() }
}

/// Pairs the modes of every variant with the existing rows, greedily by decreasing MAC down to `min_mac`.
fn pair<'a>(variants: &[Variant], modes: &[&'a [Mode]], min_mac: f64) -> Vec<Row<'a>> {
    let mut rows: Vec<Row> = Vec::new();
    for (v, modes) in modes.iter().enumerate() {
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (r, row) in rows.iter().enumerate() {
            let Some((of, reference)) = row.reference() else { continue };
            let mac_with = |m: &Mode| mac(variants[of].machine, reference, m);
            pairs.extend(modes.iter().enumerate().map(|(m, other)| (mac_with(other), r, m)));
        }
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        rows.iter_mut().for_each(|row| row.modes.push(None));
        let mut taken = vec![false; modes.len()];
        for (mac, r, m) in pairs.into_iter().filter(|pair| pair.0 >= min_mac) {
            if rows[r].modes[v].is_none() && !taken[m] {
                rows[r].modes[v] = Some(&modes[m]);
                rows[r].mac = Some(rows[r].mac.map_or(mac, |least| least.min(mac)));
                taken[m] = true;
            }
        }
        for (m, _) in taken.iter().enumerate().filter(|(_, taken)| !**taken) {
            let mut modes_of_row = vec![None; v];
            modes_of_row.push(Some(&modes[m]));
            rows.push(Row { modes: modes_of_row, mac: None });
        }
    }
    rows.sort_by(|a, b| a.lowest_frequency().total_cmp(&b.lowest_frequency()));
    rows
}

/// Mass-weighted MAC |aᴴ M b|² / (aᴴ M a · bᴴ M b) over the shaft DOFs common to the variants; 0 if shafts
/// differ.
fn mac(machine: &Machine, a: &Mode, b: &Mode) -> f64 {
    let shaft = 6 * machine.assembly.dofs.shaft_nodes;
    let full = machine.assembly.dofs.full_len();
    if b.full_shape.len() < shaft || b.whirl.len() != a.whirl.len() {
        return 0.0;
    }
    let on_shaft = |mode: &Mode| {
        let mut shape = mode.full_shape.clone();
        shape.resize(full, Default::default());
        shape[shaft..].fill(Default::default());
        shape
    };
    let (a, b) = (on_shaft(a), on_shaft(b));
    let mass = &machine.assembly.full_mass;
    let (ma, mb) = (mass.mul_complex(&a), mass.mul_complex(&b));
    let product =
        |x: &[Complex64], y: &[Complex64]| x.iter().zip(y).map(|(x, y)| x.conj() * y).sum::<Complex64>();
    let size = product(&a, &ma).re * product(&b, &mb).re;
    if size > 0.0 { product(&a, &mb).norm_sqr() / size } else { 0.0 }
}
