//! Geometric imperfections of races and balls: waviness, eccentric races, off-size balls; defects are in
//! `defects`.

use super::ball_inertia::BALL_INERTIA;
use super::defects::RowKeys;
use super::mounting::MOUNTING;
use super::{contact, defects};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Declared, Flag, Group, Key, PowerStiffness, Quantity, SubTable, Table, TableList, Words, any,
    count, flag, keys, not_negative, power_stiffness, quantity, sub_table, table_list, words,
};
use crate::file::reader::Reader;
use rotordyn_bearing::{
    BallBearing, BallGeometry, BallSpin, BallWave, DefectLaw, Imperfections, OffSize, Preload, Wave,
};
use rotordyn_units::{ANGLE, LENGTH, NUMBER};
use std::f64::consts::TAU;

/// Highest order of waviness.
const MAX_WAVINESS_ORDER: usize = 10_000;

/// Keywords of the key `defect_law`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum DefectLawKeyword {
    Displacement,
    Undamped,
    Force,
    ForceOnLoaded,
}

keys! {
    /// Of every ball bearing.
    pub(super) static IMPERFECTIONS: ImperfectionKeys {
        inner_waviness: TableList = table_list(WaveKeys::TABLE);
        inner_spectrum: SubTable = sub_table(SpectrumKeys::TABLE).named("inner_waviness");
        outer_waviness: TableList = table_list(WaveKeys::TABLE);
        outer_spectrum: SubTable = sub_table(SpectrumKeys::TABLE).named("outer_waviness");
        ball_waviness: TableList = table_list(&BALL_WAVE_TABLE);
        ball_spectrum: SubTable = sub_table(&BALL_SPECTRUM_TABLE).named("ball_waviness");
        off_size: TableList = table_list(&OFF_SIZE_TABLE);
        inner_eccentricity: SubTable = sub_table(EccentricityKeys::TABLE);
        outer_eccentricity: SubTable = sub_table(EccentricityKeys::TABLE);
        ball_spin: Words<BallSpin> = words(&[("rolling", BallSpin::Rolling), ("shaft", BallSpin::Shaft)],
            "Spin of the balls with their imperfections: that of rolling, or the speed of the shaft.")
            .default("rolling");
    }
}

keys! {
    /// Of `model = "ball"` only.
    pub(super) static DEFECT_LAW: DefectLawKeys {
        defect_law: Words<DefectLawKeyword> = words(&[
            ("displacement", DefectLawKeyword::Displacement),
            ("undamped_displacement", DefectLawKeyword::Undamped),
            ("force", DefectLawKeyword::Force),
            ("force_on_loaded", DefectLawKeyword::ForceOnLoaded),
        ], "How a defect acts; all but displacement are those of Atef et al. (2022).")
            .default("displacement");
        defect_stiffness: PowerStiffness = power_stiffness("1.5", "Contact stiffness of the laws force and force_on_loaded.")
            .computed("that of the contacts").with("defect_law = \"force\"").example("\"1.58e10 N/m^1.5\"");
    }
}

keys! {
    /// A harmonic of waviness.
    static WAVE: WaveKeys = "A harmonic of waviness." {
        order: Count = count([1, MAX_WAVINESS_ORDER], "Waves per circumference.").example("2");
        amplitude: Quantity = quantity(not_negative(LENGTH), "Amplitude of the deviation along the contact normal.").example("\"1 um\"");
        phase: Quantity = quantity(any(ANGLE), "Phase of the wave.").default("0 deg").example("\"90 deg\"");
    }
}

keys! {
    /// A harmonic of balls.
    static BALL_WAVE: BallWaveKeys {
        ball: Count = count([0, 999], "The ball that has it, counted from 0.").computed("every ball");
    }
}

static BALL_WAVE_TABLE: Table = Table {
    meaning: "A harmonic of waviness of the balls.",
    groups: &[Group::always(WaveKeys::LIST), Group::always(BallWaveKeys::LIST)],
};

keys! {
    /// Waviness as a spectrum.
    static SPECTRUM: SpectrumKeys = "Waviness as a spectrum over the order n, with random phases." {
        amplitude: Quantity = quantity(not_negative(LENGTH), "Amplitude at order 1.").example("\"2 um\"");
        from: Count = count([1, MAX_WAVINESS_ORDER], "Lowest order.").default("2");
        to: Count = count([1, MAX_WAVINESS_ORDER], "Highest order.").default("15");
        law: Words<Option<f64>> = words(&[("1/n", None), ("constant", Some(0.0))], "Amplitudes over the order.")
            .default("1/n");
        roughness_exponent: Quantity = quantity(not_negative(NUMBER), "Amplitudes fall with this power of the order.")
            .computed("by law").example("1.5");
        seed: Count = count([0, usize::MAX >> 1], "Seed of the phases.").default("1");
    }
}

