//! Commands under strace, which counts their system calls, kills them at one, or lets it fail.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Calls that change files. HDF5 writes with pwrite64, copies use copy_file_range.
const CALLS: &str = "write,pwrite64,copy_file_range,ftruncate,rename,renameat,renameat2,link,linkat,unlink,unlinkat,fsync,fdatasync,mkdir";

/// One system call of the first thread: its name and how many of its kind come before it, from 1.
pub type Point = (String, usize);

/// Whether strace may trace here; if not, the test is skipped, or fails with `CI` set.
pub fn can_trace() -> bool {
    let traced = Command::new("strace").args(["-o", "/dev/null", "true"]).output();
    if traced.is_ok_and(|output| output.status.success()) {
        return true;
    }
    let message = "strace not found, or not allowed to trace";
    let must_run = std::env::var_os("CI").is_some() && std::env::var_os("ROTORDYN_ALLOW_SKIP").is_none();
    assert!(!must_run, "{message}; set ROTORDYN_ALLOW_SKIP to skip the test");
    eprintln!("SKIPPED: {message}");
    false
}

/// A command under strace with its options.
fn traced(command: &Command, options: &[&str]) -> Command {
    let mut strace = Command::new("strace");
    strace.args(["-f", "-qq"]).args(options).arg(command.get_program()).args(command.get_args());
    strace.env("RAYON_NUM_THREADS", "1").stdin(Stdio::null());
    if let Some(folder) = command.get_current_dir() {
        strace.current_dir(folder);
    }
    strace
}

/// Runs a command that must succeed; returns the points at which its first thread changes files.
pub fn points(command: &Command, log: &Path) -> Vec<Point> {
    let output =
        traced(command, &["-y", "-e", &format!("trace={CALLS}"), "-o", log.to_str().unwrap()]).output();
    let output = output.unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(log).unwrap();
    let first = text.split_whitespace().next().unwrap_or_default().to_string();
    let mut counts = BTreeMap::new();
    let mut found = Vec::new();
    for line in text.lines() {
        let Some((thread, call)) = line.split_once(' ') else { continue };
        let Some((name, arguments)) = call.trim_start().split_once('(') else { continue };
        // A pipe to the process that reads a file is no output, and no disk.
        let is_output =
            !arguments.contains("<pipe:") || ["1<", "2<"].iter().any(|fd| arguments.starts_with(fd));
        if thread == first && !name.starts_with('<') {
            let count = counts.entry(name.to_string()).or_insert(0);
            *count += 1;
            if is_output {
                found.push((name.to_string(), *count));
            }
        }
    }
    found
}

/// Runs a command that is killed before the system call of a point takes effect.
pub fn killed_at(command: &Command, (call, count): &Point) -> Output {
    let inject = format!("inject={call}:error=EIO:signal=KILL:when={count}");
    traced(command, &["-e", &format!("trace={call}"), "-e", &inject, "-o", "/dev/null"]).output().unwrap()
}

/// Runs a command whose calls of a kind fail from a point on as on a full disk.
pub fn without_space_from(command: &Command, (call, count): &Point) -> Output {
    let inject = format!("inject={call}:error=ENOSPC:when={count}+");
    traced(command, &["-e", &format!("trace={call}"), "-e", &inject, "-o", "/dev/null"]).output().unwrap()
}

/// Every point, or `wanted` of them, chosen by a fixed seed.
pub fn sample(all: Vec<Point>, wanted: Option<usize>) -> Vec<Point> {
    let Some(wanted) = wanted.filter(|wanted| *wanted < all.len()) else { return all };
    // Marsaglia 2003: xorshift with a period of 2^32 - 1.
    let mut seed = 2_463_534_242_u32;
    let mut left = all;
    let mut chosen = Vec::new();
    for _ in 0..wanted {
        seed ^= seed << 13;
        seed ^= seed >> 17;
        seed ^= seed << 5;
        chosen.push(left.swap_remove(seed as usize % left.len()));
    }
    chosen
}
