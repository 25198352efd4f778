//! Builds a model from a reference file of ROSS 3.1.0 results (schema ross-ref-1).

use rotordyn::bearing::{Bearing, LinearBearing, LinearBearingRow, LinearElement, SiteTangent};
use rotordyn::element::{Anchor, Disc, Material, ShaftElement, ShearCoefficient};
use rotordyn::model::{BearingSite, Damping, Drive, Model, SpeedProfile, Unbalance};
use serde_json::Value;
use std::path::Path;

/// Reads a JSON file below `tests/data`.
pub fn read(name: &str) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    serde_json::from_str(&text).unwrap()
}

/// Numbers of a JSON array.
pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

fn material(value: &Value) -> Material {
    Material {
        name: "steel".into(),
        young: number(&value["E"]),
        shear: number(&value["G"]),
        poisson: value["poisson"].as_f64().unwrap_or(0.3),
        density: number(&value["rho"]),
    }
}

/// A shaft element from ROSS's arguments; right diameters default to the left ones.
pub fn element(value: &Value, steel: &Value) -> ShaftElement {
    let at = |name: &str| value[name].as_f64();
    let flag = |name: &str| value[name].as_bool().unwrap_or(true);
    let method = value["shear_method"].as_str().or(value["shear_method_calc"].as_str());
    ShaftElement {
        length: number(&value["L"]),
        outer_diameter: [at("odl").unwrap(), at("odr").or(at("odl")).unwrap()],
        inner_diameter: [at("idl").unwrap(), at("idr").or(at("idl")).unwrap()],
        material: material(steel),
        shear: match (flag("shear_effects"), method) {
            (false, _) => ShearCoefficient::Rigid,
            (true, Some("hutchinson")) => ShearCoefficient::Hutchinson,
            (true, _) => ShearCoefficient::Cowper,
        },
        rotary_inertia: flag("rotary_inertia"),
        axial_force: at("axial_force").unwrap_or(0.0),
        torque: at("torque").unwrap_or(0.0),
        proportional_damping: [at("alpha").unwrap_or(0.0), at("beta").unwrap_or(0.0)],
        internal_viscous: 0.0,
        layers: Vec::new(),
    }
}

fn bearing(value: &Value, k: usize) -> BearingSite {
    let speeds = value.get("speed_table").filter(|v| v.is_array()).map(numbers);
    let entry = |name: &str, row: usize| match &value[name] {
        Value::Array(list) => number(&list[row]),
        other => number(other),
    };
    let table = speeds.unwrap_or(vec![0.0]);
    let matrix = |letter: char, row: usize| {
        let mut m = [[0.0; 6]; 6];
        for (i, j, axes) in [(0, 0, "xx"), (0, 1, "xy"), (1, 0, "yx"), (1, 1, "yy"), (2, 2, "zz")] {
            m[i][j] = entry(&format!("{letter}{axes}"), row);
        }
        m
    };
    let rows = table.iter().enumerate().map(|(row, &speed)| LinearBearingRow {
        speed,
        stiffness: matrix('k', row),
        damping: matrix('c', row),
    });
    assert!(value["n_link"].is_null(), "the reference files have grounded bearings only");
    BearingSite {
        name: format!("bearing {k}"),
        node: index(&value["n"]),
        housing: Anchor::GROUND,
        bearing: Bearing::Linear(LinearBearing { table: rows.collect(), ..Default::default() }),
    }
}

/// The model of a reference file.
pub fn model(case: &Value) -> Model {
    let list = |name: &str| case[name].as_array().cloned().unwrap_or_default();
    let shaft: Vec<ShaftElement> = list("shaft_elements")
        .iter()
        .map(|e| element(e, &case["materials"][e["material"].as_str().unwrap()]))
        .collect();
    let mut node_z = vec![0.0];
    for e in &shaft {
        node_z.push(node_z.last().unwrap() + e.length);
    }
    let discs = list("discs");
    let unbalances = case["results"]["unbalance"]["unbalance"].as_array().cloned().unwrap_or_default();
    Model {
        name: case["name"].as_str().unwrap_or("case").into(),
        title: String::new(),
        gravity: [0.0, -9.80665, 0.0],
        materials: Vec::new(),
        node_z,
        shaft,
        rigid_rotor: None,
        stations: Vec::new(),
        discs: discs
            .iter()
            .map(|d| Disc {
                name: "disc".into(),
                node: index(&d["n"]),
                mass: number(&d["m"]),
                polar_inertia: number(&d["Ip"]),
                diametral_inertia: number(&d["Id"]),
                outer_diameter: 0.0,
                thickness: 0.0,
            })
            .collect(),
        bodies: Vec::new(),
        masses: Vec::new(),
        bushings: Vec::new(),
        joints: Vec::new(),
        bearings: list("bearings").iter().enumerate().map(|(k, b)| bearing(b, k)).collect(),
        belts: Vec::new(),
        unbalances: unbalances
            .iter()
            .map(|u| Unbalance {
                name: "unbalance".into(),
                node: index(&u["node"]),
                magnitude: number(&u["magnitude"]),
                phase: number(&u["phase"]),
            })
            .collect(),
        loads: Vec::new(),
        damping: Damping::default(),
        drive: Drive::Prescribed { node: None },
        profile: SpeedProfile::Constant { speed: 0.0, duration: 1.0 },
        probes: Vec::new(),
        studies: Default::default(),
    }
}

/// Tangents of a model's linear bearings at a speed.
pub fn tangents(model: &Model, speed: f64) -> Vec<SiteTangent> {
    model
        .bearings
        .iter()
        .map(|site| match &site.bearing {
            Bearing::Linear(b) => LinearElement::new(b).tangent(speed),
            _ => panic!("the reference files have linear bearings only"),
        })
        .collect()
}
