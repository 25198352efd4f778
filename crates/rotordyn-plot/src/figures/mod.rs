//! All figures of the results, by file name.
//!
//! | name | content |
//! |---|---|
//! | `machine_layout` | layout of the machine, side view |
//! | `static_deflection`, `ball_loads` | static equilibrium |
//! | `modes_<speed>rpm`, `campbell` | mode shapes, Campbell diagram |
//! | `frf_<excitation>` | frequency response functions (Bode plots), rotations separately (`_rotation`) |
//! | `unbalance_bode_<quantity>`, `unbalance_polar_<quantity>`, `unbalance_orbits` | synchronous unbalance response: Bode plot, polar (Nyquist) plot, orbits |
//! | `run_up_<channel>`, `run_up_bearing_<bearing>`, `run_up_energy` | time histories of the run-up |
//! | `run_up_bearing_<bearing>_cage`, `..._cage_orbit` | run-up with free balls: cage speed, slip, pocket force, friction torque; orbit of the cage |
//! | `spectrogram_<channel>`, `waterfall_<channel>` | spectra over speed with the linear Campbell lines |
//! | `orders_<channel>`, `order_cuts_<channel>` | order tracking: order map, order cuts with their range over the cage phases |
//! | `poincare_orbits`, `poincare_sections`, `lyapunov`, `bifurcation_<channel>` | steady motion at constant speed |
//! | `bearing_<bearing>_ball_loads`, `..._contact_angles` | bearing analysis at the operating point |
//! | `bearing_<bearing>_stiffness_over_<sweep>`, `..._displacement_...`, `..._contacts_...` | sweeps over load, displacement, speed, cage angle |
//! | `bearing_<bearing>_cage_speed`, `..._spin_axes`, `..._cage_orbit`, `..._skidding` | bearing with free balls and cage |
//! | `signal_<what>_<channel>` | signal analysis of a record: spectra, envelope with bearing lines, kurtogram, orders, jerk ... |
//! | `stabilisation`, `auto_mac`, `frf_fit_...`, `mode_shapes` | experimental modal analysis of FRFs |
//! | `validation_mac`, `validation_frequencies`, `validation_frf_...`, `validation_frac`, `validation_fdac` | correlation of model and measurement; `update_...` before and after |
//! | `run_up_spectrogram_<channel>`, `run_up_waterfall_<channel>`, `run_up_order_cuts_<channel>` | measured and computed run-up |
//! | `<section>_<quantity>` | quantities that the results' documents mark as drawn, over their axis |
//! | `comparison_frf_...`, `comparison_campbell` | model variants on common axes |

mod bearing;
mod campbell;
mod comparison;
mod display_unit;
mod drawn;
mod free_ball;
pub mod identification;
mod machine;
mod named;
mod response;
mod run;
mod run_free_ball;
mod run_up_correlation;
mod signal;
mod signal_orders;
mod signal_units;
mod steady;
mod validation;

use named::{Named, TO_RPM};
pub use validation::Stage;

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::FigureError;
use crate::{self as plot, Figure};
use rotordyn_core::document::Section;
use rotordyn_core::results::{BearingResult, CampbellResult, ChannelPair, SignalResult};
use rotordyn_core::study::{Machine, Results};
use rotordyn_core::warning::Warning;
use rotordyn_update::target::Target;

/// Draws all figures of the available results as `<name>.svg` and `<name>.png`; returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw(results: &Results, machine: &Machine, folder: &Path) -> Result<Vec<PathBuf>, FigureError> {
    write_all(&all(results, machine), &results.warnings, folder)
}

/// All figures of the available results with their file names (without extension).
pub fn all(results: &Results, machine: &Machine) -> Vec<(String, Figure)> {
    let mut figures = vec![machine::layout(machine)];
    figures.extend(results.equilibrium.iter().flat_map(|found| machine::equilibrium(found, machine)));
    figures.extend(results.modal.iter().map(|found| machine::modes(found, machine)));
    figures.extend(results.campbell.iter().map(|found| campbell::campbell(found, machine)));
    figures.extend(results.frf.iter().flat_map(|found| response::frf(found, machine)));
    let criticals = response::criticals(results);
    figures
        .extend(results.unbalance.iter().flat_map(|found| response::unbalance(found, &criticals, machine)));
    figures.extend(results.run_up.iter().flat_map(|found| run::histories(&found.history, machine)));
    figures.extend(results.run_up.iter().flat_map(|found| run_free_ball::figures(&found.history, machine)));
    let campbell = results.campbell.as_ref();
    figures.extend(results.spectrograms.iter().flat_map(|found| run::spectrogram(found, campbell, machine)));
    figures.extend(
        results.orders.iter().flat_map(|found| run::orders(found, results.cage_phases.as_ref(), machine)),
    );
    figures.extend(results.poincare.iter().flat_map(|found| steady::poincare(found, machine)));
    figures.extend(results.lyapunov.iter().map(|found| steady::lyapunov(found, machine)));
    figures.extend(results.bifurcation.iter().flat_map(|found| steady::bifurcation(found, machine)));
    figures.extend(bearings(&results.bearings, &machine.model.title));
    figures.extend(drawn::figures(&results.sections(&machine.assembly.dofs), &machine.model.title));
    figures
}

