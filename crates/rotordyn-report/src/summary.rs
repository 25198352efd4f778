//! What the results say, in about ten lines.

use super::items;
use rotordyn_core::model::Model;
use rotordyn_io::error::Error;
use rotordyn_io::hdf5::{Attribute, Reader};
use rotordyn_linalg::Complex64;
use std::f64::consts::TAU;

/// A line of the summary.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    pub what: String,
    pub value: String,
    pub detail: String,
}

/// Most critical speeds, bearings and channels that are listed.
const LISTED: usize = 4;

/// The lines that the stored studies give.
pub(crate) fn lines(reader: &dyn Reader, model: &Model) -> Result<Vec<Line>, Error> {
    let operating = model.profile.top_speed() * 60.0 / TAU;
    let parts = [
        critical_speeds(reader, operating)?,
        least_damped(reader)?,
        thresholds(reader)?,
        largest_orbit(reader)?,
        bearing_loads(reader)?,
        bearing_lives(reader)?,
        run_up(reader)?,
    ];
    Ok(parts.into_iter().flatten().collect())
}

fn line(what: impl Into<String>, value: String, detail: String) -> Line {
    Line { what: what.into(), value, detail }
}

/// The values of a data set; none if it is missing.
fn numbers(reader: &dyn Reader, path: &str) -> Result<Vec<f64>, Error> {
    Ok(if reader.contains(path)? { reader.read(path)?.data } else { Vec::new() })
}

fn texts(reader: &dyn Reader, path: &str) -> Result<Vec<String>, Error> {
    if reader.contains(path)? { reader.read_texts(path) } else { Ok(Vec::new()) }
}

fn attribute(reader: &dyn Reader, object: &str, name: &str) -> Result<Option<f64>, Error> {
    Ok(match reader.attribute(object, name)? {
        Some(Attribute::Number(x)) => Some(x),
        Some(Attribute::Integer(n)) => Some(n as f64),
        _ => None,
    })
}

