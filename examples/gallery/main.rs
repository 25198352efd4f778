//! Draws every kind of figure from synthetic but realistic data into `out/gallery`.
//!
//! `cargo run --release --example gallery`

mod machine;
mod over_speed;

use std::path::Path;

use machine::*;
use over_speed::*;
use rotordyn::plot::{Figure, write};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new("out/gallery");
    std::fs::create_dir_all(folder)?;
    for (name, figure) in figures() {
        write(&figure, &[], &folder.join(name))?;
        println!("{}", folder.join(name).display());
    }
    Ok(())
}

fn figures() -> Vec<(&'static str, Figure)> {
    vec![
        ("campbell", campbell()),
        ("spectrogram", spectrogram()),
        ("waterfall", waterfall()),
        ("order_map", order_map()),
        ("order_cuts", order_cuts()),
        ("frf", frf()),
        ("frf_measured", frf_measured()),
        ("modes", modes()),
        ("bode", bode()),
        ("polar", polar()),
        ("orbits", orbits()),
        ("ball_loads", ball_loads()),
        ("deflection", deflection()),
        ("history", history()),
        ("stiffness", stiffness()),
        ("rig", rig()),
    ]
}
