//! Arguments of `init`, with the starter machines.

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use std::path::PathBuf;

/// Arguments of `init`.
#[derive(Args, Clone, Debug)]
pub struct InitArgs {
    /// The starter machine; without it they are listed
    #[arg(value_name = "KIND", value_parser = starter())]
    pub kind: Option<Starter>,
    /// File to write, - for standard output [default: KIND.toml in this folder]
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long)]
    pub force: bool,
}

/// A starter machine.
#[derive(Clone, Copy, Debug)]
pub struct Starter {
    pub name: &'static str,
    pub meaning: &'static str,
    pub text: &'static str,
}

/// The starter machines, by name.
pub const STARTERS: [Starter; 6] = [
    Starter {
        name: "motor",
        meaning: "Motor on two 6205 with a wave spring",
        text: include_str!("../../../assets/init/motor.toml"),
    },
    Starter {
        name: "fan",
        meaning: "Overhung fan on two 6208 with a belt drive",
        text: include_str!("../../../assets/init/fan.toml"),
    },
    Starter {
        name: "pump",
        meaning: "Pump with an overhung impeller on a 6306 and a pair of 7306B",
        text: include_str!("../../../assets/init/pump.toml"),
    },
    Starter {
        name: "spindle",
        meaning: "Spindle on a pair of 7014C and a spring-loaded 7012C",
        text: include_str!("../../../assets/init/spindle.toml"),
    },
    Starter {
        name: "vertical",
        meaning: "Vertical rotor on a pair of 7208B and a spring-loaded 6207",
        text: include_str!("../../../assets/init/vertical.toml"),
    },
    Starter {
        name: "test-rig",
        meaning: "Overhung disc on two 6205 in flexible housings with a belt",
        text: include_str!("../../../assets/init/test-rig.toml"),
    },
];

/// Parser of a kind, which lists all of them in the help.
fn starter() -> impl TypedValueParser<Value = Starter> {
    PossibleValuesParser::new(STARTERS.map(|kind| PossibleValue::new(kind.name).help(kind.meaning)))
        .try_map(|name| STARTERS.into_iter().find(|kind| kind.name == name).ok_or("an unknown kind"))
}
