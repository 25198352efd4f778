//! Theorems that hold for any machine, on random ones.

#[path = "../common/machine.rs"]
mod machine;

mod linear;
mod planes;
