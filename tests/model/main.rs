//! Model files: what they say arrives in the model.

mod catalogue;
mod files;
mod rig;
mod syntax;
