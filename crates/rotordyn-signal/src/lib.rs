//! Signal processing of sampled records (slices with a sample rate), independent of the rotor model.
//!
//! | module | contents |
//! |---|---|
//! | [`window`] | rectangular, Hann, Hamming, Blackman, flat top; gain and noise bandwidth |
//! | [`filter`] | Butterworth filters (IIR, second-order sections), causal or zero-phase |
//! | [`spectrum`] | amplitude spectrum, PSD and cross spectrum by Welch, coherence, dB |
//! | [`stft`] | short-time Fourier transform: spectrogram over time and rpm |
//! | [`decimate`] | fewer samples behind an anti-aliasing filter, while the record grows |
//! | [`resample`] | resampling uniform in shaft angle (angular resampling) or in time |
//! | [`order`] | order tracking: order spectrogram, order cuts, averaged order spectrum |
//! | [`vold_kalman`] | Vold-Kalman order tracking: complex amplitudes of several orders, sample by sample |
//! | [`order_background`] | background beside an order, and how certain a level over it is |
//! | [`order_neighbours`] | lines of other orders in the band of an order |
//! | [`order_tracks`] | amplitude and phase of orders over time and speed, from the Vold-Kalman filter |
//! | [`waterfall`] | waterfall (cascade) plot: spectra at chosen speeds |
//! | [`ridge`] | peak interpolation, peaks of a spectrogram near a given line |
//! | [`orbit`] | filtered orbit, forward and backward whirl, full spectrum |
//! | [`poincare`] | Poincaré section (stroboscopic sampling) by a phase, clusters of its points |
//! | [`motion_classification`] | classification of a motion: periodic, quasi-periodic or chaotic (0–1 test) |
//! | [`lyapunov`] | largest Lyapunov exponent from the growth of a perturbation |
//! | [`band_noise`] | band-limited Gaussian random function of time |
//! | [`clipping`] | samples that stand at a limit of their channel |
//! | [`dropout`] | dead channels, gaps, single absurd samples |
//! | [`statistics`] | RMS, peak, crest factor, skewness, kurtosis |
//! | [`impact`] | impact (hammer) test: detection and quality of hits, FRF estimators H1, H2, Hv, coherence, windows |
//! | [`envelope`] | Hilbert transform: analytic signal, envelope, (squared) envelope spectrum of a band |
//! | [`kurtogram`] | spectral kurtosis, fast kurtogram, band selection by any score ([`filter_bank`]) |
//! | [`bearing_lines`] | bearing defect frequencies FTF, BPFO, BPFI, 2 BSF with side bands; damaged part |
//! | [`diagnosis`] | bearing diagnosis of a record: band, envelope spectrum, defect frequencies |
//! | [`grading`] | what a record says of a bearing: damaged part with its probability, rivals, lines left unexplained |
//! | [`race_defects`] | localised race defects (dents, bumps): angle, width, kind ([`jerk`]) |
//! | [`cepstrum`] | real and power cepstrum, liftering |
//! | [`cyclic`] | cyclic spectral coherence (cyclostationarity) |
//! | [`tacho`] | shaft angle from tachometer (keyphasor) pulses |
//! | [`tacho_jitter`] | what the jitter of the pulses leaves of a strong order beside it |
//! | [`tacholess`] | tacholess speed estimation: shaft angle from an order line of the record |
//! | [`synchronous`] | time-synchronous average (TSA) |
//! | [`trend`] | trend over several records: Mann-Kendall test, Theil-Sen slope |
//! | [`record`] | measured records, FRFs, test geometry and mode shapes as read from files |
//!
//! Sample n of a record is at t = n/f_s; every function returns a [`SignalError`] for empty records, NaN and
//! infinity.

mod background;
pub mod band_noise;
pub mod bearing_lines;
pub mod cepstrum;
pub mod clipping;
pub mod cyclic;
pub mod decimate;
mod demodulator;
pub mod diagnosis;
pub mod dropout;
pub mod envelope;
pub mod error;
pub mod filter;
pub mod filter_bank;
mod gaussian;
pub mod grading;
pub mod impact;
pub mod jerk;
mod kaiser;
pub mod kurtogram;
pub mod lyapunov;
pub mod motion_classification;
pub mod orbit;
pub mod order;
pub mod order_background;
pub mod order_neighbours;
pub mod order_tracks;
pub mod poincare;
mod quantity;
pub mod race_defects;
pub mod record;
pub mod resample;
pub mod ridge;
pub mod segment;
mod settling;
pub mod spectrum;
pub mod statistics;
pub mod stft;
pub mod synchronous;
pub mod tacho;
pub mod tacho_jitter;
pub mod tacholess;
pub mod trend;
pub mod vold_kalman;
pub mod waterfall;
pub mod window;

pub use error::SignalError;
pub use quantity::Quantity;
pub use rustfft::num_complex::Complex;
pub use window::WindowKind;
