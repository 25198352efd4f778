//! Axes, DOF order, signs and symbols used everywhere (documentation only).
//!
//! - Right-handed axes: z along the shaft, y up, x horizontal; spin Ω is about +z; gravity along −y.
//! - A node has six DOFs in the order u_x u_y u_z θ_x θ_y θ_z. A slope is u_x′ = θ_y, u_y′ = −θ_x.
//! - M q̈ + (C + Ω G) q̇ + (K + Ω̇ K_s + Ω K_c) q = f. K is symmetric, G skew, C symmetric except for what
//!   the user gives; K_c is the circulatory stiffness of internal damping.
//! - Forward whirl turns from x towards y, as the spin does.
//! - A bearing's force is the force ON the shaft; tangents are −∂f/∂q and −∂f/∂q̇.
//! - Complex response: q(t) = Re(Q e^{+jωt}).
//! - SI throughout; other units carry a suffix (`_hz`, `_rpm`, `_deg`). Angles in rad, speeds in rad/s.
