//! Names of coherence functions: `coh1`, `H1_coherence`, `coherence disc/A`.

/// Whether a part of a name says that it is a coherence.
pub(super) fn is_coherence(name: &str) -> bool {
    parts(name).any(|part| is_word(&part.to_lowercase()))
}

/// The FRF to which a coherence belongs by its name: `H1_coherence` and `coherence H1` to `H1`, `coh_1` to the only one that ends
/// in 1.
pub(super) fn frf_of<'a>(coherence: &'a str, frfs: &'a [String]) -> Option<&'a str> {
    if let Some(frf) = coherence.strip_prefix("coherence ") {
        return Some(frf);
    }
    let kept: Vec<String> = parts(coherence).map(str::to_lowercase).filter(|part| !is_word(part)).collect();
    let plain = |name: &str| parts(name).collect::<Vec<_>>().join(" ").to_lowercase();
    let base = kept.join(" ");
    if let Some(same) = frfs.iter().find(|frf| !base.is_empty() && plain(frf) == base) {
        return Some(same);
    }
    let own = number(coherence)?;
    let mut fitting = frfs.iter().filter(|frf| number(frf) == Some(own));
    let only = fitting.next().filter(|_| fitting.next().is_none())?;
    // Nothing but the number is in the name.
    (kept.is_empty() || base == own).then_some(only)
}

fn parts(name: &str) -> impl Iterator<Item = &str> {
    name.split([' ', '_', '-', '.', '(', ')', '[', ']']).filter(|part| !part.is_empty())
}

/// `coh`, `coherence`, `coh12`, `Kohaerenz`.
fn is_word(part: &str) -> bool {
    let word = part.trim_end_matches(|c: char| c.is_ascii_digit());
    part.starts_with("coh") || matches!(word, "kohärenz" | "kohaerenz" | "gamma" | "γ" | "γ²")
}

/// Digits at the end of a name.
fn number(name: &str) -> Option<&str> {
    let name = name.trim_end_matches([')', ']']);
    let digits = &name[name.trim_end_matches(|c: char| c.is_ascii_digit()).len()..];
    (!digits.is_empty()).then_some(digits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coherences_belong_to_frfs() {
        let frfs: Vec<String> = ["H1", "H2", "disc", "H12"].map(str::to_owned).into();
        for (name, expected) in [
            ("H1_coherence", Some("H1")),
            ("coherence H2", Some("H2")),
            ("Coherence(H1)", Some("H1")),
            ("coh_1", Some("H1")),
            ("coh2", Some("H2")),
            ("disc coherence", Some("disc")),
            ("coh12", Some("H12")),
            ("coh3", None),
            ("coherence", None),
        ] {
            assert_eq!(frf_of(name, &frfs), expected, "{name}");
            assert!(is_coherence(name), "{name}");
        }
        for other in ["incoherent", "H1", "incoh_psd"] {
            assert!(!is_coherence(other), "{other}");
        }
    }
}
