//! Seeds: the models, the small files of `corpus` and those that once crashed a reader.

use std::collections::BTreeSet;
use std::path::PathBuf;

use crate::folders::{files, top};
use crate::targets::Target;

/// Folder of the inputs that once crashed a target.
pub fn regressions(target: &Target) -> PathBuf {
    top().join("fuzz/regressions").join(target.name)
}

/// All seeds of a target, without repetitions.
pub fn seeds(target: &Target) -> Vec<Vec<u8>> {
    let mut folders = vec![(top().join("fuzz/corpus").join(target.name), "*")];
    folders.extend(target.seed_files.iter().map(|(folder, extension)| (top().join(folder), *extension)));
    folders.push((regressions(target), "*"));
    let of_files = folders.iter().flat_map(|(folder, extension)| files(folder, extension));
    let mut known = BTreeSet::new();
    let all = of_files.map(|(_, bytes)| bytes).chain((target.made_seeds)());
    all.filter(|seed| seed.len() <= target.max_length && known.insert(seed.clone())).collect()
}
