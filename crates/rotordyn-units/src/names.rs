//! Names: the known name nearest to a misspelt one, and names of files.

/// The known name most similar to a word, if it is similar enough to be meant.
///
/// Ignores case and whether words are joined by `-`, `_` or a space. Similar enough: a Jaro-Winkler similarity above
/// 0.87, or at most as many edits (Damerau-Levenshtein) as a third of the word's letters. Ties: first in the alphabet.
pub fn nearest<'n>(word: &str, known: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    let plain = |s: &str| s.to_lowercase().replace(['-', ' '], "_");
    let word = plain(word);
    let score = |name: &str| strsim::jaro_winkler(&word, &plain(name));
    let best = known.into_iter().max_by(|a, b| score(a).total_cmp(&score(b)).then(b.cmp(a)))?;
    let close = strsim::damerau_levenshtein(&word, &plain(best)) <= word.chars().count() / 3;
    (close || score(best) > 0.87).then_some(best)
}

/// Similarity of two names from 0 to 1 (Jaro-Winkler), case ignored.
pub fn similarity(a: &str, b: &str) -> f64 {
    strsim::jaro_winkler(&a.to_lowercase(), &b.to_lowercase())
}

/// Portable file name: characters other than letters, digits, dot, underscore and dash become `_`.
pub fn file_name(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || "._-".contains(c) { c } else { '_' }).collect()
}
