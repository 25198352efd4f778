//! `/motion`: frames of the motion of all parts, written with a run and read for animations.

use super::section::write_section;
use crate::error::Error;
use crate::hdf5::{Attribute, Reader, Store};
use rotordyn_core::results::{BearingMotion, BodyMotion, Motion};

const GROUP: &str = "/motion";

/// Writes the motion, replacing an earlier one.
///
/// # Errors
/// The file cannot be written.
pub fn write_motion(store: &Store, motion: &Motion) -> Result<(), Error> {
    write_section(store, "", &motion.section())?;
    store.flush()
}

/// Reads the motion of a run; `None` if it was not recorded.
///
/// # Errors
/// The file cannot be read, or its arrays do not belong together.
pub fn read_motion(store: &dyn Reader) -> Result<Option<Motion>, Error> {
    if !store.contains(GROUP)? {
        return Ok(None);
    }
    let wrong = |what: &str| Error::of_file("read", store.path())(format!("{GROUP}: {what}"));
    let time = store.read(&format!("{GROUP}/time"))?.data;
    let frames = time.len();
    let displacement = store.read(&format!("{GROUP}/displacement"))?.data;
    let per_frame = displacement.len() / frames.max(1);
    if per_frame.checked_mul(frames) != Some(displacement.len()) {
        return Err(wrong("arrays of different lengths"));
    }
    let bearing = |name: String| {
        let at = format!("{GROUP}/bearings/{name}");
        let balls = match store.attribute(&at, "balls")? {
            Some(Attribute::Integer(balls)) if balls >= 0 => balls as usize,
            _ => return Err(wrong("a bearing without its number of balls")),
        };
        let cage_angle = store.read(&format!("{at}/cage_angle"))?.data;
        let mut bodies = Vec::new();
        if store.contains(&format!("{at}/position"))? {
            let position = vectors::<3>(store, &format!("{at}/position"), frames)?;
            let orientation = vectors::<4>(store, &format!("{at}/orientation"), frames)?;
            let rotation = vectors::<3>(store, &format!("{at}/angular_velocity"), frames)?;
            let forces = vectors::<3>(store, &format!("{at}/ball_forces"), frames)?;
            let parts = position.into_iter().zip(orientation).zip(rotation).zip(forces);
            bodies.extend(parts.map(|(((position, orientation), rotation), forces)| BodyMotion {
                position,
                orientation,
                rotation,
                forces,
            }));
        }
        if cage_angle.len() != frames || (!bodies.is_empty() && bodies.len() < balls) {
            return Err(wrong("arrays of different lengths"));
        }
        Ok(BearingMotion { name, cage_angle, bodies, balls })
    };
    let motion = Motion {
        shaft_angle: store.read(&format!("{GROUP}/shaft_angle"))?.data,
        displacement: displacement.chunks(per_frame.max(1)).map(<[f64]>::to_vec).collect(),
        bearings: store
            .members(&format!("{GROUP}/bearings"))?
            .into_iter()
            .map(bearing)
            .collect::<Result<_, _>>()?,
        time,
    };
    if motion.shaft_angle.len() != frames || motion.displacement.len() != frames {
        return Err(wrong("arrays of different lengths"));
    }
    Ok(Some(motion))
}

/// An array \[body, frame, N\] as vectors over the frames of every body.
fn vectors<const N: usize>(
    store: &dyn Reader,
    name: &str,
    frames: usize,
) -> Result<Vec<Vec<[f64; N]>>, Error> {
    let data = store.read(name)?.data;
    let (vectors, rest) = data.as_chunks::<N>();
    if frames == 0 || !rest.is_empty() || vectors.len() % frames != 0 {
        return Err(Error::of_file("read", store.path())(format!("{name} has another number of frames")));
    }
    Ok(vectors.chunks(frames).map(<[[f64; N]]>::to_vec).collect())
}
