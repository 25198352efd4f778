//! Matrices of the Timoshenko shaft element: mass, stiffness, geometric stiffness, gyroscopic, circulatory.
//!
//! Bending follows the cubic Timoshenko shape functions with one shear parameter φ per element
//! (Friswell et al. 2010, §5.4); conical sections are integrated exactly. For element length h and wave
//! number k a frequency is overestimated by (k h)⁴/1440 + ρω²h²/(24 κG): fourth order while h is well above
//! the diameter, with a small second-order term from shear below. Both planes use the same
//! functions over (u, ψ): u = u_x, ψ = θ_y in one plane, u = u_y, ψ = −θ_x in the other.

use super::shaft::{ShaftElement, gauss, quadrature};

/// Element matrix over u_x u_y u_z θ_x θ_y θ_z of the left, then of the right node.
pub type Matrix12 = [[f64; 12]; 12];

type Matrix4 = [[f64; 4]; 4];

/// DOFs of the plane x-z, (u_x, θ_y) of both nodes.
const PLANE_X: [usize; 4] = [0, 4, 6, 10];
/// DOFs of the plane y-z, (u_y, −θ_x) of both nodes; signs in [`SIGN_Y`].
const PLANE_Y: [usize; 4] = [1, 3, 7, 9];
const SIGN_Y: [f64; 4] = [1.0, -1.0, 1.0, -1.0];

/// Averaging rule for axial and torsional properties of a conical element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ConeRule {
    /// Exact flexibility 1/k = ∫ dz/(E A) and exactly integrated inertia.
    #[default]
    Exact,
    /// Arithmetic mean of both ends, as ROSS does.
    ArithmeticMean,
}

/// Shape functions at ξ: displacement u, slope u′, rotation ψ, curvature ψ′ for unit (u₁ ψ₁ u₂ ψ₂).
struct Shape {
    displacement: [f64; 4],
    slope: [f64; 4],
    rotation: [f64; 4],
    curvature: [f64; 4],
}

impl Shape {
    fn new(x: f64, length: f64, phi: f64) -> Self {
        let (l, a) = (length, 1.0 / (1.0 + phi));
        let (x2, x3) = (x * x, x * x * x);
        let half = 0.5 * phi;
        Self {
            displacement: [
                a * (1.0 + phi * (1.0 - x) - 3.0 * x2 + 2.0 * x3),
                a * l * (x - 2.0 * x2 + x3 + half * (x - x2)),
                a * (phi * x + 3.0 * x2 - 2.0 * x3),
                a * l * (x3 - x2 + half * (x2 - x)),
            ],
            slope: [
                a / l * (6.0 * x2 - 6.0 * x - phi),
                a * (1.0 - 4.0 * x + 3.0 * x2 + half * (1.0 - 2.0 * x)),
                a / l * (6.0 * x - 6.0 * x2 + phi),
                a * (3.0 * x2 - 2.0 * x + half * (2.0 * x - 1.0)),
            ],
            rotation: [
                a / l * 6.0 * (x2 - x),
                a * (1.0 - 4.0 * x + 3.0 * x2 + phi * (1.0 - x)),
                a / l * 6.0 * (x - x2),
                a * (3.0 * x2 - 2.0 * x + phi * x),
            ],
            curvature: [
                a / (l * l) * (12.0 * x - 6.0),
                a / l * (6.0 * x - 4.0 - phi),
                a / (l * l) * (6.0 - 12.0 * x),
                a / l * (6.0 * x - 2.0 + phi),
            ],
        }
    }
}

impl ShaftElement {
    /// ∫ weight(ξ) a bᵀ dz with shape functions of shear parameter φ; a, b chosen by `pick`.
    fn integrate(
        &self,
        phi: f64,
        weight: impl Fn(f64) -> f64,
        pick: impl Fn(&Shape) -> ([f64; 4], [f64; 4]),
    ) -> Matrix4 {
        let mut out = [[0.0; 4]; 4];
        gauss(|xi, w| {
            let (a, b) = pick(&Shape::new(xi, self.length, phi));
            let factor = w * self.length * weight(xi);
            for (row, a) in out.iter_mut().zip(a) {
                for (v, b) in row.iter_mut().zip(b) {
                    *v += factor * a * b;
                }
            }
        });
        out
    }

