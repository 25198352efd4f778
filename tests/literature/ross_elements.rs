//! Element matrices of ROSS 3.1.0 (element_matrices.json), entry by entry.

use crate::agree;
use crate::ross::{element, number, numbers, read};
use rotordyn::element::ShearCoefficient;
use rotordyn::element::shaft_matrices::{ConeRule, Matrix12};
use serde_json::Value;

/// Largest deviation relative to the largest entry of the matrix.
fn deviation(ours: &Matrix12, theirs: &Value) -> f64 {
    let theirs: Vec<Vec<f64>> = theirs.as_array().unwrap().iter().map(numbers).collect();
    let size = theirs.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
    let mut worst: f64 = 0.0;
    for (a, b) in ours.iter().zip(&theirs) {
        for (a, b) in a.iter().zip(b) {
            worst = worst.max((a - b).abs());
        }
    }
    worst / size
}

fn sum(a: &Matrix12, b: &Matrix12) -> Matrix12 {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + b[i][j]))
}

#[test]
fn shaft_elements_agree_entry_by_entry() {
    let file = read("ross/element_matrices.json");
    let cases = file["shaft"].as_array().unwrap();
    assert_eq!(cases.len(), 8);
    for case in cases {
        let name = case["name"].as_str().unwrap();
        let mut e = element(&case["input"], &file["material"]);
        if e.shear == ShearCoefficient::Hutchinson {
            // ROSS 3.1.0 lacks one factor 1 + ν of Hutchinson 2001, 6(1+ν)²/(7+12ν+4ν²) for the solid circle.
            let theirs = number(&case["kappa"]);
            agree::relative("shear coefficient, hollow", e.shear_coefficient().unwrap(), 1.3 * theirs, 1e-14);
            e.shear = ShearCoefficient::Value(theirs);
        }
        let rule = ConeRule::ArithmeticMean;
        let k = sum(&e.elastic_stiffness(rule), &e.geometric_stiffness());
        for (ours, theirs) in
            [(e.mass_matrix(rule), "M"), (k, "K"), (e.gyroscopic_matrix(), "G"), (e.spin_up_ross(), "Kst")]
        {
            let worst = deviation(&ours, &case[theirs]);
            agree::curve(format_args!("{name}: matrix {theirs}"), worst, 1.0, 1e-12);
        }
        if let Some(kappa) = case["kappa"].as_f64() {
            agree::relative(
                format_args!("{name}: shear coefficient"),
                e.shear_coefficient().unwrap(),
                kappa,
                1e-14,
            );
        }
        agree::relative(format_args!("{name}: mass [kg]"), e.mass(), number(&case["mass"]), 1e-12);
    }
}
