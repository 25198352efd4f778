//! Binary glTF 2.0 (.glb): named, coloured parts for any viewer, by serde_json and one binary buffer.

use std::path::Path;

use serde_json::{Value, json};

use crate::error::Error;
use rotordyn_core::geometry::scene_graph::{Material, Node, Scene};

const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The scene as the bytes of a .glb file (coordinates in single precision, as glTF demands).
pub fn to_glb(scene: &Scene) -> Vec<u8> {
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
    std::fs::write(path, to_glb(scene)).map_err(Error::of_file("write", path))
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
        self.view(start, ARRAY_BUFFER, accessor)
    }

    fn indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(triangles.iter().flatten().flat_map(|i| i.to_le_bytes()));
        let accessor = json!({
            "componentType": UNSIGNED_INT, "count": 3 * triangles.len(), "type": "SCALAR",
        });
        self.view(start, ELEMENT_ARRAY_BUFFER, accessor)
    }

    fn view(&mut self, start: usize, target: u32, mut accessor: Value) -> usize {
        accessor["bufferView"] = self.views.len().into();
        self.views.push(json!({
            "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start, "target": target,
        }));
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}
