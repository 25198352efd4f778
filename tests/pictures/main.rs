//! Figures: ticks, labels, decimation, valid and equal SVG, PNG size, and degenerate data.

mod degenerate_data;
mod figures;
mod layout;
mod machine_layout;
mod machines;
mod mode_shapes;
mod polar;
mod samples;
mod text_overlap;
