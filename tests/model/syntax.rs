//! Syntax of a model file, item by item.

use rotordyn::bearing::{Bearing, Cage};
use rotordyn::model::study::Integrator;
use rotordyn::model::{self, Drive, Kind, LoadFactor, Model, Options, Quantity, SpeedProfile};

const HEAD: &str = r#"
[model]
name = "test"
[material.steel]
young = "200 GPa"
poisson = 0.25
density = "8000 kg/m^3"
[shaft]
element_length = "100 mm"
section = [
    { length = "0.3 m", outer_diameter = "20 mm" },
    { to = "0.5 m", outer_diameter = "20 mm", outer_diameter_end = "40 mm", inner_diameter = "10 mm", shear = 0.9 },
]
[station]
A = "0 m"
M = "0.35 m"
B = "0.5 m"
[bearing.A]
model = "linear"
station = "A"
k_xx = "1e7 N/m"
"#;

fn load_with(text: &str, options: &Options) -> Model {
    model::load("test.toml", format!("{HEAD}{text}"), options).unwrap_or_else(|e| panic!("{e}")).model
}

fn load(text: &str) -> Model {
    load_with(text, &Options::default())
}

#[test]
fn mesh_has_nodes_at_stations_and_section_ends() {
    let model = load("");
    let expected = [0.0, 0.1, 0.2, 0.3, 0.35, 0.425, 0.5];
    assert_eq!(model.node_z.len(), expected.len());
    assert!(model.node_z.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15));
    assert_eq!(model.stations.iter().map(|s| s.node).collect::<Vec<_>>(), [0, 4, 6]);
    let cone = &model.shaft[4];
    assert!(
        (cone.outer_diameter[0] - 0.025).abs() < 1e-15 && (cone.outer_diameter[1] - 0.0325).abs() < 1e-15
    );
    assert_eq!(cone.inner_diameter, [0.01; 2]);
    assert_eq!(model.materials[0].shear, 80e9);
}

