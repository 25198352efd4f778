//! All figures of the results, by file name.
//!
//! | name | content |
//! |---|---|
//! | `machine_layout` | layout of the machine, side view |
//! | `static_deflection`, `ball_loads` | static equilibrium |
//! | `static_shaft_loads`, `unbalance_shaft_loads_<speed>rpm` | deflection, shear force and bending moment along the shaft |
//! | `modes_<speed>rpm`, `campbell`, `stability` | mode shapes, Campbell diagram, log decrement over speed |
//! | `critical_map` | undamped critical speeds over bearing stiffness |
//! | `torsional_interference`, `torsional_modes` | torsional natural frequencies with order lines, twist along the shaft |
//! | `frf_<excitation>` | frequency response functions (Bode plots), rotations separately (`_rotation`) |
//! | `unbalance_bode_<quantity>`, `unbalance_polar_<quantity>`, `unbalance_orbits` | synchronous unbalance response: Bode plot, polar (Nyquist) plot, orbits |
//! | `unbalance_bearing_forces` | dynamic force of every bearing over speed, with its static force |
//! | `run_up_<channel>`, `run_up_bearing_<bearing>`, `run_up_energy` | time histories of the run-up |
//! | `run_up_bearing_<bearing>_cage`, `..._cage_orbit` | run-up with free balls: cage speed, slip, pocket force, friction torque; orbit of the cage |
//! | `spectrogram_<channel>`, `waterfall_<channel>` | spectra over speed with the linear Campbell lines |
//! | `orders_<channel>`, `order_cuts_<channel>`, `order_tracks_<channel>` | order tracking: order map, order cuts with their range over the cage phases, amplitude and phase by the Vold-Kalman filter |
//! | `poincare_orbits`, `poincare_sections`, `lyapunov`, `bifurcation_<channel>` | steady motion at constant speed |
//! | `bearing_<bearing>_sheet` | bearing on one page: load distribution, contact angles, stiffness, contacts and friction over load and speed |
//! | `bearing_<bearing>_ball_loads`, `..._contact_angles` | bearing analysis at the operating point |
//! | `bearing_<bearing>_stiffness_over_<sweep>`, `..._displacement_...`, `..._contacts_...` | sweeps over load, displacement, speed, cage angle |
//! | `bearing_<bearing>_cage_speed`, `..._spin_axes`, `..._cage_orbit`, `..._skidding` | bearing with free balls and cage |
//! | `signal_<what>_<channel>` | signal analysis of a record: spectra, envelope with bearing lines, kurtogram, orders, jerk ... |
//! | `stabilisation`, `auto_mac`, `frf_fit_...`, `mode_shapes` | experimental modal analysis of FRFs |
//! | `validation_mac`, `validation_frequencies`, `validation_frf_...`, `validation_frac`, `validation_fdac` | correlation of model and measurement; `update_...` before and after |
//! | `update_profile_<parameter>` | profile likelihood of a parameter of an update |
//! | `run_up_spectrogram_<channel>`, `run_up_waterfall_<channel>`, `run_up_order_cuts_<channel>` | measured and computed run-up |
//! | `<section>_<quantity>` | quantities that the results' documents mark as drawn, over their axis |
//! | `comparison_frf_...`, `comparison_unbalance_...`, `comparison_campbell` | cases of a model on common axes, with measured FRFs |
//! | `comparison_spectrogram_<channel>`, `comparison_waterfall_<channel>`, `comparison_order_cuts_<channel>` | run-ups of cases side by side, with a measured one |

mod bearing;
mod bearing_sheet;
mod campbell;
mod comparison;
mod concern;
mod display_unit;
mod drawn;
mod folder;
mod free_ball;
mod geometry_lines;
pub mod identification;
mod machine;
mod named;
mod order_tracks;
mod response;
mod rotor_maps;
mod run;
mod run_free_ball;
mod run_up_comparison;
mod run_up_correlation;
mod shaft_loads;
mod signal;
mod signal_orders;
mod signal_units;
mod steady;
mod trend;
mod update_profile;
mod validation;

