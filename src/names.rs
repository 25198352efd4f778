//! Names that a user may have meant.

/// Of the known names the most similar to a word, if it is similar enough to be meant.
///
/// Case counts not, nor whether words are joined by `-`, `_` or a space. Similar enough: a Jaro-Winkler similarity above
/// 0.87, or no more edits (Damerau-Levenshtein) than a third of the word's letters. Of equals the first by alphabet.
pub fn nearest<'n>(word: &str, known: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    let plain = |s: &str| s.to_lowercase().replace(['-', ' '], "_");
    let word = plain(word);
    let score = |name: &str| strsim::jaro_winkler(&word, &plain(name));
    let best = known.into_iter().max_by(|a, b| score(a).total_cmp(&score(b)).then(b.cmp(a)))?;
    let close = strsim::damerau_levenshtein(&word, &plain(best)) <= word.chars().count() / 3;
    (close || score(best) > 0.87).then_some(best)
}
