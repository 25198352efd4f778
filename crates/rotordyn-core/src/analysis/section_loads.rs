//! Loads in the cross-sections of the shaft: shear force, bending moment, axial force and torque.
//!
//! The forces on the ends of an element are f = (K + Ω K_c − ω² M + jω (C + Ω G)) q − f_gravity, with all its inertia, so
//! that they are exact at the nodes of the discretised shaft. The part of the shaft before a section (smaller z) acts on
//! the part behind it with the shear force V and a moment; signs of a beam: dM/dz = V in each plane, and a positive M has
//! positive curvature, E I u″ = M (Gere & Timoshenko, Mechanics of Materials, ch. 4). Dampers of modal damping belong to no
//! element: their forces are left out.

use crate::element::shaft_matrices::ConeRule;
use crate::element::{Element, ElementMatrices, ShaftElement};
use crate::model::Model;
use rotordyn_linalg::{Complex64, SparseMatrix};
use std::f64::consts::PI;

/// Loads in one cross-section, complex amplitudes; real for static loads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionLoad {
    /// Shaft node.
    pub node: usize,
    /// Element to which the section belongs.
    pub element: usize,
    /// Shear force along x and y \[N\]: the resultant of all forces on the part of the shaft before the section.
    pub shear: [Complex64; 2],
    /// Bending moment in the planes x-z and y-z \[N m\].
    pub moment: [Complex64; 2],
    /// Axial force \[N\], positive in tension.
    pub axial: Complex64,
    /// Torque \[N m\].
    pub torque: Complex64,
}

/// Matrices of one shaft element, for the loads at its ends.
struct ElementForces {
    mass: SparseMatrix,
    damping: SparseMatrix,
    gyroscopic: SparseMatrix,
    stiffness: SparseMatrix,
    circulatory: SparseMatrix,
}

/// The shaft of a model, for the loads in its sections; empty for a rigid rotor.
pub struct ShaftSections {
    elements: Vec<ElementForces>,
    gravity: [f64; 3],
}

impl ShaftSections {
    pub fn new(model: &Model) -> Self {
        let [alpha, beta] = model.damping.proportional;
        let forces = |element: &dyn Element| {
            let mut all = ElementMatrices::new(12, ConeRule::default());
            element.add_matrices(0, &mut all);
            let [mass, stiffness, damping] = [all.mass.build(), all.stiffness.build(), all.damping.build()];
            ElementForces {
                damping: SparseMatrix::sum(&[(1.0, &damping), (alpha, &mass), (beta, &stiffness)]),
                gyroscopic: all.gyroscopic.build(),
                circulatory: all.circulatory.build(),
                mass,
                stiffness,
            }
        };
        Self { elements: model.shaft.iter().map(|e| forces(e)).collect(), gravity: model.gravity }
    }

    /// Loads at both ends of every element, in the order of z, under gravity and displacements q of all DOFs \[m, rad\].
    pub fn at_rest(&self, q: &[f64]) -> Vec<SectionLoad> {
        self.of(|element, nodes| {
            let own = &q[6 * nodes..6 * nodes + 12];
            let acceleration: [f64; 12] =
                std::array::from_fn(|i| if i % 6 < 3 { self.gravity[i % 6] } else { 0.0 });
            let (elastic, weight) = (element.stiffness.mul(own), element.mass.mul(&acceleration));
            std::array::from_fn(|i| Complex64::new(elastic[i] - weight[i], 0.0))
        })
    }

    /// Loads at both ends of every element at a steady speed Ω \[rad/s\], from synchronous amplitudes of all DOFs.
    pub fn at_speed(&self, q: &[Complex64], speed: f64) -> Vec<SectionLoad> {
        self.of(|element, nodes| {
            let own = &q[6 * nodes..6 * nodes + 12];
            let [m, c, g, k, h] = [
                &element.mass,
                &element.damping,
                &element.gyroscopic,
                &element.stiffness,
                &element.circulatory,
            ]
            .map(|matrix| matrix.mul_complex(own));
            std::array::from_fn(|i| {
                let damped = Complex64::new(0.0, speed) * (c[i] + g[i] * speed);
                k[i] + h[i] * speed - m[i] * (speed * speed) + damped
            })
        })
    }

    /// Loads from the forces on the ends of every element.
    fn of(&self, ends: impl Fn(&ElementForces, usize) -> [Complex64; 12]) -> Vec<SectionLoad> {
        let sections = |(k, element): (usize, &ElementForces)| {
            let f = ends(element, k);
            // The part before the element acts on its first end, the element itself on the part behind it.
            let section = |node: usize, f: &[Complex64], sign: f64| SectionLoad {
                node,
                element: k,
                shear: [f[0] * sign, f[1] * sign],
                moment: [f[4] * -sign, f[3] * sign],
                axial: f[2] * -sign,
                torque: f[5] * -sign,
            };
            [section(k, &f[..6], 1.0), section(k + 1, &f[6..], -1.0)]
        };
        self.elements.iter().enumerate().flat_map(sections).collect()
    }
}

/// Largest bending stress √(M_xz² + M_yz²) d/(2 I) in a section of an element \[Pa\]; with layers of moduli E_k that of the
/// layer with the largest one, √(M_xz² + M_yz²) E d/(2 Σ E_k I_k).
pub fn bending_stress(model: &Model, section: &SectionLoad) -> f64 {
    let (element, end) = (&model.shaft[section.element], section.node - section.element);
    let second_moment =
        |e: &ShaftElement| PI / 64.0 * (e.outer_diameter[end].powi(4) - e.inner_diameter[end].powi(4));
    let [x, y] = section.moment.map(|moment| moment.norm());
    let moment = x.hypot(y);
    if element.layers.is_empty() {
        return 0.5 * element.outer_diameter[end] * moment / second_moment(element);
    }
    let rigidity: f64 = element.with_layers().map(|e| e.material.young * second_moment(e)).sum();
    let stress = |e: &ShaftElement| 0.5 * e.outer_diameter[end] * moment * e.material.young / rigidity;
    element.with_layers().map(stress).fold(0.0, f64::max)
}
