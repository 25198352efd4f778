//! Shift of measured natural frequencies with the force level: nonlinearity of clearances and contacts.

use super::pairing::{Candidate, pair_modes};
use super::state::ModelState;
use super::target::Target;
use rotordyn_core::document::{Document, MissingCell, Rows, Section};

/// Largest relative shift at which two modes still count as the same one.
const MAX_FREQUENCY_SHIFT: f64 = 0.2;

/// Frequency shift of every mode of the first measurement in the others.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceLevelShifts {
    /// Peak force of every measurement \[N\].
    pub forces: Vec<Option<f64>>,
    pub modes: Vec<ShiftedMode>,
}

/// A mode of the first measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct ShiftedMode {
    /// Label of the computed mode paired with it.
    pub label: Option<String>,
    pub frequency_hz: f64,
    /// In every other measurement; `None` where it has no pair.
    pub shifts: Vec<Option<FrequencyShift>>,
}

/// The same mode in another measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrequencyShift {
    pub frequency_hz: f64,
    /// f/f₁ − 1.
    pub shift: f64,
    pub mac: f64,
    pub damping_ratio: Option<f64>,
}

impl ForceLevelShifts {
    /// Pairs the modes of every measurement with those of the first; `first`: the model's modes paired with the first.
    ///
    /// `None` if the measurements have different points.
    pub fn new(measured: &[(&Target, Option<f64>)], first: &ModelState) -> Option<Self> {
        let (reference, others) = measured.split_first()?;
        let reference = reference.0;
        if others.iter().any(|(target, _)| target.sensors.len() != reference.sensors.len()) {
            return None;
        }
        let pairings: Vec<_> = others
            .iter()
            .map(|(target, _)| pair_modes(&candidates(reference), &candidates(target)))
            .collect();
        let modes = reference.modes.iter().enumerate().map(|(m, mode)| {
            let shift = |(pairing, (target, _)): (&super::pairing::Pairing, &(&Target, Option<f64>))| {
                pairing.pairs.iter().filter(|pair| pair.measured == m).find_map(|pair| {
                    let other = &target.modes[pair.computed];
                    let shift = other.frequency_hz / mode.frequency_hz - 1.0;
                    (shift.abs() < MAX_FREQUENCY_SHIFT).then_some(FrequencyShift {
                        frequency_hz: other.frequency_hz,
                        shift,
                        mac: pair.mac,
                        damping_ratio: other.damping_ratio,
                    })
                })
            };
            ShiftedMode {
                label: first.paired_mode(m).map(|(mode, _)| mode.label.clone()),
                frequency_hz: mode.frequency_hz,
                shifts: pairings.iter().zip(others).map(shift).collect(),
            }
        });
        Some(Self { forces: measured.iter().map(|(_, force)| *force).collect(), modes: modes.collect() })
    }

    /// What is written to files.
    pub fn section(&self) -> Section<'_> {
        let forces: Vec<f64> = self.forces.iter().map(|force| force.unwrap_or(f64::NAN)).collect();
        let of =
            |shift: &Option<FrequencyShift>, value: fn(&FrequencyShift) -> f64| shift.as_ref().map(value);
        let modes = Rows::of(&self.modes)
            .text("label", |m| m.label.as_deref().unwrap_or("-"))
            .number("hz", "Hz", |m| m.frequency_hz)
            .nested(
                "shifts",
                |m| &m.shifts,
                |rows| {
                    rows.optional("hz", "Hz", |s| of(s, |s| s.frequency_hz))
                        .missing(MissingCell::Row)
                        .optional("shift", "1", |s| of(s, |s| s.shift))
                        .optional("mac", "1", |s| of(s, |s| s.mac))
                },
            );
        let content = Document::new().numbers("forces", "N", forces).table("modes", modes);
        Section::new("force_level_shifts", "force_level_shifts", content)
    }
}

fn candidates(target: &Target) -> Vec<Candidate<'_>> {
    target.modes.iter().map(|m| Candidate { frequency_hz: m.frequency_hz, shape: &m.shape }).collect()
}
