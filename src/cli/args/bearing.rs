//! Arguments of `bearing`.

use clap::Args;

use super::StudyArgs;

/// Bearings, operating point and sweeps.
#[derive(Args, Clone, Debug)]
pub struct BearingArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    /// Bearing names, separated by commas [default: all ball bearings]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub bearing: Vec<String>,
    /// Load F_x, F_y, F_z of the shaft on the bearing, such as "0, -500, 100 N"
    #[arg(long, value_name = "FORCES", allow_hyphen_values = true)]
    pub load: Option<String>,
    /// Moments M_x, M_y, such as "0, 4 N m"
    #[arg(long, value_name = "MOMENTS", allow_hyphen_values = true)]
    pub moment: Option<String>,
    /// Shaft speed, such as "3000 rpm" [default: the highest of the speed profile]
    #[arg(long, value_name = "SPEED")]
    pub speed: Option<String>,
    /// DOFs constrained at the centred position, such as z,theta_x,theta_y
    #[arg(long, alias = "hold", value_name = "MOTIONS", value_delimiter = ',')]
    pub constrain: Vec<String>,
    /// Quantity to sweep: load, displacement, speed or cage_angle, with a range or with its default range,
    /// such as load="0 N .. 2 kN" or speed; can be repeated
    #[arg(long, value_name = "NAME[=RANGE]")]
    pub sweep: Vec<String>,
    /// Direction of load and displacement sweeps: load (all components in proportion), x, y, z, theta_x,
    /// theta_y
    #[arg(long, value_name = "MOTION")]
    pub along: Option<String>,
    /// Average over the cage angle instead of using the cage angle of the model
    #[arg(long, alias = "averaged")]
    pub cage_average: bool,
}
