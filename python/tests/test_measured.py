"""Modes of measurements, model updating and bearings by themselves: the command's bits, and what they mean."""

from __future__ import annotations

import json
import pickle
import subprocess
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rotordyn as rd
from conftest import COMMAND, MODELS, command, load

#: What is of the command.
OF_COMMAND = {"command", "seconds", "files", "schema", "program", "version", "exit_code", "errors", "warnings", "measured"}


def without(document: dict[str, Any], *more: str) -> dict[str, Any]:
    return {key: value for key, value in document.items() if key not in OF_COMMAND and key not in more}


@pytest.fixture(scope="module")
def noisy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """FRFs of the rig as a test with noise gives them."""
    folder = tmp_path_factory.mktemp("noisy")
    command("frf", str(MODELS / "overhung_rig.toml"), "--noise", "40 dB", "--out", str(folder), "--no-figures")
    return folder / "frf_noisy.uff"


def test_modes_of_a_file_are_those_of_the_command(noisy: Path, tmp_path: Path) -> None:
    expected = command("identify", str(noisy), "--band", "30 .. 200 Hz", "--out", str(tmp_path), "--no-figures")
    with warnings.catch_warnings(record=True) as given:
        warnings.simplefilter("always")
        found = rd.identify(noisy, band="30 .. 200 Hz")
    assert without(found.to_dict()) == without(expected)
    assert [str(w.message.text) for w in given if isinstance(w.message, rd.RotordynWarning)] == [  # type: ignore[attr-defined]
        w["text"] for w in expected["warnings"]
    ]
    assert Path(given[0].filename).name == "test_measured.py"
    assert len(found) == len(expected["modes"]) and np.array_equal(
        found.frequency_hz, [mode["frequency_hz"] for mode in expected["modes"]]
    )
    found.save_shapes(tmp_path / "own.uff")
    assert (tmp_path / "own.uff").read_bytes() == (tmp_path / "modes.uff").read_bytes()
    found.save(tmp_path / "own.h5")
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "results.h5") as a, h5py.File(tmp_path / "own.h5") as b:
        names: list[str] = []
        a.visit(names.append)
        for name in names:
            if isinstance(a[name], h5py.Dataset):
                assert np.array_equal(a[name][()], b[name][()]), name


def test_residual_terms_are_those_of_the_command(noisy: Path, tmp_path: Path) -> None:
    flags = ("--band", "30 .. 200 Hz", "--residual-terms", "none", "--out", str(tmp_path), "--no-figures")
    expected = command("identify", str(noisy), *flags)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = rd.identify(noisy, band="30 .. 200 Hz", residual_terms="none")
        both = rd.identify(noisy, band="30 .. 200 Hz")
    assert without(found.to_dict()) == without(expected)
    assert not np.array_equal(found.frequency_hz, both.frequency_hz)


def test_modes_of_computed_frfs_are_those_of_the_model(jeffcott: rd.Model) -> None:
    frf = jeffcott.frf(speed="0 rpm", max_frequency="100 Hz")
    modes = jeffcott.modal(speed="0 rpm", modes=4)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = rd.identify(frf)
        band = rd.identify(frf, band="10 .. 60 Hz")
    # One FRF without noise: the pole is that of the mode that it shows.
    near = np.argmin(abs(modes.frequency_hz - found.frequency_hz[0]))
    damped = modes.eigenvalue.imag[near] / (2 * np.pi)
    assert found.frequency_hz[0] == pytest.approx(abs(damped), rel=1e-5)
    assert found.zeta[0] == pytest.approx(modes.zeta[near], rel=1e-2)
    assert band.frequency_hz[0] == pytest.approx(found.frequency_hz[0], rel=1e-4)
    assert "modes" in found.keys() and found.unit("total_fit_error") == "1" and "modes" in repr(found) and "modes" in dir(found)
    assert found.plot().svg.startswith("<svg") and found.figures[0] == "stabilisation" and found._repr_html_()
    with pytest.raises(rd.InputError, match="there are"):
        found.plot("nothing")


