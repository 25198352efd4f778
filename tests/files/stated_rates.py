"""Records whose rate or axis is stated in many ways: `stated_rates.py FOLDER` writes them for stated_rates.rs.

Each axis name in MATLAB 5 (scipy), MATLAB 7.3 (h5py), NumPy and CSV; rates as text; two rates; attributes of other types.
"""

import sys
from pathlib import Path

import h5py
import numpy as np
import scipy.io

out = Path(sys.argv[1])
N = 100
x = np.round(np.sin(0.31 * np.arange(N)), 6)
times = np.arange(N) / 200.0
frequencies = 0.5 * np.arange(N)


def mat5(name, values):
    columns = {key: np.reshape(v, (-1, 1)) if np.ndim(v) else v for key, v in values.items()}
    scipy.io.savemat(out / f"{name}.mat", columns)


def mat73(name, values):
    path = out / f"{name}_73.mat"
    with h5py.File(path, "w", userblock_size=512) as file:
        for key, value in values.items():
            if isinstance(value, str):
                codes = np.frombuffer(value.encode("utf-16-le"), dtype="<u2").reshape(-1, 1)
                made = file.create_dataset(key, data=codes)
                made.attrs["MATLAB_class"] = np.bytes_("char")
            else:
                made = file.create_dataset(key, data=np.reshape(value, (1, -1)))
                made.attrs["MATLAB_class"] = np.bytes_("double")
    with open(path, "r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(116) + b"\0" * 8 + b"\x00\x02IM")


def npz(name, values):
    np.savez(out / f"{name}.npz", **{key: np.array(value) for key, value in values.items()})


def csv(name, values):
    lists = {key: v for key, v in values.items() if np.ndim(v)}
    lines = [f"# {key}: {v}" for key, v in values.items() if not np.ndim(v)]
    lines.append(",".join(lists))
    lines.extend(",".join(repr(float(v[k])) for v in lists.values()) for k in range(N))
    (out / f"{name}.csv").write_text("\n".join(lines) + "\n")


for write in [mat5, mat73, npz, csv]:
    for key, value in {"sr": 200.0, "fs": 200.0, "Fs": 200.0, "SampleFrequency": 200.0, "dt": 0.005}.items():
        write(f"one_{key}_{key.islower()}", {key: value, "acc": x})
    for key in ["t", "X_Value"]:
        write(f"time_{key}", {key: times, "acc": x})
    for key in ["freq", "Freq_domain", "f"]:
        write(f"frequency_{key}", {key: frequencies, "acc": x})
    # The number of samples alone is no rate, and is said if it is another.
    write("count", {"npts": 90.0, "fs": 200.0, "acc": x})
    for at, text in enumerate(["200", "200 Hz", "0.2 kHz", "0,2 kHz", "200 S/s"]):
        write(f"text_{at}", {"fs": text, "acc": x})
    write("text_step", {"dt": "5 ms", "acc": x})
    write("no_rate", {"fs": "fast", "acc": x})
    write("two", {"fs": 200.0, "dt": 0.004, "acc": x})
    write("two_times", {"fs": 250.0, "t": times, "acc": x})

with h5py.File(out / "attributes.h5", "w") as file:
    made = file.create_dataset("acc", data=x)
    made.attrs["fs"] = "0.2 kHz"
    made.attrs["calibrated"] = True
    made.attrs["colour"] = np.array((1, 2.0), dtype=[("a", "i4"), ("b", "f8")])
