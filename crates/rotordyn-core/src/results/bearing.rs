//! Results of a study of single ball bearings.

use super::free_ball::{FreeBallResult, SkiddingMap};
use crate::analysis::ball_inertia::InertiaUse;
use crate::analysis::bearing_stiffness::BearingEquilibrium;
use crate::analysis::preload::MountedPreload;
use crate::document::{Array, Column, Document, MissingCell, Rows, Section, in_hdf5, in_json, named};
use crate::model::study::SweepVariable;
use crate::warning::Warning;
use rotordyn_bearing::contact::Race;
use rotordyn_bearing::contact::ehl::Solution;
use rotordyn_bearing::rating::LoadRating;
use rotordyn_bearing::rating::shoulder::shoulder_angle;
use rotordyn_bearing::{
    Arrangement, BallBearing, BallMotion, CharacteristicOrders, FrictionTorque, LimitCheck, MountedGeometry,
    PreloadState, ShoulderMargin,
};
use serde::{Deserialize, Serialize};

/// Results of one ball bearing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingResult {
    pub name: String,
    pub bearing: BallBearing,
    /// Description of the operating load's source.
    pub load_source: String,
    /// Motions u_x u_y u_z θ_x θ_y with prescribed displacement.
    pub prescribed: [bool; 5],
    /// Preload of the centred bearing at the operating speed.
    pub preload: PreloadState,
    /// Axial force of its preload in the machine at the operating point; `None` without preload or machine.
    pub mounted_preload: Option<MountedPreload>,
    /// Ball inertia used, and why.
    pub ball_inertia: InertiaUse,
    /// Ratings of all rows together.
    pub rating: LoadRating,
    /// Orders at the nominal contact angle.
    pub nominal_orders: CharacteristicOrders,
    /// The operating point.
    pub point: BearingPoint,
    /// The limits that apply at the operating point, exceeded or not.
    pub limits: Vec<LimitCheck>,
    pub sweeps: Vec<BearingSweepResult>,
    /// EHL solutions of the most heavily loaded contacts, for a bearing with the EHL contact law.
    pub films: Vec<EhlFilm>,
    /// The bearing with free balls and cage under the same force; `None` for other bearings.
    pub free_balls: Option<FreeBallResult>,
    /// Its cage slip over load and speed, if asked for.
    pub skidding: Option<SkiddingMap>,
    pub warnings: Vec<Warning>,
}

impl BearingResult {
    /// What is written to files.
    pub fn section(&self) -> Section<'_> {
        Section::listed("bearings", format!("bearings/{}", self.name), self.document())
    }

    fn document(&self) -> Document<'_> {
        let (rating, orders) = (&self.rating, &self.nominal_orders);
        let rating = Document::new()
            .number(named("dynamic", "dynamic_rating"), "N", rating.dynamic)
            .number(named("static", "static_rating"), "N", rating.static_rating)
            .number(named("fatigue", "fatigue_limit"), "N", rating.fatigue);
        let preload = Document::new()
            .number(named("offset", "preload_offset"), "m", self.preload.offset)
            .number(named("axial_force", "preload_force"), "N", self.preload.axial_force);
        let inertia = Document::new()
            .text(in_json("bearing"), &self.ball_inertia.bearing)
            .and(self.ball_inertia.document());
        let mut out = Document::new()
            .text(in_json("name"), &self.name)
            .text("load_source", &self.load_source)
            .group("geometry", geometry_document(&self.bearing))
            .group("ball_inertia", inertia)
            .table(in_json("prescribed"), Rows::of(&self.prescribed).flag("", |prescribed| *prescribed))
            .group(named("rating", ""), rating)
            .group(named("preload", ""), preload)
            .group(named("nominal_orders", ""), orders_document(orders))
            .record("operating", BearingPoint::columns(Rows::of([&self.point])))
            .table("limits", limit_columns(&self.limits))
            .list("sweeps", self.sweeps.iter().map(BearingSweepResult::document))
            .list("films", self.films.iter().map(|film| film.document()))
            .with(in_json("warnings"), Warning::list(&self.warnings));
        for sweep in &self.sweeps {
            out = out.group(in_hdf5(format!("sweep_{}", sweep.of.name())), sweep.document());
        }
        for film in &self.films {
            out = out.group(in_hdf5(format!("film_{}", film.race)), film.document());
        }
        // What a bearing does not have is omitted.
        if let Some(mounted) = &self.mounted_preload {
            let content = Document::new().text("bearing", &mounted.bearing).and(mounted.document());
            out = out.group(in_json("mounted_preload"), content).numbers(
                in_hdf5("mounted_preload"),
                "N",
                &mounted.rows,
            );
        }
        if let Some(free) = &self.free_balls {
            out = out.group("free_balls", free.document());
        }
        if let Some(map) = &self.skidding {
            out = out.group("skidding_map", map.document());
        }
        out.and_if(self.bearing.estimated_geometry.as_ref(), |out, how| out.text("estimated_geometry", how))
    }
}

