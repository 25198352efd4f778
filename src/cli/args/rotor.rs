//! Arguments of `critical-map` and `torsional`.

use super::StudyArgs;
use super::keys::{help as key_help, help_with as key_help_with};
use clap::Args;

pub const CRITICAL_MAP: &str = "\
Examples:
  rotordyn critical-map models/jeffcott.toml
  rotordyn critical-map models/jeffcott.toml --max-speed \"12000 rpm\" --lowest-stiffness \"1e4 N/m\"";

pub const TORSIONAL: &str = "\
Examples:
  rotordyn torsional models/overhung_rig.toml
  rotordyn torsional models/overhung_rig.toml --orders 1,2,6 --speed-range \"900, 1200 rpm\"";

#[derive(Args, Clone, Debug)]
pub struct CriticalMapArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    #[arg(long, value_name = "SPEED", help = key_help("study.critical_map.max_speed"))]
    pub max_speed: Option<String>,
    #[arg(long, value_name = "STIFFNESS", help = key_help("study.critical_map.lowest_stiffness"))]
    pub lowest_stiffness: Option<String>,
    #[arg(long, value_name = "STIFFNESS", help = key_help("study.critical_map.highest_stiffness"))]
    pub highest_stiffness: Option<String>,
}

#[derive(Args, Clone, Debug)]
pub struct TorsionalArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    #[arg(long, value_name = "SPEED", help = key_help("study.torsional.max_speed"))]
    pub max_speed: Option<String>,
    #[arg(long, value_name = "ORDERS", value_delimiter = ',', help = key_help_with("study.torsional.orders", "such as 1,2,6"))]
    pub orders: Vec<String>,
    #[arg(long, value_name = "N", help = key_help("study.torsional.modes"))]
    pub modes: Option<usize>,
    #[arg(long, value_name = "SPEEDS", help = key_help("study.torsional.operating_speeds"))]
    pub speed_range: Option<String>,
}
