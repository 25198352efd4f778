//! Limits of a worker process: memory, and processor time for one input.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Address space of a worker \[bytes\]: several times what any reader may use for inputs of this size (200 MB), with the
/// program, its libraries and the stacks of its threads.
pub const MEMORY: u64 = 1 << 30;

/// Processor time for one input \[s\].
pub const SECONDS: f64 = 2.0;

/// The same where a longer one is run once more by a process of its own, which then decides \[s\]: HDF5's library has
/// endless loops on damaged files, and thousands of inputs reach them.
pub const SECONDS_OF_FIRST_TRY: f64 = 0.3;

/// Exit code of a worker that stopped itself because an input took too long.
pub const TOO_LONG: i32 = 97;

/// Exit code of a worker that stopped itself because an input blocked it, without using processor time.
pub const BLOCKED: i32 = 98;

/// Waiting time that is taken for blocked, far above what a busy machine delays an input.
const PATIENCE: Duration = Duration::from_secs(120);

/// Processor time for the input under way may not exceed this \[ns\]; 0 between inputs.
static DEADLINE: AtomicU64 = AtomicU64::new(0);

/// Processor time of all threads of this process \[ns\].
#[cfg(unix)]
pub fn cpu_nanoseconds() -> u64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    (time.tv_sec as u64) * 1_000_000_000 + time.tv_nsec as u64
}

/// Time since the first call \[ns\], where processor time cannot be asked.
#[cfg(not(unix))]
pub fn cpu_nanoseconds() -> u64 {
    static START: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    START.get_or_init(std::time::Instant::now).elapsed().as_nanos() as u64
}

/// Limits the address space of this process \[bytes\], so that a promised size that is believed ends it; no core files.
#[cfg(unix)]
pub fn limit_memory(bytes: u64) {
    use rustix::process::{Resource, Rlimit, setrlimit};
    for (resource, limit) in [(Resource::As, bytes), (Resource::Core, 0)] {
        // A lower limit that is set from outside stays.
        let _ = setrlimit(resource, Rlimit { current: Some(limit), maximum: Some(limit) });
    }
}

#[cfg(not(unix))]
pub fn limit_memory(_: u64) {}

/// Ends this process by the signal of its limit after further processor time \[s\].
///
/// Limits of the system are whole seconds: a thread looks at the clock.
#[cfg(unix)]
pub fn limit_cpu_seconds(more: f64) {
    use rustix::process::{Signal, getpid, kill_process};
    static WATCH: std::sync::Once = std::sync::Once::new();
    start(more);
    WATCH.call_once(|| {
        std::thread::spawn(|| {
            while cpu_nanoseconds() < DEADLINE.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(20));
            }
            kill_process(getpid(), Signal::XCPU)
        });
    });
}

#[cfg(not(unix))]
pub fn limit_cpu_seconds(_: f64) {}

/// Sets all limits on this process and starts its watch.
pub fn impose() {
    limit_memory(MEMORY);
    std::thread::spawn(|| {
        let mut since = (0, Instant::now());
        loop {
            std::thread::sleep(Duration::from_millis(100));
            let deadline = DEADLINE.load(Ordering::Relaxed);
            if deadline != since.0 {
                since = (deadline, Instant::now());
            }
            if deadline > 0 && since.1.elapsed() > PATIENCE {
                eprintln!("blocked for {} s", PATIENCE.as_secs());
                std::process::exit(BLOCKED);
            }
            if deadline > 0 && cpu_nanoseconds() > deadline {
                eprintln!("more than the allowed processor time");
                std::process::exit(TOO_LONG);
            }
        }
    });
}

/// Starts the time of an input, which may take `seconds` of processor time; the time used so far \[ns\].
pub fn start(seconds: f64) -> u64 {
    let now = cpu_nanoseconds();
    DEADLINE.store(now + (seconds * 1e9) as u64, Ordering::Relaxed);
    now
}

/// Ends the time of an input that began at `start`; its duration \[s\].
pub fn stop(start: u64) -> f64 {
    DEADLINE.store(0, Ordering::Relaxed);
    1e-9 * cpu_nanoseconds().saturating_sub(start) as f64
}
