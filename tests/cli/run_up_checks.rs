//! What a run-up says of itself: energy balance, instability, error by the step, names of cuts, and its exit code.

use super::{json_of, rotordyn};
use serde_json::Value;

/// A rigid rotor of 5 kg on two bearings; `more`: tables after the bearings.
fn rotor(bearings: [&str; 2], more: &str) -> String {
    format!(
        r#"
        [model]
        name = "rotor"
        gravity = "9.81 m/s^2"
        [rotor]
        centre = "100 mm"
        mass = "5 kg"
        polar_inertia = "0.01 kg m^2"
        diametral_inertia = "0.03 kg m^2"
        [station]
        A = "0 mm"
        D = "60 mm"
        B = "200 mm"
        [bearing.A]
        station = "A"
        {}
        [bearing.B]
        station = "B"
        {}
        [probe.Ay]
        at = "station.A"
        direction = "y"
        [probe.Bx]
        at = "station.B"
        direction = "x"
        quantity = "velocity"
        [probe.By]
        at = "station.B"
        direction = "y"
        quantity = "acceleration"
        {more}
        "#,
        bearings[0], bearings[1]
    )
}

const LINEAR: &str = "model = \"linear\"\nk_xx = \"2e6 N/m\"\nk_yy = \"3e6 N/m\"\nk_zz = \"1e6 N/m\"\n\
                      c_xx = \"150 N s/m\"\nc_yy = \"150 N s/m\"\n";
const CROSS_COUPLED: &str = "model = \"linear\"\nk_xx = \"1e7 N/m\"\nk_yy = \"1e7 N/m\"\nk_zz = \"1e7 N/m\"\n\
                             k_xy = \"3e6 N/m\"\nk_yx = \"-3e6 N/m\"\nc_xx = \"50 N s/m\"\nc_yy = \"50 N s/m\"\n";
const UNBALANCE: &str = "[unbalance.u]\nstation = \"D\"\nmagnitude = \"60 g mm\"\n";

/// The document of a command on a model; `exit`: its exit code.
fn document(text: &str, arguments: &[&str], exit: i32) -> Value {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.toml"), text).unwrap();
    let mut command = rotordyn();
    command.current_dir(folder.path()).args(arguments).args([
        "--json",
        "--quiet",
        "--no-figures",
        "--out",
        "out",
    ]);
    serde_json::from_slice(&command.assert().code(exit).get_output().stdout).unwrap()
}

/// What `run-up` prints for a model.
fn run_up_of(text: &str, exit: i32) -> std::process::Output {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.toml"), text).unwrap();
    let arguments = ["run-up", "model.toml", "--no-figures", "--out", "out"];
    rotordyn().current_dir(folder.path()).args(arguments).assert().code(exit).get_output().clone()
}

fn warnings<'a>(document: &'a Value, code: &str) -> Vec<&'a Value> {
    document["warnings"].as_array().unwrap().iter().filter(|w| w["code"] == code).collect()
}

fn speed(profile: &str, more: &str) -> String {
    format!("[speed]\nprofile = {profile}\n{more}")
}

/// A balanced rotor does not move but by round-off, of which no step is to blame: neither at constant speed nor in a ramp.
#[test]
fn round_off_is_no_error_of_the_step() {
    let ramp = speed("\"ramp\"\nfrom = \"2000 rpm\"\nto = \"14000 rpm\"\nramp = \"1 s\"", "[study.run_up]\n");
    let still = speed("\"constant\"\nspeed = \"600 rpm\"\nduration = \"1 s\"", "[study.run_up]\n");
    for more in [&ramp, &still] {
        let found = document(&rotor([LINEAR, LINEAR], more), &["run-up", "model.toml"], 0);
        for code in ["energy-balance", "time-step"] {
            assert!(warnings(&found, code).is_empty(), "{:?}", found["warnings"]);
        }
    }
    // With an unbalance the step matters.
    let coarse = ramp.replace("[study.run_up]", "[study.run_up]\nstep = \"500 us\"");
    let found =
        document(&rotor([LINEAR, LINEAR], &format!("{coarse}{UNBALANCE}")), &["run-up", "model.toml"], 0);
    assert!(!warnings(&found, "time-step").is_empty(), "{:?}", found["warnings"]);
}

