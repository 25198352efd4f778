//! Cross-checks with independent readers and with the methods of other libraries (parry, rapier).

#[path = "../../crates/rotordyn-bearing/tests/common/bearing.rs"]
mod bearing;

mod glb;
mod machine_export;
mod parry_distance;
mod parry_masses;
mod parry_overlaps;
mod rapier_cage;
mod text_files;
