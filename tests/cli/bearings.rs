//! `bearing` command: bearings of a machine, bearing-only files, all flags.

use crate::{json_of, output_of, rotordyn};
use serde_json::Value;

const RIG: &str = "models/overhung_rig.toml";
const ALONE: &str = "[model]\nname = \"spindle\"\n[bearing.front]\nmodel = \"ball\"\ndesignation = \"7206B\"\n\
                     thrust = \"+z\"\n";

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[test]
fn all_bearings_of_a_machine_at_their_static_loads() {
    let folder = tempfile::tempdir().unwrap();
    let document = json_of(rotordyn().args(["bearing", RIG, "--out"]).arg(folder.path()));
    assert_eq!((&document["command"], &document["exit_code"]), (&"bearing".into(), &0.into()));
    let bearings = document["bearings"].as_array().unwrap();
    assert_eq!(bearings.iter().map(|b| b["name"].as_str().unwrap()).collect::<Vec<_>>(), ["A", "B"]);
    // Total load: weight of rotor and pulley (17.5 kg without the housings) and 250 N belt tension along x.
    let total: Vec<f64> =
        (0..2).map(|k| bearings.iter().map(|b| numbers(&b["operating"]["load"])[k]).sum()).collect();
    assert!((total[0].abs() - 250.0).abs() < 25.0 && total[1] < -100.0, "{total:?}");
    for bearing in bearings {
        let of: Vec<&str> =
            bearing["sweeps"].as_array().unwrap().iter().map(|s| s["variable"].as_str().unwrap()).collect();
        assert_eq!(of, ["load", "cage_angle"]);
        assert!((bearing["nominal_orders"]["bpfo"].as_f64().unwrap() - 3.5722).abs() < 1e-4);
        for sweep in bearing["sweeps"].as_array().unwrap() {
            assert_eq!(sweep["points"].as_array().unwrap().len(), sweep["values"].as_array().unwrap().len());
        }
    }
    for figure in [
        "ball_loads",
        "contact_angles",
        "stiffness_over_load",
        "contacts_over_cage_angle",
        "displacement_over_cage_angle",
    ] {
        for extension in ["svg", "png"] {
            assert!(folder.path().join(format!("bearing_B_{figure}.{extension}")).exists(), "{figure}");
        }
    }
    let store = rotordyn::io::hdf5::Store::open(folder.path().join("results.h5")).unwrap();
    assert!(store.contains("/bearings/A/operating/stiffness") && store.contains("/meta"));
    let stored = store.read("/bearings/B/sweep_load/stiffness").unwrap();
    assert_eq!(stored.shape, [40, 5, 5]);
    let first = numbers(&bearings[1]["sweeps"][0]["points"][0]["stiffness"][0]);
    assert_eq!(&stored.data[..5], first.as_slice());
}

#[test]
fn bearing_only_file_under_a_given_load() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("spindle.toml");
    std::fs::write(&model, format!("{ALONE}ball_inertia = \"none\"\n")).unwrap();
    let mut command = rotordyn();
    command.arg("bearing").arg(&model).args(["--no-figures", "--out"]).arg(folder.path());
    let text = output_of(&mut command);
    for part in [
        "Bearing front at",
        "massless (as stated)",
        "a tenth of the dynamic load rating",
        "theta_y",
        "internal geometry estimated",
        "static safety s_0",
        "Loaded balls",
        "BPFI",
        "No speed sweep",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 120), "{text}");
    let given = |flags: &[&str]| {
        let mut command = rotordyn();
        command.arg("bearing").arg(&model).args(["--no-figures", "--out"]).arg(folder.path()).args(flags);
        json_of(&mut command)["bearings"][0].clone()
    };
    let flags =
        ["--load", "100, -200, 600 N", "--moment", "0, 1 N m", "--speed", "6000 rpm", "--cage-average"];
    let found = given(&[&flags[..], &["--sweep", "load=10 N .. 900 N", "--along", "z"]].concat());
    assert_eq!(numbers(&found["operating"]["load"]), [100.0, -200.0, 600.0, 0.0, 1.0]);
    let sweep = &found["sweeps"][0];
    let values = numbers(&sweep["values"]);
    assert_eq!((values[0], values[40], sweep["variable"].as_str()), (10.0, 900.0, Some("load")));
    assert_eq!(numbers(&sweep["points"][40]["load"])[2], 900.0);
    let pushed = given(&[
        "--sweep",
        "displacement=1 um .. 20 um",
        "--along",
        "z",
        "--constrain",
        "x,y,theta_x,theta_y",
    ]);
    let point = &pushed["sweeps"][0]["points"][40];
    assert_eq!(numbers(&point["displacement"]), [0.0, 0.0, 20e-6, 0.0, 0.0]);
    assert!(numbers(&point["load"])[2] > 0.0);
}

