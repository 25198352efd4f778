"""Records as other programs store them, with what a reader must find in them.

    python3 tests/files/foreign_records.py tests/data/arrays/foreign

writes the files of tests/data/arrays/foreign and expected.json: rate, names, units and values of every channel.
tests/files/foreign_records.rs reads them. Made with numpy 2.4.6, scipy 1.17.1 and h5py 3.16.0.
"""

import datetime
import json
import struct
import sys
from pathlib import Path

import h5py
import numpy as np
import scipy.io

out = Path(sys.argv[1])
N = 100
k = np.arange(N)
# Six digits, so that text holds the same numbers.
x = np.round(np.sin(0.31 * k) + 0.3 * np.cos(1.7 * k + 0.2), 6)
y = np.round(2.5 * np.cos(0.11 * k * k / 7), 6)
G = 9.80665
expected = {}


def channel(values, rate=None, unit="", si="", factor=1.0, frequency=None, start=0.0, speed=None):
    values = np.asarray(values)
    if values.dtype.kind == "c":
        numbers = [[float(v.real) * factor, float(v.imag) * factor] for v in values]
    else:
        numbers = [float(v) * factor for v in values]
    return {"values": numbers, "rate": rate, "file_unit": unit, "unit": si, "start": start, "frequency": frequency, "speed": speed}


def expect(name, channels, left_out=(), scalars=None, notes=(), sources=()):
    expected[name] = {
        "channels": channels,
        "left_out": list(left_out),
        "scalars": scalars or {},
        "notes": list(notes),
        "sources": list(sources),
    }


# MATLAB 5 and 4, by scipy.
def objects(*values):
    cells = np.empty((len(values),), dtype=object)
    for at, value in enumerate(values):
        cells[at] = value
    return cells


def matlab5():
    column = lambda v: np.asarray(v).reshape(-1, 1)
    scipy.io.savemat(out / "struct.mat", {"bearing": {"sr": 97656.0, "gs": column(x), "load": 270.0, "rate": 25.0}})
    expect("struct.mat", {"bearing.gs": channel(x, 97656.0)}, scalars={"bearing.load": 270.0, "bearing.rate": 25.0}, sources=["`bearing.sr` (97656)"])
    runs = np.zeros((2,), dtype=[("x", object), ("Fs", object), ("unit", object)])
    runs[0] = (column(x), 1000.0, "g")
    runs[1] = (column(y), 2000.0, "mm/s")
    scipy.io.savemat(out / "struct_array.mat", {"runs": runs, "fs": 50.0, "outside": column(x + 1)}, do_compression=True)
    expect(
        "struct_array.mat",
        {"runs(1).x": channel(x, 1000.0, "g", "m/s^2", G), "runs(2).x": channel(y, 2000.0, "mm/s", "m/s", 1e-3), "outside": channel(x + 1, 50.0)},
    )
    inner = objects(column(y), "inside")
    scipy.io.savemat(out / "cells.mat", {"SampleFrequency": 800.0, "c": objects(column(x), "a text", inner, {"a": column(2 * y), "dt": 0.5})})
    expect(
        "cells.mat",
        {"c{1}": channel(x, 800.0), "c{3}{1}": channel(y, 800.0), "c{4}.a": channel(2 * y, 2.0)},
        left_out=['c{2} (text "a text")', 'c{3}{2} (text "inside")'],
    )
    rig = {"acc": {"X_Value": column(0.01 * k), "signal": column(x), "units": "m/s^2"}, "frf": {"Freq_domain": column(0.5 * k), "H": column(x + 1j * y)}, "npts": 100.0}
    scipy.io.savemat(out / "nested.mat", {"rig": rig})
    expect(
        "nested.mat",
        {"rig.acc.signal": channel(x, 100.0, "m/s^2", "m/s^2"), "rig.frf.H": channel(x + 1j * y, frequency=[0.0, 0.5])},
        sources=["`rig.acc.X_Value`", "`rig.frf.Freq_domain`"],
    )
    scipy.io.savemat(out / "version_4.mat", {"fs": 640.0, "a": column(x), "b": np.stack([y, -y]).astype("f4").astype(float)}, format="4")
    four = y.astype("f4").astype(float)
    expect("version_4.mat", {"a": channel(x, 640.0), "b[1]": channel(four, 640.0), "b[2]": channel(-four, 640.0)})
    for name in ["struct", "struct_array", "cells", "nested"]:
        path = out / f"{name}.mat"
        # Without the date, so that the same script writes the same files.
        path.write_bytes(b"MATLAB 5.0 MAT-file".ljust(116) + path.read_bytes()[116:])


