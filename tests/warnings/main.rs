//! Warnings: plausible machines have none, a spoiled copy has exactly its own, and random machines have those whose
//! criterion holds.

mod copies;
mod dropouts;
mod every_code;
mod machines;
mod measured_codes;
mod plausible;
mod program;
mod random;
mod spoiled;
mod study_codes;
mod tacho;
mod unusual;

use rotordyn::model::{self, Diagnostic, Options};
use rotordyn::study::Machine;
use rotordyn::warning::Warning;
use std::collections::BTreeSet;

/// Warnings of a model's text in its input, at standstill and at top speed, and of its linear studies.
fn warnings_of(text: &str) -> Vec<Warning> {
    let loaded =
        model::load("machine.toml", text, &Options::default()).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let mut found: Vec<Warning> = loaded.warnings.iter().filter_map(Diagnostic::to_warning).collect();
    let machine = Machine::new(loaded.model).unwrap();
    let studies = &machine.model.studies;
    let results = rotordyn::results::Results {
        modal: studies.modal.as_ref().map(|study| machine.modal(study).unwrap()).unwrap_or_default(),
        unbalance: studies.unbalance.as_ref().map(|study| machine.unbalance(study).unwrap()),
        frf: studies.frf.as_ref().map(|study| machine.frf(study).unwrap()),
        ..Default::default()
    };
    found.extend(machine.warnings(&results, &[machine.model.profile.top_speed()]));
    found
}

/// Names of their codes, once each.
fn codes(warnings: &[Warning]) -> BTreeSet<&'static str> {
    warnings.iter().map(|warning| warning.code.name()).collect()
}
