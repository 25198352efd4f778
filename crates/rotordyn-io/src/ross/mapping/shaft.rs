//! Shaft elements, materials and couplings.

use super::writer::{Writer, tag};
use crate::ross::rotor::{Coupling, SavedMaterial, ShaftPart};
use crate::ross::text::{Names, number};

/// Shear coefficient of Hutchinson as ROSS has it, 1 + ν less than in the paper.
fn hutchinson_of_ross(part: &ShaftPart) -> f64 {
    let nu = part.material.young / (2.0 * part.material.shear) - 1.0;
    let ratio = (part.inner[0] + part.inner[1]) / (part.outer[0] + part.outer[1]);
    let m2 = ratio * ratio;
    let a = (1.0 + m2) * (1.0 + m2);
    6.0 * a * (1.0 + nu)
        / (a * (7.0 + 12.0 * nu + 4.0 * nu * nu) + 4.0 * m2 * (5.0 + 6.0 * nu + 2.0 * nu * nu))
}

/// Less than any element's length, for the smallest distance of nodes \[m\].
const DEFAULT_SPACING: f64 = 1e-4;

impl Writer<'_> {
    /// Materials, sections, layers, stations and couplings.
    pub fn shaft(&mut self) {
        let materials = self.materials();
        let longest = self.z.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
        let shortest = self.z.windows(2).map(|w| w[1] - w[0]).fold(longest, f64::min);
        self.text.table("[shaft]");
        self.text.comment("one element a section, as in ROSS; less gives a finer mesh");
        self.text.quantity("element_length", longest, "m");
        if shortest < 2.0 * DEFAULT_SPACING {
            self.text.quantity("minimum_spacing", 0.5 * shortest, "m");
        }
        if let Some((_, first)) = materials.first() {
            self.text.text("material", first);
        }
        let several = materials.len() > 1;
        let (rotor, z) = (self.rotor, self.z.clone());
        let name_of = |material: &SavedMaterial| {
            let found = materials.iter().find(|(known, _)| same_material(known, material));
            found.map_or(String::new(), |(_, name)| name.clone())
        };
        let mut layers = Vec::new();
        for node in 0..z.len() - 1 {
            let mut here = rotor.shaft.iter().filter(|part| part.node == node);
            let coupling = rotor.couplings.iter().find(|coupling| coupling.node == node);
            if let Some(part) = here.next() {
                self.section("[[shaft.section]]", part, several.then(|| name_of(&part.material)));
                self.count("ShaftElement", "[[shaft.section]]");
            } else if let Some(coupling) = coupling {
                self.text.table("[[shaft.section]]");
                self.text.comment(&coupling.name);
                self.text.raw("gap", "true");
                self.text.quantity("length", coupling.length, "m");
                self.text.quantity("outer_diameter", coupling.diameter, "m");
            }
            layers.extend(here);
        }
        for part in layers {
            self.section("[[shaft.layer]]", part, several.then(|| name_of(&part.material)));
            self.count("ShaftElement between the nodes of another", "[[shaft.layer]]");
        }
        self.text.table("[station]");
        for (node, z) in z.iter().enumerate() {
            self.text.quantity(&format!("n{node}"), *z, "m");
        }
        for coupling in &rotor.couplings {
            self.coupling(coupling);
        }
    }

    /// Materials with their names, written as tables.
    fn materials(&mut self) -> Vec<(SavedMaterial, String)> {
        let mut found: Vec<(SavedMaterial, String)> = Vec::new();
        let mut names = Names::default();
        for part in &self.rotor.shaft {
            if found.iter().all(|(known, _)| !same_material(known, &part.material)) {
                found.push((part.material.clone(), names.of(&part.material.name)));
            }
        }
        for (material, name) in &found {
            if material.density == 0.0 {
                let why = "a shaft without mass is no machine here: every node needs inertia";
                self.leave_out(&format!("{}: rho", material.name), why);
            }
            self.text.table(&format!("[material.{name}]"));
            self.text.quantity("young", material.young, "Pa");
            self.text.quantity("shear", material.shear, "Pa");
            self.text.quantity("density", material.density, "kg/m^3");
            *self.counts.entry(("Material", "[material.x]")).or_insert(0) += 1;
        }
        found
    }

    fn section(&mut self, header: &str, part: &ShaftPart, material: Option<String>) {
        self.text.table(header);
        self.text.comment(&part.name);
        if header.contains("layer") {
            self.text.quantity("from", self.z[part.node], "m");
            self.text.quantity("to", self.z[part.node + 1], "m");
        } else {
            self.text.quantity("length", part.length, "m");
        }
        for (key, ends) in [("outer_diameter", part.outer), ("inner_diameter", part.inner)] {
            if ends != [0.0; 2] {
                self.text.quantity(key, ends[0], "m");
            }
            if ends[1] != ends[0] {
                self.text.quantity(&format!("{key}_end"), ends[1], "m");
            }
        }
        if let Some(material) = material {
            self.text.text("material", &material);
        }
        match (part.shear_effects, part.shear_method.as_str()) {
            (false, _) => self.text.text("shear", "none"),
            (true, "hutchinson") => {
                self.text.comment(
                    "Hutchinson's coefficient as ROSS computes it, 1 + nu less than \"hutchinson\" here",
                );
                self.text.raw("shear", &number(hutchinson_of_ross(part)));
            }
            (true, "cowper") => {}
            (true, other) => {
                let why = format!("the shear coefficient {other:?} is not known; Cowper's is used");
                self.leave_out(&format!("{}: shear_method_calc", part.name), why);
            }
        }
        if !part.rotary_inertia {
            self.text.raw("rotary_inertia", "false");
        }
        if !part.gyroscopic {
            let why = "gyroscopic = false: here every section has its gyroscopic moment";
            self.leave_out(&format!("{}: gyroscopic", part.name), why);
        }
        for (key, value, unit) in [("axial_force", part.axial_force, "N"), ("torque", part.torque, "N m")] {
            if value != 0.0 {
                self.text.quantity(key, value, unit);
            }
        }
        if self.rotor.proportional == [0.0; 2] {
            for (key, value, unit) in [
                ("mass_damping", part.proportional[0], "1/s"),
                ("stiffness_damping", part.proportional[1], "s"),
            ] {
                if value != 0.0 {
                    self.text.quantity(key, value, unit);
                }
            }
        }
    }

    fn coupling(&mut self, coupling: &Coupling) {
        let name = self.bushings.of(tag(&coupling.name));
        for (side, [mass, polar, diametral]) in coupling.ends.into_iter().enumerate() {
            let half = if side == 0 { "left" } else { "right" };
            let tag = format!("{name}_{half}");
            self.disc(
                &format!("{}, {half} half", coupling.name),
                &tag,
                coupling.node + side,
                [mass, polar, diametral],
            );
        }
        let matrix = |axes: &[f64; 6]| [0, 1, 2, 3, 4, 5].map(|i| (i, axes[i]));
        if coupling.stiffness.iter().chain(&coupling.damping).any(|v| *v != 0.0) {
            self.text.table(&format!("[bushing.{name}]"));
            self.text.comment(&coupling.name);
            let [a, b] = [coupling.node, coupling.node + 1];
            self.text.raw("between", &format!("[\"station.n{a}\", \"station.n{b}\"]"));
            self.text.raw("lever_arms", "false");
            let global = self.rotor.proportional != [0.0; 2];
            for (letter, axes, units) in [
                ('k', &coupling.stiffness, ["N/m", "N m/rad"]),
                ('c', &coupling.damping, ["N s/m", "N m s/rad"]),
            ] {
                for (i, value) in
                    matrix(axes).into_iter().filter(|(_, v)| *v != 0.0 && (letter == 'k' || !global))
                {
                    let key = ["x", "y", "z", "tilt_x", "tilt_y", "spin"][i];
                    self.text.quantity(&format!("{letter}_{key}"), value, units[usize::from(i > 2)]);
                }
            }
        }
        self.count("CouplingElement", "[[shaft.section]] with gap, [bushing.x], two [disc.x]");
    }
}

fn same_material(a: &SavedMaterial, b: &SavedMaterial) -> bool {
    a.young == b.young && a.shear == b.shear && a.density == b.density
}
