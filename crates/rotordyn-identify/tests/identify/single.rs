//! Circle fit and peak fit (half-power method) of one mode of one FRF, compared with the known mode.

use rotordyn_identify::sdof::{circle_fit, half_power_fit};
use rotordyn_signal::Quantity;

use crate::known_modes::{KnownMode, bending_shape, frfs, lines};

#[test]
fn circle_fit_and_peak_fit_of_one_mode() {
    let known = [KnownMode::real(40.0, 0.01, &bending_shape(1, 3), &[1])];
    for (power, quantity) in
        [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration].into_iter().enumerate()
    {
        let made = frfs(&known, &lines(20.0, 60.0, 0.05), power as i32);
        let circle = circle_fit(&made.frequencies, &made.values[1][0], [39.0, 41.0], quantity).unwrap();
        let natural = known[0].pole.norm() / std::f64::consts::TAU;
        // The contribution of the conjugate pole is a straight line to 1e-4 over the band.
        assert!((circle.frequency_hz / natural - 1.0).abs() < 1e-5, "{circle:?}");
        assert!((circle.damping_ratio / 0.01 - 1.0).abs() < 2e-3, "{circle:?}");
        let residue = known[0].residue(1, 0);
        assert!((circle.residue - residue).norm() < 1e-2 * residue.norm(), "{circle:?} for {residue}");
        // Half-power points are interpolated between lines 0.05 Hz apart; the half-power bandwidth is 0.8 Hz.
        let peak = half_power_fit(&made.frequencies, &made.values[1][0], [36.0, 44.0]).unwrap();
        assert!((peak.frequency_hz / natural - 1.0).abs() < 5e-4, "{peak:?}");
        assert!((peak.damping_ratio / 0.01 - 1.0).abs() < 0.03, "{peak:?}");
    }
}

#[test]
fn no_mode_without_a_peak() {
    let known = [KnownMode::real(40.0, 0.01, &bending_shape(1, 3), &[1])];
    let made = frfs(&known, &lines(20.0, 60.0, 0.05), 2);
    assert_eq!(half_power_fit(&made.frequencies, &made.values[1][0], [50.0, 55.0]), None);
    // Too few lines; the flank of a mode outside the band.
    for band in [[40.0, 40.1], [50.0, 55.0]] {
        assert_eq!(circle_fit(&made.frequencies, &made.values[1][0], band, Quantity::Acceleration), None);
    }
}
