//! Memory of a run-up: the samples are on disk, so that a longer run needs little more of it.

use std::process::{Command, Stdio};
use std::time::Duration;

/// Most memory of a run-up of the Jeffcott rotor with so many seconds at its final speed, its figures included \[MB\].
fn peak_memory(hold: &str) -> f64 {
    let folder = tempfile::tempdir().unwrap();
    let mut run = Command::new(assert_cmd::cargo::cargo_bin("rotordyn"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["run-up", "models/jeffcott.toml", "--set", "speed.ramp=0.2 s", "--set", "speed.settle=0 s"])
        .args(["--set", "study.run_up.step=100 us", "--set", "study.run_up.sample_rate=10 kHz"])
        .args(["--set", &format!("speed.hold={hold} s"), "--out"])
        .arg(folder.path())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", run.id());
    let mut peak = 0.0;
    loop {
        // The peak so far: the last reading misses what is allocated within the last interval.
        let text = std::fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.trim().trim_end_matches("kB").trim().parse::<f64>().ok());
        peak = kilobytes.map_or(peak, |kilobytes| f64::max(peak, 1e-3 * kilobytes));
        if let Some(exit) = run.try_wait().unwrap() {
            assert!(exit.success(), "{exit}");
            return peak;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
}

/// With 600 000 samples more, of 4.8 MB in each of the 20 columns (96 MB), the peak grows by half of that at most: what follows
/// the run reads a column or two at a time, with a resampled copy and spectra of them (five columns, 24 MB), and large figures
/// are drawn two at a time or not. A cache of the HDF5 library that keeps the record would add all of it, and with all
/// samples in memory the peak grew by four times that.
#[test]
fn a_longer_run_needs_little_more_memory() {
    let [short, long] = ["2", "62"].map(peak_memory);
    println!("{short:.1} MB for 2 s, {long:.1} MB for 62 s");
    assert!(short > 5.0 && long - short < 0.5 * 20.0 * 4.8, "{short} MB, {long} MB");
}
