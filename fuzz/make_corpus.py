#!/usr/bin/env python3
"""Writes the seeds in fuzz/corpus: small valid files of every format, as numpy, scipy, h5py and rotordyn write them.

    fuzz/make_corpus.py target/debug/rotordyn
"""
import io
import math
import struct
import subprocess
import sys
import tempfile
import wave
from pathlib import Path

import h5py
import numpy as np
import scipy.io

CORPUS = Path(__file__).resolve().parent / "corpus"


def folder(name):
    path = CORPUS / name
    path.mkdir(parents=True, exist_ok=True)
    return path


T = np.arange(40) / 1000.0
X = np.sin(2 * math.pi * 50 * T)
F = np.arange(12) * 2.0
H = 1 / (1 - (F / 9.0) ** 2 + 0.05j)


def mappings():
    out = folder("mapping")
    texts = {
        "channels": 'rate = "12 kHz"\n\n[channel.x]\nstation = "A"\ndirection = "y"\nunit = "g"\n\n'
        '[channel.y]\nstation = "B"\ndirection = "-x"\noffset = "150, 0, 0 mm"\n\n[channel.n]\nunit = "rpm"\n',
        "points": 'axes = ["z", "x", "y"]\nfrequency_step = "0.5 Hz"\n\n[point.1]\nstation = "A"\ndirection = "x"\n\n'
        '[point.2]\nstation = "B"\n\n[point.3]\nstation = "disc1"\noffset = "0, 10, 0 mm"\ndirection = "y"\n',
        "reference": '[channel.H]\nstation = "A"\ndirection = "x"\nunit = "g/N"\n'
        'reference = { station = "B", direction = "-Ry", offset = "1, 2, 3 mm" }\n',
        "empty": "# nothing is moved\n",
    }
    for name, text in texts.items():
        (out / f"{name}.toml").write_text(text)


def tables():
    out = folder("csv")
    rows = lambda separator, *columns: "\n".join(separator.join(f"{v:.6g}" for v in row) for row in zip(*columns)) + "\n"
    (out / "units.csv").write_text("time [s],x [m/s^2],y (mm),n_rpm\n" + rows(",", T, X, 2 * X, 0 * T + 1500))
    (out / "comma.csv").write_text("Zeit (ms);Weg (µm)\n" + rows(";", 1e3 * T, X).replace(".", ","))
    (out / "latin1.csv").write_bytes("t;a [m/s²];T [°C]\n".encode("latin-1") + rows(";", T, X, X).encode())
    (out / "blanks.txt").write_text("# rate 1 kHz\n" + rows("   ", T, X))
    (out / "bare.txt").write_text(rows("\t", X, 3 * X))
    (out / "frf.csv").write_text("freq_hz,H_re,H_im,coh\n" + rows(",", F, H.real, H.imag, 0 * F + 1))
    (out / "cells.csv").write_text("f,H\n" + "".join(f"{f},({h.real:.5f}{h.imag:+.5f}j)\n" for f, h in zip(F, H)))
    (out / "quoted.csv").write_text('"time, of the record","a ""quoted"" name"\ns,g\n' + rows(",", T, X))
    (out / "utf16.csv").write_bytes(("time [s],x [m]\n" + rows(",", T[:6], X[:6])).encode("utf-16"))
    (out / "gaps.csv").write_text("t,x,y\n0,1,\n0.1,,3\n0.2,nan,4\n0.3,1e400,-inf\n")


def arrays():
    out = folder("numpy")
    for name, array in {
        "f8": X,
        "f4_big": X.astype(">f4"),
        "c16": H,
        "fortran": np.asfortranarray(np.arange(24.0).reshape(2, 3, 4)),
        "i2": np.arange(20, dtype="<i2"),
        "bool": X > 0,
        "text": np.array(["a", "bcd", "µ"]),
        "bytes": np.array([b"g", b"m/s"]),
        "scalar": np.array(12000.0),
    }.items():
        np.save(out / f"{name}.npy", array)
    with open(out / "version2.npy", "wb") as file:
        np.lib.format.write_array(file, X[:5], version=(2, 0))
    np.savez(out / "records.npz", x=X, y=2 * X, fs=1000.0, x_unit="g", n_rpm=1500.0)
    np.savez_compressed(out / "frf.npz", freq_hz=F, H=np.stack([[H, 2 * H], [H, H]]), coh=np.ones((2, 2, len(F))))


