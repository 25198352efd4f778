//! Unbalance, loads, damping, drive, speed profile and probes.

use super::increasing::check_increasing;
use super::measured_speed::{self, MeasuredKeys};
use super::places::{ANCHOR, AnchorKeys, Places};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Declared, Group, NamedTables, Quantities, Quantity, SubTable, Table, Text, Words, any, below,
    count, keys, named_tables, not_negative, positive, quantities, quantity, sub_table, text, words,
};
use crate::file::reader::Reader;
use crate::file::tree::Value;
use crate::{BandNoise, Damping, Drive, ExternalFile, Load, LoadFactor, Probe, SpeedProfile, Unbalance};
use rotordyn_core::element::Anchor;
use rotordyn_units::{
    ANGLE, FORCE, FREQUENCY, LENGTH, MASS, MOMENT, NUMBER, RATE, SPEED, TILT_DAMPING, TIME, UNBALANCE, names,
};

keys! {
    /// Tables of this file.
    pub(super) static TOP: TopKeys {
        unbalance: NamedTables = named_tables(UnbalanceKeys::TABLE);
        load: NamedTables = named_tables(&LOAD_TABLE);
        probe: NamedTables = named_tables(&PROBE_TABLE).computed("x and y of every disc and bearing");
        damping: SubTable = sub_table(DampingKeys::TABLE);
        drive: SubTable = sub_table(DriveKeys::TABLE);
        speed: SubTable = sub_table(&SPEED_TABLE);
    }
}

keys! {
    /// `[unbalance.x]`.
    static UNBALANCE_KEYS: UnbalanceKeys = "Unbalance at a station: a magnitude, a mass at a radius, or a balance grade." {
        station: Text = text("name of a station", "Where it sits.").example("\"A\"");
        magnitude: Quantity = quantity(not_negative(UNBALANCE), "Unbalance.").required("or mass, or grade");
        mass: Quantity = quantity(not_negative(MASS), "Mass at a radius.").required("or magnitude, or grade");
        radius: Quantity = quantity(positive(LENGTH), "Radius at which the mass is.").required("with mass").with("mass = \"5 g\"");
        grade: Text = text("a balance quality grade", "Permissible unbalance of ISO 21940-11 at a speed.")
            .required("or magnitude, or mass").example("\"G6.3\"");
        speed: Quantity = quantity(positive(SPEED), "Service speed, of any grade.").required("with grade")
            .with("grade = \"G6.3\"");
        rotor_mass: Quantity = quantity(positive(MASS), "Mass of the rotor, of any grade.")
            .computed("shaft and discs").with("grade = \"G6.3\"");
        phase: Quantity = quantity(any(ANGLE), "Position from +x towards +y at a shaft angle of zero.")
            .default("0 deg").example("\"90 deg\"");
    }
}

keys! {
    /// `[load.x]`.
    pub(super) static LOAD: LoadKeys {
        force: Quantities = quantities(any(FORCE), "three: x, y, z", "Force, constant, times factor or random.")
            .required("or moment").example("\"0, -100, 0 N\"");
        moment: Quantities = quantities(any(MOMENT), "three: about x, y, z", "Moment, constant, times factor or random.")
            .required("or force").example("\"0, 0, 12 N m\"");
        time: Quantities = quantities(any(TIME), "one or more, increasing",
            "Times of a load history, with straight lines between them; it is no part of the statics, a run starts without it.")
            .required("with factor").with("factor = [0, 1]").example("\"0, 0.1 s\"");
        factor: Quantities = quantities(any(NUMBER), "as many as time",
            "Factor of the load at these times; the first holds from the start of the run, the last to its end: 0 where there is no load.")
            .required("with time").with("time = \"0, 0.1 s\"").example("[0, 1]");
        band: Quantities = quantities(not_negative(FREQUENCY), "two, increasing", "A random load: flat spectrum from 5 % of the width inside these frequencies, -6 dB at them; force and moment: RMS.")
            .optional().example("\"5, 500 Hz\"");
        seed: Count = count([0, 999_999_999], "Random course of a load with a band: the same for equal seeds.")
            .computed("one of its own, from the load's name").with("band = \"5, 500 Hz\"");
    }
}

static LOAD_TABLE: Table = Table {
    meaning: "A force or moment in the axes of the model: constant, over time or random; constant loads act in statics.",
    groups: &[Group::always(AnchorKeys::LIST), Group::always(LoadKeys::LIST)],
};