pub use comparison::LinearComparison;
use concern::Concern;
pub use folder::FigureFolder;
pub use machine::layout;
use named::TO_RPM;
pub use named::{Named, WithWarnings};
pub use validation::Stage;

use std::path::PathBuf;

use rayon::prelude::*;

use crate::FigureError;
use crate::{self as plot, Figure};
use rotordyn_core::document::Section;
use rotordyn_core::model::BearingSite;
use rotordyn_core::results::{
    BearingResult, CampbellResult, ChannelPair, RunUpComparison, SignalResult, TrendResult,
};
use rotordyn_core::study::{Machine, Results};
use rotordyn_update::Update;
use rotordyn_update::parameter::FreeParameter;
use rotordyn_update::profile::Profile;
use rotordyn_update::target::Target;

/// Draws all figures of the available results as `<name>.svg` and `<name>.png`; returns the SVG files.
///
/// # Errors
/// A file cannot be written, or stored numbers cannot be read.
pub fn draw<'a>(
    results: &Results,
    machine: &Machine,
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_all(&all_with_warnings(results, machine)?, folder)
}

/// All figures of the available results with their file names (without extension).
///
/// Samples, spectrograms and order maps stay where they are stored until a figure is written.
///
/// # Errors
/// Stored numbers cannot be read.
pub fn all(results: &Results, machine: &Machine) -> Result<Vec<(String, Figure)>, FigureError> {
    Ok(with_concerns(results, machine)?.into_iter().map(|(_, named)| named).collect())
}

/// All figures, each with the warnings that concern what it shows.
///
/// # Errors
/// As [`all`].
pub fn all_with_warnings(results: &Results, machine: &Machine) -> Result<Vec<WithWarnings>, FigureError> {
    let warned = |(concern, named): (Concern, Named)| (named, concern.select(&results.warnings));
    Ok(with_concerns(results, machine)?.into_iter().map(warned).collect())
}

/// All figures, each with what it shows.
fn with_concerns<'a>(
    results: &'a Results,
    machine: &'a Machine,
) -> Result<Vec<(Concern<'a>, Named)>, FigureError> {
    let mut out = vec![(Concern::of(&[]), machine::layout(machine))];
    let mut add = |studies: &'static [&'static str], figures: Vec<Named>| {
        out.extend(figures.into_iter().map(|named| (Concern::of(studies), named)));
    };
    let equilibrium = results.equilibrium.iter().flat_map(|found| machine::equilibrium(found, machine));
    add(&["static"], equilibrium.collect());
    let loaded = results.equilibrium.iter().filter_map(|found| shaft_loads::at_rest(found, machine));
    add(&["static"], loaded.collect());
    add(&["modal"], results.modal.iter().map(|found| machine::modes(found, machine)).collect());
    add(&["campbell"], results.campbell.iter().map(|found| campbell::campbell(found, machine)).collect());
    let stability = results.campbell.iter().filter_map(|found| rotor_maps::stability(found, machine));
    add(&["campbell"], stability.collect());
    let map = results.critical_map.iter().filter_map(|found| rotor_maps::critical_map(found, machine));
    add(&["critical_map"], map.collect());
    let torsional = results.torsional.iter().flat_map(|found| rotor_maps::torsional(found, machine));
    add(&["torsional"], torsional.collect());
    add(&["frf"], results.frf.iter().flat_map(|found| response::frf(found, machine)).collect());
    let criticals = response::criticals(results);
    let unbalance =
        results.unbalance.iter().flat_map(|found| response::unbalance(found, &criticals, machine));
    add(&["unbalance"], unbalance.collect());
    let loaded = results.unbalance.iter().flat_map(|found| shaft_loads::under_unbalance(found, machine));
    add(&["unbalance"], loaded.collect());
    if let Some(found) = &results.run_up {
        add(&["run_up"], run::histories(&found.history, machine));
        add(&["run_up"], run_free_ball::figures(&found.history, machine)?);
    }
    let campbell = results.campbell.as_ref();
    for found in &results.spectrograms {
        add(&["run_up", "spectrogram"], run::spectrogram(found, campbell, machine)?);
    }
    let cage_phases = results.cage_phases.as_ref();
    let orders = results.orders.iter().flat_map(|found| run::orders(found, cage_phases, machine));
    add(&["run_up", "orders"], orders.collect());
    let poincare = results.poincare.iter().flat_map(|found| steady::poincare(found, machine));
    add(&["poincare"], poincare.collect());
    add(&["lyapunov"], results.lyapunov.iter().map(|found| steady::lyapunov(found, machine)).collect());
    let bifurcation = results.bifurcation.iter().flat_map(|found| steady::bifurcation(found, machine));
    add(&["bifurcation"], bifurcation.collect());
    for found in &results.bearings {
        let concern = Concern::of(&["bearing"]).of_bearing(&found.name);
        out.extend(bearing_figures(found, &machine.model.title).map(|named| (concern, named)));
    }
    for section in results.sections(&machine.assembly.dofs) {
        let concern = Concern::of(studies_of_section(section.json));
        let drawn = drawn::figures(std::slice::from_ref(&section), &machine.model.title);
        out.extend(drawn.into_iter().map(|named| (concern, named)));
    }
    // A history of the forces in one bearing shows that bearing.
    for (concern, (name, _)) in &mut out {
        let of = |bearing: &&BearingSite| {
            let stem = name.strip_prefix("run_up_bearing_").and_then(|rest| rest.strip_prefix(&bearing.name));
            stem.is_some_and(|rest| rest.is_empty() || rest.starts_with("_cage"))
        };
        if let Some(site) = machine.model.bearings.iter().find(of) {
            *concern = concern.of_bearing(&site.name);
        }
    }
    Ok(out)
}

