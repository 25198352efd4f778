"""Compares the rig's results.h5, read with plain h5py, with the same results in JSON."""

import json
import sys

import h5py
import numpy as np

with open(sys.argv[2], encoding="utf-8") as text:
    want = json.load(text)


def same(got, expected):
    got, expected = np.asarray(got, float), np.array(expected, float)
    assert got.shape == expected.shape, (got.shape, expected.shape)
    assert np.allclose(got, expected, rtol=1e-14, atol=0, equal_nan=True)


def texts(dataset):
    return dataset.asstr()[:].tolist()


with h5py.File(sys.argv[1], "r") as file:

    def has_unit(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind in "fc":
            assert isinstance(item.attrs["unit"], str), name

    file.visititems(has_unit)

    meta = file["meta"].attrs
    assert meta["program"] == "rotordyn" and meta["version"] == want["version"]
    assert meta["title"] == want["title"] and meta["model"] == "[model]"
    assert {"git", "variant", "settings", "seed", "units"} <= set(meta)

    labels = file["labels"]
    nodes = texts(labels["node"])
    assert len(nodes) == len(labels["node_z"]) == len(want["equilibrium"]["nodes"])
    assert abs(labels["bearings/A"].attrs["bpfo"] - 3.5716) < 1e-3 and labels["bearings/A"].attrs["balls"] == 9

    equilibrium = file["equilibrium"]
    same(equilibrium["displacement"], [n["displacement"] for n in want["equilibrium"]["nodes"]])
    for bearing in want["equilibrium"]["bearings"]:
        group = equilibrium["bearings"][bearing["name"]]
        for name in ("force", "stiffness", "damping"):
            same(group[name], bearing[name])
        same(group["balls/load"], [ball["load_n"] for ball in bearing["balls"]])

    modes, modal = file["modes"], want["modal"]
    same(modes["rpm"], [at["speed_rpm"] for at in modal])
    for name, key in (("frequency", "frequency_hz"), ("zeta", "damping_ratio"), ("log_dec", "log_decrement")):
        same(modes[name], [[m[key] for m in at["modes"]] for at in modal])
        assert modes[name].dims[0].label == "rpm" and modes[name].dims[0][0] == modes["rpm"]
    same(modes["omega"][:] / (2 * np.pi), modes["frequency"][:])
    same(modes["eigenvalue"][:].imag, modes["omega"][:])
    assert texts(modes["label"]) == [[m["label"] for m in at["modes"]] for at in modal]
    shapes = modes["shapes"]
    assert shapes.dtype == np.complex128 and shapes.shape == (*modes["omega"].shape, len(nodes), 6)
    # Whirl as defined, from the shapes themselves: 1 is a forward circle.
    whirl, ux, uy = modes["whirl"][:], shapes[..., 0], shapes[..., 1]
    shaft = whirl.shape[-1]
    size = (np.abs(ux) ** 2 + np.abs(uy) ** 2)[..., :shaft]
    area = 2 * (ux * np.conj(uy)).imag[..., :shaft]
    moving = size > 1e-12 * size.max(axis=-1, keepdims=True)
    assert np.allclose(whirl[moving] * size[moving], area[moving], atol=1e-9 * size.max())

    campbell = file["campbell"]
    same(campbell["frequency"], [b["frequency_hz"] for b in want["campbell"]["branches"]])
    same(campbell["frequency"].dims[1]["rpm"], want["campbell"]["speeds_rpm"])
    assert texts(campbell["label"]) == [b["label"] for b in want["campbell"]["branches"]]
    assert "BPFO" in texts(campbell["orders/label"])
    for group, listed in (
        (campbell["crossings"], want["campbell"]["crossings"]),
        (file["critical_speeds"], want["critical_speeds"]["speeds"]),
    ):
        assert len(listed) > 0
        same(group["rpm"], [c["speed_rpm"] for c in listed])
        same(group["frequency"], [c["frequency_hz"] for c in listed])
        assert np.allclose(group["rpm"][:] / 60 * group["order"][:], group["frequency"][:], rtol=1e-9)
        assert texts(group["whirl"]) == [c["kind"] for c in listed]

    frf = file["frf"]
    same(frf["response"].dims[2]["frequency"], want["frf"]["frequency_hz"])
    assert frf.attrs["quantity"] == "accelerance" and frf["response"].dtype == np.complex128
    responses, excitations, units = (texts(frf[n]) for n in ("responses", "excitations", "units"))
    for function in want["frf"]["functions"]:
        r, e = responses.index(function["response"]), excitations.index(function["excitation"])
        same(frf["response"][r, e].real, function["re"])
        same(frf["response"][r, e].imag, function["im"])
        assert units[r][e] == function["unit"]

    unbalance = file["unbalance"]
    for response in want["unbalance"]["responses"]:
        same(unbalance["channels"][response["name"]][:].imag, response["im"])
    for orbit in want["unbalance"]["orbits"]:
        same(unbalance["orbits"][orbit["disc"]]["y"][:].real, orbit["y_re"])
    assert unbalance["orbits/main/x"].dims[0][0] == unbalance["rpm"]

    run = want["run_up"]
    assert file["time"].attrs["run_state"] == file["run_up"].attrs["end"] == run["end"] == "complete"
    assert list(file["channels"].attrs["names"]) == [c["name"] for c in run["channels"]]
    for channel in run["channels"]:
        stored = file["channels"][channel["name"]]
        assert {k: stored.attrs[k] for k in ("unit", "quantity", "station", "direction")} == {
            k: channel[k] for k in ("unit", "quantity", "station", "direction")
        }
        assert stored.attrs["fs"] == run["sample_rate_hz"] and len(stored) == run["samples"]
        same([stored[:].min(), stored[:].max()], [channel["minimum"], channel["maximum"]])

    spectrogram = file["spectra/B_ax/spectrogram"]
    amplitude, peak = spectrogram["amplitude"], want["spectrograms"][0]["peak"]
    assert [list(dim.keys()) for dim in amplitude.dims] == [["rpm", "time"], ["frequency"]]
    assert amplitude.attrs["unit"] == "m/s^2" and spectrogram.attrs["level"] == "peak"
    i, j = np.unravel_index(np.argmax(amplitude[:]), amplitude.shape)
    same(
        [spectrogram["rpm"][i], spectrogram["frequency"][j], amplitude[i, j]],
        [peak["speed_rpm"], peak["frequency_hz"], peak["amplitude"]],
    )
    orders = file["spectra/B_ax/orders"]
    assert [list(dim.keys()) for dim in orders["amplitude"].dims] == [["rpm", "time"], ["order"]]
    cuts = want["orders"][0]["cuts"]
    same(orders["cuts/rms"], [cut["rms"] for cut in cuts])
    assert texts(orders["cuts/label"]) == [cut["label"] for cut in cuts]
    same(orders["cuts/rms"].dims[1][0], cuts[0]["speed_rpm"])

    bearing, group = want["bearings"][0], file["bearings/B"]
    assert group.attrs["load_source"] == bearing["load_source"] and group.attrs["bpfo"] == bearing["nominal_orders"]["bpfo"]
    singles = ("load", "displacement", "stiffness", "radial_stiffness", "largest_pressure", "bpfo")
    for name in singles:
        same(group["operating"][name], bearing["operating"][name])
    for sweep in bearing["sweeps"]:
        over = group["sweep_" + sweep["variable"]]
        same(over["swept_value"], sweep["values"])
        assert over["swept_value"].attrs["unit"] == sweep["unit"]
        for name in singles:
            same(over[name], [point[name] for point in sweep["points"]])
            assert over[name].dims[0][0] == over["swept_value"]
        for race in ("inner", "outer"):
            for name in ("load", "contact_angle", "pressure", "film"):
                balls = [[ball[race][name] for ball in point["balls"]] for point in sweep["points"]]
                same(over["balls"][race][name], balls)
