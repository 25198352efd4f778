//! Every code has a spoiled copy of something plausible that gives it and no other warning.

use crate::copies::{
    Case, Pair, SPALL, alone, command, exchanged, models, oil, tabulated, with_keys, without_modal,
};
use crate::measured_codes;
use crate::program;
use crate::spoiled::{machine, replaced};
use crate::study_codes;
use crate::{codes, warnings_of};
use rayon::prelude::*;
use rotordyn::warning::Code;

/// Codes of an angular contact row by itself under two loads.
fn at_loads(designation: &str, loads: [&str; 2]) -> Pair {
    with_keys_at_loads(designation, "", loads)
}

/// The same of a bearing with further keys.
fn with_keys_at_loads(designation: &str, keys: &str, loads: [&str; 2]) -> Pair {
    let row = alone(designation, &format!("thrust = \"+z\"\nball_inertia = \"none\"\n{keys}"));
    let folder = program::folder(&[("bearing.toml", row)]);
    loads.map(|load| {
        let bearing = ["bearing", "bearing.toml", "--no-figures", "--out", "out", "--load", load];
        let flags =
            ["--constrain", "theta_x,theta_y", "--speed", "100 rpm", "--sweep", "cage_angle=0 deg .. 1 deg"];
        program::codes(folder.path(), &[&bearing[..], &flags].concat(), 0)
    })
}

const INPUT: &[Case] = &[
    (Code::MaterialRange, || exchanged("two_discs_soft", "210 GPa", "21 GPa")),
    (Code::SectionStep, || {
        let mut thin = machine("two_discs_soft");
        thin.sections = vec![[990.0, 40.0], [10.0, 1.0]];
        models(&machine("two_discs_soft").text(), &thin.text())
    }),
    (Code::BoreMismatch, || exchanged("motor_large", "\"6312\"", "\"6310\"")),
    (Code::DiscFit, || {
        exchanged("two_discs_soft", "thickness = ", "inner_diameter = \"80 mm\"\nthickness = ")
    }),
    (Code::DiscSize, || {
        // Its mass by a light material, so that nothing else is wrong with it.
        let of = |diameter: &str| {
            let text = machine("two_discs_soft").text();
            let material = "[material.foam]\nyoung = \"1 GPa\"\npoisson = 0.3\ndensity = \"400 kg/m^3\"\n[disc.light]\n\
                            station = \"at_one\"\nthickness = \"0.01 mm\"\nmaterial = \"foam\"\n";
            replaced(&text, "[disc.one]", &format!("{material}outer_diameter = \"{diameter}\"\n[disc.one]"))
        };
        models(&of("1 m"), &of("9 m"))
    }),
    (Code::Gravity, || {
        let mut upwards = machine("two_discs_soft");
        upwards.gravity = "-9.81 m/s^2";
        models(&machine("two_discs_soft").text(), &upwards.text())
    }),
    (Code::OverlappingDiscs, || {
        let mut two = machine("two_discs_soft");
        two.discs[1].1 = two.discs[0].1 + 12.0;
        models(&machine("two_discs_soft").text(), &two.text())
    }),
    (Code::DiscCollision, || {
        let mut rig = machine("rig_short");
        rig.discs[0].1 = rig.bearings[1].1 + 5.0;
        models(&machine("rig_short").text(), &rig.text())
    }),
    (Code::SingleBearing, || {
        let mut motor = machine("motor_small");
        motor.bearings.truncate(1);
        models(&machine("motor_small").text(), &motor.text())
    }),
    (Code::BearingSpeed, || {
        let of = |rpm| {
            let mut spindle = machine("spindle_small");
            (spindle.rpm, spindle.unbalance) = (rpm, 0.1);
            spindle.text().replace("\"150 N\"", "\"2500 N\"")
        };
        // n d_m of the pitch diameter of 54 mm: 2.4e6 and 2.7e6 mm rpm.
        models(&of(45000.0), &of(50000.0))
    }),
    (Code::CageSpeed, || {
        // FTF of a 6205 is 0.398; with an outer ring that turns, 0.602.
        ["cage = 0.602\n", "cage = 0.52\n"].map(|keys| {
            let mut motor = machine("motor_small");
            motor.bearings[0].2 += keys;
            codes(&warnings_of(&motor.text())).into_iter().map(String::from).collect()
        })
    }),
    (Code::OverlappingBearings, || {
        let third = |distance: f64| {
            let mut motor = machine("motor_small");
            let (_, z, keys) = motor.bearings[0].clone();
            motor.bearings.push(("C", z + distance, keys));
            motor.text()
        };
        // A 6205 is 15 mm wide.
        models(&third(15.0), &third(9.0))
    }),
    (Code::BalanceQuality, || exchanged("two_discs_soft", "\"40 g mm\"", "\"40 kg mm\"")),
    (Code::UnusedItem, || {
        let brass =
            "[material.brass]\nyoung = \"105 GPa\"\npoisson = 0.34\ndensity = \"8400 kg/m^3\"\n[shaft]";
        exchanged("two_discs_soft", "[shaft]", brass)
    }),
    (Code::DefectGeometry, || {
        // Two balls of a 6205 are 16.2 mm apart on the outer race.
        with_keys("motor_small", &replaced(SPALL, "2 mm", "30 mm"))
    }),
    (Code::MeasuredSpeed, || {
        let of = |pulses: &str| {
            let ramp = "profile = \"ramp\"\nramp = \"2 s\"\nto = \"3000 rpm\"";
            let text = machine("two_discs_soft").text();
            replaced(&text, ramp, &format!("profile = \"measured\"\npulses = \"{pulses}\""))
        };
        models(&of("0, 20, 40, 60, 80, 100, 120 ms"), &of("0, 20, 40, 60, 100, 120, 140 ms"))
    }),
];

