//! The .glb export read back by an independent minimal reader of the glTF specification.

use crate::agree;
use rotordyn::geometry::BearingShapes;
use rotordyn::geometry::scene_graph::Scene;
use rotordyn::io::gltf::to_glb;
use serde_json::Value;

use crate::bearing::rig_6205;

/// Header and the two chunks: the JSON document and the binary buffer.
fn parse(file: &[u8]) -> (Value, Vec<u8>) {
    let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(&file[0..4], b"glTF");
    assert_eq!(word(4), 2);
    assert_eq!(word(8), file.len());
    let json = word(12);
    assert_eq!((&file[16..20], json % 4), (&b"JSON"[..], 0));
    let binary = 20 + json;
    assert_eq!(&file[binary + 4..binary + 8], b"BIN\0");
    assert_eq!(binary + 8 + word(binary), file.len());
    (serde_json::from_slice(&file[20..binary]).unwrap(), file[binary + 8..].to_vec())
}

/// The numbers of an accessor as stored.
fn numbers(document: &Value, binary: &[u8], accessor: &Value) -> Vec<f64> {
    let accessor = &document["accessors"][accessor.as_u64().unwrap() as usize];
    let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    let length = view["byteLength"].as_u64().unwrap() as usize;
    let width = if accessor["type"] == "VEC3" { 3 } else { 1 };
    assert_eq!(accessor["count"].as_u64().unwrap() as usize * width * 4, length);
    let float = accessor["componentType"] == 5126;
    binary[start..start + length]
        .chunks(4)
        .map(|b| {
            let b = b.try_into().unwrap();
            if float { f64::from(f32::from_le_bytes(b)) } else { f64::from(u32::from_le_bytes(b)) }
        })
        .collect()
}

#[test]
fn bearing_part_names_positions_and_meshes() {
    let bearing = rig_6205();
    let shapes = BearingShapes::new(&bearing.geometry, bearing.cage_pocket_diameter);
    let at = shapes.centred(0.1);
    let (document, binary) = parse(&to_glb(&Scene::of_bearing("A", &shapes, &at)));
    assert_eq!(document["buffers"][0]["byteLength"].as_u64().unwrap() as usize, binary.len());

    let nodes = document["nodes"].as_array().unwrap();
    let names: Vec<&str> = nodes.iter().map(|n| n["name"].as_str().unwrap()).collect();
    assert_eq!(names[..5], ["A", "inner ring", "outer ring", "cage", "ball 1"]);
    assert_eq!(names.len(), 4 + 9);
    assert_eq!(document["scenes"][0]["nodes"], serde_json::json!([0]));
    assert_eq!(nodes[0]["children"].as_array().unwrap().len(), 12);
    for (j, ball) in at.balls.iter().enumerate() {
        for k in 0..3 {
            // serde_json reads numbers to within one unit in the last place.
            agree::absolute(
                "position of a ball in glTF [m]",
                nodes[4 + j]["translation"][k].as_f64().unwrap(),
                ball[k],
                1e-17,
            );
        }
    }

    // Every vertex within its stated bounds, every index within its vertices, every normal of unit length
    // and on the same side as its triangle.
    for mesh in document["meshes"].as_array().unwrap() {
        let primitive = &mesh["primitives"][0];
        let attributes = &primitive["attributes"];
        let positions = numbers(&document, &binary, &attributes["POSITION"]);
        let normals = numbers(&document, &binary, &attributes["NORMAL"]);
        let indices = numbers(&document, &binary, &primitive["indices"]);
        let accessor = &document["accessors"][attributes["POSITION"].as_u64().unwrap() as usize];
        let at =
            |data: &[f64], i: usize| nalgebra::Vector3::new(data[3 * i], data[3 * i + 1], data[3 * i + 2]);
        for i in 0..positions.len() / 3 {
            for k in 0..3 {
                let x = positions[3 * i + k];
                assert!(x >= accessor["min"][k].as_f64().unwrap() - 1e-9);
                assert!(x <= accessor["max"][k].as_f64().unwrap() + 1e-9);
            }
            agree::absolute("length of a normal in glTF", at(&normals, i).norm(), 1.0, 1e-6);
        }
        for triangle in indices.chunks(3) {
            let [a, b, c] = [0, 1, 2].map(|k| triangle[k] as usize);
            let p = [a, b, c].map(|i| at(&positions, i));
            let facet = (p[1] - p[0]).cross(&(p[2] - p[0]));
            let mean = [a, b, c].map(|i| at(&normals, i)).iter().sum::<nalgebra::Vector3<f64>>();
            assert!(facet.dot(&mean) > 0.9 * facet.norm() * mean.norm(), "{facet} {mean}");
        }
    }
}
