//! Which warnings concern a figure: those of its study and bearing, and those of the whole machine.

use rotordyn_core::warning::{Code, Warning};

/// What a figure shows.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Concern<'a> {
    /// Names of its studies, as in the model file: `run_up`, `spectrogram`.
    pub studies: &'a [&'a str],
    /// The bearing that it shows alone.
    pub bearing: Option<&'a str>,
}

impl<'a> Concern<'a> {
    /// A figure of studies of the machine.
    pub fn of(studies: &'a [&'a str]) -> Self {
        Self { studies, bearing: None }
    }

    /// The same of one bearing.
    pub fn of_bearing(self, bearing: &'a str) -> Self {
        Self { bearing: Some(bearing), ..self }
    }

    /// The warnings that restrict what the figure shows.
    pub fn select(self, warnings: &[Warning]) -> Vec<Warning> {
        warnings.iter().filter(|warning| self.includes(warning)).cloned().collect()
    }

    fn includes(self, warning: &Warning) -> bool {
        let shows = |study: &str| self.studies.contains(&study);
        let (kind, name) = warning.item.split_once('.').unwrap_or((&warning.item, ""));
        match (kind, warning.code) {
            ("study", _) => shows(name),
            // Of the responses to unbalance, although it names the bearing.
            (_, Code::LinearRange) => shows("unbalance"),
            // Of the analysis of a bearing, without effect on the machine.
            (_, Code::Rating | Code::DefectsAveraged | Code::LubricantFilm | Code::SweepIncomplete) => {
                shows("bearing") && self.bearing.is_none_or(|bearing| bearing == name)
            }
            // `bearing.A`, or a part of it: `bearing.A.defect.0`.
            ("bearing", _) => self.bearing.is_none_or(|bearing| {
                name.strip_prefix(bearing).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
            }),
            _ => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_has_the_warnings_of_its_study_its_bearing_and_the_machine() {
        let all = [
            Warning::new(Code::MaterialRange, "material.steel", "0"),
            Warning::new(Code::FreeMotion, "", "1"),
            Warning::new(Code::UndampedPeak, "study.frf", "2"),
            Warning::new(Code::EnergyBalance, "study.run_up", "3"),
            Warning::new(Code::BearingUnloaded, "bearing.A", "4"),
            Warning::new(Code::DefectGeometry, "bearing.A2.defect[0]", "5"),
            Warning::new(Code::LinearRange, "bearing.A", "6"),
            Warning::new(Code::Rating, "bearing.A", "7"),
        ];
        let texts = |concern: Concern| -> String {
            concern.select(&all).iter().map(|warning| warning.text.as_str()).collect()
        };
        for (concern, expected) in [
            (Concern::of(&["modal"]), "0145"),
            (Concern::of(&["frf"]), "01245"),
            (Concern::of(&["unbalance"]), "01456"),
            (Concern::of(&["run_up"]).of_bearing("A"), "0134"),
            (Concern::of(&["run_up"]).of_bearing("A2"), "0135"),
            (Concern::of(&["bearing"]).of_bearing("A"), "0147"),
            (Concern::of(&["bearing"]).of_bearing("A2"), "015"),
        ] {
            assert_eq!(texts(concern), expected, "{concern:?}");
        }
    }
}
