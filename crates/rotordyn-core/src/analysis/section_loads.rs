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
use rotordyn_linalg::{Complex64, Triplets};
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

/// Entry (i, j) of the matrices of one shaft element, for the loads at its ends.
#[derive(Clone, Copy, Default)]
struct Entry {
    i: usize,
    j: usize,
    mass: f64,
    damping: f64,
    gyroscopic: f64,
    stiffness: f64,
    circulatory: f64,
}

/// The entries of one shaft element that are not all zero.
type ElementForces = Vec<Entry>;

/// The shaft of a model, for the loads in its sections; empty for a rigid rotor.
pub struct ShaftSections {
    elements: Vec<ElementForces>,
    gravity: [f64; 3],
}

impl ShaftSections {
    pub fn new(model: &Model) -> Self {
        let [alpha, beta] = model.damping.proportional;
        let forces = |element: &dyn Element| -> ElementForces {
            let mut all = ElementMatrices::new(12, ConeRule::default());
            element.add_matrices(0, &mut all);
            let [m, c, g] = [all.mass, all.damping, all.gyroscopic].map(Triplets::build);
            let [k, h] = [all.stiffness, all.circulatory].map(Triplets::build);
            let entries = (0..144).map(|at| {
                let (i, j) = (at / 12, at % 12);
                let (mass, stiffness) = (m.get(i, j), k.get(i, j));
                let damping = c.get(i, j) + alpha * mass + beta * stiffness;
                let (gyroscopic, circulatory) = (g.get(i, j), h.get(i, j));
                Entry { i, j, mass, damping, gyroscopic, stiffness, circulatory }
            });
            let is_empty = |e: &Entry| {
                [e.mass, e.damping, e.gyroscopic, e.stiffness, e.circulatory].iter().all(|v| *v == 0.0)
            };
            entries.filter(|entry| !is_empty(entry)).collect()
        };
        Self { elements: model.shaft.iter().map(|e| forces(e)).collect(), gravity: model.gravity }
    }

    /// Loads at both ends of every element, in the order of z, under gravity and displacements q of all DOFs \[m, rad\].
    pub fn at_rest(&self, q: &[f64]) -> Vec<SectionLoad> {
        let acceleration = |i: usize| if i % 6 < 3 { self.gravity[i % 6] } else { 0.0 };
        self.of(|entry, first| {
            (entry.stiffness * q[first + entry.j] - entry.mass * acceleration(entry.j)).into()
        })
    }

    /// Loads at both ends of every element at a steady speed Ω \[rad/s\], from synchronous amplitudes of all DOFs.
    pub fn at_speed(&self, q: &[Complex64], speed: f64) -> Vec<SectionLoad> {
        self.of(|entry, first| {
            let elastic = entry.stiffness + speed * entry.circulatory - speed * speed * entry.mass;
            let damped = speed * (entry.damping + speed * entry.gyroscopic);
            Complex64::new(elastic, damped) * q[first + entry.j]
        })
    }

    /// Loads from the forces on the ends of every element, the sums of what `force` gives for each entry and the first DOF
    /// of the element.
    fn of(&self, force: impl Fn(&Entry, usize) -> Complex64) -> Vec<SectionLoad> {
        let sections = |(k, element): (usize, &ElementForces)| {
            let mut f = [Complex64::default(); 12];
            element.iter().for_each(|entry| f[entry.i] += force(entry, 6 * k));
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
    if element.layers.is_empty() {
        return 0.5 * element.outer_diameter[end] * resultant(section) / second_moment(element, end);
    }
    let curvature = curvature(model, section);
    let stress = |e: &ShaftElement| 0.5 * e.outer_diameter[end] * curvature * e.material.young;
    element.with_layers().map(stress).fold(0.0, f64::max)
}

/// Largest bending strain √(M_xz² + M_yz²) d/(2 Σ E_k I_k) in a section of an element; 0 where nothing resists bending.
pub fn bending_strain(model: &Model, section: &SectionLoad) -> f64 {
    let (element, end) = (&model.shaft[section.element], section.node - section.element);
    let outer = element.with_layers().map(|e| e.outer_diameter[end]).fold(0.0, f64::max);
    let strain = 0.5 * outer * curvature(model, section);
    if strain.is_finite() { strain } else { 0.0 }
}

/// √(M_xz² + M_yz²)/(Σ E_k I_k) \[1/m\].
fn curvature(model: &Model, section: &SectionLoad) -> f64 {
    let (element, end) = (&model.shaft[section.element], section.node - section.element);
    let rigidity: f64 = element.with_layers().map(|e| e.material.young * second_moment(e, end)).sum();
    resultant(section) / rigidity
}

/// √(M_xz² + M_yz²) \[N m\].
fn resultant(section: &SectionLoad) -> f64 {
    let [x, y] = section.moment.map(|moment| moment.norm());
    x.hypot(y)
}

/// Second moment of area at an end of an element \[m⁴\].
fn second_moment(element: &ShaftElement, end: usize) -> f64 {
    PI / 64.0 * (element.outer_diameter[end].powi(4) - element.inner_diameter[end].powi(4))
}
