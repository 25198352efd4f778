//! The run-up of ROSS 3.1.0's Jeffcott rotor through its first critical speed (runup_jeffcott.json).
//!
//! Integrated as there: Newmark γ = ½, β = ¼, dt = 1e-4 s, from rest; once with ROSS's terms of angular
//! acceleration, once with ours, once without.

use crate::agree;
use crate::ross::{self, number, numbers, read};
use rotordyn::assembly::{Assembly, LinearSystem, SpinUpForm};
use rotordyn::element::Anchor;
use rotordyn::element::shaft_matrices::ConeRule;
use rotordyn::linalg::BandLayout;
use rotordyn::model::{Drive, Unbalance};
use serde_json::Value;

/// x and y of the probed nodes at every stored sample.
fn run_up(case: &Value, form: SpinUpForm) -> Vec<[Vec<f64>; 2]> {
    let mut model = ross::model(&read("ross/jeffcott.json"));
    model.drive = Drive::Prescribed { node: Some(0) };
    model.unbalances = vec![Unbalance {
        name: "unbalance".into(),
        node: case["unbalance"]["node"].as_u64().unwrap() as usize,
        magnitude: number(&case["unbalance"]["magnitude"]),
        phase: number(&case["unbalance"]["phase"]),
    }];
    let assembly = Assembly::with_forms(&model, form, ConeRule::ArithmeticMean).unwrap();
    let system = LinearSystem::new(&assembly, &ross::tangents(&model, 0.0), 0.0).unwrap();
    let (m, c, k) = (&system.mass, &system.damping, &system.stiffness);
    let (g, ks) = (&assembly.gyroscopic, &assembly.spin_up);

    let lateral: Vec<usize> = assembly.unbalances[0].x.0.iter().map(|&(i, _)| i).collect();
    let layout = BandLayout::new(&[m, c, k, g, ks]).restricted_to(&lateral);
    let [mb, cb, kb, gb, ksb] = [m, c, k, g, ks].map(|a| layout.scatter(a));
    let mut lu = layout.workspace::<f64>();

    let probes: Vec<usize> =
        case["probes"].as_array().unwrap().iter().map(|p| p["node"].as_u64().unwrap() as usize).collect();
    let rows: Vec<_> = probes.iter().map(|&n| assembly.anchor_rows(&Anchor::node(n))).collect();
    let mut out = vec![[vec![0.0], vec![0.0]]; probes.len()];
    let (dt, steps) = (number(&case["dt"]), case["steps"].as_u64().unwrap() as usize);
    let every = case["decimation"].as_u64().unwrap() as usize;
    let ramp = &case["ramp"];
    let rate = (number(&ramp["speed1"]) - number(&ramp["speed0"])) / number(&ramp["T"]);

    let n = layout.size();
    let (mut q, mut v, mut a) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for step in 1..steps {
        let t = step as f64 * dt;
        let speed = rate * t;
        let (half, quarter) = (0.5 * dt, 0.25 * dt * dt);
        lu.refactor(|i| mb[i] + half * (cb[i] + speed * gb[i]) + quarter * (kb[i] + rate * ksb[i])).unwrap();
        for i in 0..n {
            q[i] += dt * v[i] + quarter * a[i];
            v[i] += half * a[i];
        }
        let mut f = vec![0.0; n];
        assembly.add_unbalance(0.5 * rate * t * t, speed, rate, &mut f);
        for (matrix, factor, x) in [(c, 1.0, &v), (g, speed, &v), (k, 1.0, &q), (ks, rate, &q)] {
            matrix.mul_add(-factor, x, &mut f);
        }
        // Only the lateral unknowns are solved for; nothing else is loaded.
        lu.solve(&mut f);
        a = f;
        for i in 0..n {
            q[i] += quarter * a[i];
            v[i] += half * a[i];
        }
        if step % every == 0 {
            for (out, rows) in out.iter_mut().zip(&rows) {
                out[0].push(rows[0].dot(&q));
                out[1].push(rows[1].dot(&q));
            }
        }
    }
    out
}

/// Largest distance of two trajectories.
fn distance(a: &[Vec<f64>; 2], b: &[Vec<f64>; 2]) -> f64 {
    assert_eq!(a[0].len(), b[0].len());
    (0..a[0].len()).map(|i| (a[0][i] - b[0][i]).hypot(a[1][i] - b[1][i])).fold(0.0, f64::max)
}

#[test]
fn run_up_agrees_and_spin_up_forms_differ_little() {
    let case = read("ross/runup_jeffcott.json");
    let theirs = run_up(&case, SpinUpForm::Ross);
    let ours = run_up(&case, SpinUpForm::EnergyConsistent);
    let none = run_up(&case, SpinUpForm::None);
    for (p, probe) in case["probes"].as_array().unwrap().iter().enumerate() {
        let reference = [numbers(&probe["x"]), numbers(&probe["y"])];
        let peak = number(&case["peak"][p]["max_r"]);
        let off = distance(&theirs[p], &reference) / peak;
        let differ = distance(&ours[p], &theirs[p]) / peak;
        let left_out = distance(&none[p], &theirs[p]) / peak;
        println!(
            "node {}: ROSS's form differs from ROSS by {off:.1e} of the peak; ours from ROSS's form by {differ:.1e}; none by {left_out:.1e}",
            probe["node"]
        );
        // The same equations and integrator: round-off over 40 000 steps.
        agree::curve(format_args!("run-up of node {}", probe["node"]), off, 1.0, 1e-6);
        let step = number(&case["dt"]) * number(&case["decimation"]);
        let time: Vec<f64> = (0..reference[0].len()).map(|k| k as f64 * step).collect();
        let over = agree::Over { name: "time", unit: "s", values: &time };
        let radius =
            |of: &[Vec<f64>; 2]| -> Vec<f64> { of[0].iter().zip(&of[1]).map(|(x, y)| x.hypot(*y)).collect() };
        let what = format_args!("run-up of node {}: distance from the axis", probe["node"]);
        agree::curves(what, "m", over, &radius(&theirs[p]), &radius(&reference), 1e-6);
        // ROSS's own value for dropping its terms.
        let dropped = number(&case["max_abs_diff_if_Ksdt_is_dropped"][probe["node"].to_string()]) / peak;
        agree::relative("what is left out without the spin-up terms, over the peak", left_out, dropped, 0.05);
        assert!(differ > 0.0 && differ < 5e-4, "{differ:e}");
    }
}