keys! {
    /// A spectrum of balls.
    static BALL_SPECTRUM: BallSpectrumKeys {
        same_phase: Flag = flag("Whether all balls have the same phases.").default("false");
    }
}

static BALL_SPECTRUM_TABLE: Table = Table {
    meaning: "Waviness of the balls as a spectrum over the order n, with random phases.",
    groups: &[Group::always(SpectrumKeys::LIST), Group::always(BallSpectrumKeys::LIST)],
};

keys! {
    /// Eccentricity of a race.
    static ECCENTRICITY: EccentricityKeys = "Eccentricity of a race." {
        amount: Quantity = quantity(not_negative(LENGTH), "Distance of the centres.").example("\"2 um\"");
        angle: Quantity = quantity(any(ANGLE), "Direction, from +x towards +y.").default("0 deg").example("\"30 deg\"");
    }
}

keys! {
    /// A ball of another size.
    static OFF_SIZE: OffSizeKeys {
        ball: Count = count([0, 999], "The ball, counted from 0.");
        diameter_difference: Quantity = quantity(any(LENGTH),
            "Difference of its diameter, at most a hundredth of it.").example("\"0.2 um\"");
    }
}

static OFF_SIZE_TABLE: Table = Table {
    meaning: "A ball of another size.",
    groups: &[Group::always(OffSizeKeys::LIST), Group::always(RowKeys::LIST)],
};

/// All geometric imperfections of races and balls; `pair`: whether the bearing has two rows.
pub(super) fn read(r: &Reader, g: &BallGeometry, pair: bool) -> Imperfections {
    let keys = &IMPERFECTIONS;
    let mut inner_waviness = waviness(r, &keys.inner_waviness, &keys.inner_spectrum);
    let mut outer_waviness = waviness(r, &keys.outer_waviness, &keys.outer_spectrum);
    let eccentric = |key: &Key<SubTable>, wave: fn(f64, f64, f64) -> Wave| {
        eccentricity(r, key).map(|[by, towards]| wave(by, towards, g.contact_angle))
    };
    inner_waviness.extend(eccentric(&keys.inner_eccentricity, Wave::eccentric_inner));
    outer_waviness.extend(eccentric(&keys.outer_eccentricity, Wave::eccentric_outer));
    Imperfections {
        inner_waviness,
        outer_waviness,
        ball_waviness: ball_waviness(r, g.balls),
        off_size: off_size(r, g, pair),
        defects: defects::read(r, g, pair),
        law: defect_law(r),
        spin: r.word(&keys.ball_spin),
    }
}

/// Waviness: a list of harmonics, `[{ order = 2, amplitude = "1 um" }]`, or a spectrum,
/// `{ amplitude = "2 um", from = 2, to = 15 }`.
fn waviness(r: &Reader, waves: &Key<TableList>, spectrum: &Key<SubTable>) -> Vec<Wave> {
    if let Some(spectrum) = WavinessSpectrum::read(r, spectrum, false) {
        let mut seed = spectrum.seed;
        return spectrum.waves(&mut seed);
    }
    let read = |wave: Reader| {
        let out = one_wave(&wave);
        wave.finish();
        out
    };
    wave_tables(r, waves).into_iter().map(read).collect()
}

/// Waviness of balls: a harmonic with `ball` applies to that ball only; a spectrum gives every ball different
/// phases unless `same_phase = true`.
fn ball_waviness(r: &Reader, balls: usize) -> Vec<BallWave> {
    if let Some(spectrum) = WavinessSpectrum::read(r, &IMPERFECTIONS.ball_spectrum, true) {
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
        let key = &BALL_WAVE.ball;
        let ball = wave.has(key).then(|| wave.count_up_to(key, balls - 1).unwrap_or(0));
        let out = BallWave { ball, wave: one_wave(&wave) };
        wave.finish();
        out
    };
    wave_tables(r, &IMPERFECTIONS.ball_waviness).into_iter().map(read).collect()
}

fn wave_tables<'a>(r: &Reader<'a>, key: &Key<TableList>) -> Vec<Reader<'a>> {
    if r.has_table(key) { Vec::new() } else { r.tables(key) }
}

