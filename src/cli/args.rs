//! Arguments of the command, and its manual.

mod bearing;
mod manual;
mod measured;
mod update;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use super::signal::args::SignalArgs;
use super::steady_args::{BifurcationArgs, PoincareArgs, SteadyArgs};
pub use bearing::BearingArgs;
use manual::{AFTER, LONG_ABOUT};
pub use measured::{EstimatorName, IdentifyArgs, NoiseArgs, ShaftArgs};
pub use update::{FitWord, MeasuredArgs, UpdateArgs, ValidateArgs};

/// Simulates rotating machines on real bearings: modes, Campbell diagrams, FRFs, nonlinear run-ups.
#[derive(Debug, Parser)]
#[command(
    name = "rotordyn",
    version,
    long_about = LONG_ABOUT,
    after_long_help = AFTER,
    after_help = "See --help for examples, units and exit codes, and COMMAND --help for each command.",
    max_term_width = 100,
    arg_required_else_help = true,
    disable_help_subcommand = true
)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
    #[command(flatten)]
    pub output: Output,
}

/// How to speak; for every command.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Output")]
pub struct Output {
    /// Print one JSON document to standard output, and nothing else there
    #[arg(long, global = true)]
    pub json: bool,
    /// Print no tables and no progress, only errors and warnings
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Number of threads; the numbers computed do not depend on it [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
}

/// Which machine.
#[derive(Args, Clone, Debug)]
pub struct ModelArgs {
    /// The model file (TOML)
    pub model: PathBuf,
    /// Lay [variant.NAME] of the file over the model
    #[arg(long, value_name = "NAME")]
    pub variant: Option<String>,
    /// Set any value of the model, such as bearing.B.radial_clearance="20 um"; can be repeated
    #[arg(long, value_name = "PATH=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
}

/// Which machine, and where its results go.
#[derive(Args, Clone, Debug)]
pub struct StudyArgs {
    #[command(flatten)]
    pub model: ModelArgs,
    /// Folder for the results [default: out/NAME or out/NAME_VARIANT]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
}

/// What to export.
#[derive(Args, Clone, Debug)]
pub struct ExportArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    /// Formats of a run's channels, separated by commas
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', default_values = ["csv", "uff", "mat"])]
    pub formats: Vec<ChannelFormat>,
    /// Number in the names of channels.mat
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub number: u32,
}

/// A format of channels.
#[derive(clap::ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChannelFormat {
    Csv,
    Uff,
    Mat,
    Npz,
    Wav,
}

/// A stored run.
#[derive(Args, Clone, Debug, Default)]
pub struct StoredArgs {
    /// results.h5 of a run-up, or the folder that holds it
    pub file: PathBuf,
    /// Channels to look at, separated by commas [default: those of the model file, else all that vibrate]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub channels: Vec<String>,
    /// Window length, such as "0.5 s" (spectrogram only)
    #[arg(long, value_name = "TIME")]
    pub length: Option<String>,
    /// Highest frequency, such as "220 Hz" (spectrogram only)
    #[arg(long, value_name = "FREQUENCY")]
    pub max_frequency: Option<String>,
    /// Order resolution, such as 0.05 (orders only)
    #[arg(long, value_name = "NUMBER")]
    pub resolution: Option<String>,
    /// Highest order (orders only)
    #[arg(long, value_name = "NUMBER")]
    pub max_order: Option<String>,
    /// Order lines to draw or to cut, such as 1,2,BPFO,"2 BPFO"
    #[arg(long, value_name = "ORDERS", value_delimiter = ',')]
    pub orders: Vec<String>,
    /// Overlap of neighbouring windows, 0 to below 1
    #[arg(long, value_name = "NUMBER")]
    pub overlap: Option<String>,
    /// Window: rectangular, hann, hamming, blackman, flat-top
    #[arg(long, value_name = "NAME")]
    pub window: Option<String>,
    /// Draw no figures
    #[arg(long)]
    pub no_figures: bool,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Do every study that the model file asks for
    ///
    /// Writes results.h5 and all figures to out/NAME/, and prints tables of modes, critical speeds, bearing loads,
    /// orders and the energy balance of the run-up. results.h5 is started anew. A study that fails is named at the
    /// end (exit code 3); the others are done all the same.
    #[command(after_long_help = "\
Examples:
  rotordyn run models/overhung_rig.toml
  rotordyn run models/overhung_rig.toml --variant wavy --out /data/wavy
  rotordyn run models/jeffcott.toml --json --quiet > jeffcott.json")]
    Run(StudyArgs),

