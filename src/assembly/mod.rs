//! Assembly: model to DOF map and matrices.
