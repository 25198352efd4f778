//! Linear bearing: tangents compared with finite differences over its speed table, and power balance.

use rotordyn_bearing::{BearingModel, LinearBearing, LinearBearingRow, Rotation};

fn row(speed: f64, scale: f64) -> LinearBearingRow {
    let entry = |a: usize, b: usize| if a == b { 1e7 } else { 1e5 * (a as f64 - 0.4 * b as f64) };
    let matrix = |factor: f64| std::array::from_fn(|a| std::array::from_fn(|b| factor * scale * entry(a, b)));
    LinearBearingRow { speed, stiffness: matrix(1.0), damping: matrix(1e-4) }
}

#[test]
fn tangents_match_finite_differences_and_power_balances() {
    let table = vec![row(0.0, 1.0), row(100.0, 1.4), row(300.0, 3.0)];
    let element = LinearBearing { table, ..Default::default() }.element();
    let (d, v) = ([1e-5, -2e-5, 3e-6, 1e-4, -2e-4, 5e-5], [1e-3, 2e-3, -1e-3, 0.1, 0.05, -0.02]);
    for speed in [0.0, 60.0, 100.0, 220.0, 400.0] {
        let rotation = Rotation { shaft_speed: speed, ..Rotation::default() };
        let here = element.reaction(&d, &v, &rotation);
        for column in 0..6 {
            // The law is linear: a difference of any size is exact but for round-off.
            let (mut moved, mut faster) = (d, v);
            moved[column] += 1e-3;
            faster[column] += 1e-1;
            let by_d = element.reaction(&moved, &v, &rotation).force;
            let by_v = element.reaction(&d, &faster, &rotation).force;
            for r in 0..6 {
                let k = -(by_d[r] - here.force[r]) / 1e-3;
                let c = -(by_v[r] - here.force[r]) / 1e-1;
                assert!((k - here.stiffness[r][column]).abs() < 1e-8 * 1e7, "K[{r}][{column}] at {speed}");
                assert!((c - here.damping[r][column]).abs() < 1e-8 * 1e7, "C[{r}][{column}] at {speed}");
            }
        }
        // Rate of the stored energy by differences along the motion.
        let at = |t: f64| {
            let q: [f64; 6] = std::array::from_fn(|k| d[k] + v[k] * t);
            element.reaction(&q, &v, &rotation).elastic_energy
        };
        let rate = (at(1e-6) - at(-1e-6)) / 2e-6;
        let work: f64 = here.force.iter().zip(&v).map(|(f, v)| f * v).sum();
        let residual = rate + here.dissipated_power + work - here.parametric_power;
        assert!(residual.abs() < 1e-6 * here.dissipated_power.abs(), "{residual} at {speed}");
    }
}
