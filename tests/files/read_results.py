"""Checks the example file of hdf5_h5py.rs with plain h5py."""

import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1], "r") as file:
    meta = file["meta"].attrs
    assert meta["program"] == "rotordyn" and isinstance(meta["program"], str)
    assert meta["seed"] == 42 and meta["seed"].dtype == np.int64
    assert np.array_equal(meta["gravity"], [0.0, -9.80665, 0.0])
    assert list(meta["stations"]) == ["disc", "Lager µ"]

    shapes = file["modes/shapes"]
    assert shapes.dtype == np.complex128 and shapes.attrs["unit"] == "m"
    assert np.array_equal(shapes[:], np.arange(6).reshape(2, 3) * (1 - 0.5j))
    assert list(file["modes/label"].asstr()[:]) == ["bending 1 ↺", "torsion 1"]

    for name in ["B_x", "B_y"]:
        spectrum = file["spectra"][name]
        assert spectrum.dtype == np.float64 and spectrum.attrs["unit"] == "dB re 1 m/s2"
        assert np.array_equal(spectrum[:], np.arange(2560.0).reshape(40, 64))
        assert spectrum.chunks is not None and spectrum.shuffle and spectrum.compression == "gzip"
        assert [list(dim.keys()) for dim in spectrum.dims] == [["rpm"], ["frequency"]]
        assert [dim.label for dim in spectrum.dims] == ["rpm", "frequency"]
        assert spectrum.dims[0]["rpm"] == file["spectra/rpm"]
        assert np.array_equal(spectrum.dims[1][0][:], 2.5 * np.arange(64))
    assert file["spectra/rpm"].is_scale and not file["spectra/B_x"].is_scale
    assert len(file["spectra/rpm"].attrs["REFERENCE_LIST"]) == 2

    assert file["time"].attrs["run_state"] == "complete"
    t = file["time/t"][:]
    assert np.array_equal(t, 0.25 + np.arange(5000) / 1000)
    assert np.array_equal(file["time/theta"][:], 2 * t) and np.all(file["time/speed"][:] == 2)
    assert [file["time"][name].attrs["unit"] for name in ("t", "theta", "speed")] == ["s", "rad", "rad/s"]
    channel = file["channels/B ay"]
    assert np.array_equal(channel[:], np.arange(5000.0))
    expected = dict(unit="m/s2", quantity="acceleration", station="B", direction="y", fs=1000.0, t0=0.25)
    assert {key: channel.attrs[key] for key in expected} == expected
    assert channel.dims[0][0] == file["time/t"]
