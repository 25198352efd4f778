//! Noise: modes found all the same, and standard errors that are what the scatter is.
