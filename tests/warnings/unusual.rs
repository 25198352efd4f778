//! Plausible machines far from a motor in size, speed or support.

use crate::machines::{DOWN, Description, fixed, floating, linear, pair};

/// A housing on springs of its own \[N/m\] with damping \[N s/m\].
fn housing(name: &str, mass: f64, stiffness: f64, damping: f64) -> String {
    let axes = |key: &str, value: f64, unit: &str| -> String {
        ["x", "y", "z"].map(|axis| format!("{key}_{axis} = \"{value} {unit}\"\n")).concat()
    };
    format!(
        "[housing.{name}]\nstation = \"{name}\"\nmass = \"{mass} kg\"\ninertia = \"{} kg m^2\"\nk_tilt = \"1e4 N m/rad\"\n\
         k_spin = \"1e4 N m/rad\"\n{}{}",
        2e-4 * mass,
        axes("k", stiffness, "N/m"),
        axes("c", damping, "N s/m")
    )
}

/// A bearing of 6 mm bore that no catalogue has, with 7 balls.
fn miniature(more: &str) -> String {
    format!(
        "model = \"ball\"\nballs = 7\nball_diameter = \"3.5 mm\"\npitch_diameter = \"12.5 mm\"\nbore = \"6 mm\"\n\
         inner_osculation = 0.52\nouter_osculation = 0.53\nradial_clearance = \"5 um\"\n{more}"
    )
}

