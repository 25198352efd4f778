//! Published figures; the file's name is its source.

#[path = "../common/ross.rs"]
mod ross;

mod ross_elements;
mod ross_modes;
