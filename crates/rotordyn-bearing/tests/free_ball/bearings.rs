//! Bearings of these tests.

use rotordyn_bearing::contact::{ContactDamping, ContactLaw, Traction};
use rotordyn_bearing::free_ball::{
    Drag, FreeBallBearing, FreeCage, FrictionLaw, Guidance, Pocket, PointContactLaw, RingState, SlipModel,
};
use rotordyn_bearing::material::Material;
use rotordyn_bearing::{BallBearing, BallGeometry, BallInertia, Cage, Fit, Preload};
use std::f64::consts::TAU;

pub fn steel() -> Material {
    let (young, poisson) = (2.06e11, 0.3);
    Material { name: "steel".into(), young, shear: young / (2.0 * (1.0 + poisson)), poisson, density: 7850.0 }
}

/// Bearing of a geometry, of steel, without preload and clearance change.
pub fn ball_bearing(geometry: BallGeometry) -> BallBearing {
    BallBearing {
        cage_pocket_diameter: geometry.default_cage_pocket(),
        geometry,
        ball_material: steel(),
        ring_material: steel(),
        contact: ContactLaw::Hertz,
        contact_stiffness: Default::default(),
        damping: ContactDamping::Constant { coefficient: 0.0, ramp: 1e-6 },
        inertia: BallInertia::OuterRaceControl,
        preload: Preload::None,
        duplex: None,
        fit: Fit::default(),
        cage: Cage::Rolling,
        cage_angle: 0.0,
        imperfections: Default::default(),
        service: Default::default(),
        estimated_geometry: None,
    }
}

/// The catalogue's 6205 with a number of balls and a diametral clearance \[m\].
pub fn geometry_6205(balls: usize, radial_clearance: f64) -> BallGeometry {
    let ball_diameter = 7.938e-3;
    BallGeometry {
        balls,
        ball_diameter,
        pitch_diameter: 38.5e-3,
        inner_groove_radius: 0.515 * ball_diameter,
        outer_groove_radius: 0.525 * ball_diameter,
        radial_clearance,
        contact_angle: 0.0,
        thrust_direction: 1.0,
        moment_arm: None,
        bore: 25e-3,
        outside_diameter: 52e-3,
        width: 15e-3,
    }
}

/// Free balls without cage, gravity and losses; Coulomb friction μ regularised at v₀ \[m/s\].
pub fn free(ball: BallBearing, friction: f64, slip_speed: f64, slip: SlipModel) -> FreeBallBearing {
    FreeBallBearing {
        ball,
        friction: FrictionLaw::Coulomb(Traction { friction, slip_speed }),
        slip,
        damping: 0.0,
        rolling_loss: 0.0,
        cage: None,
        ball_friction: Traction { friction: 0.0, slip_speed: 1e-3 },
        drag: Drag::default(),
        gravity: [0.0; 3],
    }
}

pub fn rpm(speed: f64) -> f64 {
    speed * TAU / 60.0
}

/// Inner ring at a speed \[rad/s\] and time, outer ring at rest.
pub fn rings(speed: f64, time: f64) -> [RingState; 2] {
    [RingState::rotating(speed, speed * time), RingState::default()]
}

/// Relative deviation.
pub fn off(value: f64, expected: f64) -> f64 {
    (value / expected - 1.0).abs()
}

/// Polyamide cage of the 6205 with a pocket clearance of 0.16 mm and a friction coefficient in its pockets.
pub fn plastic_cage(pocket: Pocket, guidance: Guidance, friction: f64) -> FreeCage {
    let [mass, polar_inertia, transverse_inertia] = FreeCage::ring_inertia(1150.0, [17e-3, 21.5e-3], 10e-3);
    FreeCage {
        mass,
        polar_inertia,
        transverse_inertia,
        pocket,
        pocket_diameter: 8.1e-3,
        pocket_contact: touch(1e8, 1.0, friction),
        guidance,
    }
}

/// Contact of a stiffness \[N/mⁿ\], a damping χ \[s/m\] and a friction coefficient regularised at 1 cm/s.
pub fn touch(stiffness: f64, damping: f64, friction: f64) -> PointContactLaw {
    PointContactLaw { stiffness, damping, friction: Traction { friction, slip_speed: 1e-2 } }
}
