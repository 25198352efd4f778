//! A second opinion: other programs' figures and other libraries' methods beside ours.

#[path = "../common/bearing.rs"]
mod bearing;

mod glb;
mod machine_export;
mod parry_distance;
mod parry_masses;
mod parry_overlaps;
mod rapier_cage;
mod text_files;
