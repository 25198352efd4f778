//! Figures: ticks, labels, decimation, valid and equal SVG, PNG size, and data that no figure should have to see.

mod figures;
mod hostile;
mod layout;
mod samples;
