//! Command-line arguments (clap) and their help texts.

mod bearing;
mod common;
mod compare;
mod import;
mod init;
pub mod keys;
mod manual;
mod measured;
mod rotor;
mod steady;
mod update;

use common::assignment;
pub use common::{
    CheckpointArgs, Interval, ModelArgs, OrdersArgs, Output, OutputFiles, ReportArgs, SpectrogramArgs,
    StoredArgs, StudyArgs,
};
use keys::{help as key_help, help_with as key_help_with};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand};
use rotordyn::io::run_export::{self, RunFormat};

use super::signal::args::SignalArgs;
use super::trend::args::TrendArgs;
pub use bearing::BearingArgs;
pub use compare::CompareArgs;
pub use import::ImportArgs;
pub use init::{InitArgs, STARTERS};
use manual::{AFTER_HELP, LONG_ABOUT};
pub use measured::{EstimatorName, IdentifyArgs, NoiseArgs, ResidualTermsName, ShaftArgs};
pub use rotor::{CriticalMapArgs, TorsionalArgs};
pub use steady::{BifurcationArgs, PoincareArgs, SteadyArgs};
pub use update::{FitResidual, MeasuredArgs, UpdateArgs, ValidateArgs};

/// Simulates rotating machines on real bearings: modes, Campbell diagrams, FRFs, nonlinear run-ups.
#[derive(Debug, Parser)]
#[command(
    name = "rotordyn",
    version,
    long_about = LONG_ABOUT,
    after_long_help = AFTER_HELP,
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

/// Arguments of `export`.
#[derive(Args, Clone, Debug)]
pub struct ExportArgs {
    #[command(flatten)]
    pub study: StudyArgs,
    /// File formats of the run-up's channels (time histories), separated by commas [default: csv,uff,mat]
    #[arg(long, value_name = "FORMATS", value_delimiter = ',', default_values = ["csv", "uff", "mat"],
          hide_default_value = true, value_parser = run_format())]
    pub formats: Vec<RunFormat>,
    /// Record number in the variable names of channels.mat (X001_...)
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub number: u32,
    /// Also write every mode in motion for ParaView, with this number of frames a cycle: modes_<speed>rpm_<mode>.pvd
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(4..=360))]
    pub mode_frames: Option<u16>,
    /// How many times slower motion.glb shows a recorded motion [default: the shaft turns once a second at most]
    #[arg(long, value_name = "FACTOR", value_parser = slow_motion)]
    pub slow_motion: Option<f64>,
}

fn slow_motion(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(factor) if factor > 0.0 && factor.is_finite() => Ok(factor),
        _ => Err("give a number greater than zero, such as 50".into()),
    }
}

/// Help of `--out` of a command whose results have a folder of their own.
fn results_in(folder: &str) -> String {
    format!("Folder for the results [default: {folder}]")
}

