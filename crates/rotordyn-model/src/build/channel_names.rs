//! Names of probes against those of the channels that every run records.

use super::loading;
use crate::Model;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::Reader;
use rotordyn_core::model::run_channels::automatic_channels;

/// Refuses probes whose name a run needs for a channel of its own.
pub(super) fn check(top: &Reader, model: &Model) {
    let automatic = automatic_channels(model);
    for probe in &model.probes {
        let Some((name, of)) = automatic.iter().find(|(name, _)| *name == probe.name) else { continue };
        let span = top.item(&loading::TOP.probe, name).map_or(0..0, |r| r.span);
        let message = format!("probe.{name} has the name of the automatic channel `{name}` of {of}");
        let problem = Problem::new(Kind::Conflict, &span, message);
        top.log.error(problem.hint("choose another name for the probe: every run-up records that channel"));
    }
}
