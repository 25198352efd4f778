//! Round trips of CSV and VTK files, number by number.

use rotordyn::io::csv::{self, Column};
use rotordyn::io::vtk::{Field, Grid, Values, machine_fields, to_vtu, write_pvd, write_vtu};

#[test]
fn csv_round_trip_is_exact_with_units_in_header() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.csv");
    let acceleration = [1.0 / 3.0, -2.5e-300, 0.0];
    let channels = [
        Column { name: "B_ax", unit: "m/s²", values: &acceleration },
        Column { name: "speed", unit: "rpm", values: &[10.0, 20.0, 30.0] },
    ];
    csv::write_series(&path, 2000.0, 1.0, &channels).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("time_s,B_ax_m_s2,speed_rpm"));
    for (k, line) in lines.enumerate() {
        let numbers: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        assert_eq!(numbers, [1.0 + k as f64 / 2000.0, acceleration[k], 10.0 * (k + 1) as f64]);
    }
    assert_eq!(text.lines().count(), 4);
    let header = |name, unit| Column { name, unit, values: &[] }.header();
    assert_eq!(header("rim.tangential", "m/(s^2 N)"), "rim_tangential_m_s2_N");
    assert_eq!(header("ratio", ""), "ratio");
}

/// The numbers of a named array of a .vtu text.
fn numbers(text: &str, name: &str) -> Vec<f64> {
    let start = text.find(&format!("Name=\"{name}\"")).unwrap();
    let body = &text[start + text[start..].find('>').unwrap() + 1..];
    body[..body.find('<').unwrap()].split_whitespace().map(|x| x.parse().unwrap()).collect()
}

fn grid() -> Grid {
    Grid {
        points: vec![[0.0; 3], [0.0, 0.0, 0.1], [0.0, 0.0, 1.0 / 3.0], [0.02, 0.0, 0.1]],
        lines: vec![[0, 1], [1, 2]],
        ..Grid::default()
    }
}

#[test]
fn vtu_round_trip_is_exact() {
    let q: Vec<f64> = (0..18).map(|k| f64::from(k) / 7.0).collect();
    let fields = machine_fields(&grid(), &q, &[55.5]);
    let text = to_vtu(&grid(), &fields).unwrap();
    assert_eq!(numbers(&text, "points"), grid().points.concat());
    let expected = |first: usize| -> Vec<f64> {
        (0..3).flat_map(|k| q[6 * k + first..6 * k + first + 3].to_vec()).chain([0.0; 3]).collect()
    };
    assert_eq!(numbers(&text, "displacement"), expected(0));
    assert_eq!(numbers(&text, "rotation"), expected(3));
    assert_eq!(numbers(&text, "ball_load"), [0.0, 0.0, 0.0, 55.5]);
    assert_eq!(numbers(&text, "connectivity"), [0.0, 1.0, 1.0, 2.0, 3.0]);
    assert_eq!(numbers(&text, "offsets"), [2.0, 4.0, 5.0]);
    assert_eq!(numbers(&text, "types"), [3.0, 3.0, 1.0]);
}

#[test]
fn vtk_series_and_error_messages() {
    let folder = tempfile::tempdir().unwrap();
    let fields = machine_fields(&grid(), &[0.0; 18], &[]);
    write_vtu(&folder.path().join("a&b.vtu"), &grid(), &fields).unwrap();
    let path = folder.path().join("run.pvd");
    write_pvd(&path, &[(0.25, "a&b.vtu".into())]).unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.contains("timestep=\"2.5e-1\" part=\"0\" file=\"a&amp;b.vtu\""), "{text}");

    let field = |values| [Field { name: "f".into(), values }];
    let error = to_vtu(&grid(), &field(Values::Scalars(vec![0.0, f64::NAN, 0.0, 0.0]))).unwrap_err();
    assert_eq!(error, "f contains a number that is not finite");
    let error = to_vtu(&grid(), &field(Values::Scalars(vec![0.0]))).unwrap_err();
    assert_eq!(error, "field f does not have one value for each of 4 points");
    let bad = Grid { lines: vec![[0, 9]], ..grid() };
    assert_eq!(to_vtu(&bad, &[]).unwrap_err(), "a line ends at point 9 of 4");
    let missing_folder = folder.path().join("missing").join("x.vtu");
    assert!(write_vtu(&missing_folder, &grid(), &fields).unwrap_err().to_string().starts_with("write "));
}
