//! Long help texts of the command.

pub const LONG_ABOUT: &str = "\
Rotordynamics of rotor-bearing systems: a flexible shaft with discs on ball or linear bearings, in housings on springs.

One TOML file describes the machine and the studies: static equilibrium, natural frequencies and mode shapes, \
Campbell diagrams, critical speeds, FRFs, unbalance responses, nonlinear run-ups with one Hertz contact per ball, and \
the spectrograms and order spectra of those run-ups.";

pub const AFTER_HELP: &str = "\
Examples:
  rotordyn init motor                                          writes motor.toml, a machine to start from
  rotordyn run models/overhung_rig.toml                        all studies of the file
  rotordyn check my_machine.toml                               validate and summarise the model
  rotordyn modal my_machine.toml --speed \"0, 3000 rpm\"         natural frequencies at two speeds
  rotordyn run-up my_machine.toml --set bearing.B.radial_clearance=\"20 um\"
  rotordyn compare models/overhung_rig.toml --variants spherical,cylindrical,base
  rotordyn spectrogram out/overhung_rig --channels B_ax        of a stored run-up
  rotordyn bearing models/overhung_rig.toml --bearing A        loads, contacts, stiffness of one bearing
  rotordyn signal record.mat --rate \"12 kHz\" --bearing 6205   bearing diagnosis from the envelope
  rotordyn trend pump_7/ --bearing 6205 --speed \"1480 rpm\"     several records of one machine over time
  rotordyn identify frfs.uff --band \"5 .. 180 Hz\"             modes from measured FRFs
  rotordyn catalogue 6205

Units: values are written with their unit: \"20 um\", \"1200 rpm\", \"12 deg\", \"2.1e11 Pa\". A bare number is an error.

Results go to out/NAME/ (out/NAME_VARIANT/ for a variant): results.h5 (HDF5, opens with h5py) and every figure as SVG \
and PNG. One command at a time writes to a folder. While one runs, results_unfinished.h5 has its finished studies and \
the samples so far; it stays if the program is killed, and spectrogram, orders, signal and export read it. Tables go to standard output; progress, warnings and errors to standard error.

Exit codes:
  0    success
  2    invalid input: arguments, model file, settings, measured data
  3    no solution: no equilibrium, no convergence, an unconstrained rigid-body mode; partial results are on disk
  4    file error: a file or folder cannot be read or written
  5    with --strict: there are warnings; everything is computed and written
  101  internal error (a bug in rotordyn): please report it
  129  ended by SIGHUP (terminal closed); partial results are on disk
  130  ended by Ctrl-C; partial results are on disk
  143  ended by SIGTERM; partial results are on disk

Warnings have a code: `rotordyn help CODE` explains one, `rotordyn help warnings` lists them.

Environment: NO_COLOR or TERM=dumb disables colour; RAYON_NUM_THREADS is the default of --threads.";
