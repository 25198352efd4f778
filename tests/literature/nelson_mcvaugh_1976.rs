//! Nelson & McVaugh, "The dynamics of rotor-bearing systems using finite elements", J. Eng. Ind. 98 (1976)
//! 593.
//!
//! Their axes: X along the shaft; Y, Z lateral. Here Y → x, Z → y. Geometry in the exact inches of the
//! original (ross/nelson_mcvaugh_isotropic_rayleigh.json); its printed centimetres are rounded, and with them
//! (I_p = 0.0020) the sixth speed at whirl ratio 1 is 0.6 % low.

use crate::agree;
use crate::ross::{self, number, numbers, read};
use rotordyn::analysis::{ModeKind, critical_speed, modal};
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::bearing::SiteTangent;
use std::f64::consts::TAU;

fn support(k: f64, cross: f64) -> SiteTangent {
    let mut tangent = SiteTangent::default();
    tangent.stiffness[0][..2].copy_from_slice(&[k, cross]);
    tangent.stiffness[1][..2].copy_from_slice(&[cross, k]);
    tangent
}

fn assembly() -> Assembly {
    Assembly::new(&ross::model(&read("ross/nelson_mcvaugh_isotropic_rayleigh.json"))).unwrap()
}

#[test]
fn critical_speeds_for_three_whirl_ratios() {
    let figures = read("nelson_mcvaugh_1976.json");
    let assembly = assembly();
    let k = number(&figures["k_isotropic_N_m"]);
    let system = LinearSystem::new(&assembly, &[support(k, 0.0); 2], 0.0).unwrap();
    for (name, order) in
        [("whirl_ratio_1", 1.0), ("whirl_ratio_1/2 (spin speed)", 2.0), ("whirl_ratio_1/4 (spin speed)", 4.0)]
    {
        let theirs = numbers(&figures["critical_speeds_rpm"][name]);
        let ours =
            critical_speed::undamped_critical_speeds(&assembly, &system, order, 1.2e5 / 60.0 * TAU).unwrap();
        let bending: Vec<_> = ours.iter().filter(|c| c.mode.kind.is_bending()).collect();
        for (k, theirs) in theirs.iter().enumerate() {
            // Their list alternates backward and forward: the k-th of its kind.
            let kind = if k % 2 == 0 { ModeKind::Backward } else { ModeKind::Forward };
            let of_kind: Vec<_> = bending.iter().filter(|c| c.mode.kind == kind).collect();
            let rpm = of_kind[k / 2].speed * 60.0 / TAU;
            println!(
                "{name} {kind:?} {}: {rpm:.0} rpm, theirs {theirs}, {:+.3} %",
                k / 2 + 1,
                100.0 * (rpm / theirs - 1.0)
            );
            agree::relative(format_args!("{name}: whirl speed [rpm]"), rpm, *theirs, 0.003);
        }
    }
}

#[test]
fn whirl_speeds_on_orthotropic_supports() {
    let figures = &read("nelson_mcvaugh_1976.json")["orthotropic"];
    let assembly = assembly();
    let support = support(number(&figures["kyy=kzz"]), number(&figures["kyz=kzy"]));
    let system = LinearSystem::new(&assembly, &[support; 2], 1e5 / 60.0 * TAU).unwrap();
    let modes = modal::modes(&assembly, &system, 8).unwrap();
    let bending: Vec<f64> =
        modes.iter().filter(|m| m.kind.is_bending()).map(|m| m.omega() * 60.0 / TAU).collect();
    for (ours, theirs) in bending.iter().zip(numbers(&figures["whirl_cpm_at_100000rpm"])) {
        println!("{ours:.0} cpm, theirs {theirs}, {:+.3} %", 100.0 * (ours / theirs - 1.0));
        agree::relative("critical speed of another program [rpm]", *ours, theirs, 0.003);
    }
}
