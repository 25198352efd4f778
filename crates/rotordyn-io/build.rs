//! Tells the program which git revision it was built from, where there is one.

use std::process::Command;

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|o| o.status.success())?;
    String::from_utf8(output.stdout).ok().map(|text| text.trim().to_string())
}

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    // A copy of the sources inside another project's repository has no revision of its own.
    let own = std::env::var("CARGO_MANIFEST_DIR").ok();
    let root = git(&["rev-parse", "--show-toplevel"]).map(|root| root + "/crates/rotordyn-io");
    if root.is_none() || root != own {
        return;
    }
    if let Some(revision) = git(&["rev-parse", "--short=12", "HEAD"]) {
        println!("cargo:rustc-env=ROTORDYN_GIT={revision}");
    }
    // The log of HEAD changes with every commit; it is absent from a fresh clone only where logs are off.
    if let Some(log) = git(&["rev-parse", "--git-path", "logs/HEAD"])
        && std::path::Path::new(&log).exists()
    {
        println!("cargo:rerun-if-changed={log}");
    }
}
