//! Motion of all parts of a machine, frame by frame, for animations.

use crate::document::{Array, Document, Section, in_json};
use serde::{Deserialize, Serialize};

/// Frames of the motion of a machine with its balls and cages.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Times \[s\] and angles of the shaft \[rad\].
    pub time: Vec<f64>,
    pub shaft_angle: Vec<f64>,
    /// Displacements of the nodes of shaft and bodies, six per node \[m, rad\], without the angle of the shaft.
    pub displacement: Vec<Vec<f64>>,
    /// Every ball bearing.
    pub bearings: Vec<BearingMotion>,
}

/// Motion of the balls and the cage of a bearing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BearingMotion {
    pub name: String,
    /// Angle of the cage over the frames \[rad\].
    pub cage_angle: Vec<f64>,
    /// Free bodies, each over the frames: the balls, then the cage; empty with a cage that rolls.
    pub bodies: Vec<BodyMotion>,
    /// Number of free balls.
    pub balls: usize,
}

/// Motion of one free body against the bearing's place at rest, over the frames.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyMotion {
    /// Centre \[m\].
    pub position: Vec<[f64; 3]>,
    /// Orientation as unit quaternion, scalar first. That of a ball is the integral of its angular velocity over the
    /// samples of the run, from none at the first frame.
    pub orientation: Vec<[f64; 4]>,
    /// Angular velocity \[rad/s\].
    pub rotation: Vec<[f64; 3]>,
    /// Normal loads of inner and outer race, force of the pocket along the orbit \[N\]; 0 for a cage.
    pub forces: Vec<[f64; 3]>,
}

impl Motion {
    /// Bytes of the numbers of a frame: `nodes` of shaft and bodies, and free bodies.
    pub fn frame_bytes(nodes: usize, free_bodies: usize) -> f64 {
        8.0 * (2.0 + 6.0 * nodes as f64 + 13.0 * free_bodies as f64)
    }

    /// The bearing of a name.
    pub fn bearing(&self, name: &str) -> Option<&BearingMotion> {
        self.bearings.iter().find(|bearing| bearing.name == name)
    }

    /// Largest angle by which a free body or the shaft turns from one frame to the next \[rad\], by its angular velocity.
    pub fn largest_turn(&self) -> f64 {
        let intervals = self.time.windows(2).map(|t| t[1] - t[0]);
        let interval = intervals.fold(0.0, f64::max);
        let shaft = self.shaft_angle.windows(2).map(|angle| (angle[1] - angle[0]).abs()).fold(0.0, f64::max);
        let bodies = self.bearings.iter().flat_map(|bearing| &bearing.bodies).flat_map(|body| &body.rotation);
        let speed = |w: &[f64; 3]| w.iter().map(|w| w * w).sum::<f64>().sqrt();
        bodies.map(|rotation| interval * speed(rotation)).fold(shaft, f64::max)
    }

    /// What is written to the results file, in the group `motion`.
    pub fn section(&self) -> Section<'_> {
        let frames = self.time.len();
        let nodes = self.displacement.first().map_or(0, |frame| frame.len() / 6);
        let displacement: Vec<f64> = self.displacement.iter().flatten().copied().collect();
        let displacement = Array::real(&[frames, nodes, 6], "m, rad", displacement).over(0, "time");
        let bearings = self.bearings.iter().map(|bearing| (bearing.name.clone(), bearing.document(frames)));
        let content = Document::new()
            .numbers("time", "s", &self.time)
            .numbers("shaft_angle", "rad", &self.shaft_angle)
            .array("displacement", displacement)
            .groups("bearings", "name", bearings);
        Section::new("motion", "motion", content)
    }
}

impl BearingMotion {
    fn document(&self, frames: usize) -> Document<'_> {
        let bodies = self.bodies.len();
        let document = Document::new()
            .text(in_json("name"), &self.name)
            .integer("balls", self.balls)
            .numbers("cage_angle", "rad", &self.cage_angle);
        if bodies == 0 {
            return document;
        }
        let columns = [
            array(frames, "m", self.bodies.iter().map(|body| &body.position)),
            array(frames, "1", self.bodies.iter().map(|body| &body.orientation)),
            array(frames, "rad/s", self.bodies.iter().map(|body| &body.rotation)),
            array(frames, "N", self.bodies.iter().map(|body| &body.forces)),
        ];
        let names = ["position", "orientation", "angular_velocity", "ball_forces"];
        names.into_iter().zip(columns).fold(document, |out, (name, column)| out.array(name, column))
    }
}

/// Vectors of every body as an array \[body, frame, component\].
fn array<'a, const N: usize>(
    frames: usize,
    unit: &str,
    bodies: impl Iterator<Item = &'a Vec<[f64; N]>>,
) -> Array<'static> {
    let values: Vec<f64> = bodies.flatten().flatten().copied().collect();
    let count = values.len() / (N * frames.max(1));
    Array::real(&[count, frames, N], unit, values)
}