fn run_format() -> impl TypedValueParser<Value = RunFormat> {
    PossibleValuesParser::new(run_export::FORMATS.map(|format| format.name))
        .try_map(|name| RunFormat::named(&name).ok_or("an unknown format"))
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Write a commented starter machine: motor, fan, pump, spindle, vertical or test-rig
    ///
    /// A complete model file of a plausible machine with all studies, to be changed into yours. An existing file is
    /// kept unless --force is given.
    #[command(after_long_help = "\
Examples:
  rotordyn init
  rotordyn init motor
  rotordyn init spindle -o my_spindle.toml
  rotordyn init pump -o - | less")]
    Init(InitArgs),

    /// Write a model file from a rotor that ROSS saved
    ///
    /// Reads files of ROSS 2 and 3, TOML or JSON: shaft elements, cones included, discs, bearings and seals with
    /// coefficients over speed and whirl frequency, supports, point masses, couplings, damping. Prints what went where,
    /// and names everything that was not carried over; each of these is a warning.
    #[command(after_long_help = import::EXAMPLES)]
    Import(ImportArgs),

    /// Run all studies of the model file
    ///
    /// Writes results.h5 and all figures to out/NAME/, and prints tables of modes, critical speeds, bearing
    /// loads, orders and the energy balance of the run-up. An existing results.h5 is replaced at the
    /// end; if the run is stopped, complete results stay as results_previous.h5. A failed
    /// study is reported at the end (exit code 3); the other studies still run.
    #[command(after_long_help = "\
Examples:
  rotordyn run models/overhung_rig.toml
  rotordyn run models/overhung_rig.toml --variant wavy --out /data/wavy
  rotordyn run models/jeffcott.toml --json --quiet > jeffcott.json")]
    Run {
        #[command(flatten)]
        study: StudyArgs,
        #[command(flatten)]
        checkpoints: CheckpointArgs,
    },

    /// Validate a model file with all its variants and summarise the machine
    ///
    /// Reports all errors of the file at once with their locations, overlapping bearing parts (balls, cage
    /// pockets, rings) and unconstrained rigid-body modes. Prints masses, stations, bearings with their
    /// defect frequencies as orders (FTF, BPFO, BPFI, BSF per revolution) and the number of degrees of
    /// freedom. With --variant only that variant is checked.
    #[command(after_long_help = "\
Examples:
  rotordyn check models/overhung_rig.toml
  rotordyn check my_machine.toml --variant block --set speed.to=\"1500 rpm\"")]
    Check(ModelArgs),

    /// Static equilibrium: bearing forces, ball loads, bearing stiffness
    ///
    /// Under gravity, belt pull, preload and constant loads, solved by a damped Newton iteration for any
    /// clearance. Default without [study.static]: standstill, bearing forces averaged over the cage angle.
    #[command(after_long_help = "\
Units: forces N, moments N m, displacements um, ball positions and contact angles deg, stiffness N/m.

Examples:
  rotordyn static models/overhung_rig.toml
  rotordyn static models/overhung_rig.toml --fixed-cage-angle --set bearing.A.cage_angle=\"20 deg\"")]
    Static {
        #[command(flatten)]
        study: StudyArgs,
        #[arg(long, value_name = "SPEED", help = key_help("study.static.speed"))]
        speed: Option<String>,
        /// Keep the cage angle of the model instead of averaging over it
        #[arg(long, alias = "cage-as-placed")]
        fixed_cage_angle: bool,
    },

    /// Natural frequencies, damping and mode shapes at given speeds
    ///
    /// Damped (complex) modes of the machine linearised about its static equilibrium, labelled by whirl
    /// direction and energy share. Default without [study.modal]: 12 modes at standstill and at the highest
    /// speed of [speed].
    #[command(after_long_help = "\
Units: frequencies Hz and rpm (cycles per minute), damping ratio zeta in %, logarithmic decrement (log dec).

Examples:
  rotordyn modal models/jeffcott.toml
  rotordyn modal models/jeffcott.toml --speed \"0, 1500, 3000 rpm\" --modes 8")]
    Modal {
        #[command(flatten)]
        study: StudyArgs,
        /// Speeds, such as "0, 3000 rpm" [default: 0 and the highest of [speed]]
        #[arg(long, value_name = "SPEEDS")]
        speed: Option<String>,
        #[arg(long, value_name = "N", help = key_help("study.modal.modes"))]
        modes: Option<usize>,
    },

    /// Campbell diagram (linear), critical speeds at order-line crossings, stability thresholds
    ///
    /// Modes are tracked over speed by MAC. Default without [study.campbell]: 12 modes at 25 speeds up to the
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
        #[arg(long, value_name = "N", help = key_help("study.campbell.modes"))]
        modes: Option<usize>,
    },

    /// Critical speeds with whirl direction and damping
    ///
    /// Speeds at which a damped natural frequency equals n times the speed (order n). Default without
    /// [study.critical]: order 1, up to three times the highest speed of [speed], else 6000 rpm.
    #[command(after_long_help = "\
