//! Fifteen plausible machines of industry, as text of model files.

/// A machine by its shaft, bearings, discs and speed.
#[derive(Clone)]
pub struct Description {
    pub name: &'static str,
    /// Length and diameter of every section \[mm\].
    pub sections: Vec<[f64; 2]>,
    /// Name, position \[mm\] and keys of every bearing.
    pub bearings: Vec<(&'static str, f64, String)>,
    /// Name, position, diameter, thickness \[mm\].
    pub discs: Vec<(&'static str, f64, f64, f64)>,
    /// Unbalance of every disc \[g mm\].
    pub unbalance: f64,
    pub rpm: f64,
    /// Gravity as in the file.
    pub gravity: &'static str,
    /// Further tables.
    pub more: String,
}

pub const DOWN: &str = "9.81 m/s^2";
/// Shaft vertical, so that gravity is axial.
const VERTICAL: &str = "0, 0, -9.81 m/s^2";

impl Description {
    /// The text of the model file.
    pub fn text(&self) -> String {
        let sections: Vec<String> = self
            .sections
            .iter()
            .map(|[l, d]| format!("{{ length = \"{l} mm\", outer_diameter = \"{d} mm\" }}"))
            .collect();
        let mut out = format!(
            "[model]\nname = \"{}\"\ngravity = \"{}\"\n[material.steel]\nyoung = \"210 GPa\"\npoisson = 0.3\n\
             density = \"7850 kg/m^3\"\n[shaft]\nmaterial = \"steel\"\nelement_length = \"15 mm\"\nsection = [{}]\n\
             [station]\n",
            self.name,
            self.gravity,
            sections.join(", ")
        );
        for (name, z, ..) in &self.bearings {
            out += &format!("{name} = \"{z} mm\"\n");
        }
        for (name, z, ..) in &self.discs {
            out += &format!("at_{name} = \"{z} mm\"\n");
        }
        for (name, _, keys) in &self.bearings {
            out += &format!("[bearing.{name}]\nstation = \"{name}\"\n{keys}\n");
        }
        for (name, _, diameter, thickness) in &self.discs {
            out += &format!(
                "[disc.{name}]\nstation = \"at_{name}\"\nouter_diameter = \"{diameter} mm\"\nthickness = \"{thickness} mm\"\n\
                 material = \"steel\"\n[unbalance.{name}]\nstation = \"at_{name}\"\nmagnitude = \"{} g mm\"\n",
                self.unbalance
            );
        }
        out += &format!(
            "[speed]\nprofile = \"ramp\"\nramp = \"2 s\"\nto = \"{} rpm\"\n[drive]\nkind = \"prescribed\"\n\
             [study.modal]\nspeeds = \"0, {} rpm\"\nmodes = 6\n{}",
            self.rpm, self.rpm, self.more
        );
        out
    }
}

/// The bearing that locates the shaft.
pub fn fixed(designation: &str) -> String {
    format!("model = \"ball\"\ndesignation = \"{designation}\"\n")
}

/// The bearing whose outer ring slides, pushed by a wave spring towards the other.
pub fn floating(designation: &str, thrust: &str, force: f64) -> String {
    format!(
        "{}thrust = \"{thrust}\"\npreload = {{ force = \"{force} N\", spring = \"{:.0} N/m\" }}\n",
        fixed(designation),
        force / 3e-3
    )
}

/// A duplex pair back to back with light preload.
pub fn pair(designation: &str, spacing: f64, preload: f64) -> String {
    format!(
        "{}arrangement = \"back_to_back\"\nrow_spacing = \"{spacing} mm\"\npreload = {{ dry_force = \"{preload} N\" }}\n",
        fixed(designation)
    )
}

/// A bearing given by stiffness and damping, as of a journal bearing or a measured one.
pub fn linear(k: f64, c: f64, axial: bool) -> String {
    let axial = if axial { "k_zz = \"1e7 N/m\"\n" } else { "" };
    format!(
        "model = \"linear\"\nk_xx = \"{k} N/m\"\nk_yy = \"{k} N/m\"\nc_xx = \"{c} N s/m\"\nc_yy = \"{c} N s/m\"\n{axial}"
    )
}

/// Motors, fans, pumps, spindles, vertical pumps, two-disc rotors and test rigs, each in two sizes or speeds.
pub fn all() -> Vec<Description> {
    let motor = |name, designation: &str, bore: f64, core: f64, length: f64, force, rpm, unbalance| {
        let seat = 0.6 * bore;
        let a = 1.5 * bore;
        Description {
            name,
            sections: vec![[a, bore], [length, core], [seat + bore, bore]],
            bearings: vec![
                ("A", a - seat, fixed(designation)),
                ("B", a + length + seat, floating(designation, "+z", force)),
            ],
            discs: vec![("core", a + 0.5 * length, 2.5 * core, 0.6 * length)],
            unbalance,
            rpm,
            gravity: DOWN,
            more: String::new(),
        }
    };
    let overhung =
        |name, designation: &str, bore: f64, disc: f64, force, rpm, unbalance, gravity| Description {
            name,
            sections: vec![
                [1.2 * bore, 0.9 * bore],
                [3.0 * bore, bore],
                [6.0 * bore, 1.25 * bore],
                [1.5 * bore, bore],
            ],
            bearings: vec![
                ("A", 3.8 * bore, fixed(designation)),
                ("B", 10.8 * bore, floating(designation, "+z", force)),
            ],
            discs: vec![("wheel", 0.6 * bore, disc, 0.5 * bore)],
            unbalance,
            rpm,
            gravity,
            more: String::new(),
        };
    let spindle = |name, front: &str, rear: &str, bore: f64, force, rpm| Description {
        name,
        sections: vec![[bore, 1.2 * bore], [2.5 * bore, bore], [2.5 * bore, bore - 10.0]],
        bearings: vec![
            ("front", 1.6 * bore, pair(front, 0.3 * bore, force)),
            ("rear", 5.2 * bore, pair(rear, 0.3 * bore, force)),
        ],
        discs: vec![("chuck", 0.4 * bore, 2.0 * bore, 0.5 * bore)],
        unbalance: 5.0,
        rpm,
        gravity: DOWN,
        more: String::new(),
    };
    let two_discs = |name, k, c, rpm| Description {
        name,
        sections: vec![[1000.0, 40.0]],
        bearings: vec![("A", 50.0, linear(k, c, true)), ("B", 950.0, linear(k, c, false))],
        discs: vec![("one", 350.0, 250.0, 30.0), ("two", 650.0, 220.0, 30.0)],
        unbalance: 40.0,
        rpm,
        gravity: DOWN,
        more: String::new(),
    };
    let rig = |name, overhang: f64, rpm| Description {
        name,
        sections: vec![[600.0 + overhang, 25.0]],
        bearings: vec![("A", 100.0, floating("6205", "-z", 200.0)), ("B", 500.0, fixed("6205"))],
        discs: vec![("disc", 560.0 + overhang, 200.0, 20.0)],
        unbalance: 20.0,
        rpm,
        gravity: DOWN,
        more: String::new(),
    };
    vec![
        motor("motor_small", "6205", 25.0, 35.0, 160.0, 180.0, 1500.0, 30.0),
        motor("motor_large", "6312", 60.0, 80.0, 420.0, 900.0, 3000.0, 150.0),
        overhung("fan_small", "6206", 30.0, 300.0, 300.0, 1450.0, 60.0, DOWN),
        overhung("fan_large", "6216", 80.0, 700.0, 1500.0, 980.0, 900.0, DOWN),
        overhung("pump_small", "6306", 30.0, 160.0, 350.0, 2950.0, 20.0, DOWN),
        overhung("pump_large", "6313", 65.0, 350.0, 1200.0, 1480.0, 200.0, DOWN),
        spindle("spindle_small", "7008C", "7006C", 40.0, 150.0, 6000.0),
        spindle("spindle_large", "7014C", "7012C", 70.0, 400.0, 4000.0),
        overhung("vertical_small", "6306", 30.0, 160.0, 500.0, 2950.0, 20.0, VERTICAL),
        overhung("vertical_large", "6310", 50.0, 260.0, 900.0, 1480.0, 100.0, VERTICAL),
        two_discs("two_discs_soft", 5e6, 2000.0, 3000.0),
        two_discs("two_discs_stiff", 5e7, 5000.0, 6000.0),
        rig("rig_short", 0.0, 1200.0),
        rig("rig_long", 100.0, 1000.0),
        motor("gear_shaft", "6209", 45.0, 60.0, 300.0, 500.0, 1480.0, 80.0),
    ]
}
