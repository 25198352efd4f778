//! What cannot be identified says so, and what to do.

use rotordyn::identify::{Settings, identify};
use rotordyn::linalg::Complex64;
use rotordyn::signal::record::FrfMatrix;

use crate::made::{Known, bent, frfs, lines};

fn good() -> FrfMatrix {
    frfs(&[Known::real(40.0, 0.01, &bent(1, 3), &[1])], &lines(5.0, 85.0, 0.2), 2)
}

fn said(change: impl FnOnce(&mut FrfMatrix, &mut Settings)) -> String {
    let (mut made, mut settings) = (good(), Settings::default());
    change(&mut made, &mut settings);
    match identify(&made, &settings) {
        Err(error) => error.to_string(),
        Ok(found) => panic!("{:?}", found.modes),
    }
}

#[test]
fn each_says_what_to_do() {
    let cases: [(String, [&str; 2]); 9] = [
        (said(|made, _| made.values[1][0][130].re = f64::NAN), ["31.000 Hz", "leave it out"]),
        (
            said(|made, _| made.values[2][0].fill(Complex64::default())),
            ["response 3:+y is zero", "dead channel"],
        ),
        (
            said(|_, s| (s.band, s.max_order) = (Some([35.0, 45.0]), Some(60))),
            ["51 lines", "lower the order to 24"],
        ),
        (said(|_, s| s.band = Some([39.0, 41.0])), ["11 lines", "choose a wider band"]),
        (
            said(|_, s| s.band = Some([300.0, 400.0])),
            ["0 lines of the 5.000 .. 85.000 Hz", "choose a wider band"],
        ),
        (said(|_, s| s.max_order = Some(3)), ["highest order", "8 or more"]),
        (said(|made, _| made.frequencies[9] += 0.1), ["uniformly spaced", "interpolate"]),
        (
            // Noise alone, of a fixed sequence.
            said(|made, _| {
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
            said(|made, _| {
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
