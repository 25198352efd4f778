//! File formats, read and written; each external crate is used by one module only.

pub mod error;

pub mod animated_scene;
pub mod atomic_file;
pub mod budget;
pub mod checkpoint_file;
pub mod csv;
pub mod document_tables;
pub mod export_3d;
pub mod external_file;
pub mod film_table_cache;
pub mod gltf;
#[cfg(feature = "hdf5")]
pub mod hdf5;
pub mod identified_modes;
pub mod inflate;
pub mod json;
pub mod machine_records;
pub mod mat;
pub mod measured;
pub mod model_file_edit;
pub mod npy;
pub mod operational_modes;
#[cfg(feature = "hdf5")]
pub mod results_file;
pub mod ross;
pub mod run_export;
pub mod run_identity;
pub mod saved_results;
pub mod spill;
pub mod uff;
pub mod vtk;
mod vtk_machine;
mod vtk_motion;
pub mod wav;