    /// Check a model file with all its variants, and say what is in it
    ///
    /// Reports every problem of the file at once, each with its place; balls, cage pockets and rings that overlap;
    /// and motions that nothing holds. Prints masses, stations, bearings with their characteristic orders (FTF, BPFO,
    /// BPFI, BSF per revolution) and the number of degrees of freedom. With --variant only that one is checked.
    #[command(after_long_help = "\
Examples:
  rotordyn check models/overhung_rig.toml
  rotordyn check my_machine.toml --variant block --set speed.to=\"1500 rpm\"")]
    Check(ModelArgs),

    /// Static equilibrium: bearing forces, ball loads, bearing stiffness
    ///
    /// Under gravity, belt pull, preload and constant loads, found by damped Newton for any clearance. Without
    /// [study.static] at standstill, with the bearings averaged over the cage's position.
    #[command(after_long_help = "\
Units: forces N, moments N m, displacements um, ball positions and contact angles deg, stiffness N/m.

Examples:
  rotordyn static models/overhung_rig.toml
  rotordyn static models/overhung_rig.toml --cage-as-placed --set bearing.A.cage_angle=\"20 deg\"")]
    Static {
        #[command(flatten)]
        study: StudyArgs,
        /// Speed at which bearings tabulated over speed are taken, such as "1200 rpm"
        #[arg(long, value_name = "SPEED")]
        speed: Option<String>,
        /// Keep the cage angle of the model instead of averaging over it
        #[arg(long)]
        cage_as_placed: bool,
    },

    /// Natural frequencies, damping and mode shapes at given speeds
    ///
    /// Damped modes of the machine linearised about its equilibrium, labelled by orbit and energy. Without
    /// [study.modal]: 12 modes at standstill and at the highest speed of [speed].
    #[command(after_long_help = "\
Units: frequencies Hz and rpm (cycles per minute), damping ratio zeta in %, logarithmic decrement.

Examples:
  rotordyn modal models/jeffcott.toml
  rotordyn modal models/jeffcott.toml --speed \"0, 1500, 3000 rpm\" --modes 8")]
    Modal {
        #[command(flatten)]
        study: StudyArgs,
        /// Speeds, such as "1200 rpm" or "0, 600, 1200 rpm"
        #[arg(long, value_name = "SPEEDS")]
        speed: Option<String>,
        /// Number of modes
        #[arg(long, value_name = "N")]
        modes: Option<usize>,
    },

    /// Linear Campbell diagram, crossings with order lines, stability thresholds
    ///
    /// Modes are followed over speed by their shapes (MAC). Without [study.campbell]: 12 modes at 25 speeds up to the
    /// highest of [speed], else 3000 rpm.
    #[command(after_long_help = "\
Examples:
  rotordyn campbell models/overhung_rig.toml
  rotordyn campbell models/jeffcott.toml --max-speed \"12000 rpm\" --modes 10")]
    Campbell {
        #[command(flatten)]
        study: StudyArgs,
        /// Highest speed, such as "6000 rpm"; 25 speeds from 0
        #[arg(long, value_name = "SPEED")]
        max_speed: Option<String>,
        /// Number of modes
        #[arg(long, value_name = "N")]
        modes: Option<usize>,
    },

    /// Critical speeds with whirl direction and damping
    ///
    /// Speeds at which a mode's frequency is n times the speed. Without [study.critical]: order 1, up to three times
    /// the highest speed of [speed], else 6000 rpm.
    #[command(after_long_help = "\
