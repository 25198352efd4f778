//! `report.html`: self-contained, the same bytes again, and safe with whatever the model says.

use crate::{json_of, output_of, rotordyn};
use base64::Engine as _;
use flate2::read::ZlibDecoder;
use serde_json::Value;
use std::io::Read;
use std::path::Path;

/// Largest page of the rig \[bytes\].
const LARGEST: u64 = 8_000_000;

/// The head of the page's data, read as its script does.
fn head_of(page: &str) -> Value {
    let data = page.split_once("<script type=\"text/plain\" id=\"data\">").unwrap().1;
    let data = data.split_once("</script>").unwrap().0;
    let packed = base64::engine::general_purpose::STANDARD.decode(data).unwrap();
    let mut bytes = Vec::new();
    ZlibDecoder::new(&packed[..]).read_to_end(&mut bytes).unwrap();
    let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[4..4 + length]).unwrap()
}

/// The page without its data and scripts.
fn text_of(page: &str) -> &str {
    page.split_once("<script").unwrap().0
}

/// The linear studies of a small machine, with its page.
fn run(model: &Path, out: &Path) -> (Value, String) {
    let done = json_of(rotordyn().arg("run").arg(model).arg("--out").arg(out));
    (done, std::fs::read_to_string(out.join("report.html")).unwrap())
}

/// A machine that computes quickly.
fn small_machine(title: &str, disc: &str) -> String {
    format!(
        r#"
[model]
name = "small"
title = {title:?}
[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[shaft]
element_length = "50 mm"
section = [{{ length = "0.4 m", outer_diameter = "20 mm" }}]
[station]
A = "20 mm"
B = "380 mm"
middle = "200 mm"
[disc.{disc:?}]
station = "middle"
outer_diameter = "160 mm"
thickness = "20 mm"
material = "steel"
[bearing.A]
model = "linear"
station = "A"
k_xx = "1e7 N/m"
k_yy = "2e7 N/m"
k_zz = "1e6 N/m"
[bearing.B]
model = "linear"
station = "B"
k_xx = "1e7 N/m"
k_yy = "2e7 N/m"
[drive]
kind = "prescribed"
station = "A"
[study.modal]
speeds = ["0 rpm", "3000 rpm"]
[study.campbell]
speeds = {{ from = "0 rpm", to = "6000 rpm", count = 5 }}
modes = 6
"#
    )
}

#[test]
fn a_run_leaves_a_page_of_its_results() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("small.toml");
    std::fs::write(&model, small_machine("Small machine", "main")).unwrap();
    let out = folder.path().join("out");
    let (done, page) = run(&model, &out);
    assert!(done["files"].to_string().contains("report.html"), "{}", done["files"]);
    let identity = done["identity"].as_str().unwrap();
    for words in
        ["Small machine", identity, "Least damped mode", "shaft.element_length", "<svg", "bearing.A.k_xx"]
    {
        assert!(text_of(&page).contains(words), "{words}");
    }
    // Nothing is loaded from elsewhere: the only addresses are names of XML spaces and those in the libraries' texts.
    for from in ["src=\"http", "href=\"http", "url(http", "@import"] {
        assert!(!text_of(&page).contains(from), "{from}");
    }
    let head = head_of(&page);
    let campbell = &head["results"]["groups"]["campbell"];
    assert_eq!(campbell["sets"]["frequency"]["shape"], serde_json::json!([6, 5]));
    // Shapes over the speeds of the diagram, at the nodes of the modal study.
    let nodes = &head["results"]["groups"]["modes"]["sets"]["shapes"]["shape"][2];
    assert!(nodes.as_u64() > Some(8), "{nodes}");
    assert_eq!(campbell["sets"]["shapes"]["shape"], serde_json::json!([6, 5, nodes, 6]));
    let points = head["machine"]["points"]["count"].as_u64().unwrap();
    assert!(points > 300 && head["machine"]["parts"]["count"].as_u64() == Some(points / 3));

    // The page of the stored results is the same, byte by byte.
    let again = folder.path().join("again.html");
    output_of(rotordyn().arg("report").arg(&out).arg("--out").arg(&again));
    assert!(std::fs::read_to_string(&again).unwrap() == page);
}

#[test]
fn a_run_without_figures_writes_no_page() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("small.toml");
    std::fs::write(&model, small_machine("Small machine", "main")).unwrap();
    let out = folder.path().join("out");
    output_of(rotordyn().arg("run").arg(&model).arg("--no-figures").arg("--out").arg(&out));
    assert!(!out.join("report.html").exists());
    output_of(rotordyn().arg("report").arg(out.join("results.h5")));
    assert!(out.join("report.html").exists());
}

