//! rotordyn: a multibody rotor-bearing simulator with a flexible shaft.
//!
//! A model file describes a machine; modes, Campbell diagram, FRFs and nonlinear run-ups are computed from
//! it. The whole pipeline on a small rotor:
//!
//! ```
//! use rotordyn::model::{self, study};
//! use rotordyn::study::{Machine, Recorder};
//! use std::f64::consts::TAU;
//! use std::ops::ControlFlow;
//!
//! // A model file: units in the values, stations by name, all problems reported at once.
//! let text = r#"
//!     [model]
//!     name = "small_rotor"
//!     [material.steel]
//!     young = "207 GPa"
//!     poisson = 0.3
//!     density = "7850 kg/m^3"
//!     [shaft]
//!     element_length = "40 mm"
//!     section = [{ length = "400 mm", outer_diameter = "20 mm" }]
//!     [station]
//!     A = "20 mm"
//!     disc = "200 mm"
//!     B = "380 mm"
//!     [disc.main]
//!     station = "disc"
//!     outer_diameter = "160 mm"
//!     thickness = "20 mm"
//!     material = "steel"
//!     [bearing.A]
//!     station = "A"
//!     model = "ball"
//!     designation = "6204"
//!     [bearing.B]
//!     station = "B"
//!     model = "ball"
//!     designation = "6204"
//!     [unbalance.disc]
//!     station = "disc"
//!     magnitude = "50 g mm"
//!     [damping.modal]
//!     frequency = "50 Hz"
//!     ratio = 0.01
//!     [drive]
//!     kind = "prescribed"
//!     station = "A"
//!     [speed]
//!     profile = "ramp"
//!     ramp = "0.2 s"
//!     to = "1200 rpm"
//!     [probe.disc_y]
//!     at = "disc.main"
//!     direction = "y"
//!     [study.run_up]
//!     step = "100 us"
//!     sample_rate = "2 kHz"
//!     cutoff = "1500 Hz"
//! "#;
//! let model = model::load("small_rotor.toml", text, &Default::default())?.model;
//!
//! // Assembled, with the static equilibrium under gravity.
//! let machine = Machine::new(model)?;
//!
//! // Linearised about it: modes labelled by whirl and energy, and a Campbell diagram with MAC mode tracking.
//! let modes = machine.modal(&study::ModalStudy { speeds: vec![0.0, TAU * 20.0], modes: 6 })?;
//! let bending = modes[1].modes.iter().find(|m| m.label == "1st bending y");
//! assert!(bending.is_some_and(|m| m.frequency_hz() > 20.0));
//! let speeds = (0..5).map(|k| TAU * 5.0 * k as f64).collect();
//! let orders = vec![1.0];
//! let campbell =
//!     machine.campbell(&study::CampbellStudy { speeds, modes: 4, orders, speed_dependent_bearings: true })?;
//! assert_eq!(campbell.diagram.branches.len(), 4);
//!
//! // The nonlinear run-up: linear parts reduced by component mode synthesis, one Hertz contact per ball.
//! let settings = machine.model.studies.run_up.clone().expect("given in the file");
//! let reduction = machine.reduce(&settings)?;
//! let mut recorder = Recorder::new(&machine.model, &reduction.system, settings.sample_rate);
//! let report = machine.run_up(&settings, &reduction, |sample| {
//!     recorder.record(sample);
//!     ControlFlow::Continue(())
//! });
//! assert!(report.energy.residual().abs() < 1e-3 * report.energy.exchanged());
//!
//! // Order tracking of a recorded channel.
//! let orders = study::OrderStudy {
//!     channels: vec!["disc_y".into()],
//!     resolution: 0.5,
//!     max_order: 5.0,
//!     max_order_is_default: false,
//!     overlap: 0.5,
//!     window: study::WindowKind::Hann,
//!     cuts: vec![1.0],
//!     bandwidth: None,
//! };
//! let found = machine.orders(&orders, &recorder.history)?;
//! assert!(found[0].cuts[0].1.rms.iter().all(|level| level.is_finite()));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | contents |
//! |---|---|
//! | [`conventions`] | axes, order of DOFs, signs, symbols |
//! | [`series`] | numbers in memory or read from where they are stored |
//! | [`document`] | results as named quantities with units, for files and tables |
//! | [`units`], [`material`], [`names`] | quantities as text; material data; similar names, file names |
//! | [`linalg`] | sparse and banded matrices, eigenvalue problems |
//! | [`signal`] | spectra, STFT, order tracking, envelopes, bearing faults, orbits of sampled records |
//! | [`contact`] | Hertz contacts |
//! | [`element`] | shaft elements, discs, bodies, bushings, joints, belts |
//! | [`bearing`] | linear and ball bearings, healthy or with defects: force, tangent stiffness and damping |
//! | [`model`] | the model file, read and validated; the machine in SI |
//! | [`geometry`] | bearings and machine as solids: overlaps, multibody balls and cage, meshes, scenes |
//! | [`assembly`] | degrees of freedom, system matrices, eliminated joints, rigid-body modes |
//! | [`analysis`] | equilibrium, modes, Campbell, critical speeds, FRFs, unbalance, stability |
//! | [`transient`] | model reduction, time integration, energy balance |
//! | [`identify`] | experimental modal analysis: poles, shapes and residues from FRFs, with standard errors |
//! | [`update`] | model updating: mode pairing by MAC, sensitivities, least squares, identifiability |
//! | [`results`], [`study`] | results of the studies; the studies, one method of [`study::Machine`] each |
//! | [`error`] | the error that wraps those of all layers: input, physics, environment |
//! | [`io`] | file formats: HDF5, universal files, MATLAB, NumPy, CSV, WAV, JSON, VTK, glTF |
//! | [`plot`], [`figures`] | SVG and PNG charts; the figures of every study |
//! | [`report_page`] | the results of a run as one page |
//!
//! Imports go down this table only.

pub use rotordyn_bearing::{self as bearing, contact, material};
pub use rotordyn_core::{
    analysis, assembly, conventions, document, element, geometry, series, study, transient, warning,
};
pub use rotordyn_identify as identify;
pub use rotordyn_io::{self as io, error};
pub use rotordyn_linalg as linalg;
pub use rotordyn_model as model;
#[cfg(feature = "plot")]
pub use rotordyn_plot::{self as plot, figures};
#[cfg(feature = "plot")]
pub use rotordyn_report as report_page;
pub use rotordyn_signal as signal;
pub use rotordyn_units::{self as units, names};
pub use rotordyn_update as update;

/// Results of the studies, saved and loaded without loss by [`save`](results::save) and [`load`](results::load).
pub mod results {
    pub use rotordyn_core::results::*;
    pub use rotordyn_core::study::Results;
    pub use rotordyn_io::saved_results::{load, save};
}
