//! What a machine computed last, by speed: studies and their warnings ask for the same equilibria.

use std::fmt;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Values in the cache.
const MOST: usize = 8;

/// The last values by speed \[rad/s\].
pub(super) struct SpeedCache<T>(Mutex<Vec<(f64, T)>>);

impl<T: Clone> SpeedCache<T> {
    pub fn new() -> Self {
        Self(Mutex::default())
    }

    /// The value at a speed, computed if it is not in the cache.
    ///
    /// # Errors
    /// Those of the computation, which are not cached.
    pub fn at<E>(&self, speed: f64, compute: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
        if let Some((_, found)) = self.all().iter().find(|(at, _)| at.to_bits() == speed.to_bits()) {
            return Ok(found.clone());
        }
        let found = compute()?;
        let mut all = self.all();
        if all.len() == MOST {
            all.remove(0);
        }
        all.push((speed, found.clone()));
        Ok(found)
    }

    fn all(&self) -> MutexGuard<'_, Vec<(f64, T)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T> fmt::Debug for SpeedCache<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("SpeedCache")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_computed_once_and_the_oldest_is_dropped() {
        let cache = SpeedCache::new();
        let ask = |speed: f64, value: usize| cache.at(speed, || Ok::<_, ()>(value)).unwrap();
        assert_eq!([ask(1.0, 10), ask(1.0, 20), ask(0.0, 30), ask(-0.0, 40)], [10, 10, 30, 40]);
        assert_eq!(cache.at(2.0, || Err(())), Err(()));
        assert_eq!(ask(2.0, 50), 50);
        for k in 3..3 + MOST {
            ask(k as f64, k);
        }
        assert_eq!([ask(1.0, 60), ask(2.0 + MOST as f64, 70)], [60, 2 + MOST]);
    }
}