# MATLAB 7.3, as MATLAB lays it out in HDF5.
class Cell(list):
    """A column of a cell array."""


class Matlab73:
    def __init__(self, path):
        self.path = path
        self.file = h5py.File(path, "w", userblock_size=512, libver="earliest")
        self.count = 0

    def close(self):
        self.file.close()
        head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + b"\0" * 8 + b"\x00\x02IM"
        with open(self.path, "r+b") as raw:
            raw.write(head)

    def reference(self, value):
        refs = self.file.require_group("#refs#")
        name = f"r{self.count}"
        self.count += 1
        self.put(refs, name, value)
        return refs[name].ref

    def references(self, group, name, values):
        data = group.create_dataset(name, (1, len(values)), dtype=h5py.ref_dtype)
        for at, value in enumerate(values):
            data[0, at] = self.reference(value)
        return data

    def put(self, group, name, value):
        if isinstance(value, dict):
            made = group.create_group(name)
            made.attrs["MATLAB_class"] = np.bytes_("struct")
            for field, inner in value.items():
                self.put(made, field, inner)
        elif isinstance(value, Cell):
            self.references(group, name, value).attrs["MATLAB_class"] = np.bytes_("cell")
        elif isinstance(value, list):
            made = group.create_group(name)
            made.attrs["MATLAB_class"] = np.bytes_("struct")
            for field in value[0]:
                self.references(made, field, [element[field] for element in value])
        elif isinstance(value, str):
            codes = np.frombuffer(value.encode("utf-16-le"), dtype="<u2").reshape(-1, 1)
            made = group.create_dataset(name, data=codes)
            made.attrs["MATLAB_class"] = np.bytes_("char")
            made.attrs["MATLAB_int_decode"] = np.int32(2)
        else:
            value = np.asarray(value)
            if value.ndim < 2:
                value = value.reshape(-1, 1)
            if value.size == 0:
                made = group.create_dataset(name, data=np.array(value.shape, dtype="<u8"))
                made.attrs["MATLAB_empty"] = np.uint8(1)
            elif value.dtype.kind == "c":
                pairs = np.empty(value.T.shape, dtype=[("real", "<f8"), ("imag", "<f8")])
                pairs["real"], pairs["imag"] = value.T.real, value.T.imag
                made = group.create_dataset(name, data=pairs)
            else:
                made = group.create_dataset(name, data=np.ascontiguousarray(value.T))
            names = {"f8": "double", "f4": "single", "i2": "int16", "c16": "double", "u1": "uint8"}
            made.attrs["MATLAB_class"] = np.bytes_(names[value.dtype.str[1:]])


def matlab73():
    def write(name, **contents):
        file = Matlab73(out / name)
        for key, value in contents.items():
            file.put(file.file, key, value)
        file.close()

    write("struct_73.mat", bearing={"sr": 48828.0, "gs": x, "load": 300.0, "rate": 25.0, "note": "a bearing"})
    expect(
        "struct_73.mat",
        {"bearing.gs": channel(x, 48828.0)},
        left_out=['bearing.note (text "a bearing")'],
        scalars={"bearing.load": 300.0, "bearing.rate": 25.0},
        sources=["`bearing.sr` (48828)"],
    )
    write("struct_array_73.mat", fs=10.0, runs=[{"x": x, "Fs": 1000.0, "unit": "g"}, {"x": y.astype("f4"), "Fs": 2000.0, "unit": "mm/s"}])
    expect(
        "struct_array_73.mat",
        {"runs(1).x": channel(x, 1000.0, "g", "m/s^2", G), "runs(2).x": channel(y.astype("f4"), 2000.0, "mm/s", "m/s", 1e-3)},
        scalars={"fs": 10.0},
    )
    deep = {"one": {"two": {"dt": 0.001, "c": Cell([x, Cell([-y]), {"z": 3 * x, "fs": 5.0}])}}}
    write("cells_73.mat", **deep, empty=np.zeros((0, 0)))
    expect(
        "cells_73.mat",
        {"one.two.c{1}": channel(x, 1000.0), "one.two.c{2}{1}": channel(-y, 1000.0), "one.two.c{3}.z": channel(3 * x, 5.0)},
        left_out=["/empty (empty)"],
    )
    # Responses of two points to one over 100 lines, in MATLAB's order of indices.
    h = np.stack([x + 1j * y, y - 2j * x])[:, None, :]
    write("frf_73.mat", test={"Freq_domain": 0.25 * k, "H": h, "npts": 100.0, "counts": (10 * x).astype("i2")})
    lines = [0.0, 0.25]
    expect(
        "frf_73.mat",
        {
            "test.H[1]": channel(h[0, 0], frequency=lines),
            "test.H[2]": channel(h[1, 0], frequency=lines),
            "test.counts": channel((10 * x).astype("i2"), frequency=lines),
        },
    )


