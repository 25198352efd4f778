//! Ball bearing 6205 of the overhung rig, for tests without a model file.
#![allow(dead_code)]

use rotordyn_bearing::contact::{ContactDamping, ContactLaw};
use rotordyn_bearing::material::Material;
use rotordyn_bearing::{BallBearing, BallGeometry, BallInertia, Cage, Fit, Preload};

pub fn steel() -> Material {
    Material { name: "steel".into(), young: 207e9, shear: 207e9 / 2.6, poisson: 0.3, density: 7850.0 }
}

/// 6205 of the overhung rig: 9 balls of 7.938 mm on 38.5 mm, f 0.515/0.525, clearance 10 um.
pub fn rig_6205() -> BallBearing {
    BallBearing {
        geometry: BallGeometry {
            balls: 9,
            ball_diameter: 7.938e-3,
            pitch_diameter: 38.5e-3,
            inner_groove_radius: 0.515 * 7.938e-3,
            outer_groove_radius: 0.525 * 7.938e-3,
            radial_clearance: 10e-6,
            contact_angle: 0.0,
            thrust_direction: 1.0,
            moment_arm: None,
            bore: 25e-3,
            outside_diameter: 52e-3,
            width: 15e-3,
        },
        ball_material: steel(),
        ring_material: steel(),
        contact: ContactLaw::Hertz,
        contact_stiffness: Default::default(),
        damping: ContactDamping::Constant { coefficient: 300.0, ramp: 1e-6 },
        inertia: BallInertia::None,
        preload: Preload::None,
        duplex: None,
        fit: Fit::default(),
        cage: Cage::Rolling,
        cage_angle: 0.0,
        imperfections: Default::default(),
        cage_pocket_diameter: 8.1e-3,
        service: Default::default(),
        estimated_geometry: None,
    }
}
