//! Stand-in for the crate `cmake`: compiles the HDF5 C library with the C compiler alone.
//!
//! It has the three functions that the build script of `hdf5-metno-src` calls. README.md beside it says why
//! it exists and how to make H5pubconf.h anew.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::{Command, exit};
use std::{env, fs};

/// HDF5 as configured by a real cmake, see README.md.
const CONFIGURATION: &str = include_str!("../H5pubconf.h");
/// The release that `CONFIGURATION` was made from: major, minor, release.
const RELEASE: [u32; 3] = [2, 2, 0];
/// The options that were ON when `CONFIGURATION` was made, in alphabetical order.
const OPTIONS_ON: [&str; 2] = ["HDF5_ENABLE_ZLIB_SUPPORT", "HDF5_NO_PACKAGES"];
/// Set to anything to build with the real cmake.
const FORCE: &str = "HDF5_BUILD_WITH_CMAKE";

/// What to build and with which options.
pub struct Config {
    source: PathBuf,
    options: BTreeMap<OsString, OsString>,
}

impl Config {
    /// Starts from the folder that holds CMakeLists.txt, relative to the package.
    pub fn new<P: AsRef<Path>>(path: P) -> Config {
        let package = PathBuf::from(variable("CARGO_MANIFEST_DIR"));
        Config { source: package.join(path), options: BTreeMap::new() }
    }

    /// Sets an option, `-Dkey=value`.
    pub fn define<K: AsRef<OsStr>, V: AsRef<OsStr>>(&mut self, key: K, value: V) -> &mut Config {
        self.options.insert(key.as_ref().into(), value.as_ref().into());
        self
    }

    /// Builds and returns the folder with `include/` and `lib/`.
    pub fn build(&mut self) -> PathBuf {
        println!("cargo::rerun-if-env-changed={FORCE}");
        let out = PathBuf::from(variable("OUT_DIR"));
        match self.why_not_plain() {
            None => self.compile(&out),
            Some(reason) => self.run_cmake(&out, &reason),
        }
        out
    }

    /// Why the checked-in configuration does not fit; `None` if it does.
    fn why_not_plain(&self) -> Option<String> {
        let target =
            ["OS", "ENV", "POINTER_WIDTH", "ENDIAN"].map(|k| variable(&format!("CARGO_CFG_TARGET_{k}")));
        let on: Vec<_> =
            self.options.iter().filter(|(_, value)| *value == "ON").map(|(key, _)| key).collect();
        let public = fs::read_to_string(self.source.join("src/H5public.h")).unwrap_or_default();
        let defines = |name, value| public.contains(&format!("#define H5_VERS_{name} {value}\n"));
        if env::var_os(FORCE).is_some() {
            Some(format!("{FORCE} is set"))
        } else if target != ["linux", "gnu", "64", "little"] {
            Some(format!("the target is {}, not 64-bit linux-gnu", variable("TARGET")))
        } else if !["MAJOR", "MINOR", "RELEASE"]
            .into_iter()
            .zip(RELEASE)
            .all(|(name, value)| defines(name, value))
        {
            Some(format!("the sources are not of HDF5 release {RELEASE:?}"))
        } else if on != OPTIONS_ON {
            Some(format!("the options {on:?} are ON instead of {OPTIONS_ON:?}"))
        } else {
            None
        }
    }

    /// Compiles every source file of the library with the checked-in configuration.
    fn compile(&self, out: &Path) {
        let sources = self.source.join("src");
        or_exit("create the include folder", fs::create_dir_all(out.join("include")));
        or_exit("write H5pubconf.h", fs::write(out.join("include/H5pubconf.h"), CONFIGURATION));
        // The text that H5check_version prints; the real one holds host, date and paths.
        let settings = "const char H5build_settings[] = \"\";\n";
        or_exit("write H5build_settings.c", fs::write(out.join("H5build_settings.c"), settings));
        // Relative names make the compiler's input the same in every checkout, for compiler caches.
        or_exit("enter the output folder", env::set_current_dir(out));

        let mut library = cc::Build::new();
        library.include("include").include(&sources).include(sources.join("H5FDsubfiling"));
        if let Some(header) = self.options.get(OsStr::new("H5_ZLIB_HEADER")) {
            library.include(Path::new(header).parent().expect("a path to zlib.h"));
        }
        for name in ["_GNU_SOURCE", "_LARGEFILE_SOURCE", "NDEBUG"] {
            library.define(name, None);
        }
        library.define("_POSIX_C_SOURCE", "200809L").define("_FILE_OFFSET_BITS", "64");
        library.std("gnu11").opt_level(1).debug(false).warnings(false).flag_if_supported("-w");
        library.file("H5build_settings.c");
        let mut files: Vec<_> = or_exit("list the sources", fs::read_dir(&sources))
            .map(|entry| or_exit("list the sources", entry).path())
            .filter(|path| path.extension() == Some(OsStr::new("c")))
            .collect();
        files.sort();
        library.files(files).out_dir(out.join("lib")).cargo_metadata(false).compile("hdf5");
    }

    /// Hands the work over to the real cmake.
    fn run_cmake(&self, out: &Path, reason: &str) {
        let build = out.join("build");
        if variable("HOST") != variable("TARGET") && env::var_os("CMAKE_TOOLCHAIN_FILE").is_none() {
            fail(&format!(
                "HDF5 needs cmake here ({reason}), and cross-compiling with it needs CMAKE_TOOLCHAIN_FILE"
            ));
        }
        let mut configure = Command::new("cmake");
        configure.arg("-S").arg(&self.source).arg("-B").arg(&build);
        configure.args(["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_POSITION_INDEPENDENT_CODE=ON"]);
        configure.arg(definition("CMAKE_INSTALL_PREFIX".as_ref(), out.as_ref()));
        configure.args(self.options.iter().map(|(key, value)| definition(key, value)));
        run(&mut configure, reason);
        let mut install = Command::new("cmake");
        install.arg("--build").arg(&build).args(["--config", "Release", "--target", "install", "--parallel"]);
        run(install.arg(env::var("NUM_JOBS").unwrap_or_else(|_| "1".into())), reason);
    }
}

fn definition(key: &OsStr, value: &OsStr) -> OsString {
    let mut text = OsString::from("-D");
    text.push(key);
    text.push("=");
    text.push(value);
    text
}

fn run(command: &mut Command, reason: &str) {
    match command.status() {
        Ok(status) if status.success() => {}
        Ok(status) => fail(&format!("cmake failed to build HDF5 ({status}); see the output below")),
        Err(error) => {
            fail(&format!("HDF5 needs cmake 3.26 or later here ({reason}), and it cannot be run: {error}"))
        }
    }
}

/// A variable that cargo sets for every build script.
fn variable(name: &str) -> String {
    env::var(name).unwrap_or_else(|error| fail(&format!("cannot build HDF5: {name}: {error}")))
}

fn or_exit<T>(operation: &str, result: std::io::Result<T>) -> T {
    result.unwrap_or_else(|error| fail(&format!("cannot build HDF5: {operation}: {error}")))
}

fn fail(message: &str) -> ! {
    println!("cargo::error={message}");
    exit(1)
}