def numpy_and_hdf5():
    np.savez(out / "names.npz", x=x, y=y, SampleFrequency=np.array(4096.0), x_unit="g", X105RPM=1797.0)
    expect("names.npz", {"x": channel(x, 4096.0, "g", "m/s^2", G, speed=1797.0), "y": channel(y, 4096.0, speed=1797.0)}, scalars={"X105RPM": 1797.0})
    np.savez(out / "times.npz", t_ms=0.5 * k, x=x.astype("f4"), npts=np.int32(100), o=np.array([None]), n=np.zeros((0,)))
    expect("times.npz", {"x": channel(x.astype("f4"), 2000.0)}, left_out=["o (Python objects or a structured type)", "n (empty)"], sources=["`t_ms`"])
    np.savez(out / "force.npz", f=y, dt=0.125, T=20.0 + 0.01 * k)
    # `f` does not increase: it is a force. The temperature does, but so does time: `dt` is nearer to nothing else.
    np.savez(out / "force.npz", f=y, dt=0.125)
    expect("force.npz", {"f": channel(y, 8.0)}, sources=["`dt` (0.125)"])
    with h5py.File(out / "attributes.h5", "w") as file:
        file.attrs["Fs"] = 100.0
        group = file.create_group("rig")
        group.attrs["SampleFrequency"] = 256.0
        group.attrs["operator"] = "nobody"
        a = group.create_dataset("a", data=x)
        a.attrs["units"] = "g"
        b = group.create_dataset("b", data=y)
        b.attrs["wf_increment"] = 0.002
        b.attrs["wf_start_offset"] = 1.5
        b.attrs["unit"] = "N"
        b.attrs["calibration"] = 10.2
        file["c"] = x + y
        file["sub/sr"] = 12.0
        file["sub/d"] = x - y
    expect(
        "attributes.h5",
        {
            "c": channel(x + y, 100.0),
            "rig.a": channel(x, 256.0, "g", "m/s^2", G),
            "rig.b": channel(y, 500.0, "N", "N", start=1.5),
            "sub.d": channel(x - y, 12.0),
        },
        left_out=['rig.operator (text "nobody")'],
        scalars={"rig.b.calibration": 10.2},
    )


# Text by hand.
def text(name, lines, encoding="utf-8", mark=b""):
    (out / name).write_bytes(mark + ("\n".join(lines) + "\n").encode(encoding))


def rows(separator, *columns, end="", comma=False):
    lines = [separator.join(f"{v:.6f}" if not isinstance(v, str) else v for v in row) + end for row in zip(*columns)]
    return [line.replace(".", ",") for line in lines] if comma else lines


