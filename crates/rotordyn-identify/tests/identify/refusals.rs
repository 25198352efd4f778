//! Error messages with hints for data that cannot be identified.

use rotordyn_identify::{Settings, frfs_without_unit, identify};
use rotordyn_linalg::Complex64;
use rotordyn_signal::record::{Dof, FrfMatrix};

use crate::known_modes::{KnownMode, bending_shape, frfs, lines};

fn good() -> FrfMatrix {
    frfs(&[KnownMode::real(40.0, 0.01, &bending_shape(1, 3), &[1])], &lines(5.0, 85.0, 0.2), 2)
}

fn error_message(change: impl FnOnce(&mut FrfMatrix, &mut Settings)) -> String {
    let (mut made, mut settings) = (good(), Settings::default());
    change(&mut made, &mut settings);
    match identify(&made, &settings) {
        Err(error) => error.to_string(),
        Ok(found) => panic!("{:?}", found.modes),
    }
}

#[test]
fn errors_contain_hints() {
    let cases: [(String, [&str; 2]); 9] = [
        (error_message(|made, _| made.values[1][0][130].re = f64::NAN), ["31.000 Hz", "leave it out"]),
        (
            error_message(|made, _| made.values[2][0].fill(Complex64::default())),
            ["response 3:+y is zero", "dead channel"],
        ),
        (
            error_message(|_, s| (s.band, s.max_order) = (Some([35.0, 45.0]), Some(60))),
            ["51 lines", "lower the order to 24"],
        ),
        (error_message(|_, s| s.band = Some([39.0, 41.0])), ["11 lines", "choose a wider band"]),
        (
            error_message(|_, s| s.band = Some([300.0, 400.0])),
            ["0 lines of the 5.000 .. 85.000 Hz", "choose a wider band"],
        ),
        (error_message(|_, s| s.max_order = Some(3)), ["highest order", "8 or more"]),
        (error_message(|made, _| made.frequencies[9] += 0.1), ["uniformly spaced", "interpolate"]),
        (
            // Noise alone, of a fixed sequence.
            error_message(|made, _| {
                let mut state = 1u32;
                made.values.iter_mut().flatten().flatten().for_each(|h| {
                    let mut next = || {
                        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                        f64::from(state) / 2f64.powi(31) - 1.0
                    };
                    *h = Complex64::new(next(), next());
                });
            }),
            ["no mode was found in 5.000 .. 85.000 Hz", "check the coherence"],
        ),
        (
            error_message(|made, _| {
                made.values.iter_mut().flatten().flatten().for_each(|h| *h = Complex64::new(1e-3, 0.0))
            }),
            ["no mode was found", "choose a band with a resonance"],
        ),
    ];
    for (text, parts) in &cases {
        println!("{text}");
        assert!(parts.iter().all(|part| text.contains(part)), "{parts:?} is not in\n{text}");
    }
}

#[test]
fn a_request_ends_the_identification() {
    let message = error_message(|_, settings| settings.stop.request());
    assert_eq!(message, "the identification was stopped");
}

#[test]
fn force_over_motion_is_refused() {
    // Dynamic stiffness, mechanical impedance, apparent mass; of a rotation.
    for unit in ["N/m", "kg s^-1", "kg", "m^2 kg s^-2 rad^-1", "N m/rad"] {
        let text = error_message(|made, _| made.units[1][0] = unit.into());
        assert!(
            text.contains(&format!("response 2:+y to reference 1:+y is in {unit}: force over motion")),
            "{text}"
        );
        assert!(text.contains("reciprocal") && text.contains("inverse of their matrix"), "{text}");
    }
    for unit in ["m/N", "(m/s)/N", "(m/s^2)/N", "rad/(N m)", "", "(m/s^2)/V", "m kg^-1"] {
        let mut made = good();
        made.units.iter_mut().flatten().for_each(|own| *own = unit.into());
        assert!(identify(&made, &Settings::default()).is_ok(), "{unit}");
    }
}

#[test]
fn frfs_without_a_unit_are_named() {
    let of = |units: [&str; 2]| FrfMatrix {
        frequencies: vec![1.0],
        responses: vec![Dof::new(6, 1), Dof::new(30, 1)],
        references: vec![Dof::new(30, 1)],
        values: vec![vec![vec![1.0.into()]]; 2],
        units: units.map(|unit| vec![unit.into()]).to_vec(),
        coherence: None,
    };
    assert_eq!(frfs_without_unit(&of(["(m/s^2)/N", "m/N"])), None);
    let text = frfs_without_unit(&of(["(m/s^2)/N", ""])).unwrap();
    assert_eq!(text, "1 of 2 FRFs have no unit (30:+x/30:+x) and are treated as accelerance");
}

/// FRFs of the other sign convention, conjugated, have no stable pole: the reason is named.
#[test]
fn conjugated_frfs_are_refused_with_the_reason() {
    let modes = [(21.0, 0.01, 1), (48.0, 0.03, 2)]
        .map(|(hz, zeta, k)| KnownMode::real(hz, zeta, &bending_shape(k, 5), &[1, 3]));
    for power in 0..3 {
        let mut made = frfs(&modes, &lines(5.0, 85.0, 0.25), power);
        assert!(identify(&made, &Settings::default()).is_ok());
        made.values.iter_mut().flatten().flatten().for_each(|h| *h = h.conj());
        let error = identify(&made, &Settings::default()).unwrap_err().to_string();
        assert!(error.contains("the phase of the FRFs rises through the resonances"), "{error}");
    }
}