/// A pair has P, P_0, L_10 and s_0 of its double row, and the mark of its estimated geometry, in table, JSON and HDF5.
#[test]
fn ratings_of_a_pair_in_every_output() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("pair.toml");
    let text = "[model]\nname = \"pair\"\n[lubricant.oil]\ngrade = \"ISO VG 32\"\ntemperature = \"50 degC\"\n\
                [bearing.front]\nmodel = \"ball\"\ndesignation = \"7012AC\"\narrangement = \"face_to_face\"\n\
                row_spacing = \"18 mm\"\nlubricant = \"oil\"\n";
    std::fs::write(&model, text).unwrap();
    let run = |flags: &[&str]| {
        let mut command = rotordyn();
        command.arg("bearing").arg(&model).args(["--no-figures", "--speed", "8000 rpm", "--out"]);
        command.arg(folder.path()).args([
            "--load",
            "0, -1500, 2500 N",
            "--sweep",
            "cage_angle=0 deg .. 9 deg",
        ]);
        command.args(flags);
        command
    };
    let document = json_of(&mut run(&[]));
    let bearing = &document["bearings"][0];
    let of = |key: &str| bearing["operating"][key].as_f64().unwrap_or_else(|| panic!("{key}: {bearing}"));
    // 25 deg, F_a/F_r above e = 0.68: double row X_2 = 0.67, Y_2 = 1.41, static 1 and 0.76.
    let p = 0.67 * 1500.0 + 1.41 * 2500.0;
    assert!((of("equivalent_load") - p).abs() < 1e-6);
    assert!((of("static_equivalent_load") - (1500.0 + 0.76 * 2500.0)).abs() < 1e-6);
    let rating = |key: &str| bearing["rating"][key].as_f64().unwrap();
    assert!((of("basic_life") / (rating("dynamic") / p).powi(3) - 1.0).abs() < 1e-12);
    assert!((of("static_safety") * of("static_equivalent_load") / rating("static") - 1.0).abs() < 1e-12);
    let [ratio, required] = ["viscosity_ratio", "reference_viscosity"].map(of);
    // 32 mm2/s at 40 degC is about 20 at 50 degC.
    assert!((15e-6..24e-6).contains(&(ratio * required)), "{ratio} {required}");
    assert_eq!(of("contamination"), 0.5);
    let modified = of("life_modification") * of("reference_life");
    assert!((of("modified_life") / modified - 1.0).abs() < 1e-12);
    assert!(bearing["estimated_geometry"].as_str().unwrap().starts_with("estimated"));
    let store = rotordyn::io::hdf5::Store::open(folder.path().join("results.h5")).unwrap();
    for key in ["equivalent_load", "static_safety", "basic_life", "life_by_ball_loads", "contamination"] {
        let stored = store.read(&format!("/bearings/front/operating/{key}")).unwrap();
        assert_eq!(stored.data, [of(key)], "{key}");
    }
    let mark = store.attribute("/bearings/front", "estimated_geometry").unwrap();
    assert!(format!("{mark:?}").contains("estimated as for another contact angle"), "{mark:?}");
    let table = output_of(&mut run(&[]));
    for part in
        ["of the pair", "X 0.67", "Y 1.41", "s_0 = C_0/P_0", "kappa", "e_C 0.50", "geometry estimated"]
    {
        assert!(table.contains(part), "{part} is not in\n{table}");
    }
}