/// Cross-coupled stiffness makes the forward whirl grow until the run diverges: the mode is named, and the totals of the energies
/// are those of one instant: what is left is the error of Newmark's steps, a few percent.
#[test]
fn divergence_names_the_unstable_mode() {
    let more = speed("\"constant\"\nspeed = \"3000 rpm\"\nduration = \"3 s\"", "[study.run_up]\n");
    let more = format!("{more}{UNBALANCE}");
    let found = document(&rotor([CROSS_COUPLED, CROSS_COUPLED], &more), &["run-up", "model.toml"], 3);
    let unstable = warnings(&found, "unstable-mode");
    assert_eq!(unstable.len(), 1, "{:?}", found["warnings"]);
    let text = unstable[0]["text"].as_str().unwrap();
    assert!(text.contains("3000 rpm") && text.contains("likely cause of the divergence"), "{text}");
    for open in warnings(&found, "energy-balance") {
        assert!(!open["advice"].as_str().unwrap().contains("reduce"), "{open}");
    }
    let energy = &found["run_up"]["energy_j"];
    let [residual, change] = ["residual", "stored_change"].map(|key| energy[key].as_f64().unwrap());
    assert!(change > 1.0 && residual.abs() < 0.1 * change, "{energy}");
}

/// Dormand-Prince's steps hold the energies at the default tolerance, on stiff contacts too; a coarse one is said to be so by the
/// keys that change it.
/// Probes along translation and rotation are translations, and only bearings with cages have cage angles; a short run says what
/// the estimate of its step's error needs.
#[test]
fn units_cages_and_length_of_a_short_run() {
    let probe = "[probe.mixed]\nat = \"station.A\"\ndirection = [0, 3, 0, 0.1, 0, 0]\nquantity = \"acceleration\"\n\
                 [probe.tilt]\nat = \"station.A\"\ndirection = [0, 0, 0, 1, 1, 0]\nquantity = \"acceleration\"\n[study.run_up]\n";
    let ball = "model = \"ball\"\ndesignation = \"6205\"\n";
    let text = rotor(
        [LINEAR, ball],
        &format!("{UNBALANCE}{}{probe}", speed("\"ramp\"\nto = \"600 rpm\"\nramp = \"0.1 s\"", "")),
    );
    let found = document(&text, &["run-up", "model.toml"], 0);
    let channels = found["run_up"]["channels"].as_array().unwrap();
    let unit = |name: &str| {
        channels
            .iter()
            .find(|channel| channel["name"] == name)
            .map(|channel| channel["unit"].as_str().unwrap())
    };
    assert_eq!(unit("mixed"), Some("m/s^2"));
    assert_eq!(unit("tilt"), Some("rad/s^2"));
    assert_eq!((unit("A_cage_angle"), unit("B_cage_angle")), (None, Some("rad")));

    let shown = String::from_utf8_lossy(&run_up_of(&text, 0).stdout).into_owned();
    assert!(shown.contains("no estimate of the step's error: it needs a run of 0.480 s"), "{shown}");
}

/// An explicit integrator with a step that is too long names itself.
#[test]
fn divergence_of_an_explicit_integrator_is_its_step() {
    let study = "[study.run_up]\nintegrator = \"rk4\"\nstep = \"500 us\"\n";
    let text = rotor(
        [LINEAR, LINEAR],
        &format!("{UNBALANCE}{}{study}", speed("\"ramp\"\nto = \"600 rpm\"\nramp = \"1 s\"", "")),
    )
    .replace("2e6 N/m", "2e9 N/m");
    let shown = String::from_utf8_lossy(&run_up_of(&text, 3).stderr).into_owned();
    for part in ["diverged", "explicit integrator rk4", "lower step", "leave out integrator"] {
        assert!(shown.replace("\n", " ").contains(part), "{part}: {shown}");
    }
}