def matlab():
    out = folder("mat")
    records = {"x": X, "fs": 1000.0, "X105RPM": 1797.0, "note": "a record", "n": np.arange(5, dtype=np.int16)}
    scipy.io.savemat(out / "records_v5.mat", records)
    scipy.io.savemat(out / "compressed_v5.mat", records, do_compression=True)
    scipy.io.savemat(out / "records_v4.mat", {"x": X, "fs": 1000.0, "t": T, "text": "abc"}, format="4")
    scipy.io.savemat(out / "frf_v5.mat", {"freq": F, "H": np.stack([[H, 2 * H]]), "coh": np.ones((1, 2, len(F)))})
    scipy.io.savemat(
        out / "struct_v5.mat",
        {"bearing": {"gs": X[:8], "sr": 97656.0, "load": 270.0, "nested": {"a": 1.0}}, "cell": np.array([X[:3], "a"], dtype=object)},
    )
    # As the analyser SignalCalc writes them: axis and value, with a list of what they are.
    info = ["Signal X1", "Real EU N", "0 0 0", "Signal H1_2", "Real/Imag g / N", "0 0 0", "Signal C1_2", "Real"]
    columns = {"X1": np.stack([T, X], axis=1), "H1_2": np.stack([F, H], axis=1), "C1_2": np.stack([F, 0 * F + 1], axis=1)}
    scipy.io.savemat(out / "signal_calc_v5.mat", {"DP_Info": np.array(info), **columns})
    for path in out.glob("*_v5.mat"):
        # Without the date, so that the same script writes the same files.
        path.write_bytes(b"MATLAB 5.0 MAT-file".ljust(116) + path.read_bytes()[116:])
    (out / "text.mat").write_text("# Created by Octave\n# name: x\n# type: matrix\n# rows: 3\n# columns: 2\n 1 2\n 3 4\n 5 6\n\n")


def waves():
    out = folder("wav")
    for width in (1, 2, 3, 4):
        data = io.BytesIO()
        with wave.open(data, "wb") as file:
            file.setnchannels(1 + width % 2)
            file.setsampwidth(width)
            file.setframerate(8000)
            file.writeframes(bytes(range(48)) * (1 + width % 2))
        (out / f"pcm{8 * width}.wav").write_bytes(data.getvalue())
    samples = X[:24].astype("<f4").tobytes()
    form = struct.pack("<HHIIHH", 3, 1, 8000, 32000, 4, 32)
    chunk = lambda name, body: name + struct.pack("<I", len(body)) + body + b"\0" * (len(body) % 2)
    riff = lambda *chunks: b"RIFF" + struct.pack("<I", 4 + sum(map(len, chunks))) + b"WAVE" + b"".join(chunks)
    (out / "float.wav").write_bytes(riff(chunk(b"fmt ", form), chunk(b"data", samples)))
    guid = bytes.fromhex("0300000000001000800000aa00389b71")
    extensible = struct.pack("<HHIIHHHHI", 0xFFFE, 2, 8000, 64000, 8, 32, 22, 32, 3) + guid
    (out / "extensible.wav").write_bytes(
        riff(chunk(b"JUNK", b"abc"), chunk(b"fmt ", extensible), chunk(b"fact", struct.pack("<I", 12)), chunk(b"LIST", b"INFO"), chunk(b"data", samples))
    )


def universal():
    # tests/data/uff has files with every kind of data set; these have odd ends of lines and an unknown kind.
    out = folder("uff")
    line = lambda text: f"{text:<80}\n"
    header = ["x at A", "NONE", "23-NOV-26 12:00:00", "NONE", "NONE"]
    numbers = "    1         0    0         0 A                   1   3 NONE                0   0"
    form = "         2         8         1  0.00000e+00  1.00000e-03  0.00000e+00"
    axes = ["        17    0    0    0                 Time                    s", "        12    0    0    0         acceleration                m/s^2"]
    none = "         0    0    0    0                 NONE                 NONE"
    values = "".join(f"{v:13.5e}" for v in X[:8])
    body = [*header, numbers, form, *axes, none, none, values[:78], values[78:]]
    text = "    -1\n" + line("    58") + "".join(map(line, body)) + "    -1\n"
    (out / "time.uff").write_text(text)
    (out / "crlf.uff").write_bytes(text.replace("\n", "\r\n").encode())
    (out / "unknown.uff").write_text("    -1\n  9999\nwords\n    -1\n" + text)


