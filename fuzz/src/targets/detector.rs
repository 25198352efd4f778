//! Does what the input asks for, to test that the engine notices it.

use std::hint::black_box;
use std::path::Path;

use crate::outcome::Outcome;

pub fn run(bytes: &[u8], _: &Path) -> Outcome {
    let asked = |word: &str| bytes.windows(word.len()).any(|window| window == word.as_bytes());
    if asked("panic") {
        panic!("asked to panic");
    }
    if asked("thread") {
        // The program goes on without this thread.
        drop(std::thread::spawn(|| panic!("asked to panic in a thread")).join());
    }
    if asked("overflow") {
        let most = black_box(u32::MAX);
        black_box(most + 1);
    }
    if asked("abort") {
        std::process::abort();
    }
    if asked("stack") {
        black_box(deep(0));
    }
    if asked("memory") {
        black_box(vec![1_u8; 8 << 30]);
    }
    if asked("loop") {
        let mut steps = 0_u64;
        while black_box(true) {
            steps = black_box(steps.wrapping_add(1));
        }
    }
    Outcome::accepted("as asked")
}

fn deep(level: u64) -> u64 {
    let frame = black_box([level; 64]);
    if level == u64::MAX { 0 } else { deep(level + 1).wrapping_add(frame[0]) }
}