keys! {
    /// `[damping]`.
    static DAMPING: DampingKeys = "Damping of the whole structure." {
        mass: Quantity = quantity(not_negative(RATE), "Rayleigh damping, factor of the mass matrix.")
            .default("0 1/s");
        stiffness: Quantity = quantity(not_negative(TIME), "Rayleigh damping, factor of the stiffness matrix.")
            .default("0 s").example("\"1e-5 s\"");
        modal: SubTable = sub_table(ModalDampingKeys::TABLE);
    }
}

keys! {
    /// `[damping.modal]`.
    static MODAL: ModalDampingKeys = "Damping ratios over frequency, linear between the points." {
        frequency: Quantities = quantities(not_negative(FREQUENCY), "one or more, increasing", "Frequencies.")
            .example("\"0, 200 Hz\"");
        ratio: Quantities = quantities(below(NUMBER, [0.0, 1.0]), "as many as frequency", "Damping ratios.")
            .example("[0.005, 0.01]");
    }
}

keys! {
    /// `[drive]`.
    pub(super) static DRIVE: DriveKeys = "How the shaft is driven." {
        kind: Words<bool> = words(&[("prescribed", false), ("torque", true)],
            "Speed as prescribed by [speed], or rotation as an unknown with a torque on the shaft.");
        station: Text = text("name of a station", "Where the drive acts.").required("with kind = \"torque\"")
            .example("\"A\"");
        speed: Quantities = quantities(any(SPEED), "one or more, increasing", "Speeds of the torque-speed characteristic.")
            .required("with kind = \"torque\"").with("kind = \"torque\"").example("\"0, 3000 rpm\"");
        torque: Quantities = quantities(any(MOMENT), "as many as speed", "Torques of the characteristic.")
            .required("with kind = \"torque\"").with("kind = \"torque\"").example("\"5, 0 N m\"");
        drag: Quantity = quantity(not_negative(TILT_DAMPING), "Viscous drag torque over speed of a torque drive.")
            .default("0 N m s/rad").with("kind = \"torque\"");
    }
}

static SPEED_TABLE: Table = Table {
    meaning: "Speed over time, of run-ups.",
    groups: &[
        Group::always(ProfileKeys::LIST),
        Group { condition: "profile = \"constant\"", keys: ConstantKeys::LIST },
        Group { condition: "profile = \"ramp\"", keys: RampKeys::LIST },
        Group { condition: "profile = \"s-curve\"", keys: RampKeys::LIST },
        Group { condition: "profile = \"table\"", keys: TabulatedKeys::LIST },
        Group { condition: "profile = \"coast-down\"", keys: CoastDownKeys::LIST },
        Group { condition: "profile = \"measured\"", keys: MeasuredKeys::LIST },
    ],
};

/// Keywords of the key `profile`.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Constant,
    Ramp,
    SCurve,
    Table,
    CoastDown,
    Measured,
}

keys! {
    /// Of every `[speed]`.
    static PROFILE: ProfileKeys {
        profile: Words<Shape> = words(&[
            ("constant", Shape::Constant), ("ramp", Shape::Ramp), ("s-curve", Shape::SCurve),
            ("table", Shape::Table), ("coast-down", Shape::CoastDown), ("measured", Shape::Measured),
        ], "Form of the speed over time; s-curve is a ramp without jumps of the acceleration.").example("\"ramp\"");
    }
}

keys! {
    /// Of constant speed.
    static CONSTANT: ConstantKeys {
        speed: Quantity = quantity(not_negative(SPEED), "Speed.");
        duration: Quantity = quantity(positive(TIME), "Duration.");
    }
}

keys! {
    /// Of a ramp.
    static RAMP: RampKeys {
        from: Quantity = quantity(not_negative(SPEED), "Speed at the start.").default("0 rpm");
        to: Quantity = quantity(not_negative(SPEED), "Speed at the end.");
        settle: Quantity = quantity(not_negative(TIME), "Time at the speed of the start, before the ramp.").default("0 s");
        ramp: Quantity = quantity(positive(TIME), "Duration of the ramp.");
        hold: Quantity = quantity(not_negative(TIME), "Time at the speed of the end, after the ramp.").default("0 s");
    }
}

keys! {
    /// Of speeds over time.
    static TABULATED: TabulatedKeys {
        time: Quantities = quantities(not_negative(TIME), "two or more, increasing", "Times.").example("\"0, 10 s\"");
        speed: Quantities = quantities(not_negative(SPEED), "as many as time", "Speeds at these times; between them a smooth curve (monotone cubic, PCHIP) without overshoot, not straight lines.")
            .example("\"0, 1200 rpm\"");
    }
}