/// Draws the quantities that documents mark as drawn; `note` stands below the titles. Returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_marked(sections: &[Section], note: &str, folder: &Path) -> Result<Vec<PathBuf>, FigureError> {
    write_all(&drawn::figures(sections, note), &[], folder)
}

/// Draws all figures of ball bearing analyses; returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_bearings(
    found: &[BearingResult],
    title: &str,
    folder: &Path,
) -> Result<Vec<PathBuf>, FigureError> {
    let warnings: Vec<Warning> = found.iter().flat_map(|found| found.warnings.clone()).collect();
    write_all(&bearings(found, title).collect::<Vec<_>>(), &warnings, folder)
}

/// Draws all figures of analysed records; `title` is the name of their file. Returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_signal(found: &[SignalResult], title: &str, folder: &Path) -> Result<Vec<PathBuf>, FigureError> {
    let mut figures: Vec<Named> = found.iter().flat_map(|r| signal::figures(r, title)).collect();
    let sections: Vec<Section> = found.iter().map(SignalResult::section).collect();
    figures.extend(drawn::figures(&sections, title));
    write_all(&figures, &[], folder)
}

/// Draws the envelope spectra of two records, each with the title of its file, in panels one below the other.
///
/// # Errors
/// A file cannot be written.
pub fn draw_envelope_comparison(
    of: [(&SignalResult, &str); 2],
    folder: &Path,
) -> Result<Vec<PathBuf>, FigureError> {
    write_all(&signal::envelope_comparison(of).into_iter().collect::<Vec<_>>(), &[], folder)
}

fn bearings(found: &[BearingResult], title: &str) -> impl Iterator<Item = Named> {
    found.iter().flat_map(|found| {
        let free = found.free_balls.iter().flat_map(|free| free_ball::figures(free, title));
        let skidding = found.skidding.iter().map(|map| free_ball::skidding(map, title));
        bearing::figures(found, title).into_iter().chain(free).chain(skidding)
    })
}

/// Draws the FRFs and Campbell diagrams of several variants of a model on common axes; returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_comparison(variants: &[(String, &Results)], folder: &Path) -> Result<Vec<PathBuf>, FigureError> {
    write_all(&comparison::figures(variants), &[], folder)
}

/// Draws the comparison of a measurement with stages of a model; file names start with `prefix`. Returns the
/// SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_validation(
    prefix: &str,
    title: &str,
    target: &Target,
    stages: &[Stage],
    folder: &Path,
) -> Result<Vec<PathBuf>, FigureError> {
    write_all(&validation::figures(prefix, title, target, stages), &[], folder)
}

/// Draws a measured and a computed run-up; file names start with `prefix`. Returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_run_up_correlation(
    prefix: &str,
    pairs: &[ChannelPair],
    campbell: Option<&CampbellResult>,
    machine: &Machine,
    folder: &Path,
) -> Result<Vec<PathBuf>, FigureError> {
    write_all(&run_up_correlation::figures(prefix, pairs, campbell, machine), &[], folder)
}

fn write_all(figures: &[Named], warnings: &[Warning], folder: &Path) -> Result<Vec<PathBuf>, FigureError> {
    std::fs::create_dir_all(folder).map_err(FigureError::of_file("create folder", folder))?;
    let stems: Vec<String> = figures.iter().map(|(name, _)| rotordyn_units::names::file_name(name)).collect();
    figures
        .par_iter()
        .zip(&stems)
        .try_for_each(|((_, figure), stem)| plot::write(figure, warnings, &folder.join(stem)))?;
    Ok(stems.iter().map(|stem| folder.join(format!("{stem}.svg"))).collect())
}
