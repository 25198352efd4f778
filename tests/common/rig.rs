//! The overhung rig from its model file.
#![allow(dead_code)]

use rotordyn::model::{Model, Options, load};

/// The rig's three bearing models of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Supports {
    Spherical,
    Cylindrical,
    BallBearings,
}

/// The rig with one of its bearing models.
pub fn rig(supports: Supports) -> Model {
    match supports {
        Supports::Spherical => variant(Some("spherical"), &[]),
        Supports::Cylindrical => variant(Some("cylindrical"), &[]),
        Supports::BallBearings => variant(None, &[]),
    }
}

/// The rig with a variant and overriding settings.
pub fn variant(variant: Option<&str>, set: &[(&str, &str)]) -> Model {
    let options = Options {
        variant: variant.map(String::from),
        set: set.iter().map(|(path, value)| ((*path).into(), (*value).into())).collect(),
    };
    match load("overhung_rig.toml", include_str!("../../models/overhung_rig.toml"), &options) {
        Ok(loaded) => loaded.model,
        Err(errors) => panic!("{errors:?}"),
    }
}
