//! Questions to the operating system: free disk space, processor time, names.

use std::path::Path;
#[cfg(unix)]
use std::time::Duration;

/// Stack of the thread that watches the processor time \[bytes\].
#[cfg(unix)]
const WATCH_STACK: usize = 64 << 10;

/// Free bytes of the file system of a folder that may not exist yet; `None` where it cannot be asked.
#[cfg(unix)]
pub fn free_space(folder: &Path) -> Option<f64> {
    let full = std::path::absolute(folder).ok()?;
    let existing = full.ancestors().find(|path| path.exists())?;
    let found = rustix::fs::statvfs(existing).ok()?;
    Some(found.f_bavail as f64 * found.f_frsize as f64)
}

#[cfg(not(unix))]
pub fn free_space(_: &Path) -> Option<f64> {
    None
}

/// Processor time of all threads of the program so far \[s\]; `None` where it cannot be asked.
#[cfg(unix)]
pub fn cpu_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64)
}

#[cfg(not(unix))]
pub fn cpu_seconds() -> Option<f64> {
    None
}

/// Limits the memory (address space) of the program to what it has and `bytes` more, and its core files to none.
#[cfg(target_os = "linux")]
pub fn limit_memory(bytes: u64) {
    use rustix::process::Resource;
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let size = status.lines().find_map(|line| line.strip_prefix("VmSize:")?.trim().strip_suffix("kB"));
    let own = size.and_then(|size| size.trim().parse::<u64>().ok());
    if let Some(own) = own {
        limit(Resource::As, own.saturating_mul(1024).saturating_add(bytes));
    }
    limit(Resource::Core, 0);
}

#[cfg(not(target_os = "linux"))]
pub fn limit_memory(_: u64) {}

/// Opens no further file: the next free number of a file is the first that is not allowed.
#[cfg(unix)]
pub fn limit_files() {
    use std::os::fd::AsRawFd;
    // The lowest free number, which this file has for a moment.
    let Ok(next) = std::fs::File::open("/dev/null") else { return };
    if let Ok(number) = u64::try_from(next.as_raw_fd()) {
        limit(rustix::process::Resource::Nofile, number);
    }
}

#[cfg(not(unix))]
pub fn limit_files() {}

/// Ends the program by SIGXCPU when it has computed so long from now on \[s\], in place of an earlier limit.
///
/// Limits of the system are whole seconds: a thread of the program looks at its clock, and the system's limit is for the
/// case that it cannot.
#[cfg(unix)]
pub fn limit_cpu_seconds(seconds: f64) {
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicU64, Ordering};
    static END_MICROSECONDS: AtomicU64 = AtomicU64::new(u64::MAX);
    static WATCH: OnceLock<bool> = OnceLock::new();
    let Some(used) = cpu_seconds() else { return };
    END_MICROSECONDS.store((1e6 * (used + seconds)) as u64, Ordering::Relaxed);
    limit(rustix::process::Resource::Cpu, (used + seconds).ceil() as u64 + 1);
    let watch = || {
        loop {
            let end = 1e-6 * END_MICROSECONDS.load(Ordering::Relaxed) as f64;
            let left = cpu_seconds().map_or(0.0, |used| end - used);
            if left <= 0.0 {
                let _ =
                    rustix::process::kill_process(rustix::process::getpid(), rustix::process::Signal::XCPU);
            }
            // One thread computes, so that the time left cannot pass sooner.
            std::thread::sleep(Duration::from_secs_f64(left.clamp(0.01, 1.0)));
        }
    };
    WATCH.get_or_init(|| std::thread::Builder::new().stack_size(WATCH_STACK).spawn(watch).is_ok());
}

#[cfg(not(unix))]
pub fn limit_cpu_seconds(_: f64) {}

/// Sets the current limit, not beyond the one that the system allows.
#[cfg(unix)]
fn limit(resource: rustix::process::Resource, value: u64) {
    let allowed = rustix::process::getrlimit(resource);
    let current = Some(allowed.maximum.map_or(value, |most| most.min(value)));
    let new = rustix::process::Rlimit { current, maximum: allowed.maximum };
    // Without the limit a damaged file costs more, but only this process.
    let _ = rustix::process::setrlimit(resource, new);
}

/// Name of this computer in its network; "this computer" where it cannot be asked.
pub fn host_name() -> String {
    // Linux; Windows; shells that pass it on.
    let known = std::fs::read_to_string("/proc/sys/kernel/hostname").ok();
    let named = |variable| std::env::var(variable).ok();
    let name = known.or_else(|| named("COMPUTERNAME")).or_else(|| named("HOSTNAME"));
    name.map_or("this computer".into(), |name| name.trim().to_string())
}

/// Whether an open file is still the one of this path.
#[cfg(unix)]
pub fn is_same_file(file: &std::fs::File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |found: std::fs::Metadata| (found.dev(), found.ino());
    matches!((file.metadata().map(id), std::fs::metadata(path).map(id)), (Ok(a), Ok(b)) if a == b)
}

#[cfg(not(unix))]
pub fn is_same_file(_: &std::fs::File, path: &Path) -> bool {
    path.exists()
}
