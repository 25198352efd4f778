//! Arguments of `import`.

use clap::Args;
use std::path::PathBuf;

pub const EXAMPLES: &str = "\
Examples:
  rotordyn import rotor.toml -o machine.toml
  rotordyn import rotor.json -o - | less
  rotordyn import rotor.json --json --quiet | jq .not_carried";

/// Arguments of `import`.
#[derive(Args, Clone, Debug)]
pub struct ImportArgs {
    /// A rotor saved by ROSS (Rotor.save), TOML or JSON
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Model file to write, - for standard output [default: FILE's name with _machine.toml, in this folder]
    #[arg(long, short, value_name = "MODEL")]
    pub output: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long)]
    pub force: bool,
}