/// Orders that the sampling rate does not take are bad input, before anything is computed.
#[test]
fn orders_beyond_the_sampling_rate_are_refused_before_the_run() {
    let study = "[study.run_up]\nsample_rate = \"100 Hz\"\n[study.orders]\nmax_order = 10\n";
    let text = rotor(
        [LINEAR, LINEAR],
        &format!("{UNBALANCE}{}{study}", speed("\"ramp\"\nto = \"600 rpm\"\nramp = \"5 s\"", "")),
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("model.toml"), text).unwrap();
    for command in ["check", "run"] {
        let run = rotordyn().current_dir(folder.path()).args([command, "model.toml"]).assert().code(2);
        let shown = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
        assert!(shown.contains("max_order") && shown.contains("sample_rate"), "{shown}");
    }
    assert!(!folder.path().join("out").exists());
}

#[test]
fn tolerance_of_error_control_holds_the_energies() {
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/models/jeffcott.toml");
    let arguments = |more: &'static str| ["run-up", model, "--integrator", "dormand-prince", "--set", more];
    let found = document("", &arguments("speed.ramp = \"0.4 s\""), 0);
    assert!(warnings(&found, "energy-balance").is_empty(), "{:?}", found["warnings"]);
    let more = [
        "--set",
        "study.run_up.relative_tolerance = 1e-2",
        "--set",
        "study.run_up.absolute_tolerance = \"1e-6 m\"",
    ];
    let arguments = [&arguments("speed.ramp = \"0.4 s\"")[..], &more].concat();
    for open in warnings(&document("", &arguments, 0), "energy-balance") {
        assert!(open["advice"].as_str().unwrap().contains("relative_tolerance"), "{open}");
    }
}

/// Two ball bearings of different size: cuts say the bearing, and checks of the step concern the channels that are asked for.
#[test]
fn cuts_of_two_bearings_are_named_by_them() {
    let ball = |balls: u32| {
        format!(
            "model = \"ball\"\nballs = {balls}\nball_diameter = \"9 mm\"\npitch_diameter = \"45 mm\"\n\
             inner_osculation = 0.515\nouter_osculation = 0.525\nradial_clearance = \"5 um\"\nball_inertia = \"none\"\n"
        )
    };
    let study = "[bushing.damp]\nbetween = [\"rotor\", \"ground\"]\nc_x = \"300 N s/m\"\nc_y = \"300 N s/m\"\n\
                 k_z = \"1e5 N/m\"\nc_z = \"300 N s/m\"\n[study.run_up]\nsample_rate = \"5 kHz\"\n[study.orders]\n\
                 resolution = 0.5\nmax_order = 8\ncuts = [1, \"A.BPFO\", \"B.BPFO\"]\nchannels = [\"Ay\"]\n";
    let more = speed("\"ramp\"\nfrom = \"1000 rpm\"\nto = \"6000 rpm\"\nramp = \"0.3 s\"", study);
    let labels = |bearings: [u32; 2], text: &str| {
        let [a, b] = bearings.map(ball);
        let found = document(&rotor([&a, &b], text), &["run", "model.toml"], 0);
        let cuts = found["orders"][0]["cuts"].as_array().unwrap();
        let names: Vec<String> = cuts.iter().map(|cut| cut["label"].as_str().unwrap().to_string()).collect();
        let lines = found["run_up"]["step_error"]["lines"].as_array().cloned().unwrap_or_default();
        assert!(!lines.is_empty() && lines.iter().all(|line| line["channel"] == "Ay"), "{lines:?}");
        names
    };
    let text = format!("{more}{UNBALANCE}");
    assert_eq!(labels([9, 8], &text), ["1x", "A.BPFO", "B.BPFO"]);
    let same = text.replace("\"A.BPFO\", \"B.BPFO\"", "\"BPFO\"");
    assert_eq!(labels([8, 8], &same), ["1x", "BPFO"]);
}

/// Too few revolutions for the cuts, which the speed profile says before the run.
#[test]
fn cuts_that_cannot_be_made_are_refused_before_the_run() {
    let study = "[study.run_up]\n[study.orders]\nresolution = 0.5\nmax_order = 8\ncuts = [1]\n";
    let more = speed("\"constant\"\nspeed = \"600 rpm\"\nduration = \"0.05 s\"", study);
    let found =
        document(&rotor([LINEAR, LINEAR], &format!("{more}{UNBALANCE}")), &["run-up", "model.toml"], 2);
    assert!(found["run_up"].is_null(), "{found}");
}

