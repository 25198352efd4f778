//! Signals that end a command: the first requests a clean stop, the second ends the program at once.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock};

use rotordyn::linalg::StopRequest;
#[cfg(unix)]
use signal_hook::consts::{SIGHUP, SIGXFSZ};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

static REQUESTED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
/// The signal received, 0 before.
static SIGNAL: LazyLock<Arc<AtomicUsize>> = LazyLock::new(Arc::default);

/// Installs the handlers of Ctrl-C (SIGINT), SIGTERM and, where it is not ignored (`nohup`), SIGHUP.
pub fn install_handlers() {
    let mut signals = vec![SIGINT, SIGTERM];
    #[cfg(unix)]
    if !is_ignored(SIGHUP) {
        signals.push(SIGHUP);
    }
    let received: Vec<Arc<AtomicBool>> = signals.iter().map(|_| Arc::default()).collect();
    for (own, &signal) in signals.iter().enumerate() {
        // The same signal again ends the program, and so does another one, even if both arrive together on two
        // threads: each marks its own flag before it reads the others. Without handlers a signal kills the program;
        // the files stay readable even then.
        let end_if =
            |flag: &Arc<AtomicBool>| flag::register_conditional_shutdown(signal, 128 + signal, flag.clone());
        let _ = end_if(&received[own]);
        let _ = flag::register(signal, received[own].clone());
        for (other, flag) in received.iter().enumerate() {
            if other != own {
                let _ = end_if(flag);
            }
        }
        let _ = flag::register_usize(signal, SIGNAL.clone(), signal as usize);
        let _ = flag::register(signal, REQUESTED.clone());
    }
    // A limit on the size of files is an error of the write then, not a signal that kills.
    #[cfg(unix)]
    let _ = flag::register(SIGXFSZ, Arc::default());
}

/// Whether the program was started with a signal ignored; assumed where the system does not say so.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|digits| u64::from_str_radix(digits.trim(), 16).ok());
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Whether a signal requested the end.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}

/// The request of a signal, for computations that end by one.
pub fn stop_request() -> StopRequest {
    StopRequest::of(REQUESTED.clone())
}

/// Exit code of a command that a signal ended: 128 and the number of the signal.
pub fn exit_code() -> u8 {
    match SIGNAL.load(Ordering::SeqCst) {
        0 => 130,
        signal => 128 + signal as u8,
    }
}

/// What ended a command: "Ctrl-C" or the name of the signal.
pub fn cause() -> &'static str {
    match exit_code() {
        143 => "SIGTERM",
        129 => "SIGHUP",
        _ => "Ctrl-C",
    }
}

/// Stops a study after a signal.
pub fn continue_unless_interrupted() -> ControlFlow<()> {
    if requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// Ends the program without the clean-up of its libraries.
pub fn end_at_once(code: u8) -> ! {
    signal_hook::low_level::exit(code.into())
}