const SUPPORTS: &[Case] = &[
    (Code::FreeMotion, || {
        let mut two = machine("two_discs_soft");
        two.gravity = "0 m/s^2";
        models(&two.text(), &two.text().replace("k_yy = \"5000000 N/m\"\n", ""))
    }),
    (Code::FreeAxialMotion, || exchanged("two_discs_soft", "k_zz = \"1e7 N/m\"\n", "")),
    (Code::LargeDeflection, || {
        let pulled = |force: &str| {
            let mut two = machine("two_discs_soft");
            two.more = format!("[load.pull]\nat = \"disc.one\"\nforce = \"0, {force}, 0 N\"\n");
            two.text()
        };
        models(&pulled("-2000"), &pulled("-200000"))
    }),
    (Code::BearingUnloaded, || {
        let mut vertical = machine("vertical_small");
        let bearing =
            |class: &str| format!("model = \"ball\"\ndesignation = \"6306\"\nclearance = \"{class}\"\n");
        vertical.bearings[0].2 = bearing("C2");
        vertical.bearings[1].2 = bearing("C4");
        models(&machine("vertical_small").text(), &vertical.text())
    }),
    (Code::FittedLaw, || {
        let law = |range: &str| {
            let mut motor = machine("motor_small");
            motor.bearings[0].2 += &format!(
                "contact = \"power_law\"\npower_law = {{ stiffness = \"8e9 N/m^1.5\", exponent = 1.5, range = \"{range}\" }}\n"
            );
            motor.text()
        };
        models(&law("0.01, 5000 N"), &law("200, 5000 N"))
    }),
    (Code::StaticLoad, || with_keys("motor_small", "static_rating = \"15 N\"\n")),
    (Code::Shoulder, || with_keys("motor_small", "inner_shoulder_diameter = \"30.8 mm\"\n")),
    (Code::Film, || {
        let of = |roughness: &str| {
            let mut motor = machine("motor_small");
            motor.bearings[0].2 += "lubricant = \"oil\"\n";
            motor.more = format!("{}[study.bearing]\nroughness = \"{roughness}\"\n", oil(0.0261));
            motor.text()
        };
        models(&of("0.1 um"), &of("3 um"))
    }),
    (Code::ContactAngleLost, || {
        // Half the balls of a single row carry with a thrust of 1.25 F_r tan 40 deg; without it the ring slides.
        at_loads("7206B", ["0, -1000, 1100 N", "0, -1000, 20 N"])
    }),
    (Code::OpenSide, || {
        // Pressed beyond its play against its direction, an angular contact row carries on the open side.
        at_loads("7205B", ["0, -100, 300 N", "0, -100, -300 N"])
    }),
    (Code::NotChecked, || {
        let of = |stiffness: &str| {
            let text = machine("two_discs_soft").text();
            let tabulated = text
                .replace("k_xx = \"5000000 N/m\"", "speed = \"0, 3000 rpm\"\nk_xx = \"5e6, 5e6 N/m\"")
                .replace("k_yy = \"5000000 N/m\"", &format!("k_yy = \"5e6, {stiffness} N/m\""))
                .replace("\"2000 N s/m\"", "\"2000, 2000 N s/m\"")
                .replace("k_zz = \"1e7 N/m\"", "k_zz = \"1e7, 1e7 N/m\"");
            without_modal(&tabulated, "")
        };
        models(&of("5e6"), &of("0"))
    }),
    (Code::MinimumLoad, || {
        let mut motor = machine("motor_small");
        (motor.rpm, motor.unbalance) = (6000.0, 5.0);
        let plain = motor.text();
        motor.bearings[1].2 = motor.bearings[0].2.clone();
        models(&plain, &motor.text())
    }),
    (Code::GyroscopicSliding, || {
        let of = |rpm| {
            let mut spindle = machine("spindle_small");
            (spindle.rpm, spindle.unbalance) = (rpm, 0.1);
            spindle
                .text()
                .replace("7008C", "7008B")
                .replace("7006C", "7006B")
                .replace("\"150 N\"", "\"60 N\"")
        };
        models(&of(10000.0), &of(20000.0))
    }),
    (Code::LooseRing, || {
        let of = |interference: &str| {
            let fit = format!(
                "thrust = \"+z\"\nfit = {{ shaft_interference = \"{interference}\", shaft_bore = \"40 mm\", speed_growth = true }}"
            );
            alone("7014C", &fit)
        };
        let flags =
            ["--load", "0, -300, 1000 N", "--speed", "20000 rpm", "--sweep", "cage_angle=0 deg .. 1 deg"];
        command("bearing", &of("30 um"), &of("5 um"), &flags)
    }),
    (Code::PreloadWithoutEffect, || {
        let of =
            |preload: &str| alone("7014C", &format!("thrust = \"+z\"\nball_inertia = \"none\"\n{preload}"));
        let spring = "preload = { force = \"200 N\", spring = \"1e6 N/m\" }";
        let flags =
            ["--load", "0, -500, 600 N", "--speed", "100 rpm", "--sweep", "cage_angle=0 deg .. 1 deg"];
        command("bearing", &of(spring), &of("preload = { force = \"200 N\" }"), &flags)
    }),
    (Code::BallInertia, || {
        let mut spindle = machine("spindle_small");
        let plain = spindle.text();
        spindle.bearings.iter_mut().for_each(|bearing| bearing.2 += "ball_inertia = \"none\"\n");
        command("modal", &plain, &spindle.text(), &[])
    }),
    (Code::Rating, || {
        let of = |angle: &str| alone("7206B", &format!("thrust = \"+z\"\ncontact_angle = \"{angle}\""));
        command("bearing", &of("40 deg"), &of("50 deg"), &["--sweep", "cage_angle=0 deg .. 1 deg"])
    }),
    (Code::DefectsAveraged, || {
        let flags = ["--cage-average", "--sweep", "cage_angle=0 deg .. 1 deg"];
        command("bearing", &alone("6205", ""), &alone("6205", SPALL), &flags)
    }),
    (Code::LubricantFilm, || {
        let of = |law: &str| {
            let keys = format!("lubricant = \"oil\"\n{law}[study.bearing]\nroughness = \"0.001 um\"");
            alone("6205", &keys) + "\n" + &oil(0.0261)
        };
        let flags = ["--speed", "60 rpm", "--load", "0, -500, 0 N", "--sweep", "load=400 N .. 500 N"];
        command("bearing", &of(""), &of("contact = \"ehl\"\n"), &flags)
    }),
    (Code::TableRange, || {
        let modal = |speeds: &str| format!("[study.modal]\nspeeds = \"{speeds} rpm\"\n");
        let of = |speeds: &str| tabulated(&[1000.0, 3000.0], &[5e6, 6e6], ["", ""], &modal(speeds));
        models(&of("1000, 3000"), &of("500, 3000"))
    }),
    (Code::BeltPull, || {
        let fan = include_str!("../../assets/init/fan.toml");
        command(
            "static",
            fan,
            &replaced(fan, "constant_pull = true\n", "constant_pull = false\n")
                .replace("k_x = \"1e5 N/m\"", "k_x = \"1e8 N/m\""),
            &[],
        )
    }),
    (Code::Preload, || {
        let mut motor = machine("motor_small");
        let plain = motor.text();
        motor.bearings[1].2 =
            motor.bearings[0].2.clone() + "thrust = \"+z\"\npreload = { force = \"180 N\" }\n";
        models(&plain, &motor.text())
    }),
];

