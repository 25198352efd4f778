//! `[study.spectrogram]` and `[study.orders]`: against sampling rate, length and turns of the run, which the speed profile
//! gives before it.

use super::orders::{ORDER, orders};
use super::rounding::{rounded_down, rounded_up};
use super::run_keys::channels;
use super::run_up::RUN_UP;
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Declared, Group, Quantity, Special, Table, Texts, Words, below, keys, positive, quantity, special, texts,
    words,
};
use crate::file::quantities::declared_default;
use crate::file::reader::Reader;
use crate::study::{OrderStudy, RunUpStudy, SpectrogramStudy, WindowKind};
use crate::{Drive, Model};
use rotordyn_signal::resample::SAMPLES_PER_ORDER;
use rotordyn_units::{FREQUENCY, NUMBER, TIME};
use std::f64::consts::TAU;

keys! {
    /// Windows of `[study.spectrogram]` and `[study.orders]`.
    static WINDOW: WindowKeys {
        channels: Texts = texts("names of probes", "Channels.").computed("all vibration channels")
            .example("[\"disc_x\"]");
        window: Words<WindowKind> = words(&[
            ("rectangular", WindowKind::Rectangular),
            ("hann", WindowKind::Hann),
            ("hamming", WindowKind::Hamming),
            ("blackman", WindowKind::Blackman),
            ("flat-top", WindowKind::FlatTop),
        ], "Window function.").default("hann");
        overlap: Quantity = quantity(below(NUMBER, [0.0, 1.0]), "Overlap of successive windows.").default("0.75");
    }
}

pub(super) static SPECTROGRAM_TABLE: Table = Table {
    meaning: "Spectrograms of the run-up over time and speed.",
    groups: &[Group::always(WindowKeys::LIST), Group::always(SpectrogramKeys::LIST)],
};

keys! {
    /// `[study.spectrogram]`.
    static SPECTROGRAM: SpectrogramKeys {
        length: Quantity = quantity(positive(TIME), "Length of a window; by default half the run if that is shorter than 1 s.").default("1 s");
        max_frequency: Quantity = quantity(positive(FREQUENCY), "Highest frequency.")
            .computed("half the sampling rate");
        dynamic_range_db: Quantity = quantity(positive(NUMBER), "Range of the colours in dB.").default("60");
        orders: Special = special(ORDER, "Order lines.").default("1");
    }
}

pub(super) static ORDERS_TABLE: Table = Table {
    meaning: "Order tracking of the run-up.",
    groups: &[Group::always(WindowKeys::LIST), Group::always(OrderKeys::LIST)],
};

keys! {
    /// `[study.orders]`.
    static ORDERS: OrderKeys {
        resolution: Quantity = quantity(positive(NUMBER), "Order resolution, at most 1; coarser by default in a run of fewer turns than a window of 0.05 has.").default("0.05");
        max_order: Quantity = quantity(positive(NUMBER),
            "Highest order; by default at least a tenth above the highest cut, and less where a given sample_rate allows less.").default("20");
        cuts: Special = special(ORDER, "Order cuts: levels of these orders over speed.").default("1");
        bandwidth: Quantity = quantity(positive(NUMBER),
            "With it the Vold-Kalman filter also tracks amplitude and phase of the cuts' orders: its -3 dB bandwidth in orders.")
            .computed("not tracked").example("0.2");
    }
}

/// Speed below which the shaft is at standstill for order tracking \[rad/s\].
const STANDSTILL: f64 = 0.05 * TAU;
/// Times at which the speed profile is looked at.
const POINTS: usize = 20_000;
/// Range of order resolutions and of highest orders that order tracking takes.
const COARSEST: f64 = 1.0;
const HIGHEST: f64 = 1e4;
/// Windows in a run that is too short for those by default.
const WINDOWS: f64 = 2.0;

pub(super) fn spectrogram(r: &Reader, model: &Model, run: Option<&RunUpStudy>) -> SpectrogramStudy {
    needs_run_up(r, run);
    let sample_rate = run.map_or(0.0, |run| run.sample_rate);
    let highest = &SPECTROGRAM.max_frequency;
    let max_frequency = r.or(highest, 0.5 * sample_rate);
    if max_frequency > 0.5 * sample_rate && sample_rate > 0.0 {
        let message = format!("{} is above half the sampling rate", r.name(highest));
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(highest), message);
        r.log.error(problem.hint("raise study.run_up.sample_rate"));
    }
    SpectrogramStudy {
        channels: channels(r, &WINDOW.channels, model),
        window: r.word(&WINDOW.window),
        length: length(r, model.profile.duration(), sample_rate),
        overlap: r.value(&WINDOW.overlap),
        max_frequency,
        dynamic_range_db: r.value(&SPECTROGRAM.dynamic_range_db),
        orders: orders(r, &SPECTROGRAM.orders, model),
    }
}

