//! Warnings of a machine and its results: one pass over model, equilibrium and studies.

mod deflection;
mod linear;
mod margins;
mod modes;
mod order_tracks;
mod run;
mod spectrogram;
mod supports;
mod tables;
mod whirl;

pub use order_tracks::smeared_maxima;
pub(super) use supports::standstill_and_top;

use super::Machine;
use crate::study::Results;
use crate::warning::{Code, Warning};

impl Machine {
    /// What restricts the results of studies at these speeds \[rad/s\], in the order of a reader's interest: the machine at
    /// rest and at speed, its modes, its responses, its runs.
    ///
    /// Without speeds only what the results themselves show: post-processing of a stored run computes nothing of the
    /// machine.
    pub fn warnings(&self, results: &Results, speeds: &[f64]) -> Vec<Warning> {
        let mut found = Vec::new();
        if !speeds.is_empty() {
            found.extend(self.support_warnings(speeds));
            found.extend(self.deflection_warnings(results));
        }
        found.extend(tables::warnings(&self.model, results));
        found.extend(supports::ball_inertia(results));
        found.extend(modes::warnings(results));
        found.extend(self.mesh_warnings(results));
        found.extend(self.whirl_frequency_warnings(results));
        found.extend(self.unstable_mode_warnings(results).unwrap_or_else(|error| {
            let text = format!("the stability of the modes is not checked: {error}");
            vec![Warning::new(Code::NotChecked, "", text)]
        }));
        found.extend(self.linear_warnings(results));
        if !speeds.is_empty() {
            found.extend(results.unbalance.iter().flat_map(|response| self.margin_range_warnings(response)));
        }
        found.extend(results.run_up.iter().flat_map(|run| self.run_up_warnings(run)));
        for warning in results.run_up.iter().flat_map(|run| self.peak_load_warnings(&run.peak_loads)) {
            // That of the static load is enough.
            if !found.iter().any(|known| known.code == warning.code && known.item == warning.item) {
                found.push(warning);
            }
        }
        found.extend(run::sample_rate(&self.model, results));
        found.extend(spectrogram::smeared_orders(&self.model, results));
        found.extend(order_tracks::orders_in_one_band(results));
        found.extend(run::settling(&self.model, results));
        found
    }
}
