//! Figures: ticks, labels, decimation, valid and equal SVG, PNG size, and degenerate data.

mod degenerate_data;
mod figures;
mod layout;
mod samples;
