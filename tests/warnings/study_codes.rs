//! Spoiled studies: the codes of linear studies and of runs.

use crate::copies::{Case, Pair, alone, command, exchanged, models, tabulated, without_modal};
use crate::program;
use crate::spoiled::{machine, replaced};
use rotordyn::analysis::critical_speed::UncertainRange;
use rotordyn::io::hdf5::Store;
use rotordyn::results::Results;
use rotordyn::study::Machine;
use rotordyn::warning::Code;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// Housings for the bearings of [`tabulated`], of a mass \[kg\] on a stiffness \[N/m\], and a Campbell diagram.
fn housings(mass: f64, stiffness: f64, count: usize) -> String {
    let one = |name: &str| {
        format!(
            "[housing.{name}]\nstation = \"{name}\"\nmass = \"{mass} kg\"\ninertia = \"0.1 kg m^2\"\nk_x = \"{stiffness} N/m\"\n\
             k_y = \"{stiffness} N/m\"\nk_z = \"{stiffness} N/m\"\nk_tilt = \"1e6 N m/rad\"\nk_spin = \"1e6 N m/rad\"\n\
             c_x = \"500 N s/m\"\nc_y = \"500 N s/m\"\nc_z = \"500 N s/m\"\n"
        )
    };
    let speeds = format!("{{ from = \"0 rpm\", to = \"3000 rpm\", count = {count} }}");
    format!("{}{}[study.campbell]\nspeeds = {speeds}\nmodes = 10\n", one("A"), one("B"))
}

const IN_HOUSINGS: [&str; 2] = ["housing = \"housing.A\"", "housing = \"housing.B\""];

/// A run-up of two discs within 0.5 s: speed \[rpm\], its settings and further tables.
fn run_up(rpm: f64, more: &str) -> String {
    let mut described = machine("two_discs_soft");
    described.rpm = rpm;
    let text = replaced(&described.text(), "ramp = \"2 s\"", "ramp = \"0.5 s\"");
    without_modal(&text, &format!("[probe.x]\nat = \"disc.one\"\ndirection = \"x\"\n{more}"))
}

