//! Motion of a run with free balls: recorded frames against the run's channels, the results file, ParaView and glTF files.

use crate::rig;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rotordyn::io::animated_scene::AnimatedScene;
use rotordyn::io::export_3d::export_motion;
use rotordyn::io::hdf5::Store;
use rotordyn::io::{gltf, results_file};
use rotordyn::model::study::{BearingStudy, MotionSettings, RunUpStudy};
use rotordyn::model::{Options, SpeedProfile, load};
use rotordyn::results::{History, Motion};
use rotordyn::study::{Machine, MotionRecorder, Recorder, bearing_motion};
use rotordyn::transient::run::End;
use serde_json::Value;
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::LazyLock;

/// Balls of bearing B.
const BALLS: usize = 9;

/// The rig with free balls in B at 1200 rpm for 20 ms, frames at 1 kHz from 10 ms on.
static RUN: LazyLock<(Machine, History, Motion)> = LazyLock::new(|| {
    let mut model = rig::variant(Some("free_balls"), &[("bearing.B.slip", "\"centre\"")]);
    model.profile = SpeedProfile::Constant { speed: 125.7, duration: 0.02 };
    let machine = Machine::new(model).unwrap();
    let settings = MotionSettings { rate: 1e3, from: 0.01, to: f64::INFINITY };
    let study = RunUpStudy { motion: Some(settings), ..machine.model.studies.run_up.clone().unwrap() };
    let reduction = machine.reduce(&study).unwrap();
    let mut recorder = Recorder::new(&machine.model, &reduction.system, study.sample_rate);
    let mut frames = MotionRecorder::new(&machine, &reduction, settings, study.sample_rate);
    let report = machine.run_up(&study, &reduction, |sample| {
        recorder.record(sample);
        frames.observe(sample);
        ControlFlow::Continue(())
    });
    assert_eq!(report.end, End::Complete);
    let motion = frames.motion;
    (machine, recorder.into_history(), motion)
});

/// Values of a channel at the samples of the frames.
fn at_frames(history: &History, motion: &Motion, name: &str) -> Vec<f64> {
    let values = history.channel(name).unwrap().values.in_memory().unwrap();
    let sample = |time: &f64| (time * history.sample_rate).round() as usize;
    motion.time.iter().map(|time| values[sample(time)]).collect()
}

/// An angle less whole turns, near 0.
fn rest(angle: f64) -> f64 {
    angle - (angle / TAU).round() * TAU
}

/// Frames at the requested instants have the places that the channels of the run tell of.
#[test]
fn frames_agree_with_the_channels_of_the_run() {
    let (machine, history, motion) = &*RUN;
    assert_eq!(motion.time.len(), 11);
    for (k, time) in motion.time.iter().enumerate() {
        assert!((time - 0.01 - 1e-3 * k as f64).abs() < 1e-12);
    }
    let bearing = motion.bearing("B").unwrap();
    assert_eq!((bearing.balls, bearing.bodies.len()), (BALLS, BALLS + 1));
    assert!(motion.bearing("A").unwrap().bodies.is_empty());
    let site = machine.model.bearings.iter().find(|site| site.name == "B").unwrap();
    let housing = 6 * site.housing.node.unwrap();
    let channel = |name: &str| at_frames(history, motion, name);
    let [x, y, angle, balls, disc] =
        ["B_cage_x", "B_cage_y", "B_cage_angle", "B_ball_angle", "disc_y"].map(channel);
    let disc_node = 6 * machine.model.discs.iter().find(|disc| disc.name == "main").unwrap().node;
    let cage = &bearing.bodies[BALLS];
    for k in 0..motion.time.len() {
        let q = &motion.displacement[k];
        let arm = Vector3::from(site.housing.offset);
        let ring = Vector3::from_row_slice(&q[housing..housing + 3])
            + Vector3::from_row_slice(&q[housing + 3..housing + 6]).cross(&arm);
        let centre = Vector3::from(cage.position[k]) - ring;
        assert!((centre.x - x[k]).abs() < 1e-12 && (centre.y - y[k]).abs() < 1e-12, "{centre} {}", x[k]);
        let [w, i, j, l] = cage.orientation[k];
        let across = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, l)) * Vector3::x();
        assert!(rest(across.y.atan2(across.x) - angle[k]).abs() < 1e-9);
        // The channel is filtered, the frame is the instant.
        assert!((q[disc_node + 1] - disc[k]).abs() < 1e-9, "{} {}", q[disc_node + 1], disc[k]);
        let places = (0..BALLS).map(|j| {
            let [x, y, _] = bearing.bodies[j].position[k];
            rest(y.atan2(x) - TAU * j as f64 / BALLS as f64 - balls[k])
        });
        // The mean direction of the balls; their spacing scatters within the pockets.
        assert!((places.sum::<f64>() / BALLS as f64).abs() < 1e-3);
        let loads: f64 = bearing.bodies[..BALLS].iter().map(|ball| ball.forces[k][0]).sum();
        assert!(loads > 50.0, "the bearing carries disc and belt: {loads}");
    }
}

