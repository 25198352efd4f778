//! Contacts, motion and friction of the balls of a bearing at an operating point.

use crate::results::{BallState, ContactState};
use rotordyn_bearing::contact::{BallContacts, Race};
use rotordyn_bearing::friction;
use rotordyn_bearing::{BallBearing, BallLoad, FrictionTorque, kinematics, shoulder_margin};

/// Every ball with its two contacts and its motion, at a speed of the shaft \[rad/s\].
///
/// `contacts`: with the film of the bearing's lubricant, also for a dry contact law.
pub(super) fn ball_states(
    bearing: &BallBearing,
    contacts: &BallContacts,
    loads: &[BallLoad],
    speed: f64,
) -> Vec<BallState> {
    let g = &bearing.geometry;
    let friction = bearing.service.sliding_friction;
    let gamma = g.ball_diameter * g.contact_angle.cos() / g.pitch_diameter;
    let entrainment = 0.25 * g.pitch_diameter * (1.0 - gamma * gamma) * speed.abs();
    let films = contacts.at_speed(entrainment);
    let motions = kinematics::ball_motions(bearing, loads, speed);
    let advances = kinematics::ball_advance(loads, &motions);
    let states = loads.iter().zip(motions).zip(advances).map(|((ball, motion), advance)| {
        let shoulders = shoulder_margin(bearing, ball);
        let ratios = motion.spin_to_roll();
        let contact = |race: Race, load: f64, angle: f64| {
            let k = usize::from(race == Race::Outer);
            let unloaded = ContactState { angle, shoulder: shoulders[k], ..ContactState::default() };
            if load <= 0.0 {
                return unloaded;
            }
            let patch = contacts.hertz.of(race).patch(load);
            ContactState {
                load,
                semi_major: patch.semi_major,
                semi_minor: patch.semi_minor,
                pressure: patch.maximum_pressure,
                film: films.film(race, load),
                minimum_film: films.minimum_film(race, load),
                spin: motion.spin[k],
                spin_to_roll: ratios[k],
                spin_moment: friction * motion.spin_moment[k],
                pressure_velocity: motion.pressure_velocity[k],
                ..unloaded
            }
        };
        BallState {
            row: ball.row,
            position: ball.position,
            inner: contact(Race::Inner, ball.load, ball.contact_angle),
            outer: contact(Race::Outer, ball.outer_load, ball.outer_contact_angle),
            motion,
            advance,
        }
    });
    states.collect()
}

/// Friction torque of a bearing under the forces of its rows, F_r and F_a \[N\], at a speed \[rad/s\].
///
/// `row_rating`: static load rating of one row \[N\].
pub(super) fn friction_torque(
    bearing: &BallBearing,
    row_rating: f64,
    rows: &[[f64; 2]],
    speed: f64,
    balls: &[BallState],
) -> FrictionTorque {
    let g = &bearing.geometry;
    let of_row = |&[radial, axial]: &[f64; 2]| friction::load_torque(g, row_rating, radial, axial);
    let of_rows: Vec<[f64; 2]> = rows.iter().map(of_row).collect();
    let load: f64 = of_rows.iter().map(|[torque, _]| torque).sum();
    // That of the row with the larger torque.
    let of_most = of_rows.iter().copied().max_by(|a, b| a[0].total_cmp(&b[0]));
    let load_factor = of_most.map_or(0.0, |[_, factor]| factor);
    let rows = rows.len() as f64;
    let (oil, sliding_friction) = (bearing.lubricant(), bearing.service.sliding_friction);
    let factor = bearing.service.lubrication.viscous_factor(g);
    let viscous =
        oil.map_or(0.0, |oil| rows * friction::viscous_torque(g, factor, oil.kinematic_viscosity(), speed));
    let spin = friction::spin_torque(balls.iter().map(|ball| &ball.motion), sliding_friction, speed);
    FrictionTorque {
        load,
        viscous,
        spin,
        heat: (load + viscous + spin) * speed.abs(),
        load_factor,
        viscous_factor: oil.map_or(f64::NAN, |_| factor),
        sliding_friction,
    }
}
