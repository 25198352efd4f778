//! Warnings of random ball bearings: there exactly where their criterion holds, recomputed from ball loads and geometry.

use crate::random_bearings::{Random, bearing, condition, random_oil};
use rotordyn::analysis::equilibrium::CageTreatment;
use rotordyn::bearing::{Arrangement, BallBearing, BallInertia, Preload};
use rotordyn::contact::ContactLaw;
use rotordyn::model::study::{BearingStudy, BearingSweep, SweepVariable};
use rotordyn::results::{BallState, BearingResult, ContactState};
use rotordyn::study::single_bearings;
use std::f64::consts::PI;

/// Complete elliptic integrals K and E of the parameter m, by the arithmetic-geometric mean.
fn elliptic(m: f64) -> [f64; 2] {
    let (mut a, mut b, mut sum, mut power) = (1.0f64, (1.0 - m).sqrt(), 0.5 * m, 0.5);
    for _ in 0..30 {
        let c: f64 = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        power *= 2.0;
        sum += power * c * c;
    }
    let k = 0.5 * PI / a;
    [k, k * (1.0 - sum)]
}

/// Hertz contact of a ball with a race (Harris, eq. 6.39 to 6.43): semi-axis across the rolling direction \[m\] and largest
/// pressure \[Pa\] at a load \[N\]. `sign`: −1 inner, +1 outer race; steel of 207 GPa and 0.3.
fn hertz(b: &BallBearing, osculation: f64, sign: f64, load: f64) -> [f64; 2] {
    let g = &b.geometry;
    let gamma = g.ball_diameter * g.contact_angle.cos() / g.pitch_diameter;
    let race = -sign * 2.0 * gamma / (1.0 + sign * gamma);
    let sum = (4.0 - 1.0 / osculation + race) / g.ball_diameter;
    let difference = (1.0 / osculation + race) / (4.0 - 1.0 / osculation + race);
    let (mut low, mut high) = (1.0 + 1e-9, 1e3f64);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let square = middle * middle;
        let [k, e] = elliptic(1.0 - 1.0 / square);
        let found = ((square + 1.0) * e - 2.0 * k) / ((square - 1.0) * e);
        if found < difference { low = middle } else { high = middle }
    }
    let [_, e] = elliptic(1.0 - 1.0 / (low * low));
    let size = (1.5 * load / sum * 2.0 * (1.0 - 0.09) / 207e9).cbrt();
    let [a, b] = [(2.0 * low * low * e / PI).cbrt() * size, (2.0 * e / (PI * low)).cbrt() * size];
    [a, 1.5 * load / (PI * a * b)]
}

/// C_0 and P_0 \[N\] by ISO 76.
fn static_loads(b: &BallBearing, radial: f64, axial: f64) -> [f64; 2] {
    let g = &b.geometry;
    let rows = if b.duplex.is_some() { 2.0 } else { 1.0 };
    let osculation = [g.inner_groove_radius, g.outer_groove_radius].map(|r| r / g.ball_diameter);
    // The ball load of 4200 MPa at the more highly stressed race, over 5 D².
    let limit = |f: f64, sign: f64| (4.2e9 / hertz(b, f, sign, 1.0)[1]).powi(3);
    let ball = limit(osculation[0].max(0.52), -1.0).min(limit(osculation[1].max(0.53), 1.0));
    let rating = 0.2 * ball * rows * g.balls as f64 * g.contact_angle.cos();
    const Y: [f64; 9] = [0.52, 0.5, 0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22];
    let opposed = b.duplex.is_some_and(|pair| pair.arrangement != Arrangement::Tandem);
    let [x, y] = match g.contact_angle > 0.0 {
        true => {
            let place = g.contact_angle.to_degrees() / 5.0 - 1.0;
            let k = (place as usize).min(7);
            [0.5, Y[k] + (Y[k + 1] - Y[k]) * (place - k as f64)]
        }
        false => [0.6, 0.5],
    };
    let doubled = if opposed { 2.0 } else { 1.0 };
    [rating, (doubled * (x * radial + y * axial)).max(radial)]
}

