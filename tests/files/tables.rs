//! Tables of other programs: separators, decimal commas, units, complex cells, error messages.

use rotordyn::error::Error;
use rotordyn::io::measured;
use rotordyn::signal::Complex;
use rotordyn::signal::record::{AxisQuantity, Kind, MeasuredData, Points, Values};

fn try_read(name: &str, bytes: &[u8]) -> Result<MeasuredData, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    measured::read(&path)
}

fn read(text: &str) -> MeasuredData {
    try_read("table.csv", text.as_bytes()).unwrap()
}

fn real(measured: &MeasuredData, name: &str) -> Vec<f64> {
    match &measured.record(name).unwrap().values {
        Values::Real(values) => values.clone(),
        Values::Complex(_) => panic!("{name} is complex"),
    }
}

#[test]
fn separators_decimal_commas_and_byte_order_marks() {
    let plain = read("time_s,a_m_s2\n0,1.5\n0.001,-2\n0.002,3e-1\n");
    for text in [
        "\u{feff}time_s;a_m_s2\r\n0;1,5\r\n0,001;-2\r\n0,002;3e-1\r\n",
        "time_s\ta_m_s2\n0\t1.5\n0.001\t-2\n0.002\t3e-1\n",
        "# made by hand\ntime_s a_m_s2\n\n0   1.5\n 0.001  -2\n# pause\n0.002 3e-1",
        "\"time_s\",\"a_m_s2\"\n0,1.5\n0.001,-2\n0.002,3e-1\n",
        "# time_s,a_m_s2\n0,1.5\n0.001,-2\n0.002,3e-1\n",
        "time_s,a_m_s2,\n0,1.5,\n0.001,-2,\n0.002,3e-1,\n",
        "time;a\ns;m/s²\n0;1,5\n0,001;-2\n0,002;3e-1\n",
        "Time (ms),a [m/s^2]\n0,1.5\n1,-2\n2,3e-1\n",
    ] {
        let back = read(text);
        assert_eq!(real(&back, "a"), [1.5, -2.0, 0.3], "{text}");
        let record = &back.records[0];
        assert_eq!((record.unit.as_str(), record.sample_rate()), ("m/s^2", Ok(1000.0)), "{text}");
        assert_eq!((record.kind, &record.values), (Kind::Time, &plain.records[0].values));
    }
    let latin = b"time_s;T \xb0\n0;1\n1;2\n";
    assert_eq!(try_read("a.csv", latin).unwrap().records[0].name, "T °");
}

#[test]
fn units_are_converted_and_unknown_ones_kept() {
    let back = read("time_s,a_g,x_um,force (lbf),level [dB]\n0,1,2,3,4\n1,1,2,3,4\n");
    assert_eq!(real(&back, "a")[0], 9.80665);
    assert_eq!(real(&back, "x")[0], 2e-6);
    assert!((real(&back, "force")[0] - 3.0 * 4.4482216152605).abs() < 1e-14);
    let level = back.record("level").unwrap();
    assert_eq!((level.unit.as_str(), level.file_unit.as_str()), ("", "dB"));
}

#[test]
fn sampling_rate_from_rounded_times() {
    // 12 kHz with six decimals: steps of 83 and 84 microseconds.
    let rows: String = (0..4000).map(|k| format!("{:.6},1\n", f64::from(k) / 12000.0)).collect();
    let back = read(&("time_s,a\n".to_owned() + &rows));
    assert_eq!(back.records[0].sample_rate(), Ok(12000.0));
    assert!(back.notes.is_empty());
    // A missing sample in the middle is reported.
    let mut lines: Vec<&str> = rows.lines().collect();
    lines.remove(2000);
    let back = read(&("time_s,a\n".to_owned() + &lines.join("\n")));
    assert_eq!(back.notes, ["`time` is not uniformly spaced"]);
    let text = back.records[0].sample_rate().unwrap_err().to_string();
    assert!(text.contains("`a` is not sampled uniformly: the step after value 1999 is 1.67"), "{text}");
    assert!(text.contains("resample it"), "{text}");
}

