//! Output-only identification of seeded synthetic machines with known modes.

mod coverage;
mod harmonics;
mod machine;
mod modes;
mod refusals;
