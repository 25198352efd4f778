//! The long texts of the command's manual.

pub const LONG_ABOUT: &str = "\
Simulates rotating machines: a flexible shaft with discs on ball or linear bearings, in housings on springs.

One TOML file describes the machine and what to compute. From it come static equilibrium, natural frequencies and \
mode shapes, Campbell diagrams, critical speeds, FRFs, unbalance responses, nonlinear run-ups with one Hertz contact \
per ball, and the spectrograms and order spectra of those run-ups.";

pub const AFTER: &str = "\
Examples:
  rotordyn run models/overhung_rig.toml                        every study the file asks for
  rotordyn check my_machine.toml                               is the file sound? what is in it?
  rotordyn modal my_machine.toml --speed \"0, 3000 rpm\"         natural frequencies at two speeds
  rotordyn run-up my_machine.toml --set bearing.B.radial_clearance=\"20 um\"
  rotordyn compare models/overhung_rig.toml --variants spherical,cylindrical,base
  rotordyn spectrogram out/overhung_rig --channels B_ax        of a run-up that is on disk
  rotordyn bearing models/overhung_rig.toml --bearing A        loads, contacts, stiffness of one bearing
  rotordyn signal record.mat --rate \"12 kHz\" --bearing 6205   which part of the bearing is damaged?
  rotordyn identify frfs.uff --band \"5 Hz, 180 Hz\"            modes from measured FRFs
  rotordyn catalogue 6205

Units are written in values: \"20 um\", \"1200 rpm\", \"12 deg\", \"2.1e11 Pa\". A number without its unit is an error.

Results go to out/NAME/ (out/NAME_VARIANT/ for a variant): results.h5 (HDF5, opens with h5py) and every figure as SVG \
and PNG. Tables go to standard output; progress, warnings and errors to standard error.

Exit codes:
  0    done
  2    the input is wrong: arguments, model file, settings
  3    the physics has no answer: no equilibrium, no convergence, a free motion; what was computed is on disk
  4    the environment: a file or folder that cannot be read or written
  101  a bug in rotordyn: please report it
  130  ended by Ctrl-C; what was computed is on disk

Environment: NO_COLOR turns colour off; RAYON_NUM_THREADS is the default of --threads.";
