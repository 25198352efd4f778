//! Nonlinear transients in time.
