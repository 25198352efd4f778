//! Words of the formats.

use rotordyn::model::keys;

fn words(list: &[&str]) -> Vec<Vec<u8>> {
    list.iter().map(|word| word.as_bytes().to_vec()).collect()
}

fn bytes(list: &[&[u8]]) -> Vec<Vec<u8>> {
    list.iter().map(|word| word.to_vec()).collect()
}

const UNITS: [&str; 40] = [
    "mm", "m", "um", "\u{b5}m", "in", "N", "kN", "N/m", "N/mm", "N m", "Nm", "Pa", "GPa", "MPa", "kg", "g",
    "kg/m^3", "kg m^2", "g mm", "rpm", "rad/s", "Hz", "kHz", "s", "ms", "us", "deg", "rad", "K", "degC",
    "m/s^2", "g/N", "mm/s", "N s/m", "1/s", "mm^2/s", "Pa s", "%", "kHz^2", "lbf",
];

/// Classes, keys and values of rotors that ROSS saves.
pub fn ross() -> Vec<Vec<u8>> {
    words(&[
        "ross_version",
        "parameters",
        "ShaftElement_",
        "DiskElement_",
        "BearingElement_",
        "SealElement_",
        "PointMass_",
        "CouplingElement_",
        "GearElement_",
        "material",
        "n_link",
        "frequency",
        "speed",
        "interpolation",
        "kxx",
        "cxy",
        "mzz",
        "idl",
        "odr",
        "shear_method_calc",
        "hutchinson",
        "alpha",
        "beta",
        "Ip_l",
        "kt_x",
        "mx",
        "null",
        "[[",
        "1e308",
        "1e-320",
        "nan",
        "inf",
        "-0.0",
        "18446744073709551615",
    ])
}

/// Keys of the model file with what they are assigned in examples, their words and units.
pub fn model() -> Vec<Vec<u8>> {
    let mut found = words(&UNITS);
    for key in keys::all() {
        let example = if key.example.is_empty() { "{}" } else { &key.example };
        found.push(key.name.as_bytes().to_vec());
        found.push(format!("{} = {example}\n", key.name).into_bytes());
        found.push(format!("{} = {example}\n", key.path).into_bytes());
        found.push(example.as_bytes().to_vec());
        found.push(format!("[{}]\n", key.path).into_bytes());
        found.extend(key.words.iter().map(|word| word.as_bytes().to_vec()));
        found.extend(
            key.conditions().into_iter().filter(|c| !c.is_empty()).map(|c| format!("{c}\n").into_bytes()),
        );
    }
    found.extend(words(&[
        "[variant.x]\n",
        "variant.x.",
        "[[shaft.section]]\n",
        "shaft.section.0.",
        ".-1",
        ".99999999",
        "\"",
        "station.",
        "bearing.",
        "disc.",
        "ground",
        "rotor",
        "..",
        "\u{feff}",
        "+z",
        "-y",
        "theta_x",
    ]));
    found.sort();
    found.dedup();
    found
}

pub fn mapping() -> Vec<Vec<u8>> {
    let keys = [
        "rate = \"12 kHz\"\n",
        "frequency_step = \"0.5 Hz\"\n",
        "axes = [\"z\", \"x\", \"y\"]\n",
        "axes",
        "\"-x\"",
        "[channel.",
        "[point.",
        "station = \"A\"\n",
        "station",
        "direction = \"-y\"\n",
        "direction",
        "unit = \"g\"\n",
        "offset = \"150, 0, 0 mm\"\n",
        "offset",
        "reference = { station = \"A\", direction = \"x\" }\n",
        "reference",
        "\"x\"",
        "\"Rx\"",
        "\"theta_z\"",
        "\"+\"",
        "\"\"",
        "coherence ",
        "9223372036854775807",
        "-9223372036854775808",
    ];
    [words(&keys), words(&UNITS)].concat()
}

pub fn uff() -> Vec<Vec<u8>> {
    let mut found = words(&[
        "    -1\n",
        "    58\n",
        "    55\n",
        "  2414\n",
        "  2411\n",
        "  2412\n",
        "  2420\n",
        "    15\n",
        "    82\n",
        "   151\n",
        "   164\n",
        "   161\n",
        "    18\n",
        "  2430\n",
        "    58b     2     2",
        "    58b     1     2",
        "NONE\n",
        "         1         4",
        "         2         5",
        "         6",
        "  1.00000E+00",
        " -0.00000D+00",
        "  1.0E+308",
        "         0         0",
        "2147483647",
        "-2147483648",
        "         5         6         7",
        "     99999999",
    ]);
    found.push([0_u8; 8].to_vec());
    found.push(vec![0xff; 8]);
    found
}

pub fn mat() -> Vec<Vec<u8>> {
    let mut found = bytes(&[
        b"MATLAB 5.0 MAT-file",
        b"\x00\x01IM",
        b"\x01\x00MI",
        b"\x0e\0\0\0",
        b"\x0f\0\0\0",
        b"\x06\0\0\0\x08\0\0\0",
        b"\x05\0\0\0\x08\0\0\0",
        b"\x01\0\0\0\x01\0\0\0",
        b"\x09\0\0\0",
        b"\x01\0\x04\0",
        b"\x02\0\x02\0",
        b"\x01\x08",
        b"\xff\xff\xff\xff",
        b"\xff\xff\xff\x7f",
        b"\0\0\0\x80",
        b"\x04\0\0\0",
        b"\x10\0\0\0",
        b"\x11\0\0\0",
        b"\x0c\0\0\0",
        b"\x01\0\0\0",
        b"\x02\0\0\0",
        b"\x0d\0\0\0",
        b"\0\0\0\0",
        b"\x9c\x4b\0\0",
        b"\xe8\x03\0\0",
        b"\x33\0\0\0",
    ]);
    found.extend(words(&[
        "fs", "dt", "time", "H", "freq", "info_t", "x_fs", "x_unit", "coh", "_RPM", "sr", "npts",
    ]));
    found
}

