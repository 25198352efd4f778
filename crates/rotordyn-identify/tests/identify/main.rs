//! Poles and mode shapes of exact and noisy FRFs, refusals.

mod exact;
mod known_modes;
mod noise;
mod refusals;
mod single;