#[test]
fn invalid_flags_are_reported() {
    let fails_with = |flags: &[&str], part: &str| {
        let assert = rotordyn().args(["bearing", RIG, "--no-figures"]).args(flags).assert().code(2);
        let text = String::from_utf8_lossy(&assert.get_output().stderr).to_string();
        assert!(text.contains(part), "{part} is not in\n{text}");
    };
    fails_with(&["--bearing", "C"], "unknown ball bearing `C`");
    fails_with(&["--load", "1, 2 N"], "F_x, F_y, F_z");
    fails_with(&["--load", "1, 2, 3"], "unit");
    fails_with(&["--sweep", "weight"], "load, displacement, speed, cage_angle");
    fails_with(&["--sweep", "load=2 kN"], "load=\"0 N .. 2 kN\"");
    fails_with(&["--constrain", "up"], "theta_x");
    rotordyn().args(["bearing", "models/jeffcott.toml"]).assert().code(2);
}

/// A bearing-only file with free balls runs them under the given load, and maps their slip in every output; a file without
/// free balls is told what to change.
#[test]
fn skidding_map_of_a_bearing_alone() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("light.toml");
    let text = "[model]\nname = \"light\"\n[bearing.front]\nmodel = \"free_ball\"\ndesignation = \"6205\"\n\
                slip = \"centre\"\nfriction = 0.03\ndrag = { cage_moment = \"2e-5 N m s/rad\" }\n";
    std::fs::write(&model, text).unwrap();
    let flags = ["--load", "0, 0, 200 N", "--speed", "6000 rpm", "--sweep", "load", "--skidding"];
    let grid = ["--skidding-loads", "50, 200 N", "--skidding-speeds", "3000, 6000 rpm"];
    let mut command = rotordyn();
    command.arg("bearing").arg(&model).args(flags).args(grid).args(["--csv", "--out"]).arg(folder.path());
    let found = json_of(&mut command)["bearings"][0].clone();
    assert!(found["free_balls"]["slip"].is_number(), "{found}");
    let map = &found["skidding_map"];
    assert_eq!(numbers(&map["load_n"]), [50.0, 200.0]);
    assert_eq!((map["complete"].as_bool(), map["failures"].as_array().map(Vec::len)), (Some(true), Some(0)));
    let slip: Vec<f64> = map["slip"].as_array().unwrap().iter().flat_map(numbers).collect();
    println!("slip {slip:?}");
    assert!(slip.len() == 4 && slip.iter().all(|slip| slip.abs() < 0.02), "{slip:?}");
    assert_eq!(map["points"].as_array().map(Vec::len), Some(4));
    let store = rotordyn::io::hdf5::Store::open(folder.path().join("results.h5")).unwrap();
    assert_eq!(store.read("/bearings/front/skidding_map/slip").unwrap().data, slip);
    for extension in ["svg", "png"] {
        assert!(folder.path().join(format!("bearing_front_skidding.{extension}")).exists());
    }
    let tables = std::fs::read_dir(folder.path().join("csv")).unwrap();
    assert!(tables.flatten().any(|file| file.file_name().to_string_lossy().contains("skidding")));

    let text = std::fs::read_to_string(&model).unwrap();
    let (kinematic, _) = text.split_once("slip").unwrap();
    std::fs::write(&model, kinematic.replace("free_ball", "ball")).unwrap();
    let assert = rotordyn().arg("bearing").arg(&model).arg("--skidding").assert().code(2);
    let text = String::from_utf8_lossy(&assert.get_output().stderr).to_string();
    assert!(text.contains("bearing front model = \"free_ball\""), "{text}");
}

