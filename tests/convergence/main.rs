//! Fitted orders of convergence.

#[path = "../common/machine.rs"]
#[allow(dead_code)]
mod machine;
#[path = "../common/ross.rs"]
#[allow(dead_code)]
mod ross;

mod shaft_element;
