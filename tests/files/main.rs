//! Files written and read: round trips in Rust, exchange with h5py, scipy, numpy and pyuff, measured records.

mod analyser;
mod arrays;
mod example_records;
mod foreign_records;
mod formats;
mod hdf5_h5py;
mod hdf5_reader;
mod hdf5_round_trip;
mod hdf5_stream;
mod mapping;
mod matlab_structures;
#[path = "../common/measured_data.rs"]
mod measured_data;
mod measured_files;
mod motion;
mod own_exporter;
mod own_study;
mod report;
mod results_file;
#[path = "../common/rig.rs"]
mod rig;
mod rig_results;
mod saved_results;
mod stated_rates;
mod tables;
mod uff;
mod uff_measured;
mod uff_pyuff;