/// Speeds at which 1x meets a natural frequency, with the separation of the nearest from the top speed.
///
/// Separation margin: |N_c − N|/N with the critical speed N_c and the top speed N (API 684).
fn critical_speeds(reader: &dyn Reader, operating: f64) -> Result<Vec<Line>, Error> {
    let stored = ["/critical_speeds", "/campbell/crossings"];
    let Some(group) =
        stored.into_iter().find(|group| reader.contains(&format!("{group}/rpm")).unwrap_or(false))
    else {
        return Ok(Vec::new());
    };
    let rpm = numbers(reader, &format!("{group}/rpm"))?;
    let order = numbers(reader, &format!("{group}/order"))?;
    let label = texts(reader, &format!("{group}/label"))?;
    let synchronous: Vec<(f64, &str)> = rpm
        .iter()
        .zip(&order)
        .zip(&label)
        .filter(|((_, order), _)| (**order - 1.0).abs() < 1e-9)
        .map(|((rpm, _), label)| (*rpm, label.as_str()))
        .collect();
    if synchronous.is_empty() {
        let range = attribute(reader, "/critical_speeds", "max_speed")?.map(|speed| speed * 60.0 / TAU);
        let top = range.or(numbers(reader, "/campbell/rpm")?.last().copied());
        let detail = top.map_or(String::new(), |top| format!("up to {top:.0} rpm"));
        return Ok(vec![line("Critical speeds (1x)", "none".into(), detail)]);
    }
    let speeds: Vec<String> = synchronous.iter().take(LISTED).map(|(rpm, _)| format!("{rpm:.0}")).collect();
    let modes: Vec<&str> = synchronous.iter().take(LISTED).map(|(_, label)| *label).collect();
    let more = synchronous.len().saturating_sub(LISTED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let value = format!("{} rpm", speeds.join(", "));
    let mut out = vec![line("Critical speeds (1x)", value, format!("{}{more}", modes.join(", ")))];
    let nearest =
        synchronous.iter().min_by(|a, b| (a.0 - operating).abs().total_cmp(&(b.0 - operating).abs()));
    if let Some((rpm, label)) = nearest.filter(|_| operating > 0.0) {
        let margin = 100.0 * (rpm - operating).abs() / operating;
        let side = if *rpm > operating { "above" } else { "below" };
        let detail = format!("{rpm:.0} rpm ({label}) is {side} the top speed of {operating:.0} rpm");
        out.push(line("Nearest to the top speed", format!("separation {margin:.0} %"), detail));
    }
    Ok(out)
}

/// The mode of least damping over the Campbell diagram's speeds, else of the modal study.
fn least_damped(reader: &dyn Reader) -> Result<Vec<Line>, Error> {
    let (labels, decrements, speeds, rows_are_modes) = if reader.contains("/campbell/log_dec")? {
        let labels = texts(reader, "/campbell/label")?;
        (labels, numbers(reader, "/campbell/log_dec")?, numbers(reader, "/campbell/rpm")?, true)
    } else {
        let labels = texts(reader, "/modes/label")?;
        (labels, numbers(reader, "/modes/log_dec")?, numbers(reader, "/modes/rpm")?, false)
    };
    let least =
        decrements.iter().enumerate().filter(|(_, d)| d.is_finite()).min_by(|a, b| a.1.total_cmp(b.1));
    let Some((at, decrement)) = least.filter(|_| !speeds.is_empty()) else { return Ok(Vec::new()) };
    let (mode, speed) = match rows_are_modes {
        true => (at / speeds.len(), at % speeds.len()),
        false => (at, at / (decrements.len() / speeds.len()).max(1)),
    };
    let (Some(label), Some(rpm)) = (labels.get(mode), speeds.get(speed)) else { return Ok(Vec::new()) };
    let detail = format!("{label} at {rpm:.0} rpm");
    let value = match *decrement < 0.0 {
        true => format!("log decrement {decrement:.3}: unstable"),
        false => format!("log decrement {decrement:.3}"),
    };
    Ok(vec![line("Least damped mode", value, detail)])
}

/// Speeds at which a mode becomes unstable.
fn thresholds(reader: &dyn Reader) -> Result<Vec<Line>, Error> {
    let rpm = numbers(reader, "/campbell/thresholds/rpm")?;
    let label = texts(reader, "/campbell/thresholds/label")?;
    let found = rpm.iter().zip(&label).take(LISTED);
    Ok(found
        .map(|(rpm, label)| line("Stability threshold", format!("{rpm:.0} rpm"), label.clone()))
        .collect())
}

/// The largest orbit under unbalance.
///
/// Semi-major axis: |x + i y|/2 + |x − i y|/2 with the complex amplitudes x and y.
fn largest_orbit(reader: &dyn Reader) -> Result<Vec<Line>, Error> {
    let rpm = numbers(reader, "/unbalance/rpm")?;
    let mut largest: Option<(f64, f64, String)> = None;
    let has_orbit = |path: &str| reader.contains(&format!("{path}/x"));
    for name in items::groups(reader, "/unbalance/orbits", &has_orbit)? {
        let [x, y] = ["x", "y"].map(|axis| reader.read_complex(&format!("/unbalance/orbits/{name}/{axis}")));
        for ((x, y), rpm) in x?.data.iter().zip(&y?.data).zip(&rpm) {
            let iy = Complex64::I * y;
            let size = 0.5 * ((x + iy).norm() + (x - iy).norm());
            if largest.as_ref().is_none_or(|(most, ..)| size > *most) {
                largest = Some((size, *rpm, name.clone()));
            }
        }
    }
    let words = |(size, rpm, name): (f64, f64, String)| {
        let value = format!("{} um", significant(1e6 * size));
        line(
            "Largest unbalance response",
            value,
            format!("orbit of {name} (semi-major axis) at {rpm:.0} rpm"),
        )
    };
    Ok(largest.map(words).into_iter().collect())
}

/// Static loads of the bearings.
fn bearing_loads(reader: &dyn Reader) -> Result<Vec<Line>, Error> {
    let mut out = Vec::new();
    let has_force = |path: &str| reader.contains(&format!("{path}/force"));
    for name in items::groups(reader, "/equilibrium/bearings", &has_force)?.into_iter().take(LISTED) {
        let at = format!("/equilibrium/bearings/{name}");
        let force = numbers(reader, &format!("{at}/force"))?;
        let [x, y, z, ..] = force[..] else { continue };
        let value = format!("{} N radial, {} N axial", significant(x.hypot(y)), significant(z.abs()));
        let ball = attribute(reader, &at, "largest_ball_load")?.filter(|load| *load > 0.0);
        let detail = ball.map_or(String::new(), |load| format!("most loaded ball {} N", significant(load)));
        out.push(line(format!("Static load of bearing {name}"), value, detail));
    }
    Ok(out)
}

/// Rating lives of the bearing study.
fn bearing_lives(reader: &dyn Reader) -> Result<Vec<Line>, Error> {
    let mut out = Vec::new();
    let has_life = |path: &str| reader.contains(&format!("{path}/operating/basic_life"));
    for name in items::groups(reader, "/bearings", &has_life)?.into_iter().take(LISTED) {
        let life = numbers(reader, &format!("/bearings/{name}/operating/basic_life"))?.first().copied();
        if let Some(life) = life.filter(|life| life.is_finite()) {
            let value = format!("L10 = {} million revolutions", significant(life));
            out.push(line(format!("Rating life of bearing {name}"), value, String::new()));
        }
    }
    Ok(out)
}

/// The strongest line in the spectra of the run-up, and how the run ended.
fn run_up(reader: &dyn Reader) -> Result<Vec<Line>, Error> {
    let mut out = Vec::new();
    let has_map = |path: &str| reader.contains(&format!("{path}/spectrogram/amplitude"));
    for channel in items::groups(reader, "/spectra", &has_map)? {
        let at = format!("/spectra/{channel}/spectrogram");
        let map = reader.read(&format!("{at}/amplitude"))?;
        let (rpm, hz) =
            (numbers(reader, &format!("{at}/rpm"))?, numbers(reader, &format!("{at}/frequency"))?);
        let lines = hz.len().max(1);
        // The first lines hold the mean.
        let strongest = map.data.iter().enumerate().filter(|(k, a)| a.is_finite() && k % lines >= 3);
        let Some((k, amplitude)) = strongest.max_by(|a, b| a.1.total_cmp(b.1)) else { continue };
        let (Some(rpm), Some(hz)) = (rpm.get(k / lines), hz.get(k % lines)) else { continue };
        let unit = match reader.attribute(&format!("{at}/amplitude"), "unit")? {
            Some(Attribute::Text(unit)) => unit,
            _ => String::new(),
        };
        let order = if *rpm > 0.0 { format!(" (order {:.2})", hz * 60.0 / rpm) } else { String::new() };
        let value = format!("{} {unit}", significant(*amplitude));
        out.push(line(
            format!("Strongest line of {channel}"),
            value,
            format!("{hz:.1} Hz{order} at {rpm:.0} rpm"),
        ));
        if out.len() == LISTED {
            break;
        }
    }
    if let Some(Attribute::Text(end)) = attribute_text(reader, "/run_up", "end")? {
        let samples = attribute(reader, "/run_up", "samples")?.unwrap_or(0.0);
        out.push(line("Run-up", end, format!("{samples:.0} samples")));
    }
    Ok(out)
}

fn attribute_text(reader: &dyn Reader, object: &str, name: &str) -> Result<Option<Attribute>, Error> {
    if reader.contains(object)? { reader.attribute(object, name) } else { Ok(None) }
}

/// Three significant digits.
fn significant(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = 2 - x.abs().log10().floor() as i32;
    match digits {
        ..=0 => format!("{x:.0}"),
        1..=5 => format!("{x:.*}", digits as usize),
        _ => format!("{x:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits() {
        let cases =
            [(1234.5, "1234"), (0.0, "0"), (12.345, "12.3"), (0.012345, "0.0123"), (1.2e-7, "1.20e-7")];
        for (x, text) in cases {
            assert_eq!(significant(x), text);
        }
    }
}
