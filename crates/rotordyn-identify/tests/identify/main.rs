//! Poles and mode shapes of exact and noisy FRFs, refusals.

mod band_end;
mod drift;
mod exact;
mod exponential_window;
mod full_band;
mod heavy_damping;
mod inconsistent_output;
mod known_modes;
mod mains;
mod merged_modes;
mod model_error;
mod noise;
mod noise_only;
mod pairs;
mod random;
mod refusals;
mod residual_terms;
mod single;
mod whirl_pairs;