/// What is written of the internal geometry, as it was understood.
fn geometry_document(bearing: &BallBearing) -> Document<'_> {
    let g = &bearing.geometry;
    let out = Document::new()
        .integer("balls", g.balls)
        .number("ball_diameter", "m", g.ball_diameter)
        .number("pitch_diameter", "m", g.pitch_diameter)
        .number("inner_groove_radius", "m", g.inner_groove_radius)
        .number("outer_groove_radius", "m", g.outer_groove_radius)
        .number("radial_clearance", "m", g.radial_clearance)
        .number("contact_angle", "rad", g.contact_angle)
        .number("bore", "m", g.bore)
        .number("outside_diameter", "m", g.outside_diameter)
        .number("width", "m", g.width)
        .number("inner_shoulder_angle", "rad", shoulder_angle(bearing, Race::Inner))
        .number("outer_shoulder_angle", "rad", shoulder_angle(bearing, Race::Outer));
    out.and_if(bearing.duplex, |out, pair| {
        let arrangement = match pair.arrangement {
            Arrangement::BackToBack => "back to back",
            Arrangement::FaceToFace => "face to face",
            Arrangement::Tandem => "tandem",
        };
        out.text("arrangement", arrangement).number("row_spacing", "m", pair.spacing)
    })
}

/// The limits with their figures, one row each.
fn limit_columns(limits: &[LimitCheck]) -> Rows<'static, '_, LimitCheck> {
    Rows::of(limits)
        .text("quantity", |l| &l.quantity)
        .number("value", "", |l| l.value)
        .number("limit", "", |l| l.limit)
        .text("side", |l| if l.is_least { "at least" } else { "at most" })
        .text("unit", |l| &l.unit)
        .text("state", |l| l.state.name())
        .text("says", |l| &l.says)
}

/// What is written of characteristic orders.
pub(super) fn orders_document<'a>(orders: &CharacteristicOrders) -> Document<'a> {
    Document::new()
        .number("ftf", "1/revolution", orders.ftf)
        .number("bpfo", "1/revolution", orders.bpfo)
        .number("bpfi", "1/revolution", orders.bpfi)
        .number("bsf", "1/revolution", orders.bsf)
}

/// EHL (elastohydrodynamic) solution of one contact: pressure and film thickness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EhlFilm {
    /// "inner" or "outer".
    pub race: String,
    /// Load \[N\] and entrainment speed \[m/s\].
    pub load: f64,
    pub speed: f64,
    pub solution: Solution,
}

impl EhlFilm {
    fn document(&self) -> Document<'_> {
        let s = &self.solution;
        let map = |unit, data| Array::real(&[s.x.len(), s.y.len()], unit, data).over(0, "x").over(1, "y");
        Document::new()
            .text(in_json("race"), &self.race)
            .number("load", "N", self.load)
            .number("entrainment_speed", "m/s", self.speed)
            .number("central_film", "m", s.central_film)
            .number("minimum_film", "m", s.minimum_film)
            .number("approach", "m", s.approach)
            .number("rolling_force", "N", s.rolling_force)
            .numbers(in_hdf5("x"), "m", &s.x)
            .numbers(in_hdf5("y"), "m", &s.y)
            .array(in_hdf5("pressure"), map("Pa", &s.pressure))
            .array(in_hdf5("film"), map("m", &s.film))
    }
}

/// One of a ball's two contacts.
pub type PickContact = fn(&BallState) -> &ContactState;

