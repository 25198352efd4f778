//! Geometric imperfections of races and balls: waviness, eccentric races, off-size balls; defects are in
//! `defects`.

use super::{contact, defects};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::reader::{Reader, any, not_negative};
use crate::file::tree::Value;
use rotordyn_bearing::{
    BallBearing, BallGeometry, BallSpin, BallWave, DefectLaw, Imperfections, OffSize, Preload, Wave,
};
use rotordyn_units::{ANGLE, LENGTH, NUMBER};
use std::f64::consts::TAU;

/// Highest order of waviness.
const MAX_WAVINESS_ORDER: usize = 10_000;

/// Keywords of the key `defect_law`.
#[derive(Clone, Copy, PartialEq)]
enum DefectLawKeyword {
    Displacement,
    Undamped,
    Force,
    ForceOnLoaded,
}

/// All geometric imperfections of races and balls; `pair`: whether the bearing has two rows.
pub(super) fn read(r: &Reader, g: &BallGeometry, pair: bool) -> Imperfections {
    let mut inner_waviness = waviness(r, "inner_waviness");
    let mut outer_waviness = waviness(r, "outer_waviness");
    let eccentric = |key: &str, wave: fn(f64, f64, f64) -> Wave| {
        eccentricity(r, key).map(|[by, towards]| wave(by, towards, g.contact_angle))
    };
    inner_waviness.extend(eccentric("inner_eccentricity", Wave::eccentric_inner));
    outer_waviness.extend(eccentric("outer_eccentricity", Wave::eccentric_outer));
    Imperfections {
        inner_waviness,
        outer_waviness,
        ball_waviness: ball_waviness(r, g.balls),
        off_size: off_size(r, g, pair),
        defects: defects::read(r, g, pair),
        law: defect_law(r),
        spin: r
            .choice("ball_spin", &[("rolling", BallSpin::Rolling), ("shaft", BallSpin::Shaft)])
            .unwrap_or_default(),
    }
}

/// Waviness: a list of harmonics, `[{ order = 2, amplitude = "1 um" }]`, or a spectrum,
/// `{ amplitude = "2 um", from = 2, to = 15 }`.
fn waviness(r: &Reader, key: &str) -> Vec<Wave> {
    if let Some(spectrum) = WavinessSpectrum::read(r, key) {
        let mut seed = spectrum.seed;
        return spectrum.waves(&mut seed);
    }
    let read = |wave: Reader| {
        let out = one_wave(&wave);
        wave.finish();
        out
    };
    wave_tables(r, key).into_iter().map(read).collect()
}

/// Waviness of balls: a harmonic with `ball` applies to that ball only; a spectrum gives every ball different
/// phases unless `same_phase = true`.
fn ball_waviness(r: &Reader, balls: usize) -> Vec<BallWave> {
    const KEY: &str = "ball_waviness";
    if let Some(spectrum) = WavinessSpectrum::read(r, KEY) {
        let mut seed = spectrum.seed;
        let on = |ball: Option<usize>, waves: Vec<Wave>| {
            waves.into_iter().map(move |wave| BallWave { ball, wave }).collect::<Vec<_>>()
        };
        return match spectrum.same_phase {
            true => on(None, spectrum.waves(&mut seed)),
            false => (0..balls).flat_map(|ball| on(Some(ball), spectrum.waves(&mut seed))).collect(),
        };
    }
    let read = |wave: Reader| {
        let ball = wave.has("ball").then(|| wave.count("ball", 0, 0..=balls - 1));
        let out = BallWave { ball, wave: one_wave(&wave) };
        wave.finish();
        out
    };
    wave_tables(r, KEY).into_iter().map(read).collect()
}

fn wave_tables<'a>(r: &Reader<'a>, key: &str) -> Vec<Reader<'a>> {
    if is_table(r, key) { Vec::new() } else { r.tables(key) }
}

fn is_table(r: &Reader, key: &str) -> bool {
    matches!(r.entry(key).map(|e| &e.node.value), Some(Value::Table(_)))
}

fn one_wave(wave: &Reader) -> Wave {
    let order = wave.count("order", 1, 1..=MAX_WAVINESS_ORDER);
    if !wave.has("order") {
        wave.missing("order", "2");
    }
    let amplitude = wave.need("amplitude", not_negative(LENGTH));
    Wave { order: order as u32, amplitude, phase: wave.or("phase", any(ANGLE), 0.0) }
}

/// Waviness spectrum over the order n: amplitude/n (default), `law = "constant"`, or `roughness_exponent = s`
/// for amplitude/nˢ; pseudo-random phases from a seed.
struct WavinessSpectrum {
    amplitudes: Vec<(u32, f64)>,
    seed: u64,
    same_phase: bool,
}

impl WavinessSpectrum {
    /// `None` if the key is absent or a list.
    fn read(r: &Reader, key: &str) -> Option<Self> {
        if !is_table(r, key) {
            return None;
        }
        let law = r.table(key)?;
        let amplitude = law.need("amplitude", not_negative(LENGTH));
        let (from, to) =
            (law.count("from", 2, 1..=MAX_WAVINESS_ORDER), law.count("to", 15, 1..=MAX_WAVINESS_ORDER));
        let exponent = match law.one_of(&["law", "roughness_exponent"]) {
            Some("roughness_exponent") => Some(law.or("roughness_exponent", not_negative(NUMBER), 1.0)),
            _ => law.choice("law", &[("1/n", None), ("constant", Some(0.0))]).flatten(),
        };
        let seed = law.count("seed", 1, 0..=usize::MAX >> 1) as u64;
        if to < from && law.has_no_errors() {
            law.error(Kind::OutOfRange, "to", format!("{} is below {}", law.name("to"), law.name("from")));
        }
        let same_phase = key == "ball_waviness" && law.flag("same_phase", false);
        law.finish();
        let at = |n: usize| amplitude / exponent.map_or(n as f64, |s| (n as f64).powf(s));
        Some(Self { amplitudes: (from..=to).map(|n| (n as u32, at(n))).collect(), seed, same_phase })
    }