/// P_0 \[N\] of the most loaded ball, where preload or interference presses all: Q = 5 F_r/(Z cos α) of ISO 76.
fn pressed_static_load(found: &BearingResult) -> f64 {
    let (b, point) = (&found.bearing, &found.point);
    let rows = if b.duplex.is_some() { 2 } else { 1 };
    let mut sums = vec![[0.0f64; 5]; rows];
    for ball in &point.balls {
        let (inner, sum) = (&ball.inner, &mut sums[ball.row]);
        let across = inner.load * inner.angle.cos();
        sum[0] += across * ball.position.cos();
        sum[1] += across * ball.position.sin();
        sum[2] += inner.load * inner.angle.sin();
        sum[3] += across;
        sum[4] = sum[4].max(across);
    }
    let pressed = match rows {
        1 => point.mounted.radial_clearance < 0.0,
        _ => {
            let full_circumference = sums.iter().all(|s| s[3] > 0.0 && s[0].hypot(s[1]) < 0.75 * s[3]);
            let [a, b] = [sums[0][2].abs(), sums[1][2].abs()];
            full_circumference && a.min(b) >= 0.2 * a.max(b)
        }
    };
    let most = sums.iter().map(|s| s[4]).fold(0.0, f64::max);
    if pressed { rows as f64 * b.geometry.balls as f64 * most / 5.0 } else { 0.0 }
}

/// Interference less what rotation takes of it, over the interference \[-\]: thick rings, u = (ρ Ω² r/4E) ((1 − ν) r² + (3 + ν) R²)
/// with the other radius R.
fn loosening(b: &BallBearing, speed: f64) -> f64 {
    let (g, fit, steel) = (&b.geometry, &b.fit, &b.ring_material);
    if fit.shaft_interference <= 0.0 || !fit.speed_growth {
        return -1.0;
    }
    let seat = 0.5 * g.bore;
    let grows = |other: f64| {
        steel.density * speed * speed * seat / (4.0 * steel.young)
            * ((1.0 - steel.poisson) * seat * seat + (3.0 + steel.poisson) * other * other)
    };
    let race = 0.5 * (g.pitch_diameter - g.ball_diameter * g.contact_angle.cos());
    2.0 * (grows(race) - grows(0.5 * fit.shaft_bore)) / fit.shaft_interference - 1.0
}

/// Angle of the shoulder from the groove's bottom, and how far an ellipse reaches beyond it \[rad\].
fn beyond_shoulder(b: &BallBearing, radius: f64, semi_axis: f64, angle: f64) -> f64 {
    let g = &b.geometry;
    let reach = g.contact_angle + 25f64.to_radians();
    let by_angle = if g.contact_angle > 0.0 { radius * (1.0 - reach.cos()) } else { 0.0 };
    let height = (0.2 * g.ball_diameter).max(by_angle);
    angle.abs() + semi_axis / radius - (1.0 - height / radius).acos()
}