fn one_wave(wave: &Reader) -> Wave {
    let order = wave.count(&WAVE.order);
    Wave { order: order as u32, amplitude: wave.value(&WAVE.amplitude), phase: wave.value(&WAVE.phase) }
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
    fn read(r: &Reader, key: &Key<SubTable>, of_balls: bool) -> Option<Self> {
        if !r.has_table(key) {
            return None;
        }
        let law = r.table(key)?;
        let amplitude = law.value(&SPECTRUM.amplitude);
        let (from, to) = (law.count(&SPECTRUM.from), law.count(&SPECTRUM.to));
        let exponent = match law.one_of(&[&SPECTRUM.law, &SPECTRUM.roughness_exponent]) {
            Some(given) if given.is(&SPECTRUM.roughness_exponent) => {
                Some(law.value(&SPECTRUM.roughness_exponent))
            }
            _ => law.word(&SPECTRUM.law),
        };
        let seed = law.count(&SPECTRUM.seed) as u64;
        if to < from && law.has_no_errors() {
            let message = format!("{} is below {}", law.name(&SPECTRUM.to), law.name(&SPECTRUM.from));
            law.error(Kind::OutOfRange, &SPECTRUM.to, message);
        }
        let same_phase = of_balls && law.flag(&BALL_SPECTRUM.same_phase);
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
fn eccentricity(r: &Reader, key: &Key<SubTable>) -> Option<[f64; 2]> {
    let table = r.table(key)?;
    let out = [table.value(&ECCENTRICITY.amount), table.value(&ECCENTRICITY.angle)];
    table.finish();
    Some(out)
}

/// Deviations of ball diameters: `[{ ball = 0, diameter_difference = "0.2 um" }]`.
fn off_size(r: &Reader, g: &BallGeometry, pair: bool) -> Vec<OffSize> {
    let most = 0.01 * g.ball_diameter;
    let read = |size: Reader| {
        let (ball, difference) = (&OFF_SIZE.ball, &OFF_SIZE.diameter_difference);
        if !size.has(ball) {
            size.missing(ball);
        }
        let out = OffSize {
            ball: size.count_up_to(ball, g.balls - 1).unwrap_or(0),
            diameter_difference: size.value(difference),
            row: defects::row(&size, pair),
        };
        if size.has_no_errors() && out.diameter_difference.abs() > most {
            let message = format!("{} is more than a hundredth of the ball diameter", size.name(difference));
            let problem = Problem::new(Kind::OutOfRange, &size.span_of(difference), message);
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
    r.tables(&IMPERFECTIONS.off_size).into_iter().map(read).collect()
}

/// `defect_law`, with `defect_stiffness` if it is a force law.
fn defect_law(r: &Reader) -> DefectLaw {
    let (law_key, stiffness) = (&DEFECT_LAW.defect_law, &DEFECT_LAW.defect_stiffness);
    let word = r.choice(law_key);
    let law = word.unwrap_or(law_key.default_word());
    let force = matches!(law, DefectLawKeyword::Force | DefectLawKeyword::ForceOnLoaded);
    let given = r.has(stiffness);
    if given && !force {
        // a misspelt law was already reported
        if word.is_some() || !r.has(law_key) {
            let message = format!("{} applies only to a force law", r.name(stiffness));
            let problem = Problem::new(Kind::Conflict, &r.span_of(stiffness), message);
            r.log.error(problem.expected("defect_law = \"force\" or \"force_on_loaded\""));
        }
    }
    let stiffness = (given && force).then(|| contact::power_law_stiffness(r, stiffness, 1.5));
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
    let conflict = |key: &dyn Declared, message: String, expected: &str| {
        let problem = Problem::new(Kind::Conflict, &r.span_of(key), message);
        r.log.error(problem.expected(expected).hint(
            "defect_law = \"displacement\" works with every bearing; the force law is from the literature",
        ));
    };
    let law = r.name(&DEFECT_LAW.defect_law);
    if bearing.inertia.is_on() {
        conflict(
            &BALL_INERTIA.ball_inertia,
            format!("{law} does not define on which contact of a ball with inertia the force acts"),
            "ball_inertia = \"none\"",
        );
    }
    if matches!(bearing.preload, Preload::Spring { .. }) {
        conflict(
            &MOUNTING.preload,
            format!("{law} has no potential energy, which the equilibrium of a spring preload needs"),
            "a rigid preload",
        );
    }
    if stiffness.is_none() && !bearing.contact.has_separate_contacts() {
        conflict(
            &DEFECT_LAW.defect_law,
            format!("{law} needs a Hertz stiffness, which a fitted power law does not have"),
            "defect_stiffness as well, such as \"1.58e10 N/m^1.5\"",
        );
    }
}
