//! Comparison with published values; the file name gives the source.

#[path = "../common/agree.rs"]
mod agree;
#[path = "../../crates/rotordyn-bearing/tests/common/bearing.rs"]
mod bearing;
#[path = "../../crates/rotordyn-bearing/tests/common/ehl.rs"]
#[allow(dead_code)]
mod lubricated;
#[path = "../common/measured_data.rs"]
mod measured_data;
#[path = "../common/rig.rs"]
mod rig;
#[path = "../common/ross.rs"]
mod ross;

mod atef_2022;
mod atef_2022_geometry;
mod atef_2022_jerk;
mod atef_2022_lines;
mod atef_2022_records;
mod bal_2022_contacts;
mod bal_2022_frequencies;
mod bal_2022_machine;
mod bal_2022_preload;
mod cakmak_2010;
mod cakmak_2010_modes;
mod cwru_6205;
mod cwru_records;
mod iso16281;
mod iso_281_life;
mod iso_281_ratings;
mod iso_vg_oils;
mod nasa_tn_d_7870;
mod nelson_mcvaugh_1976;
mod ross_critical;
mod ross_elements;
mod ross_modes;
mod ross_responses;
mod ross_run_up;
mod upadhyay_2009;
mod wardle_1988;
mod zhang_2016;
mod zhang_2016_bearing;
mod zhang_2016_contacts;
mod zhang_2016_ehl;