Examples:
  rotordyn critical models/jeffcott.toml
  rotordyn critical models/overhung_rig.toml --max-speed \"6000 rpm\" --orders 1,2,3")]
    Critical {
        #[command(flatten)]
        study: StudyArgs,
        /// Highest speed, such as "6000 rpm"
        #[arg(long, value_name = "SPEED")]
        max_speed: Option<String>,
        /// Orders, such as 1,2,BPFO
        #[arg(long, value_name = "ORDERS", value_delimiter = ',')]
        orders: Vec<String>,
    },

    /// Frequency response functions at a fixed speed
    ///
    /// Every probe's response to every excitation, solved directly at each frequency. Without [study.frf]: unit forces
    /// along x and y at the first disc (else station), 1 to 500 Hz by 0.25 Hz, receptance.
    #[command(after_long_help = "\
Units: receptance m/N, mobility m/(s N), accelerance m/(s^2 N).

Examples:
  rotordyn frf models/overhung_rig.toml
  rotordyn frf models/jeffcott.toml --speed \"1500 rpm\" --quantity mobility
  rotordyn frf models/overhung_rig.toml --noise \"40 dB\" --averages 10 --seed 1   also writes frf_noisy.uff")]
    Frf {
        #[command(flatten)]
        study: StudyArgs,
        /// Speed, such as "1200 rpm"
        #[arg(long, value_name = "SPEED")]
        speed: Option<String>,
        /// Highest frequency, such as "400 Hz"; from 1 Hz by 0.25 Hz
        #[arg(long, value_name = "FREQUENCY")]
        max_frequency: Option<String>,
        /// receptance, mobility or accelerance
        #[arg(long, value_name = "NAME")]
        quantity: Option<String>,
        #[command(flatten)]
        test: NoiseArgs,
    },

    /// Steady unbalance response over speed: Bode diagrams and orbits
    ///
    /// Without [study.unbalance]: 200 speeds up to one and a half times the highest of [speed], else 6000 rpm.
    #[command(after_long_help = "\
Examples:
  rotordyn unbalance models/jeffcott.toml
  rotordyn unbalance models/jeffcott.toml --max-speed \"6000 rpm\"")]
    Unbalance {
        #[command(flatten)]
        study: StudyArgs,
        /// Highest speed, such as "6000 rpm"; 200 speeds
        #[arg(long, value_name = "SPEED")]
        max_speed: Option<String>,
    },

    /// Nonlinear run-up through the speed profile, one Hertz contact per ball
    ///
    /// Integrates the machine through [speed]: linear parts reduced to their modes below the cutoff with static
    /// correction, every ball a nonlinear contact. Samples go to results.h5 as they come; Ctrl-C ends the run cleanly
    /// and what was computed stays readable. Without [study.run_up]: generalised-alpha, steps of 100 us, sampling at
    /// 2 kHz, all modes. Where the file has [study.spectrogram] and [study.orders], they are done too.
    #[command(after_long_help = "\
Examples:
  rotordyn run-up models/overhung_rig.toml
  rotordyn run-up models/overhung_rig.toml --variant wavy --step \"50 us\"
  rotordyn run-up models/overhung_rig.toml --set speed.ramp=\"5 s\"")]
    RunUp {
        #[command(flatten)]
        study: StudyArgs,
        /// Time step, such as "100 us"
        #[arg(long, value_name = "TIME")]
        step: Option<String>,
        /// generalised-alpha, newmark, rk4 or dormand-prince
        #[arg(long, value_name = "NAME")]
        integrator: Option<String>,
        /// Sampling rate of the channels, such as "4 kHz"
        #[arg(long, value_name = "FREQUENCY")]
        sample_rate: Option<String>,
    },

    /// Spectrograms over rpm of a stored run-up: the measured-style Campbell diagram
    ///
    /// Settings come from the model text stored in the file; flags override them. Adds to the same results.h5 and
    /// draws beside it.
    #[command(after_long_help = "\
Examples:
  rotordyn spectrogram out/overhung_rig
  rotordyn spectrogram out/overhung_rig/results.h5 --channels B_ax,B_ay --length \"0.5 s\"")]
    Spectrogram(StoredArgs),

    /// Order spectra and order cuts of a stored run-up
    ///
    /// Resamples the channels at even shaft angles. Settings come from the model text stored in the file; flags
    /// override them. Adds to the same results.h5 and draws beside it.
    #[command(after_long_help = "\