keys! {
    /// Of a coast-down.
    static COAST_DOWN: CoastDownKeys {
        from: Quantity = quantity(not_negative(SPEED), "Speed at the start.");
        settle: Quantity = quantity(not_negative(TIME), "Time at this speed before the coast-down.").default("0 s");
        time_constant: Quantity = quantity(positive(TIME), "Time in which the speed falls to 1/e.");
        duration: Quantity = quantity(positive(TIME), "Duration.");
    }
}

static PROBE_TABLE: Table = Table {
    meaning: "A channel: motion of a point along a direction.",
    groups: &[
        Group::always(AnchorKeys::LIST),
        Group::always(DirectionKeys::LIST),
        Group::always(ProbeKeys::LIST),
    ],
};

keys! {
    /// Of an excitation or a probe.
    pub(super) static DIRECTION: DirectionKeys {
        direction: Text = text("x, y, z, or tx, ty, tz for a rotation, - for the opposite", "Direction by name.")
            .required("").example("\"x\"");
        components: Quantities = quantities(any(NUMBER), "three, or six with rotations", "Direction by components, scaled to unit translation, else to unit rotation; rotations in rad per metre of it.")
            .named("direction").required("").example("[1, 1, 0]");
    }
}

keys! {
    /// Of a probe.
    static PROBE: ProbeKeys {
        quantity: Words<crate::Quantity> = words(&QUANTITIES, "What is measured.").default("displacement");
    }
}

/// Unbalance by magnitude, by a mass at a radius, or by a balance quality grade of ISO 21940-11: U = m G/Ω, G
/// = e_per Ω.
pub(super) fn unbalances(top: &Reader, places: &Places, rotor_mass: f64) -> Vec<Unbalance> {
    let read = |(name, r): (&str, Reader)| {
        let (node, _) = places.station(&r, &UNBALANCE_KEYS.station);
        let keys = &UNBALANCE_KEYS;
        let magnitude = match r.one_of(&[&keys.magnitude, &keys.mass, &keys.grade]) {
            Some(given) if given.is(&keys.magnitude) => r.value(&keys.magnitude),
            Some(given) if given.is(&keys.mass) => r.value(&keys.mass) * r.value(&keys.radius),
            Some(_) => {
                let speed = r.value(&keys.speed);
                let mass = r.or(&keys.rotor_mass, rotor_mass);
                mass * balance_grade(&r) / speed
            }
            None => {
                r.missing_or(&keys.magnitude, ", or mass and radius, or grade and speed");
                1.0
            }
        };
        let phase = r.value(&keys.phase);
        r.finish();
        Unbalance { name: name.into(), node, magnitude, phase }
    };
    top.items(&TOP.unbalance).into_iter().map(read).collect()
}

/// Balance quality grade, "G6.3" \[m/s\].
fn balance_grade(r: &Reader) -> f64 {
    let number = |text: &str| text.trim().strip_prefix(['G', 'g'])?.trim().parse::<f64>().ok();
    let grade = &UNBALANCE_KEYS.grade;
    match r.text(grade).and_then(number) {
        Some(mm_per_s) if mm_per_s > 0.0 && mm_per_s.is_finite() => mm_per_s / 1e3,
        _ => {
            let message = format!("{} is not a balance quality grade", r.name(grade));
            let problem = Problem::new(Kind::BadQuantity, &r.span_of(grade), message);
            r.log.error(problem.expected("a grade of ISO 21940-11 such as \"G6.3\""));
            1.0
        }
    }
}

/// How a load goes over time: a table, a random course, or constant.
fn load_factor(name: &str, r: &Reader) -> LoadFactor {
    let over_time = r.has(&LOAD.time) || r.has(&LOAD.factor);
    if !r.has(&LOAD.band) {
        if r.has(&LOAD.seed) {
            r.missing(&LOAD.band);
        }
        if !over_time {
            return LoadFactor::Constant;
        }
        let (time, factor) = (r.need_list(&LOAD.time), r.need_list(&LOAD.factor));
        return LoadFactor::Table(table(r, (&LOAD.time, &time), (&LOAD.factor, &factor)));
    }
    if over_time {
        let message = format!("{} has a random course (band) and one over time (time, factor)", r.path);
        r.error(Kind::Conflict, &LOAD.band, message);
    }
    let seed = match r.has(&LOAD.seed) {
        true => r.count_or(&LOAD.seed, 0) as u64,
        // Beyond all seeds of files.
        false => 1 << 32 | u64::from(names::hash(name)),
    };
    let band = r.need_list(&LOAD.band);
    let noise = <[f64; 2]>::try_from(band).ok().and_then(|band| BandNoise::new(band, seed).ok());
    match noise {
        Some(noise) => LoadFactor::Random(noise),
        None => {
            if r.has_no_errors() {
                let message = format!("{} is no frequency band", r.name(&LOAD.band));
                let problem = Problem::new(Kind::BadQuantity, &r.span_of(&LOAD.band), message);
                r.log.error(problem.expected("a lower and a higher frequency, such as \"5, 500 Hz\""));
            }
            LoadFactor::Constant
        }
    }
}