    /// Consistent mass matrix M, with rotary inertia ρ I if enabled.
    pub fn mass_matrix(&self, rule: ConeRule) -> Matrix12 {
        let rho = self.material.density;
        let phi = self.shear_parameter();
        let mut plane = self.integrate(phi, |x| rho * self.area(x), |s| (s.displacement, s.displacement));
        if self.rotary_inertia {
            add4(&mut plane, &self.rotary(phi));
        }
        let mut m = both_planes(&plane);
        self.add_bar_mass(&mut m, 2, rule, |x| rho * self.area(x));
        self.add_bar_mass(&mut m, 5, rule, |x| 2.0 * rho * self.second_moment(x));
        m
    }

    fn rotary(&self, phi: f64) -> Matrix4 {
        let rho = self.material.density;
        self.integrate(phi, |x| rho * self.second_moment(x), |s| (s.rotation, s.rotation))
    }

    /// Mass of a bar with linear shape functions for DOF `dof` of both nodes.
    fn add_bar_mass(&self, m: &mut Matrix12, dof: usize, rule: ConeRule, density: impl Fn(f64) -> f64) {
        let mean = 0.5 * (density(0.0) + density(1.0));
        let at = |x: f64| if rule == ConeRule::Exact { density(x) } else { mean };
        let [left, both, right] = [
            quadrature(|x| at(x) * (1.0 - x).powi(2)),
            quadrature(|x| at(x) * x * (1.0 - x)),
            quadrature(|x| at(x) * x * x),
        ];
        m[dof][dof] = self.length * left;
        m[dof][dof + 6] = self.length * both;
        m[dof + 6][dof] = self.length * both;
        m[dof + 6][dof + 6] = self.length * right;
    }

    /// Elastic stiffness K_e, without the geometric terms.
    pub fn elastic_stiffness(&self, rule: ConeRule) -> Matrix12 {
        let phi = self.shear_parameter();
        let (e, g) = (self.material.young, self.material.shear);
        let mut plane = self.integrate(phi, |x| e * self.second_moment(x), |s| (s.curvature, s.curvature));
        if let Some(kappa) = self.shear_coefficient() {
            let shear = self.integrate(
                phi,
                |x| kappa * g * self.area(x),
                |s| {
                    let angle: [f64; 4] = std::array::from_fn(|i| s.slope[i] - s.rotation[i]);
                    (angle, angle)
                },
            );
            add4(&mut plane, &shear);
        }
        let mut k = both_planes(&plane);
        for (dof, stiffness) in [
            (2, e * self.bar_mean(rule, |x| self.area(x)) / self.length),
            (5, g * self.bar_mean(rule, |x| 2.0 * self.second_moment(x)) / self.length),
        ] {
            k[dof][dof] = stiffness;
            k[dof + 6][dof + 6] = stiffness;
            k[dof][dof + 6] = -stiffness;
            k[dof + 6][dof] = -stiffness;
        }
        k
    }

    /// Section property of the uniform bar of equal axial or torsional stiffness.
    fn bar_mean(&self, rule: ConeRule, section: impl Fn(f64) -> f64) -> f64 {
        match rule {
            ConeRule::ArithmeticMean => 0.5 * (section(0.0) + section(1.0)),
            // 1/section is not polynomial: five points on eight pieces reach round-off for any usual cone.
            ConeRule::Exact => {
                let pieces = 8.0;
                let flexibility: f64 =
                    (0..8).map(|p| quadrature(|x| 1.0 / section((f64::from(p) + x) / pieces))).sum();
                pieces / flexibility
            }
        }
    }

    /// Geometric stiffness of axial force N and torque T.
    ///
    /// Force: N ∫ u′ u′ dz in both planes, positive in tension. Torque (positive on the face towards +z,
    /// acting along the tangent at both nodes): Friswell et al. 2010, §5.4.8; its end terms ±T/2 cancel between
    /// neighbours of equal torque and make a single element's matrix unsymmetric.
    pub fn geometric_stiffness(&self) -> Matrix12 {
        let n = self.axial_force;
        let mut k = both_planes(&self.integrate(self.shear_parameter(), |_| n, |s| (s.slope, s.slope)));
        if self.torque != 0.0 {
            let (a, b) = (self.torque / self.length, 0.5 * self.torque);
            // Rows over (u_x, θ_y), columns over (u_y, θ_x), of both nodes.
            let x_from_y = [[0.0, a, 0.0, -a], [a, b, -a, -b], [0.0, -a, 0.0, a], [-a, b, a, -b]];
            for (i, row) in PLANE_X.iter().zip(x_from_y) {
                for (j, v) in PLANE_Y.iter().zip(row) {
                    k[*i][*j] += v;
                    // The end terms ±T/2 between θ_x and θ_y of one node are skew, all else symmetric.
                    k[*j][*i] += if i.abs_diff(*j) == 1 && i % 6 == 4 { -v } else { v };
                }
            }
        }
        k
    }

