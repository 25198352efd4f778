//! Critical speeds outside the speeds of an unbalance response, whose separation margins it does not show.

use crate::analysis::ModeKind;
use crate::analysis::peaks::{CRITICALLY_DAMPED, LARGEST_REQUIRED, separation};
use crate::analysis::poles::{Pole, synchronous_poles};
use crate::analysis::table_range::speed_range;
use crate::assembly::PhysicsError;
use crate::document::TO_RPM;
use crate::results::UnbalanceResult;
use crate::study::Machine;
use crate::warning::{Code, Warning};

impl Machine {
    /// Critical speeds that API 617 may ask to be farther from the operating speeds, and that lie outside the speeds of the response.
    /// A response at one speed has no peaks, and none is missed.
    pub(super) fn margin_range_warnings(&self, found: &UnbalanceResult) -> Vec<Warning> {
        let (Some([lowest, highest]), Some([first, last])) =
            (found.operating_speeds, speed_range(&found.speeds))
        else {
            return Vec::new();
        };
        if first == last {
            return Vec::new();
        }
        let [below, above] = LARGEST_REQUIRED;
        let [low, high] = [lowest * (1.0 - below), highest * (1.0 + above)];
        let gaps = [[low, first.min(high)], [last.max(low), high]];
        gaps
            .into_iter()
            .filter(|[from, to]| to > from)
            .flat_map(|range| {
                self.critical_within(range).map_or_else(
                    |error| {
                        let [from, to] = range.map(|speed| speed * TO_RPM);
                        let text = format!(
                            "unbalance: critical speeds from {from:.0} to {to:.0} rpm, so near the operating speeds that \
                             their separation margins count, are not sought: {error}"
                        );
                        vec![Warning::new(Code::MarginRange, "study.unbalance", text)]
                    },
                    |poles| poles.iter().map(|pole| unassessed(pole, [first, last], [lowest, highest])).collect(),
                )
            })
            .collect()
    }

    /// The lateral critical speeds within a range of speeds \[rad/s\] that the unbalance excites, without critically damped ones.
    fn critical_within(&self, [from, to]: [f64; 2]) -> Result<Vec<Pole>, PhysicsError> {
        if let Some(machine) = self.decided(&[from, to])? {
            return machine.critical_within([from, to]);
        }
        self.check_tables("unbalance", &[from, to])?;
        let tangents = |speed| self.tangents(speed, true);
        let (mut poles, _) = synchronous_poles(&self.assembly, [from, to], &tangents, &self.table_speeds())?;
        poles.retain(|pole| {
            let is_lateral = !matches!(pole.kind, Some(ModeKind::Torsional | ModeKind::Axial));
            is_lateral
                && (from..=to).contains(&pole.at)
                && 0.5 * pole.at > CRITICALLY_DAMPED * pole.half_width
                && pole.is_excited_by(&self.assembly.unbalance_amplitude(pole.at))
        });
        Ok(poles)
    }
}

fn unassessed(pole: &Pole, [first, last]: [f64; 2], operating: [f64; 2]) -> Warning {
    let side = match pole.at {
        at if at < operating[0] => "below",
        at if at > operating[1] => "above",
        _ => "within",
    };
    let distance = match side {
        "within" => "within the operating speeds".into(),
        side => format!("{:.1} % {side} the operating speeds", 100.0 * separation(pole.at, operating)),
    };
    let text = format!(
        "unbalance: {} at {:.1} rpm, {distance}, lies outside the speeds of the response ({:.0} to {:.0} rpm): its \
         separation margin is not assessed",
        pole.label,
        pole.at * TO_RPM,
        first * TO_RPM,
        last * TO_RPM
    );
    Warning::new(Code::MarginRange, "study.unbalance", text)
}