/// A bearing's lines stand where its cage turns, under an axial load 2 % above the nominal order: the level of "BPFO" is that
/// of the line which the record has, by the recorded cage angle, and not that of the gap beside it.
#[test]
fn order_cuts_of_bearings_follow_the_loaded_cage() {
    let ball = "model = \"ball\"\ndesignation = \"6205\"\nradial_clearance = \"20 um\"\n\
                defect = [{ kind = \"dent\", on = \"outer\", centre = \"270 deg\", width = \"0.5 mm\" }]";
    let linear = "model = \"linear\"\nk_xx = \"5e7 N/m\"\nk_yy = \"5e7 N/m\"\nc_xx = \"100 N s/m\"\nc_yy = \"100 N s/m\"";
    let more = "[load.axial]\nat = \"rotor\"\nforce = \"0, 0, 1500 N\"\n[probe.ay]\nat = \"rotor\"\ndirection = \"y\"\n\
                quantity = \"acceleration\"\n[speed]\nprofile = \"constant\"\nspeed = \"3000 rpm\"\nduration = \"1 s\"\n\
                [study.run_up]\nsample_rate = \"10 kHz\"\n[study.orders]\nchannels = [\"ay\"]\ncuts = [1, \"2 BPFO\"]\n";
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (folder.path().join("m.toml"), folder.path().join("out"));
    std::fs::write(&file, rotor([ball, linear], more)).unwrap();
    let mut run = rotordyn();
    json_of(run.arg("run-up").arg(&file).args(["--no-figures", "--out"]).arg(&out));
    // The loaded order by the statics of the bearing.
    let mut statics = rotordyn();
    let bearing = json_of(
        statics.arg("bearing").arg(&file).args(["--no-figures", "--out"]).arg(folder.path().join("b")),
    );
    let order = 2.0 * bearing["bearings"][0]["operating"]["bpfo"].as_f64().unwrap();
    let mut orders = rotordyn();
    let cuts = format!("2 BPFO,{order},7.1444");
    let document = json_of(orders.arg("orders").arg(&out).args(["--no-figures", "--orders", &cuts]));
    let found = document["orders"][0]["cuts"].as_array().unwrap();
    let level = |k: usize| {
        found[k]["rms"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).fold(0.0, f64::max)
    };
    assert!((found[0]["order"].as_f64().unwrap() - order).abs() < 1e-3, "{} {order}", found[0]["order"]);
    assert!((order - 7.1444).abs() > 0.05 && (level(0) / level(1) - 1.0).abs() < 0.01, "{found:?}");
    assert!(level(2) < 0.5 * level(0), "{found:?}");
}

/// A shaft that reverses under its drive is tracked both ways, and the highest order fits the speed that it reaches.
#[test]
fn driven_shafts_are_tracked_at_every_speed() {
    let linear = "model = \"linear\"\nk_xx = \"5e7 N/m\"\nk_yy = \"5e7 N/m\"\nc_xx = \"500 N s/m\"\nc_yy = \"500 N s/m\"";
    let windows = |from: &str, torque: &str, duration: &str| {
        let more = format!(
            "[drive]\nkind = \"torque\"\nstation = \"D\"\nspeed = \"-3600, 3600 rpm\"\ntorque = \"{torque}, {torque} N m\"\n\
             [unbalance.u]\nstation = \"D\"\nmagnitude = \"100 g mm\"\n\
             [speed]\nprofile = \"constant\"\nspeed = \"{from}\"\nduration = \"{duration}\"\n\
             [study.run_up]\nsample_rate = \"2 kHz\"\n[study.orders]\nchannels = [\"Ay\"]\ncuts = [1]\n"
        );
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("m.toml");
        std::fs::write(&file, rotor([linear; 2], &more)).unwrap();
        let mut run = rotordyn();
        let run = run.arg("run-up").arg(&file).args(["--no-figures", "--out"]).arg(folder.path().join("out"));
        let document = json_of(run);
        document["orders"][0]["cuts"][0]["speed_rpm"].as_array().unwrap().len()
    };
    // From 1200 rpm to as much backward; to 3400 rpm, where 20 orders would need 3 kHz.
    assert!(windows("1200 rpm", "-0.2", "12.5 s") >= 14 && windows("0 rpm", "1.2", "3 s") >= 10);
}
