//! Model files: their content is read into the model.

mod bearing_file;
mod bearing_keys;
mod catalogue;
mod declared_keys;
mod defaults;
mod files;
mod imperfections;
mod key_contexts;
mod papers;
mod renamed;
mod rig;
mod run_analyses;
mod schema;
mod syntax;