/// Shaft of 0.3 m and a frustum: G 2.5 mm/s at 100 rad/s gives U = m 25 µm with the mass of both.
#[test]
fn balance_grade_takes_the_rotor_mass() {
    let text = "[unbalance.u]\nstation = \"M\"\ngrade = \"G2.5\"\nspeed = \"100 rad/s\"\nphase = \"90 deg\"";
    let unbalance = &load(text).unbalances[0];
    let frustum = (0.02_f64.powi(2) + 0.02 * 0.04 + 0.04_f64.powi(2)) / 3.0 - 1e-4;
    let mass = 8000.0 * std::f64::consts::FRAC_PI_4 * (0.3 * 4e-4 + 0.2 * frustum);
    assert!((unbalance.magnitude - mass * 25e-6).abs() < 1e-15);
    assert!((unbalance.phase - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    let bolt = load("[unbalance.u]\nstation = \"M\"\nmass = \"5 g\"\nradius = \"120 mm\"");
    assert!((bolt.unbalances[0].magnitude - 6e-4).abs() < 1e-18);
}

#[test]
fn linear_bearing_over_speed() {
    let text = r#"
[bearing.B]
model = "linear"
station = "B"
speed = "0, 1000, 3000 rpm"
k_xx = "1e7, 1.2e7, 2e7 N/m"
k_xy = "-1e6 N/m"
k_txtx = "100 N m/rad"
k_xty = "5 N"
c_yy = ["100 N s/m", "0.2 N s/mm", "300 N s/m"]
"#;
    let model = load(text);
    let Bearing::Linear(bearing) = &model.bearings[1].bearing else { panic!() };
    assert_eq!(bearing.table.len(), 3);
    let row = &bearing.table[1];
    assert!((row.speed - 1000.0 * std::f64::consts::PI / 30.0).abs() < 1e-12);
    assert_eq!((row.stiffness[0][0], row.stiffness[0][1], row.stiffness[1][0]), (1.2e7, -1e6, 0.0));
    assert_eq!((row.stiffness[3][3], row.stiffness[0][4], row.damping[1][1]), (100.0, 5.0, 200.0));
    let whole =
        "[bushing.b]\nbetween = [\"B\", \"ground\"]\nstiffness_si = [[1, 2, 0, 0, 0, 0], [2, 5, 0, 0, 0, 0],
        [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 1]]";
    assert_eq!(load(whole).bushings[0].stiffness[1], [2.0, 5.0, 0.0, 0.0, 0.0, 0.0]);
}

#[test]
fn ball_bearing_fields_override_the_catalogue() {
    let text = r#"
[bearing.B]
model = "ball"
station = "B"
designation = "7206b"
thrust = "-z"
balls = 11
inner_osculation = 0.515
contact_angle = "30 deg"
cage = 0.41
cage_angle = "10 deg"
outer_waviness = [{ order = 3, amplitude = "1 um", phase = "90 deg" }, { order = 5, amplitude = "0.2 um" }]
"#;
    let model = load(text);
    let Bearing::Ball(ball) = &model.bearings[1].bearing else { panic!() };
    let g = &ball.geometry;
    assert_eq!((g.balls, g.bore, g.outside_diameter, g.width), (11, 0.030, 0.062, 0.016));
    assert!((g.inner_groove_radius / g.ball_diameter - 0.515).abs() < 1e-15);
    assert!((g.outer_groove_radius / g.ball_diameter - 0.53).abs() < 1e-15);
    assert!((g.contact_angle.to_degrees() - 30.0).abs() < 1e-12);
    assert_eq!((g.radial_clearance, g.thrust_direction, ball.cage), (0.0, -1.0, Cage::Ratio(0.41)));
    assert_eq!((ball.imperfections.outer_waviness.len(), ball.imperfections.outer_waviness[1].order), (2, 5));
    assert!(ball.cage_pocket_diameter > g.ball_diameter);

    let plain =
        load("[bearing.B]\nmodel = \"ball\"\nstation = \"B\"\ndesignation = \"6205\"\nclearance = \"C3\"");
    let Bearing::Ball(ball) = &plain.bearings[1].bearing else { panic!() };
    // ISO 5753-1, bore 25 mm, C3: 13 to 28 um
    assert!((ball.geometry.radial_clearance - 20.5e-6).abs() < 1e-20);
}

#[test]
fn bearing_offset_in_its_housing() {
    let text = r#"
[housing.H]
station = "B"
offset = "0, -50, 10 mm"
mass = "1 kg"
inertia = "1, 2, 3 g m^2"
inertia_products = "0.1, 0, 0 g m^2"
k_x = "1e6 N/m"
k_y = "1e6 N/m"
k_z = "1e6 N/m"
k_tilt_x = "1e3 N m/rad"
k_tilt_y = "2e3 N m/rad"
k_spin = "1e3 N m"
[bearing.B]
model = "ball"
station = "B"
housing = "H"
designation = "6205"
[sensor.s]
at = "H"
offset = "0, 60, 0 mm"
mass = "20 g"
"#;
    let model = load(text);
    assert_eq!(model.bodies[0].position, [0.0, -0.05, 0.51]);
    assert!((model.bodies[0].inertia[0][1] - 1e-4).abs() < 1e-19);
    let housing = model.bearings[1].housing;
    assert_eq!(housing.node, Some(7));
    assert!((housing.offset[1] - 0.05).abs() < 1e-15 && (housing.offset[2] + 0.01).abs() < 1e-15);
    assert_eq!((model.bushings[0].stiffness[3][3], model.bushings[0].stiffness[4][4]), (1e3, 2e3));
    assert_eq!((model.masses[0].anchor.node, model.masses[0].mass), (Some(7), [0.02; 3]));
}

#[test]
fn loads_drive_profile_and_damping() {
    let text = r#"
[load.kick]
at = "M"
force = "0, -10, 0 N"
moment = "1, 0, 0 N m"
time = "0, 1, 2 ms"
factor = [0, 1, 0]
[drive]
kind = "torque"
station = "A"
speed = "0, 100 rad/s"
torque = "10, 5 N m"
drag = "0.01 N m s/rad"
[speed]
profile = "table"
time = "0, 1, 5 s"
speed = ["0 rpm", "600 rpm", "10 Hz"]
[damping]
mass = "0.5 1/s"
stiffness = "10 us"
[damping.modal]
frequency = "20, 50 Hz"
ratio = ["1 %", "0.5 %"]
"#;
    let model = load(text);
    assert_eq!(model.loads[0].force, [0.0, -10.0, 0.0, 1.0, 0.0, 0.0]);
    assert_eq!(model.loads[0].factor, LoadFactor::Table(vec![[0.0, 0.0], [1e-3, 1.0], [2e-3, 0.0]]));
    let torque = Drive::Torque { node: 0, table: vec![[0.0, 10.0], [100.0, 5.0]], drag: 0.01 };
    assert_eq!(model.drive, torque);
    let SpeedProfile::Table { points } = &model.profile else { panic!() };
    assert!((points[1][1] - points[2][1]).abs() < 1e-12);
    assert_eq!(model.damping.proportional, [0.5, 1e-5]);
    assert_eq!(model.damping.modal, [[20.0, 0.01], [50.0, 0.005]]);
}

/// Loads have random courses of their own, unless they have the same seed.
#[test]
fn random_loads() {
    let load_of =
        |name: &str, more: &str| format!("[load.{name}]\nat = \"M\"\nforce = \"1, 0, 0 N\"\n{more}\n");
    let band = "band = \"5, 500 Hz\"";
    let seeded = format!("{band}\nseed = 3");
    let text =
        [("a", band), ("b", band), ("c", &seeded), ("d", &seeded)].map(|(name, more)| load_of(name, more));
    let model = load(&text.concat());
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| model.loads[k].factor.at(0.1));
    assert!(a != b && a != c && c == d, "{a} {b} {c} {d}");
    assert!(model.loads.iter().all(|load| matches!(load.factor, LoadFactor::Random(_))));
    for (more, expected) in [
        ("band = \"5 Hz\"", "no frequency band"),
        ("band = \"500, 5 Hz\"", "no frequency band"),
        (
            "band = \"5, 500 Hz\"\ntime = \"0, 1 s\"\nfactor = [0, 1]",
            "a random course (band) and one over time",
        ),
        ("seed = 3", "band is missing"),
    ] {
        let text = format!("{HEAD}{}", load_of("a", more));
        let found = model::load("test.toml", text, &Options::default()).unwrap_err();
        assert!(found.to_string().contains(expected), "{more}: {found}");
    }
}