Examples:
  rotordyn orders out/overhung_rig
  rotordyn orders out/overhung_rig --resolution 0.02 --orders 7,\"2 BPFO\"")]
    Orders(StoredArgs),

    /// Orbits and Poincaré sections at steady speed, and what kind of motion it is
    ///
    /// Runs from static equilibrium, lets the motion settle, then looks at it once per turn of the shaft or of a cage,
    /// or per ball passage: period n, quasi-periodic or chaotic. Settings come from [study.poincare]; flags override
    /// them.
    #[command(after_long_help = super::steady_args::POINCARE)]
    Poincare(Box<PoincareArgs>),

    /// Largest Lyapunov exponent at steady speed, with its standard error
    ///
    /// Follows a run beside the first from a slightly different state, at the same shaft and cage angles. Settings come
    /// from [study.lyapunov]; flags override them.
    #[command(after_long_help = super::steady_args::LYAPUNOV)]
    Lyapunov(Box<SteadyArgs>),

    /// Bifurcation diagram over any value of the model, swept up and down on every core
    ///
    /// Each value starts from where the one before ended, so that the two ways may find two motions. Settings come from
    /// [study.bifurcation]; flags override them. Ctrl-C leaves what was computed.
    #[command(after_long_help = super::steady_args::BIFURCATION)]
    Bifurcation(Box<BifurcationArgs>),

    /// Ball bearings one by one: loads, contacts, stiffness, film, frequencies, life
    ///
    /// Takes a machine, or a file that holds bearings alone. The operating load is that of the machine's equilibrium
    /// unless one is given; a bearing alone gets a tenth of its dynamic load rating. Prints ball loads, contact
    /// angles, pressures, film, the 5x5 stiffness and the characteristic frequencies; sweeps load, cage angle and, where
    /// it matters, speed unless told otherwise. Settings come from [study.bearing]; flags override them.
    #[command(after_long_help = "\
Loads are those of the shaft on the bearing. Motions are x, y, z (along the shaft), theta_x, theta_y. With a given \
load the tilts are held unless a moment is given; in a machine the shaft holds tilts and axial place in the sweeps.

Examples:
  rotordyn bearing models/overhung_rig.toml
  rotordyn bearing models/overhung_rig.toml --bearing A --load \"0, -500, 100 N\" --speed \"3000 rpm\"
  rotordyn bearing my_bearing.toml --sweep load=\"0 N .. 2 kN\" --along y --averaged
  rotordyn bearing my_bearing.toml --sweep displacement=\"0 um .. 30 um\" --along z --hold x,y,theta_x,theta_y
  rotordyn bearing my_bearing.toml --sweep speed=\"0 rpm .. 20000 rpm\"")]
    Bearing(Box<BearingArgs>),

    /// Modes from measured FRFs or records of an impact test: poles, damping, shapes, with their standard errors
    ///
    /// Poly-reference least-squares complex frequency over all orders; poles that stay are chosen, refined together on
    /// all FRFs, and those that the data do not bear out dropped. Reads universal files, MATLAB, NumPy, CSV, HDF5 and
    /// our own results.h5; time records of an impact test are turned into FRFs first, hits of files with the same points
    /// averaged, double hits and overloads left out. A run-up at 0 rpm under one [load.X] with a history is a simulated
    /// impact test. Writes results.h5, modes.uff (data sets 55) and figures: stabilisation diagram, autoMAC, FRFs
    /// measured and synthesised, shapes where the file has geometry.
    #[command(after_long_help = "\
Examples:
  rotordyn identify frfs.uff --band \"5 .. 180 Hz\"
  rotordyn identify test.npz --quantity accelerance --max-order 40
  rotordyn identify hit_*.mat --mapping channels.toml --window \"0.5 s\" --estimator hv
  rotordyn identify out/overhung_rig/results.h5 --json")]
    Identify(Box<IdentifyArgs>),

    /// Compare variants of one machine: frequencies side by side, FRFs overlaid
    ///
    /// Modes of the variants are paired with those of the first by their shapes along the shaft (mass-weighted MAC).
    /// `base` is the file without a variant.
    #[command(after_long_help = "\