def hdf5():
    out = folder("hdf5")

    def write(name, fill, **settings):
        with h5py.File(out / f"{name}.h5", "w", **settings) as file:
            fill(file)

    def records(file):
        for name, values in {"x": X, "y": 2 * X}.items():
            data = file.create_dataset(name, data=values)
            data.attrs["unit"] = "m/s^2"
            data.attrs["fs"] = 1000.0

    def chunked(file):
        group = file.create_group("run/a")
        group.create_dataset("x", data=X, chunks=(16,), compression="gzip", shuffle=True, fletcher32=True)
        group.create_dataset("i", data=np.arange(40, dtype=">i2"), chunks=(10,), maxshape=(None,))
        group.create_dataset("scaled", data=np.arange(40), chunks=(20,), scaleoffset=0)

    def kinds(file):
        file["text"] = "variable length"
        file["texts"] = np.array(["a", "µ"], dtype=object)
        file["fixed"] = np.bytes_("fixed length")
        file["complex"] = H
        file["bool"] = X > 0
        file["compound"] = np.zeros(3, dtype=[("a", "f8"), ("b", "i4", (2,))])
        file["empty"] = h5py.Empty("f8")
        file["zero"] = np.zeros((0, 3))
        file["scalar"] = 12000.0
        vlen = file.create_dataset("vlen", (2,), dtype=h5py.vlen_dtype("f8"))
        vlen[0] = [1.0, 2.0]
        enum = h5py.enum_dtype({"off": 0, "on": 1}, basetype="i1")
        file.create_dataset("enum", data=np.zeros(3, dtype="i1"), dtype=enum)
        file.create_dataset("reference", data=file["scalar"].ref, dtype=h5py.ref_dtype)

    def links(file):
        file["a/x"] = X[:10]
        file["hard"] = file["a/x"]
        file["soft"] = h5py.SoftLink("/a/x")
        file["dangling"] = h5py.SoftLink("/nowhere")
        file["external"] = h5py.ExternalLink("other.h5", "/x")
        file["a/cycle"] = file["a"]

    def matlab73(file):
        data = file.create_dataset("x", data=X.reshape(-1, 1).T)
        data.attrs["MATLAB_class"] = np.bytes_("double")
        rate = file.create_dataset("fs", data=np.array([[1000.0]]))
        rate.attrs["MATLAB_class"] = np.bytes_("double")
        group = file.create_group("bearing")
        group.attrs["MATLAB_class"] = np.bytes_("struct")
        group["gs"] = X.reshape(1, -1)
        cells = file.create_group("#refs#")
        cells["a"] = X[:3]
        file.create_dataset("cell", data=np.array([[cells["a"].ref]], dtype=object), dtype=h5py.ref_dtype)
        name = file.create_dataset("name", data=np.frombuffer("abc".encode("utf-16-le"), dtype="<u2").reshape(-1, 1))
        name.attrs["MATLAB_class"] = np.bytes_("char")

    write("records", records)
    write("records_latest", records, libver="latest")
    write("chunked", chunked)
    write("chunked_latest", chunked, libver="latest")
    write("kinds", kinds)
    write("links", links)
    write("matlab73", matlab73, userblock_size=512)


MODEL = """
[model]
name = "small"
[material.steel]
young = "207 GPa"
poisson = 0.3
density = "7850 kg/m^3"
[shaft]
element_length = "100 mm"
section = [{ length = "400 mm", outer_diameter = "20 mm" }]
[station]
A = "0 mm"
disc = "200 mm"
B = "400 mm"
[disc.main]
station = "disc"
outer_diameter = "160 mm"
thickness = "20 mm"
material = "steel"
[bearing.A]
station = "A"
model = "linear"
k_xx = "1e7 N/m"
k_yy = "1e7 N/m"
[bearing.B]
station = "B"
BEARING
[unbalance.disc]
station = "disc"
magnitude = "50 g mm"
[damping.modal]
frequency = "50 Hz"
ratio = 0.01
[drive]
kind = "prescribed"
station = "A"
[speed]
profile = "ramp"
ramp = "0.1 s"
to = "1200 rpm"
[probe.disc_y]
at = "disc.main"
direction = "y"
[probe.disc_x]
at = "disc.main"
direction = "x"
quantity = "acceleration"
"""

STUDIES = """
[study.static]
[study.modal]
speeds = "0, 1200 rpm"
modes = 3
[study.frf]
frequencies = { from = "10 Hz", to = "60 Hz", step = "10 Hz" }
[study.frf.excitation.disc]
at = "disc.main"
direction = "x"
[study.run_up]
step = "200 us"
sample_rate = "1 kHz"
cutoff = "400 Hz"
motion_rate = "50 Hz"
"""


def results(program):
    out = folder("results")
    linear = 'model = "linear"\nk_xx = "1e7 N/m"\nk_yy = "1e7 N/m"'
    run_up = STUDIES[STUDIES.index("[study.run_up]") :]
    for name, bearing, studies, command in [
        ("run", linear, STUDIES, "run"),
        ("modal", linear, "", "modal"),
        ("ball", 'model = "ball"\ndesignation = "6204"', run_up, "run"),
    ]:
        with tempfile.TemporaryDirectory() as work:
            model = Path(work) / "small.toml"
            model.write_text(MODEL.replace("BEARING", bearing) + studies)
            call = [program, command, model, "--out", Path(work) / "out", "--no-figures"]
            subprocess.run(call, check=True, stdout=subprocess.DEVNULL)
            (out / f"{name}.h5").write_bytes((Path(work) / "out" / "results.h5").read_bytes())


def main():
    mappings()
    tables()
    arrays()
    matlab()
    waves()
    universal()
    hdf5()
    if len(sys.argv) > 1:
        results(sys.argv[1])


main()