/// Length of a window \[s\]: not longer than the run, and of two samples at least.
fn length(r: &Reader, duration: f64, sample_rate: f64) -> f64 {
    let key = &SPECTROGRAM.length;
    if sample_rate == 0.0 {
        return r.value(key);
    }
    // Both ends of the run are sampled.
    let samples = (duration * sample_rate).floor() + 1.0;
    let fits = |length: f64| (length * sample_rate).round() <= samples;
    let by_default = declared_default(key);
    if !r.has(key) && !fits(by_default) && duration > 0.0 {
        let length = rounded_down(duration / WINDOWS);
        r.taken_by_default(key, format!("\"{length} s\""));
        return length;
    }
    let length = r.value(key);
    if !fits(length) {
        let message = format!("{} of {length} s is longer than the run of {duration} s", r.name(key));
        let problem = Problem::new(Kind::Conflict, &r.span_of(key), message);
        r.log.conflict(problem.hint("shorten it, or lengthen the run in [speed]"));
    } else if (length * sample_rate).round() < 2.0 {
        let message = format!("{} of {length} s is shorter than two samples", r.name(key));
        let problem = Problem::new(Kind::Conflict, &r.span_of(key), message);
        r.log.conflict(problem.hint("lengthen it, or raise study.run_up.sample_rate"));
    }
    length
}

/// The study with the highest order that its cuts and the default need, which [`fitted_orders`] fits to the run, and whether
/// its keys were read without errors.
pub(super) fn orders_of_run(r: &Reader, model: &Model) -> (OrderStudy, bool) {
    let cuts = orders(r, &ORDERS.cuts, model);
    let highest_cut = highest_of(&cuts);
    let highest = &ORDERS.max_order;
    let by_default = declared_default(highest).max(1.1 * highest_cut);
    let max_order = r.get(highest).unwrap_or(by_default);
    if r.has(highest) && max_order < highest_cut {
        let message = format!("{} is below the cut at order {highest_cut:.4}", r.name(highest));
        let problem = Problem::new(Kind::OutOfRange, &r.span_of(highest), message);
        r.log.error(problem.hint("raise it, or remove the cut"));
    }
    let study = OrderStudy {
        channels: channels(r, &WINDOW.channels, model),
        resolution: r.or(&ORDERS.resolution, declared_default(&ORDERS.resolution)),
        max_order,
        max_order_is_default: max_order == by_default,
        overlap: r.value(&WINDOW.overlap),
        window: r.word(&WINDOW.window),
        cuts,
        bandwidth: r.get(&ORDERS.bandwidth),
    };
    (study, r.has_no_errors())
}

/// The study with defaults that fit the run; conflicts where given values do not, if its own keys were read without errors.
pub(super) fn fitted_orders(
    r: &Reader,
    (mut study, is_sound): (OrderStudy, bool),
    model: &Model,
    run: Option<&RunUpStudy>,
) -> OrderStudy {
    needs_run_up(r, run);
    // A motor's torque gives no speed beforehand.
    let run = run.filter(|_| matches!(model.drive, Drive::Prescribed { .. }));
    if let Some(run) = run.filter(|_| is_sound) {
        fit_highest_order(r, &mut study, run.sample_rate, model.profile.top_speed());
        fit_resolution(r, &mut study, longest_turns(model));
    }
    for (key, value) in [(&ORDERS.max_order, study.max_order), (&ORDERS.resolution, study.resolution)] {
        if !r.has(key) {
            r.taken_by_default(key, value.to_string());
        }
    }
    check_ranges(r, &study);
    study
}