/// A bearing under one load at one speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingPoint {
    pub state: BearingEquilibrium,
    pub balls: Vec<BallState>,
    /// Stiffness along the radial load and along the axis \[N/m\]: with the other motions free unless
    /// prescribed, and with all other motions constrained.
    pub radial_stiffness: [f64; 2],
    pub axial_stiffness: [f64; 2],
    /// Orders at the load-weighted mean contact angle.
    pub orders: CharacteristicOrders,
    /// Axial force of the centred bearing at this speed \[N\], its operating preload.
    pub preload_force: f64,
    pub life: BearingLife,
    /// Smallest film over the composite roughness; 0 without film, infinite without load.
    pub film_ratio: f64,
    /// Friction torque, and the power lost by it.
    pub friction: FrictionTorque,
    /// Clearance and free contact angle as mounted, at this speed.
    pub mounted: MountedGeometry,
}

/// Rating lives \[10⁶ revolutions\], at 90 % reliability except the modified life; NaN where the standard
/// defines none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingLife {
    /// Dynamic equivalent load P = X F_r + Y F_a \[N\] (ISO 281).
    pub equivalent_load: f64,
    /// X, Y and the limit e of F_a/F_r.
    pub factors: [f64; 3],
    /// Basic rating life L₁₀ = (C/P)³.
    pub basic: f64,
    /// Static equivalent load P₀ \[N\] and static safety factor s₀ = C₀/P₀ (ISO 76).
    pub static_load: f64,
    pub static_safety: f64,
    /// Basic reference rating life L₁₀ᵣ with the load distribution of ISO/TS 16281: rigid rings, massless balls, dry
    /// contacts, moment arm D_pw/2.
    pub reference: f64,
    /// Dynamic equivalent reference load P_ref = C/L₁₀ᵣ^{1/3} \[N\].
    pub reference_load: f64,
    /// The same life from the ball loads of the bearing in equilibrium: ball inertia, film, imperfections, moment
    /// arm to the groove centres.
    pub by_ball_loads: f64,
    /// Required kinematic viscosity ν₁ \[m²/s\] and viscosity ratio κ = ν/ν₁; none without a lubricant.
    pub reference_viscosity: f64,
    pub viscosity_ratio: f64,
    /// Contamination factor e_C and life modification factor a_ISO(κ, e_C C_u/P_ref); none for κ < 0.1.
    pub contamination: f64,
    pub modification: f64,
    /// L_nmr = a₁ a_ISO L₁₀ᵣ.
    pub modified: f64,
}

/// One ball with its two contacts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BallState {
    /// Row of a matched pair, 0 or 1; 0 in a single row.
    pub row: usize,
    /// ψ_j \[rad\] from +x towards +y.
    pub position: f64,
    pub inner: ContactState,
    pub outer: ContactState,
    /// Orbital motion, spin axis and sliding.
    pub motion: BallMotion,
    /// Advance of the ball against its place in the cage \[rad\].
    pub advance: f64,
}

impl BallState {
    /// Every value of the ball's motion with its name in files.
    pub const COLUMNS: [Column<Self>; 8] = [
        ("orbital_speed", "rad/s", |b| b.motion.orbital_speed),
        ("ball_speed", "rad/s", |b| b.motion.ball_speed),
        ("ball_velocity_axial", "rad/s", |b| b.motion.ball_velocity[0]),
        ("ball_velocity_radial", "rad/s", |b| b.motion.ball_velocity[1]),
        ("pitch_angle", "rad", |b| b.motion.pitch_angle),
        ("race_control_ratio", "1", |b| b.motion.control_ratio),
        // 0 inner, 1 outer race; none without load.
        ("controlling_race", "1", |b| match b.motion.control {
            Some(Race::Inner) => 0.0,
            Some(Race::Outer) => 1.0,
            None => f64::NAN,
        }),
        ("ball_advance", "rad", |b| b.advance),
    ];

    fn columns<'a, 'r>(rows: Rows<'a, 'r, Self>) -> Rows<'a, 'r, Self> {
        rows.integer("row", |b| b.row)
            .number("position", "rad", |b| b.position)
            .columns(&Self::COLUMNS, MissingCell::Omitted)
            .group("inner", |b| &b.inner, ContactState::columns)
            .group("outer", |b| &b.outer, ContactState::columns)
    }
}