#[test]
fn studies_and_probes() {
    let text = r#"
[probe.slant]
at = "M"
direction = [3, 4, 0]
[probe.twist]
at = "M"
direction = "-tz"
quantity = "velocity"
[study.frf]
frequencies = { from = "1 Hz", to = "100 Hz", count = 3, spacing = "log" }
quantity = "mobility"
responses = ["twist"]
excitation.hit = { at = "station.M", direction = "y" }
[study.run_up]
integrator = "dormand-prince"
relative_tolerance = 1e-7
[speed]
profile = "constant"
speed = "10 Hz"
duration = "2 s"
"#;
    let model = load(text);
    assert_eq!(model.probes[0].direction, [0.6, 0.8, 0.0, 0.0, 0.0, 0.0]);
    let frf = model.studies.frf.unwrap();
    assert!((frf.frequencies[1] - 10.0).abs() < 1e-12);
    assert_eq!((frf.responses.len(), frf.responses[0].quantity), (1, Quantity::Velocity));
    assert_eq!(frf.responses[0].direction[5], -1.0);
    let run_up = model.studies.run_up.unwrap();
    let method = Integrator::DormandPrince { relative_tolerance: 1e-7, absolute_tolerance: 1e-12 };
    assert_eq!((run_up.integrator, run_up.cutoff), (method, f64::INFINITY));
}

#[test]
fn set_reaches_every_kind_of_path() {
    let set = |path: &str, value: &str| {
        load_with("", &Options { set: vec![(path.into(), value.into())], ..Options::default() })
    };
    assert_eq!(set("material.steel.young", "100 GPa").materials[0].young, 100e9);
    assert_eq!(set("material.steel.young", "\"100 GPa\"").materials[0].young, 100e9);
    assert_eq!(set("material.steel.poisson", "0.3").materials[0].poisson, 0.3);
    assert_eq!(set("shaft.section.0.outer_diameter", "30 mm").shaft[0].outer_diameter, [0.03; 2]);
    assert_eq!(set("damping.mass", "2 1/s").damping.proportional[0], 2.0);
    assert_eq!(
        set("study.modal.speeds", "[\"0 rpm\", \"1 rad/s\"]").studies.modal.unwrap().speeds,
        [0.0, 1.0]
    );
}