pub(super) fn loads(top: &Reader, places: &Places) -> Vec<Load> {
    let read = |(name, r): (&str, Reader)| {
        let at = places.anchor(&r);
        if at.node.is_none() && r.has_no_errors() {
            let message = format!("{} acts on ground, where it has no effect", r.path);
            r.error(Kind::Conflict, &ANCHOR.at, message);
        }
        let force = r.vector(&LOAD.force);
        let moment = r.vector(&LOAD.moment);
        if force.is_none() && moment.is_none() && r.has_no_errors() {
            r.missing(&LOAD.force);
        }
        let (f, m) = (force.unwrap_or_default(), moment.unwrap_or_default());
        let factor = load_factor(name, &r);
        r.finish();
        Load { name: name.into(), at, force: [f[0], f[1], f[2], m[0], m[1], m[2]], factor }
    };
    top.items(&TOP.load).into_iter().map(read).collect()
}

/// Pairs from two lists of equal length, the first increasing.
fn table(
    r: &Reader,
    (x_key, x): (&dyn Declared, &[f64]),
    (y_key, y): (&dyn Declared, &[f64]),
) -> Vec<[f64; 2]> {
    if !r.has_no_errors() {
        return Vec::new();
    }
    if x.len() != y.len() {
        let (y_name, x_name) = (r.name(y_key), x_key.name());
        let message = format!("{y_name} has {} values, but `{x_name}` has {}", y.len(), x.len());
        r.error(Kind::Conflict, y_key, message);
    }
    check_increasing(r, x_key, x);
    x.iter().zip(y).map(|(&x, &y)| [x, y]).collect()
}

pub(super) fn damping(top: &Reader) -> Damping {
    let r = top.table_or_empty(&TOP.damping);
    let proportional = [r.value(&DAMPING.mass), r.value(&DAMPING.stiffness)];
    let modal = r.table(&DAMPING.modal).map_or_else(Vec::new, |m| {
        let (frequency, ratio) = (m.need_list(&MODAL.frequency), m.need_list(&MODAL.ratio));
        let modal = table(&m, (&MODAL.frequency, &frequency), (&MODAL.ratio, &ratio));
        m.finish();
        modal
    });
    r.finish();
    Damping { proportional, modal }
}

pub(super) fn drive(top: &Reader, places: &Places) -> Drive {
    let Some(r) = top.table(&TOP.drive) else { return Drive::Prescribed { node: None } };
    if !r.has(&DRIVE.kind) {
        r.missing_as(&DRIVE.kind, "\"prescribed\" or \"torque\"");
    }
    let drive = if r.word(&DRIVE.kind) {
        let (node, _) = places.station(&r, &DRIVE.station);
        let speed = r.need_list(&DRIVE.speed);
        let values = r.need_list(&DRIVE.torque);
        let drag = r.value(&DRIVE.drag);
        Drive::Torque { node, table: table(&r, (&DRIVE.speed, &speed), (&DRIVE.torque, &values)), drag }
    } else {
        Drive::Prescribed { node: r.has(&DRIVE.station).then(|| places.station(&r, &DRIVE.station).0) }
    };
    r.finish();
    drive
}