/// One contact of a ball.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ContactState {
    /// Q \[N\].
    pub load: f64,
    /// Contact angle α \[rad\].
    pub angle: f64,
    /// Semi-axes of the ellipse a, b \[m\], a across the rolling direction.
    pub semi_major: f64,
    pub semi_minor: f64,
    /// p₀ \[Pa\].
    pub pressure: f64,
    /// Central and minimum film thickness \[m\]; 0 where dry or unloaded.
    pub film: f64,
    pub minimum_film: f64,
    /// Spin speed about the contact normal \[rad/s\], its ratio to the rolling speed, and the friction moment of
    /// spinning \[N m\].
    pub spin: f64,
    pub spin_to_roll: f64,
    pub spin_moment: f64,
    /// Largest pressure times sliding speed \[W/m²\].
    pub pressure_velocity: f64,
    /// Contact ellipse and shoulder of the groove.
    pub shoulder: ShoulderMargin,
}

impl ContactState {
    /// Every value with its name in files.
    pub const COLUMNS: [Column<Self>; 15] = [
        ("load", "N", |c| c.load),
        ("contact_angle", "rad", |c| c.angle),
        ("semi_major", "m", |c| c.semi_major),
        ("semi_minor", "m", |c| c.semi_minor),
        ("pressure", "Pa", |c| c.pressure),
        ("film", "m", |c| c.film),
        ("minimum_film", "m", |c| c.minimum_film),
        ("spin_speed", "rad/s", |c| c.spin),
        ("spin_to_roll", "1", |c| c.spin_to_roll),
        ("spin_moment", "N m", |c| c.spin_moment),
        ("pressure_velocity", "W/m2", |c| c.pressure_velocity),
        ("ellipse_edge_angle", "rad", |c| c.shoulder.ellipse_angle),
        ("shoulder_angle", "rad", |c| c.shoulder.shoulder_angle),
        ("shoulder_distance", "m", |c| c.shoulder.arc),
        ("fraction_beyond_shoulder", "1", |c| c.shoulder.fraction_beyond),
    ];

    fn columns<'a, 'r>(rows: Rows<'a, 'r, Self>) -> Rows<'a, 'r, Self> {
        rows.columns(&Self::COLUMNS, MissingCell::Numbers)
    }
}

impl BearingPoint {
    /// Every scalar with its name in files.
    pub const COLUMNS: [Column<Self>; 42] = [
        ("speed", "rad/s", |p| p.state.condition.speed),
        ("cage_angle", "rad", |p| p.state.condition.cage_angle),
        ("radial_stiffness", "N/m", |p| p.radial_stiffness[0]),
        ("radial_stiffness_constrained", "N/m", |p| p.radial_stiffness[1]),
        ("axial_stiffness", "N/m", |p| p.axial_stiffness[0]),
        ("axial_stiffness_constrained", "N/m", |p| p.axial_stiffness[1]),
        ("loaded_balls", "1", |p| p.loaded() as f64),
        ("largest_ball_load", "N", Self::largest_load),
        ("largest_pressure", "Pa", Self::largest_pressure),
        ("minimum_film", "m", |p| if p.has_film() { p.minimum_film() } else { f64::NAN }),
        ("film_ratio", "1", |p| if p.has_film() { p.film_ratio } else { f64::NAN }),
        ("preload_force", "N", |p| p.preload_force),
        ("equivalent_load", "N", |p| p.life.equivalent_load),
        ("radial_factor_x", "1", |p| p.life.factors[0]),
        ("axial_factor_y", "1", |p| p.life.factors[1]),
        ("load_ratio_limit_e", "1", |p| p.life.factors[2]),
        ("basic_life", "1e6 revolutions", |p| p.life.basic),
        ("static_equivalent_load", "N", |p| p.life.static_load),
        ("static_safety", "1", |p| p.life.static_safety),
        ("reference_life", "1e6 revolutions", |p| p.life.reference),
        ("reference_load", "N", |p| p.life.reference_load),
        ("life_by_ball_loads", "1e6 revolutions", |p| p.life.by_ball_loads),
        ("reference_viscosity", "m2/s", |p| p.life.reference_viscosity),
        ("viscosity_ratio", "1", |p| p.life.viscosity_ratio),
        ("contamination", "1", |p| p.life.contamination),
        ("life_modification", "1", |p| p.life.modification),
        ("modified_life", "1e6 revolutions", |p| p.life.modified),
        ("ftf", "1/revolution", |p| p.orders.ftf),
        ("bpfo", "1/revolution", |p| p.orders.bpfo),
        ("bpfi", "1/revolution", |p| p.orders.bpfi),
        ("bsf", "1/revolution", |p| p.orders.bsf),
        ("friction_torque", "N m", |p| p.friction.total()),
        ("friction_torque_load", "N m", |p| p.friction.load),
        ("friction_torque_viscous", "N m", |p| p.friction.viscous),
        ("friction_torque_spin", "N m", |p| p.friction.spin),
        ("friction_heat", "W", |p| p.friction.heat),
        ("friction_load_factor", "1", |p| p.friction.load_factor),
        ("friction_viscous_factor", "1", |p| p.friction.viscous_factor),
        ("sliding_friction", "1", |p| p.friction.sliding_friction),
        ("mounted_radial_clearance", "m", |p| p.mounted.radial_clearance),
        ("mounted_axial_clearance", "m", |p| p.mounted.axial_clearance),
        ("free_contact_angle", "rad", |p| p.mounted.free_contact_angle),
    ];