def tables():
    t = k / 1000.0
    taken = "the table has no names: its first column is taken as time in s"
    text("no_header.csv", rows(",", t, x, y))
    expect("no_header.csv", {"no_header_2": channel(x, 1000.0), "no_header_3": channel(y, 1000.0)}, notes=[taken])
    text("counted.txt", [f"{n} {v:.6f}" for n, v in zip(k, x)])
    expect("counted.txt", {"counted_2": channel(x)}, left_out=["the first column (it counts the lines)"], notes=["no sampling rate or frequency step is stated for counted_2"])
    text("trailing.csv", ["time [s];a [g];b", *rows(";", t, x, y, end=";")])
    expect("trailing.csv", {"a": channel(x, 1000.0, "g", "m/s^2", G), "b": channel(y, 1000.0)})
    text("comma.csv", ["Zeit (ms);Weg in µm;a / m/s²", *rows(";", 1e3 * t, x, y, comma=True)])
    expect("comma.csv", {"Weg": channel(x, 1000.0, "µm", "m", 1e-6), "a": channel(y, 1000.0, "m/s²", "m/s^2")})
    text("rate.csv", ["Instrument: NN-1", "Sampling rate: 12 kHz", "x [mm/s];y", *rows(";", x, y)])
    expect(
        "rate.csv",
        {"x": channel(x, 12000.0, "mm/s", "m/s", 1e-3), "y": channel(y, 12000.0)},
        left_out=["a line before the numbers (`Instrument: NN-1`)"],
        sources=["`Sampling rate` (12)"],
    )
    text("step.txt", ["# dt = 0.5 ms", "# x y", *rows(" ", x, y)])
    expect("step.txt", {"x": channel(x, 2000.0), "y": channel(y, 2000.0)})
    text("fs_column.csv", ["fs,x", *rows(",", 0 * t + 640, x)])
    expect("fs_column.csv", {"x": channel(x, 640.0)})
    start = datetime.datetime(2026, 11, 23, 23, 59, 59, 950000)
    times = [start + datetime.timedelta(milliseconds=int(n)) for n in k]
    iso = [moment.isoformat(timespec="milliseconds") for moment in times]
    text("iso.csv", ["time,x [g]", *rows(",", iso, x)])
    expect("iso.csv", {"x": channel(x, 1000.0, "g", "m/s^2", G)}, sources=["the column `dates`"])
    german = [moment.strftime("%d.%m.%Y %H:%M:%S,%f")[:-3] for moment in times]
    text("german.csv", ["Datum;x [mm]", *[f"{a};{v:.6f}".replace(".", ",") if False else f"{a};" + f"{v:.6f}".replace(".", ",") for a, v in zip(german, x)]])
    expect("german.csv", {"x": channel(x, 1000.0, "mm", "m", 1e-3)})
    us = [moment.strftime("%m/%d/%Y\t%I:%M:%S.%f %p") for moment in times]
    text("us.txt", ["Date\tTime\tx", *[f"{a}\t{v:.6f}" for a, v in zip(us, x)]])
    expect("us.txt", {"x": channel(x, 1000.0)})
    for name, encoding, mark in [
        ("utf16_le", "utf-16-le", b"\xff\xfe"),
        ("utf16_be", "utf-16-be", b"\xfe\xff"),
        ("utf16_le_bare", "utf-16-le", b""),
        ("utf16_be_bare", "utf-16-be", b""),
    ]:
        text(f"{name}.csv", ["t [s];x [µm]", *rows(";", t, x, comma=True)], encoding, mark)
        expect(f"{name}.csv", {"x": channel(x, 1000.0, "µm", "m", 1e-6)})


