//! Cross-checks with independent readers and with the methods of other libraries (parry, rapier).

#[path = "../common/agree.rs"]
mod agree;
#[path = "../../crates/rotordyn-bearing/tests/common/bearing.rs"]
mod bearing;

#[allow(dead_code)] // the free-ball tests of the bearing crate use the rest
#[path = "../../crates/rotordyn-bearing/tests/free_ball/bearings.rs"]
mod free_balls;

mod glb;
mod machine_export;
mod parry_distance;
mod parry_free_balls;
mod parry_masses;
mod parry_overlaps;
mod rapier_cage;
mod rapier_integration;
mod ross_campbell;
mod ross_import;
mod text_files;