    /// Gyroscopic matrix G for unit speed: G\[θ_x, θ_y\] = +∫ 2ρI ψ ψ dz and its transpose negative.
    pub fn gyroscopic_matrix(&self) -> Matrix12 {
        gyroscopic_of(&self.rotary(self.shear_parameter()))
    }

    /// Circulatory stiffness K_c of internal damping, for unit speed: η_v K_e P.
    ///
    /// Damping acts on the velocity in the rotating frame, q̇ + Ω P q with (P q)_x = q_y and
    /// (P q)_y = −q_x for both displacements and rotations, so that f = −η_v K_e (q̇ + Ω P q). Forward
    /// whirl at ω gets the damping η_v K_e (ω − Ω)/ω, negative above the critical speed.
    pub fn circulatory_stiffness(&self) -> Matrix12 {
        let k = self.elastic_stiffness(ConeRule::Exact);
        let mut out = [[0.0; 12]; 12];
        for i in 0..12 {
            for node in [0, 6] {
                for (x, y) in [(node, node + 1), (node + 3, node + 4)] {
                    out[i][y] += self.internal_viscous * k[i][x];
                    out[i][x] -= self.internal_viscous * k[i][y];
                }
            }
        }
        out
    }

    /// Torque geometric stiffness of internal torque T(ξ) in symmetric (energy) form.
    ///
    /// V = ½ ∫ T (θ_x θ_y′ − θ_x′ θ_y) dz, T the torque of the part on the left on the part on the right,
    /// along the tangent; see [`SpinUpForm`](crate::assembly::SpinUpForm).
    pub fn torque_energy_stiffness(&self, torque: impl Fn(f64) -> f64) -> Matrix12 {
        // ∫ T ψ_y ψ_x′ dz over the planes' own coordinates.
        let b = self.integrate(self.shear_parameter(), torque, |s| (s.rotation, s.curvature));
        let mut k = [[0.0; 12]; 12];
        for i in 0..4 {
            for j in 0..4 {
                // θ_x = −ψ_y: V = −½ ∫ T (ψ_y ψ_x′ − ψ_y′ ψ_x) dz.
                let v = -0.5 * SIGN_Y[i] * (b[i][j] - b[j][i]);
                k[PLANE_Y[i]][PLANE_X[j]] += v;
                k[PLANE_X[j]][PLANE_Y[i]] += v;
            }
        }
        k
    }

    /// ROSS 3.1.0's spin-up matrix: minus the u_x- and θ_y-rows of the gyroscopic matrix, taken without shear
    /// and, for a cone, with the mean of both ends' second moments of area.
    pub fn spin_up_ross(&self) -> Matrix12 {
        let inertia = 0.5 * self.material.density * (self.second_moment(0.0) + self.second_moment(1.0));
        let g = gyroscopic_of(&self.integrate(0.0, |_| inertia, |s| (s.rotation, s.rotation)));
        let mut k = [[0.0; 12]; 12];
        for i in PLANE_X {
            k[i] = g[i].map(|v| -v);
        }
        k
    }
}

fn add4(a: &mut Matrix4, b: &Matrix4) {
    for (x, y) in a.iter_mut().flatten().zip(b.iter().flatten()) {
        *x += y;
    }
}

/// G of one rotary inertia matrix ∫ ρ I ψ ψ dz.
fn gyroscopic_of(rotary: &Matrix4) -> Matrix12 {
    let mut g = [[0.0; 12]; 12];
    for a in 0..4 {
        for b in 0..4 {
            // With θ_x = −ψ_y, +G[θ_x, θ_y] becomes −G[ψ_y, ψ_x].
            let v = -2.0 * SIGN_Y[a] * rotary[a][b];
            g[PLANE_Y[a]][PLANE_X[b]] = v;
            g[PLANE_X[b]][PLANE_Y[a]] = -v;
        }
    }
    g
}

/// The same bending matrix in both planes.
fn both_planes(plane: &Matrix4) -> Matrix12 {
    let mut out = [[0.0; 12]; 12];
    for a in 0..4 {
        for b in 0..4 {
            out[PLANE_X[a]][PLANE_X[b]] = plane[a][b];
            out[PLANE_Y[a]][PLANE_Y[b]] = SIGN_Y[a] * SIGN_Y[b] * plane[a][b];
        }
    }
    out
}
