//! Contact of ball and race.
