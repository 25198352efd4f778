//! Ball bearings whose balls and cage are free bodies, `model = "free_ball"`.

use super::ball_inertia;
use super::ball_keys::{self, BALL};
use super::contact::{self, BALL_CONTACT};
use super::free_cage;
use super::imperfections;
use super::lubricants;
use super::mounting::{self, PAIR};
use crate::file::diagnostic::{Kind, Problem};
use crate::file::key::{
    Count, Declared, Flag, Quantity, SubTable, Words, count, flag, keys, not_negative, positive, quantity,
    sub_table, words,
};
use crate::file::reader::Reader;
use rotordyn_bearing::BallBearing;
use rotordyn_bearing::contact::{ContactDamping, Lubricant, Traction};
use rotordyn_bearing::free_ball::{Drag, FilmShear, FreeBallBearing, FrictionLaw, SlipModel, TractionCurve};
use rotordyn_core::element::Material;
use rotordyn_units::{DENSITY, INVERSE_SPEED, NUMBER, PRESSURE, TILT_DAMPING, VELOCITY};

/// Kinds of friction law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FrictionKeyword {
    Coulomb,
    Curve,
    Film,
}

keys! {
    /// Of `model = "free_ball"` only.
    pub(super) static FREE_BALL: FreeBallKeys {
        friction_law: Words<FrictionKeyword> = words(&[
            ("coulomb", FrictionKeyword::Coulomb),
            ("curve", FrictionKeyword::Curve),
            ("film", FrictionKeyword::Film),
        ], "Friction of balls and races: Coulomb regularised at a slip speed, a traction curve, or the shear of the oil film.")
            .default("coulomb");
        friction: Quantity = quantity(not_negative(NUMBER), "Coefficient of friction of balls and races; with film the limit of its shear stress over pressure.")
            .default("0.06");
        slip_speed: Quantity = quantity(positive(VELOCITY), "Slip up to which friction is proportional to slip; the time step shrinks with it.")
            .default("20 mm/s");
        traction_curve: SubTable = sub_table(TractionCurveKeys::TABLE).required("with friction_law = \"curve\"")
            .with("friction_law = \"curve\"");
        eyring_stress: Quantity = quantity(positive(PRESSURE), "Shear stress above which the film is no longer Newtonian.")
            .default("5 MPa").with("friction_law = \"film\"\nlubricant = \"oil\"");
        slip: Words<bool> = words(&[("ellipse", true), ("centre", false)],
            "Slip over the contact ellipse, with spin and conformity, or at its centre, which costs less.")
            .default("ellipse");
        slip_points_along: Count = count([1, 64], "Points along rolling in a contact ellipse.").default("4");
        slip_points_across: Count = count([1, 64], "Points across rolling in a contact ellipse.").default("12");
        hunt_crossley: Quantity = quantity(not_negative(INVERSE_SPEED), "Damping by Hunt and Crossley of each contact of ball and race.")
            .default("1 s/m");
        rolling_loss: Quantity = quantity(not_negative(NUMBER), "Hysteresis loss factor of rolling resistance.")
            .default("0.007");
        full_complement: Flag = flag("Whether there is no cage and the balls touch each other.").default("false");
        drag: SubTable = sub_table(DragKeys::TABLE);
    }
}

keys! {
    /// `traction_curve = { ... }`.
    static TRACTION_CURVE: TractionCurveKeys = "Friction over slip v, mu = D (1 - exp(-C v)) + B v exp(-C v) (Gupta 1984)." {
        limit: Quantity = quantity(positive(NUMBER), "D, at large slip.").example("0.05");
        slope: Quantity = quantity(not_negative(INVERSE_SPEED), "B, of the maximum above D.").default("0 s/m");
        decay: Quantity = quantity(positive(INVERSE_SPEED), "C, how fast D is reached.").example("\"50 s/m\"");
    }
}

keys! {
    /// `drag = { ... }`.
    static DRAG: DragKeys = "Resistance of the lubricant around balls and cage, at rest with the outer ring." {
        density: Quantity = quantity(not_negative(DENSITY), "Density of the mixture of oil and air.").default("0 kg/m^3");
        ball_force: Quantity = quantity(not_negative(NUMBER), "Drag coefficient of a moving ball.").default("1.25");
        ball_moment: Quantity = quantity(not_negative(NUMBER), "Moment coefficient of a turning ball.").default("0.1");
        cage_moment: Quantity = quantity(not_negative(TILT_DAMPING), "Moment on the cage over its speed.")
            .default("0 N m s/rad");
    }
}

const EXACT_HINT: &str = "the contacts are dry Hertzian ones; a film acts by friction_law = \"film\"";
const DAMPING_HINT: &str = "use hunt_crossley = \"1 s/m\"";

/// Keys of `model = "ball"` that do not apply here, with a hint for each.
const INAPPLICABLE_KEYS: [(&dyn Declared, &str); 5] = [
    (&BALL_CONTACT.contact, EXACT_HINT),
    (&BALL_CONTACT.contact_damping, DAMPING_HINT),
    (&BALL_CONTACT.damping_ramp, DAMPING_HINT),
    (&BALL_CONTACT.film_damping, DAMPING_HINT),
    (&PAIR.arrangement, "a bearing with free balls has one row: add a second bearing"),
];

