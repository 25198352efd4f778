//! Hertzian contact compared with closed forms and independent values for the rig's bearing.

use crate::agree;
use crate::bearing::{rig_6205, steel};
use rotordyn_bearing::BallElement;
use rotordyn_bearing::contact::EllipticContact;

#[test]
fn sphere_on_flat_gives_circular_contact() {
    // Q = (4/3) E* sqrt(R) δ^1.5 for a sphere of radius R on a flat of the same steel.
    let radius: f64 = 5e-3;
    let contact = EllipticContact::new(1.0 / radius, 1.0 / radius, [&steel(), &steel()]);
    let modulus = 207e9 / (2.0 * (1.0 - 0.09));
    let exact = 4.0 / 3.0 * modulus * radius.sqrt();
    agree::relative("K of a sphere on a plane [N/m^1.5]", contact.stiffness, exact, 1e-13);
    // p0 = (6 Q E*^2 / (π³ R²))^(1/3), and p0 = 3Q/(2πa²) must agree with the patch.
    let patch = contact.patch(100.0);
    let pi = std::f64::consts::PI;
    let p0 = (6.0 * 100.0 * modulus * modulus / (pi.powi(3) * radius * radius)).cbrt();
    agree::relative("maximum pressure [Pa]", patch.maximum_pressure, p0, 1e-13);
    agree::relative(
        "square of the contact radius [m²]",
        patch.semi_major.powi(2),
        radius * patch.deflection,
        1e-13,
    );
}

#[test]
fn ellipse_ratio_satisfies_curvature_equation() {
    let m = steel();
    for across in [0.999, 0.5, 0.1, 1e-2, 1e-4] {
        let c = EllipticContact::new(1.0, across, [&m, &m]);
        let (k2, [first, second]) = (c.ratio * c.ratio, c.integrals);
        let f = ((k2 + 1.0) * second - 2.0 * first) / ((k2 - 1.0) * second);
        // The equation is ill-conditioned towards the circle, where (κ² − 1) cancels.
        agree::absolute(
            format_args!("curvature difference across {across}"),
            f,
            c.curvature_difference,
            1e-11,
        );
        assert!(c.ratio > 1.0);
    }
}

#[test]
fn rig_contact_constants() {
    // Values of an independent program for the same geometry (tests/data/rig.json, bearing.catalogue).
    let pair = BallElement::new(&rig_6205()).contacts;
    agree::relative("6205: K of the inner contact", pair.inner.stiffness, 28162882888.95517, 1e-9);
    agree::relative("6205: K of the outer contact", pair.outer.stiffness, 25018667553.86848, 1e-9);
    agree::relative("6205: K of both contacts", pair.stiffness, 9373862544.95941, 1e-9);
    let orders = rig_6205().geometry.characteristic_orders(0.0);
    agree::absolute("6205: BPFO [orders]", orders.bpfo, 3.5722, 5e-5);
    agree::absolute("6205: BPFI [orders]", orders.bpfi, 5.4278, 5e-5);
    agree::absolute("6205: FTF [orders]", orders.ftf, 0.3969, 5e-5);
    agree::absolute("6205: BSF [orders]", orders.bsf, 2.322, 5e-4);
}