Examples:
  rotordyn critical models/jeffcott.toml
  rotordyn critical models/overhung_rig.toml --max-speed \"6000 rpm\" --orders 1,2,3")]
    Critical {
        #[command(flatten)]
        study: StudyArgs,
        #[arg(long, value_name = "SPEED", help = key_help("study.critical.max_speed"))]
        max_speed: Option<String>,
        #[arg(long, value_name = "ORDERS", value_delimiter = ',', help = key_help_with("study.critical.orders", "such as 1,2,BPFO"))]
        orders: Vec<String>,
    },

    /// Undamped critical speed map: critical speeds over bearing stiffness, with the bearings' own over speed
    ///
    /// All bearings get the same radial stiffness; forward modes. Default without [study.critical_map]: up to three
    /// times the highest speed of [speed], else 6000 rpm; stiffness a decade and more around that of the bearings.
    #[command(after_long_help = rotor::CRITICAL_MAP)]
    CriticalMap(CriticalMapArgs),

    /// Torsional natural frequencies, their mode shapes and the orders that meet them (interference diagram)
    ///
    /// Undamped rotation of the shaft with its discs. Default without [study.torsional]: orders 1 and 2 up to 1.5 times
    /// the highest speed of [speed], else 6000 rpm.
    #[command(after_long_help = rotor::TORSIONAL)]
    Torsional(TorsionalArgs),

    /// Frequency response functions at a fixed speed
    ///
    /// Response of every probe to every excitation, solved directly at each frequency. Default without
    /// [study.frf]: receptance for unit forces along x and y at the first disc (else station), 1 to 500 Hz in
    /// steps of 0.25 Hz. Frequencies are added around the natural frequencies, so that no peak lies between
    /// the points (refine = false in [study.frf]: none); universal files have the given ones.
    #[command(after_long_help = "\
Units: receptance m/N, mobility m/(s N), accelerance m/(s^2 N).

Examples:
  rotordyn frf models/overhung_rig.toml
  rotordyn frf models/jeffcott.toml --speed \"1500 rpm\" --quantity mobility
  rotordyn frf models/overhung_rig.toml --noise \"40 dB\" --averages 10 --seed 1   also writes frf_noisy.uff")]
    Frf {
        #[command(flatten)]
        study: StudyArgs,
        #[arg(long, value_name = "SPEED", help = key_help("study.frf.speed"))]
        speed: Option<String>,
        /// Highest frequency, such as "400 Hz"; from 1 Hz in steps of 0.25 Hz
        #[arg(long, value_name = "FREQUENCY")]
        max_frequency: Option<String>,
        #[arg(long, value_name = "NAME", help = key_help("study.frf.quantity"))]
        quantity: Option<String>,
        #[command(flatten)]
        test: NoiseArgs,
    },

    /// Synchronous (1x) unbalance response over speed: Bode plots and orbits
    ///
    /// Default without [study.unbalance]: 200 speeds up to 1.5 times the highest of [speed], else 6000 rpm.
    /// Speeds are added around the critical speeds (refine = false: none). Every peak is listed with its
    /// amplification factor, every critical speed with log decrement and separation margin from the operating
    /// speeds as in API 617; bearing forces over speed; bending moment along the shaft where it is largest.
    #[command(after_long_help = "\
Examples:
  rotordyn unbalance models/jeffcott.toml
  rotordyn unbalance models/jeffcott.toml --max-speed \"6000 rpm\"
  rotordyn unbalance models/jeffcott.toml --speed-range \"2800, 3200 rpm\"")]
    Unbalance {
        #[command(flatten)]
        study: StudyArgs,
        /// Highest speed, such as "6000 rpm"; 200 speeds
        #[arg(long, value_name = "SPEED")]
        max_speed: Option<String>,
        #[arg(long, value_name = "SPEEDS", help = key_help("study.unbalance.operating_speeds"))]
        speed_range: Option<String>,
    },

    /// Nonlinear transient run-up through the speed profile, one Hertz contact per ball
    ///
    /// Time integration of the machine through [speed]: linear parts reduced to their modes below the cutoff
    /// frequency plus static correction modes, every ball a nonlinear contact. Samples are streamed to
    /// results.h5; after Ctrl-C the samples so far remain readable. Default without [study.run_up]:
    /// generalised-alpha, steps by speed and bearings, sampling at 2 kHz, all modes. [study.spectrogram] and
    /// [study.orders] of the file are run too. The step used divides the sampling interval; its error in the
    /// order levels is estimated by repeating the stretch of the largest response with about twice the step.
    #[command(after_long_help = "\
