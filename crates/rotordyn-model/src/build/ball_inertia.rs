//! Centrifugal force and gyroscopic moment of balls, `ball_inertia`.

use crate::file::key::{Quantity, SubTable, Words, keys, positive, quantity, sub_table, words};
use crate::file::reader::Reader;
use rotordyn_bearing::BallInertia;
use rotordyn_units::FORCE;

keys! {
    /// `ball_inertia`: a keyword or a table.
    pub(super) static BALL_INERTIA: BallInertiaKeys {
        ball_inertia: Words<BallInertia> = words(&[
            ("auto", BallInertia::Auto(None)),
            ("none", BallInertia::None),
            ("outer_race_control", BallInertia::OuterRaceControl),
            ("inner_race_control", BallInertia::InnerRaceControl),
            ("harris_inner_race_control", BallInertia::HarrisInnerRaceControl),
            ("shared", BallInertia::Shared),
            ("centrifugal", BallInertia::Centrifugal),
        ], "Centrifugal force and gyroscopic moment of the balls, and the race that takes the moment.")
            .default("auto");
        given: SubTable = sub_table(GivenInertiaKeys::TABLE).named("ball_inertia");
    }
}

keys! {
    /// `ball_inertia = { ... }`.
    static GIVEN_INERTIA: GivenInertiaKeys = "A constant force of every ball at any speed, without moment." {
        centrifugal_force: Quantity = quantity(positive(FORCE), "Centrifugal force.").example("\"120 N\"");
    }
}

/// Ball inertia: a keyword, or `{ centrifugal_force = "120 N" }`.
pub(super) fn read(r: &Reader) -> BallInertia {
    if !r.has_table(&BALL_INERTIA.given) {
        return r.word(&BALL_INERTIA.ball_inertia);
    }
    let Some(given) = r.table(&BALL_INERTIA.given) else { return BallInertia::default() };
    let force = given.value(&GIVEN_INERTIA.centrifugal_force);
    given.finish();
    BallInertia::CentrifugalForce(force)
}