pub(super) fn profile(top: &Reader, files: &[ExternalFile]) -> SpeedProfile {
    let standstill = SpeedProfile::Constant { speed: 0.0, duration: 1.0 };
    let Some(r) = top.table(&TOP.speed) else { return standstill };
    if !r.has(&PROFILE.profile) {
        // Of a whole ramp what is not there yet, so that the next check does not ask for the rest.
        let rest: Vec<String> = [(&RAMP.to, "1200 rpm"), (&RAMP.ramp, "10 s")]
            .iter()
            .filter(|(key, _)| !r.has(*key))
            .map(|(key, value)| format!(", {} = \"{value}\"", key.name()))
            .collect();
        r.missing_as(&PROFILE.profile, &format!("\"ramp\"{}", rest.concat()));
    }
    let profile = match r.choice(&PROFILE.profile) {
        Some(Shape::Constant) => {
            SpeedProfile::Constant { speed: r.value(&CONSTANT.speed), duration: r.value(&CONSTANT.duration) }
        }
        Some(Shape::Ramp) => SpeedProfile::Ramp {
            from: r.value(&RAMP.from),
            to: r.value(&RAMP.to),
            settle: r.value(&RAMP.settle),
            ramp: r.value(&RAMP.ramp),
            hold: r.value(&RAMP.hold),
        },
        Some(Shape::SCurve) => SpeedProfile::SCurve {
            from: r.value(&RAMP.from),
            to: r.value(&RAMP.to),
            settle: r.value(&RAMP.settle),
            ramp: r.value(&RAMP.ramp),
            hold: r.value(&RAMP.hold),
        },
        Some(Shape::Table) => {
            let (time, speed) = (r.need_list(&TABULATED.time), r.need_list(&TABULATED.speed));
            if time.len() < 2 && r.has_no_errors() {
                r.error(Kind::WrongType, &TABULATED.time, "speed.time needs two values or more");
            }
            SpeedProfile::Table { points: table(&r, (&TABULATED.time, &time), (&TABULATED.speed, &speed)) }
        }
        Some(Shape::CoastDown) => SpeedProfile::CoastDown {
            from: r.value(&COAST_DOWN.from),
            settle: r.value(&COAST_DOWN.settle),
            time_constant: r.value(&COAST_DOWN.time_constant),
            duration: r.value(&COAST_DOWN.duration),
        },
        Some(Shape::Measured) => measured_speed::read(&r, files).unwrap_or(standstill),
        None => {
            r.entries();
            standstill
        }
    };
    r.finish();
    profile
}

pub(super) const QUANTITIES: [(&str, crate::Quantity); 3] = [
    ("displacement", crate::Quantity::Displacement),
    ("velocity", crate::Quantity::Velocity),
    ("acceleration", crate::Quantity::Acceleration),
];

pub(super) fn probes(top: &Reader, places: &Places) -> Vec<Probe> {
    let read = |(name, r): (&str, Reader)| {
        if name.contains(['/', '"']) || name.is_empty() {
            let problem =
                Problem::new(Kind::OutOfRange, &r.span, format!("`{name}` is not a valid channel name"));
            r.log.error(problem.expected("a name without / and quotes"));
        }
        let probe = Probe {
            name: name.into(),
            at: places.anchor(&r),
            direction: direction(&r),
            quantity: r.word(&PROBE.quantity),
        };
        r.finish();
        probe
    };
    top.items(&TOP.probe).into_iter().map(read).collect()
}

/// Direction by name ("x", "-y", "tz" for a rotation) or as components (3 or 6); normalised to unit
/// translation, or to unit rotation if there is no translation.
pub(super) fn direction(r: &Reader) -> [f64; 6] {
    let mut direction = [0.0; 6];
    match r.entry(&DIRECTION.direction).map(|e| &e.node.value) {
        None => r.missing_or(&DIRECTION.direction, " or [1, 1, 0]"),
        Some(Value::Text(text)) => {
            let (sign, axis) = text.strip_prefix('-').map_or((1.0, text.as_str()), |axis| (-1.0, axis));
            match ["x", "y", "z", "tx", "ty", "tz"].iter().position(|a| *a == axis) {
                Some(k) => direction[k] = sign,
                None => {
                    let message = format!("`{text}` is not a direction");
                    let problem = Problem::new(Kind::UnknownName, &r.span_of(&DIRECTION.direction), message);
                    r.log.error(
                        problem.expected(
                            "x, y, z, tx, ty or tz, with - for the opposite direction, or [1, 1, 0]",
                        ),
                    );
                }
            }
        }
        Some(_) => {
            let Some(values) = r.list(&DIRECTION.components) else { return direction };
            if !matches!(values.len(), 3 | 6) {
                let message = format!("{} has three or six components", r.name(&DIRECTION.direction));
                r.error(Kind::WrongType, &DIRECTION.direction, message);
                return direction;
            }
            let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            let scale = match (length(&values[..3]), length(&values)) {
                (translation, _) if translation > 0.0 => translation,
                (_, rotation) if rotation > 0.0 => rotation,
                _ => {
                    let message = format!("{} is zero", r.name(&DIRECTION.direction));
                    r.error(Kind::OutOfRange, &DIRECTION.direction, message);
                    1.0
                }
            };
            for (d, v) in direction.iter_mut().zip(&values) {
                *d = v / scale;
            }
        }
    }
    direction
}

/// Anchor and direction of an excitation, such as a hammer impact.
pub(super) fn anchor_and_direction(r: &Reader, places: &Places) -> (Anchor, [f64; 6]) {
    (places.anchor(r), direction(r))
}
