"""Prints as JSON what scipy and numpy read from the .mat and .npz files of a folder; `--write` first writes theirs.

Created tests/data/arrays/numpy.json, scipy_compressed.mat and numpy_compressed.npz (numpy 2.4.6, scipy 1.17.1):
    ROTORDYN_BLESS=1 cargo test --test files arrays
    python3 tests/files/read_arrays.py tests/data/arrays --write > tests/data/arrays/numpy.json
"""

import json
import os
import sys

import numpy as np
import scipy.io

folder = sys.argv[1]


def plain(value):
    value = np.asarray(value)
    if value.dtype.kind in "US":
        return [str(v).rstrip() for v in value.ravel()]
    if value.dtype.kind == "c":
        return np.ascontiguousarray(value).view(float).ravel().tolist()
    return value.astype(float).ravel().tolist()


if "--write" in sys.argv:
    k = np.arange(12.0)
    wave = np.sin(0.3 * k)
    cube = (k[:, None, None] + 10 * np.arange(3)[None, :, None] + 100 * np.arange(2)[None, None, :]).astype(complex)
    cube += 1j * k[:, None, None]
    arrays = {
        "H": np.moveaxis(cube, 0, -1),
        "freq": 0.5 * k,
        "coh": np.full((3, 2, 12), 0.5, np.float32),
        "X7_DE_time": wave,
        "X7RPM": np.uint16(1797),
    }
    scipy.io.savemat(os.path.join(folder, "scipy_compressed.mat"), arrays | {"title": "test", "s": {"a": 1}, "e": []}, do_compression=True)
    more = {
        "big": wave.astype(">f8"),
        "small": wave.astype(np.float32),
        "short": k.astype(">i2"),
        "flags": k > 5,
        "fortran": np.asfortranarray(np.outer(k, [1.0, 2.0])),
        "short_unit": np.array("m/s²"),
        "objects": np.array([{"a": 1}, None], object),
    }
    np.savez_compressed(os.path.join(folder, "numpy_compressed.npz"), **arrays, **more)

found = {}
mat = scipy.io.loadmat(os.path.join(folder, "all.mat"))
found["all.mat"] = {name: plain(value) for name, value in mat.items() if not name.startswith("__")}
with np.load(os.path.join(folder, "all.npz")) as npz:
    found["all.npz"] = {name: plain(npz[name]) for name in npz.files}
json.dump(found, sys.stdout, indent=1, sort_keys=True)