/// A phrase of every warning, and by how much its criterion is exceeded over the limit; negative: it is not.
fn criteria(found: &BearingResult, roughness: f64) -> Vec<(&'static str, f64)> {
    let (b, point) = (&found.bearing, &found.point);
    let g = &b.geometry;
    let speed = point.state.condition.speed;
    let balls = &point.balls;
    let loaded: Vec<&BallState> = balls.iter().filter(|ball| ball.inner.load > 0.0).collect();
    if loaded.is_empty() {
        return vec![("no ball carries load", 1.0)];
    }
    let osculation = [g.inner_groove_radius, g.outer_groove_radius].map(|r| r / g.ball_diameter);
    let contacts: Vec<(&ContactState, f64, f64)> = balls
        .iter()
        .flat_map(|ball| [(&ball.inner, osculation[0], -1.0), (&ball.outer, osculation[1], 1.0)])
        .filter(|(contact, ..)| contact.load > 0.0)
        .collect();
    let largest = contacts.iter().map(|(contact, ..)| contact.load).fold(0.0, f64::max);
    let (mut pressure, mut beyond) = (0.0f64, -1.0f64);
    for (contact, f, sign) in &contacts {
        let [a, p] = hertz(b, *f, *sign, contact.load);
        assert!((p / contact.pressure - 1.0).abs() < 1e-6, "{p} {}", contact.pressure);
        pressure = pressure.max(p);
        // Contacts below 2 % of the largest load do not count.
        if contact.load > 0.02 * largest {
            beyond = beyond.max(beyond_shoulder(b, f * g.ball_diameter, a, contact.angle));
        }
    }
    let [x, y, z, ..] = point.state.load;
    let [rating, external] = static_loads(b, x.hypot(y), z.abs());
    let equivalent = external.max(pressed_static_load(found));
    assert!(
        (found.rating.static_rating / rating - 1.0).abs() < 1e-6,
        "{} {rating}",
        found.rating.static_rating
    );
    let mut out = vec![
        ("4.2 GPa", pressure / 4.2e9 - 1.0),
        ("static safety s_0", if pressure > 4.2e9 { 0.0 } else { equivalent / rating - 1.0 }),
        ("beyond the shoulder", beyond),
    ];
    let single = g.contact_angle > 0.0 && b.duplex.is_none();
    let whole: f64 = loaded.iter().map(|ball| ball.inner.load).sum();
    let mean = loaded.iter().map(|ball| ball.inner.load * ball.inner.angle.abs()).sum::<f64>() / whole;
    out.push(("the inner ring slides", if single { 1.0 - mean / (0.5 * g.contact_angle) } else { -1.0 }));
    let open = balls.iter().filter(|ball| ball.outer.load > 0.0);
    let open = open.map(|ball| -ball.outer.angle * g.thrust_direction).fold(-1.0, f64::max);
    out.push(("open side", if single { open } else { -1.0 }));
    let rpm = speed.abs() * 30.0 / PI;
    let pitch = 1e3 * g.pitch_diameter;
    let required = if rpm < 1000.0 { 45e3 * rpm.powf(-0.83) } else { 4.5e3 / rpm.sqrt() } / pitch.sqrt();
    let oil = b.lubricant().map(|oil| 1e6 * oil.viscosity / oil.density);
    let minimum = 25.0 * (oil.unwrap_or(required) * rpm / 1e3).powf(2.0 / 3.0) * (pitch / 100.0).powi(2);
    let all = loaded.len() == balls.len();
    out.push(("minimum load", if all { -1.0 } else { minimum / point.life.reference_load - 1.0 }));
    out.push(("viscosity ratio kappa", oil.map_or(-1.0, |oil| 1.0 - oil / required / 0.1)));
    let film = contacts.iter().map(|(contact, ..)| contact.minimum_film).fold(f64::INFINITY, f64::min);
    out.push(("film ratio", if oil.is_some() { 1.0 - film / roughness } else { -1.0 }));
    let mass = 7850.0 * PI / 6.0 * g.ball_diameter.powi(3);
    let cage = point.orders.ftf * speed;
    let sum = |of: &dyn Fn(&BallState) -> f64| loaded.iter().map(|ball| of(ball)).sum::<f64>();
    let [inner_sum, outer_sum] = [sum(&|ball| ball.inner.load), sum(&|ball| ball.outer.load)];
    // 2 M/D = m D ω_c ω_r/5, ω_r = ω_c sin α_o/γ' or (Ω − ω_c) sin α_i/γ'.
    let scale = 0.2 * mass * g.pitch_diameter * cage;
    let on_outer = scale * cage * sum(&|ball| ball.outer.angle.sin().abs());
    let on_inner = scale * (speed - cage) * sum(&|ball| ball.inner.angle.sin().abs());
    let (moment, resisted) = match b.inertia {
        BallInertia::InnerRaceControl => (on_inner, 0.07 * inner_sum),
        BallInertia::HarrisInnerRaceControl => (0.5 * on_inner, 0.07 * inner_sum.min(outer_sum)),
        _ => (on_outer, 0.07 * outer_sum),
    };
    let has_moment =
        !matches!(b.inertia, BallInertia::None | BallInertia::Centrifugal | BallInertia::CentrifugalForce(_));
    out.push(("gyroscopic moment", if has_moment { moment / resisted - 1.0 } else { -1.0 }));
    let gamma = g.ball_diameter * g.contact_angle.cos() / g.pitch_diameter;
    let centrifugal = 0.5 * mass * g.pitch_diameter * (0.5 * (1.0 - gamma) * speed).powi(2);
    let inner = loaded.iter().map(|ball| ball.inner.load).fold(0.0, f64::max);
    let massless = b.inertia == BallInertia::None;
    out.push(("its balls are massless", if massless { centrifugal / (0.003 * inner) - 1.0 } else { -1.0 }));
    out.push(("rotation widens the bore", loosening(b, speed)));
    let limit = if g.contact_angle > 0.0 { 2.5e6 } else { 1.5e6 };
    out.push(("turns at n d_m", pitch * rpm / limit - 1.0));
    let opposed = b.duplex.is_some_and(|pair| pair.arrangement != Arrangement::Tandem);
    let rigid = !matches!(b.preload, Preload::None | Preload::Spring { .. });
    let free = !found.prescribed[2];
    out.push(("preload has no effect", if rigid && !opposed && free { 1.0 } else { -1.0 }));
    out
}