def labview():
    head = ["LabVIEW Measurement\t", "Writer_Version\t2", "Reader_Version\t2", "Separator\tTab", "Decimal_Separator\t{}", "Multi_Headings\t{}", "X_Columns\t{}", "Time_Pref\tAbsolute", "Operator\tnobody", "Date\t2026/11/23", "Time\t12:00:00,5", "***End_of_Header***\t", "\t"]

    def header(decimal, multi, columns):
        filled = iter([decimal, multi, columns])
        return [line.format(next(filled)) if "{}" in line else line for line in head]

    def segment(channels, count, units, x0, dx, names):
        line = lambda key, values: key + "\t" + "\t".join(str(v) for v in values) + "\t"
        return [
            line("Channels", [channels]),
            line("Samples", [count] * channels),
            line("Date", ["2026/11/23"] * channels),
            line("Time", ["12:00:00.5"] * channels),
            line("Y_Unit_Label", units),
            line("X_Dimension", ["Time"] * channels),
            line("X0", [f"{x0:.16E}"] * channels),
            line("Delta_X", [f"{dx:f}"] * channels),
            "***End_of_Header***\t" + "\t" * channels,
            names,
        ]

    dx = 0.0005
    lines = header(".", "Yes", "One")
    # Two segments, of which the second goes on where the first ends.
    for first, last in [(0, 60), (60, 100)]:
        lines += segment(2, last - first, ["g", "Volts"], first * dx, dx, "X_Value\tacc\tmotor current\tComment")
        body = rows("\t", k[first:last] * dx, x[first:last], y[first:last])
        body[0] += "\tstart" if first == 0 else ""
        lines += body + [""]
    text("segments.lvm", lines)
    expect(
        "segments.lvm",
        {"acc": channel(x, 2000.0, "g", "m/s^2", G), "motor current": channel(y, 2000.0, "Volts")},
        left_out=["1 comments of the column Comment"],
        sources=["`Delta_X` (0.0005)"],
    )
    lines = header(",", "No", "No") + segment(1, N, ["m/s^2"], 0.25, dx, "X_Value\ta\tComment")
    lines += [line.replace(".", ",") for line in rows("\t", [""] * N, x)]
    text("no_x.lvm", [line.replace("0.000500", "0,000500") for line in lines])
    expect("no_x.lvm", {"a": channel(x, 2000.0, "m/s^2", "m/s^2", start=0.25)})
    lines = header(".", "Yes", "Multi") + segment(2, N, ["g", "mm/s"], 0.0, dx, "X_Value\ta\tX_Value\tb\tComment")
    lines[-4:-2] = [lines[-4], lines[-3].replace("\t0.000500\t0.000500", f"\t{dx:f}\t{2 * dx:f}")]
    text("multi.lvm", lines + rows("\t", k * dx, x, 2 * k * dx, y))
    expect("multi.lvm", {"a": channel(x, 2000.0, "g", "m/s^2", G), "b": channel(y, 1000.0, "mm/s", "m/s", 1e-3)})


def waves():
    chunk = lambda name, body: name + struct.pack("<I", len(body)) + body + b"\0" * (len(body) % 2)

    def wav(name, code, channels, bits, data, extra=b"", extensible=False, long=False):
        block = channels * bits // 8
        form = struct.pack("<HHIIHH", 0xFFFE if extensible else code, channels, 51200, 51200 * block, block, bits)
        if extensible:
            guid = struct.pack("<H", code) + bytes.fromhex("000000001000800000aa00389b71")
            form += struct.pack("<HHI", 22, bits, 3) + guid
        chunks = chunk(b"fmt ", form) + extra
        if long:
            ds64 = chunk(b"ds64", struct.pack("<QQQI", 0, len(data), len(data) // block, 0))
            body = ds64 + chunks + b"data" + b"\xff\xff\xff\xff" + data
            (out / name).write_bytes(b"RF64\xff\xff\xff\xffWAVE" + body)
        else:
            chunks += chunk(b"data", data)
            (out / name).write_bytes(b"RIFF" + struct.pack("<I", 4 + len(chunks)) + b"WAVE" + chunks)

    both = np.stack([x, y], axis=1)
    rate = 51200.0
    wav("double.wav", 3, 2, 64, both.astype("<f8").tobytes(), chunk(b"LIST", b"INFOabc"))
    expect("double.wav", {"double_1": channel(x, rate), "double_2": channel(y, rate)}, left_out=["the chunk LIST (7 bytes)"])
    wav("single.wav", 3, 1, 32, x.astype("<f4").tobytes())
    expect("single.wav", {"single": channel(x.astype("<f4"), rate)})
    whole = np.round(x / 2 * 2**23).astype("<i4")
    packed = b"".join(int(v).to_bytes(3, "little", signed=True) for v in whole)
    wav("pcm24.wav", 1, 1, 24, packed)
    expect("pcm24.wav", {"pcm24": channel(whole / 2.0**23, rate)})
    wav("extensible.wav", 3, 2, 64, both.astype("<f8").tobytes(), extensible=True)
    expect("extensible.wav", {"extensible_1": channel(x, rate), "extensible_2": channel(y, rate)})
    short = np.round(x / 2 * 2**15).astype("<i2")
    wav("rf64.wav", 1, 1, 16, short.tobytes(), long=True)
    expect("rf64.wav", {"rf64": channel(short / 2.0**15, rate)})


out.mkdir(parents=True, exist_ok=True)
matlab5()
matlab73()
numpy_and_hdf5()
tables()
labview()
waves()
(out / "expected.json").write_text(json.dumps(expected, indent=None, separators=(",", ":")).replace('"channels"', '\n"channels"') + "\n")
