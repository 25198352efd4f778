//! Machines whose pictures are tested, drawn by the studies themselves.

use std::collections::BTreeMap;

use rotordyn::model::{Options, load};
use rotordyn::results::Results;
use rotordyn::study::Machine;
use rotordyn::{figures, plot::Figure};

/// Two housings on soft axial springs, shaft axially located elsewhere: their axial modes move no shaft.
pub const PEDESTALS: &str = r#"
[model]
name = "fan"
title = "Fan between sliding pedestals"
[material.steel]
young = "206 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[shaft]
material = "steel"
element_length = "60 mm"
section = [
    { length = "120 mm", outer_diameter = "35 mm" },
    { length = "600 mm", outer_diameter = "55 mm", inner_diameter = "20 mm" },
    { length = "120 mm", outer_diameter = "35 mm" },
]
[station]
left = "60 mm"
hub = "420 mm"
right = "780 mm"
[disc.wheel]
station = "hub"
mass = "25 kg"
polar_inertia = "0.6 kg m^2"
diametral_inertia = "0.31 kg m^2"
outer_diameter = "440 mm"
thickness = "40 mm"
[housing.left]
station = "left"
mass = "9 kg"
inertia = "0.05 kg m^2"
k_x = "1.5e7 N/m"
k_y = "3e7 N/m"
k_z = "1e6 N/m"
k_tilt = "3e5 N m/rad"
k_spin = "4e5 N m/rad"
c_x = "500 N s/m"
[housing.right]
station = "right"
mass = "7 kg"
inertia = "0.04 kg m^2"
k_x = "1.5e7 N/m"
k_y = "3e7 N/m"
k_z = "1.4e6 N/m"
k_tilt = "3e5 N m/rad"
k_spin = "4e5 N m/rad"
[bearing.left]
station = "left"
housing = "housing.left"
model = "linear"
k_xx = "8e7 N/m"
k_yy = "8e7 N/m"
[bearing.right]
station = "right"
housing = "housing.right"
model = "linear"
k_xx = "8e7 N/m"
k_yy = "8e7 N/m"
[bushing.thrust]
between = ["hub", "ground"]
k_z = "4e7 N/m"
c_z = "200 N s/m"
[unbalance.wheel]
station = "hub"
magnitude = "60 g mm"
[drive]
kind = "prescribed"
station = "left"
[probe.wheel_x]
at = "disc.wheel"
direction = "x"
[probe.wheel_y]
at = "disc.wheel"
direction = "y"
[study.static]
[study.modal]
speeds = "3000 rpm"
modes = 14
[study.campbell]
speeds = { from = "0 rpm", to = "12000 rpm", step = "500 rpm" }
modes = 12
orders = [1, 2, 3]
[study.frf]
speed = "3000 rpm"
frequencies = { from = "5 Hz", to = "400 Hz", step = "2 Hz" }
excitation.wheel = { at = "disc.wheel", direction = "x" }
[study.unbalance]
speeds = { from = "500 rpm", to = "12000 rpm", step = "100 rpm" }
"#;

/// A pair, a linear bearing, a damper, a pin, and a foundation below the shaft.
pub const SPINDLE: &str = r#"
[model]
name = "spindle"
title = "Spindle with a duplex pair on a foundation"
[material.steel]
young = "210 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[shaft]
material = "steel"
element_length = "25 mm"
section = [
    { length = "60 mm", outer_diameter = "30 mm", inner_diameter = "12 mm" },
    { length = "100 mm", outer_diameter = "30 mm", outer_diameter_end = "45 mm", inner_diameter = "12 mm" },
    { length = "220 mm", outer_diameter = "45 mm" },
]
[station]
front = "30 mm"
middle = "160 mm"
rear = "300 mm"
end = "380 mm"
[disc.rotor]
station = "middle"
outer_diameter = "140 mm"
inner_diameter = "45 mm"
thickness = "30 mm"
material = "steel"
[body.foundation]
station = "middle"
offset = "0, -150, 0 mm"
mass = "80 kg"
inertia = "0.9, 0.6, 1.2 kg m^2"
[bushing.feet]
between = ["body.foundation", "ground"]
k_x = "3e7 N/m"
k_y = "5e7 N/m"
k_z = "2e7 N/m"
k_txtx = "2e5 N m/rad"
k_tyty = "2e5 N m/rad"
k_tztz = "2e5 N m/rad"
[bushing.air]
between = ["middle", "ground"]
c_x = "20 N s/m"
c_y = "20 N s/m"
[bearing.front]
station = "front"
housing = "body.foundation"
model = "ball"
designation = "7206B"
arrangement = "back_to_back"
row_spacing = "16 mm"
preload = { force = "150 N" }
[bearing.rear]
station = "rear"
model = "linear"
k_xx = "4e7 N/m"
k_yy = "4e7 N/m"
c_xx = "300 N s/m"
c_yy = "300 N s/m"
[joint.end]
between = ["end", "ground"]
constrain = ["x", "y"]
[drive]
kind = "prescribed"
station = "end"
[study.static]
[study.modal]
speeds = "3000 rpm"
modes = 12
[study.campbell]
speeds = { from = "0 rpm", to = "20000 rpm", step = "1000 rpm" }
modes = 10
orders = [1, 2]
"#;