#[test]
fn markup_in_names_and_titles_stays_text() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("small.toml");
    let title =
        format!("</script><script>alert(1)</script><img src=x onerror='alert(2)'>{}", "long ".repeat(20_000));
    std::fs::write(&model, small_machine(&title, "<b onclick=alert(3)>&\"'</b>")).unwrap();
    let (_, page) = run(&model, &folder.path().join("out"));
    let text = text_of(&page);
    for markup in ["<img", "<b onclick", "alert(1)</script>"] {
        assert!(!text.contains(markup), "{markup}");
    }
    assert!(text.contains("&lt;/script&gt;&lt;script&gt;alert(1)"));
    assert!(text.contains("&lt;b onclick=alert(3)&gt;&amp;&quot;&#39;&lt;/b&gt;"));
    // Data, libraries, own scripts: no more elements than the template has.
    assert_eq!(page.matches("<script").count(), 2 + page.matches("\\x3cscript").count());
}

#[test]
fn a_file_without_results_has_no_page() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("results.h5");
    let store = rotordyn::io::hdf5::Store::create(&file).unwrap();
    store.write("/values", &[2], &[1.0, 2.0], &[]).unwrap();
    drop(store);
    let output = rotordyn().arg("report").arg(&file).assert().code(2);
    let output = String::from_utf8(output.get_output().stderr.clone()).unwrap();
    assert!(output.contains("contains no rotordyn run"), "{output}");
    rotordyn().arg("report").arg(folder.path().join("missing")).assert().code(4);
}

/// The page of the rig, with a run-up of half a second.
#[test]
fn the_page_of_the_rig_is_small() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path();
    let short =
        ["speed.settle=0.1 s", "speed.ramp=0.3 s", "speed.hold=0.1 s", "study.spectrogram.length=0.1 s"];
    let more = ["study.orders.resolution=0.5", "study.orders.cuts=[1, 2]"];
    let set = short.iter().chain(&more).flat_map(|value| ["--set", value]);
    output_of(rotordyn().args(["run", "models/overhung_rig.toml", "--out"]).arg(out).args(set));
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.len() as u64 <= LARGEST, "{} bytes", page.len());
    let head = head_of(&page);
    let channels = head["history"]["channels"].as_array().unwrap();
    assert!(channels.iter().any(|channel| channel["name"] == "B_ax" && channel["unit"] == "m/s^2"));
    assert_eq!(head["history"]["samples"], 2001);
    let drawn: Vec<&str> =
        head["figures"].as_array().unwrap().iter().map(|f| f["caption"].as_str().unwrap()).collect();
    assert!(drawn.iter().any(|caption| caption.starts_with("Loads of the balls")), "{drawn:?}");
    assert!(text_of(&page).contains("Strongest line of"), "summary of the run-up");
    // The model has no study of its bearings: they are computed for the page.
    let bearings = head["bearings"].as_array().unwrap();
    let names: Vec<&str> = bearings.iter().map(|bearing| bearing["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["A", "B"]);
    for bearing in bearings {
        assert!(bearing["stored"] == false && bearing["failed"].is_null(), "{bearing}");
        let groups = &bearing["tree"]["groups"];
        assert_eq!(groups["geometry"]["attributes"]["balls"], 9);
        let balls = &groups["operating"]["groups"]["balls"]["groups"]["outer"]["sets"]["load"];
        assert_eq!((&balls["shape"], &balls["unit"]), (&serde_json::json!([9]), &serde_json::json!("N")));
        assert!(groups["sweep_load"]["sets"]["swept_value"]["count"].as_u64() > Some(10));
        assert!(groups["limits"]["sets"]["state"]["values"].as_array().unwrap().len() > 3);
        assert_eq!(bearing["classes"].as_array().unwrap().len(), 5);
        assert!(bearing["sheet"].as_str().unwrap().contains("<svg"));
    }
}

/// A bearing of its own study is shown as stored; one of an older file without geometry and limits says so.
#[test]
fn a_stored_bearing_is_shown_and_what_an_older_file_lacks_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("alone.toml");
    let text = "[model]\nname = \"alone\"\n[bearing.\"60/22\"]\nmodel = \"ball\"\ndesignation = \"6205\"\n";
    std::fs::write(&model, text).unwrap();
    let out = folder.path().join("out");
    output_of(rotordyn().arg("bearing").arg(&model).arg("--no-figures").arg("--out").arg(&out));
    let page = || {
        output_of(rotordyn().arg("report").arg(&out));
        std::fs::read_to_string(out.join("report.html")).unwrap()
    };
    let bearing = |page: &str| head_of(page)["bearings"][0].clone();
    let found = bearing(&page());
    assert_eq!((&found["name"], &found["stored"]), (&"60/22".into(), &true.into()));
    assert_eq!(found["absent"], serde_json::json!([]));
    // 6205: bore 25 mm, CN from 5 to 20 um (ISO 5753-1).
    let normal = &found["classes"][1];
    assert_eq!(normal["name"], "CN");
    assert!((normal["least"].as_f64().unwrap() - 5e-6).abs() < 1e-12, "{normal}");
    let store = rotordyn::io::hdf5::Store::append(out.join("results.h5")).unwrap();
    for part in ["geometry", "limits"] {
        store.remove(&format!("/bearings/60/22/{part}")).unwrap();
    }
    drop(store);
    let older = bearing(&page());
    assert_eq!(older["absent"].as_array().unwrap().len(), 2, "{older}");
    assert!(older["classes"].is_null());
}
