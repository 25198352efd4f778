//! Deflections of the shaft beyond the linear theory of beams.

use crate::analysis::section_loads::{SectionLoad, ShaftSections, bending_strain};
use crate::document::{TO_RPM, number};
use crate::study::{Machine, Results};
use crate::warning::{Code, Warning};

/// Rotation of a section \[rad\] from which what linear theory leaves out, of the order of its square, is 1 %.
const LARGEST_SLOPE: f64 = 0.1;
/// Bending strain from which no shaft material stays elastic for long: 1 GPa in steel, 0.7 GPa in titanium.
const LARGEST_STRAIN: f64 = 5e-3;

/// Rotation \[rad\] and bending strain of a section.
#[derive(Clone, Copy)]
struct Bending {
    z: f64,
    slope: f64,
    strain: f64,
}

impl Bending {
    /// How far it lies beyond the limits, 1 at a limit.
    fn excess(&self) -> f64 {
        (self.slope / LARGEST_SLOPE).max(self.strain / LARGEST_STRAIN)
    }
}

/// The section farthest beyond the limits, in words; `None` within them.
fn beyond(sections: impl Iterator<Item = Bending>, what: &str) -> Option<String> {
    let finite = sections.filter(|section| section.excess().is_finite());
    let worst = finite.max_by(|a, b| a.excess().total_cmp(&b.excess()))?;
    (worst.excess() > 1.0).then(|| {
        let part = match worst.slope / LARGEST_SLOPE > worst.strain / LARGEST_STRAIN {
            true => format!("a slope of {} deg", number(worst.slope.to_degrees(), 3)),
            false => format!("a bending strain of {} %", number(100.0 * worst.strain, 3)),
        };
        let at = number(1e3 * worst.z, 5);
        format!("{what} gives the shaft {part} at z = {at} mm, where linear theory of beams does not hold")
    })
}

impl Machine {
    /// The shaft under its static loads at standstill, and under unbalance.
    pub(super) fn deflection_warnings(&self, results: &Results) -> Vec<Warning> {
        let mut found = Vec::new();
        let mut warn = |item: &str, text: String| found.push(Warning::new(Code::LargeDeflection, item, text));
        if let Some(text) = beyond(self.bending_at_rest().into_iter(), "static: the static load") {
            warn("shaft", text);
        }
        for at in results.unbalance.iter().flat_map(|unbalance| &unbalance.shaft) {
            let sections = at.points.iter().map(|p| Bending { z: p.z, slope: p.slope, strain: p.strain });
            let what = format!("unbalance: the response at {:.0} rpm", at.speed * TO_RPM);
            if let Some(text) = beyond(sections, &what) {
                warn("study.unbalance", text);
            }
        }
        found
    }

    fn bending_at_rest(&self) -> Vec<Bending> {
        let q = self.assembly.dofs.expand(&self.standstill_equilibrium.q);
        let sections = ShaftSections::new(&self.model).at_rest(&q);
        let bending = |section: &SectionLoad| Bending {
            z: self.model.node_z[section.node],
            slope: q[6 * section.node + 3].hypot(q[6 * section.node + 4]),
            strain: bending_strain(&self.model, section),
        };
        sections.iter().map(bending).collect()
    }
}
