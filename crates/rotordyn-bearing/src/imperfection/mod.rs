//! Imperfect races and balls: what is given (`input`), and the height and slope that a ball meets (`profile`, from
//! `raceway` and `spall`).

mod input;
pub mod profile;
mod raceway;
mod spall;
mod surface;

pub use input::{BallSpin, BallWave, Defect, DefectForm, DefectLaw, Imperfections, OffSize, Shape, Wave};
pub use profile::{Deviation, Profile, ProfileState};
pub use surface::Surface;