/// Balls turn about z by the integral of their angular velocity, which is that of rolling, (D_pw/D_w − D_w/D_pw)/2 of the
/// shaft's speed backwards less the orbit, but for those that slip without load.
#[test]
fn orientation_of_balls_is_that_of_rolling() {
    let (machine, _, motion) = &*RUN;
    let geometry = &machine.model.bearings[1].bearing.ball().unwrap().geometry;
    let gamma = geometry.ball_diameter / geometry.pitch_diameter;
    let speed = 125.7 * (0.5 * (1.0 - gamma) - 0.5 * (1.0 / gamma - gamma));
    let duration = motion.time[10] - motion.time[0];
    for ball in &motion.bearing("B").unwrap().bodies[..BALLS] {
        assert_eq!(ball.orientation[0], [1.0, 0.0, 0.0, 0.0]);
        let [w, x, y, z] = ball.orientation[10];
        assert!((w * w + x * x + y * y + z * z - 1.0).abs() < 1e-12);
        let turned = rest(2.0 * z.atan2(w) - speed * duration);
        // Trapezoidal sum over the frames, between which the speed varies with every collision.
        let sum: f64 = ball.rotation.windows(2).map(|pair| 0.5 * (pair[0][2] + pair[1][2]) * 1e-3).sum();
        println!(
            "turned {:.4} rad, sum {sum:.4}, rolling {:.4}",
            turned + speed * duration,
            speed * duration
        );
        assert!((turned + speed * duration - sum).abs() < 0.02);
        assert!(turned.abs() < 0.1 * (speed * duration).abs());
    }
}

#[test]
fn the_results_file_keeps_the_motion() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::create(folder.path().join("results.h5")).unwrap();
    assert_eq!(results_file::read_motion(&store).unwrap(), None);
    let motion = &RUN.2;
    results_file::write_motion(&store, motion).unwrap();
    assert_eq!(results_file::read_motion(&store).unwrap().as_ref(), Some(motion));
    let shape = store.read("/motion/bearings/B/position").unwrap().shape;
    assert_eq!(shape, [BALLS + 1, 11, 3]);
    results_file::remove_run(&store).unwrap();
    assert_eq!(results_file::read_motion(&store).unwrap(), None);
}

/// Numbers of an appended array of a .vtu file.
fn appended(file: &[u8], name: &str) -> Vec<f64> {
    let text = String::from_utf8_lossy(file);
    let declaration = text.lines().find(|line| line.contains(&format!("Name=\"{name}\""))).unwrap();
    let offset: usize =
        declaration.split("offset=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let start = file.windows(mark.len()).position(|window| window == mark).unwrap() + mark.len() + offset;
    let length = u64::from_le_bytes(file[start..start + 8].try_into().unwrap()) as usize;
    let data = &file[start + 8..start + 8 + length];
    match declaration.contains("Float64") {
        true => data.chunks(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect(),
        false => data.chunks(4).map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))).collect(),
    }
}