/// From a micro spindle of 60 000 rpm to a mill of 30 rpm, each with an unbalance response up to its speed.
pub fn all() -> Vec<Description> {
    let machine =
        |name, sections: &[[f64; 2]], bearings, discs: &[(&'static str, f64, f64, f64)], unbalance, rpm| {
            Description {
                name,
                sections: sections.to_vec(),
                bearings,
                discs: discs.to_vec(),
                unbalance,
                rpm,
                gravity: DOWN,
                more: format!(
                    "[study.unbalance]\nspeeds = {{ from = \"{} rpm\", to = \"{rpm} rpm\", count = 30 }}\n",
                    rpm / 30.0
                ),
            }
        };
    let with = |mut described: Description, more: &str| {
        described.more += more;
        described
    };
    let in_housing = |name: &str, keys: String| format!("housing = \"housing.{name}\"\n{keys}");
    let line_bearing = |k: usize| {
        let names = ["B1", "B2", "B3", "B4", "B5"];
        (names[k], 100.0 + 950.0 * k as f64, linear(5e7, 5000.0, k == 2))
    };
    vec![
        // Oil films on floating rings, soft and well damped.
        machine(
            "turbocharger",
            &[[30.0, 8.0], [70.0, 10.0], [30.0, 8.0]],
            vec![("T", 32.0, linear(2e6, 150.0, false)), ("C", 98.0, linear(2e6, 150.0, true))],
            &[("turbine", 12.0, 55.0, 10.0), ("compressor", 118.0, 50.0, 8.0)],
            0.2,
            90000.0,
        ),
        with(
            machine(
                "turbocharger_on_balls",
                &[[30.0, 8.0], [70.0, 10.0], [30.0, 8.0]],
                vec![
                    ("T", 35.0, in_housing("T", fixed("6000"))),
                    ("C", 95.0, in_housing("C", floating("6000", "+z", 60.0))),
                ],
                &[("turbine", 12.0, 50.0, 8.0), ("compressor", 118.0, 45.0, 6.0)],
                0.1,
                60000.0,
            ),
            &(housing("T", 0.1, 5e6, 300.0) + &housing("C", 0.1, 5e6, 300.0)),
        ),
        machine(
            "grinding_spindle",
            &[[40.0, 40.0], [60.0, 50.0], [220.0, 55.0], [60.0, 45.0], [40.0, 40.0]],
            vec![("front", 70.0, pair("7010C", 40.0, 300.0)), ("rear", 350.0, pair("7009C", 40.0, 250.0))],
            &[("wheel", 20.0, 250.0, 25.0)],
            20.0,
            2800.0,
        ),
        machine(
            "washing_machine",
            &[[120.0, 25.0], [80.0, 30.0]],
            vec![("rear", 40.0, fixed("6205")), ("front", 140.0, floating("6206", "+z", 200.0))],
            &[("drum", 190.0, 480.0, 8.0)],
            500.0,
            1200.0,
        ),
        machine(
            "drone_fan",
            &[[12.0, 5.0], [40.0, 6.0]],
            vec![
                ("A", 18.0, miniature("")),
                (
                    "B",
                    46.0,
                    miniature("thrust = \"+z\"\npreload = { force = \"12 N\", spring = \"8 N/mm\" }\n"),
                ),
            ],
            &[("fan", 6.0, 60.0, 6.0)],
            0.05,
            18000.0,
        ),
        machine(
            "line_shaft",
            &[[4000.0, 60.0]],
            (0..5).map(line_bearing).collect(),
            &[("p1", 600.0, 400.0, 60.0), ("p2", 2300.0, 300.0, 60.0), ("p3", 3600.0, 350.0, 60.0)],
            400.0,
            400.0,
        ),
        machine(
            "flywheel",
            &[[80.0, 70.0], [300.0, 80.0], [80.0, 70.0]],
            vec![("A", 60.0, fixed("6314")), ("B", 400.0, floating("6314", "+z", 1200.0))],
            &[("wheel", 230.0, 900.0, 80.0)],
            800.0,
            1500.0,
        ),
        with(
            machine(
                "pinion",
                &[[60.0, 45.0], [40.0, 50.0], [180.0, 62.0], [40.0, 50.0], [60.0, 45.0]],
                vec![("A", 80.0, fixed("6310")), ("B", 300.0, floating("6310", "+z", 700.0))],
                &[("gear", 200.0, 120.0, 60.0)],
                40.0,
                1480.0,
            ),
            "[load.mesh]\nat = \"disc.gear\"\nforce = \"900, 2600, 250 N\"\n",
        ),
        machine(
            "micro_spindle",
            &[[15.0, 8.0], [20.0, 10.0], [60.0, 12.0], [20.0, 10.0]],
            vec![("front", 25.0, pair("7000C", 8.0, 25.0)), ("rear", 105.0, floating("7000C", "-z", 25.0))],
            &[("tool", 5.0, 14.0, 12.0)],
            0.05,
            60000.0,
        ),
        machine(
            "slow_mill",
            &[[200.0, 150.0], [2400.0, 180.0], [200.0, 150.0]],
            vec![("A", 100.0, linear(4e8, 1e5, true)), ("B", 2700.0, linear(4e8, 1e5, false))],
            &[("drum_1", 800.0, 1600.0, 60.0), ("drum_2", 2000.0, 1600.0, 60.0)],
            50000.0,
            30.0,
        ),
        machine(
            "slow_drum",
            &[[100.0, 60.0], [600.0, 80.0], [100.0, 60.0]],
            vec![("A", 60.0, fixed("6212")), ("B", 740.0, fixed("6212"))],
            &[("drum", 400.0, 500.0, 150.0)],
            5000.0,
            30.0,
        ),
        with(
            machine(
                "belt_saw",
                &[[60.0, 25.0], [40.0, 30.0], [160.0, 36.0], [40.0, 30.0], [80.0, 25.0]],
                vec![("A", 80.0, fixed("6206")), ("B", 280.0, floating("6206", "+z", 250.0))],
                &[("blade", 25.0, 315.0, 3.0), ("pulley", 345.0, 100.0, 40.0)],
                15.0,
                3600.0,
            ),
            "[belt.drive]\nstation = \"at_pulley\"\npull = \"250, 0 N\"\nconstant_pull = true\nk_x = \"5e4 N/m\"\n\
             k_y = \"5e4 N/m\"\nc_x = \"20 N s/m\"\nc_y = \"20 N s/m\"\n",
        ),
    ]
}
