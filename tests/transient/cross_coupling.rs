//! Work of cross-coupled stiffness, the same for an unsymmetric bushing and for a linear bearing in its place.

use std::ops::ControlFlow;

use rotordyn::model::{Options, load};
use rotordyn::study::Machine;
use rotordyn::transient::energy::Energy;

/// A rotor with a seal in the middle, and its energies after a run of 0.1 s in steps of 50 us.
fn energy_with(seal: &str) -> Energy {
    energy_in_steps(seal, "step = \"50 us\"")
}

/// The same with other keys of the run.
fn energy_in_steps(seal: &str, keys: &str) -> Energy {
    let bearing = |name: &str| {
        format!(
            "[bearing.{name}]\nstation = \"{name}\"\nmodel = \"linear\"\nk_x = \"1e7 N/m\"\nk_y = \"1e7 N/m\"\n\
             k_z = \"1e7 N/m\"\nc_x = \"3e3 N s/m\"\nc_y = \"3e3 N s/m\"\n"
        )
    };
    let text = format!(
        "[model]\nname = \"seal\"\ngravity = \"0 m/s^2\"\n[material.steel]\nyoung = \"207 GPa\"\npoisson = 0.3\n\
         density = \"7850 kg/m^3\"\n[shaft]\nelement_length = \"100 mm\"\n\
         section = [{{ length = \"1 m\", outer_diameter = \"60 mm\" }}]\n[station]\nA = \"0 mm\"\nmid = \"500 mm\"\n\
         B = \"1 m\"\n{}{}{seal}\n[unbalance.u]\nstation = \"mid\"\nmagnitude = \"1000 g mm\"\n[speed]\n\
         profile = \"constant\"\nspeed = \"3000 rpm\"\nduration = \"0.1 s\"\n[study.run_up]\n{keys}\n",
        bearing("A"),
        bearing("B")
    );
    let loaded = load("seal.toml", &text, &Options::default()).unwrap_or_else(|errors| panic!("{errors:?}"));
    let study = loaded.model.studies.run_up.clone().unwrap();
    let machine = Machine::new(loaded.model).unwrap();
    let reduction = machine.reduce(&study).unwrap();
    machine.run_up(&study, &reduction, |_| ControlFlow::Continue(())).energy
}

#[test]
fn the_work_of_a_seal_is_in_the_balance() {
    let stiffness = "k_x = \"5e5 N/m\"\nk_y = \"5e5 N/m\"\nk_xy = \"2e5 N/m\"\nk_yx = \"-2e5 N/m\"\nc_x = \"3000 N s/m\"\n\
                     c_y = \"3000 N s/m\"";
    let bushing = energy_with(&format!(
        "[bushing.seal]\nbetween = [\"mid\", \"ground\"]\nunsymmetric = true\n{stiffness}"
    ));
    let bearing = energy_with(&format!("[bearing.seal]\nstation = \"mid\"\nmodel = \"linear\"\n{stiffness}"));
    for found in [&bushing, &bearing] {
        assert!(found.residual().abs() < 1e-3 * found.exchanged(), "{found:?}");
    }
    assert!(bearing.parametric > 0.02 * bearing.work, "{bearing:?}");
    let work = [&bushing, &bearing].map(|found| found.work + found.parametric);
    assert!((work[0] / work[1] - 1.0).abs() < 1e-4, "{work:?}");
    assert!(bushing.parametric == 0.0, "{bushing:?}");
}

/// With all damping in linear bearings a step of 0.5 ms, a 40th of a revolution, leaves the balance closed: work of the loads and losses
/// are low by the same sin(Ωh)/(Ωh). Sums of powers beside it would leave (Ωh/2)², 0.6 %. Newmark's method has the balance exactly.
#[test]
fn the_balance_closes_at_long_steps() {
    for (integrator, bound) in [("newmark", 1e-9), ("fitted-newmark", 2e-3)] {
        let keys = format!("step = \"500 us\"\nintegrator = \"{integrator}\"\nsample_rate = \"2 kHz\"");
        let found = energy_in_steps("", &keys);
        let share = found.residual() / found.exchanged();
        println!("{integrator}: {share:.1e}");
        assert!(share.abs() < bound, "{integrator}: {share}");
    }
}
