//! Point masses, bearings and seals, and links between supports.

use super::writer::{Place, Writer, tag};
use crate::ross::rotor::{AXES, SavedBearing, SavedMass};

/// Stiffness from which a spring stands for a rigid support \[N/m\]: ten thousand times that of the stiffest bearings.
const RIGID: f64 = 1e14;

impl Writer<'_> {
    /// Point masses: bodies on nodes of their own, else masses on the shaft or on those bodies.
    pub fn supports(&mut self) {
        let mut written = Vec::new();
        for mass in &self.rotor.masses {
            match self.bodies.get(&mass.node).cloned() {
                Some(name) if !written.contains(&mass.node) => {
                    written.push(mass.node);
                    self.body(mass, &name);
                }
                Some(name) => self.sensor(&mass.name, &format!("body.{name}"), mass.mass),
                None => self.sensor(&mass.name, &format!("station.n{}", mass.node), mass.mass),
            }
        }
    }

    fn body(&mut self, mass: &SavedMass, name: &str) {
        let z = self.support_position(mass.node);
        let [mx, my, mz] = mass.mass;
        self.text.table(&format!("[body.{name}]"));
        self.text.comment(&format!("{}, node {} of ROSS", mass.name, mass.node));
        self.text.quantities("position", &[0.0, 0.0, z], "m");
        let axial = if mz > 0.0 { mz } else { mx };
        let values = if mx == my && my == axial { vec![mx] } else { vec![mx, my, axial] };
        self.text.quantities("mass", &values, "kg");
        self.text.comment("without effect, since it does not turn");
        self.text.quantity("inertia", 1.0, "kg m^2");
        self.text.table(&format!("[joint.{name}]"));
        self.text.comment("a node of a point mass has no rotations in ROSS");
        self.text.raw("between", &format!("[\"body.{name}\", \"ground\"]"));
        if mz > 0.0 {
            self.text.raw("constrain", "[\"tx\", \"ty\", \"tz\"]");
        } else {
            self.text.raw("constrain", "[\"z\", \"tx\", \"ty\", \"tz\"]");
            let why = "no mass along z: it is held there";
            self.leave_out(&format!("{}: mz", mass.name), why);
        }
        self.count("PointMass with a node of its own", "[body.x], [joint.x]");
    }

    /// Position of the shaft node that a support node leads to, over other supports if need be.
    fn support_position(&self, node: usize) -> f64 {
        let mut at = node;
        for _ in 0..=self.bodies.len() {
            if let Some(z) = self.z.get(at) {
                return *z;
            }
            let linked = self.rotor.bearings.iter().find(|b| b.link == Some(at) && b.node != node);
            at = linked.map_or(0, |b| b.node);
        }
        0.0
    }

    fn sensor(&mut self, item: &str, at: &str, mass: [f64; 3]) {
        if mass.iter().any(|m| *m < 0.0) {
            self.leave_out(item, "a negative mass");
            return;
        }
        if mass == [0.0; 3] {
            return;
        }
        let name = self.sensors.of(tag(item));
        self.text.table(&format!("[sensor.{name}]"));
        self.text.comment(item);
        self.text.text("at", at);
        let same = mass.iter().all(|m| *m == mass[0]);
        self.text.quantities("mass", if same { &mass[..1] } else { &mass }, "kg");
        self.count("masses on shaft or supports", "[sensor.x]");
    }

    /// A bearing or seal, with its masses.
    pub fn bearing(&mut self, bearing: &SavedBearing) {
        let [a, b] = [self.place(Some(bearing.node)), self.place(bearing.link)];
        if !bearing.more.is_empty() {
            let keys = bearing.more.join(", ");
            let why = format!("{keys}: only its coefficients are carried over");
            self.leave_out(&bearing.name, why);
        }
        self.bearing_mass(bearing, [a, b]);
        let coefficients = || bearing.stiffness.iter().chain(&bearing.damping);
        if coefficients().flatten().all(|v| *v == 0.0) {
            self.leave_out(&bearing.name, "all its coefficients are zero");
            return;
        }
        if let Some(rest) = self.rigid(bearing, [a, b]) {
            if rest.stiffness.iter().chain(&rest.damping).flatten().any(|v| *v != 0.0) {
                self.bearing(&rest);
            }
            return;
        }
        match (a, b) {
            (Place::Station(node), Place::Ground | Place::Body(_)) => self.on_shaft(bearing, node, b),
            (Place::Body(_), Place::Station(node)) => self.on_shaft(bearing, node, a),
            _ => self.link(bearing, [a, b]),
        }
    }

    /// Springs of a bearing to ground that stand for a rigid support become a joint, which holds exactly: next to them the
    /// stiffness of the shaft is lost in round-off. Returns the rest of the bearing, without masses.
    fn rigid(&mut self, bearing: &SavedBearing, [at, other]: [Place; 2]) -> Option<SavedBearing> {
        // the diagonal in the order of `AXES`
        let diagonal = [(0, "x"), (3, "y"), (4, "z")];
        let is_rigid = |k: usize| bearing.stiffness[k].iter().all(|v| *v >= RIGID);
        let held: Vec<(usize, &str)> = diagonal.into_iter().filter(|(k, _)| is_rigid(*k)).collect();
        let alone = [1, 2]
            .iter()
            .all(|k| bearing.stiffness[*k].iter().chain(&bearing.damping[*k]).all(|v| *v == 0.0));
        if held.is_empty() || !alone || other != Place::Ground {
            return None;
        }
        let name = format!("{}_rigid", self.bearings.of(tag(&bearing.name)));
        let at = self.place_name(at);
        self.text.table(&format!("[joint.{name}]"));
        self.text.comment(&format!("{}: {RIGID:e} N/m or more, held exactly", bearing.name));
        self.text.raw("between", &format!("[\"{at}\", \"ground\"]"));
        let names: Vec<String> = held.iter().map(|(_, axis)| format!("\"{axis}\"")).collect();
        self.text.raw("constrain", &format!("[{}]", names.join(", ")));
        self.count("BearingElement of a rigid support", "[joint.x]");
        let mut rest = bearing.clone();
        for (k, _) in held {
            rest.stiffness[k].fill(0.0);
            rest.damping[k].fill(0.0);
        }
        rest.mass.iter_mut().for_each(|values| values.fill(0.0));
        rest.more.clear();
        Some(rest)
    }

    /// A bearing between shaft and ground or a support.
    fn on_shaft(&mut self, bearing: &SavedBearing, node: usize, housing: Place) {
        let name = self.bearings.of(tag(&bearing.name));
        self.text.table(&format!("[bearing.{name}]"));
        self.text.comment(&bearing.name);
        self.text.text("model", "linear");
        self.text.text("station", &format!("n{node}"));
        if housing != Place::Ground {
            let housing = self.place_name(housing);
            self.text.text("housing", &housing);
        }
        if let Some(speed) = &bearing.speed {
            self.text.quantities("speed", speed, "rad/s");
        }
        if let Some(whirl) = &bearing.whirl {
            self.text.quantities("whirl_frequency", whirl, "rad/s");
        }
        if bearing.speed.is_some() || bearing.whirl.is_some() {
            self.text.text("beyond_table", "extrapolate");
            self.interpolation(bearing);
        }
        self.coefficients(bearing, ["xx", "xy", "yx", "yy", "zz"]);
        self.count(
            if bearing.name.contains("Seal") { "SealElement" } else { "BearingElement" },
            "[bearing.x]",
        );
    }

    fn interpolation(&mut self, bearing: &SavedBearing) {
        let points = [&bearing.speed, &bearing.whirl].map(|axis| axis.as_ref().map_or(0, Vec::len));
        if bearing.interpolation != "pchip" && points.iter().any(|n| *n > 2) {
            let why = format!(
                "interpolation \"{}\": here the table is interpolated by monotone cubics (PCHIP), as ROSS 3 does",
                bearing.interpolation
            );
            self.leave_out(&bearing.name, why);
        }
    }

    /// Springs and dampers that do not end on the shaft and a support.
    fn link(&mut self, bearing: &SavedBearing, ends: [Place; 2]) {
        if bearing.speed.is_some() || bearing.whirl.is_some() {
            let why =
                "coefficients over speed or frequency between places other than the shaft and a support";
            self.leave_out(&bearing.name, why);
            return;
        }
        let name = self.bushings.of(tag(&bearing.name));
        let [a, b] = ends.map(|end| self.place_name(end));
        self.text.table(&format!("[bushing.{name}]"));
        self.text.comment(&bearing.name);
        self.text.raw("between", &format!("[\"{a}\", \"{b}\"]"));
        if !ends.contains(&Place::Ground) {
            self.text.raw("lever_arms", "false");
        }
        if bearing.stiffness[1] != bearing.stiffness[2] || bearing.damping[1] != bearing.damping[2] {
            self.text.raw("unsymmetric", "true");
        }
        self.coefficients(bearing, ["x", "xy", "yx", "y", "z"]);
        self.count("BearingElement of a support", "[bushing.x]");
    }

    fn coefficients(&mut self, bearing: &SavedBearing, keys: [&str; 5]) {
        for (letter, table, unit) in [("k", &bearing.stiffness, "N/m"), ("c", &bearing.damping, "N s/m")] {
            for (axes, values) in keys.iter().zip(table) {
                if values.iter().any(|v| *v != 0.0) {
                    let same = values.iter().all(|v| *v == values[0]);
                    let values = if same { &values[..1] } else { &values[..] };
                    self.text.quantities(&format!("{letter}_{axes}"), values, unit);
                }
            }
        }
    }

    /// Mass coefficients: constant and without coupling of the axes they are a mass on the shaft.
    fn bearing_mass(&mut self, bearing: &SavedBearing, [at, other]: [Place; 2]) {
        let [xx, xy, yx, yy, zz] = &bearing.mass;
        if bearing.mass.iter().flatten().all(|v| *v == 0.0) {
            return;
        }
        let constant = bearing.mass.iter().all(|values| values.iter().all(|v| *v == values[0]));
        let coupled = xy.iter().chain(yx).any(|v| *v != 0.0);
        if !constant || coupled || other != Place::Ground {
            let names: Vec<String> = AXES.iter().map(|axes| format!("m{axes}")).collect();
            let why = "masses over speed, between axes or between two nodes";
            self.leave_out(&format!("{}: {}", bearing.name, names.join(", ")), why);
            return;
        }
        let at = self.place_name(at);
        self.sensor(&bearing.name, &at, [xx[0], yy[0], zz[0]]);
    }
}
