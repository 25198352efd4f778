//! Changes of an input, seeded and reproducible: bytes, numbers of every width, words, lines, parts of other inputs.

mod blocks;
mod numbers;
mod text;
mod zip;

use fastrand::Rng;

/// Most changes of one input.
const MAX_CHANGES: u32 = 6;

/// Changes inputs of one target.
pub struct Mutator {
    rng: Rng,
    dictionary: Vec<Vec<u8>>,
    text: bool,
    max_length: usize,
}

impl Mutator {
    pub fn new(seed: u64, dictionary: Vec<Vec<u8>>, text: bool, max_length: usize) -> Self {
        Mutator { rng: Rng::with_seed(seed), dictionary, text, max_length }
    }

    /// A changed input of the corpus; later entries, which did something new, are chosen more often.
    pub fn next(&mut self, corpus: &[Vec<u8>]) -> Vec<u8> {
        let (Some(parent), Some(other)) = (self.choose(corpus), self.choose(corpus)) else {
            return Vec::new();
        };
        let mut input = parent.clone();
        // Mostly one or two: more are refused for the first of them.
        let mut draw = || self.rng.u32(0..MAX_CHANGES);
        let changes = 1 + draw().min(draw()).min(draw());
        for _ in 0..changes {
            self.change(&mut input, other);
        }
        input.truncate(self.max_length);
        // Most archives with a changed member must have the checksum of it, or only the checksum is tested.
        if zip::is_zip(&input) && self.rng.u8(0..4) > 0 {
            zip::correct_checksums(&mut input);
        }
        input
    }

    fn choose<'c>(&mut self, corpus: &'c [Vec<u8>]) -> Option<&'c Vec<u8>> {
        let recent = self.rng.u8(0..3) == 0;
        let from = if recent { corpus.len().saturating_sub(32) } else { 0 };
        let place = from + self.rng.usize(0..(corpus.len() - from).max(1));
        corpus.get(place)
    }

    /// One change.
    fn change(&mut self, input: &mut Vec<u8>, other: &[u8]) {
        let rng = &mut self.rng;
        if self.text && rng.u8(0..4) > 0 {
            match rng.u8(0..7) {
                0 | 1 => text::replace_number(rng, input),
                2 => text::change_line(rng, input, other),
                3 => text::replace_value(rng, input, other, &self.dictionary),
                4 => text::replace_word(rng, input, &self.dictionary),
                5 => text::insert_word(rng, input, &self.dictionary),
                _ => text::replace_character(rng, input),
            }
            return;
        }
        match rng.u8(0..14) {
            0 => numbers::flip_bit(rng, input),
            1 | 2 => numbers::set_byte(rng, input),
            3..=5 => numbers::edit_integer(rng, input),
            6 => numbers::set_float(rng, input),
            7 => blocks::delete(rng, input),
            8 => blocks::copy_within(rng, input),
            9 => blocks::repeat(rng, input, self.max_length),
            10 => blocks::insert_from(rng, input, other),
            11 => blocks::splice(rng, input, other),
            12 => blocks::overwrite(rng, input, &self.dictionary),
            _ => blocks::cut(rng, input),
        }
    }
}

/// A block of up to `longest` bytes somewhere in `length` bytes, mostly short.
fn block(rng: &mut Rng, length: usize, longest: usize) -> std::ops::Range<usize> {
    if length == 0 {
        return 0..0;
    }
    let limit = match rng.u8(0..4) {
        0 | 1 => 8,
        2 => 64,
        _ => longest,
    };
    let size = 1 + rng.usize(0..limit.min(length).max(1));
    let start = rng.usize(0..length);
    start..(start + size).min(length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Inputs are the same for the same seed, differ from their parents, and stay within their length.
    #[test]
    fn inputs_are_reproducible_and_limited() {
        let corpus = vec![b"rate = 12 kHz\n[channel.A]\nunit = \"g\"\n".to_vec(), (0..=255).collect()];
        let words = vec![b"station".to_vec()];
        for text in [false, true] {
            let make = |seed| {
                let mut mutator = Mutator::new(seed, words.clone(), text, 300);
                (0..2000).map(|_| mutator.next(&corpus)).collect::<Vec<_>>()
            };
            let inputs = make(7);
            assert_eq!(inputs, make(7));
            assert_ne!(inputs, make(8));
            assert!(inputs.iter().all(|input| input.len() <= 300));
            let unchanged = inputs.iter().filter(|input| corpus.contains(input)).count();
            assert!(unchanged < inputs.len() / 5, "{unchanged} unchanged");
            assert!(inputs.iter().any(|input| input.windows(7).filter(|w| w == b"station").count() > 0));
        }
    }

    #[test]
    fn empty_inputs_are_changed_without_a_panic() {
        for text in [false, true] {
            let mut mutator = Mutator::new(1, Vec::new(), text, 50);
            (0..5000).for_each(|_| drop(mutator.next(&[Vec::new(), vec![0]])));
            assert!(mutator.next(&[]).is_empty());
        }
    }
}