/// Studies, as in the model file, of a section of the results.
fn studies_of_section(section: &str) -> &'static [&'static str] {
    match section {
        "equilibrium" => &["static"],
        "modal" => &["modal"],
        "campbell" => &["campbell"],
        "critical_speeds" => &["critical"],
        "critical_map" => &["critical_map"],
        "torsional" => &["torsional"],
        "frf" => &["frf"],
        "unbalance" => &["unbalance"],
        "run_up" => &["run_up"],
        "cage_phases" | "orders" => &["run_up", "orders"],
        "spectrograms" => &["run_up", "spectrogram"],
        "poincare" => &["poincare"],
        "lyapunov" => &["lyapunov"],
        "bifurcation" => &["bifurcation"],
        "bearings" => &["bearing"],
        _ => &[],
    }
}

/// Draws the quantities that documents mark as drawn; `note` stands below the titles. Returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_marked<'a>(
    sections: &[Section],
    note: &str,
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_plain(drawn::figures(sections, note), folder)
}

/// Draws all figures of analysed records; `title` is the name of their file. Returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_signal<'a>(
    found: &[SignalResult],
    title: &str,
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_plain(of_signal(found, title), folder)
}

/// All figures of analysed records; `title` is the name of their file.
pub fn of_signal(found: &[SignalResult], title: &str) -> Vec<Named> {
    let mut figures: Vec<Named> = found.iter().flat_map(|r| signal::figures(r, title)).collect();
    let sections: Vec<Section> = found.iter().map(SignalResult::section).collect();
    figures.extend(drawn::figures(&sections, title));
    figures
}

/// Draws several records of one machine over their axis; `title`: what they are of. Returns the SVG file.
///
/// # Errors
/// The file cannot be written.
pub fn draw_trend<'a>(
    found: &TrendResult,
    title: &str,
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_plain(vec![trend::figure(found, title)], folder)
}

/// Draws the envelope spectra of two records, each with the title of its file, in panels one below the other.
///
/// # Errors
/// A file cannot be written.
pub fn draw_envelope_comparison<'a>(
    of: [(&SignalResult, &str); 2],
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_plain(signal::envelope_comparison(of).into_iter().collect::<Vec<_>>(), folder)
}

/// All figures of ball bearing analyses, each with the warnings of its bearing.
pub fn of_bearings(found: &[BearingResult], title: &str) -> Vec<WithWarnings> {
    let of = |found: &BearingResult| {
        bearing_figures(found, title).map(|named| (named, found.warnings.clone())).collect::<Vec<_>>()
    };
    found.iter().flat_map(of).collect()
}

