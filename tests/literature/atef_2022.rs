//! Atef et al. 2022: ball-pass frequencies, contacts at rest and the balls' centrifugal force of
//! models/atef_2022.toml, by the ids of tests/data/atef_2022.json (an independent program of the same
//! equations).
//!
//! Axes: x and y are the paper's, z is along the shaft; angles from +x, where the load points.

use crate::agree;
use crate::ross::{number, numbers, read};
use rotordyn::model::{self, Model, Options};
use rotordyn::results::BearingPoint;
use rotordyn::study::Machine;
use serde_json::Value;

/// The machine of the model file in one of its variants, with further settings.
pub fn model(variant: &str, set: &[(&str, &str)]) -> Model {
    let options = Options {
        variant: (!variant.is_empty()).then(|| variant.into()),
        set: set.iter().map(|(key, value)| ((*key).to_string(), (*value).to_string())).collect(),
    };
    let text = include_str!("../../models/atef_2022.toml");
    model::load("atef_2022.toml", text, &options).unwrap_or_else(|e| panic!("{variant}: {e}")).model
}

/// Value of a row of the reference by its id.
pub fn reference(id: &str) -> Value {
    let rows = &read("atef_2022.json");
    let found = rows["tight"].as_array().unwrap().iter().find(|row| row["id"] == id);
    found.unwrap_or_else(|| panic!("{id}"))["value"].clone()
}

#[track_caller]
pub fn assert_within(what: &str, got: f64, expected: f64, relative: f64) {
    agree::relative(what, got, expected, relative);
}

/// The machine's bearing under the load of the variant's study.
fn bearing(variant: &str) -> BearingPoint {
    let model = model(variant, &[]);
    let study = model.studies.bearing.clone().expect("the file studies its bearing");
    let mut found = Machine::new(model).unwrap().bearings(&study).unwrap();
    found.swap_remove(0).point
}

fn loads(point: &BearingPoint) -> Vec<f64> {
    let mut loads: Vec<f64> = point.balls.iter().map(|b| b.inner.load).filter(|q| *q > 0.0).collect();
    loads.sort_by(|a, b| b.total_cmp(a));
    loads
}

/// A01, A02.
#[test]
fn ball_pass_frequencies() {
    let point = bearing("");
    let hz = 1797.0 / 60.0;
    assert_within("BPFO", point.orders.bpfo * hz, number(&reference("A01")), 1e-5);
    assert_within("BPFI", point.orders.bpfi * hz, number(&reference("A02")), 1e-5);
}

/// A15, A16, A17.
#[test]
fn deflection_and_ball_loads_at_rest() {
    let on_load_line = reference("A15");
    let point = bearing("clearance");
    let deflection = point.state.displacement[0];
    assert_within("A15 deflection", deflection, 1e-6 * number(&on_load_line["delta_um"]), 1e-4);
    let half_zone = (5.5e-6 / deflection).acos().to_degrees();
    assert_within("A15 zone", half_zone, number(&on_load_line["zone_half_deg"]), 1e-4);
    let expected = numbers(&on_load_line["Q"]);
    assert_eq!(loads(&point).len(), expected.len());
    for (got, expected) in loads(&point).iter().zip(&expected) {
        assert_within("A15 load", *got, *expected, 1e-4);
    }

    let straddling = reference("A16");
    let point = bearing("clearance_straddling");
    assert_within(
        "A16 deflection",
        point.state.displacement[0],
        1e-6 * number(&straddling["delta_um"]),
        1e-4,
    );
    assert_within("A16 load", loads(&point)[0], number(&straddling["Qmax"]), 1e-4);
    assert_eq!(loads(&point).len() as f64, number(&straddling["loaded"]));

    let tight = reference("A17");
    let point = bearing("no_clearance");
    assert_within("A17 deflection", point.state.displacement[0], 1e-6 * number(&tight["delta_um"]), 1e-4);
    assert_within("A17 load", loads(&point)[0] / 2000.0, number(&tight["Qmax_over_Q"]), 1e-4);
}

/// A13: F_c of eq. 13 is the outer minus the inner contact load of a ball. A14: the forces of evenly spaced
/// balls cancel, so that eq. 12, which subtracts F_c from every ball, has no effect.
#[test]
fn centrifugal_force() {
    let point = bearing("ball_inertia");
    let mut sum = [0.0; 2];
    for ball in &point.balls {
        let force = ball.outer.load - ball.inner.load;
        assert_within("F_c", force, number(&reference("A13")), 1e-3);
        sum[0] += force * ball.position.cos();
        sum[1] += force * ball.position.sin();
    }
    assert_eq!(point.balls.len(), 9);
    let largest = loads(&point)[0];
    for sum in sum {
        agree::absolute("sum of the centrifugal forces [N]", sum, 0.0, 1e-9 * largest);
    }
}

/// The DOFs are x and y of inner ring, outer ring and resonator.
#[test]
fn six_degrees_of_freedom() {
    let machine = Machine::new(model("", &[])).unwrap();
    let mut masses: Vec<f64> =
        (0..machine.assembly.dofs.len()).map(|k| machine.assembly.mass.get(k, k)).collect();
    masses.sort_by(f64::total_cmp);
    assert_eq!(masses, [1.0, 1.0, 1.2638, 1.2638, 12.638, 12.638]);
}