/// `run` computes `[study.bearing]` of a machine with the other studies.
#[test]
fn run_computes_the_bearing_study() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("small.toml");
    let bearing = |name: &str| {
        format!("[bearing.{name}]\nstation = \"{name}\"\nmodel = \"ball\"\ndesignation = \"6204\"\n")
    };
    let text = format!(
        "[model]\nname = \"small\"\n[material.steel]\nyoung = \"207 GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n\
         [lubricant.oil]\nviscosity = \"0.04 Pa s\"\npressure_viscosity = \"2e-8 1/Pa\"\n\
         [shaft]\nelement_length = \"40 mm\"\nsection = [{{ length = \"400 mm\", outer_diameter = \"20 mm\" }}]\n\
         [station]\nA = \"20 mm\"\nB = \"380 mm\"\n{}{}contact = \"film\"\n\
         [study.static]\n[study.bearing]\nbearings = \"B\"\nspeed = \"3000 rpm\"\nsweep = [\"speed\"]\n\
         loads = {{ from = \"1 N\", to = \"50 N\", count = 5 }}\n",
        bearing("A"),
        bearing("B")
    );
    std::fs::write(&model, text).unwrap();
    let mut command = rotordyn();
    command.arg("run").arg(&model).arg("--out").arg(folder.path());
    let document = json_of(&mut command);
    assert!(document["equilibrium"].is_object());
    // The bearings of the catalogue with estimated geometry are named in every document and results file.
    for name in ["A", "B"] {
        assert!(
            document["estimated_geometry"][name].as_str().unwrap().starts_with("estimated"),
            "{document}"
        );
    }
    let store = rotordyn::io::hdf5::Store::open(folder.path().join("results.h5")).unwrap();
    let mark = store.attribute("/meta", "estimated_geometry").unwrap();
    assert!(format!("{mark:?}").contains("A: estimated from published ratings"), "{mark:?}");
    drop(store);
    let text = output_of(rotordyn().arg("static").arg(&model).arg("--out").arg(folder.path()));
    assert!(text.contains("internal geometry of bearing A estimated"), "{text}");
    let bearing = &document["bearings"][0];
    assert_eq!(bearing["name"], "B");
    let of: Vec<&str> =
        bearing["sweeps"].as_array().unwrap().iter().map(|s| s["variable"].as_str().unwrap()).collect();
    assert_eq!(of, ["load", "speed"]);
    // Load: half the shaft's weight; the film thickness increases with speed.
    let weight = 7850.0 * std::f64::consts::PI * 1e-4 * 0.4 * 9.80665;
    assert!((numbers(&bearing["operating"]["load"])[1] / (-0.5 * weight) - 1.0).abs() < 1e-3);
    let points = bearing["sweeps"][1]["points"].as_array().unwrap();
    let film = |k: usize| points[k]["minimum_film"].as_f64().unwrap();
    assert!(film(0) == 0.0 && film(20) > 0.0 && film(40) > film(20));
    assert!(bearing["operating"]["modified_life"].as_f64().unwrap() > 0.0);
    assert!(folder.path().join("bearing_B_contacts_over_speed.png").exists());
}

/// EHL film: solved once, cached on disk, its pressure and thickness fields plotted and stored.
#[test]
fn ehl_film_is_solved_once_and_cached() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("filmed.toml");
    let text = "[model]\nname = \"filmed\"\n[lubricant.oil]\ngrade = \"ISO VG 68\"\ntemperature = \"50 degC\"\n\
                [bearing.front]\nmodel = \"ball\"\ndesignation = \"6205\"\ncontact = \"ehl\"\n\
                [bearing.front.ehl]\nloads = \"100, 1500 N\"\nspeeds = \"3, 8 m/s\"\nload_count = 3\n\
                speed_count = 2\npoints = 3\n";
    std::fs::write(&model, text).unwrap();
    let cache = folder.path().join("cache");
    let run = |out: &str| {
        let mut command = rotordyn();
        command.env("ROTORDYN_CACHE", &cache).arg("bearing").arg(&model);
        command.args(["--speed", "6000 rpm", "--load", "0, -800, 0 N", "--out"]).arg(folder.path().join(out));
        json_of(&mut command)
    };
    let first = run("first");
    let tables = || std::fs::read_dir(&cache).unwrap().count();
    assert_eq!(tables(), 2);
    let bearing = &first["bearings"][0];
    for (film, race) in bearing["films"].as_array().unwrap().iter().zip(["inner", "outer"]) {
        assert_eq!(film["race"], race);
        // ISO VG 68 at 50 degC, 3 m/s: some tenths of a micrometre.
        let central = film["central_film"].as_f64().unwrap();
        assert!((1e-7..2e-6).contains(&central), "{central:e}");
        assert!(film["minimum_film"].as_f64().unwrap() < central);
        let path = folder.path().join("first").join(format!("bearing_front_film_{race}.png"));
        assert!(path.exists(), "{}", path.display());
        let store = rotordyn::io::hdf5::Store::open(folder.path().join("first").join("results.h5")).unwrap();
        let pressure = store.read(&format!("/bearings/front/film_{race}/pressure")).unwrap();
        assert!(pressure.shape.len() == 2 && pressure.data.iter().copied().fold(0.0, f64::max) > 5e8);
    }
    // The contact law's film thickness is the solved one; the second run reads it from the cache.
    let inner = &bearing["operating"]["balls"].as_array().unwrap().iter().max_by(|a, b| {
        let load = |v: &Value| v["inner"]["load"].as_f64().unwrap();
        load(a).total_cmp(&load(b))
    });
    let law = inner.unwrap()["inner"]["film"].as_f64().unwrap();
    let solved = bearing["films"][0]["central_film"].as_f64().unwrap();
    // Grids of 3 and 5 points over the inlet.
    assert!((law / solved - 1.0).abs() < 0.02, "{law:e} {solved:e}");
    let again = run("again");
    assert_eq!(again["bearings"], first["bearings"]);
    assert_eq!(tables(), 2);
}

