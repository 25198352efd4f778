//! The largest load of every bearing in a run.

use super::system::{State, System};
use serde::{Deserialize, Serialize};

/// State of a bearing where its force is largest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeakLoad {
    pub bearing: String,
    /// \[s\].
    pub time: f64,
    /// Shaft speed \[rad/s\].
    pub speed: f64,
    /// \[rad\].
    pub cage_angle: f64,
    /// u_x u_y u_z θ_x θ_y of the shaft against the housing \[m, rad\]; 0 where the bearing has none.
    pub displacement: [f64; 5],
    /// Size of the force \[N\].
    pub force: f64,
}

/// Looks for the largest loads at the instants that it is shown.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PeakLoads {
    found: Vec<PeakLoad>,
}

impl PeakLoads {
    /// Looks at a state of a run of `system`.
    pub fn observe(&mut self, system: &System, state: &State) {
        for (k, (interface, reaction)) in system.interfaces.iter().zip(&state.reactions).enumerate() {
            let force = reaction.force[..3].iter().map(|f| f * f).sum::<f64>().sqrt();
            if self.found.len() == k {
                self.found.push(PeakLoad {
                    bearing: interface.name.clone(),
                    time: 0.0,
                    speed: 0.0,
                    cage_angle: 0.0,
                    displacement: [0.0; 5],
                    force: 0.0,
                });
            }
            let peak = &mut self.found[k];
            if force > peak.force {
                let rows = &state.d[interface.first_row..][..interface.element.relative_dofs().min(5)];
                peak.displacement = std::array::from_fn(|axis| rows.get(axis).copied().unwrap_or(0.0));
                (peak.time, peak.speed, peak.force) = (state.time, state.spin.speed, force);
                peak.cage_angle = state.rotations[k].cage_angle;
            }
        }
    }

    /// The largest load of every bearing that had one.
    pub fn found(&self) -> Vec<PeakLoad> {
        self.found.iter().filter(|peak| peak.force > 0.0).cloned().collect()
    }
}
