//! Instants of a long study at which it can be stopped, and from which it can be resumed.

/// An instant of a study: the share done, and a snapshot if one is wanted.
pub struct Milestone<'a, S> {
    /// Completed share, 0 to 1.
    pub share: f64,
    take: &'a dyn Fn() -> S,
}

impl<'a, S> Milestone<'a, S> {
    /// An instant whose snapshot `take` gives.
    pub fn new(share: f64, take: &'a dyn Fn() -> S) -> Self {
        Self { share, take }
    }

    /// What the study needs to go on from here to the same bits as if it had never been stopped.
    pub fn snapshot(&self) -> S {
        (self.take)()
    }
}
