//! The analyses of one channel of a file.

use super::super::failure::Failure;
use super::shaft_source::ShaftSource;
use rotordyn::results::{BearingWithOrders, SignalResult};
use rotordyn::signal::SignalError;
use rotordyn::study::signal::{SignalChannel, SignalSettings, analyse};

/// The analyses of one channel.
pub fn analyse_channel(
    channel: &SignalChannel,
    shaft: &ShaftSource,
    bearing: Option<&BearingWithOrders>,
    settings: &SignalSettings,
) -> Result<SignalResult, Failure> {
    let named = |text: String| Failure::Input(format!("`{}`: {text}", channel.name));
    let motion = shaft.motion(channel).map_err(named)?;
    if motion.is_none() && bearing.is_some() {
        return Err(named("the shaft speed is zero; bearing defect frequencies are multiples of it".into()));
    }
    analyse(channel, motion.as_ref(), bearing, settings).map_err(|error| match error {
        SignalError::Unknown { what, purpose } => {
            let advice = if what.contains("angle") {
                "give --tacho CHANNEL, or --track 1=\"5 Hz .. 50 Hz\""
            } else {
                "give --speed \"1797 rpm\", or a range of constant speed with --time"
            };
            named(format!("{purpose} needs {what}, which is not known; {advice}"))
        }
        error => named(error.to_string()),
    })
}
