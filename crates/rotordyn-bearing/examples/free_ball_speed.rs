//! Cost of a bearing with free balls: ball evaluations per second, CPU time per simulated second.

use rotordyn_bearing::BallBearing;
use rotordyn_bearing::contact::{ContactDamping, Traction};
use rotordyn_bearing::free_ball::{
    Drag, FreeBallBearing, FreeBalls, FreeCage, FrictionLaw, Guidance, Pocket, PointContactLaw, RingState,
    SlipModel,
};
use std::time::Instant;

#[path = "../tests/free_ball/bearings.rs"]
#[allow(dead_code)]
mod bearings;

fn bearing(slip: SlipModel) -> FreeBallBearing {
    let ball = BallBearing {
        damping: ContactDamping::HuntCrossley { factor: 0.0 },
        ..bearings::ball_bearing(bearings::geometry_6205(9, -4e-6))
    };
    let [mass, polar_inertia, transverse_inertia] = FreeCage::ring_inertia(1150.0, [17e-3, 21.5e-3], 10e-3);
    let friction = Traction { friction: 0.1, slip_speed: 1e-2 };
    FreeBallBearing {
        ball,
        friction: FrictionLaw::Coulomb(Traction { friction: 0.06, slip_speed: 1e-2 }),
        slip,
        damping: 1.0,
        rolling_loss: 0.0,
        cage: Some(FreeCage {
            mass,
            polar_inertia,
            transverse_inertia,
            pocket: Pocket::Cylindrical,
            pocket_diameter: 8.1e-3,
            pocket_contact: PointContactLaw { stiffness: 1e8, damping: 1.0, friction },
            guidance: Guidance::Balls,
        }),
        ball_friction: friction,
        drag: Drag::default(),
        gravity: [0.0, -9.80665, 0.0],
    }
}

/// CPU time of this process \[s\]; the time of day where the system does not tell.
fn cpu_seconds(start: &Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let nanoseconds = text.split_whitespace().next().and_then(|value| value.parse::<f64>().ok());
    nanoseconds.map_or(start.elapsed().as_secs_f64(), |value| 1e-9 * value)
}

fn main() {
    let clock = Instant::now();
    let speed = 40.0 * std::f64::consts::PI;
    let rings = |t: f64| [RingState::rotating(speed, speed * t), RingState::default()];
    let slips = [
        SlipModel::Centre,
        SlipModel::Ellipse { along: 2, across: 8 },
        SlipModel::Ellipse { along: 4, across: 12 },
        SlipModel::Ellipse { along: 8, across: 24 },
    ];
    for slip in slips {
        let balls = FreeBalls::new(bearing(slip), speed).expect("valid input");
        let mut state = balls.initial_state(&rings(0.0)).expect("no overlap");
        let stable = balls.stable_step(&state, &rings(0.0));
        let (step, duration) = (2e-6, 0.25);
        let start = cpu_seconds(&clock);
        let run = balls.advance(&mut state, [&rings(0.0), &rings(duration)], duration, step);
        let seconds = cpu_seconds(&clock) - start;
        let evaluations = 9.0 * 4.0 * run.expect("a stable step").steps as f64;
        println!(
            "{slip:?}: {:.2} million ball evaluations a second, {:.1} s of CPU per simulated second at {:.1} us; \
             stable: contact {:.1} us, friction {:.1} us",
            1e-6 * evaluations / seconds,
            seconds / duration,
            1e6 * step,
            1e6 * stable.contact,
            1e6 * stable.friction
        );
    }
}