#[test]
fn warnings_exactly_where_their_criterion_says() {
    let mut random = Random(77);
    let (mut failures, mut there, mut absent) = (Vec::new(), [0usize; 16], [0usize; 16]);
    for number in 0..240 {
        let mut ball = bearing(&mut random);
        let mut at = condition(&mut random, &ball);
        // Some at low speed, and some single rows without the thrust that they need or with the opposite one.
        if number % 6 == 5 {
            at.speed *= 0.003;
        }
        if number % 7 == 3 && ball.duplex.is_none() {
            at.load[2] *= if number % 2 == 0 { 0.02 } else { -1.0 };
        }
        match number % 4 {
            0 => ball.contact = ContactLaw::Film { lubricant: random_oil(&mut random), speed_factor: 1.0 },
            1 => ball.service.lubricant = Some(random_oil(&mut random)),
            _ => {}
        }
        if number % 5 == 4 {
            ball.inertia = BallInertia::None;
        }
        let [x, y, z, a, b] = at.load;
        let study = BearingStudy {
            force: Some([x, y, z]),
            moment: Some([a, b]),
            constrained: Some(at.prescribed.map(|held| held.is_some())),
            speed: Some(at.speed),
            cage_average: at.cage == CageTreatment::Averaged,
            sweeps: vec![BearingSweep { variable: SweepVariable::CageAngle, values: vec![ball.cage_angle] }],
            ..BearingStudy::default()
        };
        let found = match single_bearings(&[("random".into(), ball)], &study) {
            Ok(mut found) => found.remove(0),
            Err(error) => {
                failures.push(format!("{number}: {error}"));
                continue;
            }
        };
        let expected = criteria(&found, study.roughness);
        for (k, (phrase, excess)) in expected.iter().enumerate() {
            let warned = found.warnings.iter().any(|w| w.text.contains(phrase));
            // Round-off decides at the limit itself.
            if excess.abs() > 1e-6 && warned != (*excess > 0.0) {
                failures.push(format!("{number}: {phrase}, criterion {excess:.3e}: {:?}", found.warnings));
            }
            [&mut absent, &mut there][usize::from(warned)][k] += 1;
        }
        for warning in &found.warnings {
            if !expected.iter().any(|(phrase, _)| warning.text.contains(phrase)) {
                failures.push(format!("{number}: not expected: {warning}"));
            }
        }
    }
    println!("there {there:?}, absent {absent:?}");
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
    // Every criterion occurs on both sides.
    let both = (0..13).filter(|k| there[*k] > 0 && absent[*k] > 0).count();
    assert!(both == 13, "there {there:?}, absent {absent:?}");
}
