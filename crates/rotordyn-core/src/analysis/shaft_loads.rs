//! Deflection, shear force and bending moment along the shaft: at rest, and their amplitudes under unbalance.

use super::section_loads::{SectionLoad, ShaftSections, bending_strain, bending_stress};
use super::unbalance::Orbit;
use crate::document::{Document, Rows, TO_RPM, in_hdf5, in_json, named, quantity};
use crate::model::Model;
use rotordyn_linalg::Complex64;
use serde::{Deserialize, Serialize};

/// A section of the shaft at rest; two at every node between elements, before and behind it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShaftPoint {
    /// Axial position \[m\].
    pub z: f64,
    /// Displacements u_x and u_y \[m\].
    pub displacement: [f64; 2],
    /// Shear force along x and y \[N\].
    pub shear: [f64; 2],
    /// Bending moment in the planes x-z and y-z \[N m\].
    pub moment: [f64; 2],
    /// Axial force, positive in tension \[N\].
    pub axial: f64,
    /// Torque \[N m\].
    pub torque: f64,
    /// Largest bending stress \[Pa\], without notches; its amplitude as the shaft turns.
    pub stress: f64,
}

/// Amplitudes in a section under unbalance: semi-major axes of the ellipses that the vectors (x, y) run through.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShaftAmplitude {
    /// Axial position \[m\].
    pub z: f64,
    /// Displacement \[m\].
    pub displacement: f64,
    /// Shear force \[N\].
    pub shear: f64,
    /// Bending moment \[N m\].
    pub moment: f64,
    /// Rotation of the section about an axis across the shaft \[rad\], and largest bending strain.
    #[serde(default)]
    pub slope: f64,
    #[serde(default)]
    pub strain: f64,
}

/// Loads of the shaft under unbalance at one speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShaftAmplitudes {
    /// Ω \[rad/s\].
    pub speed: f64,
    /// Why at this speed, such as "operating speed".
    pub reason: String,
    pub points: Vec<ShaftAmplitude>,
}

/// Deflection and section loads of the shaft at rest; `q`: displacements of all DOFs.
pub fn at_rest(model: &Model, sections: &[SectionLoad], q: &[f64]) -> Vec<ShaftPoint> {
    let point = |section: &SectionLoad| ShaftPoint {
        z: model.node_z[section.node],
        displacement: [q[6 * section.node], q[6 * section.node + 1]],
        shear: section.shear.map(|v| v.re),
        moment: section.moment.map(|m| m.re),
        axial: section.axial.re,
        torque: section.torque.re,
        stress: bending_stress(model, section),
    };
    sections.iter().map(point).collect()
}

/// Amplitudes along the shaft at a speed Ω \[rad/s\]; `q`: synchronous amplitudes of all DOFs.
pub fn under_unbalance(
    model: &Model,
    shaft: &ShaftSections,
    q: &[Complex64],
    speed: f64,
) -> Vec<ShaftAmplitude> {
    let point = |section: &SectionLoad| ShaftAmplitude {
        z: model.node_z[section.node],
        displacement: major([q[6 * section.node], q[6 * section.node + 1]]),
        shear: major(section.shear),
        moment: largest_moment(section),
        slope: major([q[6 * section.node + 3], q[6 * section.node + 4]]),
        strain: bending_strain(model, section),
    };
    shaft.at_speed(q, speed).iter().map(point).collect()
}

/// Amplitude of the bending moment in a section under unbalance \[N m\].
pub fn largest_moment(section: &SectionLoad) -> f64 {
    major(section.moment)
}

/// Semi-major axis of the ellipse of a vector (x, y).
fn major([x, y]: [Complex64; 2]) -> f64 {
    Orbit::new(x, y).major
}

impl ShaftPoint {
    /// Where along the shaft a quantity is largest: the point and the value there.
    pub fn largest(points: &[Self], of: impl Fn(&Self) -> f64) -> Option<(&Self, f64)> {
        points.iter().map(|point| (point, of(point))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// What is written to files, one row a section.
    pub fn columns(points: &[Self]) -> Rows<'static, '_, Self> {
        Rows::of(points)
            .over("z")
            .number(named("z_m", "z"), "m", |p| p.z)
            .number(named("u_x_m", "u_x"), "m", |p| p.displacement[0])
            .number(named("u_y_m", "u_y"), "m", |p| p.displacement[1])
            .number(named("shear_x_n", "shear_x"), "N", |p| p.shear[0])
            .number(named("shear_y_n", "shear_y"), "N", |p| p.shear[1])
            .number(named("moment_xz_nm", "moment_xz"), "N m", |p| p.moment[0])
            .number(named("moment_yz_nm", "moment_yz"), "N m", |p| p.moment[1])
            .number(named("axial_force_n", "axial_force"), "N", |p| p.axial)
            .number(named("torque_nm", "torque"), "N m", |p| p.torque)
            .number(named("bending_stress_pa", "bending_stress"), "Pa", |p| p.stress)
    }
}

impl ShaftAmplitude {
    /// Where along the shaft a quantity is largest: the point and the value there.
    pub fn largest(points: &[Self], of: impl Fn(&Self) -> f64) -> Option<(&Self, f64)> {
        points.iter().map(|point| (point, of(point))).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl ShaftAmplitudes {
    /// What is written to files.
    pub fn document(&self) -> Document<'_> {
        let rows = Rows::of(&self.points)
            .over("z")
            .number(named("z_m", "z"), "m", |p| p.z)
            .number(quantity("displacement", "m"), "m", |p| p.displacement)
            .number(quantity("shear", "N"), "N", |p| p.shear)
            .number(named("moment_nm", "moment"), "N m", |p| p.moment);
        Document::new()
            .text(in_json("at"), &self.reason)
            .number(in_json("speed_rpm"), "rpm", self.speed * TO_RPM)
            .number(in_hdf5("rpm"), "rpm", self.speed * TO_RPM)
            .table(named("sections", ""), rows)
    }
}
