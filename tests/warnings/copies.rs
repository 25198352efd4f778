//! Plausible machines beside their spoiled copies.

use crate::program;
use crate::spoiled::{machine, replaced};
use crate::{codes, warnings_of};
use rotordyn::warning::Code;
use std::collections::BTreeSet;

/// Codes of the plausible and of the spoiled copy.
pub type Pair = [BTreeSet<String>; 2];

/// A case: the code and what gives the pair.
pub type Case = (Code, fn() -> Pair);

/// Codes of two model files, by the library.
pub fn models(plain: &str, spoiled: &str) -> Pair {
    [plain, spoiled].map(|text| codes(&warnings_of(text)).into_iter().map(String::from).collect())
}

/// Codes of one command on two files of the same name, by the program.
pub fn command(name: &str, plain: &str, spoiled: &str, flags: &[&str]) -> Pair {
    [plain, spoiled].map(|text| {
        let folder = program::folder(&[("machine.toml", text.to_string())]);
        let arguments = [&[name, "machine.toml", "--no-figures", "--out", "out"], flags].concat();
        program::codes(folder.path(), &arguments, 0)
    })
}

/// The machine of a name, and its copy with a part of the text replaced.
pub fn exchanged(name: &str, from: &str, to: &str) -> Pair {
    let text = machine(name).text();
    models(&text, &replaced(&text, from, to))
}

/// The machine of a name, with keys added to its first bearing in the copy.
pub fn with_keys(name: &str, keys: &str) -> Pair {
    let mut described = machine(name);
    let plain = described.text();
    described.bearings[0].2 += keys;
    models(&plain, &described.text())
}

/// A machine with further tables in place of its modal study.
pub fn without_modal(text: &str, more: &str) -> String {
    format!("{}{more}", &text[..text.find("[study.modal]").unwrap()])
}

/// Two discs on linear bearings tabulated over speed: stiffness \[N/m\], keys of each bearing, further tables.
pub fn tabulated(speeds: &[f64], stiffness: &[f64], keys: [&str; 2], more: &str) -> String {
    let list = |values: &[f64], unit: &str| {
        let texts: Vec<String> = values.iter().map(f64::to_string).collect();
        format!("\"{} {unit}\"", texts.join(", "))
    };
    let (speed, k) = (list(speeds, "rpm"), list(stiffness, "N/m"));
    let (c, axial) = (list(&vec![2000.0; speeds.len()], "N s/m"), list(&vec![1e7; speeds.len()], "N/m"));
    let mut described = machine("two_discs_soft");
    for ((_, _, text), keys) in described.bearings.iter_mut().zip(keys) {
        *text = format!(
            "model = \"linear\"\nspeed = {speed}\nk_xx = {k}\nk_yy = {k}\nk_zz = {axial}\nc_xx = {c}\nc_yy = {c}\n{keys}\n"
        );
    }
    without_modal(&described.text(), more)
}

/// A bearing by itself.
pub fn alone(designation: &str, keys: &str) -> String {
    format!(
        "[model]\nname = \"alone\"\n[bearing.A]\nmodel = \"ball\"\ndesignation = \"{designation}\"\n{keys}\n"
    )
}

/// An oil of a viscosity \[Pa s\].
pub fn oil(viscosity: f64) -> String {
    format!(
        "[lubricant.oil]\nviscosity = \"{viscosity} Pa s\"\ndensity = \"870 kg/m^3\"\npressure_viscosity = \"2e-8 1/Pa\"\n"
    )
}

pub const SPALL: &str = "defect = [{ on = \"outer\", angle = \"-90 deg\", kind = \"spall\", width = \"2 mm\", depth = \"20 um\" }]\n";