fn bearing_figures(found: &BearingResult, title: &str) -> impl Iterator<Item = Named> {
    let free = found.free_balls.iter().flat_map(|free| free_ball::figures(free, title));
    let skidding = found.skidding.iter().map(|map| free_ball::skidding(map, title));
    let sheet = bearing_sheet::figure(found, title);
    std::iter::once(sheet).chain(bearing::figures(found, title)).chain(free).chain(skidding)
}

/// The page of a ball bearing for its designer, `bearing_<bearing>_sheet`.
pub fn bearing_sheet(found: &BearingResult, title: &str) -> Figure {
    bearing_sheet::figure(found, title).1
}

/// Draws FRFs, unbalance responses and Campbell diagrams of several cases of a model on common axes; returns the SVG
/// files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_comparison<'a>(
    compared: LinearComparison,
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_plain(comparison::figures(compared), folder)
}

/// Draws run-ups of several cases, with the linear natural frequencies of each; returns the SVG files.
///
/// # Errors
/// A file cannot be written, or stored numbers cannot be read.
pub fn draw_run_up_comparison<'a>(
    found: &RunUpComparison,
    campbell: &[Option<&CampbellResult>],
    machine: &Machine,
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_plain(run_up_comparison::figures(found, campbell, machine)?, folder)
}

/// Draws the comparison of a measurement with stages of a model; file names start with `prefix`. Returns the
/// SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_validation<'a>(
    prefix: &str,
    title: &str,
    target: &Target,
    stages: &[Stage],
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_plain(of_validation(prefix, title, target, stages), folder)
}

/// All figures of the comparison of a measurement with stages of a model; their names start with `prefix`.
pub fn of_validation(prefix: &str, title: &str, target: &Target, stages: &[Stage]) -> Vec<Named> {
    validation::figures(prefix, title, target, stages)
}

/// The figures of the profiles of the parameters of an update.
pub fn of_update_profiles(
    title: &str,
    found: &Update,
    parameters: &[FreeParameter],
    profiles: &[Profile],
) -> Vec<Named> {
    update_profile::figures(title, found, parameters, profiles)
}

/// Draws a measured and a computed run-up; file names start with `prefix`. Returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn draw_run_up_correlation<'a>(
    prefix: &str,
    pairs: &[ChannelPair],
    campbell: Option<&CampbellResult>,
    machine: &Machine,
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_plain(run_up_correlation::figures(prefix, pairs, campbell, machine)?, folder)
}

/// Writes figures without warnings.
fn write_plain<'a>(
    figures: Vec<Named>,
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    write_all(&figures.into_iter().map(|named| (named, Vec::new())).collect::<Vec<_>>(), folder)
}

/// Names of the files of figures, SVG and PNG.
pub fn file_names(figures: &[WithWarnings]) -> Vec<String> {
    stems(figures)
        .iter()
        .flat_map(|stem| [".svg", ".png"].map(|extension| format!("{stem}{extension}")))
        .collect()
}

/// Names of figures as files: none twice in a folder.
fn stems(figures: &[WithWarnings]) -> Vec<String> {
    rotordyn_units::names::file_names(figures.iter().map(|((name, _), _)| name.as_str()))
}

/// Writes figures, each with its warnings below it; returns the SVG files.
///
/// # Errors
/// A file cannot be written.
pub fn write_all<'a>(
    figures: &[WithWarnings],
    folder: impl Into<FigureFolder<'a>>,
) -> Result<Vec<PathBuf>, FigureError> {
    let FigureFolder { path: folder, identity } = folder.into();
    std::fs::create_dir_all(folder).map_err(FigureError::of_file("create folder", folder))?;
    let stems = stems(figures);
    figures.par_iter().zip(&stems).try_for_each(|(((_, figure), warnings), stem)| {
        plot::write_of_run(figure, warnings, &folder.join(stem), identity)
    })?;
    Ok(stems.iter().map(|stem| folder.join(format!("{stem}.svg"))).collect())
}
