//! `bearing --motion`: the settled motion of bearings with free balls, for 3D viewers and ParaView.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use rotordyn::io::export_3d::export_motion;
use rotordyn::model::Model;
use rotordyn::results::BearingResult;
use rotordyn::study::bearing_motion;
use rotordyn::units::names::file_names;

use super::failure::Failure;
use super::terminal::Terminal;

/// Writes the motion of every bearing that has settled; returns the files.
pub fn export(
    found: &[BearingResult],
    model: Option<&Model>,
    turns: u64,
    folder: &Path,
    terminal: &Terminal,
) -> Result<Vec<PathBuf>, Failure> {
    let spinner = terminal.spinner("motion");
    let mut files = Vec::new();
    let settled: Vec<_> = found.iter().filter_map(|found| found.free_balls.as_ref()).collect();
    let folders = file_names(settled.iter().map(|settled| settled.name.as_str()));
    for ((settled, name), model) in settled.iter().zip(folders).zip(std::iter::repeat(model).flatten()) {
        let motion = bearing_motion(model, settled, turns as usize);
        let motion = motion.map_err(|error| Failure::Input(error.to_string()))?;
        let Some((bearing, motion)) = motion else { continue };
        // A turn of the shaft a second.
        let slow_motion = (settled.speed.abs() / TAU).max(1.0);
        let folder = folder.join(format!("motion_{name}"));
        files.extend(export_motion(&motion, &bearing, slow_motion, &folder)?);
    }
    spinner.finish_and_clear();
    if files.is_empty() {
        return Err(Failure::Input(
            "--motion needs a bearing with model = \"free_ball\" that settles".into(),
        ));
    }
    Ok(files)
}