    fn waves(&self, seed: &mut u64) -> Vec<Wave> {
        let wave =
            |&(order, amplitude): &(u32, f64)| Wave { order, amplitude, phase: TAU * next_uniform(seed) };
        self.amplitudes.iter().map(wave).collect()
    }
}

/// Next uniform pseudo-random number in [0, 1) of SplitMix64, reproducible on every platform.
fn next_uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Eccentricity of a race: `{ amount = "2 um", angle = "30 deg" }`, magnitude and direction.
fn eccentricity(r: &Reader, key: &str) -> Option<[f64; 2]> {
    let table = r.table(key)?;
    let out = [table.need("amount", not_negative(LENGTH)), table.or("angle", any(ANGLE), 0.0)];
    table.finish();
    Some(out)
}

/// Deviations of ball diameters: `[{ ball = 0, diameter_difference = "0.2 um" }]`.
fn off_size(r: &Reader, g: &BallGeometry, pair: bool) -> Vec<OffSize> {
    let most = 0.01 * g.ball_diameter;
    let read = |size: Reader| {
        if !size.has("ball") {
            size.missing("ball", "0");
        }
        let out = OffSize {
            ball: size.count("ball", 0, 0..=g.balls - 1),
            diameter_difference: size.need("diameter_difference", any(LENGTH)),
            row: defects::row(&size, pair),
        };
        if size.has_no_errors() && out.diameter_difference.abs() > most {
            let message =
                format!("{} is more than a hundredth of the ball diameter", size.name("diameter_difference"));
            let problem = Problem::new(Kind::OutOfRange, &size.span_of("diameter_difference"), message);
            size.log.error(
                problem.expected(format!(
                    "a diameter deviation within {:.1} um, such as \"0.2 um\"",
                    most * 1e6
                )),
            );
        }
        size.finish();
        out
    };
    r.tables("off_size").into_iter().map(read).collect()
}

/// `defect_law`, with `defect_stiffness` if it is a force law.
fn defect_law(r: &Reader) -> DefectLaw {
    let words = [
        ("displacement", DefectLawKeyword::Displacement),
        ("undamped_displacement", DefectLawKeyword::Undamped),
        ("force", DefectLawKeyword::Force),
        ("force_on_loaded", DefectLawKeyword::ForceOnLoaded),
    ];
    let word = r.choice("defect_law", &words);
    let law = word.unwrap_or(DefectLawKeyword::Displacement);
    let force = matches!(law, DefectLawKeyword::Force | DefectLawKeyword::ForceOnLoaded);
    let given = r.has("defect_stiffness");
    if given && !force {
        // a misspelt law was already reported
        if word.is_some() || !r.has("defect_law") {
            let message = format!("{} applies only to a force law", r.name("defect_stiffness"));
            let problem = Problem::new(Kind::Conflict, &r.span_of("defect_stiffness"), message);
            r.log.error(problem.expected("defect_law = \"force\" or \"force_on_loaded\""));
        }
    }
    let stiffness = (given && force).then(|| contact::power_stiffness(r, "defect_stiffness", 1.5));
    match law {
        DefectLawKeyword::Displacement => DefectLaw::Displacement,
        DefectLawKeyword::Undamped => DefectLaw::UndampedDisplacement,
        DefectLawKeyword::Force => DefectLaw::Force { stiffness, loaded_only: false },
        DefectLawKeyword::ForceOnLoaded => DefectLaw::Force { stiffness, loaded_only: true },
    }
}

/// Report options that are incompatible with the force law of defects.
pub(super) fn check_force_law(r: &Reader, bearing: &BallBearing) {
    let DefectLaw::Force { stiffness, .. } = bearing.imperfections.law else { return };
    let conflict = |key: &str, message: String, expected: &str| {
        let problem = Problem::new(Kind::Conflict, &r.span_of(key), message);
        r.log.error(problem.expected(expected).hint(
            "defect_law = \"displacement\" works with every bearing; the force law is from the literature",
        ));
    };
    let law = r.name("defect_law");
    if bearing.inertia.is_on() {
        conflict(
            "ball_inertia",
            format!("{law} does not define on which contact of a ball with inertia the force acts"),
            "ball_inertia = \"none\"",
        );
    }
    if matches!(bearing.preload, Preload::Spring { .. }) {
        conflict(
            "preload",
            format!("{law} has no potential energy, which the equilibrium of a spring preload needs"),
            "a rigid preload",
        );
    }
    if stiffness.is_none() && !bearing.contact.has_separate_contacts() {
        conflict(
            "defect_law",
            format!("{law} needs a Hertz stiffness, which a fitted power law does not have"),
            "defect_stiffness as well, such as \"1.58e10 N/m^1.5\"",
        );
    }
}