    /// Quantities for which a standard gives no value (NaN) are omitted in JSON.
    fn columns<'a, 'r>(rows: Rows<'a, 'r, Self>) -> Rows<'a, 'r, Self> {
        rows.numbers("load", "N, N m", &[5], |p| &p.state.load)
            .numbers("displacement", "m, rad", &[5], |p| &p.state.displacement)
            .numbers("stiffness", "N/m, N, N m/rad", &[5, 5], |p| p.state.stiffness.as_flattened())
            .columns(&Self::COLUMNS, MissingCell::Omitted)
            .nested("balls", |p| &p.balls, BallState::columns)
    }

    /// Largest load of a contact \[N\].
    pub fn largest_load(&self) -> f64 {
        self.contacts().map(|c| c.load).fold(0.0, f64::max)
    }

    /// Largest pressure \[Pa\].
    pub fn largest_pressure(&self) -> f64 {
        self.contacts().map(|c| c.pressure).fold(0.0, f64::max)
    }

    /// Smallest film thickness of a loaded contact \[m\]; 0 without film.
    pub fn minimum_film(&self) -> f64 {
        let films = self.contacts().filter(|c| c.load > 0.0).map(|c| c.minimum_film);
        films.reduce(f64::min).unwrap_or(0.0)
    }

    /// Whether films are known: with a lubricant, whose film is 0 at standstill, or a film of the contact law.
    pub fn has_film(&self) -> bool {
        !self.friction.viscous_factor.is_nan() || self.minimum_film() > 0.0
    }

    /// Names and units of the single values of a point.
    pub fn units() -> impl Iterator<Item = (&'static str, &'static str)> {
        Self::COLUMNS.iter().map(|(name, unit, _)| (*name, *unit))
    }

    pub fn contacts(&self) -> impl Iterator<Item = &ContactState> {
        self.balls.iter().flat_map(|ball| [&ball.inner, &ball.outer])
    }

    /// Number of balls that carry load between the rings.
    pub fn loaded(&self) -> usize {
        self.balls.iter().filter(|ball| ball.inner.load > 0.0).count()
    }

    /// Number of balls that centrifugal force alone holds on the outer race.
    pub fn held_by_centrifugal_force(&self) -> usize {
        self.balls.iter().filter(|ball| ball.inner.load <= 0.0 && ball.outer.load > 0.0).count()
    }
}

/// One sweep: the varied quantity, and the bearing at every value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BearingSweepResult {
    pub of: SweepVariable,
    /// Name of the varied quantity, such as "load along the operating load", and its SI unit.
    pub label: String,
    pub unit: String,
    /// Values with an equilibrium.
    pub values: Vec<f64>,
    pub points: Vec<BearingPoint>,
}

impl BearingSweepResult {
    fn document(&self) -> Document<'_> {
        Document::new()
            .text(in_json("variable"), self.of.name())
            .text("label", &self.label)
            .text(in_json("unit"), &self.unit)
            .numbers(named("values", "swept_value"), &self.unit, &self.values)
            .table(named("points", ""), BearingPoint::columns(Rows::of(&self.points)).over("swept_value"))
    }
}