def test_measurement_in_arrays(jeffcott: rd.Model) -> None:
    frf = jeffcott.frf(speed="0 rpm", max_frequency="100 Hz", refine=False)
    values = np.stack([frf[name, frf.excitations[0]] for name in frf.responses])[:, None, :]
    names = ["disc x", "disc y", "A x"][: len(values)]
    measured = rd.Measurement(frf.frequency_hz, values[:1], names[:1], ["disc x"], unit="m/N")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = rd.identify(measured, model=jeffcott)
        expected = rd.identify(frf)
        in_mm = rd.identify(rd.Measurement(frf.frequency_hz, values[:1] * 1e3, ["1 x"], ["1 x"], unit="mm/N"))
    assert found.frequency_hz[0] == pytest.approx(expected.frequency_hz[0], rel=1e-4)
    assert in_mm.frequency_hz[0] == pytest.approx(found.frequency_hz[0], rel=1e-6)
    again = pickle.loads(pickle.dumps(measured))
    assert np.array_equal(again.frf, measured.frf) and "1 x 1 FRFs" in repr(measured)
    good: dict[str, Any] = dict(frequency_hz=frf.frequency_hz, frf=values[:1], responses=["disc x"], references=["disc x"])
    for wrong, part in (
        (dict(frf=values[0]), "dimensions"), (dict(frf=values[:1, :, :-1]), "need"), (dict(frf=values[:1] * np.nan), "finite"),
        (dict(frf="x"), "numbers"), (dict(frequency_hz=frf.frequency_hz[::-1]), "increasing"),
        (dict(frequency_hz=frf.frequency_hz * 1j), "complex"), (dict(responses="disc x"), "list"), (dict(unit=3), "unit"),
        (dict(references=[]), "need"), (dict(coherence=values[:1].real[..., :3]), "coherence"),
    ):
        with pytest.raises(rd.InputError, match=part):
            rd.Measurement(**{**good, **wrong})
    for wrong, part in (
        (dict(responses=["disc"]), "direction"), (dict(responses=["rim x"]), "rim"),
        (dict(unit="furlongs"), "furlongs"), (dict(speed="3 m"), "speed"),
    ):
        with pytest.raises(rd.InputError, match=part), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            rd.identify(rd.Measurement(**{**good, **wrong}), model=jeffcott)


def test_bad_use_of_identify(noisy: Path, tmp_path: Path, jeffcott: rd.Model) -> None:
    (tmp_path / "text.csv").write_text("nothing\n")
    for use in (
        lambda: rd.identify(3),  # type: ignore[arg-type]
        lambda: rd.identify([]),
        lambda: rd.identify(tmp_path / "text.csv"),
        lambda: rd.identify(noisy, band="10 kg"),
        lambda: rd.identify(noisy, band=3),  # type: ignore[arg-type]
        lambda: rd.identify(noisy, out="x"),
        lambda: rd.identify(noisy, no_such_flag=1),
        lambda: rd.identify(noisy, model="x"),  # type: ignore[arg-type]
        lambda: rd.identify(noisy, mapping=3),  # type: ignore[arg-type]
        lambda: rd.identify(noisy, quantity="speediness"),
    ):
        with pytest.raises(rd.InputError):
            use()
    with pytest.raises(rd.FileError):
        rd.identify(tmp_path / "none.uff")


def perturbed(path: Path, speed: str = "0 rpm") -> rd.Frf:
    """FRFs of a rotor with a bearing of another stiffness."""
    other = load("jeffcott.toml")
    other.change({"bearing.B.k_xx": "1.5e6 N/m", "bearing.B.k_yy": "1.5e6 N/m"})
    return other.frf(speed=speed, max_frequency="200 Hz")


def test_update_is_that_of_the_command(tmp_path: Path) -> None:
    changed = tmp_path / "changed.toml"
    text = (MODELS / "jeffcott.toml").read_text()
    head, tail = text.split("[bearing.B]")
    changed.write_text(head + "[bearing.B]" + tail.replace("2e7 N/m", "1.5e6 N/m", 2))
    command("modal", str(changed), "--speed", "0 rpm", "--out", str(tmp_path / "m"), "--no-figures")
    measured = tmp_path / "m" / "results.h5"
    free = "bearing.B.k_xx+bearing.B.k_yy"
    words = ["--free", free, "--band", "5 .. 200 Hz", "--bounds", f"{free}=1e5 .. 1e8 N/m", "--profile", free]
    out = tmp_path / "u"
    expected = command("update", str(MODELS / "jeffcott.toml"), "--measured", str(measured), *words, "--out", str(out), "--no-figures")
    assert expected["exit_code"] == 0, expected["errors"]
    rig = load("jeffcott.toml")
    with warnings.catch_warnings(record=True) as given:
        warnings.simplefilter("always")
        found = rd.update(rig, measured, free, band="5 .. 200 Hz", bounds={free: "1e5 .. 1e8 N/m"}, profile=[free])
    assert without(found.to_dict()) == without(expected)
    assert [w.message.text for w in given] == [w["text"] for w in expected["warnings"]]  # type: ignore[union-attr]
    assert found.model.to_toml() == (out / "jeffcott_updated.toml").read_text()
    value = float(found.model["bearing.B.k_xx"].split()[0])
    assert value == pytest.approx(1.5e6, rel=0.05) and set(found.values) == {"bearing.B.k_xx", "bearing.B.k_yy"}
    assert rig["bearing.B.k_xx"] == "2e7 N/m" and found.plot().svg.startswith("<svg")
    found.save(tmp_path / "own.h5")
    assert (tmp_path / "own.h5").stat().st_size > 1000
    again = pickle.loads(pickle.dumps(found))
    assert again.to_dict() == found.to_dict() and again.model == found.model and again.values == found.values
    assert again.figures == found.figures and np.array_equal(again.parameters["value"], found.parameters["value"])
    # With changes the updated values are changes too.
    started = rig.with_changes({"bearing.B.k_xx": "3e7 N/m", "bearing.B.k_yy": "3e7 N/m"})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        moved = rd.update(started, measured, free, band="5 .. 200 Hz")
    assert float(moved.model["bearing.B.k_xx"].split()[0]) == pytest.approx(value, rel=0.05)
    assert moved.model.to_toml() != found.model.to_toml()


