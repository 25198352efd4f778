//! Names of other programs and textbooks for keys of the file.

/// Other names of tables and keys, with those of the file.
const SYNONYMS: [(&str, &str); 30] = [
    ("E", "young"),
    ("G", "shear"),
    ("nu", "poisson"),
    ("rho", "density"),
    ("diameter", "outer_diameter"),
    ("type", "model"),
    ("kind", "model"),
    ("mass", "disc"),
    ("impeller", "disc"),
    ("spring", "bushing"),
    ("damper", "bushing"),
    ("pedestal", "housing"),
    ("support", "housing"),
    ("force", "load"),
    ("wave_spring", "bearing"),
    ("preload", "bearing"),
    ("simulation", "study"),
    ("analysis", "study"),
    ("k_tx", "k_tilt_x"),
    ("k_ty", "k_tilt_y"),
    ("k_tz", "k_spin"),
    ("k_rx", "k_tilt_x"),
    ("k_ry", "k_tilt_y"),
    ("k_rz", "k_spin"),
    ("c_tx", "c_tilt_x"),
    ("c_ty", "c_tilt_y"),
    ("c_tz", "c_spin"),
    ("c_rx", "c_tilt_x"),
    ("c_ry", "c_tilt_y"),
    ("c_rz", "c_spin"),
];

/// The key, one of those known in a table, that a word is another name of.
pub(super) fn key_of_synonym(word: &str, known: &[&str]) -> Option<&'static str> {
    SYNONYMS.iter().find(|(other, key)| *other == word && known.contains(key)).map(|(_, key)| *key)
}
