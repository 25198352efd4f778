//! Analyses of the linear and the static problem.