Examples:
  rotordyn run-up models/overhung_rig.toml
  rotordyn run-up models/overhung_rig.toml --variant wavy --step \"50 us\"
  rotordyn run-up models/overhung_rig.toml --cage-phases 8
  rotordyn run-up models/overhung_rig.toml --set speed.ramp=\"5 s\"")]
    RunUp {
        #[command(flatten)]
        study: StudyArgs,
        #[arg(long, value_name = "TIME", help = key_help("study.run_up.step"))]
        step: Option<String>,
        #[arg(long, value_name = "NAME", help = key_help("study.run_up.integrator"))]
        integrator: Option<String>,
        #[arg(long, value_name = "FREQUENCY", help = key_help("study.run_up.sample_rate"))]
        sample_rate: Option<String>,
        #[arg(long, value_name = "FREQUENCY", help = key_help("study.run_up.motion_rate"))]
        motion_rate: Option<String>,
        #[arg(long, value_name = "N", help = key_help("study.run_up.cage_phases"))]
        cage_phases: Option<usize>,
        #[command(flatten)]
        checkpoints: CheckpointArgs,
    },

    /// One page of all results: report.html, for any browser, without network
    ///
    /// Warnings, a drawing of the machine and a summary first; the model as it was understood; Campbell diagram, FRFs,
    /// unbalance response, spectra and order cuts to look into; mode shapes in motion; every value of results.h5 in
    /// tables. `run` writes it as well, unless with --no-figures. Figures of the same folder are included as they are.
    #[command(after_long_help = "\
Examples:
  rotordyn report out/overhung_rig
  rotordyn report out/overhung_rig/results.h5 -o rig.html")]
    Report(ReportArgs),

    /// Spectrograms over rpm of a stored run-up: waterfall and Campbell map from the signal
    ///
    /// Settings come from the model text stored in the file; flags override them. Results are added to the
    /// same results.h5, figures go to its folder.
    #[command(after_long_help = "\
Examples:
  rotordyn spectrogram out/overhung_rig
  rotordyn spectrogram out/overhung_rig/results.h5 --channels B_ax,B_ay --length \"0.5 s\"")]
    Spectrogram(SpectrogramArgs),

    /// Order tracking of a stored run-up: order spectra and order cuts
    ///
    /// The channels are resampled at equal shaft angle increments (computed order tracking). Settings come
    /// from the model text stored in the file; flags override them. Results are added to the same results.h5,
    /// figures go to its folder.
    #[command(after_long_help = "\
