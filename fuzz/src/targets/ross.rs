//! A rotor that ROSS saved, as `import` reads it: what is written must be a model file, whatever its machine.

use std::path::Path;

use rotordyn::io::budget::Limits;
use rotordyn::io::ross::{self, ImportError};
use rotordyn::model::{self, Kind, ModelErrors, Options};

use crate::outcome::Outcome;

pub fn run(bytes: &[u8], folder: &Path) -> Outcome {
    let path = folder.join("rotor.toml");
    if let Err(error) = std::fs::write(&path, bytes) {
        return Outcome::refused(error);
    }
    let found = match ross::import(&path, "rotor", &Limits::default()) {
        Ok(found) => found,
        Err(ImportError::File(error)) => return Outcome::refused(error),
        Err(ImportError::Content(errors)) => {
            assert!(!errors.diagnostics.is_empty(), "refused without a reason");
            return refused(&errors);
        }
    };
    match model::load("machine.toml", &found.text, &Options::default()) {
        Ok(_) => {
            let mut outcome = Outcome::accepted("rotor");
            outcome.messages.extend(found.not_carried.iter().map(|lost| lost.why.clone()));
            outcome
        }
        Err(errors) => {
            let ours =
                [Kind::Syntax, Kind::UnknownKey, Kind::WrongDimension, Kind::MissingUnit, Kind::BadQuantity];
            let wrong = errors.diagnostics.iter().find(|d| ours.contains(&d.kind));
            assert!(wrong.is_none(), "{wrong:?} in\n{}", found.text);
            refused(&errors)
        }
    }
}

fn refused(errors: &ModelErrors) -> Outcome {
    for found in &errors.diagnostics {
        let text = &errors.sources[found.source].text;
        assert!(text.get(found.span.clone()).is_some(), "{found:?} is outside its text");
    }
    Outcome { accepted: false, messages: errors.diagnostics.iter().map(|d| d.message.clone()).collect() }
}
