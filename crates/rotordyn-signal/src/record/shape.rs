//! Test geometry (wireframe) of a measured structure, and shapes over its points.

use crate::Complex;

/// Test geometry: points, and the lines and elements that connect them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    pub nodes: Vec<Node>,
    pub lines: Vec<Polyline>,
    pub elements: Vec<Element>,
    /// Points with an offset from others, defined by a mapping.
    pub attached_points: Vec<AttachedPoint>,
}

/// A point rigidly attached to another with an offset, such as a sensor on a housing or a hit on a disc rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AttachedPoint {
    pub number: i64,
    /// The point that carries it.
    pub carrier: i64,
    /// Offset from that point \[m\].
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

/// Trace lines through points, for display.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polyline {
    pub name: String,
    /// Every stroke connects its nodes in order.
    pub strokes: Vec<Vec<i64>>,
}

/// A finite element of another program, kept for display.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    pub number: i64,
    /// Element type (FE descriptor id) of the universal file: 11 rod, 21 beam, 41 and 91 triangles, 44 and 94
    /// quadrilaterals, 111 tetrahedron, 115 brick.
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
    /// Node by node; imaginary parts are zero if `complex` is not set.
    pub values: Vec<Complex<f64>>,
    pub complex: bool,
    /// SI unit; empty if the shape has none.
    pub unit: String,
}

/// Analysis type of a shape.
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
        /// Modal a and b of the first-order (state-space) form; 0 if not given.
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