pub const LINEAR: &[Case] = &[
    (Code::UnstableMode, || {
        exchanged("two_discs_soft", "k_xx = ", "k_xy = \"5e6 N/m\"\nk_yx = \"-5e6 N/m\"\nk_xx = ")
    }),
    (Code::StaticInstability, || exchanged("two_discs_soft", "k_xx = \"", "k_xx = \"-")),
    (Code::UndampedPeak, || {
        let mut rotor = machine("two_discs_soft");
        rotor.more =
            "[study.unbalance]\nspeeds = { from = \"100 rpm\", to = \"3000 rpm\", step = \"100 rpm\" }\n"
                .into();
        models(&rotor.text(), &rotor.text().replace("\"2000 N s/m\"", "\"0 N s/m\""))
    }),
    (Code::MarginRange, || {
        // The critical speed is 2552 rpm, 15 % below 3000 rpm.
        let of = |from: f64| {
            let mut rotor = machine("two_discs_soft");
            rotor.more = format!(
                "[study.unbalance]\nspeeds = {{ from = \"{from} rpm\", to = \"4000 rpm\", step = \"100 rpm\" }}\n"
            );
            rotor.text()
        };
        models(&of(100.0), &of(2600.0))
    }),
    (Code::LinearRange, || {
        let of = |unbalance| {
            let mut rig = machine("rig_short");
            rig.unbalance = unbalance;
            let more =
                "[study.unbalance]\nspeeds = { from = \"100 rpm\", to = \"9000 rpm\", step = \"50 rpm\" }\n";
            without_modal(&rig.text(), more)
        };
        models(&of(0.05), &of(200.0))
    }),
    (Code::MeshLimit, || {
        let mut rotor = machine("two_discs_soft");
        rotor.discs.clear();
        let fine = rotor.text().replace("modes = 6", "modes = 14");
        models(&fine, &replaced(&fine, "element_length = \"15 mm\"", "element_length = \"250 mm\""))
    }),
    (Code::WhirlFrequency, || {
        let of = |stiffness: &str| {
            let mut described = machine("two_discs_soft");
            for (_, _, keys) in &mut described.bearings {
                *keys = format!(
                    "model = \"linear\"\nwhirl_frequency = \"0, 10, 500 Hz\"\nk_xx = \"{stiffness} N/m\"\n\
                     k_yy = \"{stiffness} N/m\"\nk_zz = \"1e7, 1e7, 1e7 N/m\"\n\
                     c_xx = \"2000, 2000, 2000 N s/m\"\nc_yy = \"2000, 2000, 2000 N s/m\"\n"
                );
            }
            described.text()
        };
        models(&of("1e7, 1e7, 1e7"), &of("1e7, 1e7, 3e7"))
    }),
    (Code::CrossingUncertain, || {
        // The search finds every crossing of the machines tried here, also where tables scatter from row to row or a
        // frequency touches the line: the result is spoiled.
        let study = "[study.critical]\nmax_speed = \"3000 rpm\"\n";
        let text = without_modal(&machine("two_discs_soft").text(), study);
        let loaded = rotordyn::model::load("machine.toml", &text, &Default::default()).unwrap();
        let machine = Machine::new(loaded.model).unwrap();
        let study = machine.model.studies.critical.clone().unwrap();
        let plain = Results { critical: Some(machine.critical(&study).unwrap()), ..Results::default() };
        let mut spoiled = plain.clone();
        let range = UncertainRange { order: 1.0, from: 100.0, to: 110.0 };
        spoiled.critical.as_mut().unwrap().crossings.uncertain.push(range);
        [plain, spoiled].map(|results| {
            machine.warnings(&results, &[]).iter().map(|warning| warning.code.name().to_string()).collect()
        })
    }),
    (Code::BranchLost, || {
        let of = |stiffness: [f64; 2]| {
            tabulated(&[0.0, 3000.0], &stiffness, IN_HOUSINGS, &housings(25.0, 8e7, 13))
        };
        command("campbell", &of([1e6, 1e6]), &of([1e6, 1e7]), &[])
    }),
    (Code::BranchLabel, || {
        let of =
            |stiffness: [f64; 2]| tabulated(&[0.0, 3000.0], &stiffness, IN_HOUSINGS, &housings(3.0, 2e7, 41));
        command("campbell", &of([1e6, 1e6]), &of([1e6, 3e6]), &[])
    }),
];

