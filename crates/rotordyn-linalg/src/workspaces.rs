//! Memory that tasks take in turn.

use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, PoisonError};

/// Workspaces, of which as many are made as tasks work at the same time.
///
/// What a task finds in one is not known: results must not depend on it.
#[derive(Debug)]
pub struct Workspaces<T>(Mutex<Vec<T>>);

/// A workspace, given back when dropped.
#[derive(Debug)]
pub struct Workspace<'a, T> {
    from: &'a Workspaces<T>,
    memory: Option<T>,
}

impl<T> Workspaces<T> {
    /// One that nobody uses, or a new one.
    pub fn take(&self, make: impl FnOnce() -> T) -> Workspace<'_, T> {
        // The list holds only complete workspaces: one left by a panic is as good as any.
        let free = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop();
        Workspace { from: self, memory: Some(free.unwrap_or_else(make)) }
    }
}

impl<T> Default for Workspaces<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

// The memory is there until the workspace is dropped.
impl<T> Deref for Workspace<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.memory.as_ref().expect("only dropping takes the memory")
    }
}

impl<T> DerefMut for Workspace<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        self.memory.as_mut().expect("only dropping takes the memory")
    }
}

impl<T> Drop for Workspace<'_, T> {
    fn drop(&mut self) {
        if let Some(memory) = self.memory.take() {
            self.from.0.lock().unwrap_or_else(PoisonError::into_inner).push(memory);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn workspaces_are_used_again() {
        let all = Workspaces::default();
        {
            let mut one = all.take(|| 1);
            let two = all.take(|| 2);
            assert_eq!((*one, *two), (1, 2));
            *one = 3;
        }
        let mut found = [*all.take(|| 4), 0];
        let first = all.take(|| 4);
        found[1] = *all.take(|| 4);
        assert_eq!((found, *first), ([3, 2], 3));
    }
}