/// Reads a bearing of this model; gravity in \[m/s²\].
pub(super) fn read(
    r: &Reader,
    materials: &[Material],
    lubricants: &[Lubricant],
    gravity: [f64; 3],
) -> FreeBallBearing {
    for (key, hint) in INAPPLICABLE_KEYS.iter().filter(|(key, _)| r.has(*key)) {
        let message = format!("{} does not belong to model = \"free_ball\"", r.name(*key));
        r.log.error(Problem::new(Kind::Conflict, &r.span_of(*key), message).hint(*hint));
    }
    let ball = ball(r, materials, lubricants);
    let cage = free_cage::read(r, &ball, materials, !r.flag(&FREE_BALL.full_complement));
    let slip_speed = r.value(&FREE_BALL.slip_speed);
    let [along, across] =
        [&FREE_BALL.slip_points_along, &FREE_BALL.slip_points_across].map(|key| r.count(key));
    let over_ellipse = r.word(&FREE_BALL.slip);
    for key in [&FREE_BALL.slip_points_along, &FREE_BALL.slip_points_across] {
        if r.has(key) && !over_ellipse {
            r.error(Kind::Conflict, key, format!("{} belongs to slip = \"ellipse\"", r.name(key)));
        }
    }
    let out = FreeBallBearing {
        friction: friction(r, lubricants, slip_speed),
        slip: if over_ellipse { SlipModel::Ellipse { along, across } } else { SlipModel::Centre },
        damping: r.value(&FREE_BALL.hunt_crossley),
        rolling_loss: r.value(&FREE_BALL.rolling_loss),
        ball_friction: Traction { friction: r.value(&FREE_BALL.friction), slip_speed },
        drag: drag(r),
        gravity,
        cage,
        ball,
    };
    if r.has_no_errors() {
        ball_keys::check_geometry(r, &out.ball);
    }
    if r.has_no_errors() && out.ball.ball_material.density <= 0.0 {
        let key = if r.has(&BALL.ball_material) { &BALL.ball_material } else { &BALL.material };
        let message = format!("the balls of {} have no mass", r.path);
        r.log.error(Problem::new(Kind::OutOfRange, &r.span_of(key), message).expected("a density above 0"));
    }
    if r.has_no_errors() {
        for why in out.problems() {
            r.log.error(Problem::new(Kind::Conflict, &r.span, format!("{}: {why}", r.path)));
        }
    }
    out
}

/// Geometry, materials, preload and fit as of a ball bearing; its damping is that of two contacts in series.
fn ball(r: &Reader, materials: &[Material], lubricants: &[Lubricant]) -> BallBearing {
    let entry = ball_keys::designation(r);
    let mut bearing = ball_keys::common_properties(r, materials, entry.as_ref(), None);
    bearing.service = contact::service(r, lubricants);
    bearing.inertia = ball_inertia::read(r);
    bearing.preload = mounting::preload(r);
    bearing.fit = mounting::fit(r, &bearing.geometry);
    // Each contact has half of the approach.
    bearing.damping = ContactDamping::HuntCrossley { factor: 0.5 * r.value(&FREE_BALL.hunt_crossley) };
    imperfections::check_force_law(r, &bearing);
    bearing
}

fn friction(r: &Reader, lubricants: &[Lubricant], slip_speed: f64) -> FrictionLaw {
    let keyword = r.word(&FREE_BALL.friction_law);
    let coefficient = r.value(&FREE_BALL.friction);
    let foreign = |key: &dyn Declared, owner: FrictionKeyword, word: &str| {
        if r.has(key) && keyword != owner {
            r.error(Kind::Conflict, key, format!("{} belongs to friction_law = \"{word}\"", r.name(key)));
        }
    };
    foreign(&FREE_BALL.traction_curve, FrictionKeyword::Curve, "curve");
    foreign(&FREE_BALL.eyring_stress, FrictionKeyword::Film, "film");
    let coulomb = FrictionLaw::Coulomb(Traction { friction: coefficient, slip_speed });
    match keyword {
        FrictionKeyword::Coulomb => coulomb,
        FrictionKeyword::Curve => {
            let Some(curve) = r.table(&FREE_BALL.traction_curve) else {
                if !r.has(&FREE_BALL.traction_curve) {
                    r.missing_as(&FREE_BALL.traction_curve, "{ limit = 0.05, decay = \"50 s/m\" }");
                }
                return coulomb;
            };
            let keys = &TRACTION_CURVE;
            let [limit, slope, decay] = [&keys.limit, &keys.slope, &keys.decay].map(|key| curve.value(key));
            curve.finish();
            FrictionLaw::Curve(TractionCurve { limit, slope, decay })
        }
        FrictionKeyword::Film => {
            let span = r.span_of(&FREE_BALL.friction_law);
            let Some(lubricant) = lubricants::of_bearing(r, lubricants, &span) else { return coulomb };
            let eyring_stress = r.value(&FREE_BALL.eyring_stress);
            FrictionLaw::Film(FilmShear { lubricant, eyring_stress, limit: coefficient, slip_speed })
        }
    }
}

fn drag(r: &Reader) -> Drag {
    let Some(table) = r.table(&FREE_BALL.drag) else { return Drag::default() };
    let keys = &DRAG;
    let out = Drag {
        density: table.value(&keys.density),
        ball_force: table.value(&keys.ball_force),
        ball_moment: table.value(&keys.ball_moment),
        cage_moment: table.value(&keys.cage_moment),
    };
    table.finish();
    out
}
