//! How far the cages of a recorded run turn with the shaft.

use std::borrow::Cow;
use std::f64::consts::TAU;
use std::ops::Range;

use super::Machine;
use crate::model::run_channels;
use crate::results::History;
use crate::series::SeriesError;

/// Angles of shaft and cages of a run \[rad\], one cage per bearing of the model; `None` where it has no record.
pub(super) struct CageTurns<'a> {
    shaft: Cow<'a, [f64]>,
    cages: Vec<Option<Cow<'a, [f64]>>>,
}

impl<'a> CageTurns<'a> {
    /// Of a range of the run's samples.
    pub fn of(machine: &Machine, history: &'a History, range: Range<usize>) -> Result<Self, SeriesError> {
        let cage = |name: &str| {
            // Free balls go ahead of their cage or behind it.
            let balls = history.channel(&format!("{name}_ball_angle"));
            let channel = balls.or_else(|| history.channel(&run_channels::cage_angle(name)));
            channel.map(|channel| channel.values.read(range.clone())).transpose()
        };
        let sites = machine.model.bearings.iter();
        let cages = sites.map(|site| cage(&site.name)).collect::<Result<_, _>>()?;
        Ok(Self { shaft: history.angle.read(range.clone())?, cages })
    }

    /// Turns of each cage per turn of the shaft: r = Σ Δψ Δθ / Σ Δθ², to which fast stretches count most; `None` without
    /// record, or where the shaft stands.
    pub fn ratios(&self) -> Vec<Option<f64>> {
        let ratio = |cage: &Option<Cow<'_, [f64]>>| {
            let steps = self.shaft.windows(2).zip(cage.as_ref()?.windows(2));
            let steps = steps.map(|(shaft, cage)| [shaft[1] - shaft[0], cage[1] - cage[0]]);
            let [both, squares] = steps.fold([0.0, 0.0], |sum, [s, c]| [sum[0] + s * c, sum[1] + s * s]);
            (squares > 0.0).then(|| both / squares)
        };
        self.cages.iter().map(ratio).collect()
    }

    /// Turns of one cage per turn of the shaft within some turns about a sample, at the ends of the run fewer.
    pub fn ratio_about(&self, site: usize, sample: usize, turns: f64) -> Option<f64> {
        let cage = self.cages.get(site)?.as_ref()?;
        let last = self.shaft.len().min(cage.len()).checked_sub(1)?;
        let centre = sample.min(last);
        let is_near = |k: &usize| (self.shaft[*k] - self.shaft[centre]).abs() <= 0.5 * turns * TAU;
        let first = (0..centre).rev().take_while(is_near).last().unwrap_or(centre);
        let end = (centre..=last).take_while(is_near).last().unwrap_or(centre);
        let turned = self.shaft[end] - self.shaft[first];
        (turned != 0.0).then(|| (cage[end] - cage[first]) / turned)
    }
}
