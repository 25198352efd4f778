//! Jerk, and race defects located from it.

use crate::document::{Array, Document, Rows, in_hdf5, in_json};
use rotordyn_signal::jerk::JerkJump;
use rotordyn_signal::race_defects::{DefectKind, FoldedJerk, RaceDefect};
use serde::{Deserialize, Serialize};

/// Jerk, its jumps, and the race defects located from them.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct JerkResult {
    /// \[unit/s\].
    pub jerk: Vec<f64>,
    /// Jumps in the unfolded record.
    pub jumps: Vec<JerkJump>,
    /// The jerk folded over the ball passages, and the defects located from it.
    pub race: Option<RaceResult>,
}

/// Defects of a race located from jerk jumps.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RaceResult {
    /// "outer race" or "inner race".
    pub race: String,
    /// Radius of the raceway \[m\].
    pub radius: Option<f64>,
    /// Whether two directions were given, so that angles are known over the full circumference.
    pub full_circumference: bool,
    pub fold: FoldedJerk,
    pub defects: Vec<RaceDefect>,
}

impl JerkResult {
    pub(super) fn document(&self, unit: &str) -> Document<'_> {
        let unit = format!("{unit}/s");
        let mut content = Document::new().integer(in_json("jumps"), self.jumps.len()).numbers(
            in_hdf5("jerk"),
            &unit,
            &self.jerk,
        );
        if !self.jumps.is_empty() {
            let jumps =
                Rows::of(&self.jumps)
                    .number("jump_time", "s", |j| j.time)
                    .number("jump_size", &unit, |j| j.size);
            content = content.table(in_hdf5(""), jumps);
        }
        let Some(race) = &self.race else { return Document::new().group("jerk", content) };
        let kind = |d: &RaceDefect| match d.kind {
            DefectKind::Dent => "dent",
            DefectKind::Bump => "bump",
        };
        let defects = Rows::of(&race.defects)
            .text("kind", kind)
            .number("angle", "rad", |d| d.angle)
            .number("width", "rad", |d| d.width)
            .optional("width_m", "m", |d| race.radius.map(|r| r * d.width))
            .numbers("jumps", "s", &[2], |d| d.jumps);
        content = content
            .text(in_json("race"), &race.race)
            .flag(in_json("full_circumference"), race.full_circumference)
            .table(in_json("defects"), defects);
        let changes = Array::complex(&[race.fold.changes.len()], &unit, &race.fold.changes);
        let mut folded = Document::new()
            .text("race", &race.race)
            .numbers("angle", "rad", &race.fold.angles)
            .array("jerk_change", changes.over(0, "angle"));
        if !race.defects.is_empty() {
            let defects = Rows::of(&race.defects)
                .number("defect_angle", "rad", |d| d.angle)
                .number("defect_width", "rad", |d| d.width)
                .text("defect_kind", kind);
            folded = folded.table("", defects);
        }
        Document::new().group("jerk", content).group(in_hdf5("folded_jerk"), folded)
    }
}
