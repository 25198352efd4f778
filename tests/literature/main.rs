//! Published figures; the file's name is its source.

#[path = "../common/ross.rs"]
mod ross;

mod ross_critical;
mod ross_elements;
mod ross_modes;
mod ross_responses;
