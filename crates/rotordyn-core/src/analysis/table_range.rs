//! Speeds of a study compared with the tables of bearings over speed.

use crate::assembly::PhysicsError;
use crate::model::{BearingSite, Model};
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
        if range.beyond == BeyondTable::Extrapolate {
            continue;
        }
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

/// Warnings of bearings whose tables cover less than the speeds of several studies, one for each bearing.
///
/// `studies`: name, lowest and highest speed \[rad/s\] of each. A bearing that refuses such speeds has none: its studies end
/// with an error.
pub fn warnings(model: &Model, studies: &[(&str, [f64; 2])]) -> Vec<Warning> {
    let rpm = |speed: f64| format!("{:.0}", speed * 60.0 / TAU);
    let of_bearing = |site: &BearingSite| {
        let range = site.bearing.speed_range().filter(|range| range.beyond == BeyondTable::Hold)?;
        let [first, last] = range.speeds;
        let margin = TABLE_MARGIN * last;
        let beyond: Vec<&(&str, [f64; 2])> = studies
            .iter()
            .filter(|(_, [low, high])| *low < first - margin || *high > last + margin)
            .collect();
        if beyond.is_empty() {
            return None;
        }
        let need = |(study, [low, high]): &(&str, [f64; 2])| match low == high {
            true => format!("{study} needs {} rpm", rpm(*low)),
            false => format!("{study} needs {} to {} rpm", rpm(*low), rpm(*high)),
        };
        let needs: Vec<String> = beyond.into_iter().map(need).collect();
        let low = studies.iter().any(|(_, speeds)| speeds[0] < first - margin);
        let high = studies.iter().any(|(_, speeds)| speeds[1] > last + margin);
        let held = match (low, high) {
            (true, false) => {
                format!("below {0} rpm the values of {0} rpm hold, also at standstill", rpm(first))
            }
            (false, true) => format!("above {0} rpm the values of {0} rpm hold", rpm(last)),
            _ => "beyond it the values of its end hold".into(),
        };
        let name = &site.name;
        let text = format!(
            "bearing {name}: its table covers {} to {} rpm, {}; {held}",
            rpm(first),
            rpm(last),
            needs.join(", ")
        );
        Some(Warning::new(Code::TableRange, format!("bearing.{name}"), text))
    };
    model.bearings.iter().filter_map(of_bearing).collect()
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