Examples:
  rotordyn compare models/overhung_rig.toml --variants spherical,cylindrical,base
  rotordyn compare models/overhung_rig.toml --variants clearance_5um,base,clearance_33um --modes 8")]
    Compare {
        #[command(flatten)]
        study: StudyArgs,
        /// Variants, separated by commas [default: base and every variant of the file]
        #[arg(long, value_name = "NAMES", value_delimiter = ',')]
        variants: Vec<String>,
        /// Speeds, such as "0, 1200 rpm" [default: those of [study.modal]]
        #[arg(long, value_name = "SPEEDS")]
        speed: Option<String>,
        /// Number of modes
        #[arg(long, value_name = "N")]
        modes: Option<usize>,
    },

    /// Hold the model against measured modes, FRFs or run-ups: which mode is which, and how far apart
    ///
    /// Pairs measured and computed modes by MAC and frequency (the assignment that is best for all together), lists
    /// frequencies, errors, damping and MAC, and what has no partner on either side; FRFs are identified on the way
    /// and laid over the model's, with FRAC and FDAC. Several files, such as impact tests of different force, are also
    /// held against the first: how far has every mode shifted? The record of a run-up is set beside the run-up that the
    /// model makes with the same speed: maps, waterfalls, and where every order is highest.
    #[command(after_long_help = update::VALIDATE)]
    Validate(Box<ValidateArgs>),

    /// Fit stiffnesses, dampings or any other numbers of the model to what was measured
    ///
    /// Weighted least squares with priors and bounds on frequencies, shapes, damping or FRFs, by Levenberg-Marquardt
    /// with exact sensitivities. Says of every number whether the data tell it: with its standard error, the share of
    /// the prior that is left, and the directions in which the data are blind. Writes the model file with the numbers
    /// that were found, everything else as you wrote it, and figures of before and after.
    #[command(after_long_help = update::UPDATE)]
    Update(Box<UpdateArgs>),

    /// Look up bearings of the built-in catalogue
    ///
    /// Without a designation lists all; with one (or its beginning) shows internal geometry, clearance classes after
    /// ISO 5753-1, characteristic orders, and where the geometry comes from.
    #[command(after_long_help = "\
Examples:
  rotordyn catalogue
  rotordyn catalogue 6205
  rotordyn catalogue 72 --json")]
    Catalogue {
        /// Designation, or how it begins
        designation: Option<String>,
    },

    /// A record, measured or simulated: spectra, envelope with bearing lines and verdict, kurtogram, orders, jerk
    ///
    /// Reads universal files, MATLAB, NumPy, WAV, tables, HDF5 and stored runs, whichever the content is. Says which part
    /// of the bearing is damaged by the lines in the envelope's spectrum; with --against the envelope spectra of two
    /// records, such as measured and simulated, come into one figure.
    #[command(after_long_help = super::signal::args::EXAMPLES)]
    Signal(Box<SignalArgs>),

    /// Export for viewing and for other programs: glb, VTK, universal files, MATLAB, NumPy, CSV, WAV
    ///
    /// Writes to the results folder: machine.glb and one glb for every ball bearing (any 3D viewer); mode shapes as
    /// VTK for ParaView; mode shapes and, where the file has [study.frf], FRFs as universal files for modal programs;
    /// and, when the folder holds a run-up, its channels in each of the formats.
    #[command(after_long_help = "\
Names: channels.mat has X001_B_ax_time, fs is the rate in Hz, X001RPM is the mean speed. A WAV file holds one channel as \
32-bit floats of its values in SI units.

Examples:
  rotordyn export models/overhung_rig.toml
  rotordyn export models/overhung_rig.toml --formats mat,wav --number 105")]
    Export(ExportArgs),
}

/// PATH=VALUE.
fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => Ok((path.trim().into(), value.trim().into())),
        _ => Err("expected PATH=VALUE, such as bearing.B.radial_clearance=\"20 um\"".into()),
    }
}
