//! Binary glTF 2.0 (.glb): named, coloured parts for any viewer, by serde_json and one binary buffer.

use std::path::Path;

use serde_json::{Value, json};

use crate::animated_scene::AnimatedScene;
use crate::atomic_file;
use crate::error::Error;
use rotordyn_core::geometry::scene_graph::{Material, Node, Scene};

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The scene as the bytes of a .glb file (coordinates in single precision, as glTF demands).
pub fn to_glb(scene: &Scene) -> Vec<u8> {
    glb(scene, |_| None)
}

/// An animated scene as the bytes of a .glb file; a second of the motion takes `slow_motion` seconds, the first frame is
/// at 0.
///
/// Viewers turn parts the shorter way from frame to frame, which must be less than half a turn.
pub fn to_animated_glb(animated: &AnimatedScene, slow_motion: f64) -> Vec<u8> {
    glb(&animated.scene, |buffer| {
        let start = animated.time.first()?;
        let times: Vec<f64> = animated.time.iter().map(|t| (t - start) * slow_motion).collect();
        let input = buffer.values(&times, "SCALAR", true);
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for track in &animated.tracks {
            let moves = [
                ("translation", "VEC3", track.translation.as_flattened()),
                ("rotation", "VEC4", track.rotation.as_flattened()),
            ];
            for (path, kind, values) in moves {
                let output = buffer.values(values, kind, false);
                channels.push(json!({
                    "sampler": samplers.len(), "target": { "node": track.node, "path": path },
                }));
                samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
            }
        }
        let name = format!("motion, {slow_motion} times slower");
        Some(json!([{ "name": name, "samplers": samplers, "channels": channels }]))
    })
}

/// Writes an animated scene as .glb.
///
/// # Errors
/// [`Error::Environment`] when the file cannot be written.
pub fn write_animated(path: &Path, animated: &AnimatedScene, slow_motion: f64) -> Result<(), Error> {
    atomic_file::write_derived(path, &to_animated_glb(animated, slow_motion))
        .map_err(Error::of_file("write", path))
}

/// The bytes of a .glb file; `animations` appends what they need to the buffer.
fn glb(scene: &Scene, animations: impl FnOnce(&mut Buffer) -> Option<Value>) -> Vec<u8> {
    let mut buffer = Buffer::default();
    let meshes: Vec<Value> = scene
        .meshes
        .iter()
        .enumerate()
        .map(|(k, m)| {
            let position = buffer.vectors(&m.mesh.positions, true);
            let normal = buffer.vectors(&m.mesh.normals, false);
            let indices = buffer.indices(&m.mesh.triangles);
            json!({ "primitives": [{
                "attributes": { "POSITION": position, "NORMAL": normal },
                "indices": indices, "material": k, "mode": 4,
            }] })
        })
        .collect();
    let materials: Vec<Value> = scene.meshes.iter().map(|m| material(&m.material)).collect();
    let is_child = |k: usize| scene.nodes.iter().any(|n| n.children.contains(&k));
    let roots: Vec<usize> = (0..scene.nodes.len()).filter(|&k| !is_child(k)).collect();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": concat!("rotordyn ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "name": scene.name, "nodes": roots }],
        "nodes": scene.nodes.iter().map(node).collect::<Vec<_>>(),
    });
    if let Some(animations) = animations(&mut buffer) {
        document["animations"] = animations;
    }
    // glTF allows no empty arrays.
    if !meshes.is_empty() {
        document["meshes"] = meshes.into();
        document["materials"] = materials.into();
        document["accessors"] = buffer.accessors.into();
        document["bufferViews"] = buffer.views.into();
        document["buffers"] = json!([{ "byteLength": buffer.bytes.len() }]);
    }
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut chunks = chunk(b"JSON", &text);
    if !buffer.bytes.is_empty() {
        chunks.extend(chunk(b"BIN\0", &buffer.bytes));
    }
    let mut file = b"glTF".to_vec();
    file.extend(2u32.to_le_bytes());
    file.extend((12 + chunks.len() as u32).to_le_bytes());
    file.extend(chunks);
    file
}

/// Writes a scene as .glb.
///
/// # Errors
/// [`Error::Environment`] when the file cannot be written.
pub fn write(path: &Path, scene: &Scene) -> Result<(), Error> {
    atomic_file::write_derived(path, &to_glb(scene)).map_err(Error::of_file("write", path))
}

fn chunk(kind: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let mut out = (data.len() as u32).to_le_bytes().to_vec();
    out.extend(kind);
    out.extend(data);
    out
}

fn material(look: &Material) -> Value {
    let mut out = json!({
        "name": look.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": look.colour,
            "metallicFactor": look.metallic,
            "roughnessFactor": look.roughness,
        },
    });
    if look.colour[3] < 1.0 {
        out["alphaMode"] = "BLEND".into();
    }
    out
}

fn node(node: &Node) -> Value {
    let mut out = json!({ "name": node.name, "translation": node.translation, "rotation": node.rotation });
    if let Some(mesh) = node.mesh {
        out["mesh"] = mesh.into();
    }
    if !node.children.is_empty() {
        out["children"] = node.children.clone().into();
    }
    out
}

/// The binary chunk under construction, with its buffer views and accessors.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Appends vectors; returns their accessor. Positions must state their bounds.
    fn vectors(&mut self, vectors: &[[f64; 3]], bounds: bool) -> usize {
        let start = self.bytes.len();
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for v in vectors {
            for k in 0..3 {
                let x = v[k] as f32;
                low[k] = low[k].min(x);
                high[k] = high[k].max(x);
                self.bytes.extend(x.to_le_bytes());
            }
        }
        let mut accessor = json!({ "componentType": FLOAT, "count": vectors.len(), "type": "VEC3" });
        if bounds {
            accessor["min"] = json!(low);
            accessor["max"] = json!(high);
        }
        self.view(start, Some(ARRAY_BUFFER), accessor)
    }

    /// Appends numbers of animations; returns their accessor. Times must state their bounds.
    fn values(&mut self, values: &[f64], kind: &str, bounds: bool) -> usize {
        let start = self.bytes.len();
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for x in values.iter().map(|x| *x as f32) {
            (low, high) = (low.min(x), high.max(x));
            self.bytes.extend(x.to_le_bytes());
        }
        let components = match kind {
            "VEC4" => 4,
            "VEC3" => 3,
            _ => 1,
        };
        let count = values.len() / components;
        let mut accessor = json!({ "componentType": FLOAT, "count": count, "type": kind });
        if bounds {
            accessor["min"] = json!([low]);
            accessor["max"] = json!([high]);
        }
        self.view(start, None, accessor)
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(triangles.iter().flatten().flat_map(|i| i.to_le_bytes()));
        let accessor = json!({
            "componentType": UNSIGNED_INT, "count": 3 * triangles.len(), "type": "SCALAR",
        });
        self.view(start, Some(ELEMENT_ARRAY_BUFFER), accessor)
    }

    /// A view from `start` to the end; only vertices and indices have a target.
    fn view(&mut self, start: usize, target: Option<u32>, mut accessor: Value) -> usize {
        accessor["bufferView"] = self.views.len().into();
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.views.push(view);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}
