//! Band layouts of matrices met before: over speed the sparsity of a machine's matrices hardly changes.

use super::{BandLayout, SparseMatrix};
use std::sync::{Arc, Mutex, PoisonError};

/// Layouts kept, the latest: at standstill, rotating, and some with other bearings.
const MOST: usize = 8;

/// Layouts by sparsity: what [`BandLayout::new`] gives, computed once for matrices with entries at the same positions.
#[derive(Debug, Default)]
pub struct LayoutCache(Mutex<Vec<Entry>>);

#[derive(Debug)]
struct Entry {
    patterns: Vec<SparseMatrix>,
    layout: Arc<BandLayout>,
}

impl LayoutCache {
    /// The layout of these matrices.
    pub fn layout(&self, patterns: &[&SparseMatrix]) -> Arc<BandLayout> {
        // A layout depends on nothing but the patterns, so that a list left by a panic is as good as any.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let same = |of: &Entry| {
            of.patterns.len() == patterns.len()
                && of.patterns.iter().zip(patterns).all(|(a, b)| a.same_pattern(b))
        };
        if let Some(found) = known.iter().find(|of| same(of)) {
            return found.layout.clone();
        }
        let layout = Arc::new(BandLayout::new(patterns));
        if known.len() == MOST {
            known.remove(0);
        }
        known.push(Entry { patterns: patterns.iter().map(|&a| a.clone()).collect(), layout: layout.clone() });
        layout
    }
}

/// A copy begins without layouts.
impl Clone for LayoutCache {
    fn clone(&self) -> Self {
        Self::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Triplets;

    fn chain(n: usize, order: impl Fn(usize) -> usize) -> SparseMatrix {
        let mut t = Triplets::new(n, n);
        for i in 0..n {
            t.add(order(i), order(i), 2.0);
            if i > 0 {
                t.add(order(i), order(i - 1), -1.0);
            }
        }
        t.build()
    }

    #[test]
    fn a_layout_is_that_of_the_matrices_whatever_was_asked_before() {
        let cache = LayoutCache::default();
        let plain = chain(9, |i| i);
        let others: Vec<SparseMatrix> = (1..12).map(|k| chain(12 + k, |i| (5 * i + k) % (12 + k))).collect();
        for matrix in others.iter().chain([&plain, &plain]) {
            let (found, own) = (cache.layout(&[matrix]), BandLayout::new(&[matrix]));
            assert_eq!(found.groups().collect::<Vec<_>>(), own.groups().collect::<Vec<_>>());
            assert_eq!(found.scatter(matrix), own.scatter(matrix));
        }
        let scaled = SparseMatrix::sum(&[(3.0, &plain)]);
        assert!(Arc::ptr_eq(&cache.layout(&[&plain]), &cache.layout(&[&scaled])));
        assert!(!Arc::ptr_eq(&cache.layout(&[&plain]), &cache.layout(&[&plain, &plain])));
        assert_eq!(cache.0.lock().unwrap().len(), MOST);
    }
}
