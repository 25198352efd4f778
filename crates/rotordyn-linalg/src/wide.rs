//! Code compiled for the widest vectors of the processor.

use pulp::Arch;

/// Runs a closure compiled for the widest vectors of the processor, with the same rounding on every one.
///
/// Only what is inlined into it is: mark the closure and the functions it calls `#[inline(always)]`.
#[inline(always)]
pub fn with_widest_vectors<T>(task: impl FnOnce() -> T) -> T {
    Arch::new().dispatch(task)
}