/// Lowers the highest order by default to what the sampling rate \[Hz\] takes at the highest speed \[rad/s\].
fn fit_highest_order(r: &Reader, study: &mut OrderStudy, sample_rate: f64, speed: f64) {
    let key = &ORDERS.max_order;
    let (highest, highest_cut) = (sample_rate / rate_for(1.0, speed), highest_of(&study.cuts));
    if study.max_order <= highest {
        return;
    }
    if !r.has(key) && highest_cut < highest {
        study.max_order = rounded_down(highest).max((1.1 * highest_cut).min(highest));
        return;
    }
    let (at, order): (&dyn Declared, f64) =
        if r.has(key) { (key, study.max_order) } else { (&ORDERS.cuts, highest_cut) };
    let needed = rounded_up(rate_for(order, speed));
    let message = format!(
        "{} of {} needs a sampling rate of {needed} Hz at {:.0} rpm: study.run_up.{} is {sample_rate} Hz",
        r.name(at),
        (1e4 * order).round() / 1e4,
        speed * 60.0 / TAU,
        RUN_UP.sample_rate.about.name
    );
    let problem = Problem::new(Kind::Conflict, &r.span_of(at), message);
    let lower = rounded_down(highest);
    r.log.conflict(problem.hint(format!("raise the sampling rate, or stay below order {lower}")));
}

/// Coarsens the resolution by default to what the longest turning of the shaft \[revolutions\] takes.
fn fit_resolution(r: &Reader, study: &mut OrderStudy, turns: f64) {
    let key = &ORDERS.resolution;
    if study.resolution * turns >= 1.0 || study.resolution > COARSEST {
        return;
    }
    if !r.has(key) && turns >= WINDOWS {
        study.resolution = rounded_up(WINDOWS / turns).min(COARSEST);
        return;
    }
    let needed = 1.0 / study.resolution;
    let message = format!(
        "{} of {} needs {needed:.0} turns of the shaft without stop or reversal: the run of [speed] has {turns:.1}",
        r.name(key),
        study.resolution
    );
    let problem = Problem::new(Kind::Conflict, &r.span_of(key), message);
    r.log.conflict(problem.hint("raise it, or lengthen the run in [speed]"));
}

fn check_ranges(r: &Reader, study: &OrderStudy) {
    let lowest_cut = study.cuts.iter().copied().fold(f64::INFINITY, f64::min);
    let refuse = |key: &dyn Declared, expected: String| {
        let message = format!("{} is out of range", r.name(key));
        r.log.error(Problem::new(Kind::OutOfRange, &r.span_of(key), message).expected(expected));
    };
    if study.resolution > COARSEST {
        refuse(&ORDERS.resolution, format!("at most {COARSEST}"));
    } else if study.max_order > HIGHEST {
        refuse(&ORDERS.max_order, format!("at most {HIGHEST}"));
    } else if study.max_order < study.resolution {
        refuse(&ORDERS.max_order, "the order resolution or more".into());
    }
    if study.bandwidth.is_some_and(|bandwidth| bandwidth > lowest_cut) {
        refuse(&ORDERS.bandwidth, format!("at most the lowest cut, {lowest_cut:.4}"));
    }
}

fn needs_run_up(r: &Reader, run: Option<&RunUpStudy>) {
    if run.is_none() {
        let problem = Problem::new(Kind::MissingKey, &r.span, format!("{} needs [study.run_up]", r.path));
        r.log.error(problem.hint("add [study.run_up], whose channels are analysed"));
    }
}

/// Least sampling rate \[Hz\] of an order at a speed \[rad/s\].
pub(super) fn rate_for(order: f64, speed: f64) -> f64 {
    SAMPLES_PER_ORDER * order * speed / TAU
}

/// Most revolutions of the speed profile without stop or reversal.
fn longest_turns(model: &Model) -> f64 {
    let (curve, duration) = (model.profile.curve(), model.profile.duration());
    let mut longest: f64 = 0.0;
    // Angle and direction at the start of the current turning.
    let mut start: Option<(f64, bool)> = None;
    for k in 0..=POINTS {
        let spin = curve.at(duration * k as f64 / POINTS as f64);
        let (turns, forward) = (spin.speed.abs() > STANDSTILL, spin.speed > 0.0);
        match start {
            Some((angle, before)) if turns && before == forward => {
                longest = longest.max((spin.angle - angle).abs());
            }
            _ => start = turns.then_some((spin.angle, forward)),
        }
    }
    longest / TAU
}

fn highest_of(orders: &[f64]) -> f64 {
    orders.iter().copied().fold(0.0, f64::max)
}
