//! Balls and cage as free bodies: closed forms, balances, published and reference figures.

mod angular_contact;
mod balance;
mod bearing_218;
mod bearings;
mod cage_speed;
mod diagnostics;
mod laws;
mod marble;
mod pendulum;
mod rolling;
mod skidding;
mod static_limit;
