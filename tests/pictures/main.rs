//! Figures: ticks, labels, decimation, valid and equal SVG, PNG size, and degenerate data.

mod figures;
mod hostile;
mod layout;
mod samples;
