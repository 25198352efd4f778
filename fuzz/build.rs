//! Compiles the counters of taken edges, which instrumented code calls (see `counting-rustc`).

fn main() {
    println!("cargo::rerun-if-changed=edges.c");
    if std::env::var_os("CARGO_CFG_UNIX").is_some() {
        // Whole: nothing in Rust refers to it.
        cc::Build::new().file("edges.c").link_lib_modifier("+whole-archive").compile("fuzz_edges");
    }
}
