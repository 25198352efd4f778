//! Random plausible machines: warnings only where their criterion, recomputed here, holds.

use crate::machines::Description;
use crate::warnings_of;
use rayon::prelude::*;
use rotordyn::model::study::EquilibriumStudy;
use rotordyn::model::{self, Options};
use rotordyn::study::Machine;

/// Machines drawn; `ROTORDYN_MACHINES` for another number.
const COUNT: u64 = 2000;

/// Uniform numbers in [0, 1) (SplitMix64).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[(self.unit() * list.len() as f64) as usize]
    }
}

/// A rotor between or beside two deep groove bearings with a wave spring, or on two given stiffnesses.
fn machine(seed: u64) -> Description {
    let mut random = Random(seed);
    let (designation, bore) = random.of(&[
        ("6204", 20.0),
        ("6205", 25.0),
        ("6206", 30.0),
        ("6208", 40.0),
        ("6210", 50.0),
        ("6212", 60.0),
        ("6306", 30.0),
        ("6308", 40.0),
        ("6310", 50.0),
        ("6008", 40.0),
        ("6010", 50.0),
    ]);
    let middle = bore * random.within(1.15, 1.5);
    let (front, span, rear) =
        (bore * random.within(1.5, 4.0), bore * random.within(5.0, 10.0), bore * random.within(1.0, 2.5));
    let force = bore * random.within(6.0, 12.0);
    let (a, b) = (front - 0.5 * bore, front + span + 0.5 * bore);
    let thickness = bore * random.within(0.4, 1.0);
    let diameter = bore * random.within(3.0, 7.0);
    let disc = if random.unit() < 0.5 {
        ("wheel", 0.5 * thickness.min(front - bore), diameter, 0.6 * thickness)
    } else {
        ("core", front + span * random.within(0.3, 0.7), diameter, thickness)
    };
    let fixed = format!("model = \"ball\"\ndesignation = \"{designation}\"\n");
    let floating = format!(
        "{fixed}thrust = \"+z\"\npreload = {{ force = \"{force:.1} N\", spring = \"{:.0} N/m\" }}\n",
        force / random.within(2e-3, 4e-3)
    );
    let mass = 7850.0 * 0.785e-9 * (diameter * diameter * disc.3 + middle * middle * (front + span + rear));
    let rpm = random.within(0.02, 0.15) * 1e6 / bore;
    let grade = random.of(&[1.0, 2.5, 6.3]);
    // U = G m/Ω, in g mm.
    let unbalance = grade * mass / (rpm * 0.10472) * 1e3;
    Description {
        name: "random",
        sections: vec![[front, bore], [span, middle], [rear + bore, bore]],
        bearings: vec![("A", a, fixed), ("B", b, floating)],
        discs: vec![disc],
        unbalance,
        rpm,
        gravity: "9.81 m/s^2",
        more: String::new(),
    }
}

/// Whether a bearing with unloaded balls carries less than 0.025 (ν n/1000)^(2/3) (D_pw/100)² kN (ν of ISO 281 for its
/// speed), from the ball loads of the equilibrium.
fn below_minimum_load(machine: &Machine, name: &str, rpm: f64) -> bool {
    let study = EquilibriumStudy { speed: rpm * std::f64::consts::TAU / 60.0, cage_average: false };
    let state = machine.equilibrium(&study).unwrap();
    let k = machine.model.bearings.iter().position(|site| site.name == name).unwrap();
    let g = &machine.model.bearings[k].bearing.ball().unwrap().geometry;
    let dm = 1e3 * g.pitch_diameter;
    let viscosity =
        if rpm < 1000.0 { 45000.0 * rpm.powf(-0.83) / dm.sqrt() } else { 4500.0 / (rpm * dm).sqrt() };
    let minimum = 25.0 * (viscosity * rpm / 1e3).powf(2.0 / 3.0) * (dm / 100.0).powi(2);
    let contacts = &state.bearings[k].balls;
    let force = state.bearings[k].force;
    // The dynamic equivalent load is between the radial load and radial plus twice the axial load.
    let least = force[0].hypot(force[1]);
    contacts.iter().any(|contact| contact.load <= 0.0) && least < 1.05 * minimum
}

#[test]
fn warnings_of_random_machines_are_deserved() {
    let count = std::env::var("ROTORDYN_MACHINES").ok().and_then(|n| n.parse().ok()).unwrap_or(COUNT);
    let undeserved: Vec<String> = (0..count)
        .into_par_iter()
        .flat_map_iter(|seed| {
            let described = machine(seed);
            let text = described.text();
            let found = warnings_of(&text);
            let loaded = model::load("random.toml", &text, &Options::default()).unwrap();
            let machine = Machine::new(loaded.model).unwrap();
            let wrong = found.into_iter().filter(move |warning| {
                let name = warning.item.trim_start_matches("bearing.");
                match warning.code.name() {
                    "minimum-load" => !below_minimum_load(&machine, name, described.rpm),
                    _ => true,
                }
            });
            wrong
                .map(move |warning| format!("{seed} [{}]: {warning}", warning.code.name()))
                .collect::<Vec<_>>()
        })
        .collect();
    println!("{} undeserved warnings of {count} machines", undeserved.len());
    assert!(
        undeserved.len() as f64 <= 0.02 * count as f64,
        "{}",
        undeserved[..undeserved.len().min(30)].join("\n")
    );
}
