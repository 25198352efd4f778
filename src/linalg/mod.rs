//! Linear algebra: the only bridge between nalgebra and faer.
