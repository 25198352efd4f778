//! File formats, figures and bearing geometry; each foreign crate is used by one module only.

pub mod csv;
pub mod exchange;
pub mod export;
pub mod figures;
pub mod film_tables;
pub mod gltf;
pub mod hdf5;
pub mod identified;
pub mod inflate;
pub mod json;
pub mod mat;
pub mod measured;
pub mod mesh;
pub mod model_file;
pub mod npy;
pub mod parry;
pub mod plot;
pub mod rapier;
pub mod results_file;
pub mod scene;
pub mod side_file;
pub mod uff;
pub mod vtk;
pub mod wav;