pub fn numpy() -> Vec<Vec<u8>> {
    words(&[
        "\u{1}\0",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (",
        "'shape': ()",
        "'shape': (0,)",
        "'shape': (9000000000000000000,)",
        "(4294967296, 4294967296)",
        "(2147483648, 0)",
        "'<f8'",
        "'>f8'",
        "'<c16'",
        "'<U4'",
        "'<U0'",
        "'<U4611686018427387904'",
        "'|S0'",
        "'|b1'",
        "'<i2'",
        "'<f2'",
        "'|O'",
        "'<M8[ns]'",
        "[('a', '<f8')]",
        "True",
        "False",
        "fortran_order",
        "fs",
        "dt",
        ".npy",
        "PK\u{3}\u{4}",
        "PK\u{1}\u{2}",
        "PK\u{5}\u{6}",
        "}",
        "), }",
        "-1",
        "'",
    ])
}

pub fn csv() -> Vec<Vec<u8>> {
    let mut found = words(&[
        ",",
        ";",
        "\t",
        "\"",
        "\"\"",
        "\r\n",
        "\n\n",
        "time [s]",
        "time_s",
        "t",
        "freq_hz",
        "x [m/s^2]",
        "x_um",
        "(mm)",
        "rpm",
        "1,5",
        "1.5e3",
        "nan",
        "inf",
        "-inf",
        "1e400",
        "\u{feff}",
        "#",
        "%",
        "\u{2212}5",
        "1'000",
        "# fs = 12000",
        "2026-11-23T12:00:00.5Z",
        "23.11.2026 12:00:00,5",
        "01/02/2026 1:00 PM",
        "Sampling rate: 12 kHz",
        "dt;0,001;s",
        "LabVIEW Measurement",
        "***End_of_Header***",
        "***Start_Special***",
        "Multi_Headings\tYes",
        "X_Columns\tMulti",
        "Channels\t2",
        "Delta_X\t0.001",
        "X_Value\ta\tComment",
        "real",
        "imag",
    ]);
    found.extend(words(&UNITS));
    found.extend(bytes(&[b"\xff\xfe", b"\xfe\xff", b"1\0,\0", b"\0\xd8", b"\xb5m"]));
    found
}

pub fn wav() -> Vec<Vec<u8>> {
    bytes(&[
        b"RIFF",
        b"RIFX",
        b"WAVE",
        b"fmt ",
        b"data",
        b"LIST",
        b"fact",
        b"JUNK",
        b"bext",
        b"\x10\0\0\0",
        b"\x12\0\0\0",
        b"\x28\0\0\0",
        b"\x01\0",
        b"\x03\0",
        b"\xfe\xff",
        b"\x18\0",
        b"\x20\0",
        b"\x40\0",
        b"\xff\xff\xff\xff",
        b"\0\0\0\0",
        b"\x44\xac\0\0",
        b"\x00\x00\x00\x00\x10\x00\x80\x00\x00\xaa\x00\x38\x9b\x71",
    ])
}

pub fn hdf5() -> Vec<Vec<u8>> {
    let mut found = bytes(&[
        b"\x89HDF\r\n\x1a\n",
        b"TREE",
        b"HEAP",
        b"SNOD",
        b"GCOL",
        b"OHDR",
        b"OCHK",
        b"FRHP",
        b"FHDB",
        b"FHIB",
        b"BTHD",
        b"BTLF",
        b"BTIN",
        b"FSHD",
        b"EAHD",
        b"FAHD",
        b"SMTB",
        b"\xff\xff\xff\xff\xff\xff\xff\xff",
        b"\0\0\0\0\0\0\0\0",
        b"\x60\0\0\0\0\0\0\0",
        b"\x11\0\x10\0",
        b"\x01\0\x18\0",
        b"\x03\0\x18\0",
        b"\x08\0\x18\0",
        b"\x0b\0\x18\0",
        b"\x0c\0\x18\0",
        b"\x10\0\x10\0",
        b"\x01\x01\x01\0",
        b"\x01\x20\x01\0",
        b"\x19\x01\x01\0",
        b"\x16\0\0\0",
        b"\x10\x08\0\0",
    ]);
    found.extend(words(&[
        "fs",
        "unit",
        "units",
        "dt",
        "wf_increment",
        "r\0",
        "i\0",
        "#refs#",
        "MATLAB_class",
        "double",
    ]));
    found
}

pub fn results() -> Vec<Vec<u8>> {
    let names = [
        "meta",
        "time",
        "theta",
        "speed",
        "channels",
        "names",
        "run_state",
        "complete",
        "motion",
        "bearings",
        "balls",
        "frf",
        "modes",
        "eigenvalue",
        "shapes",
        "rpm",
        "quantity",
        "station",
        "direction",
        "unit",
        "fs",
        "t0",
        "files",
        "paths",
        "columns",
        "units",
    ];
    [hdf5(), words(&names)].concat()
}