Examples:
  rotordyn orders out/overhung_rig
  rotordyn orders out/overhung_rig --resolution 0.02 --orders 7,\"2 BPFO\"")]
    Orders(OrdersArgs),

    /// Orbits and Poincaré sections at constant speed, and classification of the motion
    ///
    /// Starts at static equilibrium, discards the transient, then samples the state once per shaft
    /// revolution, cage revolution or ball passage. Classes: period n, quasi-periodic, chaotic. Settings come
    /// from [study.poincare]; flags override them.
    #[command(after_long_help = steady::POINCARE)]
    Poincare(Box<PoincareArgs>),

    /// Largest Lyapunov exponent at constant speed, with its standard error
    ///
    /// Integrates a perturbed trajectory with the same shaft and cage angles and measures its separation from
    /// the reference trajectory. Settings come from [study.lyapunov]; flags override them.
    #[command(after_long_help = steady::LYAPUNOV)]
    Lyapunov(Box<SteadyArgs>),

    /// Bifurcation diagram over any model parameter, swept up and down in parallel
    ///
    /// By default each value starts from the final state of the previous one, so up and down sweeps show
    /// coexisting motions (hysteresis). Settings come from [study.bifurcation]; flags override them. Ctrl-C
    /// keeps the points computed so far.
    #[command(after_long_help = steady::BIFURCATION)]
    Bifurcation(Box<BifurcationArgs>),

    /// Ball bearing analysis: load distribution, contacts, stiffness, film, defect frequencies, life
    ///
    /// Takes a machine model or a file with bearings only. Default load: that of the machine's static
    /// equilibrium; for a file with bearings only a tenth of the dynamic load rating. Prints ball loads,
    /// contact angles and pressures, film thickness, the 5x5 stiffness matrix, defect frequencies and rating
    /// life. Default sweeps: load, cage angle and, for speed-dependent bearings, speed. Settings come from
    /// [study.bearing]; flags override them.
    #[command(after_long_help = bearing::HELP)]
    Bearing(Box<BearingArgs>),

    /// Experimental modal analysis of FRFs or impact-test records: poles, damping, mode shapes, standard
    /// errors
    ///
    /// Poly-reference least-squares complex frequency (pLSCF, PolyMAX) with automatic pole selection from the
    /// stabilisation diagram and joint refinement on all FRFs; modes not supported by the data are dropped.
    /// Reads universal files (UFF), MATLAB, NumPy, CSV, HDF5 and results.h5 of this program. Time records of
    /// an impact test are converted to FRFs first: hits at the same points are averaged, double hits and
    /// overloads rejected. A run-up at 0 rpm with one [load.X] history is a simulated impact test. Writes
    /// results.h5, modes.uff (dataset 55) and figures: stabilisation diagram, auto-MAC, measured and
    /// synthesised FRFs, and mode shapes if the file has geometry.
    #[command(after_long_help = "\
Examples:
  rotordyn identify frfs.uff --band \"5 .. 180 Hz\"
  rotordyn identify test.npz --quantity accelerance --max-order 40
  rotordyn identify hit_*.mat --mapping channels.toml --exponential-window \"0.5 s\" --estimator hv
  rotordyn identify out/overhung_rig/results.h5 --json")]
    Identify(Box<IdentifyArgs>),

    /// Compare cases of one machine, and a measurement: modes, FRFs, unbalance responses, run-ups
    ///
    /// Variants, several values of a key, or named cases beside each other, in tables and on common axes: natural
    /// frequencies paired by MAC, FRFs, unbalance responses, Campbell diagrams; with --run-up run-ups. Measured FRFs or
    /// a recorded run-up stand beside them.
    #[command(after_long_help = compare::COMPARE, mut_arg("out", |out| out.help(results_in("out/NAME_comparison"))))]
    Compare(Box<CompareArgs>),

    /// Correlate the model with measured modes, FRFs or run-ups: mode pairing, MAC, frequency errors
    ///
    /// Pairs measured and computed modes by MAC and frequency (optimal assignment) and lists frequencies,
    /// errors, damping, MAC and unpaired modes. Measured FRFs are identified and compared with the model's,
    /// with FRAC and FDAC. Several files, such as impact tests at different force levels, are also compared
    /// with the first: shift of every mode. A measured run-up is compared with a simulation driven by the
    /// same speed: spectrogram maps, waterfalls and the peak of every order.
    #[command(after_long_help = update::VALIDATE, mut_arg("out", |out| out.help(results_in("out/NAME_validation or out/NAME_VARIANT_validation"))))]
    Validate(Box<ValidateArgs>),

    /// Model updating: fit stiffnesses, dampings or any other parameters to measurements
    ///
    /// Weighted least squares with priors and bounds on frequencies, mode shapes, damping or FRFs, by
    /// Levenberg-Marquardt with exact sensitivities. Reports the identifiability of every parameter: standard
    /// error, posterior over prior variance, and the poorly identifiable parameter combinations. Writes the
    /// model file with the updated values, the rest of its text unchanged, and figures before and after.
    #[command(after_long_help = update::UPDATE, mut_arg("out", |out| out.help(results_in("out/NAME_updated or out/NAME_VARIANT_updated"))))]
    Update(Box<UpdateArgs>),

    /// Explain the keys of the model file, or a command
    ///
    /// Without a name lists the tables of the model file; with the path of a table lists its keys with values,
    /// defaults and meaning; with the path of a key explains it. Names of items are left out or given. A name that is
    /// no key of the file but a command shows the help of the command.
    #[command(after_long_help = "\