/// `[shaft]` needs no material and no element length where every section and layer has its own.
#[test]
fn sections_may_have_all_their_properties_themselves() {
    let section = |young: &str, rest: &str| {
        format!(
            "[material.{young}]\nyoung = \"{young} GPa\"\npoisson = 0.3\ndensity = \"7850 kg/m^3\"\n[[shaft.{rest}]]\nlength = \"300 mm\"\nmaterial = \"{young}\"\nelement_length = \"100 mm\"\n"
        )
    };
    let text = format!(
        "[model]\nname = \"parts\"\n{}outer_diameter = \"25 mm\"\n{}outer_diameter = \"30 mm\"\n{}from = \"0 mm\"\n\
         outer_diameter = \"40 mm\"\ninner_diameter = \"25 mm\"\n",
        section("210", "section"),
        section("70", "section"),
        section("105", "layer")
    );
    let model = model::load("parts.toml", &text, &Options::default()).unwrap().model;
    let moduli: Vec<f64> = model.shaft.iter().map(|element| element.material.young / 1e9).collect();
    assert_eq!(moduli, [210.0, 210.0, 210.0, 70.0, 70.0, 70.0]);
    assert_eq!(model.shaft[0].layers[0].material.young, 105e9);
    let missing = text.replacen("material = \"70\"\n", "", 1);
    let errors = model::load("parts.toml", &missing, &Options::default()).unwrap_err().to_string();
    assert!(errors.contains("shaft.material is missing"), "{errors}");
}

#[test]
fn variants_build_on_each_other_and_set_comes_last() {
    let text = r#"
[variant.soft]
bearing.A.k_xx = "1e6 N/m"
station.C = "0.2 m"
[variant.softer]
based_on = "soft"
remove = ["station.M"]
bearing.A = { k_xx = "1e5 N/m", k_yy = "3 N/m" }
"#;
    assert_eq!(model::variants(&format!("{HEAD}{text}")), ["soft", "softer"]);
    let stiffness = |variant: Option<&str>, set: &[(&str, &str)]| {
        let set = set.iter().map(|(p, v)| (p.to_string(), v.to_string())).collect();
        let model = load_with(text, &Options { variant: variant.map(String::from), set });
        let Bearing::Linear(bearing) = &model.bearings[0].bearing else { panic!() };
        let names: String = model.stations.iter().map(|s| s.name.as_str()).collect();
        (bearing.table[0].stiffness[0][0], bearing.table[0].stiffness[1][1], names)
    };
    assert_eq!(stiffness(None, &[]), (1e7, 0.0, "AMB".into()));
    assert_eq!(stiffness(Some("soft"), &[]), (1e6, 0.0, "AMBC".into()));
    assert_eq!(stiffness(Some("softer"), &[("bearing.A.k_xx", "7 N/m")]), (7.0, 3.0, "ABC".into()));
}

#[test]
fn poissons_ratio_is_in_range_when_it_follows_from_the_shear_modulus() {
    let with = |line: &str| {
        let loaded = model::load("test.toml", HEAD.replace("poisson = 0.25", line), &Options::default());
        loaded.map(|loaded| loaded.model).map_err(|errors| errors.diagnostics[0].kind)
    };
    let poisson = |line: &str| with(line).unwrap().materials[0].poisson;
    assert_eq!(poisson("shear = \"80 GPa\""), 0.25);
    assert!((poisson("shear = \"66.6667 GPa\"") - 0.5).abs() < 1e-6);
    assert_eq!(with("shear = \"60 GPa\"").unwrap_err(), Kind::OutOfRange);
    assert_eq!(with("shear = \"11000 GPa\"").unwrap_err(), Kind::OutOfRange);
    assert_eq!(with("poisson = -1").unwrap_err(), Kind::OutOfRange);
}

#[test]
fn floating_shaft_is_a_warning() {
    let text = HEAD.split("[bearing.A]").next().unwrap();
    let loaded = model::load("test.toml", text, &Options::default()).unwrap();
    assert_eq!(loaded.warnings.len(), 1);
    assert!(loaded.warnings[0].message.contains("free-free"));
}

#[test]
fn windows_files_are_read() {
    let text = format!("\u{feff}{}", HEAD.replace('\n', "\r\n"));
    assert!(model::load("test.toml", text, &Options::default()).is_ok());
}
