//! A request to end a long computation, from another thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the end of a computation is requested; its clones share the request.
///
/// The computation looks at it from time to time and then ends soon, with an error.
#[derive(Clone, Debug, Default)]
pub struct StopRequest(Arc<AtomicBool>);

impl StopRequest {
    /// The request that a flag stands for, such as that of a signal.
    pub fn of(flag: Arc<AtomicBool>) -> Self {
        Self(flag)
    }

    pub fn request(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Settings that differ in who may end the computation are the same settings.
impl PartialEq for StopRequest {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