Examples:
  rotordyn help
  rotordyn help bearing
  rotordyn help bearing.preload
  rotordyn help study.run_up.step
  rotordyn help --schema > rotordyn.schema.json
  rotordyn help commands
  rotordyn help run-up")]
    Help {
        /// Path of a table or key, such as bearing.preload, or a command; `commands` and `warnings` list them all
        path: Option<String>,
        /// Print the JSON Schema of the model file, for editors that complete and explain its keys
        #[arg(long, conflicts_with = "path")]
        schema: bool,
    },

    /// List or look up bearings of the built-in catalogue
    ///
    /// Without a designation lists all; with one (or its first characters) shows internal geometry, clearance
    /// classes of ISO 5753-1, defect frequencies as orders (FTF, BPFO, BPFI, BSF), and the source of the
    /// geometry.
    #[command(after_long_help = "\
Examples:
  rotordyn catalogue
  rotordyn catalogue 6205
  rotordyn catalogue 72 --json")]
    Catalogue {
        /// Designation or its first characters
        designation: Option<String>,
    },

    /// Analyse a measured or simulated record: spectra, envelope analysis, bearing diagnosis, kurtogram,
    /// orders, jerk
    ///
    /// Reads universal files (UFF), MATLAB, NumPy, WAV, CSV, HDF5 and stored runs; the format is detected
    /// from the content. The envelope spectrum is searched for bearing defect frequencies (BPFO, BPFI, BSF,
    /// FTF) to find the damaged part. With --compare-with, the envelope spectra of two records, such as measured
    /// and simulated, are drawn in one figure.
    #[command(after_long_help = super::signal::args::EXAMPLES)]
    Signal(Box<SignalArgs>),

    /// Follow several records of one machine over time, load or speed: statistics, bearing lines, diagnosis
    ///
    /// Every record gets a row: RMS, peak, crest factor, kurtosis, skewness, the amplitudes of the bearing's lines in one
    /// common band, and its diagnosis with probability. A change is stated if the Mann-Kendall test finds it significant
    /// among all quantities together, with the Theil-Sen slope and its 95 % interval. A record that cannot be read or
    /// judged is a row that says why; the exit code is then that of the first such record.
    #[command(after_long_help = super::trend::args::EXAMPLES)]
    Trend(Box<TrendArgs>),

    /// Export geometry, modes, FRFs and time histories: glTF (glb), VTK, UFF, MATLAB, NumPy, CSV, WAV
    ///
    /// Writes to the results folder: machine.glb and one glb for every ball bearing (any 3D viewer); mode
    /// shapes as VTK for ParaView, with discs, bodies and bearings as surfaces; mode shapes and, with [study.frf], FRFs as universal files for modal
    /// analysis programs; and the channels of a run-up stored in the folder in each of the formats. A run-up with
    /// motion_rate gives motion.glb, an animation, and motion.pvd for ParaView, with balls and cages as they moved.
    #[command(after_long_help = "\
Names: channels.mat has X001_B_ax_time, fs is the sampling rate in Hz, X001RPM is the mean speed. A WAV file contains \
one channel as 32-bit floats in SI units.

Examples:
  rotordyn export models/overhung_rig.toml
  rotordyn export models/overhung_rig.toml --mode-frames 24
  rotordyn export models/overhung_rig.toml --formats mat,wav --number 105")]
    Export(ExportArgs),
}
