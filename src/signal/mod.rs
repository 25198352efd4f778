//! Signal processing on slices and a sample rate; knows no rotor.
//!
//! | module | what it answers |
//! |---|---|
//! | [`window`] | rectangular, Hann, Hamming, Blackman, flat top; gain and noise bandwidth |
//! | [`filter`] | Butterworth sections, causal or zero-phase |
//! | [`spectrum`] | amplitude spectrum, PSD and cross spectrum by Welch, coherence, dB |
//! | [`stft`] | spectrogram over time and rpm |
//! | [`resample`] | uniform in shaft angle, uniform in time |
//! | [`order`] | order spectrogram, order cuts, averaged order spectrum |
//! | [`waterfall`] | spectra at chosen speeds |
//! | [`ridge`] | peaks between bins, the ridge near a line |
//! | [`orbit`] | filtered orbit, whirl, full spectrum |
//! | [`poincare`] | stroboscopic section by a phase, groups of its points |
//! | [`period`] | period of a section; quasi-periodic or chaotic by the 0–1 test |
//! | [`lyapunov`] | largest Lyapunov exponent from the growth of a perturbation |
//! | [`statistics`] | RMS, peak, crest factor, skewness, kurtosis |
//! | [`impact`] | impact tests: hits, their quality, H1, H2, Hv and coherence |
//! | [`envelope`] | analytic signal, envelope, envelope spectrum, squared envelope, of a band |
//! | [`kurtogram`] | spectral kurtosis, fast kurtogram, bands scored by anything ([`filter_bank`]) |
//! | [`bearing_lines`] | lines at FTF, BPFO, BPFI, 2 BSF with side bands over background; which part is damaged |
//! | [`diagnosis`] | from a record to that verdict |
//! | [`race_defects`] | dents and bumps of a race: angle, width, kind ([`jerk`]) |
//! | [`cepstrum`] | real and power cepstrum, liftering |
//! | [`cyclic`] | cyclic spectral coherence |
//! | [`tacho`] | shaft angle from pulses |
//! | [`speed_line`] | shaft angle from a line of the record itself |
//! | [`synchronous`] | time-synchronous average |
//! | [`record`] | records, FRFs, geometry and shapes as files hold them |
//!
//! Sample n of a record is at t = n/f_s; every function refuses empty records, NaN and infinity with a
//! [`SignalError`].

pub mod bearing_lines;
pub mod cepstrum;
pub mod cyclic;
pub mod diagnosis;
pub mod envelope;
pub mod error;
pub mod filter;
pub mod filter_bank;
pub mod impact;
pub mod jerk;
pub mod kurtogram;
pub mod lyapunov;
pub mod orbit;
pub mod order;
pub mod period;
pub mod poincare;
pub mod race_defects;
pub mod record;
pub mod resample;
pub mod ridge;
pub mod segment;
pub mod spectrum;
pub mod speed_line;
pub mod statistics;
pub mod stft;
pub mod synchronous;
pub mod tacho;
pub mod waterfall;
pub mod window;

pub use error::SignalError;
pub use rustfft::num_complex::Complex;
pub use window::WindowKind;
