//! Dynamic stiffness of synchronous motion at several speeds at once.

use super::harmonic::has_round_off;
use crate::assembly::Assembly;
use rotordyn_bearing::SiteTangent;
use rotordyn_linalg::complex_lanes::{ComplexLanes, LANES};
use rotordyn_linalg::{BandLayout, BandLuLanes, SparseRow, Triplets};
use std::sync::Arc;

/// S + K_b(Ω) + Ω K_c − Ω² M + jΩ (C + C_b(Ω) + Ω G) at [`LANES`] speeds Ω, K_b and C_b being those of the bearings.
///
/// The matrices of the machine are put into band storage once; those of the bearings are added at every speed.
pub struct SynchronousLanes {
    reached: Vec<usize>,
    /// Entries of the bearings' matrices that are not zero.
    pattern: Vec<bool>,
    /// M, G, C, S with belts, K_c in band storage.
    machine: [Vec<f64>; 5],
    places: Vec<Place>,
    lu: BandLuLanes,
}

/// What an entry of a bearing's matrix adds to the band storage.
struct Place {
    at: usize,
    site: usize,
    entry: [usize; 2],
    factor: f64,
}

impl SynchronousLanes {
    /// Memory for the groups of unknowns coupled to those in `reached` on bearings with these tangents. `None` with modal
    /// damping or round-off, which take more than one solution each.
    pub fn new(assembly: &Assembly, tangents: &[SiteTangent], reached: &[usize]) -> Option<Self> {
        if assembly.has_modal_damping() {
            return None;
        }
        let n = assembly.dofs.len();
        let mut bearings = Triplets::new(n, n);
        for (site, tangent) in assembly.sites.iter().zip(tangents) {
            // Absolute values: entries that cancel with these stiffnesses need not cancel with others.
            let present = |i: usize, j: usize| f64::from(u8::from(!is_zero(tangent, [i, j])));
            let present = std::array::from_fn(|i| std::array::from_fn(|j| present(i, j)));
            bearings.add_between_rows(&site.rows.clone().map(SparseRow::abs), &present);
        }
        let [m, g, c] = [&assembly.mass, &assembly.gyroscopic, &assembly.damping];
        let [s, belts, k_c] = [&assembly.stiffness, &assembly.belt_stiffness, &assembly.circulatory];
        let whole = assembly.layouts.layout(&[m, g, c, s, belts, k_c, &bearings.build()]);
        if has_round_off(&whole) {
            return None;
        }
        let layout = whole.restricted_to(reached);
        let mut machine = [m, g, c, s, k_c].map(|a| layout.scatter(a));
        machine[3].iter_mut().zip(layout.scatter(belts)).for_each(|(s, belt)| *s += belt);
        Some(Self {
            reached: reached.to_vec(),
            pattern: pattern(tangents),
            machine,
            places: places(assembly, tangents, &layout),
            lu: BandLuLanes::new(Arc::new(layout)),
        })
    }

    /// Whether bearings with these tangents, and loads on these unknowns, have a place here.
    pub fn suits(&self, tangents: &[SiteTangent], reached: &[usize]) -> bool {
        self.reached == reached && self.pattern == pattern(tangents)
    }

    /// Factorises at up to [`LANES`] speeds Ω \[rad/s\], each with its tangents; false where they are to be taken one by one.
    pub fn factor(&mut self, speeds: &[f64], tangents: &[Vec<SiteTangent>]) -> bool {
        // The last one is taken in all lanes left.
        let (Some(&last), Some(of_last)) = (speeds.last(), tangents.last()) else { return false };
        let omega: [f64; LANES] = std::array::from_fn(|lane| speeds.get(lane).copied().unwrap_or(last));
        self.lu.set_speeds(self.machine.each_ref().map(Vec::as_slice), &omega);
        let values = self.lu.values_mut();
        for Place { at, site, entry: [i, j], factor } in &self.places {
            let value = &mut values[*at];
            for (lane, omega) in omega.iter().enumerate() {
                let tangent = &tangents.get(lane).unwrap_or(of_last)[*site];
                value.re[lane] += factor * tangent.stiffness[*i][*j];
                value.im[lane] += omega * factor * tangent.damping[*i][*j];
            }
        }
        self.lu.factor()
    }

    /// Replaces f by the responses q.
    pub fn solve(&self, f: &mut [ComplexLanes]) {
        self.lu.solve(f);
    }
}

fn is_zero(tangent: &SiteTangent, [i, j]: [usize; 2]) -> bool {
    tangent.stiffness[i][j] == 0.0 && tangent.damping[i][j] == 0.0
}

fn pattern(tangents: &[SiteTangent]) -> Vec<bool> {
    tangents.iter().flat_map(|t| (0..36).map(|k| !is_zero(t, [k / 6, k % 6]))).collect()
}

/// Where the entries of the bearings' matrices that are not zero go in the band storage.
fn places(assembly: &Assembly, tangents: &[SiteTangent], layout: &BandLayout) -> Vec<Place> {
    let mut found = Vec::new();
    for (k, (site, tangent)) in assembly.sites.iter().zip(tangents).enumerate() {
        for entry in (0..36).map(|e| [e / 6, e % 6]).filter(|&entry| !is_zero(tangent, entry)) {
            let [left, right] = entry.map(|row| &site.rows[row].0);
            for (&(p, a), &(q, b)) in left.iter().flat_map(|l| right.iter().map(move |r| (l, r))) {
                if let Some(at) = layout.slot(p, q) {
                    found.push(Place { at, site: k, entry, factor: a * b });
                }
            }
        }
    }
    found
}
