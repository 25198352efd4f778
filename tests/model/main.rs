//! Model files: what they say arrives in the model.

mod files;