pub const RUNS: &[Case] = &[
    (Code::EnergyBalance, || {
        let motor = include_str!("../../assets/init/motor.toml");
        command("run-up", motor, &replaced(motor, "step = \"20 us\"", "step = \"400 us\""), &[])
    }),
    (Code::TimeStep, || {
        let fan = include_str!("../../assets/init/fan.toml");
        let at = fan.find("[study.run_up]").unwrap();
        let step = at + fan[at..].find("step = \"").unwrap();
        let end = step + fan[step..].find('\n').unwrap();
        command("run-up", fan, &replaced(fan, &fan[step..end], "step = \"200 us\""), &[])
    }),
    (Code::Reduction, || {
        let of = |cutoff: &str| {
            run_up(30000.0, &format!("[study.run_up]\nstep = \"20 us\"\ncutoff = \"{cutoff}\"\n"))
        };
        command("run-up", &of("2 kHz"), &of("300 Hz"), &[])
    }),
    (Code::SampleRate, || {
        let of = |order: f64| {
            let settings = "[study.run_up]\nstep = \"100 us\"\nsample_rate = \"1 kHz\"\ncutoff = \"2 kHz\"\n";
            run_up(
                3000.0,
                &format!("{settings}[study.spectrogram]\nlength = \"50 ms\"\norders = [{order}]\n"),
            )
        };
        // 50 Hz at the highest speed: 400 and 600 Hz, half the rate is 500 Hz.
        command("run-up", &of(8.0), &of(12.0), &[])
    }),
    (Code::OrderSmear, || {
        let of = |length: &str| {
            let settings =
                "[study.run_up]\nstep = \"100 us\"\ncutoff = \"2 kHz\"\n[study.spectrogram]\norders = [2]\n";
            run_up(3000.0, &format!("{settings}length = \"{length}\"\n"))
        };
        // 100 Hz/s: 2x sweeps over 20 and 38 lines.
        command("run-up", &of("0.31 s"), &of("0.44 s"), &[])
    }),
    (Code::OrdersInOneBand, || {
        let of = |bandwidth: f64| {
            let settings = "[study.run_up]\nstep = \"100 us\"\ncutoff = \"2 kHz\"\n[study.orders]\nresolution = 0.2\nmax_order = 5\n";
            run_up(3000.0, &format!("{settings}cuts = [1, 1.1]\nbandwidth = {bandwidth}\n"))
        };
        command("run-up", &of(0.15), &of(0.25), &[])
    }),
    (Code::FreeBalls, || {
        // A floating shaft does not settle.
        let free = replaced(
            &alone(
                "6205",
                "friction = 0.06\nslip_speed = \"10 mm/s\"\nfree_cage = { mass = \"10 g\", guidance = \"outer_land\" }",
            ),
            "\"ball\"",
            "\"free_ball\"",
        );
        let flags = ["--speed", "3000 rpm", "--load", "0, 0, 0 N", "--sweep", "cage_angle=0 deg .. 1 deg"];
        command("bearing", &alone("6205", ""), &free, &flags)
    }),
    (Code::LongComputation, long_computation),
    (Code::NotSettled, || {
        let of = |periods: usize, limit: usize| {
            run_up(
                3000.0,
                &format!(
                    "[study.poincare]\nspeed = \"2500 rpm\"\nstep = \"100 us\"\ntransient_periods = {periods}\nperiods = 20\ntransient_limit = {limit}\n"
                ),
            )
        };
        command("poincare", &of(100, 2000), &of(1, 0), &[])
    }),
    (Code::SweepIncomplete, || {
        let text = alone("7206B", "thrust = \"+z\"");
        let one = |top: &str| {
            let sweep = format!("speed=0 rpm .. {top}");
            command("bearing", &text, &text, &["--sweep", &sweep])[0].clone()
        };
        [one("9000 rpm"), one("900000 rpm")]
    }),
    (Code::IncompleteRun, || {
        let folder = program::folder(&[(
            "machine.toml",
            run_up(3000.0, "[study.run_up]\nstep = \"100 us\"\ncutoff = \"2 kHz\"\n"),
        )]);
        let run = ["run-up", "machine.toml", "--no-figures", "--out", "out"];
        assert!(program::codes(folder.path(), &run, 0).is_empty());
        let spectrogram = ["spectrogram", "out", "--no-figures", "--length", "0.1 s"];
        let plain = program::codes(folder.path(), &spectrogram, 0);
        // The state that a run writes when it ends early.
        let store = Store::append(folder.path().join("out/results.h5")).unwrap();
        store.set_attribute("/time", "run_state", "stopped: ended by Ctrl-C").unwrap();
        drop(store);
        [plain, program::codes(folder.path(), &spectrogram, 0)]
    }),
];

/// A run of years: stopped as soon as it is announced.
fn long_computation() -> Pair {
    let plain = run_up(3000.0, "[study.run_up]\nstep = \"100 us\"\ncutoff = \"2 kHz\"\n");
    let long = replaced(&plain, "step = \"100 us\"", "step = \"1e-12 s\"");
    let folder = program::folder(&[("plain.toml", plain), ("long.toml", long)]);
    let expected = program::codes(folder.path(), &["run-up", "plain.toml", "--no-figures"], 0);
    let mut child = Command::new(assert_cmd::cargo::cargo_bin("rotordyn"))
        .args(["run-up", "long.toml", "--no-figures", "--json"])
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut announced = String::new();
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    while !announced.contains("takes about") {
        assert!(stderr.read_line(&mut announced).unwrap() > 0, "{announced}");
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    // The energies of a run that has just begun are no balance.
    let mut found = program::codes_of(&output.stdout);
    found.remove(Code::EnergyBalance.name());
    [expected, found]
}