/// The film tables of the default grid come from stored films; central and minimum film of the contact law are those
/// of the solved fields in the same document.
#[test]
fn stored_and_solved_films_agree() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("filmed.toml");
    let text = "[model]\nname = \"filmed\"\n[lubricant.oil]\ngrade = \"ISO VG 100\"\ntemperature = \"60 degC\"\n\
                [bearing.b]\nmodel = \"ball\"\ndesignation = \"6308\"\ncontact = \"ehl\"\nradial_clearance = \"8 um\"\n\
                [bearing.b.ehl]\nloads = \"50, 3000 N\"\nspeeds = \"1, 6 m/s\"\n";
    std::fs::write(&model, text).unwrap();
    let mut command = rotordyn();
    command.env("ROTORDYN_CACHE", folder.path().join("cache")).arg("bearing").arg(&model);
    command.args(["--speed", "3000 rpm", "--load", "0, -2500, 0 N", "--no-figures", "--out"]);
    let found = json_of(command.arg(folder.path().join("out")));
    let bearing = &found["bearings"][0];
    for (film, race) in bearing["films"].as_array().unwrap().iter().zip(["inner", "outer"]) {
        let load = |ball: &Value| ball[race]["load"].as_f64().unwrap();
        let balls = bearing["operating"]["balls"].as_array().unwrap();
        let ball = balls.iter().max_by(|a, b| load(a).total_cmp(&load(b))).unwrap();
        for (law, solved, share) in [("film", "central_film", 0.007), ("minimum_film", "minimum_film", 0.035)]
        {
            let [law, solved] = [&ball[race][law], &film[solved]].map(|v| v.as_f64().unwrap());
            assert!((law / solved - 1.0).abs() < share, "{race} {law:e} {solved:e}");
        }
    }
}

#[test]
fn defects_are_reported_and_averaging_warns() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("worn.toml");
    let text = "[model]\nname = \"worn\"\n[bearing.b]\nmodel = \"ball\"\ndesignation = \"6205\"\n\
        defect = [{ kind = \"dent\", on = \"outer\", centre = \"0 deg\", width = \"0.5 mm\" }]\n";
    std::fs::write(&file, text).unwrap();
    let run = |more: &[&str]| {
        let mut command = rotordyn();
        command
            .arg("bearing")
            .arg(&file)
            .args(["--load", "500, 0, 0 N", "--no-figures", "--out"])
            .arg(folder.path())
            .args(more);
        let output = command.assert().success().get_output().clone();
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap())
    };
    let (report, warnings) = run(&[]);
    assert!(report.contains("races and balls: dent on outer race"), "{report}");
    assert!(!warnings.contains("as if it had no defects"), "{warnings}");
    let (_, warnings) = run(&["--cage-average"]);
    assert!(warnings.contains("(dent on outer race) is averaged"), "{warnings}");
}

/// `check` takes a file with bearings only, as `bearing` does; one with a bearing in its place is a machine without shaft.
#[test]
fn check_lists_bearings_without_a_machine() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("alone.toml");
    std::fs::write(&file, ALONE).unwrap();
    let document = json_of(rotordyn().arg("check").arg(&file));
    let bearing = &document["variants"][0]["bearings"][0];
    assert_eq!((&bearing["name"], &bearing["balls"]), (&"front".into(), &13.into()));
    let text = output_of(rotordyn().arg("check").arg(&file));
    assert!(text.contains("front") && text.contains("BPFO"), "{text}");
    std::fs::write(&file, format!("{ALONE}station = \"front\"\n")).unwrap();
    let output = rotordyn().arg("check").arg(&file).output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && errors.contains("no [shaft] table"), "{errors}");
}