#[test]
fn complex_columns_and_cells() {
    let back = read("frequency_Hz,H_re_m_N,H_im_m_N,coherence\n0,1,-2,1\n0.5,3,4,0.9\n");
    let frf = back.record("H").unwrap();
    assert_eq!((frf.kind, frf.unit.as_str(), frf.axis.quantity), (Kind::Frf, "m/N", AxisQuantity::Frequency));
    assert_eq!(frf.frf().unwrap(), [Complex::new(1.0, -2.0), Complex::new(3.0, 4.0)]);
    let coherence = back.record("coherence").unwrap();
    assert_eq!((coherence.kind, coherence.unit.as_str()), (Kind::Coherence, "1"));
    let mut cells = try_read("point.txt", b"(-0.5+2.5e-08j)\n(1e-3-1e-2j)\n-2j\n1+1i\n").unwrap();
    let expected = [
        Complex::new(-0.5, 2.5e-8),
        Complex::new(1e-3, -1e-2),
        Complex::new(0.0, -2.0),
        Complex::new(1.0, 1.0),
    ];
    assert_eq!(cells.records[0].values, Values::Complex(expected.to_vec()));
    let text = cells.records[0].frf().unwrap_err().to_string();
    assert_eq!(text, "`point` does not state its frequencies; give their step, such as \"0.5 Hz\"");
    cells.set_missing_frequency_step(0.5);
    assert_eq!(cells.frf_matrix().unwrap().frequencies, [0.0, 0.5, 1.0, 1.5]);
}

#[test]
fn table_without_names_or_rate() {
    let mut back = try_read("speed_rpm.csv", b"2.07e+02\n4.11e+02\n").unwrap();
    assert_eq!((back.records[0].name.as_str(), back.records[0].unit.as_str()), ("speed", "rpm"));
    assert_eq!(back.notes, ["no sampling rate or frequency step is stated for speed"]);
    let text = back.records[0].sample_rate().unwrap_err().to_string();
    assert_eq!(text, "`speed` does not state its sampling rate; give it, such as \"12 kHz\"");
    back.set_missing_rate(50.0);
    assert_eq!(back.records[0].sample_rate(), Ok(50.0));
    let two = try_read("data.txt", b"1 2\n3 4\n").unwrap();
    let names: Vec<&str> = two.records.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names, ["data_1", "data_2"]);
    assert_eq!(two.records[0].axis.points, Points::Unknown);
}

#[test]
fn columns_of_different_lengths_and_missing_values() {
    let back = read("time_s,a,b\n0,1,5\n1,,6\n2,3,\n3,NaN,\n");
    assert_eq!(real(&back, "b"), [5.0, 6.0]);
    let a = real(&back, "a");
    assert!(a[1].is_nan() && a[3].is_nan() && a[2] == 3.0);
    assert_eq!(back.notes, ["`a` has 2 values of 4 that are not finite, the first at index 1"]);
    // Duplicate names.
    let twice = read("time_s,a,a\n0,1,2\n1,1,2\n");
    assert_eq!(real(&twice, "a (2)"), [2.0, 2.0]);
    let text = twice.record("b").unwrap_err().to_string();
    assert_eq!(text, "there is no channel `b`; there are a, a (2)");
}

#[test]
fn errors_state_line_and_column() {
    let message = |text: &str| match try_read("table.csv", text.as_bytes()) {
        Err(Error::Content { problem, advice, .. }) => format!("{problem}; {advice}"),
        other => panic!("{other:?}"),
    };
    let cut = message("time_s,a\n0,1\n1,2\n2");
    assert_eq!(
        cut,
        "line 4 has 1 cells, the first data line has 2; the file is cut off or damaged: copy or export it again"
    );
    assert!(message("time_s,a\n0,1\n1,x\n").starts_with("`x` in line 3, column `a`, is not a number"));
    assert!(message("time_s,a\n0,1\n0,2\n").starts_with("`time` does not increase after its value 1"));
    assert!(message("time_s,a\n0,1\n,2\n").starts_with("`time` does not increase after its value 1"));
    assert!(message("a,b\n").contains("the file contains no line of numbers; write one line of names"));
    assert!(message("").contains("the file is empty"));
}
