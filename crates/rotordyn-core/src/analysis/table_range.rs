//! Speeds of a study compared with the tables of bearings over speed.

use crate::assembly::PhysicsError;
use crate::model::Model;
use crate::warning::{Code, Warning};
use rotordyn_bearing::BeyondTable;
use std::f64::consts::TAU;

/// Distance beyond the end of a table that is still taken as its end, as a fraction of its highest speed.
pub const TABLE_MARGIN: f64 = 0.01;

/// Warnings of bearings whose stiffness and damping are tabulated over fewer speeds than a study needs.
///
/// `study`: its name; `speeds`: its lowest and highest speed \[rad/s\]. Up to [`TABLE_MARGIN`] beyond a table
/// there is no warning.
///
/// # Errors
/// [`PhysicsError::BeyondTable`] for a bearing that refuses speeds beyond its table.
pub fn check_tables(model: &Model, study: &str, speeds: [f64; 2]) -> Result<Vec<Warning>, PhysicsError> {
    let mut warnings = Vec::new();
    for site in &model.bearings {
        let Some(range) = site.bearing.speed_range() else { continue };
        let table = range.speeds;
        let margin = TABLE_MARGIN * table[1];
        if speeds[0] >= table[0] - margin && speeds[1] <= table[1] + margin {
            continue;
        }
        let [table_rpm, study_rpm] = [table, speeds].map(|range| range.map(|speed| speed * 60.0 / TAU));
        let found = PhysicsError::BeyondTable {
            bearing: site.name.clone(),
            study: study.into(),
            table_rpm,
            study_rpm,
        };
        if range.beyond == BeyondTable::Refuse {
            return Err(found);
        }
        let item = format!("bearing.{}", site.name);
        let text = format!("{found}; beyond it the values of its end hold");
        warnings.push(Warning::new(Code::TableRange, item, text));
    }
    Ok(warnings)
}

/// Warning of a motor whose torque table (speed \[rad/s\], torque \[N m\]) covers less than the speeds of a run.
///
/// A table of one row is a constant torque.
pub fn check_torque_table(table: &[[f64; 2]], speeds: [f64; 2]) -> Option<Warning> {
    let [first, .., last] = table else { return None };
    let margin = TABLE_MARGIN * last[0].abs();
    let inside = speeds[0] >= first[0] - margin && speeds[1] <= last[0] + margin;
    let rpm = |speed: f64| speed * 60.0 / TAU;
    (!inside).then(|| {
        let text = format!(
            "drive: its torque table covers {:.0} to {:.0} rpm, the run reaches {:.0} to {:.0} rpm; beyond it the \
             torque of its end holds",
            rpm(first[0]),
            rpm(last[0]),
            rpm(speeds[0]),
            rpm(speeds[1])
        );
        Warning::new(Code::TableRange, "drive", text)
    })
}

/// Lowest and highest of a list of speeds; `None` for an empty list.
pub fn speed_range(speeds: &[f64]) -> Option<[f64; 2]> {
    let widen = |range: Option<[f64; 2]>, &speed: &f64| {
        Some(range.map_or([speed; 2], |[low, high]: [f64; 2]| [low.min(speed), high.max(speed)]))
    };
    speeds.iter().fold(None, widen)
}
