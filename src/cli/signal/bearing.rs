//! Bearing of the diagnosis: from the catalogue, from a model, or by its defect frequencies (orders).

use std::path::Path;

use rotordyn::bearing::{BallGeometry, CharacteristicOrders};
use rotordyn::io::hdf5::open_reader;
use rotordyn::model::catalogue;
use rotordyn::names::nearest;
use rotordyn::results::{BearingWithOrders, SignalResult};
use rotordyn::signal::bearing_lines::BearingPart;
use rotordyn::warning::Code;

use super::super::args::ModelArgs;
use super::super::catalogue::geometry as catalogue_geometry;
use super::super::failure::Failure;
use super::super::limits::limits;
use super::super::machine::ModelSource;
use super::super::settings::Settings;
use super::super::store::stored_origin;
use super::args::DiagnosisArgs;
use super::input::InputProblems;

/// The bearing given by the flags; `run`: the results file of a stored run, whose model may have it.
pub fn find(
    args: &DiagnosisArgs,
    run: Option<&Path>,
    findings: &mut InputProblems,
) -> Result<Option<BearingWithOrders>, Failure> {
    if !args.bearing_orders.is_empty() {
        return Ok(from_orders(&args.bearing_orders, findings));
    }
    let Some(name) = &args.bearing else { return Ok(None) };
    let origin = match &args.model {
        Some(model) => {
            let model = ModelArgs { model: model.clone(), variant: None, set: Vec::new() };
            Some(ModelSource::read(&model)?)
        }
        None => run.map(model_of_run).transpose()?.flatten(),
    };
    let of_model = match &origin {
        Some(origin) => origin.load_bearings(&Settings::default())?.bearings,
        None => Vec::new(),
    };
    if let Some((_, ball)) = of_model.iter().find(|(known, _)| known == name) {
        let from = origin.map_or_else(String::new, |o| o.name);
        return Ok(Some(of_geometry(name, from, &ball.geometry)));
    }
    if let Some(entry) = catalogue::find(name) {
        let source = if entry.estimated { "catalogue, estimated internal geometry" } else { "catalogue" };
        return Ok(Some(of_geometry(entry.designation, source.into(), &catalogue_geometry(&entry))));
    }
    let designations: Vec<&str> = catalogue::entries().map(|e| e.designation).collect();
    let known = of_model.iter().map(|(name, _)| name.as_str()).chain(designations);
    let hint = match nearest(name, known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!(
            "nearest in the catalogue: {}; use --bearing-orders for any other",
            catalogue::nearest(name, 6).join(", ")
        ),
    };
    let places = if of_model.is_empty() { "in the catalogue" } else { "in the model or the catalogue" };
    findings.problem(format!("there is no bearing `{name}` {places}; {hint}"));
    Ok(None)
}

/// The model that a run was computed with, if its results hold it.
fn model_of_run(path: &Path) -> Result<Option<ModelSource>, Failure> {
    Ok(stored_origin(&*open_reader(path, limits())?).ok())
}

/// Warning about lines of the outer race in a computed run whose bearing is perfect.
///
/// The balls that pass through the load change the stiffness at BPFO (variable compliance), and a computed record has no noise
/// that hides it.
pub fn variable_compliance(run: Option<&Path>, results: &[SignalResult]) -> Result<Option<String>, Failure> {
    let is_outer = |result: &&SignalResult| {
        let graded = result.envelope.as_ref().and_then(|envelope| envelope.graded.as_ref());
        graded.is_some_and(|graded| graded.part() == Some(BearingPart::OuterRace))
    };
    let Some((found, run)) = results.iter().find(is_outer).zip(run) else { return Ok(None) };
    let (Some(bearing), Some(origin)) = (&found.bearing, model_of_run(run)?) else { return Ok(None) };
    let bearings = origin.load_bearings(&Settings::default())?.bearings;
    let own = bearings.iter().find(|(name, _)| *name == bearing.name);
    Ok(own.filter(|(_, ball)| ball.imperfections.is_empty()).map(|(name, _)| {
        format!(
            "{}: the run was computed with a perfect bearing {name}: its lines at BPFO are those of variable compliance, of the \
             balls that pass through the load, not of a damaged outer race",
            found.channel
        )
    }))
}

fn of_geometry(name: &str, source: String, g: &BallGeometry) -> BearingWithOrders {
    BearingWithOrders {
        name: name.into(),
        source,
        orders: g.characteristic_orders(g.contact_angle),
        balls: g.balls,
        raceway_radii: Some(radii(g.pitch_diameter, g.ball_diameter, g.contact_angle)),
    }
}

/// Raceway radii (D_pw ∓ D_w cos α)/2 of inner and outer race.
fn radii(pitch: f64, ball: f64, angle: f64) -> [f64; 2] {
    [-1.0, 1.0].map(|side| 0.5 * (pitch + side * ball * angle.cos()))
}

/// Deviation of BPFO + BPFI from a whole number that rounding of both to two digits explains.
const ORDER_TOLERANCE: f64 = 0.02;

/// Parses `FTF=..., BPFO=..., BPFI=..., BSF=...`; the number of balls is Z = BPFO + BPFI, missing FTF and BSF
/// are computed for a contact angle of zero.
fn from_orders(rates: &[String], findings: &mut InputProblems) -> Option<BearingWithOrders> {
    const NAMES: [&str; 4] = ["FTF", "BPFO", "BPFI", "BSF"];
    let mut found: [Option<f64>; 4] = [None; 4];
    for text in rates {
        let parts = text.split_once('=').map(|(name, value)| (name.trim(), value.trim().parse::<f64>()));
        let place =
            parts.as_ref().and_then(|(name, _)| NAMES.iter().position(|n| n.eq_ignore_ascii_case(name)));
        match (place, parts) {
            (Some(place), Some((_, Ok(value)))) if value > 0.0 && value.is_finite() => {
                found[place] = Some(value)
            }
            _ => findings.problem(format!(
                "--bearing-orders {text}: expected one of {} with its order (per revolution), such as BPFO=3.585",
                NAMES.join(", ")
            )),
        }
    }
    let (Some(bpfo), Some(bpfi)) = (found[1], found[2]) else {
        findings.problem("--bearing-orders: both BPFO and BPFI are required, such as --bearing-orders BPFO=3.585,BPFI=5.415");
        return None;
    };
    let z = (bpfo + bpfi).round();
    if z < 3.0 || bpfo >= bpfi {
        findings.problem(format!(
            "--bearing-orders: BPFO + BPFI = {:.3} must be the number of balls, 3 or more, with BPFO < BPFI",
            bpfo + bpfi
        ));
        return None;
    }
    if (bpfo + bpfi - z).abs() > ORDER_TOLERANCE {
        findings.warn_of(
            Code::BearingOrdersInconsistent,
            format!(
                "--bearing-orders: BPFO + BPFI = {:.3} should be the number of balls; {z} is assumed, the orders are taken as given",
                bpfo + bpfi
            ),
        );
    }
    let gamma = (bpfi - bpfo) / z;
    let orders = CharacteristicOrders {
        ftf: found[0].unwrap_or(bpfo / z),
        bpfo,
        bpfi,
        bsf: found[3].unwrap_or(0.5 / gamma * (1.0 - gamma * gamma)),
    };
    let balls = z as usize;
    Some(BearingWithOrders {
        name: format!("{balls} balls"),
        source: "rates given".into(),
        orders,
        balls,
        raceway_radii: None,
    })
}
