//! Arguments of `bearing`.

use clap::Args;

use super::StudyArgs;

/// Which bearings, under what.
#[derive(Args, Clone, Debug)]
pub struct BearingArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    /// Names of bearings, separated by commas [default: every ball bearing]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub bearing: Vec<String>,
    /// Load of the shaft on the bearing F_x, F_y, F_z, such as "0, -500, 100 N"
    #[arg(long, value_name = "FORCES", allow_hyphen_values = true)]
    pub load: Option<String>,
    /// Moments M_x, M_y, such as "0, 4 N m"
    #[arg(long, value_name = "MOMENTS", allow_hyphen_values = true)]
    pub moment: Option<String>,
    /// Shaft speed, such as "3000 rpm" [default: the highest of the speed profile]
    #[arg(long, value_name = "SPEED")]
    pub speed: Option<String>,
    /// Motions held at the centred place, such as z,theta_x,theta_y
    #[arg(long, value_name = "MOTIONS", value_delimiter = ',')]
    pub hold: Vec<String>,
    /// What to vary: load, displacement, speed or cage_angle, with its range or one of its own, such as
    /// load="0 N .. 2 kN" or speed; can be repeated
    #[arg(long, value_name = "NAME[=RANGE]")]
    pub sweep: Vec<String>,
    /// What loads and displacements go along: load (all components in proportion), x, y, z, theta_x, theta_y
    #[arg(long, value_name = "MOTION")]
    pub along: Option<String>,
    /// Average over the cage's position instead of the cage angle of the model
    #[arg(long)]
    pub averaged: bool,
}
