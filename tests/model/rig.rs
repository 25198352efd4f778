//! `models/overhung_rig.toml` is the rig of `tests/data/rig.json`, number by number.

use rotordyn::analysis::modal;
use rotordyn::assembly::{Assembly, LinearSystem};
use rotordyn::bearing::{BallBearing, Bearing, Cage, SiteTangent};
use rotordyn::contact::ContactDamping;
use rotordyn::element::ShearCoefficient;
use rotordyn::model::{self, Drive, Model, Options, SpeedProfile};
use serde_json::Value;

fn rig(variant: Option<&str>) -> Model {
    let text = include_str!("../../models/overhung_rig.toml");
    let options = Options { variant: variant.map(String::from), ..Options::default() };
    model::load("overhung_rig.toml", text, &options).unwrap().model
}

fn reference() -> Value {
    serde_json::from_str(include_str!("../data/rig.json")).unwrap()
}

fn get(json: &Value, path: &str) -> f64 {
    json.pointer(path).unwrap_or_else(|| panic!("{path}")).as_f64().unwrap()
}

/// Equal up to two roundings: of the decimal digits and of the unit conversion.
#[track_caller]
fn same(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-14 * a.abs().max(b.abs()), "{a} {b}");
}

fn ball(model: &Model, name: &str) -> BallBearing {
    match model.bearings.iter().find(|b| b.name == name).map(|b| b.bearing.clone()) {
        Some(Bearing::Ball(ball)) => ball,
        other => panic!("{other:?}"),
    }
}

#[test]
fn shaft_stations_and_discs() {
    let (model, json) = (rig(None), reference());
    let steel = &model.materials[0];
    same(steel.young, get(&json, "/material/E"));
    same(steel.density, get(&json, "/material/rho"));
    same(steel.poisson, get(&json, "/material/nu"));
    same(model.node_z[0], get(&json, "/shaft/sections/0/z0"));
    same(model.node_z[model.node_z.len() - 1], get(&json, "/shaft/sections/0/z1"));
    let longest = get(&json, "/shaft/max_element_length") * (1.0 + 1e-9);
    for (k, e) in model.shaft.iter().enumerate() {
        assert!(e.length > 1e-3 && e.length <= longest);
        same(e.length, model.node_z[k + 1] - model.node_z[k]);
        same(e.outer_diameter[0], get(&json, "/shaft/sections/0/od"));
        assert_eq!(e.inner_diameter, [0.0; 2]);
        assert_eq!(e.shear, ShearCoefficient::Cowper);
        same(e.proportional_damping[1], get(&json, "/damping/shaft_stiffness_proportional_beta"));
    }
    for (name, path) in [("A", "bearing_A"), ("pulley", "pulley"), ("B", "bearing_B"), ("disc", "disc_cg")] {
        let station = model.stations.iter().find(|s| s.name == name).unwrap();
        same(station.z, get(&json, &format!("/stations/{path}")));
        same(model.node_z[station.node], station.z);
    }
    for (disc, path) in model.discs.iter().zip(["disc", "pulley"]) {
        same(disc.mass, get(&json, &format!("/{path}/mass")));
        same(disc.polar_inertia, get(&json, &format!("/{path}/Ip")));
        same(disc.diametral_inertia, get(&json, &format!("/{path}/It")));
        same(disc.outer_diameter, get(&json, &format!("/{path}/D")));
    }
}

#[test]
fn housings_belt_and_dampers() {
    let (model, json) = (rig(None), reference());
    assert_eq!(model.bodies.len(), 2);
    for (k, body) in model.bodies.iter().enumerate() {
        same(body.mass[1], get(&json, "/housing/each/mass"));
        same(body.inertia[1][1], get(&json, "/housing/each/J"));
        let bushing = &model.bushings[k];
        assert_eq!(bushing.a.node, Some(model.node_z.len() + k));
        assert_eq!((bushing.b.node, bushing.b.offset), (None, body.position));
        for (i, key) in ["kx", "ky", "kz", "k_tilt", "k_tilt"].iter().enumerate() {
            same(bushing.stiffness[i][i], get(&json, &format!("/housing/each/{key}")));
        }
        same(bushing.stiffness[5][5], 1e6);
        for (i, key) in ["cx", "cy", "cz"].iter().enumerate() {
            same(bushing.damping[i][i], get(&json, &format!("/housing/each/{key}")));
        }
        let site = &model.bearings[k];
        assert_eq!(site.housing.node, bushing.a.node);
        assert_eq!(site.housing.offset, [0.0; 3]);
    }
    let belt = &model.belts[0];
    assert_eq!(belt.pull, [get(&json, "/belt/static_tension_radial"), 0.0]);
    assert_eq!(belt.stiffness, [get(&json, "/belt/kx"), get(&json, "/belt/ky"), 0.0]);
    assert_eq!(belt.damping, [get(&json, "/belt/cx"), 0.0, 0.0]);
    let air = &model.bushings[2];
    assert_eq!(air.stiffness, [[0.0; 6]; 6]);
    same(air.damping[0][0], get(&json, "/damping/disc_cx_cy"));
    same(air.damping[2][2], get(&json, "/damping/disc_cz"));
    same(air.damping[5][5], get(&json, "/damping/disc_c_torsion"));
}