def test_update_from_identified_modes_and_from_frfs(tmp_path: Path) -> None:
    frf, rig, free = perturbed(tmp_path), load("jeffcott.toml"), "bearing.B.k_xx+bearing.B.k_yy"
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        modes = rd.identify(frf)
        of_modes = rd.update(rig, modes, [free], fit=["frequency"])
        kept = pickle.loads(pickle.dumps(modes))
        of_kept = rd.update(rig, kept, [free], fit="frequency")
        of_frf = rd.update(rig, frf, [free], fit=["frequency", "frf-complex"])
    assert kept.to_json() == modes.to_json() and np.array_equal(kept.modes["shape"], modes.modes["shape"])
    kept.save(tmp_path / "kept.h5")
    kept.save_shapes(tmp_path / "kept.uff")
    modes.save_shapes(tmp_path / "modes.uff")
    assert (tmp_path / "kept.uff").read_bytes() == (tmp_path / "modes.uff").read_bytes()
    for found in (of_modes, of_kept, of_frf):
        value = float(found.model["bearing.B.k_xx"].split()[0])
        # One frequency determines the linked stiffness to what one FRF determines of it.
        assert value == pytest.approx(1.5e6, rel=0.1)


def test_bad_use_of_update(noisy: Path, jeffcott: rd.Model) -> None:
    for use, part in (
        (lambda: rd.update("x", noisy, "bearing.A.k_xx"), "model"),  # type: ignore[arg-type]
        (lambda: rd.update(jeffcott, noisy, "bearing.A.k_qq"), "k_qq"),
        (lambda: rd.update(jeffcott, noisy, 3), "3"),  # type: ignore[arg-type]
        (lambda: rd.update(jeffcott, noisy, ["bearing.A.k_xx"], bounds=["x"]), "bounds"),  # type: ignore[arg-type]
        (lambda: rd.update(jeffcott, noisy, ["bearing.A.k_xx"], bounds={"bearing.B.k_xx": "1 .. 2 N/m"}), "not in free"),
        (lambda: rd.update(jeffcott, noisy, ["bearing.A.k_xx"], fit="everything"), "everything"),
        (lambda: rd.update(jeffcott, noisy, ["bearing.A.k_xx"], write="x.toml"), "write"),
        (lambda: rd.update(jeffcott, [noisy, noisy], ["bearing.A.k_xx"]), "single"),
        (lambda: rd.update(jeffcott, 7, ["bearing.A.k_xx"]), "measured"),  # type: ignore[arg-type]
    ):
        with pytest.raises(rd.InputError, match=part), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            use()


def test_bearing_under_a_load(rig: rd.Model, tmp_path: Path) -> None:
    words = ["--bearing", "B", "--load", "0, -500, 100 N", "--speed", "3000 rpm", "--sweep", "load=0 N .. 1 kN"]
    expected = command("bearing", str(MODELS / "overhung_rig.toml"), *words, "--out", str(tmp_path), "--no-figures")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = rig.bearing("B").analyse(load="0, -500, 100 N", speed="3000 rpm", sweep=["load=0 N .. 1 kN"])
        stiffness = rig.bearing("B").stiffness(load="0, -500, 100 N", speed="3000 rpm")
    assert without(found.to_dict()) == without(expected)
    assert found.stiffness.shape == (5, 5) and np.array_equal(stiffness[:5, :5], found.stiffness) and not stiffness[5].any()
    assert stiffness[1, 1] > 1e6 and len(found.sweeps) == 1 and found.plot().svg.startswith("<svg")
    assert np.array_equal(found.stiffness, expected["bearings"][0]["operating"]["stiffness"])
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(again.stiffness, found.stiffness) and again.to_json() == found.to_json()
    found.save(tmp_path / "own.h5")
    assert (tmp_path / "own.h5").stat().st_size > 1000
    for use in (
        lambda: rig.bearing("B").stiffness(load="5 N"),
        lambda: rig.bearing("B").analyse(load=3),  # type: ignore[arg-type]
        lambda: rig.bearing("B").analyse(sweep=7),  # type: ignore[arg-type]
        lambda: rig.bearing("B").analyse(sweep=["everything"]),
        lambda: rig.bearing("B").analyse(motion=2),
        lambda: load("jeffcott.toml").bearing("A").stiffness(load="0, -5, 0 N"),
    ):
        with pytest.raises(rd.InputError):
            use()


def test_no_words_of_the_command_line_in_messages(noisy: Path, jeffcott: rd.Model) -> None:
    with pytest.raises(rd.InputError) as caught, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rd.update(jeffcott, noisy, ["bearing.A.k_xx"], bounds={"bearing.B.k_xx": "1 .. 2 N/m"})
    assert "--" not in str(caught.value), str(caught.value)
    done = subprocess.run([COMMAND, "help", "--json", "--quiet"], capture_output=True, check=True)
    assert json.loads(done.stdout)["exit_code"] == 0
