//! Closed forms.

#[path = "../common/bearing.rs"]
mod bearing;

mod hertz;
