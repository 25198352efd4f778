//! Arguments of `bearing`.

use clap::Args;

use super::StudyArgs;
use super::keys::{help as key_help, help_with as key_help_with};

/// Loads, ball inertia, friction and examples.
pub(super) const HELP: &str = "\
Loads act from the shaft on the bearing. DOFs are x, y, z (along the shaft), theta_x, theta_y. With --load, tilts are \
constrained unless --moment is given; in a machine, tilts and axial position are constrained in the sweeps.

Ball inertia (ball_inertia of a bearing, with the race that resists the gyroscopic moment M of a ball of diameter D by \
friction at (inner, outer) race): auto [default: massless, or outer_race_control where the centrifugal force exceeds \
0.3 % of the largest contact load], none, outer_race_control (0, 2) M/D, inner_race_control (2, 0) M/D, \
harris_inner_race_control (1, 1) M/D, shared (in proportion to the contact loads), centrifugal (no moment), \
{ centrifugal_force = \"120 N\" }. Outer race control is the default since the moment matters at high speed, where the \
centrifugal force gives the outer contact the larger load and friction.

Friction torque (Palmgren): lubrication of a bearing (oil_bath [default], oil_mist, oil_jet, grease or { f_0 = 1.5 }) gives \
the factor of the viscous part, sliding_friction [0.06] the spinning of the balls.

Examples:
  rotordyn bearing models/overhung_rig.toml
  rotordyn bearing models/overhung_rig.toml --bearing A --load \"0, -500, 100 N\" --speed \"3000 rpm\"
  rotordyn bearing my_bearing.toml --sweep load=\"0 N .. 2 kN\" --along y --cage-average
  rotordyn bearing my_bearing.toml --sweep displacement=\"0 um .. 30 um\" --along z --constrain x,y,theta_x,theta_y
  rotordyn bearing my_bearing.toml --sweep speed=\"0 rpm .. 20000 rpm\"
  rotordyn bearing models/overhung_rig.toml --variant free_balls --bearing B --load \"0, -50, 0 N\" --speed \"6000 rpm\" \
--skidding --skidding-loads \"10, 20, 50 N\" --skidding-speeds \"2000, 4000, 6000 rpm\"";

/// Bearings, operating point and sweeps.
#[derive(Args, Clone, Debug)]
pub struct BearingArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    #[arg(long, value_name = "NAMES", value_delimiter = ',', help = key_help_with("study.bearing.bearings", "separated by commas"))]
    pub bearing: Vec<String>,
    #[arg(long, value_name = "FORCES", allow_hyphen_values = true, help = key_help("study.bearing.load"))]
    pub load: Option<String>,
    #[arg(long, value_name = "MOMENTS", allow_hyphen_values = true, help = key_help("study.bearing.moment"))]
    pub moment: Option<String>,
    #[arg(long, value_name = "SPEED", help = key_help("study.bearing.speed"))]
    pub speed: Option<String>,
    #[arg(long, alias = "hold", value_name = "MOTIONS", value_delimiter = ',', help = key_help_with("study.bearing.constrain", "such as z,theta_x,theta_y"))]
    pub constrain: Vec<String>,
    /// Quantity to sweep: load, displacement, speed or cage_angle, with a range or with its default range,
    /// such as load="0 N .. 2 kN" or speed; can be repeated
    #[arg(long, value_name = "NAME[=RANGE]")]
    pub sweep: Vec<String>,
    #[arg(long, value_name = "MOTION", help = key_help("study.bearing.along"))]
    pub along: Option<String>,
    #[arg(long, alias = "averaged", help = key_help("study.bearing.cage_average"))]
    pub cage_average: bool,
    /// Cage slip of bearings with free balls over load and speed: a map with --skidding-loads and --skidding-speeds
    #[arg(long)]
    pub skidding: bool,
    #[arg(long, value_name = "FORCES", requires = "skidding", help = key_help("study.bearing.skidding_loads"))]
    pub skidding_loads: Option<String>,
    #[arg(long, value_name = "SPEEDS", requires = "skidding", help = key_help("study.bearing.skidding_speeds"))]
    pub skidding_speeds: Option<String>,
    /// Also export the settled motion of free balls and cage over this many turns of the cage, as motion.glb and
    /// motion.pvd in the folder motion_BEARING
    #[arg(long, value_name = "TURNS", value_parser = clap::value_parser!(u64).range(1..=100))]
    pub motion: Option<u64>,
}
