//! A model file with one of its variants, as `check` and `bearing` read it, up to the assembled machine.

use std::path::Path;

use rotordyn::assembly::rigid_body_modes::rigid_body_modes_of_machine;
use rotordyn::bearing::contact::ContactLaw;
use rotordyn::geometry::BearingShapes;
use rotordyn::model::{self, Diagnostic, ExternalColumn, ExternalFile, Model, ModelErrors, Options, Source};
use rotordyn::study::Machine;

use crate::outcome::Outcome;

/// Largest machine that is assembled: a valid one of any size is no finding, and `check` tells its size.
const MAX_NODES: usize = 40;
const MAX_BALLS: usize = 30;

/// One valid machine of this number is assembled, which takes ten to a hundred times as long as reading it.
const ASSEMBLED_SHARE: u32 = 16;

/// One file of this number is also read as one of bearings alone.
const BEARINGS_SHARE: u32 = 4;

/// Overlap of ball and race that the command line allows, over the ball diameter.
const MAX_BALL_RACE_OVERLAP: f64 = 5e-3;

pub fn run(bytes: &[u8], _: &Path) -> Outcome {
    // Which variant is read, if any, follows from the bytes: an input always does the same.
    let choice = crc32fast::hash(bytes);
    let mut variants = std::str::from_utf8(bytes).map(model::variants).unwrap_or_default();
    let place = choice as usize % (variants.len() + 1);
    let variant = (place < variants.len()).then(|| variants.swap_remove(place));
    let outcome = load(bytes, &Options { variant, ..Options::default() });
    if choice.is_multiple_of(BEARINGS_SHARE) {
        return outcome.and(load_bearings(bytes, &Options::default()));
    }
    outcome
}

/// Reads a model with its options, and assembles its machine if it is small.
pub fn load(bytes: &[u8], options: &Options) -> Outcome {
    let files = side_files(bytes, options);
    match model::load_with("model.toml", bytes, options, &files) {
        Err(errors) => refused(&errors),
        Ok(loaded) => {
            let found = || loaded.warnings.iter().chain(&loaded.hints);
            check_spans(found(), &loaded.sources);
            let mut outcome = Outcome::accepted("model");
            outcome.messages.extend(found().map(|d| d.message.clone()));
            if (crc32fast::hash(bytes) / BEARINGS_SHARE).is_multiple_of(ASSEMBLED_SHARE)
                && is_small(&loaded.model)
            {
                assemble(loaded.model, &mut outcome);
            }
            outcome
        }
    }
}

fn load_bearings(bytes: &[u8], options: &Options) -> Outcome {
    match model::load_bearings_with("model.toml", bytes, options, &side_files(bytes, options)) {
        Err(errors) => refused(&errors),
        Ok(loaded) => {
            check_spans(loaded.warnings.iter().chain(&loaded.hints), &loaded.sources);
            for (_, ball) in &loaded.bearings {
                if ball.geometry.balls <= MAX_BALLS {
                    let shapes = BearingShapes::new(&ball.geometry, ball.cage_pocket_diameter);
                    let allowed = MAX_BALL_RACE_OVERLAP * ball.geometry.ball_diameter;
                    shapes.overlaps(&shapes.centred(ball.cage_angle), allowed);
                }
            }
            Outcome::accepted("bearings")
        }
    }
}

fn refused(errors: &ModelErrors) -> Outcome {
    check_spans(errors.diagnostics.iter(), &errors.sources);
    assert!(!errors.diagnostics.is_empty(), "refused without a reason");
    Outcome { accepted: false, messages: errors.diagnostics.iter().map(|d| d.message.clone()).collect() }
}

/// Every message refers to a part of its text, or it cannot be printed.
fn check_spans<'d>(diagnostics: impl Iterator<Item = &'d Diagnostic>, sources: &[Source]) {
    for found in diagnostics {
        let text = &sources[found.source].text;
        assert!(text.get(found.span.clone()).is_some(), "{found:?} is outside its text");
    }
}

/// The side files that the model names: a measured speed over time, whatever the name.
fn side_files(bytes: &[u8], options: &Options) -> Vec<ExternalFile> {
    // Reading the whole text once more for its side files takes as long as the first time.
    let mut set = options.set.iter().flat_map(|(path, value)| [path, value]);
    if !bytes.windows(4).any(|word| word == b"file") && !set.any(|text| text.contains("file")) {
        return Vec::new();
    }
    let column = |name: &str, unit: &str, values: [f64; 4]| ExternalColumn {
        name: name.into(),
        unit: unit.into(),
        values: values.to_vec(),
    };
    let content = || {
        let time = column("time", "s", [0.0, 1.0, 2.0, 3.0]);
        Ok(vec![time, column("speed", "rpm", [0.0, 300.0, 610.0, 900.0])])
    };
    let paths = model::external_files(bytes, options).into_iter();
    paths.map(|path| ExternalFile { path, content: content() }).collect()
}

fn is_small(model: &Model) -> bool {
    let small = |site: &model::BearingSite| match site.bearing.ball() {
        // A film needs its tables, which take minutes.
        Some(ball) => ball.geometry.balls <= MAX_BALLS && !matches!(ball.contact, ContactLaw::Ehl(_)),
        None => true,
    };
    model.node_count() <= MAX_NODES && model.bearings.iter().all(small)
}

fn assemble(model: Model, outcome: &mut Outcome) {
    let Some(machine) = outcome.after("machine", Machine::new(model)) else { return };
    let free = rigid_body_modes_of_machine(&machine.model, &machine.assembly);
    if let Some(free) = outcome.after("rigid-body modes", free) {
        outcome.messages.push(format!("{} rigid-body modes", free.len()));
    }
    let warnings = machine.support_warnings(&[0.0, machine.model.profile.top_speed()]);
    outcome.messages.extend(warnings.iter().map(ToString::to_string));
}