/// JSON document and buffer of a .glb file.
fn glb(path: &Path) -> (Value, Vec<u8>) {
    let file = std::fs::read(path).unwrap();
    let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
    let json = word(12);
    (serde_json::from_slice(&file[20..20 + json]).unwrap(), file[28 + json..].to_vec())
}

fn accessor(document: &Value, buffer: &[u8], number: &Value) -> Vec<f64> {
    let accessor = &document["accessors"][number.as_u64().unwrap() as usize];
    let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let [start, length] = ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
    let bytes = buffer[start..start + length].chunks(4);
    bytes.map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))).collect()
}

/// Centres of the balls in the .vtu files and translations and rotations of their nodes in the .glb are those of the run.
#[test]
fn exported_positions_are_those_of_the_run() {
    let (machine, _, motion) = &*RUN;
    let folder = tempfile::tempdir().unwrap();
    let files = export_motion(motion, &machine.model, 25.0, folder.path()).unwrap();
    assert_eq!(files, ["motion.glb", "motion.pvd"].map(|name| folder.path().join(name)));
    let series = std::fs::read_to_string(&files[1]).unwrap();
    assert_eq!(series.matches("<DataSet").count(), 11);
    let bearing = motion.bearing("B").unwrap();
    let z = machine.model.node_z[machine.model.bearings[1].node];
    for k in [0, 10] {
        let file = std::fs::read(folder.path().join(format!("motion/motion_{k:05}.vtu"))).unwrap();
        let [points, displacement, balls, velocity, load] =
            ["points", "displacement", "ball", "angular_velocity", "inner_load"]
                .map(|name| appended(&file, name));
        for (j, body) in bearing.bodies[..BALLS].iter().enumerate() {
            // The first point of a ball is its centre; bearing A stands before B.
            let number = (j + 1) as f64;
            let point = (0..balls.len()).find(|p| balls[*p] == number && velocity[3 * p + 2] != 0.0).unwrap();
            for i in 0..3 {
                let expected = body.position[k][i] + if i == 2 { z } else { 0.0 };
                assert!((points[3 * point + i] + displacement[3 * point + i] - expected).abs() < 1e-10);
                assert!((velocity[3 * point + i] - body.rotation[k][i]).abs() < 1e-4);
            }
            assert!((load[point] - body.forces[k][0]).abs() < 1e-4);
        }
    }

    let (document, buffer) = glb(&files[0]);
    let nodes = document["nodes"].as_array().unwrap();
    let named = |name: &str| nodes.iter().position(|node| node["name"] == name).unwrap();
    let animation = &document["animations"][0];
    let sampler = |node: usize, path: &str| {
        let mut channels = animation["channels"].as_array().unwrap().iter();
        let channel = channels
            .find(|channel| channel["target"]["node"] == node && channel["target"]["path"] == path)
            .unwrap();
        &animation["samplers"][channel["sampler"].as_u64().unwrap() as usize]
    };
    let children = nodes[named("B")]["children"].as_array().unwrap();
    let child = |name: &str| {
        let numbers = children.iter().map(|child| child.as_u64().unwrap() as usize);
        numbers.into_iter().find(|child| nodes[*child]["name"] == name).unwrap()
    };
    for (j, body) in bearing.bodies.iter().enumerate() {
        let node = if j < BALLS { child(&format!("ball {}", j + 1)) } else { child("cage") };
        let times = accessor(&document, &buffer, &sampler(node, "translation")["input"]);
        let places = accessor(&document, &buffer, &sampler(node, "translation")["output"]);
        let turns = accessor(&document, &buffer, &sampler(node, "rotation")["output"]);
        assert_eq!((times.len(), places.len(), turns.len()), (11, 33, 44));
        assert!((times[10] - 25.0 * 0.01).abs() < 1e-6 && times[0] == 0.0);
        for k in 0..11 {
            for i in 0..3 {
                assert!((places[3 * k + i] - body.position[k][i]).abs() < 1e-8, "{j} {k} {i}");
            }
            let [w, x, y, z] = body.orientation[k];
            let cosine: f64 = turns[4 * k..4 * k + 4].iter().zip([x, y, z, w]).map(|(a, b)| a * b).sum();
            assert!((cosine.abs() - 1.0).abs() < 1e-6, "{j} {k}");
        }
    }
    assert!(nodes[child("ball 1")]["children"].is_array(), "marks show the spin");
}

