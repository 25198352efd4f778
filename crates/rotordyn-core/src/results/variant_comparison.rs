//! Natural frequencies of the variants of a machine, paired by the MAC of their modes.

use crate::document::{Array, Document, Rows, Section};
use serde::{Deserialize, Serialize};

/// Modes of several variants, paired at every speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VariantComparison {
    pub variants: Vec<String>,
    /// Smallest MAC of a pair.
    pub min_mac: f64,
    pub speeds: Vec<PairedModes>,
}

/// Modes at one speed, by their lowest frequency.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairedModes {
    /// Ω \[rad/s\].
    pub speed: f64,
    pub modes: Vec<PairedMode>,
}

/// One mode in the variants.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairedMode {
    /// In every variant; the first one is the reference of the MAC.
    pub modes: Vec<Option<VariantMode>>,
    /// Smallest MAC with the reference; `None` without a pair.
    pub mac: Option<f64>,
    /// Variants in which the reference has no pair.
    pub unpaired: Vec<UnpairedVariant>,
}

/// A mode of one variant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VariantMode {
    pub label: String,
    pub frequency_hz: f64,
    pub zeta: f64,
}

/// A variant without a pair for a mode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnpairedVariant {
    /// Its name.
    pub variant: String,
    /// Its mode with the largest MAC, and that MAC; `None` without modes.
    pub nearest: Option<(VariantMode, f64)>,
}

impl PairedMode {
    /// Label in the first variant that has the mode.
    pub fn label(&self) -> &str {
        self.modes.iter().flatten().next().map_or("", |mode| &mode.label)
    }
}

impl VariantComparison {
    /// What is written to files.
    pub fn section(&self) -> Section<'_> {
        let count = self.variants.len();
        let of = |mode: &PairedMode, value: fn(&VariantMode) -> f64| -> Vec<f64> {
            mode.modes.iter().map(|mode| mode.as_ref().map_or(f64::NAN, value)).collect()
        };
        let nearest = |u: &UnpairedVariant, value: fn(&VariantMode) -> f64| {
            u.nearest.as_ref().map(|(mode, _)| value(mode))
        };
        let speeds =
            Rows::of(&self.speeds).number("rpm", "rpm", |at| at.speed * 30.0 / std::f64::consts::PI).nested(
                "modes",
                |at| &at.modes,
                |rows| {
                    rows.text("label", |m| m.label())
                        .optional("min_mac", "1", |m| m.mac)
                        .numbers("frequency_hz", "Hz", &[count], |m| of(m, |mode| mode.frequency_hz))
                        .cells_over(0, "variants")
                        .numbers("zeta", "1", &[count], |m| of(m, |mode| mode.zeta))
                        .cells_over(0, "variants")
                        .texts("labels", count, |m| {
                            m.modes.iter().map(|mode| mode.as_ref().map(|mode| mode.label.clone())).collect()
                        })
                        .cells_over(0, "variants")
                        .nested(
                            "unpaired",
                            |m| &m.unpaired,
                            |rows| {
                                rows.text("variant", |u| &u.variant)
                                    .optional("best_mac", "1", |u| u.nearest.as_ref().map(|(_, mac)| *mac))
                                    .optional_text("best_label", |u| {
                                        u.nearest.as_ref().map(|(mode, _)| &mode.label)
                                    })
                                    .optional("best_frequency_hz", "Hz", |u| {
                                        nearest(u, |mode| mode.frequency_hz)
                                    })
                            },
                        )
                },
            );
        let content = Document::new()
            .array("variants", Array::texts(&[count], &self.variants))
            .number("min_pair_mac", "1", self.min_mac)
            .table("speeds", speeds);
        Section::new("comparison", "comparison", content)
    }
}