/// Every case, in the order of the codes.
fn all() -> impl Iterator<Item = &'static Case> {
    [INPUT, SUPPORTS, study_codes::LINEAR, study_codes::RUNS, measured_codes::CASES].into_iter().flatten()
}

/// A tandem pair takes thrust one way, as a single row.
#[test]
fn a_tandem_pair_that_slides_is_named() {
    let tandem = "arrangement = \"tandem\"\nrow_spacing = \"16 mm\"";
    let [plain, spoiled] = with_keys_at_loads("7206B", tandem, ["0, -2000, 2200 N", "0, -2000, 40 N"]);
    let more: Vec<&String> = spoiled.difference(&plain).collect();
    assert_eq!(more, [Code::ContactAngleLost.name()], "{plain:?}");
}

#[test]
fn every_code_has_a_case() {
    let named: Vec<Code> = all().map(|(code, _)| *code).collect();
    let missing: Vec<&str> =
        Code::ALL.iter().filter(|code| !named.contains(code)).map(|code| code.name()).collect();
    assert!(missing.is_empty(), "without a spoiled copy: {missing:?}");
    assert_eq!(named.len(), Code::ALL.len(), "a code has two cases");
}

#[test]
fn a_spoiled_copy_has_exactly_its_warning() {
    let wrong: Vec<String> = all()
        .par_bridge()
        .filter_map(|(code, pair)| {
            let [plain, spoiled] = pair();
            let more: Vec<&String> = spoiled.difference(&plain).collect();
            let fewer: Vec<&String> = plain.difference(&spoiled).collect();
            // The double modes of a symmetric rotor lie in other planes on another mesh.
            let also: &[&str] = if *code == Code::MeasuredData { &["low-mac"] } else { &[] };
            let own: Vec<&str> =
                more.iter().map(|name| name.as_str()).filter(|name| !also.contains(name)).collect();
            let exact = own == [code.name()] && fewer.is_empty();
            (!exact).then(|| format!("{}: {more:?} more, {fewer:?} fewer than {plain:?}", code.name()))
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