/// A cage that rolls turns by its angle; a shaft that turns by more than half a turn from frame to frame is refused.
#[test]
fn rolling_cages_turn_and_coarse_frames_are_refused() {
    let (machine, _, motion) = &*RUN;
    let animated = AnimatedScene::of_motion(&machine.model, motion);
    let recorded = motion.bearing("A").unwrap();
    let cage = animated.track_of("A", "cage").unwrap();
    let turn = |k: usize| {
        let [x, y, z, w] = cage.rotation[k];
        let across = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)) * Vector3::x();
        across.y.atan2(across.x)
    };
    assert!(rest(turn(10) - turn(0) - (recorded.cage_angle[10] - recorded.cage_angle[0])).abs() < 1e-9);

    let mut coarse = motion.clone();
    coarse.shaft_angle.iter_mut().enumerate().for_each(|(k, angle)| *angle = 4.0 * k as f64);
    let folder = tempfile::tempdir().unwrap();
    let error = export_motion(&coarse, &machine.model, 1.0, folder.path()).unwrap_err().to_string();
    assert!(
        error.contains("turns by 229 deg") && error.contains("motion_rate of at least 1420 Hz"),
        "{error}"
    );
    assert!(gltf::to_animated_glb(&animated, 1.0).starts_with(b"glTF"));
}

/// The settled motion of one bearing has the cage speed of its study, its ring in the displacement that balances the load, and
/// exports as the motion of a machine does.
#[test]
fn a_single_bearing_moves_as_in_its_study() {
    let options = Options { variant: Some("preloaded".into()), ..Options::default() };
    let text = include_str!("../../models/free_balls.toml");
    let machine = Machine::new(load("free_balls.toml", text, &options).unwrap().model).unwrap();
    let study = BearingStudy {
        bearings: vec!["A".into()],
        force: Some([0.0, -100.0, 0.0]),
        speed: Some(1256.6),
        ..BearingStudy::default()
    };
    let found = machine.bearings(&study).unwrap().remove(0);
    let found = found.free_balls.expect("a bearing that settles");
    let (alone, motion) = bearing_motion(&machine.model, &found, 1).unwrap().unwrap();
    let bearing = motion.bearing("A").unwrap();
    assert_eq!((motion.time.len(), bearing.balls, bearing.bodies.len()), (97, 8, 9));
    let cage = &bearing.bodies[8];
    let speed = cage.rotation.iter().map(|rotation| rotation[2]).sum::<f64>() / 97.0;
    println!("cage {speed:.3} rad/s, in the study {:.3}", found.cage_speed);
    assert!((speed / found.cage_speed - 1.0).abs() < 5e-3);
    let turned = bearing.cage_angle[96] - bearing.cage_angle[0];
    assert!(rest(turned - found.cage_ratio * TAU).abs() < 0.05, "{turned}");
    assert_eq!(motion.displacement[50][..3], found.displacement);
    let pitch = 0.5 * machine.model.bearings[0].bearing.ball().unwrap().geometry.pitch_diameter;
    for [x, y, _] in bearing.bodies[..8].iter().flat_map(|ball| &ball.position) {
        assert!((x.hypot(*y) - pitch).abs() < 20e-6);
    }
    let folder = tempfile::tempdir().unwrap();
    let files = export_motion(&motion, &alone, 200.0, folder.path()).unwrap();
    let (document, _) = glb(&files[0]);
    // Inner and outer ring, cage and balls, each with translation and rotation.
    assert_eq!(document["animations"][0]["channels"].as_array().unwrap().len(), 2 * 11);
    assert!(folder.path().join("motion/motion_00096.vtu").exists());

    let rig = &RUN.0;
    let rolling = rotordyn::results::FreeBallResult { name: "A".into(), ..found };
    assert!(bearing_motion(&rig.model, &rolling, 1).unwrap().is_none(), "a bearing without free balls");
}
