//! 3D export: the machine and its bearings as .glb, mode shapes for ParaView (.vtu, .pvd).

use std::path::{Path, PathBuf};

use super::gltf;
use super::vtk::{Field, Grid, Values, machine_fields, part_field, to_binary_vtu, write_pvd, write_vtu};
use super::vtk_machine::rounded;
use super::vtk_motion;
use crate::animated_scene::AnimatedScene;
use crate::atomic_file;
use crate::error::Error;
use rotordyn_core::analysis::Mode;
use rotordyn_core::geometry::scene_graph::Scene;
use rotordyn_core::model::Model;
use rotordyn_core::results::Motion;
use rotordyn_core::study::{Machine, Results};
use rotordyn_units::names::file_names;

/// Ratio of the largest displacement of an exported mode shape to the length of the shaft.
const MODE_SHAPE_SIZE: f64 = 0.1;

/// Writes `machine.glb` and `bearing_<name>.glb` of every ball bearing; returns the files.
///
/// # Errors
/// A file cannot be written.
pub fn export_geometry(machine: &Machine, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    create_folder(folder)?;
    let mut files = vec![folder.join("machine.glb")];
    gltf::write(&files[0], &Scene::of_machine(&machine.model))?;
    let stems = file_names(machine.model.bearings.iter().map(|site| site.name.as_str()));
    for (site, stem) in machine.model.bearings.iter().zip(stems) {
        if let Some(ball) = site.bearing.ball() {
            let scene = Scene::of_ball_bearing(&site.name, ball);
            let file = folder.join(format!("bearing_{stem}.glb"));
            gltf::write(&file, &scene)?;
            files.push(file);
        }
    }
    Ok(files)
}

/// Writes every mode as `modes_<speed>rpm_<number>.vtu` and per speed `modes_<speed>rpm.pvd`, whose time is
/// the mode's number; returns the .pvd files.
///
/// Motion is Re(u e^{jωt}): fields `displacement` and `rotation` are Re u, `displacement_quarter` and
/// `rotation_quarter` −Im u, a quarter of a cycle later. The largest displacement is a tenth of
/// the shaft's length, or the largest rotation 1 rad. Field `part` tells shaft (0), discs (1), bodies (2), rings (3)
/// and balls (4), whose surfaces move with the mode as rigid bodies.
///
/// # Errors
/// A file cannot be written.
pub fn export_modes(results: &Results, machine: &Machine, folder: &Path) -> Result<Vec<PathBuf>, Error> {
    create_folder(folder)?;
    let grid = Grid::of_machine(&machine.model);
    let length = extent(machine);
    let mut files = Vec::new();
    for found in &results.modal {
        let name = modes_name(found.speed);
        let mut frames = Vec::new();
        for (k, mode) in found.modes.iter().enumerate() {
            let file = format!("{name}_{:02}.vtu", k + 1);
            write_vtu(&folder.join(&file), &grid, &mode_fields(&grid, mode, MODE_SHAPE_SIZE * length))?;
            frames.push(((k + 1) as f64, file));
        }
        let file = folder.join(format!("{name}.pvd"));
        write_pvd(&file, &frames)?;
        files.push(file);
    }
    Ok(files)
}

/// Writes every mode in motion: `modes_<speed>rpm_<number>.pvd` over the phase \[cycles\], with a .vtu for each of `frames`
/// phases of a cycle in the folder `modes_<speed>rpm`; returns the .pvd files.
///
/// The points themselves move, Re(u e^{2πj phase}) of the size of [`export_modes`]; field `displacement` is the motion.
///
/// # Errors
/// A file cannot be written.
pub fn export_mode_motion(
    results: &Results,
    machine: &Machine,
    frames: usize,
    folder: &Path,
) -> Result<Vec<PathBuf>, Error> {
    create_folder(folder)?;
    let grid = Grid::of_machine(&machine.model);
    let size = MODE_SHAPE_SIZE * extent(machine);
    let mut files = Vec::new();
    for found in &results.modal {
        let name = modes_name(found.speed);
        create_folder(&folder.join(&name))?;
        for (k, mode) in found.modes.iter().enumerate() {
            let fields = mode_fields(&grid, mode, size);
            let vectors =
                |name: &str| fields.iter().find(|field| field.name == name).map(|field| &field.values);
            let (Some(Values::Vectors(now)), Some(Values::Vectors(quarter))) =
                (vectors("displacement"), vectors("displacement_quarter"))
            else {
                continue;
            };
            let mut series = Vec::new();
            for frame in 0..frames {
                let phase = frame as f64 / frames as f64;
                let (sin, cos) = (std::f64::consts::TAU * phase).sin_cos();
                let moved: Vec<[f64; 3]> = now
                    .iter()
                    .zip(quarter)
                    .map(|(a, b)| std::array::from_fn(|i| cos * a[i] + sin * b[i]))
                    .collect();
                let points = grid.points.iter().zip(&moved);
                let points = points.map(|(p, u)| std::array::from_fn(|i| p[i] + u[i])).collect();
                let displaced = Grid { points, ..grid.clone() };
                let displacement = Field { name: "displacement".into(), values: Values::Vectors(moved) };
                let file = format!("{name}/mode_{:02}_{frame:03}.vtu", k + 1);
                let path = folder.join(&file);
                let bytes = to_binary_vtu(&displaced, &[displacement, part_field(&grid)])
                    .map_err(Error::of_file("write", &path))?;
                atomic_file::write_derived(&path, &bytes).map_err(Error::of_file("write", &path))?;
                series.push((phase, file));
            }
            let file = folder.join(format!("{name}_{:02}.pvd", k + 1));
            write_pvd(&file, &series)?;
            files.push(file);
        }
    }
    Ok(files)
}