#[test]
fn bearings() {
    let json = reference();
    let at = |key: &str| get(&json, &format!("/bearing/catalogue/{key}"));
    for name in ["A", "B"] {
        let bearing = ball(&rig(None), name);
        let g = &bearing.geometry;
        assert_eq!(g.balls as f64, at("Z"));
        same(g.ball_diameter, at("ball_d"));
        same(g.pitch_diameter, at("pitch_d"));
        same(g.inner_groove_radius, at("groove_r_inner"));
        same(g.outer_groove_radius, at("groove_r_outer"));
        same(g.radial_clearance, at("radial_clearance_diametral"));
        assert_eq!(g.contact_angle, 0.0);
        let ContactDamping::Constant { coefficient, ramp } = bearing.damping else {
            panic!("the rig's contacts have constant damping")
        };
        same(coefficient, get(&json, "/bearing/contact_damping_per_ball"));
        same(ramp, get(&json, "/bearing/contact_damping_ramp"));
        assert_eq!((bearing.cage, bearing.cage_angle), (Cage::Rolling, 0.0));
        assert!(bearing.imperfections.inner_waviness.is_empty());
        let exact = ball(&rig(Some("exact_bpfo")), name).geometry;
        same(exact.pitch_diameter, get(&json, "/bearing/paper_exact_bpfo/pitch_d"));
        same(4.5 * (1.0 - exact.ball_diameter / exact.pitch_diameter), 3.55);
        for (variant, preset) in [
            ("clearance_5um", "C2_like"),
            ("clearance_20um", "C3"),
            ("clearance_33um", "C4"),
            ("interference", "light_interference"),
        ] {
            let clearance = ball(&rig(Some(variant)), name).geometry.radial_clearance;
            same(clearance, at(&format!("clearance_presets_diametral/{preset}")));
        }
    }
    // order lines by name: BPFO is the fourth of the Campbell study
    let orders = rig(None).studies.campbell.unwrap().orders;
    assert!((orders[3] - at("orders/BPFO")).abs() < 5e-5);
}

#[test]
fn unbalance_run_up_and_drive() {
    let (model, json) = (rig(None), reference());
    same(model.unbalances[0].magnitude, get(&json, "/unbalance/residual_G6_3_at_1200rpm/U"));
    assert_eq!(model.gravity, [0.0, get(&json, "/gravity/1"), 0.0]);
    let pulley = model.stations.iter().find(|s| s.name == "pulley").unwrap().node;
    assert_eq!(model.drive, Drive::Prescribed { node: Some(pulley) });
    let SpeedProfile::Ramp { from, to, settle, ramp, hold } = model.profile else { panic!() };
    same(to, get(&json, "/run_up/rpm_end") * std::f64::consts::PI / 30.0);
    let times = [get(&json, "/run_up/t_settle"), get(&json, "/run_up/t_ramp"), get(&json, "/run_up/t_hold")];
    assert_eq!(([settle, ramp, hold], from), (times, 0.0));
    let s = &model.studies;
    assert!(s.equilibrium.is_some() && s.modal.is_some() && s.campbell.is_some() && s.critical.is_some());
    assert!(s.frf.is_some() && s.unbalance.is_some() && s.run_up.is_some() && s.spectrogram.is_some());
    assert!(s.orders.as_ref().unwrap().resolution <= 0.05);
}

#[test]
fn joint_variants_connect_the_shaft_to_ground() {
    for (variant, tilts) in [("spherical", false), ("cylindrical", true)] {
        let model = rig(Some(variant));
        assert!(model.bodies.is_empty() && model.bearings.is_empty());
        assert_eq!(model.belts[0].stiffness, [0.0; 3]);
        let locked: Vec<[bool; 6]> = model.joints.iter().map(|j| j.locked).collect();
        let axial = |axially_locked| [true, true, axially_locked, tilts, tilts, false];
        assert_eq!(locked, [axial(false), axial(true)], "{variant}");
        for (joint, z) in model.joints.iter().zip([0.03, 0.38]) {
            same(model.node_z[joint.a.node.unwrap()], z);
            assert_eq!((joint.b.node, joint.b.offset), (None, [0.0, 0.0, z]));
        }
    }
}

