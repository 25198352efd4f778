//! Contact damping compared with hand calculations and with the first integral of a rebounding mass.

use crate::agree;
use rotordyn_bearing::contact::{BallContacts, ContactDamping, ContactLaw, HertzPair, PowerLaw};

use crate::bearing::rig_6205;

/// Contacts of a ball with the power law Q = K δⁿ.
fn power_law_contacts(stiffness: f64, exponent: f64) -> BallContacts {
    let law = PowerLaw { stiffness, exponent, offset: 0.0, range: [0.0, f64::INFINITY] };
    let pair: HertzPair = rig_6205().hertz();
    BallContacts::new(pair, ContactLaw::PowerLaw(law))
}

#[test]
fn hunt_crossley_force_by_hand() {
    // K = 1e10 N/m^1.5, δ = 4 um: Q_e = 1e10 · 8e-9 = 80 N; χ = 0.3 s/m, δ̇ = 20 mm/s:
    // F_d = 0.3 · 80 · 0.02 = 0.48 N.
    let contacts = power_law_contacts(1e10, 1.5);
    let at = contacts.at_speed(0.0);
    let elastic = at.series(4e-6);
    let damping = ContactDamping::HuntCrossley { factor: 0.3 };
    for (rate, load) in [(0.02, 80.48), (0.0, 80.0), (-0.02, 79.52), (-1.0, 56.0), (-4.0, 0.0)] {
        let found = damping.apply(&at, &elastic, 4e-6, rate).load;
        // Round-off of the power function.
        agree::absolute(format_args!("force at {rate} m/s [N]"), found, load, 1e-11);
    }
}

/// c δ̇ beyond the ramp, and half of it in the middle of the ramp (symmetry of the smoothstep).
#[test]
fn constant_damping_force_by_hand() {
    let contacts = power_law_contacts(1e10, 1.5);
    let at = contacts.at_speed(0.0);
    let damping = ContactDamping::Constant { coefficient: 300.0, ramp: 1e-6 };
    // 300 N s/m at 20 mm/s: 6 N in addition to 80 N at 4 um; 3 N in addition to
    // 1e10 · (0.5e-6)^1.5 = 3.5355339 N at 0.5 um.
    for (approach, load) in [(4e-6, 86.0), (0.5e-6, 6.535_533_905_932_738)] {
        let found = damping.apply(&at, &at.series(approach), approach, 0.02).load;
        agree::absolute(format_args!("force at {approach} m [N]"), found, load, 1e-11);
    }
}

/// Root of an increasing function by bisection.
fn root(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) < 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// A mass m hits a contact at v₀: m v dv/dδ = −K δⁿ (1 + χ v) gives ∫ v dv/(1 + χ v) = −K δⁿ⁺¹/(m (n + 1)).
///
/// With G(v) = v/χ − ln(1 + χ v)/χ² the maximum approach follows from K δⁿ⁺¹/(n + 1) = m G(v₀), and the
/// rebound speed v₁ from G(−v₁) = G(v₀), independent of m, K and n.
#[test]
fn rebound_speed_and_maximum_approach_from_first_integral() {
    for (stiffness, exponent, mass, factor, speed) in [
        (1e10, 1.5, 0.05, 1.5, 0.2),
        (1e10, 1.5, 0.05, 0.3, 0.2),
        (2e9, 1.3, 0.4, 4.0, 0.5),
        (3e10, 1.5, 0.002, 0.05, 1.0),
    ] {
        let contacts = power_law_contacts(stiffness, exponent);
        let at = contacts.at_speed(0.0);
        let damping = ContactDamping::HuntCrossley { factor };
        let acceleration = |x: f64, v: f64| -damping.apply(&at, &at.series(x), x, v).load / mass;
        let integral = |v: f64| v / factor - (factor * v).ln_1p() / (factor * factor);
        let energy = mass * integral(speed);
        let max_approach = ((exponent + 1.0) * energy / stiffness).powf(1.0 / (exponent + 1.0));
        // G decreases for v < 0; 1 − χ v₁ stays positive.
        let rebound_speed = root(0.0, (1.0 - 1e-15) / factor, |v| integral(-v) - integral(speed));

        // Classical Runge-Kutta; contact duration about 3.2 δ_max/v₀.
        let step = max_approach / speed / 2000.0;
        let (mut x, mut v, mut largest_x) = (0.0, speed, 0.0_f64);
        for _ in 0..40_000 {
            let (k1, l1) = (v, acceleration(x, v));
            let (k2, l2) = (v + 0.5 * step * l1, acceleration(x + 0.5 * step * k1, v + 0.5 * step * l1));
            let (k3, l3) = (v + 0.5 * step * l2, acceleration(x + 0.5 * step * k2, v + 0.5 * step * l2));
            let (k4, l4) = (v + step * l3, acceleration(x + step * k3, v + step * l3));
            x += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            v += step / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
            largest_x = largest_x.max(x);
            if x <= 0.0 {
                break;
            }
        }
        assert!(x <= 0.0, "still in contact at {x} m");
        // Discretisation error 1/2000^2.5, as δⁿ is not smooth where the contact begins and ends; the maximum
        // lies within half a step of a sample.
        agree::relative(format_args!("χ {factor}: rebound speed [m/s]"), -v, rebound_speed, 1e-6);
        agree::relative(format_args!("χ {factor}: largest approach [m]"), largest_x, max_approach, 1e-6);
        // Coefficient of restitution e = 1 − (2/3) χ v₀ + (4/9) (χ v₀)² − ... of Hunt & Crossley.
        let small = factor * speed;
        if small <= 0.1 {
            agree::absolute(
                format_args!("coefficient of restitution at {small}"),
                -v / speed,
                1.0 - 2.0 / 3.0 * small,
                0.5 * small * small,
            );
        }
    }
}
