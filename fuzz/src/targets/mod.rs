//! What is run on an input: each target calls the library as the command line does.

mod detector;
mod mapping;
mod measured;
mod model;
mod results;
mod ross;
mod set;

use std::path::Path;

use crate::dictionary;
use crate::outcome::Outcome;

/// Something that reads input of others.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    pub name: &'static str,
    /// Runs the program on an input; files go to the folder.
    pub run: fn(&[u8], &Path) -> Outcome,
    /// Whether inputs are mostly text, and are changed by words and lines too.
    pub text: bool,
    /// Whether it reads HDF5 files, on which the library of that format may crash.
    pub hdf5: bool,
    /// Longest input \[bytes\].
    pub max_length: usize,
    /// Words of the format.
    pub dictionary: fn() -> Vec<Vec<u8>>,
    /// Folders of seeds from the top of the repository, beside `fuzz/corpus/NAME`, with the extension of their files.
    pub seed_files: &'static [(&'static str, &'static str)],
    /// Seeds that are not files.
    pub made_seeds: fn() -> Vec<Vec<u8>>,
}

const MODELS: &[(&str, &str)] = &[("models", "toml")];
const FOREIGN: &str = "tests/data/arrays/foreign";
const TABLES: &[(&str, &str)] = &[(FOREIGN, "csv"), (FOREIGN, "txt"), (FOREIGN, "lvm")];

/// All targets.
pub static ALL: [Target; 11] = [
    Target {
        name: "model",
        run: model::run,
        text: true,
        hdf5: false,
        max_length: 1 << 15,
        dictionary: dictionary::model,
        seed_files: MODELS,
        made_seeds: Vec::new,
    },
    Target {
        name: "set",
        run: set::run,
        text: true,
        hdf5: false,
        max_length: 1 << 12,
        dictionary: dictionary::model,
        seed_files: &[],
        made_seeds: set::seeds,
    },
    Target {
        name: "mapping",
        run: mapping::run,
        text: true,
        hdf5: false,
        max_length: 1 << 13,
        dictionary: dictionary::mapping,
        seed_files: &[],
        made_seeds: Vec::new,
    },
    Target {
        name: "ross",
        run: ross::run,
        text: true,
        hdf5: false,
        max_length: 1 << 14,
        dictionary: dictionary::ross,
        seed_files: &[("tests/data/ross/rotors", "toml"), ("tests/data/ross/rotors", "json")],
        made_seeds: Vec::new,
    },
    Target {
        name: "uff",
        run: |bytes, folder| measured::run(bytes, &folder.join("input.uff")),
        text: true,
        hdf5: false,
        max_length: 1 << 16,
        dictionary: dictionary::uff,
        seed_files: &[("tests/data/uff", "uff")],
        made_seeds: Vec::new,
    },
    Target {
        name: "mat",
        run: |bytes, folder| measured::run(bytes, &folder.join("input.mat")),
        text: false,
        hdf5: false,
        max_length: 1 << 16,
        dictionary: dictionary::mat,
        seed_files: &[("tests/data/arrays", "mat"), (FOREIGN, "mat")],
        made_seeds: Vec::new,
    },
    Target {
        name: "numpy",
        run: |bytes, folder| measured::run(bytes, &folder.join("input.npz")),
        text: false,
        hdf5: false,
        max_length: 1 << 16,
        dictionary: dictionary::numpy,
        seed_files: &[("tests/data/arrays", "npz"), (FOREIGN, "npz")],
        made_seeds: Vec::new,
    },
    Target {
        name: "csv",
        run: |bytes, folder| measured::run(bytes, &folder.join("input.csv")),
        text: true,
        hdf5: false,
        max_length: 1 << 16,
        dictionary: dictionary::csv,
        seed_files: TABLES,
        made_seeds: Vec::new,
    },
    Target {
        name: "wav",
        run: |bytes, folder| measured::run(bytes, &folder.join("input.wav")),
        text: false,
        hdf5: false,
        max_length: 1 << 14,
        dictionary: dictionary::wav,
        seed_files: &[(FOREIGN, "wav")],
        made_seeds: Vec::new,
    },
    Target {
        name: "hdf5",
        run: |bytes, folder| measured::run(bytes, &folder.join("input.h5")),
        text: false,
        hdf5: true,
        max_length: 1 << 17,
        dictionary: dictionary::hdf5,
        seed_files: &[(FOREIGN, "h5"), (FOREIGN, "mat")],
        made_seeds: Vec::new,
    },
    Target {
        name: "results",
        run: results::run,
        text: false,
        hdf5: true,
        max_length: 1 << 18,
        dictionary: dictionary::results,
        seed_files: &[],
        made_seeds: Vec::new,
    },
];

/// What tests of the engine run.
pub static DETECTOR: Target = Target {
    name: "detector",
    run: detector::run,
    text: false,
    hdf5: false,
    max_length: 1 << 10,
    dictionary: Vec::new,
    seed_files: &[],
    made_seeds: Vec::new,
};

/// The target of a name.
pub fn find(name: &str) -> Option<&'static Target> {
    ALL.iter().chain([&DETECTOR]).find(|target| target.name == name)
}
