//! Geometry of a measured structure, and shapes over its points.

use crate::signal::Complex;

/// Points and what joins them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    pub nodes: Vec<Node>,
    pub lines: Vec<Polyline>,
    pub elements: Vec<Element>,
    /// Points beside others, which a mapping has placed.
    pub mounts: Vec<Mount>,
}

/// A point fixed to another at a distance, as a sensor on a housing or a hit on a rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mount {
    pub number: i64,
    /// The point that carries it.
    pub on: i64,
    /// From there \[m\].
    pub offset: [f64; 3],
}

/// A numbered point \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    pub number: i64,
    pub position: [f64; 3],
    /// Number of the coordinate system of its directions; 0 is the global one.
    pub local_system: i64,
}

/// Strokes through points, drawn for the eye.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    pub name: String,
    /// Every stroke joins its nodes one after the other.
    pub strokes: Vec<Vec<i64>>,
}

/// A finite element of another program, kept for its outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    pub number: i64,
    /// The universal file's number of its kind: 11 rod, 21 beam, 41 and 91 triangles, 44 and 94 quadrilaterals,
    /// 111 tetrahedron, 115 brick.
    pub descriptor: i64,
    pub nodes: Vec<i64>,
}

/// Values at points: a mode shape, a deflection, a temperature.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    pub name: String,
    pub analysis: Analysis,
    /// Number of the mode or of the frequency.
    pub number: i64,
    /// Values per node: 1 scalar, 3 translations, 6 with rotations.
    pub components: usize,
    pub nodes: Vec<i64>,
    /// Node by node; imaginary parts are zero where `complex` is not set.
    pub values: Vec<Complex<f64>>,
    pub complex: bool,
    /// SI unit; empty where the shape has none of its own.
    pub unit: String,
}

/// What a shape is the answer to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Analysis {
    Static,
    NormalMode {
        frequency_hz: f64,
        /// Viscous damping ratio ζ and hysteretic loss factor.
        damping_ratio: f64,
        hysteretic: f64,
        /// Modal mass \[kg\].
        modal_mass: f64,
    },
    ComplexMode {
        /// λ = −ζω + jω√(1−ζ²) \[1/s\].
        eigenvalue: Complex<f64>,
        /// Modal a and b of the first-order form; 0 where not given.
        modal_a: Complex<f64>,
        modal_b: Complex<f64>,
    },
    Transient {
        time: f64,
    },
    FrequencyResponse {
        frequency_hz: f64,
    },
    Unknown,
}

impl Analysis {
    /// Natural frequency |λ|/2π or frequency of the response \[Hz\].
    pub fn frequency_hz(&self) -> Option<f64> {
        match self {
            Analysis::NormalMode { frequency_hz, .. } | Analysis::FrequencyResponse { frequency_hz } => {
                Some(*frequency_hz)
            }
            Analysis::ComplexMode { eigenvalue, .. } => Some(eigenvalue.norm() / std::f64::consts::TAU),
            Analysis::Static | Analysis::Transient { .. } | Analysis::Unknown => None,
        }
    }

    /// Damping ratio ζ = −Re λ/|λ| of a mode.
    pub fn damping_ratio(&self) -> Option<f64> {
        match self {
            Analysis::NormalMode { damping_ratio, .. } => Some(*damping_ratio),
            Analysis::ComplexMode { eigenvalue, .. } if eigenvalue.norm() > 0.0 => {
                Some(-eigenvalue.re / eigenvalue.norm())
            }
            _ => None,
        }
    }
}
