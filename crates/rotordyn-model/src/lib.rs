//! The model file: read, validated with all problems at once, and built into a [`Model`] in SI units.
//!
//! The types of the machine and its studies are those of `rotordyn_core::model`, all of them found here too.

pub mod build;
pub mod file;
pub mod keys;
pub mod load;
pub mod parameter_paths;
pub mod schema;
mod written_out;

pub use build::catalogue;
pub use file::renamed::renamed_path;
pub use file::{DefaultValue, Diagnostic, GivenValue, Kind, ModelErrors, Source};
pub use load::{
    Loaded, LoadedBearings, Options, external_files, has_bearings_only, item_span, load, load_bearings,
    load_bearings_with, load_with, variants,
};
pub use rotordyn_core::model::*;
pub use written_out::written_out;