pub fn machine(text: &str) -> Machine {
    let loaded = load("machine.toml", text, &Options::default()).unwrap_or_else(|e| panic!("{e}"));
    Machine::new(loaded.model).unwrap()
}

/// Results of the linear studies of a machine's file.
pub fn results(machine: &Machine) -> Results {
    let studies = &machine.model.studies;
    Results {
        equilibrium: studies.equilibrium.as_ref().map(|s| machine.equilibrium(s).unwrap()),
        modal: studies.modal.as_ref().map_or(Vec::new(), |s| machine.modal(s).unwrap()),
        campbell: studies.campbell.as_ref().map(|s| machine.campbell(s).unwrap()),
        frf: studies.frf.as_ref().map(|s| machine.frf(s).unwrap()),
        unbalance: studies.unbalance.as_ref().map(|s| machine.unbalance(s).unwrap()),
        ..Results::default()
    }
}

/// The machine layout alone, as SVG.
pub fn layout(text: &str) -> String {
    pictures_of(&machine(text), &Results::default()).remove("machine_layout").unwrap()
}

/// The machine with its mode shapes alone.
pub fn modes(text: &str) -> (Machine, Results) {
    let machine = machine(text);
    let modal = machine.modal(machine.model.studies.modal.as_ref().unwrap()).unwrap();
    (machine, Results { modal, ..Results::default() })
}

/// Figures of a machine by name, as SVG.
pub fn pictures(text: &str) -> BTreeMap<String, String> {
    let machine = machine(text);
    pictures_of(&machine, &results(&machine))
}

pub fn pictures_of(machine: &Machine, results: &Results) -> BTreeMap<String, String> {
    figures::all(results, machine)
        .unwrap()
        .into_iter()
        .map(|(name, figure): (String, Figure)| (name, figure.svg().unwrap()))
        .collect()
}

/// Contents of the groups of a class, without nested groups of the same class.
pub fn groups<'a>(svg: &'a str, class: &str) -> Vec<&'a str> {
    let start = format!("<g class=\"{class}");
    svg.match_indices(&start)
        .map(|(at, _)| {
            let body = &svg[at..];
            let mut depth = 0;
            for (k, _) in body.match_indices('<') {
                let rest = &body[k..];
                if rest.starts_with("<g ") {
                    depth += 1;
                } else if rest.starts_with("</g>") {
                    depth -= 1;
                    if depth == 0 {
                        return &body[..k];
                    }
                }
            }
            body
        })
        .collect()
}

/// Points of every path of a piece of SVG.
pub fn paths(svg: &str) -> Vec<Vec<[f64; 2]>> {
    svg.split(" d=\"")
        .skip(1)
        .filter_map(|p| p.split('"').next())
        .flat_map(|d| d.split('M').filter(|run| !run.is_empty()).collect::<Vec<_>>())
        .map(|run| {
            let numbers: Vec<f64> = run.split([' ', 'Z']).filter_map(|n| n.parse().ok()).collect();
            numbers.chunks_exact(2).map(|p| [p[0], p[1]]).collect()
        })
        .collect()
}