#[test]
fn block_variant() {
    let (model, json) = (rig(Some("block")), reference());
    let block = &model.bodies[0];
    same(block.mass[1], get(&json, "/block_optional/mass"));
    same(-block.position[1], get(&json, "/block_optional/shaft_axis_above_cg"));
    same(block.position[2], get(&json, "/block_optional/cg_z"));
    let node = Some(model.node_z.len());
    let housings = model.bushings.iter().filter(|b| b.name.starts_with("housing")).collect::<Vec<_>>();
    for (bushing, z) in housings.into_iter().zip([0.03, 0.38]) {
        assert_eq!(bushing.b.node, node);
        same(bushing.b.offset[1], 0.23);
        same(bushing.b.offset[2], z - 0.27);
    }
    let mounts = model.bushings.iter().filter(|b| b.name.starts_with("mount")).collect::<Vec<_>>();
    assert_eq!(mounts.len(), 4);
    for (k, mount) in mounts.into_iter().enumerate() {
        assert_eq!((mount.a.node, mount.b.node), (node, None));
        for i in 0..3 {
            same(block.inertia[i][i], get(&json, &format!("/block_optional/J_xyz/{i}")));
            let arm = get(&json, &format!("/block_optional/mounts/{k}/r_from_cg/{i}"));
            assert!((mount.a.offset[i] - arm).abs() < 1e-15);
            let stiffness = get(&json, &format!("/block_optional/mounts/{k}/k/{i}"));
            same(mount.stiffness[i][i], stiffness);
            same(mount.damping[i][i], stiffness * get(&json, "/block_optional/c_over_k_s"));
        }
    }
}

#[test]
fn wavy_variant() {
    let model = rig(Some("wavy"));
    let (a, b) =
        (ball(&model, "A").imperfections.inner_waviness, ball(&model, "B").imperfections.inner_waviness);
    assert_eq!(a.iter().map(|w| w.order).collect::<Vec<_>>(), (2..=15).collect::<Vec<_>>());
    assert!(a.iter().all(|w| w.amplitude == 2e-6 / f64::from(w.order)));
    assert!(a.iter().zip(&b).all(|(a, b)| a.phase != b.phase && (0.0..7.0).contains(&a.phase)));
    assert_eq!(a, ball(&rig(Some("wavy")), "A").imperfections.inner_waviness);
}

/// With the bearing stiffnesses of the reference, the file's machine has the reference's frequencies.
#[test]
fn frequencies_with_the_given_bearing_stiffness() {
    let json = reference();
    let tangent = |name: &str| {
        let mut stiffness = [[0.0; 6]; 6];
        for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
            stiffness[i][j] = get(&json, &format!("/expected/bearing_K5_at_equilibrium/{name}/{i}/{j}"));
        }
        SiteTangent { stiffness, ..SiteTangent::default() }
    };
    let frequencies = |variant: Option<&str>, rpm: f64| {
        let assembly = Assembly::new(&rig(variant)).unwrap();
        let speed = rpm * std::f64::consts::PI / 30.0;
        let system = LinearSystem::new(&assembly, &[tangent("A"), tangent("B")], speed).unwrap();
        let modes = modal::undamped_modes(&assembly, &system, 16).unwrap();
        modes.iter().map(modal::Mode::frequency_hz).collect::<Vec<_>>()
    };
    let expected = |key: &str| {
        let list = json.pointer(&format!("/expected/{key}")).unwrap().as_array().unwrap();
        list.iter().map(|v| v.as_f64().unwrap()).collect::<Vec<_>>()
    };
    let near = |a: &f64, b: &f64| (a - b).abs() < 0.0105; // the reference is printed to 0.01 Hz
    for (key, rpm) in [("finite/0rpm", 0.0), ("finite/1200rpm", 1200.0)] {
        let ours = frequencies(None, rpm);
        for theirs in expected(key) {
            assert!(ours.iter().any(|hz| near(hz, &theirs)), "{key}: {theirs} is not in {ours:?}");
        }
    }
    let (ours, theirs) = (frequencies(Some("block"), 0.0), expected("finite_with_block_0rpm"));
    assert_eq!(theirs.len(), 16);
    assert!(ours.iter().zip(&theirs).all(|(a, b)| near(a, b)), "{ours:?}");
}