fn modes_name(speed: f64) -> String {
    format!("modes_{:.0}rpm", speed * 60.0 / std::f64::consts::TAU)
}

/// Length of the shaft or of a rigid rotor \[m\].
fn extent(machine: &Machine) -> f64 {
    let z = &machine.model.node_z;
    let rotor = machine
        .model
        .rigid_rotor
        .as_ref()
        .map_or(0.0, |rotor| rotordyn_core::geometry::scene::disc_size(rotor).1);
    (z.last().copied().unwrap_or(0.0) - z.first().copied().unwrap_or(0.0)).max(rotor)
}

/// Largest turn of a part from frame to frame that viewers show in the right direction \[rad\].
const LARGEST_TURN: f64 = 0.9 * std::f64::consts::PI;

/// Writes the recorded motion of a machine: `motion.glb`, `slow_motion` times slower than the run, and `motion.pvd` with
/// a .vtu for every frame; returns both.
///
/// # Errors
/// Frames so far apart that a part makes half a turn between two, with the rate that would do; a file that cannot be written.
pub fn export_motion(
    motion: &Motion,
    model: &Model,
    slow_motion: f64,
    folder: &Path,
) -> Result<Vec<PathBuf>, Error> {
    create_folder(folder)?;
    let glb = folder.join("motion.glb");
    let turn = motion.largest_turn();
    if let [first, second, ..] = motion.time[..]
        && turn > LARGEST_TURN
    {
        let enough = turn / (second - first) / LARGEST_TURN;
        return Err(Error::of_file("write", &glb)(format!(
            "a part turns by {:.0} deg from frame to frame: record the run with a study.run_up.motion_rate of at least \
             {:.0} Hz",
            turn.to_degrees(),
            (enough / 10.0).ceil() * 10.0
        )));
    }
    let animated = AnimatedScene::of_motion(model, motion);
    gltf::write_animated(&glb, &animated, slow_motion)?;
    Ok(vec![glb, vtk_motion::export_motion(motion, &animated, model, folder)?])
}

fn mode_fields(grid: &Grid, mode: &Mode, size: f64) -> Vec<Field> {
    let part = |value: fn(&rotordyn_linalg::Complex64) -> f64| -> Vec<f64> {
        mode.full_shape.iter().map(value).collect()
    };
    let mut fields = machine_fields(grid, &part(|u| u.re), &[]);
    let mut quarter = machine_fields(grid, &part(|u| -u.im), &[]);
    // A mode shape has no ball loads.
    for list in [&mut fields, &mut quarter] {
        list.retain(|f| matches!(f.values, Values::Vectors(_)));
    }
    // Amplitude of every point over both phases; a rotation of 1 rad counts as the full size.
    let largest = |k: usize| {
        let both = [&fields[k], &quarter[k]].map(|f| match &f.values {
            Values::Vectors(v) => v.iter().map(|v| v.iter().map(|x| x * x).sum::<f64>()).collect(),
            Values::Scalars(_) => Vec::new(),
        });
        both[0].iter().zip(&both[1]).map(|(a, b)| (a + b).sqrt()).fold(0.0, f64::max)
    };
    let largest = largest(0).max(size * largest(1));
    let scale = if largest > 0.0 { size / largest } else { 1.0 };
    quarter.iter_mut().for_each(|f| f.name.push_str("_quarter"));
    fields.append(&mut quarter);
    for field in &mut fields {
        if let Values::Vectors(v) = &mut field.values {
            v.iter_mut().flatten().for_each(|x| *x = rounded(scale * *x));
        }
    }
    fields.push(part_field(grid));
    fields
}

fn create_folder(folder: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(folder).map_err(Error::of_file("create folder", folder))
}
